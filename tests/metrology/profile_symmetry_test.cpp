// Profile parameters of a map do not depend on how it lies.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "support/sample_surfaces.hpp"
#include "tabor/metrology/profile/profile.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

std::vector<ProfileOptions> all_ways() {
  std::vector<ProfileOptions> ways;
  for (const auto standard : {ProfileStandard::iso21920, ProfileStandard::iso4287}) {
    for (const auto kind : {ProfileKind::roughness, ProfileKind::primary, ProfileKind::waviness}) {
      for (const auto ends : {ProfileEnds::regression, ProfileEnds::trim}) {
        for (const std::optional<int> sections :
             {std::optional<int>(), std::optional(0), std::optional(2), std::optional(4)}) {
          ProfileOptions options{.standard = standard, .kind = kind, .sections = sections};
          options.ends = ends;
          options.ratio_height = 0.4e-6;
          if (sections) options.cutoff = 13.7e-6;  // no whole number of pixels
          ways.push_back(options);
        }
      }
    }
  }
  return ways;
}

/// Turned by 180 degrees, mirrored along either axis and transposed (then x is y), a map has the
/// same profiles.
TEST(ProfileParameters, DoNotDependOnTheDirectionOfTheMap) {  // slow with sanitizers
  for (const std::pair<Index, Index>& shape :
       {std::pair<Index, Index>{80, 60}, {81, 60}, {80, 61}}) {
    const Index nx = shape.first, ny = shape.second;
    const double lx = 1e-6 * static_cast<double>(nx), ly = 1e-6 * static_cast<double>(ny);
    auto map = noise({nx, ny, lx, ly});
    punch_holes(map, 0.01);
    for (const ProfileOptions& options : all_ways()) {
      const auto expected = profile_parameters(map, options);
      const auto compare = [&](const Field& height, const char* how, bool transposed = false) {
        auto other = map;
        other.height = height;
        if (transposed) other.grid = {ny, nx, ly, lx};
        const auto found = profile_parameters(other, options);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          const std::size_t at = transposed ? (i + found.size() / 2) % found.size() : i;
          if (std::isnan(expected[i].value) && std::isnan(found[at].value)) continue;
          if (expected[i].value == found[at].value) continue;
          EXPECT_NEAR(found[at].value / expected[i].value, 1, 1e-7)
              << expected[i].symbol << ' ' << how << ' ' << nx << ' ' << ny;
        }
      };
      compare(map.height.reverse(), "turned by 180 degrees");
      compare(map.height.rowwise().reverse(), "mirrored along x");
      compare(map.height.colwise().reverse(), "mirrored along y");
      compare(map.height.transpose(), "transposed", true);
    }
  }
}

}  // namespace
}  // namespace tabor::metrology::test
