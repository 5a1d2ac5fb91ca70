#include "tabor/cli/lowpass_scan.hpp"

#include <gmock/gmock.h>

#include "tabor/core/error.hpp"

namespace tabor::cli {
namespace {

TEST(ParseCutoffs, TakesRisingNumbersOnly) {
  EXPECT_EQ(parse_cutoffs("64,128,256"), (std::vector<double>{64, 128, 256}));
  for (const char* bad : {"", "64,", "128,64", "64,64", "0,1", "-1", "8um", "inf"}) {
    EXPECT_THROW(parse_cutoffs(bad), UsageError) << bad;
  }
}

}  // namespace
}  // namespace tabor::cli
