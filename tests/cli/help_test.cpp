#include "tabor/cli/help.hpp"

#include <gmock/gmock.h>

#include <set>

namespace tabor::cli {
namespace {

using testing::HasSubstr;

TEST(Help, OfEveryVerbShowsTwoExamplesThatCallIt) {
  for (const Verb& verb : verbs()) {
    EXPECT_GE(verb.examples.size(), 2u) << verb.name;
    for (const std::string& example : verb.examples) {
      EXPECT_THAT(example, testing::StartsWith("tabor " + verb.name)) << verb.name;
      EXPECT_THAT(help_of(verb), HasSubstr(example));
    }
  }
}

TEST(Help, ExplainsEveryOption) {
  for (const Verb& verb : verbs()) {
    const OptionSet set = options_of(verb);
    for (const Option& option : set.options()) {
      EXPECT_FALSE(option.help.empty()) << verb.name << ' ' << option.flag;
    }
  }
}

TEST(Help, NamesNoOptionTwice) {
  for (const Verb& verb : verbs()) {
    std::set<std::string> flags;
    const OptionSet set = options_of(verb);
    for (const Option& option : set.options()) {
      EXPECT_TRUE(flags.insert(option.flag).second) << verb.name << ' ' << option.flag;
    }
  }
}

TEST(OptionsMarkdown, ListsEveryVerbAndEscapesTableBars) {
  const std::string text = options_markdown();
  for (const Verb& verb : verbs()) {
    EXPECT_THAT(text, HasSubstr("## tabor " + verb.name));
  }
  EXPECT_THAT(text, HasSubstr("`--solver fast\\|polonsky-keer`"));
}

}  // namespace
}  // namespace tabor::cli
