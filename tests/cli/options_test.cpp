#include "tabor/cli/options.hpp"

#include <gmock/gmock.h>

#include "tabor/core/error.hpp"

namespace tabor::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string message_of(const OptionSet& set, const std::vector<std::string>& words) {
  try {
    parse(set, "verb", words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Parse, AssignsRepeatedOptionsInTheOrderOfTheCommandLine) {
  OptionSet set;
  std::vector<std::string> order;
  for (const std::string flag : {"--alpha", "--beta"}) {
    set.add({.flag = flag,
             .placeholder = "X",
             .assign = [&order, flag](const std::string& value) { order.push_back(flag + value); }})
        .repeatable = true;
  }
  parse(set, "verb", {"--beta", "1", "--alpha=2", "--beta", "3"});
  EXPECT_THAT(order, ElementsAre("--beta1", "--alpha2", "--beta3"));
}

TEST(Parse, ConvertsQuantitiesToSi) {
  OptionSet set;
  double pressure = 0;
  std::vector<double> densities;
  set.quantity("--pressure", "P", "", dimension::pressure, pressure);
  set.quantities("--density", "D", "", dimension::areal_density, densities);
  parse(set, "verb", {"--pressure", "7 MPa", "--density", "0.45g/m^2,0.9 g/m^2"});
  EXPECT_DOUBLE_EQ(pressure, 7e6);
  EXPECT_THAT(densities, ElementsAre(testing::DoubleEq(0.45e-3), testing::DoubleEq(0.9e-3)));
}

TEST(Parse, RejectsAQuantityWithoutUnitAndShowsTheCorrectedForm) {
  OptionSet set;
  double pressure = 0;
  set.quantity("--pressure", "P", "", dimension::pressure, pressure);
  EXPECT_THAT(message_of(set, {"--pressure", "7"}), HasSubstr("--pressure 7MPa"));
}

TEST(Parse, NamesTheNearestOption) {
  OptionSet set;
  double pressure = 0;
  set.quantity("--pressure", "P", "", dimension::pressure, pressure);
  EXPECT_THAT(message_of(set, {"--presure", "7MPa"}),
              AllOf(HasSubstr("unknown option '--presure'"), HasSubstr("'--pressure'")));
}

TEST(Parse, NamesTheNearestWordOfAChoice) {
  OptionSet set;
  std::string model;
  set.choice("--model", {"droplets", "limit"}, "", model);
  EXPECT_THAT(message_of(set, {"--model", "dropletts"}), HasSubstr("did you mean 'droplets'"));
}

TEST(Parse, NamesAMissingOption) {
  OptionSet set;
  double pressure = 0;
  set.quantity("--pressure", "P", "mean pressure", dimension::pressure, pressure).required = true;
  EXPECT_THAT(message_of(set, {}), HasSubstr("--pressure P is missing"));
}

TEST(Parse, RejectsASurplusWord) {
  OptionSet set;
  std::string scan;
  set.positional("SCAN", "", scan);
  EXPECT_THAT(message_of(set, {"a", "b"}), HasSubstr("unexpected word 'b'"));
}

TEST(Parse, RejectsAnOptionWithoutItsValue) {
  OptionSet set;
  double pressure = 0;
  set.quantity("--pressure", "P", "", dimension::pressure, pressure);
  EXPECT_THAT(message_of(set, {"--pressure"}), HasSubstr("--pressure"));
}

TEST(Parse, RejectsAnOptionGivenTwiceThatActsOnce) {
  OptionSet set;
  double pressure = 0;
  set.quantity("--pressure", "P", "", dimension::pressure, pressure);
  EXPECT_THAT(message_of(set, {"--pressure", "1Pa", "--pressure", "2Pa"}),
              HasSubstr("more than once"));
}

TEST(Parse, TakesANegativeValue) {
  OptionSet set;
  double ratio = 0;
  set.number("--ratio", "X", "", ratio);
  parse(set, "verb", {"--ratio", "-0.5"});
  EXPECT_EQ(ratio, -0.5);
}

TEST(Parse, RejectsNumbersThatAreNotPlainOrNotWhole) {
  OptionSet set;
  double ratio = 0;
  std::uint64_t threads = 0;
  set.number("--ratio", "X", "", ratio);
  set.count("--threads", "", threads);
  for (const char* bad : {"nan", "inf", "0.3x", "", "1e400"}) {
    EXPECT_THAT(message_of(set, {"--ratio", bad}), HasSubstr("--ratio")) << bad;
  }
  for (const char* bad : {"-1", "1.5", "1e30", "two"}) {
    EXPECT_THAT(message_of(set, {"--threads", bad}), HasSubstr("--threads")) << bad;
  }
}

TEST(Parse, TakesSwitchesAndShortFlags) {
  OptionSet set;
  bool json = false;
  std::optional<std::string> output;
  set.toggle("--json", "", json);
  set.text("--output", "OUT", "", output).short_flag = "-o";
  parse(set, "verb", {"-o", "file.h5", "--json"});
  EXPECT_TRUE(json);
  EXPECT_EQ(output, "file.h5");
}

TEST(Parse, TakesAttachedValuesAndEndsOptionsAtTwoDashes) {
  OptionSet set;
  std::optional<std::string> title;
  std::optional<std::string> output;
  std::string scan;
  set.positional("SCAN", "", scan);
  set.text("--title", "T", "", title);
  set.text("--output", "OUT", "", output).short_flag = "-o";
  parse(set, "verb", {"--title=a=b", "-ofile.h5", "--", "--odd.x3p"});
  EXPECT_EQ(title, "a=b");
  EXPECT_EQ(output, "file.h5");
  EXPECT_EQ(scan, "--odd.x3p");
}

TEST(Parse, RejectsValuesThatAreNotThereOrNotTaken) {
  OptionSet set;
  bool json = false;
  std::optional<std::string> title;
  set.toggle("--json", "", json);
  set.text("--title", "T", "", title);
  EXPECT_THAT(message_of(set, {"--json=no"}), HasSubstr("--json takes no value"));
  EXPECT_THAT(message_of(set, {"--title", "--json"}), HasSubstr("--title: T is missing"));
  EXPECT_THAT(message_of(set, {"-x"}), HasSubstr("unknown option '-x'"));
}

TEST(Parse, TakesAFileAfterAnOptionThatMayStandAlone) {
  const auto outcome = [](const std::vector<std::string>& words) {
    OptionSet set;
    std::optional<std::string> table;
    std::vector<std::string> scans;
    set.positionals("SCAN", "", scans);
    Option& option = set.text("--csv", "[OUT]", "", table);
    option.if_bare = "-";
    option.extensions = {".csv"};
    parse(set, "verb", words);
    scans.insert(scans.begin(), *table);
    return scans;
  };
  EXPECT_THAT(outcome({"--csv", "out.CSV", "a.x3p"}), ElementsAre("out.CSV", "a.x3p"));
  EXPECT_THAT(outcome({"--csv", "a.x3p", "b.x3p"}), ElementsAre("-", "a.x3p", "b.x3p"));
}

}  // namespace
}  // namespace tabor::cli
