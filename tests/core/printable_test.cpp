#include "tabor/core/printable.hpp"

#include <gtest/gtest.h>

#include "tabor/core/error.hpp"

namespace tabor {
namespace {

TEST(Printable, ShowsControlCharactersInsteadOfSendingThemToATerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\nc\x7f"), "a\\x1b[2Jb\\x0ac\\x7f");
  EXPECT_EQ(printable("5 \u00b5m"), "5 \u00b5m");
  EXPECT_STREQ(InputError("scan.txt", "'\r\t'", "", "").what(), "scan.txt: got '\\x0d\\x09'");
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
