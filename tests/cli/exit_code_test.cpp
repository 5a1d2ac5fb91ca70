#include "tabor/cli/exit_code.hpp"

#include <gmock/gmock.h>

#include <new>
#include <stdexcept>
#include <string>

#include "tabor/core/error.hpp"

namespace tabor::cli {
namespace {

struct Ending {
  int code = -1;
  std::string message;
};

template <class Thrown>
Ending ending_of(const Thrown& thrown) {
  Ending ending;
  ending.code = guarded(
      [&](const std::string& line, int code) {
        ending.message = line;
        return code;
      },
      [&]() -> int { throw thrown; });
  return ending;
}

TEST(ExitCode, FollowsTheKindOfError) {
  EXPECT_EQ(ending_of(UsageError("x")).code, 2);
  EXPECT_EQ(ending_of(InputError("x")).code, 3);
  EXPECT_EQ(ending_of(OutputError("x")).code, 5);
  EXPECT_EQ(ending_of(Interrupted()).code, 130);
  EXPECT_EQ(ending_of(std::bad_alloc()).code, 3);
  EXPECT_EQ(ending_of(std::logic_error("x")).code, 1);
}

TEST(ExitCode, OfSuccessIsWhatTheBodyReturns) {
  const auto complain = [](const std::string&, int) -> int { throw std::logic_error("nothing"); };
  EXPECT_EQ(guarded(complain, [] { return 4; }), 4);
}

}  // namespace
}  // namespace tabor::cli
