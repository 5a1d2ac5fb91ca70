#include "tabor/cases/warnings.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "results/sound_contact.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::results {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

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
  surface = topography::apply({"lowpass=gauss:1nm"}, rough());  // changes almost nothing
  EXPECT_THAT(codes_of(cases::of_film(surface, films(dose)[0])), Not(Contains("filtered")));
  surface = topography::apply({"highpass=hann:2/L"}, rough());
  EXPECT_THAT(codes_of(cases::of_film(surface, films(dose)[0])), Not(Contains("filtered")));
}

TEST(WarningsOfFilm, TellOfADoseThatTheLastDropletExceeds) {
  const topography::Topography surface = rough();
  deposition::Film film{.thickness = Field::Zero(kGrid.ny, kGrid.nx), .mean_film = 3e-7};
  film.dosed_volume = 1.019 * 3e-7 * surface.grid.area();
  EXPECT_THAT(codes_of(cases::of_film(surface, film)), Not(Contains("overdosed")));
  film.dosed_volume = 1.25 * 3e-7 * surface.grid.area();
  const Warnings found = cases::of_film(surface, film);
  ASSERT_EQ(codes_of(found), std::vector<std::string>{"overdosed"});
  EXPECT_NEAR(found[0].weight, 0.25, 1e-12);
  EXPECT_THAT(found[0].text, HasSubstr("25 % larger than asked"));
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

}  // namespace
}  // namespace tabor::results
