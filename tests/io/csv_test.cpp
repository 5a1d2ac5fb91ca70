#include "tabor/io/text/csv.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "support/rejection.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::io {
namespace {

using test::rejection;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ParseCsv, ReadsCellsCommentsAndBlankLines) {
  const CsvTable table =
      parse_csv("# measured\n\na, b\r\n1,two\n# no row\n 3 ,\"f,\"\"o\"\"\"\n", "m.csv");
  EXPECT_THAT(table.columns, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[0], ElementsAre("1", "two"));
  EXPECT_THAT(table.rows[1], ElementsAre("3", "f,\"o\""));
  EXPECT_THAT(table.lines, ElementsAre(4, 6));
  EXPECT_EQ(table.number(1, "a"), 3);
}

TEST(ParseCsv, TakesAByteOrderMarkAndAMissingLastNewline) {
  const CsvTable table = parse_csv("\xEF\xBB\xBFp\n7e6", "m.csv");
  EXPECT_EQ(table.number(0, "p"), 7e6);
}

TEST(ParseCsv, ReadsBackWhatCsvLineWrote) {
  const std::vector<std::string> nasty{"a,b", "\"q\"", "two\nlines", "", " blank ", "#1", "plain"};
  const CsvTable table = parse_csv("a,b,c,d,e,f,g\n" + csv_line(nasty), "m.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], nasty);
}

TEST(CsvLine, LeavesNoFormulaForASpreadsheet) {
  EXPECT_EQ(csv_line({"=1+1", "@x", "+a.h5", "-cmd", "-1.5e-3", "+7", "a=b"}),
            "'=1+1,'@x,'+a.h5,'-cmd,-1.5e-3,+7,a=b\n");
  EXPECT_EQ(csv_line({"\t=1", "\r=1", "\n=1"}), "'\t=1,\"'\r=1\",\"'\n=1\"\n");
}

TEST(ParseCsv, ReadsBackWhatLooksLikeAFormula) {
  const std::vector<std::string> nasty{"=1+1", "'=1",   "''=1", "'plain", "'",  "-",
                                       "\t=1", "-x,\"", "-1.5", "@",      "'5", "'-5"};
  const CsvTable table = parse_csv("a,b,c,d,e,f,g,h,i,j,k,l\n" + csv_line(nasty), "m.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], nasty);
}

TEST(ParseCsv, NamesFileLineAndColumnOfAMistake) {
  const std::string text = "mean_pressure_Pa,friction\n2e6,0.3\n5e6,abc\n";
  EXPECT_THAT(rejection([&] { parse_csv(text, "m.csv").number(1, "friction"); }),
              HasSubstr("m.csv:3: column friction: got 'abc'; expected a number"));
  EXPECT_THAT(rejection([&] { parse_csv(text, "m.csv").number(0, "frictoin"); }),
              HasSubstr("did you mean 'friction'?"));
  EXPECT_THAT(rejection([] { parse_csv("a,b\n1\n", "m.csv"); }), HasSubstr("m.csv:2: got 1 cells"));
  EXPECT_THAT(rejection([] { parse_csv("a\n\"1\n", "m.csv"); }), HasSubstr("m.csv:2"));
  EXPECT_THAT(rejection([] { parse_csv("a\n\"1\"2\n", "m.csv"); }), HasSubstr("after a closing"));
  EXPECT_THAT(rejection([] { parse_csv("# only\n", "m.csv"); }), HasSubstr("header row"));
}

TEST(CsvNumber, ReadsBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3, 7e6, 4.9e-324, -1.7976931348623157e308, 0.0}) {
    EXPECT_EQ(parse_number(csv_number(value)), value);
  }
  EXPECT_EQ(csv_number(std::nan("")), "");
}

}  // namespace
}  // namespace tabor::io
