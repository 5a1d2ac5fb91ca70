#include "tabor/cli/table.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace tabor::cli {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Table, AlignsNumbersRightAndWordsLeft) {
  Table table({"name", "value"});
  table.row({"a", "1"});
  table.row({"long", "100"});
  EXPECT_EQ(table.text(),
            "name  value\n"
            "----  -----\n"
            "a         1\n"
            "long    100\n");
}

TEST(Table, CountsCharactersAndNotBytes) {
  Table table({"unit", "x"});
  table.row({"µm", "1"});
  table.row({"nm", "1"});
  EXPECT_EQ(table.text(),
            "unit  x\n"
            "----  -\n"
            "µm    1\n"
            "nm    1\n");
}

TEST(Facts, LeaveOutWhatIsUnknown) {
  Facts facts;
  facts.fact("file", "a.x3p");
  facts.fact("instrument", "");
  EXPECT_EQ(facts.text(), "file  a.x3p\n");
}

TEST(Numbers, AreADashWhereThereIsNoValue) {
  EXPECT_EQ(percent(kNaN), "-");
  EXPECT_EQ(si(kNaN, "m"), "-");
  EXPECT_EQ(plain(kNaN), "-");
}

TEST(Numbers, AreShownInEngineeringForm) {
  EXPECT_EQ(percent(0.021343), "2.13 %");
  EXPECT_EQ(si(7e6, "Pa"), "7 MPa");
  EXPECT_EQ(si(6.7e-7, "m"), "670 nm");
}

TEST(Table, WhatAFileCallsItsChannelCannotCommandTheTerminal) {
  Table table({"channel"});
  table.row({"a\x1b[2J"});
  EXPECT_EQ(table.text().find('\x1b'), std::string::npos);
  Facts facts;
  facts.fact("channel", "a\x1b[2J\nmissing  none");
  EXPECT_EQ(facts.text(), "channel  a\\x1b[2J\\x0amissing  none\n");
}

}  // namespace
}  // namespace tabor::cli
