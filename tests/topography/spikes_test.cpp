#include "tabor/topography/spikes.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/rejection.hpp"
#include "support/rough_recipe.hpp"
#include "support/sample_surfaces.hpp"
#include "support/scans.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

Topography rough_surface(double hurst, std::uint64_t seed, Index n = 256) {
  return synthesis::self_affine(rough_recipe(n, hurst, seed));
}

std::set<Index> found(const Mask& mask) {
  std::set<Index> pixels;
  for (Index i = 0; i < mask.size(); ++i) {
    if (mask.data()[i]) pixels.insert(i);
  }
  return pixels;
}

/// Single pixels and pairs, up and down, also in a corner.
std::set<Index> plant_spikes(Topography& surface, double height) {
  std::set<Index> planted;
  const Index n = surface.grid.nx;
  for (const Index pixel : {Index{0}, 40 * n + 17, 40 * n + 18, 130 * n + 200, 200 * n + n - 1}) {
    surface.height.data()[pixel] += pixel % 2 == 0 ? height : -height;
    planted.insert(pixel);
  }
  return planted;
}

void plant_spikes_everywhere(Topography& surface, double share) {
  const Field chance = noise(surface.grid).height;
  const double range = surface.height.maxCoeff() - surface.height.minCoeff();
  std::vector<double> sorted(chance.data(), chance.data() + chance.size());
  std::sort(sorted.begin(), sorted.end());
  const double limit =
      sorted[static_cast<std::size_t>((1 - share) * static_cast<double>(sorted.size()))];
  for (Index i = 0; i < chance.size(); ++i) {
    if (chance.data()[i] > limit) surface.height.data()[i] += (i % 2 == 0 ? 0.5 : -0.5) * range;
  }
}

double upper_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The definition in spikes.hpp with windows of 5 x 5, without any shortcut.
Mask spikes_by_definition(const Field& height, double threshold) {
  Field distance(height.rows(), height.cols()), spread(distance);
  for (Index y = 0; y < height.rows(); ++y) {
    for (Index x = 0; x < height.cols(); ++x) {
      std::vector<double> around;
      for (Index v = y - 2; v <= y + 2; ++v) {
        for (Index u = x - 2; u <= x + 2; ++u) {
          const bool inside = v >= 0 && v < height.rows() && u >= 0 && u < height.cols();
          if (inside && (v != y || u != x)) around.push_back(height(v, u));
        }
      }
      const double median = upper_median(around);
      for (double& value : around) value = std::abs(value - median);
      distance(y, x) = std::abs(height(y, x) - median);
      spread(y, x) = 1.482602218505602 * upper_median(around);
    }
  }
  const double usual = 1.482602218505602 * upper_median(std::vector<double>(
                                               distance.data(), distance.data() + distance.size()));
  return distance > threshold * spread && distance > threshold * usual;
}

class SpikesOnRoughSurfaces : public testing::TestWithParam<double> {};

TEST_P(SpikesOnRoughSurfaces, AreFoundAndNothingElse) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    auto rough = rough_surface(GetParam(), seed);
    const auto planted = plant_spikes(rough, 8e-6);  // 8 Sq: the least exponent has short waves
    EXPECT_EQ(found(find_spikes(rough.height)), planted) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Exponents, SpikesOnRoughSurfaces, testing::Values(0.3, 0.8, 1.0));

TEST(Spikes, AreNotSeenInGaussianNoise) {
  EXPECT_EQ(find_spikes(noise({2000, 1000, 2e-3, 1e-3}).height).count(), 0);  // 2 million heights
}

TEST(Spikes, AreNotTheEdgesOfSteps) {
  const auto steps = surface({200, 150, 200e-6, 150e-6}, [](double x, double y) {
    return (std::fmod(x, 40e-6) < 20e-6 ? 5e-6 : 0) + 1e-9 * std::sin(3e5 * x) * std::cos(2e5 * y);
  });
  EXPECT_EQ(find_spikes(steps.height).count(), 0);
}

TEST(Spikes, StandOutOfAFlat) {
  auto flat = surface({50, 40, 50e-6, 40e-6}, [](double, double) { return 2e-6; });
  EXPECT_EQ(find_spikes(flat.height).count(), 0);
  flat.height(20, 10) = 3e-6;
  EXPECT_EQ(found(find_spikes(flat.height)), std::set<Index>{20 * 50 + 10});
}

TEST(Spikes, StandOutOfAProfile) {
  auto row = noise({400, 1, 400e-6, 1e-6});
  EXPECT_EQ(find_spikes(row.height).count(), 0);
  for (const Index x : {0, 200, 399}) row.height(0, x) += 50 * metrology::rms_height(row);
  EXPECT_EQ(found(find_spikes(row.height)), (std::set<Index>{0, 200, 399}));
  EXPECT_EQ(found(find_spikes(row.height.transpose())), (std::set<Index>{0, 200, 399}));
}

TEST(Spikes, BecomeHolesOrMedians) {
  auto rough = rough_surface(0.8, 3);
  const Field clean = rough.height;
  const auto planted = plant_spikes(rough, 5e-6);
  const auto holed = apply({"despike=auto"}, rough);
  EXPECT_EQ(found(holes(holed)), planted);
  EXPECT_THAT(holed.history.back(), HasSubstr("5 of 65536 heights"));
  EXPECT_THAT(texts_of(holed.warnings),
              testing::ElementsAre(HasSubstr("5 spikes"), HasSubstr("5 of 65536 pixels")));
  const auto mended = apply({"despike=8,5,median"}, rough);
  EXPECT_EQ(count_holes(mended), 0);
  EXPECT_LT((mended.height - clean).abs().maxCoeff(), 0.3e-6);
  EXPECT_EQ(((mended.height - rough.height).abs() > 0).count(), 5);
}

TEST(Spikes, AreCountedAmongHeightsAndNotAmongHoles) {
  Topography rough = rough_surface(0.8, 3);
  plant_spikes(rough, 5e-6);
  rough.height.block(60, 60, 10, 10) = std::numeric_limits<double>::quiet_NaN();
  const Topography despiked = apply({"despike=auto"}, rough);
  EXPECT_THAT(despiked.history.back(), HasSubstr("5 of 65436 heights"));
}

std::vector<std::string> texts_about_spikes(const Topography& surface) {
  std::vector<std::string> found;
  for (const Warning& warning : surface.warnings) {
    if (warning.code == "spikes") found.push_back(warning.text);
  }
  return found;
}

TEST(Spikes, OfAScanAreNotThoseOfAPart) {
  Topography rough = rough_surface(0.8, 3);
  plant_spikes(rough, 5e-6);
  look_at(rough);
  ASSERT_EQ(texts_about_spikes(rough).size(), 1U);
  EXPECT_THAT(texts_about_spikes(apply({"crop=0,0,100,100"}, rough)),
              testing::ElementsAre(HasSubstr("3 spikes (0.03 % of pixels)")));
  EXPECT_THAT(texts_about_spikes(apply({"crop=50,50,64,64"}, rough)), testing::IsEmpty());
  // A filter hides spikes and does not remove them.
  EXPECT_EQ(texts_about_spikes(apply({"lowpass=gauss:8um", "crop=50,50,64,64"}, rough)).size(), 1U);
}

/// The step that the warning advises.
std::string advised(const std::string& text) {
  const std::size_t begin = text.find("<despike=") + 1;
  return text.substr(begin, text.find('>', begin) - begin);
}

/// Heights that differ, or are no more.
Index count_taken(const Topography& before, const Topography& after) {
  return before.height.size() - (before.height == after.height || before.height.isNaN()).count();
}

/// Blocks of spikes hide each other in windows of which they fill half.
TEST(Spikes, ThatStandTogetherAreToldWithTheFurtherPassThatTakesThem) {
  for (const Index side : {4, 5}) {
    auto scan = noise({256, 256, 256e-6, 256e-6});
    const Field clean = scan.height;
    scan.height.block(100, 60, side, side) += 30e-6;
    scan.height.block(20, 200, side, side) -= 40e-6;
    const auto once = apply({"despike=auto"}, scan);
    ASSERT_EQ(texts_about_spikes(once).size(), 1U) << side;
    const std::string step = advised(texts_about_spikes(once).front());
    EXPECT_EQ(step, side == 4 ? "despike=8,7" : "despike=8,9");
    for (const Treatment& remedy : {Treatment{step}, {"despike=auto", step}}) {
      const auto after = apply(remedy, scan);
      EXPECT_EQ(count_holes(after), 2 * side * side) << side;
      EXPECT_THAT(texts_about_spikes(after), testing::IsEmpty());
      EXPECT_TRUE((after.height.isNaN() || after.height == clean).all());
    }
  }
}

/// A wider window takes ridges for spikes: near a spike it would be no help.
TEST(Spikes, LeftAreNoRidges) {
  for (const Index distance : {1, 3, 4}) {  // of the spike from the ridge [pixels]
    auto scan = noise({256, 256, 256e-6, 256e-6});
    scan.height.middleCols(100, 3) += 30e-6;
    scan.height(128, 102 + distance) += 60e-6;
    const auto once = apply({"despike=auto"}, scan);
    EXPECT_EQ(count_holes(once), 1) << distance;
    EXPECT_THAT(texts_about_spikes(once), testing::IsEmpty()) << distance;
    EXPECT_GT(count_holes(apply({"despike=8,7"}, once)), 256) << distance;  // most of the ridge
  }
}

/// Heights whose tails are heavier than a Gaussian's, as those of scans are.
Topography heavy_tailed(std::uint64_t seed, double power) {
  Topography scan = rough_surface(0.1, seed);
  const double rms = std::sqrt(scan.height.square().mean());
  scan.height = scan.height.sign() * rms * (scan.height / rms).abs().pow(power);
  return scan;
}

/// Whether there is a warning. The pass that it advises takes what it counts, and little else.
bool is_warned_of_what_a_further_pass_takes(const Topography& once) {
  const auto texts = texts_about_spikes(once);
  if (texts.empty()) return false;
  const Index n_taken = count_taken(once, apply({advised(texts.front())}, once));
  const Index n_left = std::stol(texts.front());
  EXPECT_GE(n_taken, n_left) << texts.front();
  EXPECT_LE(n_taken, 2 * n_left) << texts.front();
  return true;
}

TEST(Spikes, LeftAreTakenByTheFurtherPassThatTheWarningNames) {  // slow with sanitizers
  int n_warned = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const double power : {2.0, 3.0, 4.0}) {
      for (const char* first : {"despike=auto", "despike=8,5,median"}) {
        const auto once = apply({first}, heavy_tailed(seed, power));
        if (!is_warned_of_what_a_further_pass_takes(once)) continue;
        ++n_warned;
        EXPECT_EQ(advised(texts_about_spikes(once).front()).ends_with(",median"),
                  std::string(first).ends_with(",median"));
      }
    }
  }
  EXPECT_GT(n_warned, 5);
}

TEST(Spikes, LeftInMeasuredScansAreTakenByThatPass) {
  for (const char* name : {"gelsight_dime.tmd", "confocal_nanofocus1.nms", "frt_microprof2.frt"}) {
    TABOR_NEEDS_SHARED_SCAN(name);
    const auto scan = scan::read(tabor::test::shared_scan(name));
    const auto once = apply({"level=plane", "despike=auto"}, scan);
    const bool is_warned = is_warned_of_what_a_further_pass_takes(once);
    EXPECT_EQ(is_warned, std::string(name) != "confocal_nanofocus1.nms") << name;
  }
}

TEST(Spikes, LeftAreNoneWhereAWindowHasTakenThemAll) {  // slow with sanitizers
  auto rough = rough_surface(0.8, 3);
  plant_spikes(rough, 5e-6);
  EXPECT_THAT(texts_about_spikes(apply({"despike=auto"}, rough)), testing::IsEmpty());
  for (const double hurst : {0.3, 0.8}) {
    EXPECT_THAT(texts_about_spikes(apply({"despike=auto"}, rough_surface(hurst, 5))),
                testing::IsEmpty());
  }
  EXPECT_THAT(texts_about_spikes(apply({"despike=8,99"}, rough)), testing::IsEmpty());
}

TEST(Spikes, LeftInRoughScansAreNone) {
  for (const char* name : {"rubber_alicona.x3p", "focusvar_rough.al3d", "wli_ds_nonsquare.x3p"}) {
    TABOR_NEEDS_SHARED_SCAN(name);
    const auto scan = scan::read(tabor::test::shared_scan(name));
    EXPECT_THAT(texts_about_spikes(apply({"despike=auto"}, scan)), testing::IsEmpty()) << name;
  }
}

TEST(Spikes, DoNotDependOnUnits) {
  auto rough = rough_surface(0.6, 9);
  plant_spikes(rough, 4e-6);
  const auto before = found(find_spikes(rough.height));
  rough.height *= 1e6;
  EXPECT_EQ(found(find_spikes(rough.height)), before);
}

TEST(Spikes, LeaveHolesAndLonelyHeightsAlone) {
  auto rough = noise({64, 48, 64e-6, 48e-6});
  punch_holes(rough, 0.95);
  const auto after = remove_spikes(rough);
  EXPECT_TRUE((holes(after) || !holes(rough)).all());
}

TEST(Spikes, GiveTheSameBitsOnAnyNumberOfThreads) {
  auto rough = rough_surface(0.5, 2);
  plant_spikes(rough, 5e-6);
  expect_same_bits_on_any_threads([&] { return remove_spikes(rough).height; });
}

TEST(Spikes, OfAMeasuredScanGoAtOnce) {
  TABOR_NEEDS_SHARED_SCAN("polished_cyl_missing.sur");
  const auto scan =
      level(scan::read(tabor::test::shared_scan("polished_cyl_missing.sur")), Form::plane);
  // Along narrow bands heights jump between two levels some 7 nm apart, on a ground smooth to 0.6
  // nm.
  const auto after = remove_spikes(scan);
  EXPECT_GT(count_holes(after) - count_holes(scan), 1000);
  EXPECT_LT(count_holes(after), scan.grid.size() / 60);
  // Pairs that hid each other stand out now; fewer than before.
  EXPECT_LT(find_spikes(after.height).count(), count_holes(after) - count_holes(scan));
}

class SpikesOfRoughScans : public testing::TestWithParam<const char*> {};

TEST_P(SpikesOfRoughScans, AreNone) {
  TABOR_NEEDS_SHARED_SCAN(GetParam());
  EXPECT_EQ(count_spikes(scan::read(tabor::test::shared_scan(GetParam())).height), 0);
}

INSTANTIATE_TEST_SUITE_P(Scans, SpikesOfRoughScans,
                         testing::Values("rubber_alicona.x3p", "focusvar_rough.al3d",
                                         "wli_ds_nonsquare.x3p"));

/// A map too large to look at every pixel for the usual distance, with pairs of spikes.
TEST(Spikes, AreCountedAsTheyAreFound) {
  auto map = noise({1500, 400, 1.5e-3, 0.4e-3});
  punch_holes(map, 0.1);
  const double far = 30 * (map.height.isNaN().select(0, map.height)).abs().maxCoeff();
  for (Index k = 0; k < 50; ++k) {
    map.height(7 * k + 3, 29 * k + 5) = far;
    map.height(7 * k + 4, 29 * k + 5) = -far;
  }
  EXPECT_EQ(count_spikes(map.height), 100);
  EXPECT_EQ(find_spikes(map.height).count(), 100);
}

/// The rule itself, height by height, where all heights tell the usual distance.
TEST(Spikes, FollowTheirDefinition) {
  auto rough = rough_surface(0.2, 5, 64);
  plant_spikes_everywhere(rough, 0.02);
  const SpikeRule rule{.threshold = 4};
  const Mask expected = spikes_by_definition(rough.height, rule.threshold);
  EXPECT_GT(expected.count(), 20);
  EXPECT_TRUE((find_spikes(rough.height, rule) == expected).all());
}

TEST(ParseSpikeRule, ReadsEveryForm) {
  EXPECT_EQ(parse_spike_rule("auto").threshold, SpikeRule{}.threshold);
  EXPECT_EQ(parse_spike_rule("4.5").threshold, 4.5);
  EXPECT_EQ(parse_spike_rule("8,7").window, 7);
  EXPECT_TRUE(parse_spike_rule("auto, 3, median").fill_with_median);
  EXPECT_FALSE(parse_spike_rule("8,7,hole").fill_with_median);
}

TEST(ParseSpikeRule, RejectsWhatItCannotRead) {
  for (const std::string text : {"", "x", "0", "-3", "nan", "inf", "6,4", "6,1", "6,101", "6,5.5",
                                 "6,5,mean", "6,5,hole,1", "6,1e300"}) {
    EXPECT_THROW(parse_spike_rule(text), InputError) << text;
  }
  EXPECT_THAT(tabor::test::rejection([] { parse_spike_rule("6,4"); }), HasSubstr("odd number"));
}

}  // namespace
}  // namespace tabor::topography::test
