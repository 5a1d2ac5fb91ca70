#include "tabor/metrology/profile/profile.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "support/rejection.hpp"
#include "support/sample_surfaces.hpp"
#include "support/scans.hpp"
#include "support/synthetic.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/metrology/profile/profile_elements.hpp"
#include "tabor/metrology/profile/profile_filter.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

using tabor::test::expect_within;
using tabor::test::rejection;
using testing::HasSubstr;

/// The parameters along x by symbol without its _x.
std::map<std::string, Parameter> along_x(const topography::Topography& topography,
                                         const ProfileOptions& options) {
  std::map<std::string, Parameter> found;
  for (const Parameter& p : profile_parameters(topography, ProfileAxis::x, options)) {
    found[p.symbol.substr(0, p.symbol.size() - 2)] = p;
  }
  return found;
}

double value(const topography::Topography& topography, const ProfileOptions& options,
             const std::string& symbol) {
  return along_x(topography, options).at(symbol).value;
}

/// One profile of n points, dx apart.
template <typename Height>
topography::Topography profile(Index n, double dx, const Height& height) {
  return surface({n, 1, dx * static_cast<double>(n), dx},
                 [&](double x, double) { return height(x); });
}

/// The heights are the roughness profile already; sections of lc.
ProfileOptions as_given(double cutoff, int sections,
                        ProfileStandard standard = ProfileStandard::iso21920) {
  ProfileOptions options;
  options.standard = standard;
  options.cutoff = cutoff;
  options.sections = sections;
  options.filtered = true;
  return options;
}

/// Two columns, x and z, in um.
topography::Topography read_columns(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string comment;
  std::getline(stream, comment);
  std::vector<double> x, z;
  for (double at = 0, height = 0; stream >> at >> height;) {
    x.push_back(at * 1e-6);
    z.push_back(height * 1e-6);
  }
  const double dx = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  Index i = 0;
  return profile(static_cast<Index>(z.size()), dx,
                 [&](double) { return z[static_cast<std::size_t>(i++)]; });
}

struct Printed {
  const char* symbol;
  double value;      ///< lengths in um
  double half_unit;  ///< of the last digit
};

void expect_printed(const std::map<std::string, Parameter>& found, const char* case_name,
                    const char* source, const std::vector<Printed>& printed) {
  for (const Printed& row : printed) {
    const Parameter& ours = found.at(row.symbol);
    const double scale = ours.unit == "m" ? 1e6 : 1;
    expect_within("Profile parameters", case_name, fmt::format("{}, absolute", row.symbol), source,
                  std::abs(ours.value * scale - row.value), row.half_unit);
  }
}

/// The instrument's numbers, ISO 1997, lc 2.5 mm, 4 sections.
TEST(ProfileParameters, AreThoseAStylusInstrumentPrints) {
  const std::string name = "profile_mitutoyo_2.txt";
  TABOR_NEEDS_SHARED_SCAN(name);
  const auto found = along_x(read_columns(tabor::test::shared_scan(name)),
                             as_given(2.5e-3, 4, ProfileStandard::iso4287));
  EXPECT_EQ(found.at("sections").value, 4);
  expect_printed(found, "stylus profile, four sections of 2.5 mm", "printed by the instrument",
                 {{"Ra", 3.308, 5e-4},
                  {"Rq", 3.959, 5e-4},
                  {"Rsk", -0.144, 5e-4},
                  {"Rku", 2.463, 5e-4},
                  {"Rp", 8.244, 5e-4},
                  {"Rv", 10.240, 5e-4},
                  {"Rz", 18.485, 5e-4},
                  {"Rz1max", 22.062, 5e-4},
                  {"Rt", 22.233, 5e-4},
                  {"Rdq", 0.157, 5e-4}});
}

TEST(ProfileParameters, AreThoseOfThePublishedSyntheticProfile) {
  auto topography = published_profile();
  topography.height -= topography.height.mean();  // published about the mean
  auto options = as_given(20e-6, 5);
  options.forward_slopes = true;
  expect_printed(along_x(topography, options), "published synthetic profile", "surfalize tests",
                 {{"Ra", 0.638341, 1e-6},
                  {"Rq", 0.713584, 1e-6},
                  {"Rp", 1.146977, 1e-6},
                  {"Rv", 1.179609, 1e-6},
                  {"Rz", 2.326586, 1e-6},
                  {"Rt", 2.479203, 1e-6},
                  {"Rsk", -0.002984, 1e-6},
                  {"Rku", 1.564224, 1e-6},
                  {"Rdq", 1.667171, 1e-6}});
}

/// Ten periods of 1000 points.
TEST(ProfileParameters, OfASineAreItsClosedForms) {
  const double a = 2e-6, period = 100e-6, dx = 0.1e-6;
  // The ends, which the slopes leave out, have the mean squared slope at this phase.
  const auto sine =
      profile(10000, dx, [&](double x) { return a * std::sin(2 * pi * x / period + pi / 4); });
  for (const auto standard : {ProfileStandard::iso21920, ProfileStandard::iso4287}) {
    const auto found = along_x(sine, as_given(2 * period, 5, standard));
    EXPECT_NEAR(found.at("Ra").value, 2 * a / pi, 1e-5 * a);
    EXPECT_NEAR(found.at("Rq").value, a / std::sqrt(2.0), 1e-9 * a);
    EXPECT_NEAR(found.at("Rsk").value, 0, 1e-9);
    EXPECT_NEAR(found.at("Rku").value, 1.5, 1e-9);
    EXPECT_NEAR(found.at("Rp").value, a, 1e-5 * a);
    EXPECT_NEAR(found.at("Rv").value, a, 1e-5 * a);
    EXPECT_NEAR(found.at("Rz").value, 2 * a, 2e-5 * a);
    EXPECT_NEAR(found.at("Rt").value, 2 * a, 2e-5 * a);
    EXPECT_NEAR(found.at("Rdq").value, std::sqrt(2.0) * pi * a / period, 1e-6 * a / period);
    EXPECT_NEAR(found.at("RSm").value, period, 1e-6 * period);
    EXPECT_NEAR(found.at("Rc").value, 2 * a, 2e-5 * a);
    EXPECT_NEAR(found.at("Rpd").value, 1 / period, 1e-6 / period);
    EXPECT_NEAR(found.at("Rmr(c)").value, 50, 0.02);
  }
}

/// All heights from -a to a are as frequent.
TEST(ProfileParameters, OfATriangularWaveAreItsClosedForms) {
  const double a = 3e-6, period = 50e-6;
  const auto triangle = profile(20000, 0.05e-6, [&](double x) {
    const double phase = x / period - std::floor(x / period);
    return a * (4 * std::abs(phase - 0.5) - 1);
  });
  auto options = as_given(4 * period, 5);
  options.ratio_height = a / 2;
  const auto found = along_x(triangle, options);
  EXPECT_NEAR(found.at("Ra").value / (a / 2), 1, 1e-5);
  EXPECT_NEAR(found.at("Rq").value / (a / std::sqrt(3.0)), 1, 1e-5);
  EXPECT_NEAR(found.at("Rku").value, 1.8, 1e-4);
  EXPECT_NEAR(found.at("RSm").value / period, 1, 1e-9);
  EXPECT_NEAR(found.at("Rc").value / (2 * a), 1, 2e-3);
  EXPECT_NEAR(found.at("Rk").value / (2 * a), 1, 2e-3);
  EXPECT_NEAR(found.at("Rpk").value / a, 0, 2e-3);
  EXPECT_NEAR(found.at("Rvk").value / a, 0, 2e-3);
  EXPECT_NEAR(found.at("Rmr(c)").value, 25, 0.05);
}

TEST(ProfileParameters, OfARampVanishWithItsForm) {
  const auto ramp = profile(1000, 1e-6, [](double x) { return 0.3 + 0.02 * x + 5 * x * x; });
  ProfileOptions options;
  options.kind = ProfileKind::primary;
  options.short_cutoff = 0;
  options.form_degree = 2;
  EXPECT_LT(value(ramp, options, "Pt"), 1e-14);
  options.form_degree = 1;  // x^2 over L minus its line: range L^2/4
  EXPECT_NEAR(value(ramp, options, "Pt") / (5 * 1e-6 / 4), 1, 0.01);
  options.form_degree = -1;
  EXPECT_NEAR(value(ramp, options, "Pp"), 0.3, 0.01);
}

/// Transmission of the Gaussian: exp(-pi (alpha lc/lambda)^2), one half at lambda = lc.
TEST(ProfileParameters, OfASineAreReducedAsTheFiltersSay) {
  const double a = 1e-6, period = 100e-6, lc = 250e-6, ls = 60e-6;
  auto sine = profile(4000, 1e-6, [&](double x) { return a * std::sin(2 * pi * x / period); });
  sine.periodic = true;
  const auto passed = [&](double cutoff) {
    return std::exp(-std::numbers::ln2 * (cutoff / period) * (cutoff / period));
  };
  ProfileOptions options;
  options.cutoff = lc;
  options.short_cutoff = ls;
  options.sections = 0;
  options.form_degree = -1;
  const double rms = a / std::sqrt(2.0);
  EXPECT_NEAR(value(sine, options, "Rq") / (rms * passed(ls) * (1 - passed(lc))), 1, 1e-9);
  EXPECT_EQ(value(sine, options, "sections"), 16);
  options.kind = ProfileKind::primary;
  EXPECT_NEAR(value(sine, options, "Pq") / (rms * passed(ls)), 1, 1e-9);
  options.kind = ProfileKind::waviness;
  EXPECT_NEAR(value(sine, options, "Wq") / (rms * passed(ls) * passed(lc)), 1, 1e-7);
}

TEST(ProfileParameters, TrimmedEndsDoNotBendAway) {
  const auto ramp = profile(2000, 1e-6, [](double x) { return 0.01 * x; });
  ProfileOptions options;
  options.cutoff = 250e-6;
  options.short_cutoff = 0;
  options.sections = 0;
  options.form_degree = -1;  // the filter alone must follow the slope
  const double whole = value(ramp, options, "Rt");
  options.ends = ProfileEnds::trim;
  EXPECT_EQ(value(ramp, options, "sections"), 7);  // 2 mm less lc/2 at both ends
  EXPECT_LT(value(ramp, options, "Rt"), 0.1 * whole);
  EXPECT_GT(whole, 0.01 * 50e-6);
}

TEST(ProfileParameters, ElementsIgnoreRipplesBelowATenth) {
  const double period = 100e-6;
  const auto rippled = [&](double ripple) {
    // Crosses the mean line several times where the wave does.
    return profile(10000, 0.1e-6, [&, ripple](double x) {
      return 1e-6 * (std::sin(2 * pi * x / period) + ripple * std::sin(2 * pi * 25 * x / period));
    });
  };
  for (const auto standard : {ProfileStandard::iso21920, ProfileStandard::iso4287}) {
    const auto options = as_given(5 * period, 2, standard);
    EXPECT_NEAR(value(rippled(0.08), options, "RSm") / period, 1, 0.03);
    // High enough, but shorter than 1 % of a section.
    const bool short_ones_count = standard == ProfileStandard::iso21920;
    EXPECT_EQ(value(rippled(0.5), options, "RSm") / period < 0.7, short_ones_count);
  }
}

TEST(ProfileElements, ReadBothWaysDifferWhereSmallPortionsLieBetween) {
  Eigen::ArrayXd z(14);
  z << 1, -1, 1, -0.05, 0.05, -1, 1, -1, 1, -1, 1, -1, 1, -1;
  const Discrimination least{0.1, 0.1, 0};
  const auto forward = profile_elements(z, least);
  const auto backward = profile_elements(z.reverse(), least);
  ASSERT_FALSE(forward.empty());
  // -1 and the hill 1 -0.05 0.05 up to the last crossing before -1, or to the first after 1.
  const double from = 0.5, late = 4 + 0.05 / 1.05;
  EXPECT_NEAR(late - from, 3.547619, 1e-6);
  ASSERT_GE(forward.size(), 2U);
  EXPECT_NEAR(forward[0].spacing, late - from, 1e-12);
  EXPECT_NEAR(forward[0].height, 2, 1e-12);
  EXPECT_NEAR(forward[1].spacing, 6.5 - late, 1e-12);
  const double early = 2 + 1 / 1.05;  // seen from the right
  double longest = 0;
  for (const auto& element : backward) longest = std::max(longest, element.spacing);
  EXPECT_NEAR(longest, 6.5 - early, 1e-12);
}

TEST(ProfileElements, DoNotReachAcrossHoles) {
  Eigen::ArrayXd z(200);
  for (Index i = 0; i < 200; ++i) z[i] = std::sin(2 * pi * (static_cast<double>(i) + 0.5) / 20);
  EXPECT_EQ(profile_elements(z, {}).size(), 9U);
  z[105] = kHole;
  const auto elements = profile_elements(z, {});
  EXPECT_EQ(elements.size(), 4U + 4U);
  for (const auto& element : elements) {
    EXPECT_NEAR(element.spacing, 20, 0.1);
  }
}

TEST(ProfileParameters, NarrowSpikesAreElementsOnlyIn2021) {
  // A spike of 0.5 % of the section on the falling flank: ISO 4287 asks for 1 %.
  const auto spiked = profile(10000, 0.1e-6, [](double x) {
    const double place = x / 100e-6 - std::floor(x / 100e-6);
    return 1e-6 * (place < 0.5 ? 1 : place > 0.74 && place < 0.7425 ? 0.8 : -1);
  });
  const auto wide = as_given(500e-6, 2, ProfileStandard::iso4287);
  EXPECT_NEAR(value(spiked, wide, "RSm"), 100e-6, 1e-6);
  EXPECT_NEAR(value(spiked, as_given(500e-6, 2), "RSm"), 50e-6, 2e-6);
}

TEST(ProfileParameters, AverageOverRowsWithTheirScatter) {
  auto map = surface({1000, 4, 1000e-6, 4e-6}, [](double x, double y) {
    const double a = 1e-6 * (1 + std::floor(y / 1e-6));  // 1, 2, 3, 4 um
    return a * std::sin(2 * pi * x / 100e-6);
  });
  const auto found = along_x(map, as_given(200e-6, 5));
  EXPECT_NEAR(found.at("Rq").value, 2.5e-6 / std::sqrt(2.0), 1e-12);
  // Standard deviation of 1, 2, 3, 4: sqrt(5/3) = 1.29; over sqrt 2: 0.913.
  EXPECT_THAT(found.at("Rq").note, HasSubstr("913 nm over 4 of 4 profiles"));
  map.height.row(1).setConstant(kHole);
  map.height.row(2).head(600).setConstant(kHole);
  const auto holed = along_x(map, as_given(200e-6, 5));
  EXPECT_THAT(holed.at("Rq").note, HasSubstr("over 2 of 4 profiles"));
  EXPECT_NEAR(holed.at("Rq").value, 2.5e-6 / std::sqrt(2.0), 1e-12);  // rows of 1 and 4 um
}

TEST(ProfileParameters, SayHowDensitiesScatterWhateverTheirUnit) {
  const auto map = surface({1000, 2, 1000e-6, 2e-6}, [](double x, double y) {
    return 1e-6 * std::sin(2 * pi * x / (y < 1e-6 ? 100e-6 : 50e-6));
  });
  // 10 and 20 elements per mm: 10/sqrt(2) = 7.07 about 15.
  const Parameter density = along_x(map, as_given(200e-6, 5)).at("Rpd");
  EXPECT_NEAR(density.value, 15e3, 15);
  EXPECT_THAT(density.note,
              HasSubstr("standard deviation 47.1 % of the mean over 2 of 2 profiles"));
}

TEST(ProfileParameters, WeighHolesNotAtAll) {
  auto square = surface({2000, 50, 2000e-6, 50e-6}, [](double x, double) {
    return std::fmod(x, 20e-6) < 10e-6 ? 1e-6 : -1e-6;
  });
  punch_holes(square, 0.2);
  const auto found = along_x(square, as_given(400e-6, 5));
  EXPECT_NEAR(found.at("Ra").value, 1e-6, 1e-15);
  EXPECT_NEAR(found.at("Rq").value, 1e-6, 1e-15);
  EXPECT_NEAR(found.at("Rz").value, 2e-6, 1e-15);
  EXPECT_NEAR(found.at("Rku").value, 1, 1e-12);
}

TEST(ProfileParameters, AlongYAreThoseOfTheTurnedMapAlongX) {
  auto map = noise({300, 200, 300e-6, 400e-6});
  punch_holes(map, 0.01);
  auto turned = map;
  turned.height = map.height.transpose();
  turned.grid = {200, 300, 400e-6, 300e-6};
  const auto y = profile_parameters(map, ProfileAxis::y);
  const auto x = profile_parameters(turned, ProfileAxis::x);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(x[i].value, y[i].value) << x[i].symbol;
    EXPECT_EQ(x[i].symbol.substr(0, x[i].symbol.size() - 1) + "y", y[i].symbol);
  }
  EXPECT_EQ(profile_parameters(map).size(), 2 * x.size());
}

TEST(ProfileParameters, OfOneRowOrColumnAreOfOneAxis) {
  const auto row = profile(500, 1e-6, [](double x) { return std::sin(x * 1e5) * 1e-7; });
  EXPECT_THAT(profile_parameters(row),
              testing::Each(testing::Field(&Parameter::symbol, testing::EndsWith("_x"))));
  auto column = row;
  column.height.resize(500, 1);
  column.height.col(0) = row.height.row(0).transpose();
  column.grid = {1, 500, 1e-6, 500e-6};
  EXPECT_THAT(profile_parameters(column),
              testing::Each(testing::Field(&Parameter::symbol, testing::EndsWith("_y"))));
}

ProfileSetting setting_for(double amplitude, double length, const ProfileOptions& options = {}) {
  const auto sine = profile(2000, length / 2000, [&](double x) {
    return amplitude * std::sin(2 * pi * 40 * x / length);
  });
  return choose_setting(sine, ProfileAxis::x, options);
}

TEST(ProfileSetting, IsTheClassOfTheRoughness) {
  const double um = 1e-6;
  EXPECT_EQ(setting_for(0.07 * um, 10e-3).cutoff, 0.08e-3);  // Rz = 0.14 um
  EXPECT_EQ(setting_for(0.3 * um, 25e-3).cutoff, 0.25e-3);
  EXPECT_EQ(setting_for(5 * um, 50e-3).cutoff, 0.8e-3);
  EXPECT_EQ(setting_for(30 * um, 50e-3).cutoff, 2.5e-3);
  EXPECT_EQ(setting_for(50 * um, 50e-3).cutoff, 8e-3);
  const auto setting = setting_for(5 * um, 5e-3);
  EXPECT_EQ(setting.sections, 5);
  EXPECT_EQ(setting.short_cutoff, 0);  // pixels of 2.5 um
  EXPECT_THAT(setting.reason, HasSubstr("below two pixels"));
  EXPECT_EQ(setting_for(5 * um, 2.2e-3).short_cutoff, 2.5e-6);
}

TEST(ProfileSetting, OfAShortScanSaysWhatItTook) {
  const auto smaller = setting_for(5e-6, 1.5e-3);
  EXPECT_EQ(smaller.cutoff, 0.25e-3);
  EXPECT_EQ(smaller.sections, 5);
  EXPECT_THAT(smaller.reason, HasSubstr("lc = 800 "));
  EXPECT_THAT(smaller.reason, HasSubstr("not comparable"));
  const auto fifth = setting_for(5e-6, 10e-6);
  EXPECT_NEAR(fifth.cutoff, 2e-6, 1e-15);
  EXPECT_EQ(fifth.sections, 5);
  EXPECT_THAT(fifth.reason, HasSubstr("a fifth of the profile"));
}

TEST(ProfileSetting, HasTenPixelsWhereTheyFit) {
  const auto next = setting_for(0.07e-6, 60e-3);  // pixels of 30 um
  EXPECT_EQ(next.cutoff, 0.8e-3);
  EXPECT_THAT(next.reason, HasSubstr("below ten pixels"));
  auto coarse = noise({30, 30, 3e-3, 3e-3});
  coarse.height *= 20e-9 / rms_height(coarse);
  EXPECT_NEAR(choose_setting(coarse, ProfileAxis::x).cutoff, 0.6e-3, 1e-12);
  const auto tiny = noise({4, 4, 64e-3, 64e-3});
  EXPECT_NEAR(choose_setting(tiny, ProfileAxis::x).cutoff, 32e-3, 1e-12);
}

TEST(ProfileSetting, IsOneForBothAxesOfAMapThatIsNoStrip) {
  const auto map = noise({200, 120, 200e-6, 120e-6});
  EXPECT_EQ(choose_setting(map, ProfileAxis::x).cutoff, 120e-6 / 5);
  EXPECT_EQ(choose_setting(map, ProfileAxis::y).cutoff, 120e-6 / 5);
  const auto strip = noise({200, 40, 200e-6, 40e-6});
  EXPECT_EQ(choose_setting(strip, ProfileAxis::x).cutoff, 200e-6 / 5);
  EXPECT_EQ(choose_setting(strip, ProfileAxis::y).cutoff, 40e-6 / 5);
}

TEST(ProfileSetting, TakesWhatIsAskedAsFarAsItFits) {
  ProfileOptions options;
  options.cutoff = 0.8e-3;
  EXPECT_EQ(setting_for(1e-6, 2.5e-3, options).sections, 3);
  EXPECT_THAT(setting_for(1e-6, 2.5e-3, options).reason, HasSubstr("3 of 5 sections fit"));
  EXPECT_EQ(setting_for(1e-6, 0.5e-3, options).sections, 1);
  EXPECT_THAT(setting_for(1e-6, 0.5e-3, options).reason, HasSubstr("shorter than lc"));
  options.sections = 0;
  EXPECT_EQ(setting_for(1e-6, 8e-3, options).sections, 10);
  options.kind = ProfileKind::primary;
  EXPECT_EQ(setting_for(1e-6, 8e-3, options).sections, 1);
}

TEST(ProfileParameters, OfAScanShorterThanTheCutoffExist) {
  ProfileOptions options;
  options.cutoff = 2.5e-3;
  const auto found = along_x(noise({64, 64, 64e-6, 64e-6}), options);
  EXPECT_GT(found.at("Ra").value, 0);
  EXPECT_THAT(found.at("lc").note, HasSubstr("shorter than lc"));
}

TEST(ProfileParameters, OfAFarTooLongCutoffAreThoseAboutTheMean) {
  const auto map = noise({300, 1, 300e-6, 1e-6});
  ProfileOptions options;
  options.short_cutoff = 0;
  options.cutoff = 1000;  // metres: must not need weights a kilometre long
  const auto found = along_x(map, options);
  EXPECT_THAT(found.at("lc").note, HasSubstr("100 profile lengths"));
  auto unfiltered = options;
  unfiltered.kind = ProfileKind::primary;
  const double about_line = value(map, unfiltered, "Pq");
  EXPECT_NEAR(found.at("Rq").value / about_line, 1, 1e-3);
}

TEST(ProfileParameters, OfTinyMapsAreNotNumbersButDoNotFail) {
  for (const Index n : {1, 2, 3, 5}) {
    const auto tiny = noise({n, n, 1e-6 * static_cast<double>(n), 1e-6 * static_cast<double>(n)});
    EXPECT_NO_THROW(profile_parameters(tiny)) << n;
  }
  auto holes = noise({40, 40, 40e-6, 40e-6});
  holes.height.setConstant(kHole);
  EXPECT_TRUE(std::isnan(value(holes, {}, "Ra")));
  EXPECT_THAT(along_x(holes, {}).at("Ra").note, HasSubstr("none of the profiles"));
}

TEST(ProfileParameters, HaveTheSameBitsForAnyNumberOfThreads) {
  auto map = noise({400, 300, 400e-6, 300e-6});
  punch_holes(map, 0.02);
  expect_same_bits_on_any_threads([&] {
    const auto list = profile_parameters(map);
    Field values(1, static_cast<Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) values(0, static_cast<Index>(i)) = list[i].value;
    return values;
  });
}

TEST(ProfileParameters, RejectWhatMakesNoSense) {
  const auto map = noise({64, 64, 64e-6, 64e-6});
  const auto message = [&](const auto& change) {
    ProfileOptions options;
    change(options);
    return rejection([&] { profile_parameters(map, options); });
  };
  EXPECT_THAT(message([](ProfileOptions& o) { o.cutoff = 1.5e-6; }), HasSubstr("two pixels"));
  EXPECT_THAT(message([](ProfileOptions& o) { o.cutoff = kHole; }), HasSubstr("two pixels"));
  EXPECT_THAT(message([](ProfileOptions& o) { o.short_cutoff = -1; }), HasSubstr("0 for none"));
  EXPECT_THAT(message([](ProfileOptions& o) {
                o.cutoff = 10e-6;
                o.short_cutoff = 20e-6;
              }),
              HasSubstr("less than lc"));
  EXPECT_THAT(message([](ProfileOptions& o) { o.sections = -1; }), HasSubstr("as many as fit"));
  EXPECT_THAT(message([](ProfileOptions& o) { o.form_degree = 7; }), HasSubstr("to 4"));
}

TEST(ProfileParameters, ReportProgressAndStop) {
  const auto map = noise({64, 64, 64e-6, 64e-6});
  std::vector<std::string> stages;
  profile_parameters(map, {}, [&](const Progress& progress) {
    stages.emplace_back(progress.stage);
    return true;
  });
  EXPECT_THAT(stages, testing::ElementsAre("profiles along x", "profiles along y"));
  EXPECT_THROW(profile_parameters(map, {}, [](const Progress&) { return false; }), Interrupted);
}

}  // namespace
}  // namespace tabor::metrology::test
