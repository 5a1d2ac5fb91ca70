#include "tabor/core/printable.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

#include "tabor/core/error.hpp"

namespace tabor {
namespace {

TEST(Printable, ShowsControlCharactersInsteadOfSendingThemToATerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\nc\x7f"), "a\\x1b[2Jb\\x0ac\\x7f");
  EXPECT_EQ(printable("5 \u00b5m"), "5 \u00b5m");
  EXPECT_STREQ(InputError("scan.txt", "'\r\t'", "", "").what(), "scan.txt: got '\\x0d\\x09'");
}

TEST(Printable, ShowsCharactersThatTerminalsActUponOrNobodySees) {
  EXPECT_EQ(printable("a\u009b2Jb\u0085"), "a\\u{9b}2Jb\\u{85}");  // C1 of a terminal: CSI, NEL
  EXPECT_EQ(printable("\u202e\u2066\u200e\u061c"), "\\u{202e}\\u{2066}\\u{200e}\\u{61c}");
  EXPECT_EQ(printable("a\u200bb\u00ad\ufeff\u2028"), "a\\u{200b}b\\u{ad}\\u{feff}\\u{2028}");
  EXPECT_EQ(printable("\U000e0041"), "\\u{e0041}");
  EXPECT_EQ(printable("Größe, образец, 試料, 𝜇"), "Größe, образец, 試料, 𝜇");
}

TEST(Printable, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\xff"
                      "a\x9b"),
            "\\xffa\\x9b");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");  // an overlong form of a control character
  EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");  // and a longer one
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a pair
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

/// Whatever the bytes, what is left is UTF-8 without anything unseen, and stays as it is.
TEST(Printable, NothingUnseenIsLeftOfRandomBytes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (int n = 0; n < 24; ++n) text += static_cast<char>(byte(random) | (n % 3 == 0 ? 0xC0 : 0));
    const std::string shown = printable(text);
    EXPECT_EQ(printable(shown), shown);
    EXPECT_EQ(shown.find_first_of(std::string_view("\0\n\r\x1b", 4)), std::string::npos);
    for (const std::string_view lead : {"\xc2\x9b", "\xe2\x80\xae", "\xe2\x80\x8b"}) {
      EXPECT_EQ(shown.find(lead), std::string::npos);
    }
  }
}

TEST(PrintableLines, KeepsLinesAndNothingElse) {
  EXPECT_EQ(printable_lines("a\n\x1b[2J\u202e\n"), "a\n\\x1b[2J\\u{202e}\n");
}

TEST(PrintableJson, SpellsTheSameContent) {
  EXPECT_EQ(printable_json("{\n \"a\": \"\u202e\u009b\U000e0041µ\"}"),
            "{\n \"a\": \"\\u202e\\u009b\\udb40\\udc41µ\"}");
}

TEST(Printable, KeepsTheEndsOfAnEndlessText) {
  const InputError error("scan.txt", std::string(1 << 20, 'x'), "a number", "export it again");
  const std::string message = error.what();
  EXPECT_LT(message.size(), 5000u);
  EXPECT_TRUE(message.starts_with("scan.txt: got xxx"));
  EXPECT_TRUE(message.ends_with("xxx; expected a number; export it again"));
}

}  // namespace
}  // namespace tabor
