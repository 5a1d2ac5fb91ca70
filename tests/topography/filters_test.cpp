#include "tabor/topography/filters.hpp"

#include <gmock/gmock.h>

#include "support/sample_surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

const Grid kGrid{96, 80, 96e-6, 80e-6};

/// Whole periods along both axes.
Topography wave(double kx, double ky) {
  auto topography = surface(kGrid, [=](double x, double y) {
    return 1e-6 * std::cos(2 * pi * (kx * x / kGrid.lx + ky * y / kGrid.ly) + 0.3);
  });
  topography.periodic = true;
  return topography;
}

double hann(double relative) { return relative < 1 ? 0.5 * (1 + std::cos(pi * relative)) : 0; }

/// Largest deviation of the filtered wave from gain times the wave, over the amplitude.
double gain_error(const Topography& in, const std::string& filter, double gain) {
  const Field out = low_pass(in, parse_filter(filter)).height;
  return largest_difference(out, gain * in.height) / 1e-6;
}

TEST(HannFilter, HasTheRadialGain) {
  const double cutoff = 1 / 8e-6;
  for (const auto& [kx, ky] :
       {std::pair{3.0, 0.0}, {0.0, 5.0}, {6.0, -4.0}, {11.0, 2.0}, {20.0, 9.0}}) {
    const double relative = std::hypot(kx / kGrid.lx, ky / kGrid.ly) / cutoff;
    tabor::test::expect_within("Filters", fmt::format("Hann low-pass, wave ({}, {})", kx, ky),
                               "gain", "closed form",
                               gain_error(wave(kx, ky), "hann:8um", hann(relative)), 1e-14);
  }
}

TEST(HannFilter, FullWidthHalvesTheCutoff) {
  EXPECT_LT(
      gain_error(wave(3, 2), "hann-full:8um", hann(std::hypot(3 / kGrid.lx, 2 / kGrid.ly) * 16e-6)),
      1e-14);
}

TEST(HannFilter, SeparableMultipliesTheGainsOfBothAxes) {
  EXPECT_LT(gain_error(wave(7, 6), "hann-separable:8um",
                       hann(7 / kGrid.lx * 8e-6) * hann(6 / kGrid.ly * 8e-6)),
            1e-14);
}

TEST(HannFilter, CyclesPerSideCountBinsOfASquareScan) {
  const auto in = surface({64, 64, 1e-3, 1e-3},
                          [](double x, double) { return std::cos(2 * pi * 9 * x / 1e-3); });
  const Field out = low_pass(in, parse_filter("hann:12/L")).height;
  EXPECT_LT(largest_difference(out, hann(9.0 / 12) * in.height), 1e-13);
}

TEST(HannFilter, UsesTheSideOfASquareOfTheSameAreaElsewhere) {
  EXPECT_DOUBLE_EQ(scan_side({10, 10, 4e-3, 1e-3}), 2e-3);
  EXPECT_LT(gain_error(wave(4, 0), "hann:8/L", hann(4 / 96e-6 * std::sqrt(96e-6 * 80e-6) / 8)),
            1e-14);
}

TEST(HannFilter, TakesTheLengthOfAProfileForItsSide) {
  EXPECT_EQ(scan_side({500, 1, 1e-3, 2e-6}), 1e-3);
  EXPECT_EQ(scan_side({1, 500, 2e-6, 1e-3}), 1e-3);
  const auto row = surface({500, 1, 1e-3, 2e-6},
                           [](double x, double) { return std::cos(2 * pi * 9 * x / 1e-3); });
  const auto filtered = low_pass(row, parse_filter("hann:12/L"));
  EXPECT_LT(largest_difference(filtered.height, hann(9.0 / 12) * row.height), 1e-13);
  EXPECT_TRUE(filtered.warnings.empty());
  EXPECT_THAT(filtered.history.back(), testing::Not(HasSubstr("nan")));
  EXPECT_THAT(texts_of(low_pass(row, parse_filter("gauss:2mm")).warnings),
              testing::ElementsAre(HasSubstr("longer than the scan")));
}

TEST(HannFilter, MeansOneCopyOfTheScanAfterMirroring) {
  const auto history = apply({"mirror", "lowpass=hann:8/L"}, noise(kGrid)).history;
  const auto plain = apply({"lowpass=hann:8/L"}, noise(kGrid)).history;
  const auto cutoff = [](const std::string& line) { return line.substr(0, line.find(" (L")); };
  EXPECT_EQ(cutoff(history.back()), cutoff(plain.back()));
}

TEST(HannFilter, MeansOneCopyOfTheScanHoweverManyStepsLater) {
  const auto rough = noise(kGrid);
  const auto later = apply({"lowpass=hann:8/L"}, apply({"mirror"}, rough));
  const auto at_once = apply({"mirror", "lowpass=hann:8/L"}, rough);
  EXPECT_TRUE(same_bits(later.height, at_once.height));
  EXPECT_EQ(filter_side(later), scan_side(kGrid));
  // A cut-out is a scan of its own.
  const auto cut = apply({"mirror", "crop=3,2,20,10"}, rough);
  EXPECT_DOUBLE_EQ(filter_side(cut), std::sqrt(cut.grid.lx * cut.grid.ly));
}

TEST(HannFilter, NeedsASurfaceWithoutHoles) {
  auto holed = noise(kGrid);
  holed.height(3, 3) = kHole;
  try {
    low_pass(holed, parse_filter("hann:512/L"));
    FAIL() << "accepted holes";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("<fill=harmonic>"));
  }
}

TEST(GaussianFilter, TransmitsHalfAtTheCutoff) {
  for (const auto& [kx, ky] : {std::pair{3.0, 0.0}, {0.0, 2.0}, {6.0, 0.0}}) {
    const double wavelength = kx > 0 ? kGrid.lx / kx : kGrid.ly / ky;
    const double error = gain_error(wave(kx, ky), fmt::format("gauss:{}um", wavelength * 1e6), 0.5);
    tabor::test::expect_within("Filters",
                               fmt::format("Gaussian at its cutoff, {} um", wavelength * 1e6),
                               "gain", "ISO 16610-61", error, 1e-9);
  }
}

TEST(GaussianFilter, TransmitsByTheIsoCurve) {
  const double alpha_squared = std::log(2.0) / pi;
  for (const double kx : {1.0, 2.0, 8.0}) {
    const double ratio = 24e-6 * kx / kGrid.lx;
    EXPECT_LT(gain_error(wave(kx, 0), "gauss:24um", std::exp(-pi * alpha_squared * ratio * ratio)),
              1e-9);
  }
}

TEST(GaussianFilter, KeepsAConstantUpToTheEdgesAndAroundHoles) {
  auto flat = surface(kGrid, [](double, double) { return 5e-6; });
  EXPECT_LT((low_pass(flat, parse_filter("gauss:30um")).height - 5e-6).abs().maxCoeff(), 1e-19);
  punch_holes(flat, 0.4);
  const Field out = low_pass(flat, parse_filter("gauss:30um")).height;
  EXPECT_LT(largest_difference(out, flat.height), 1e-19);
}

/// A slow, direct Gaussian regression of order 0 over what is there.
double mean_around(const Topography& surface, Index y, Index x, double cutoff) {
  const double scale = std::sqrt(std::log(2.0) / pi) * cutoff;
  double sum = 0, weights = 0;
  for (Index v = 0; v < surface.grid.ny; ++v) {
    for (Index u = 0; u < surface.grid.nx; ++u) {
      if (!std::isnan(surface.height(v, u))) {
        const double dx = static_cast<double>(u - x) * surface.grid.dx(),
                     dy = static_cast<double>(v - y) * surface.grid.dy();
        const double weight = std::exp(-pi * (dx * dx + dy * dy) / (scale * scale));
        sum += weight * surface.height(v, u);
        weights += weight;
      }
    }
  }
  return sum / weights;
}

TEST(GaussianFilter, AgreesWithTheDefinitionAroundHoles) {
  auto holed = noise({30, 20, 30e-6, 30e-6});
  punch_holes(holed, 0.3);
  for (const double cutoff : {7e-6, 25e-6, 400e-6}) {  // weights end within and beyond the scan
    const Field out =
        low_pass(holed, Filter{.kind = FilterKind::gauss, .wavelength = cutoff}).height;
    for (const auto& [y, x] : {std::pair<Index, Index>{0, 0}, {7, 13}, {19, 29}, {11, 2}}) {
      if (!std::isnan(holed.height(y, x))) {
        EXPECT_NEAR(out(y, x), mean_around(holed, y, x, cutoff), 1e-9 * 1e-6) << cutoff;
      }
    }
  }
}

/// A slow, direct Gaussian with mirrored ends and weights up to 4 standard deviations.
double reflected_mean(const Field& height, Index y, Index x, double sigma) {
  const auto reach = static_cast<Index>(4 * sigma + 0.5);
  const auto mirrored = [](Index i, Index n) {
    return i < 0 ? -1 - i : i >= n ? 2 * n - 1 - i : i;
  };
  double sum = 0, weights = 0;
  for (Index v = -reach; v <= reach; ++v) {
    for (Index u = -reach; u <= reach; ++u) {
      const double weight = std::exp(-static_cast<double>(u * u + v * v) / (2 * sigma * sigma));
      sum += weight * height(mirrored(y + v, height.rows()), mirrored(x + u, height.cols()));
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(GaussianFilter, MirrorsHeightsAtTheEdgesWhenAsked) {
  const auto rough = noise({60, 50, 60e-6, 50e-6});
  const Field out = low_pass(rough, parse_filter("gauss-reflect:12um")).height;
  const double sigma = 12 * std::sqrt(std::log(2.0) / 2) / pi;
  for (const auto& [y, x] : {std::pair<Index, Index>{0, 0}, {49, 3}, {25, 30}, {2, 59}}) {
    EXPECT_NEAR(out(y, x), reflected_mean(rough.height, y, x, sigma), 1e-20);
  }
}

TEST(GaussianFilter, MirrorsBeyondTheSizeOfASmallScan) {
  const auto flat = surface({5, 4, 5e-6, 4e-6}, [](double, double) { return 3e-6; });
  EXPECT_LT((low_pass(flat, parse_filter("gauss-reflect:40um")).height - 3e-6).abs().maxCoeff(),
            1e-20);
}

TEST(Filters, WarningACutoffThatDoesNothingOrEverything) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(low_pass(rough, parse_filter("gauss:8um")).warnings.empty());
  EXPECT_TRUE(low_pass(rough, parse_filter("hann:512/L")).warnings.empty());
  EXPECT_THAT(
      texts_of(low_pass(rough, parse_filter("gauss:1.5um")).warnings),
      testing::ElementsAre(HasSubstr("below two pixels (2 µm), so it changes almost nothing")));
  EXPECT_THAT(texts_of(high_pass(rough, parse_filter("gauss:1.5um")).warnings),
              testing::ElementsAre(HasSubstr("so it leaves almost nothing")));
  EXPECT_THAT(texts_of(high_pass(rough, parse_filter("gauss:90um")).warnings),
              testing::ElementsAre(HasSubstr("so little more than the mean is removed")));
  EXPECT_THAT(texts_of(low_pass(rough, parse_filter("hann:0.5/L")).warnings),
              testing::ElementsAre(HasSubstr("longer than the scan")));
}

TEST(Filters, RejectACutoffFarBeyondTheScan) {
  const auto rough = noise(kGrid);
  for (const std::string text : {"gauss:8m", "hann:8km", "gauss-reflect:1/1000km"}) {
    EXPECT_THROW(low_pass(rough, parse_filter(text)), InputError) << text;
  }
}

TEST(GaussianFilter, WrapsRoundOnlyWhereTheSurfaceIsPeriodic) {
  auto rough = noise(kGrid);
  const auto filter = parse_filter("gauss:20um");
  const Field open = low_pass(rough, filter).height;
  rough.periodic = true;
  const Field wrapped = low_pass(rough, filter).height;
  EXPECT_LT((open - wrapped).block(40, 40, 4, 4).abs().maxCoeff(), 1e-16);
  EXPECT_GT((open - wrapped).abs().maxCoeff(), 1e-8);
}

TEST(Filters, LowAndHighPassAddUpToTheSurface) {
  const auto rough = noise(kGrid);
  for (const std::string text : {"hann:8um", "gauss:8um"}) {
    const auto filter = parse_filter(text);
    EXPECT_LT(largest_difference(low_pass(rough, filter).height + high_pass(rough, filter).height,
                                 rough.height),
              1e-20);
  }
}

TEST(Filters, CommuteWithUnitsAndTransposition) {
  const auto rough = noise(kGrid);
  for (const std::string text : {"hann:8um", "hann-separable:9/L", "hann-full:9/L", "gauss:8um"}) {
    const auto filter = parse_filter(text);
    const Field smooth = low_pass(rough, filter).height;
    auto scaled = rough;
    scaled.height *= 1e6;
    EXPECT_LT(largest_difference(low_pass(scaled, filter).height, 1e6 * smooth), 1e-12) << text;
    EXPECT_LT(largest_difference(low_pass(transpose(rough), filter).height, smooth.transpose()),
              1e-18)
        << text;
  }
}

TEST(Filters, GiveTheSameBitsOnAnyNumberOfThreads) {
  const auto rough = noise({300, 200, 1e-3, 1e-3});
  for (const std::string text : {"hann:20um", "gauss:20um"}) {
    expect_same_bits_on_any_threads([&] { return low_pass(rough, parse_filter(text)).height; });
  }
}

TEST(ParseFilter, ReadsEveryFormOfACutoff) {
  EXPECT_EQ(parse_filter("hann:512/L").cycles_per_side, 512);
  EXPECT_EQ(parse_filter("hann-full:300/L").kind, FilterKind::hann_full);
  EXPECT_EQ(parse_filter("hann-separable: 512 / L").kind, FilterKind::hann_separable);
  EXPECT_DOUBLE_EQ(parse_filter("hann:8um").wavelength, 8e-6);
  EXPECT_DOUBLE_EQ(parse_filter("hann:1/(8um)").wavelength, 8e-6);
  EXPECT_DOUBLE_EQ(parse_filter("hann:2/8 um").wavelength, 4e-6);
  EXPECT_DOUBLE_EQ(parse_filter("gauss:0.25mm").wavelength, 250e-6);
  EXPECT_DOUBLE_EQ(parse_filter("hann:512/L").cutoff_wavelength(1e-3), 1e-3 / 512);
}

TEST(ParseFilter, WritesWhatItReads) {
  for (const std::string text :
       {"hann:512/L", "hann-full:12.5/L", "gauss:8um", "hann-separable:0.25um"}) {
    EXPECT_EQ(to_string(parse_filter(text)), text);
  }
}

TEST(ParseFilter, RejectsWhatItCannotRead) {
  for (const std::string text :
       {"", "hann", "hann:", "hann:512", "hann:0/L", "hann:-3/L", "hann:x/L", "hann:512/M",
        "gauss:8", "gauss:-8um", "gauss:8kg", "gauss:0um", "hann:1/0um", "hann:inf/L", "hann:(8um",
        "butter:8um"}) {
    EXPECT_THROW(parse_filter(text), InputError) << text;
  }
}

TEST(ParseFilter, NamesTheNearestKind) {
  try {
    parse_filter("gaus:8um");
    FAIL() << "accepted an unknown filter";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'gauss'"));
  }
}

TEST(Filters, SayInTheHistoryWhatTheyChanged) {
  EXPECT_THAT(low_pass(noise(kGrid), parse_filter("hann-full:8um")).history.back(),
              HasSubstr("full width, cutoff wavelength 8 µm, zero below 16 µm, 8 pixels"));
  EXPECT_THAT(low_pass(noise(kGrid), parse_filter("hann:16/L")).history.back(),
              testing::AllOf(testing::StartsWith("lowpass=hann:16/L: radial, cutoff wavelength"),
                             HasSubstr("(L = 87.64 "), HasSubstr("Sdq")));
  EXPECT_THAT(low_pass(noise(kGrid), parse_filter("hann:512/L")).history.back(),
              HasSubstr("beyond Nyquist"));
}

}  // namespace
}  // namespace tabor::topography::test
