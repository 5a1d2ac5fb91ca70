// A rough tool: made from a recipe or a scan, placed on the sheet, pressed into it.
#include "tabor/cases/tool.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/small_sheet.hpp"
#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/recipe_text.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::cases {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

const Grid kGrid{64, 48, 64e-6, 48e-6};

topography::Topography wave(const Grid& grid, double amplitude) {
  return synthesis::sinusoid({.grid = grid, .amplitude = amplitude, .wavelength_x = grid.lx});
}

topography::Topography flat(const Grid& grid) {
  topography::Topography surface = wave(grid, 1e-6);
  surface.height.setZero();
  return surface;
}

ToolSettings of_file(const std::filesystem::path& file) {
  ToolSettings settings{.tool = file.string()};
  find_tool(settings, {});
  return settings;
}

TEST(Recipe, HasTheMeanHeightItAsksForAndItsLength) {
  for (const char* text : {"ground:Sa=0.1um,length=100um", "self-affine:Sa=0.1um,length=100um"}) {
    const auto surface = synthesis::generate(synthesis::parse_recipe(text), kGrid);
    EXPECT_EQ(surface.grid.nx, 100) << text;
    EXPECT_EQ(surface.grid.ny, kGrid.ny) << text;
    EXPECT_NEAR((surface.height - surface.height.mean()).abs().mean(), 0.1e-6, 1e-20) << text;
  }
}

TEST(Recipe, TakesTheSettingsOfGenerate) {
  const auto recipe = synthesis::parse_recipe(
      "ground:Sq=0.2um,H=0.5,groove-spacing=10um,groove_length=50um,seed=3");
  const topography::Topography surface = synthesis::generate(recipe, kGrid);
  const topography::Topography same_surface = synthesis::ground({.grid = kGrid,
                                                                 .rms_height = 0.2e-6,
                                                                 .hurst = 0.5,
                                                                 .groove_spacing = 10e-6,
                                                                 .groove_length = 50e-6,
                                                                 .seed = 3});
  EXPECT_TRUE((surface.height == same_surface.height).all());
}

TEST(Recipe, RejectsWhatItDoesNotKnow) {
  const auto message = [](const char* text) {
    return test::rejection([&] { synthesis::parse_recipe(text); });
  };
  EXPECT_THAT(message("grond:Sa=1um"), HasSubstr("ground"));
  EXPECT_THAT(message("ground:Sa"), HasSubstr("Sa=0.1um"));
  EXPECT_THAT(message("ground:Sa=0.1"), HasSubstr("unit"));
  EXPECT_THAT(message("ground:Sa=-1um"), HasSubstr("more than zero"));
  EXPECT_THAT(message("ground:Sa=1um,Sa=2um"), HasSubstr("two values"));
  EXPECT_THAT(message("ground:Sa=1um,Sq=1um"), HasSubstr("one of them"));
  EXPECT_THAT(message("ground:hurts=0.5"), HasSubstr("hurst"));
  EXPECT_THAT(message("ground:seed=1.5"), HasSubstr("whole number"));
}

TEST(Tool, StandsOnTheSheetAndRepeatsAlongX) {
  Tool tool;
  tool.grid = {4, 2, 4e-6, 2e-6};
  tool.height.resize(2, 4);
  tool.height << 0, 1, 2, 3, 10, 11, 12, 13;
  const Grid sheet{6, 2, 6e-6, 2e-6};
  Field at_place(2, 6);
  at_place << 3, 0, 1, 2, 3, 0, 13, 10, 11, 12, 13, 10;
  EXPECT_TRUE((height_at(tool, 1, sheet) == at_place).all());
  EXPECT_TRUE((height_at(tool, 5, sheet) == at_place).all());
  EXPECT_TRUE((height_at(tool, -3, sheet) == at_place).all());
  const ToolSettings two{.tool = "ground", .tool_x = 1e-6, .tool_places = 2};
  EXPECT_THAT(places_of(two, tool), testing::ElementsAre(1, 3));
}

TEST(Tool, OfAScanHasNoMeanAndCoversPixelsOfTheSheet) {
  const test::Folder folder;
  const auto file = folder / "fine.h5";
  topography::Topography fine = wave({128, 96, 64e-6, 48e-6}, 1e-6);
  fine.height += 5e-6;
  scan::write(fine, file);
  const Tool tool = make_tool(of_file(file), kGrid);
  EXPECT_EQ(tool.height.cols(), 64);
  EXPECT_EQ(tool.height.rows(), 48);
  EXPECT_NEAR(tool.height.mean(), 0, 1e-20);
  EXPECT_NEAR(tool.height(0, 0), 0.5 * (fine.height(0, 0) + fine.height(0, 1)) - 5e-6, 1e-12);
}

TEST(Tool, ThatDoesNotFitIsRejected) {
  const test::Folder folder;
  const auto message = [&](const topography::Topography& tool) {
    const auto file = folder / "tool.h5";
    scan::write(tool, file);
    return test::rejection([&] { make_tool(of_file(file), kGrid); });
  };
  EXPECT_THAT(message(wave({64, 48, 96e-6, 72e-6}, 1e-6)), HasSubstr("--resample"));
  EXPECT_THAT(message(wave({64, 40, 64e-6, 40e-6}, 1e-6)), HasSubstr("40 rows"));
  EXPECT_THAT(message(wave({32, 48, 32e-6, 48e-6}, 1e-6)), HasSubstr("<tool_repeats>"));
  topography::Topography holed = wave(kGrid, 1e-6);
  holed.height(3, 4) = std::nan("");
  EXPECT_THAT(message(holed), HasSubstr("fill"));
}

TEST(Tool, SettingsWithoutAToolAreRejected) {
  for (const ToolSettings& idle :
       {ToolSettings{.tool_x = 0.0}, ToolSettings{.tool_places = 3},
        ToolSettings{.tool_lowpass = "gauss:8um"}, ToolSettings{.tool_repeats = true}}) {
    EXPECT_TRUE(objection(idle, test::own_name));
  }
  EXPECT_FALSE(objection(ToolSettings{}, test::own_name));
  EXPECT_TRUE(objection(ToolSettings{.tool = "ground", .tool_places = 0}, test::own_name));
  EXPECT_TRUE(objection(ToolSettings{.tool = ""}, test::own_name));
  EXPECT_TRUE(objection(ToolSettings{.tool = "ground", .tool_lowpass = "gauss"}, test::own_name));
  EXPECT_FALSE(objection(ToolSettings{.tool = "ground", .tool_x = 0.0}, test::own_name));
}

TEST(ToolContact, IsThatOfTheSumUnderAFlat) {
  ContactSettings settings = test::aluminium();
  const auto surface = test::small_sheet();
  settings.tool = {.tool = "ground:Sa=0.1um", .tool_x = 7e-6};
  const ContactRecord rough = contact_state(surface, settings, contact::MeanPressure{7e6});
  const Tool tool = make_tool(settings.tool, kGrid);
  topography::Topography sum = surface;
  sum.height += height_at(tool, 7, kGrid);
  const ContactRecord flat_one = contact_state(sum, test::aluminium(), contact::MeanPressure{7e6});
  EXPECT_TRUE((rough.state.pressure == flat_one.state.pressure).all());
  EXPECT_TRUE((rough.state.gap == flat_one.state.gap).all());
  EXPECT_DOUBLE_EQ(rough.tool_place->x, 7e-6);
  EXPECT_FALSE(flat_one.tool_place.has_value());
}

/// Contact share of a wave under a flat: (2/pi) asin sqrt(P/p*) (Johnson 1985, section 13.2).
TEST(ToolContact, OfAWavyToolOnAFlatSheetIsWestergaards) {
  const test::Folder folder;
  const Grid grid{256, 8, 256e-6, 8e-6};
  const double amplitude = 1e-6;
  scan::write(wave(grid, amplitude), folder / "wave.h5");
  ContactSettings settings{.youngs_modulus = 70e9, .poissons_ratio = 0.33};
  settings.tool = of_file(folder / "wave.h5");
  const double full = std::numbers::pi * settings.effective_modulus() * amplitude / grid.lx;
  const ContactRecord record =
      contact_state(flat(grid), settings, contact::MeanPressure{0.3 * full});
  const double share = 2 / std::numbers::pi * std::asin(std::sqrt(0.3));
  EXPECT_NEAR(record.summary.contact_area_fraction_pixels, share, 2.0 / 256);
}

TEST(ToolContact, FollowsTheToolAndTheSheetTogether) {
  ContactSettings settings = test::aluminium();
  topography::Topography surface = test::small_sheet();
  settings.tool = {.tool = "self-affine:Sa=0.1um"};
  const auto first = contact_state(surface, settings, contact::MeanPressure{7e6});
  topography::Topography shifted = surface;
  for (Index x = 0; x < kGrid.nx; ++x) {
    shifted.height.col((x + 5) % kGrid.nx) = surface.height.col(x);
  }
  settings.tool.tool_x = 5e-6;
  const auto second = contact_state(shifted, settings, contact::MeanPressure{7e6});
  EXPECT_DOUBLE_EQ(second.summary.contact_area_fraction_pixels,
                   first.summary.contact_area_fraction_pixels);
  EXPECT_NEAR(second.summary.mean_gap, first.summary.mean_gap, 1e-6 * first.summary.mean_gap);
}

TEST(ToolContact, ReachesIntoPocketsThatAFlatSpares) {
  ContactSettings settings = test::aluminium();
  const auto surface = test::small_sheet();
  const auto smooth = contact_state(surface, settings, contact::MeanPressure{7e6});
  settings.tool = {.tool = "ground:Sa=0.3um,groove-length=20um"};
  const auto rough = contact_state(surface, settings, contact::MeanPressure{7e6});
  const Mask new_contact =
      contact::contact_mask(rough.state) && !contact::contact_mask(smooth.state);
  EXPECT_GT(new_contact.count(), 0);
  EXPECT_GT(rough.summary.mean_gap, smooth.summary.mean_gap);
}

TEST(ToolContact, WarnsOfAToolRougherThanTheSheet) {
  ContactSettings settings = test::aluminium();
  settings.tool = {.tool = "ground:Sa=2um"};
  const auto record = contact_state(test::small_sheet(), settings, contact::MeanPressure{7e6});
  EXPECT_THAT(codes_of(record.warnings), testing::Contains("rough-tool"));
}

TEST(ToolContact, AlongALoadPathKeepsTheSumThatEarlierContactsLeft) {
  ContactSettings settings = test::aluminium();
  settings.tool = {.tool = "ground:Sa=0.1um"};
  settings.load_path = true;
  std::vector<double> plastic;
  std::vector<contact::Control> controls{contact::MeanPressure{7e6}, contact::MeanPressure{5e6}};
  const auto surface = test::small_sheet();
  const auto receive = [&](ContactRecord&& record) {
    plastic.push_back((-record.state.gap).max(0.0).sum());
  };
  contact_states(*make_operator(settings, kGrid), surface, settings, controls, receive);
  ASSERT_THAT(plastic, SizeIs(2));
  EXPECT_GT(plastic[0], 0);
  EXPECT_LT(plastic[1], 1e-3 * plastic[0]);  // unloading is elastic
}

TEST(ToolFriction, IsTheMeanOverThePlaces) {
  FrictionRecord one;
  one.friction_dry = 0.2;
  one.friction_lubricated = 0.1;
  one.friction_area_fraction = 0.02;
  one.converged = true;
  one.warnings = {{"clamp", "a"}};
  FrictionRecord two = one;
  two.friction_dry = 0.4;
  two.converged = false;
  two.warnings = {{"spill-over", "b"}};
  const FrictionRecord mean = mean_over_places({one, two});
  EXPECT_DOUBLE_EQ(mean.friction_dry, 0.3);
  EXPECT_DOUBLE_EQ(mean.tool->spread->friction_dry, std::sqrt(0.02));
  EXPECT_DOUBLE_EQ(mean.tool->spread->friction_lubricated, 0);
  EXPECT_EQ(mean.tool->n_places, 2U);
  EXPECT_FALSE(mean.converged);
  EXPECT_THAT(codes_of(mean.warnings), testing::UnorderedElementsAre("clamp", "spill-over"));
  EXPECT_THROW(mean_over_places({}), InputError);
}

TEST(ToolFriction, StatesAFilmThatExceedsTheGap) {
  EXPECT_THAT(codes_of(of_film_in_gap(2e-6, 1e-6)), testing::ElementsAre("flooded"));
  EXPECT_TRUE(of_film_in_gap(1e-6, 2e-6).empty());
}

}  // namespace
}  // namespace tabor::cases
