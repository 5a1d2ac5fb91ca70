#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "results/sound_contact.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/core/random.hpp"
#include "tabor/results/explanations.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::results {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(Codes, AreAllExplainedToUsersAndNoOthers) {
  std::ifstream file(std::string(TABOR_SOURCE_DIR) + "/docs/warnings.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(warnings_text(), page.str());
  std::vector<std::string> codes, explained;
  for (const cases::CodeEntry& entry : cases::all_codes()) codes.emplace_back(entry.code);
  for (const Explanation& one : explanations()) {
    explained.push_back(one.code);
    EXPECT_FALSE(one.when.empty()) << one.code;
    EXPECT_THAT(one.about, testing::StartsWith("About the "));
    EXPECT_FALSE(cases::class_of(one.code) == cases::Class::doubt && one.what_to_do.empty())
        << one.code;
  }
  EXPECT_THAT(explained, testing::UnorderedElementsAreArray(codes));
  EXPECT_EQ(explanation_of("no-such-code"), nullptr);
}

/// A warning of every code with its longest numbers, as the functions word it.
Warnings one_of_each() {
  Warnings all;
  topography::Topography scan = rough();
  scan.periodic = scan.edges_match = false;
  scan.grid.ly *= 1.01;
  for (Index y = 0; y < kGrid.ny; ++y) {
    for (Index x = 0; x < kGrid.nx; ++x) {
      scan.height(y, x) = 1.23e-7 * std::round((double(x) + 1e7 * scan.height(y, x)) / 2.5);
    }
  }
  scan.height(20, 20) = 1;
  scan.height(3, 3) = std::nan("");
  scan.warnings = topography::warnings(scan);
  for (const auto& one : topography::warnings(scan)) all.push_back({one.code, one.text});
  topography::Topography row = scan;
  row.height = scan.height.row(3);
  row.grid.ny = 1;
  for (const auto& one : topography::warnings(row)) all.push_back({one.code, one.text});
  topography::Topography jumping = rough();
  const CounterRandom random(5);
  for (Index y = 0; y < kGrid.ny; ++y) jumping.height.row(y) += 1e-3 * random.normal(y);
  for (const auto& one : topography::warnings(jumping)) all.push_back({one.code, one.text});
  scan.warnings.push_back(
      {.code = "override", .text = "height unit overridden: nm instead of the file's 'um'"});
  scan.warnings.push_back(
      {.code = "file", .text = "the height scale is negative: is up really up?"});
  const auto treated = topography::apply(
      {"despike=auto", "fill=harmonic", "lowpass=gauss:123.456um", "lowpass=gauss:0.123um"}, scan);
  for (const auto& one : treated.warnings) all.push_back({one.code, one.text});
  topography::Topography holes = scan;
  holes.height.leftCols(40) = std::nan("");
  for (const auto& one : topography::apply({"fill=harmonic"}, holes).warnings) {
    all.push_back({one.code, one.text});
  }
  scan.warnings.clear();
  topography::Topography tilted = rough();
  tilted.periodic = tilted.edges_match = false;
  for (Index x = 0; x < kGrid.nx; ++x) tilted.height.col(x) += 1e-3 * double(x);
  add(cases::of_surface(tilted), all);
  add(topography::apply({"lowpass=hann:1.23456um"}, tilted).warnings, all);
  metrology::PowerSpectra spectra;
  for (auto* fit : {&spectra.x.hurst, &spectra.y.hurst, &spectra.radial.hurst}) {
    *fit = {.hurst = -12.345, .standard_error = 0.1};
  }
  add(cases::of_spectra(spectra), all);
  Contact contact;
  contact.surface = rough(0.4567);
  contact.surface.periodic = contact.surface.edges_match = false;
  contact.state.convergence = {
      .certificate = 1.234e-5, .tolerance = 1e-6, .status = Status::iteration_limit};
  contact.state.convergence.fft_pairs = 1000;
  contact.summary.max_pressure = 1e12;
  contact.summary.n_patches = 44;
  contact.summary.area_correction_valid = false;
  add(cases::of_contact(contact.surface, contact.settings, contact.state, contact.summary), all);
  Contact slow = contact;
  slow.surface.height.setZero(1033, 1031);
  slow.surface.grid.nx = 1031;
  slow.surface.grid.ny = 1033;
  add(cases::of_contact(slow.surface, slow.settings, slow.state, slow.summary), all);
  Contact seam = contact;
  seam.surface.tiles = 2;
  seam.state.pressure.setZero();
  seam.state.pressure.col(0).setConstant(1e6);
  add(cases::of_contact(seam.surface, seam.settings, seam.state, seam.summary), all);
  contact.settings.boundary = cases::Boundary::free;
  contact.state.pressure(0, 0) = 1e12;
  contact.state.convergence.certificate = 1e-7;
  contact.state.gap_error = 1.234e-9;
  contact.state.gap_limit = 1.234e-12;
  add(cases::of_contact(contact.surface, contact.settings, contact.state, contact.summary), all);
  add(cases::of_stiffness(
          {.convergence = {.certificate = 2e-3, .status = Status::iteration_limit}}),
      all);
  topography::Topography filtered = rough();
  filtered.history = {"lowpass=gauss:12.3456um: Sq fell"};
  deposition::Film film{.thickness = Field::Constant(kGrid.ny, kGrid.nx, 1.23456e-5),
                        .mean_film = 1.23456e-5};
  film.flooded = true;
  film.n_droplets = 1234;
  film.dosed_volume = 1.2345 * film.mean_film * filtered.grid.area();
  film.lost_volume = 0.123456 * film.dosed_volume;
  add(cases::of_film(filtered, film), all);
  cases::FrictionSettings settings{.shear_strength = 1e9};
  friction::Contact touching{.mean_pressure = 1e7,
                             .contact_area_fraction = 0.1,
                             .contact_area_fraction_pixels = 0.1234567,
                             .saturation_pressure = 1e8,
                             .lubricated_share = 0.123456 * 5};
  friction::Estimate estimate{.area_fraction = 0.1034567, .friction_dry = 12.3456};
  estimate.corrected_at_bound = true;
  add(cases::of_friction(touching, estimate, 0.123456, settings), all);
  estimate.at_bound = true;
  add(cases::of_friction(touching, estimate, 0.123456, settings), all);
  add(cases::of_film_in_gap(1.2345e-6, 0.98765e-6), all);
  cases::Tool tool;
  tool.rms_height = 1.2345e-3;
  add(cases::of_tool(rough(), tool), all);
  add(cases::of_pixel(1.2345e-6, 0.12345, 6.1725e-7, 0.45678), all);
  add(cases::of_sliding({.distance = 1e-4, .work = 1, .lower = 0.5, .upper = 1.2345, .lost = 1e-6},
                        1e7, 1.2345e-6, 1.2345e-5, false),
      all);
  cases::TrappedRecord trapped;
  trapped.convergence.status = Status::converged;
  trapped.liquid.seal_rounds = 12;
  trapped.liquid.seals_settled = false;
  add(cases::of_trapped(trapped), all);
  trapped.liquid.leaked_fraction = 0.123456;
  trapped.convergence = {.certificate = 1.2345e-5, .tolerance = 1e-6};
  add(cases::of_trapped(trapped), all);
  add(cases::of_mixed_friction({.friction_mixed = 12.3456}), all);
  return all;
}

/// Films that flow or carry load have theirs from the modules that solve them.
TEST(Texts, AreWrittenForEveryCode) {
  std::vector<std::string> codes;
  for (const cases::CodeEntry& entry : cases::all_codes()) {
    if (entry.about < cases::About::flow) codes.emplace_back(entry.code);
  }
  EXPECT_THAT(codes_of(one_of_each()), testing::UnorderedElementsAreArray(codes));
}

/// With the number of cases, but not all of their names: long options instead of placeholders.
TEST(Texts, FitALineAsTheyAre) {
  const auto option = [](const Advice& advice) {
    std::string text = "--" + advice.setting;
    return advice.value.empty() ? text : text + " " + advice.value;
  };
  for (const Warning& warning : one_of_each()) {
    Finding finding{.code = warning.code, .text = warning.text, .cases = {"a"}, .n_cases = 3};
    finding.n_all = 12;
    std::vector<Finding> spelled = {finding};
    spell(option, spelled);
    const std::string line = line_of(spelled[0]);
    EXPECT_LE(line.size(), kLineLimit);
    EXPECT_THAT(line, Not(HasSubstr("..."))) << line.size();
    EXPECT_THAT(line, HasSubstr("(3 of 12 cases"));
  }
}

TEST(Texts, NameSettingsAsAdviceOnlyAndSayTheirFactsWithoutIt) {
  for (const Warning& warning : one_of_each()) {
    EXPECT_THAT(warning.text, Not(HasSubstr("--")));
    EXPECT_THAT(without_advice(warning.text), Not(HasSubstr("<"))) << warning.text;
    EXPECT_GT(without_advice(warning.text).size(), 20u) << warning.text;
  }
}

TEST(Texts, SaySlowSizesOnlyWhereTheyWereSlow) {
  Contact contact;
  contact.surface.height.setZero(1024, 1031);
  contact.surface.grid.nx = 1031;
  contact.surface.grid.ny = 1024;
  contact.state.convergence.fft_pairs = 100;
  EXPECT_THAT(contact.codes(), Not(Contains("slow-size")));
  contact.state.convergence.fft_pairs = 1000;
  EXPECT_THAT(contact.codes(), Contains("slow-size"));
  contact.surface.height.setZero(1024, 1024);
  contact.surface.grid.nx = 1024;
  EXPECT_THAT(contact.codes(), Not(Contains("slow-size")));
}

TEST(Classes, AreDoubtForWhatIsNotInTheList) {
  EXPECT_EQ(cases::class_of("spill-over"), cases::Class::doubt);
  EXPECT_EQ(cases::class_of("despiked"), cases::Class::information);
  EXPECT_EQ(cases::class_of("override"), cases::Class::information);
  EXPECT_EQ(cases::class_of("no-such-code"), cases::Class::doubt);
  EXPECT_STREQ(name_of(cases::Class::doubt), "doubt");
  EXPECT_STREQ(name_of(cases::Class::information), "information");
}

}  // namespace
}  // namespace tabor::results
