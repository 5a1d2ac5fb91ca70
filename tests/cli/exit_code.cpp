#include "tabor/cli/exit_code.hpp"

#include <gmock/gmock.h>

#include <new>
#include <sstream>

#include "tabor/core/error.hpp"

namespace tabor::cli {
namespace {

struct Ending {
  int code;
  std::string message;
};

template <class Thrown>
Ending ending_of(const Thrown& thrown) {
  std::ostringstream err;
  const int code = guarded(err, [&]() -> int { throw thrown; });
  return {code, err.str()};
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
  std::ostringstream err;
  EXPECT_EQ(guarded(err, [] { return 4; }), 4);
  EXPECT_EQ(err.str(), "");
}

TEST(ErrorMessage, IsOneLine) {
  EXPECT_EQ(ending_of(InputError("two\nlines")).message, "tabor: two lines\n");
}

}  // namespace
}  // namespace tabor::cli
