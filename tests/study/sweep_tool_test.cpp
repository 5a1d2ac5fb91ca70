// Studies whose sheets are pressed with a rough tool.
#include <gmock/gmock.h>

#include "study/example_study.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/study/case.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;
using testing::HasSubstr;

std::string with_tool(const std::string& lines) {
  std::string text = test::kStudyText;
  text.insert(text.find("[[scan]]"), "[contact]\n" + lines);
  return text;
}

void write_tool(const ExampleStudy& example, std::uint64_t seed) {
  scan::write(synthesis::ground({.grid = {48, 24, 48e-6, 24e-6},
                                 .rms_height = 0.1e-6,
                                 .groove_spacing = 8e-6,
                                 .groove_length = 20e-6,
                                 .seed = seed}),
              example.folder / "tools.h5");
}

std::vector<std::string> keys_of(const Study& study) {
  std::vector<std::string> keys;
  for (const ScanTasks& tasks : tasks_of(study)) {
    for (const engine::Task& task : tasks.contacts) keys.push_back(task.key);
  }
  return keys;
}

TEST(SweepTool, ComputesAContactForEachPlaceAndOneRowForAll) {
  const ExampleStudy example;
  example.write(with_tool("tool = \"ground:Sa=0.1um,groove-length=20um\"\ntool_places = 3\n"));
  const Outcome outcome = example.run();
  EXPECT_EQ(outcome.n_done, 8U);
  EXPECT_EQ(outcome.n_contacts, 12U);
  const io::CsvTable table = io::parse_csv(example.csv(), "results.csv");
  ASSERT_EQ(table.rows.size(), 8U);
  double spread = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(table.number(i, "tool_places"), 3);
    spread += table.number(i, "friction_dry_std");
    EXPECT_LT(table.number(i, "friction_dry_std"), table.number(i, "friction_dry"));
  }
  EXPECT_GT(spread, 0);
  EXPECT_EQ(example.run().n_contacts, 0U);
}

TEST(SweepTool, OfAFileLiesBesideTheStudyAndIsKnownByItsBytes) {
  const ExampleStudy example;
  write_tool(example, 1);
  example.write(with_tool("tool = \"tools.h5\"\n"));
  const std::vector<std::string> keys = keys_of(example.read());
  EXPECT_EQ(keys_of(parse_study(to_toml(example.read()), example.folder / "study.toml")), keys);
  EXPECT_EQ(example.run().n_done, 8U);
  write_tool(example, 2);
  EXPECT_NE(keys_of(example.read()), keys);
}

TEST(SweepTool, ThatIsMissingOrUnknownIsNamedWithItsLine) {
  const ExampleStudy example;
  example.write(with_tool("tool = \"nowhere.h5\"\n"));
  EXPECT_THAT(test::message_of([&] { example.read(); }), HasSubstr("contact.tool"));
  example.write(with_tool("tool = \"grond:Sa=0.1um\"\n"));
  EXPECT_THAT(test::message_of([&] { example.read(); }), HasSubstr("ground"));
  example.write(with_tool("tool_places = 3\n"));
  EXPECT_THAT(test::message_of([&] { example.read(); }), HasSubstr("contact.tool"));
}

}  // namespace
}  // namespace tabor::study
