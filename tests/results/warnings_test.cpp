#include "tabor/cases/warnings.hpp"
#include "tabor/core/random.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tabor/cases/slide/slide.hpp"
#include "tabor/results/explanations.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::results {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const Grid kGrid{64, 48, 64e-6, 48e-6};

topography::Topography rough(double rms_slope = 0.1) {
  synthesis::SelfAffine recipe;
  recipe.grid = kGrid;
  recipe.rms_slope = rms_slope;
  return synthesis::self_affine(recipe);
}

/// A contact that nothing is to be said about: a disc in the middle.
struct Contact {
  Contact() {
    state.pressure = Field::Zero(kGrid.ny, kGrid.nx);
    state.pressure.block(20, 28, 8, 8) = 1e9;
    state.convergence = {.certificate = 1e-7, .tolerance = 1e-6, .status = Status::converged};
    summary.contact_area_fraction_pixels = 64.0 / static_cast<double>(kGrid.size());
    summary.max_pressure = 1e9;
    summary.n_patches = 1;
  }
  std::vector<std::string> codes() const {
    return codes_of(cases::of_contact(surface, settings, state, summary));
  }
  topography::Topography surface = rough();
  cases::ContactSettings settings{.youngs_modulus = 1e11};
  contact::State state;
  contact::Summary summary;
};

TEST(WarningsOfContact, AreNoneOfASoundOne) { EXPECT_THAT(Contact().codes(), testing::IsEmpty()); }

TEST(WarningsOfContact, EdgesThatDoNotMatchArePeriodicOnlyByAssumption) {
  Contact cut_out;
  cut_out.surface.periodic = false;
  EXPECT_THAT(cut_out.codes(), Contains("not-periodic"));
  cut_out.settings.boundary = cases::Boundary::free;
  EXPECT_THAT(cut_out.codes(), Not(Contains("not-periodic")));
}

TEST(WarningsOfContact, TheEdgesOfAFreePatchMayCarryATenthOfTheLoad) {
  Contact free;
  free.settings.boundary = cases::Boundary::free;
  const double inside = free.state.pressure.sum();
  free.state.pressure(0, 0) = 0.10 * inside;
  EXPECT_THAT(free.codes(), Not(Contains("edge-load")));
  for (const auto& [row, column] : {std::pair{0, 0}, {47, 63}, {20, 0}, {0, 30}, {47, 30}}) {
    Contact loaded = free;
    loaded.state.pressure(0, 0) = 0;
    loaded.state.pressure(row, column) = 0.12 * inside;
    EXPECT_THAT(loaded.codes(), Contains("edge-load")) << row << ' ' << column;
    loaded.settings.boundary = cases::Boundary::periodic;
    EXPECT_THAT(loaded.codes(), Not(Contains("edge-load")));
  }
}

TEST(WarningsOfContact, EdgesAreLookedAtUnlessTheUserSaysWhatIsThere) {
  Contact one;
  one.surface.periodic = false;
  EXPECT_THAT(one.codes(), Contains("not-periodic"));  // nobody has looked
  topography::look_at_edges(one.surface);
  EXPECT_THAT(one.codes(), Not(Contains("not-periodic")));
  one.surface = topography::apply({"crop=3,5,40,30"}, one.surface);
  EXPECT_THAT(one.codes(), Contains("not-periodic"));
  one.surface = topography::apply({"edges=tile"}, one.surface);
  EXPECT_THAT(one.codes(), Not(Contains("not-periodic")));
}

/// Of 64 x 48 pixels that are 2 x 2 images of 32 x 24: 5 % of a side are 1.6 and 1.2 pixels.
TEST(WarningsOfContact, TheSeamsOfAMirroredSurfaceMayCarryHalfTheLoad) {
  Contact mirrored;
  mirrored.surface.tiles = 2;
  const double inside = mirrored.state.pressure.block(25, 33, 3, 3).sum();
  mirrored.state.pressure.setZero();
  mirrored.state.pressure.block(28, 40, 3, 3) = 1e9;
  EXPECT_THAT(mirrored.codes(), testing::IsEmpty());
  for (const auto& [row, column] :
       {std::pair{0, 10}, {47, 10}, {23, 10}, {24, 10}, {10, 0}, {10, 63}, {10, 31}, {10, 32}}) {
    Contact loaded = mirrored;
    loaded.state.pressure(row, column) = 0.9 * inside;
    EXPECT_THAT(loaded.codes(), Not(Contains("seam-load")));
    loaded.state.pressure(row, column) = 1.1 * inside;
    EXPECT_THAT(loaded.codes(), Contains("seam-load")) << row << ' ' << column;
    loaded.surface.tiles = 1;
    EXPECT_THAT(loaded.codes(), Not(Contains("seam-load")));
  }
  mirrored.state.pressure(10, 4) = 9 * inside;  // far from any
  EXPECT_THAT(mirrored.codes(), Not(Contains("seam-load")));
}

TEST(WarningsOfContact, AnAreaAtItsBoundSaysNothingOfTheSurface) {
  Contact capped;
  capped.settings.saturation_pressure = 2e9;
  capped.summary.mean_pressure = 2e7;
  capped.summary.contact_area_fraction = 0.0101;
  EXPECT_THAT(capped.codes(), testing::IsEmpty());
  capped.summary.contact_area_fraction = 2e7 / 2e9;
  const Warnings found =
      cases::of_contact(capped.surface, capped.settings, capped.state, capped.summary);
  ASSERT_THAT(codes_of(found), testing::ElementsAre("clamp"));
  EXPECT_THAT(found[0].text, HasSubstr("P/p_sat, 1 %, for any surface"));
  capped.settings.saturation_pressure.reset();
  EXPECT_THAT(capped.codes(), testing::IsEmpty());
}

TEST(WarningsOfContact, SlopesAboveThirdsAreSteep) {
  Contact steep;
  steep.surface = rough(0.28);
  EXPECT_THAT(steep.codes(), Not(Contains("steep")));
  steep.surface.height *= 1.2;
  EXPECT_THAT(steep.codes(), Contains("steep"));
}

TEST(WarningsOfContact, OnlyElasticOnesCanBeAboveAnyHardness) {
  Contact hard;
  hard.summary.max_pressure = 0.09 * hard.settings.effective_modulus();
  EXPECT_THAT(hard.codes(), Not(Contains("above-hardness")));
  hard.summary.max_pressure = 0.11 * hard.settings.effective_modulus();
  EXPECT_THAT(hard.codes(), Contains("above-hardness"));
  hard.settings.saturation_pressure = hard.summary.max_pressure;
  EXPECT_THAT(hard.codes(), Not(Contains("above-hardness")));
}

TEST(WarningsOfContact, PatchesOfFewPixelsDependOnTheResolution) {
  Contact fine;
  fine.summary.n_patches = 6;  // of 64 pixels
  EXPECT_THAT(fine.codes(), Not(Contains("resolution")));
  fine.summary.n_patches = 7;
  EXPECT_THAT(fine.codes(), Contains("resolution"));
  fine.summary.n_patches = 0;
  EXPECT_THAT(fine.codes(), Not(Contains("resolution")));
}

TEST(WarningsOfContact, TellWhatDidNotConvergeAndWhereTheAreaIsNotCorrected) {
  Contact loose;
  loose.state.convergence.status = Status::stalled;
  loose.summary.area_correction_valid = false;
  EXPECT_THAT(loose.codes(), testing::ElementsAre("not-converged", "area-correction"));
}

TEST(WarningsOfSurface, ATiltIsToldOnceAndNotAfterLevelling) {
  topography::Topography tilted = rough();
  tilted.periodic = false;
  for (Index x = 0; x < kGrid.nx; ++x) tilted.height.col(x) += 1e-6 * static_cast<double>(x);
  tilted.warnings = {{.code = "tilt", .text = "tilt is larger than roughness"}};
  EXPECT_THAT(codes_of(cases::of_surface(tilted)), testing::ElementsAre("not-levelled"));
  for (const char* step : {"level=plane", "level=poly2", "highpass=gauss:20um"}) {
    const auto level = topography::apply({step}, tilted);
    EXPECT_FALSE(cases::not_levelled(level)) << step;
  }
  topography::Topography level = topography::apply({"level=plane"}, tilted);
  level.history.clear();  // by the instrument, say
  EXPECT_FALSE(cases::not_levelled(level));
  for (const char* step : {"level=none", "level=mean", "lowpass=gauss:4um"}) {
    EXPECT_TRUE(cases::not_levelled(topography::apply({step}, tilted))) << step;
  }
}

TEST(WarningsOfSurface, HolesThatWereFilledStay) {
  topography::Topography holed = rough();
  holed.height.leftCols(58) = std::numeric_limits<double>::quiet_NaN();
  const auto filled = topography::apply({"fill=harmonic", "level=plane"}, holed);
  const Warnings list = cases::of_surface(filled);
  ASSERT_THAT(codes_of(list), Contains("filled-holes"));
  EXPECT_THAT(list.front().text, testing::AllOf(HasSubstr("Most of the area"), HasSubstr("holes")));
}

std::vector<deposition::Film> films(const deposition::Dose& dose) {
  return deposition::deposit(rough().height, kGrid, dose);
}

TEST(WarningsOfFilm, AFilmOverTheHighestPointFloodsWhateverItsModel) {
  using deposition::Model;
  for (const Model model : {Model::droplets, Model::limit, Model::bottom_fill, Model::uniform}) {
    deposition::Dose dose;
    dose.model = model;
    dose.mean_films = {1e-4};
    const Warnings list = cases::of_film(rough(), films(dose)[0]);
    EXPECT_THAT(codes_of(list), Contains("flood")) << name(model);
    EXPECT_THAT(list[0].text, HasSubstr("flood"));
    dose.mean_films = {model == Model::uniform ? 0 : 1e-8};
    EXPECT_THAT(codes_of(cases::of_film(rough(), films(dose)[0])), Not(Contains("flood")))
        << name(model);
  }
}

TEST(WarningsOfFilm, TellOfFewDropletsAndOfOilThatRanOff) {
  deposition::Dose dose;
  dose.mean_films = {1e-7};
  EXPECT_THAT(codes_of(cases::of_film(rough(), films(dose)[0])), Not(Contains("few-droplets")));
  dose.droplet_height = 2e-7;
  EXPECT_THAT(codes_of(cases::of_film(rough(), films(dose)[0])), Contains("few-droplets"));
  dose.mean_films = {3e-7};
  EXPECT_THAT(codes_of(cases::of_film(rough(), films(dose)[0])), testing::IsEmpty());
  dose.edge = deposition::Edge::open;
  EXPECT_THAT(codes_of(cases::of_film(rough(), films(dose)[0])), Contains("oil-lost"));
}

TEST(WarningsOfFilm, TellOfPocketsThatAFilterTookUnlessThereIsNoOil) {
  topography::Topography surface = rough();
  deposition::Dose dose;
  dose.mean_films = {3e-7, 0};
  EXPECT_THAT(codes_of(cases::of_film(surface, films(dose)[0])), Not(Contains("filtered")));
  surface = topography::apply({"lowpass=hann:8/L"}, surface);
  const Warnings found = cases::of_film(surface, films(dose)[0]);
  ASSERT_THAT(codes_of(found), Contains("filtered"));
  EXPECT_THAT(found[0].text, HasSubstr("lowpass=hann:8/L"));
  EXPECT_THAT(codes_of(cases::of_film(surface, films(dose)[1])), Not(Contains("filtered")));
  surface = topography::apply({"highpass=hann:2/L"}, rough());
  EXPECT_THAT(codes_of(cases::of_film(surface, films(dose)[0])), Not(Contains("filtered")));
}

TEST(WarningsOfFilm, TellTheShareOfTheOilThatRanOff) {
  deposition::Film film;
  film.thickness = Field::Zero(2, 2);
  film.dosed_volume = 8e-12;
  film.lost_volume = 2e-12;
  const Warnings found = cases::of_film(rough(), film);
  ASSERT_EQ(codes_of(found), std::vector<std::string>{"oil-lost"});
  EXPECT_THAT(found[0].text, HasSubstr("25 % of the liquid ran off"));
}

/// Codes of a contact under 10 MPa with a shear strength of 70 MPa.
std::vector<std::string> friction_codes(const friction::Contact& contact, double spill = 0,
                                        friction::Area area = friction::Area::corrected,
                                        double shear_strength = 7e7) {
  return codes_of(cases::of_friction(contact, friction::estimate(contact, shear_strength, area),
                                     spill, {.shear_strength = shear_strength, .area = area}));
}

TEST(WarningsOfFriction, HaveTheirThresholds) {
  const friction::Contact contact{1e7, 0.1, 0.12, 2.4e8, 0.5};
  EXPECT_THAT(friction_codes(contact, 0.05), testing::IsEmpty());
  EXPECT_THAT(friction_codes(contact, 0.051), testing::ElementsAre("spill-over"));
  friction::Contact wet = contact;
  wet.lubricated_share = 0.51;
  EXPECT_THAT(friction_codes(wet), testing::ElementsAre("frictionless"));
  EXPECT_THAT(friction_codes(contact, 0, friction::Area::corrected, 1.99e8), testing::IsEmpty());
  EXPECT_THAT(friction_codes(contact, 0, friction::Area::corrected, 2.01e8),
              testing::ElementsAre("implausible-friction"));
}

TEST(WarningsOfFriction, AnAreaAtItsBoundIsAClamp) {
  const double pressure = 1e7, cap = 2.4e8;
  for (const double area : {0.0, 0.04, pressure / cap, pressure / cap * (1 + 1e-9), 0.05}) {
    const friction::Contact contact{pressure, area, 0.05, cap, 0};
    const bool at_bound = area <= pressure / cap;
    EXPECT_EQ(friction::estimate(contact, 7e7).at_bound, at_bound) << area;
    EXPECT_THAT(friction_codes(contact), Contains("clamp").Times(at_bound ? 1 : 0)) << area;
    const friction::Estimate counted = friction::estimate(contact, 7e7, friction::Area::pixels);
    EXPECT_FALSE(counted.at_bound);
    EXPECT_EQ(counted.corrected_at_bound, at_bound);
    EXPECT_DOUBLE_EQ(counted.friction_dry, 0.05 * 7e7 / pressure);
    EXPECT_THAT(friction_codes(contact, 0, friction::Area::pixels),
                Contains("clamp").Times(at_bound ? 1 : 0));
    friction::Contact elastic = contact;
    elastic.saturation_pressure = contact::kNoSaturation;
    EXPECT_THAT(friction_codes(elastic), testing::IsEmpty());
  }
}

TEST(WarningsOfSpectra, NameExponentsThatNoSelfAffineSurfaceHas) {
  metrology::PowerSpectra spectra;
  spectra.x.hurst = {.hurst = 1.05, .standard_error = 0.1};
  spectra.y.hurst = {.hurst = std::nan("")};
  spectra.radial.hurst = {.hurst = 0, .standard_error = 0.1};
  EXPECT_THAT(cases::of_spectra(spectra), testing::IsEmpty());
  spectra.x.hurst.hurst = 1.2;
  spectra.radial.hurst.hurst = -0.3;
  const Warnings found = cases::of_spectra(spectra);
  ASSERT_THAT(codes_of(found), testing::ElementsAre("hurst"));
  EXPECT_NEAR(found[0].weight, 0.3, 1e-12);
  EXPECT_THAT(found[0].text, HasSubstr("(C1D x 1.2, C2D -0.3)"));
}

TEST(WarningsOfStiffness, SayHowFarItIsFromItsTolerance) {
  contact::Stiffness stiffness{
      .value = 1e12,
      .convergence = {.certificate = 1e-9, .tolerance = 1e-8, .status = Status::converged}};
  EXPECT_THAT(cases::of_stiffness(stiffness), testing::IsEmpty());
  stiffness.convergence = {
      .certificate = 2e-3, .tolerance = 1e-8, .status = Status::iteration_limit};
  const Warnings found = cases::of_stiffness(stiffness);
  ASSERT_THAT(codes_of(found), testing::ElementsAre("stiffness"));
  EXPECT_THAT(found[0].text, HasSubstr("NOT CONVERGED (residual 2.0e-03)"));
}

TEST(WarningsOfFlow, LookAtTheMixedFriction) {
  EXPECT_THAT(codes_of(cases::of_mixed_friction({.friction_mixed = 2.1})),
              testing::ElementsAre("implausible-friction"));
  EXPECT_THAT(cases::of_mixed_friction({.friction_mixed = 1.9}), testing::IsEmpty());
}

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
  film.lost_volume = 0.123456;
  film.dosed_volume = 1;
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
