#include "tabor/cli/help.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cli/layout.hpp"
#include "tabor/cli/markdown.hpp"
#include "tabor/cli/reference.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {
namespace {

using test::Outcome;
using test::run_tabor;
using testing::HasSubstr;

TEST(Help, OfEveryVerbShowsTwoExamplesThatCallIt) {
  for (const Verb& verb : verbs()) {
    EXPECT_GE(verb.examples.size(), 2u) << verb.name;
    for (const std::string& example : verb.examples) {
      EXPECT_THAT(example, testing::StartsWith("tabor " + verb.name)) << verb.name;
      EXPECT_THAT(help_of(verb), HasSubstr(shell_lines(example)));
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

/// Lines that are wider than a terminal of 80 columns.
std::vector<std::string> wide_lines(const std::string& text) {
  std::vector<std::string> wide;
  for (const std::string& line : split(text, '\n')) {
    if (width_on_screen(line) > 80) wide.push_back(line);
  }
  return wide;
}

TEST(Help, FitsEightyColumnsInEveryLine) {
  EXPECT_THAT(wide_lines(greeting()), testing::IsEmpty());
  EXPECT_THAT(wide_lines(overview()), testing::IsEmpty());
  for (const Reference& reference : references()) {
    std::set<std::string> words = {""};
    for (const HelpTable& table : reference.tables()) words.insert(table.word);
    for (const std::string& word : words) {
      EXPECT_THAT(wide_lines(help_of(reference.verb, word)), testing::IsEmpty())
          << reference.verb.name << ' ' << word;
    }
  }
}

TEST(Help, HasEveryOptionUnderOneHeading) {
  for (const Reference& reference : references()) {
    std::set<std::string> titles;
    std::size_t n_options = 0;
    for (const OptionGroup& group : reference.groups) {
      EXPECT_TRUE(titles.insert(group.title).second) << reference.verb.name << ' ' << group.title;
      n_options += group.options.size();
    }
    EXPECT_EQ(n_options, options_of(reference.verb).options().size());
    EXPECT_EQ(reference.groups.back().title, kCommonOptions);
  }
}

TEST(Help, PutsOptionsOfFrictionUnderWhatOneWants) {
  const Reference friction = reference_of(find_verb("friction"));
  const auto heading_of = [&](const std::string& flag) -> std::string {
    for (const OptionGroup& group : friction.groups) {
      for (const Option& option : group.options) {
        if (option.flag == flag) return group.title;
      }
    }
    return "nowhere";
  };
  EXPECT_EQ(heading_of("SCAN"), "Surface");
  EXPECT_EQ(heading_of("--pixel"), "Reading the file");
  EXPECT_EQ(heading_of("--pressure"), "Contact");
  EXPECT_EQ(heading_of("--material"), heading_of("--saturation-pressure"));
  EXPECT_EQ(heading_of("--density"), heading_of("--trapped"));
  EXPECT_EQ(heading_of("--density"), heading_of("--dry-below"));
  EXPECT_EQ(heading_of("--shear-strength"), heading_of("--density-curve"));
  EXPECT_EQ(heading_of("--csv"), "Output");
}

TEST(Greeting, NamesCommandsOfAFirstHourThatWork) {
  const test::Folder folder;
  const std::string scan = (folder / "scan.h5").string();
  ASSERT_EQ(run_tabor({"generate", "edt", "-o", scan, "--pixels", "64"}).code, 0);
  for (const FirstStep& step : first_steps()) {
    std::vector<std::string> words = split(step.command, ' ');
    ASSERT_EQ(words.front(), "tabor");
    words.erase(words.begin());
    EXPECT_NO_THROW(find_verb(words.front()));
    if (words.front() == "view" || words.front() == "report") continue;  // programs of Python
    for (std::string& word : words) {
      if (word == "SCAN") word = scan;
      if (word == "friction.h5") word = (folder / word).string();
    }
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, 0) << step.command << '\n' << outcome.err;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "friction.h5"));
}

TEST(Layout, BreaksCommandsSoThatAShellReadsThemWhole) {
  const std::string command = "tabor psd " + std::string(60, 'a') + " --group 'a b=*' -o x.csv";
  EXPECT_EQ(shell_lines(command),
            "  tabor psd " + std::string(60, 'a') + " \\\n      --group 'a b=*' -o x.csv");
}

TEST(Layout, CountsCharactersNotBytes) { EXPECT_EQ(width_on_screen("µm²"), 3u); }

TEST(OptionsMarkdown, ListsEveryVerbAndEscapesTableBars) {
  const std::string text = options_markdown();
  for (const Verb& verb : verbs()) {
    EXPECT_THAT(text, HasSubstr("## tabor " + verb.name));
  }
  EXPECT_THAT(text, HasSubstr("`--solver fast\\|polonsky-keer`"));
}

}  // namespace
}  // namespace tabor::cli
