// Surfaces asked for by names: every setting that is listed is taken by a kind, and nothing else
// is.
#include "tabor/synthesis/recipes.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/synthesis/recipe_parameters.hpp"

namespace tabor::synthesis::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

std::string as_option(std::string_view name) { return "--" + std::string(name); }

/// Of a kind with what it cannot do without.
Request request_of(const std::string& kind) {
  Request request{.kind = kind, .grid = {32, 32, 32e-6, 32e-6}};
  if (kind == "edt") request.settings = {{"stage", std::string("after")}};
  if (kind == "self-affine") request.settings = {{"rms_height", 1e-7}};
  if (kind == "sinusoid") request.settings = {{"amplitude", 1e-6}, {"wavelength_x", 8e-6}};
  if (kind == "sphere") request.settings = {{"radius", 1e-3}};
  if (kind == "bump") request.settings = {{"height", 1e-6}, {"radius", 1e-5}};
  return request;
}

Request with(Request request, const std::string& name, Cell value) {
  request.settings[name] = std::move(value);
  return request;
}

/// A value of the kind of a setting, which may be out of range.
Cell some_value(const RecipeSetting& setting) {
  if (setting.kind == ValueKind::flag) return true;
  return setting.kind == ValueKind::word ? Cell(setting.words.back()) : Cell(1e-6);
}

/// What is said against a request; "" where a surface is made.
std::string complaint(const Request& request) {
  try {
    generate(request, as_option);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

const RecipeSetting& setting_of(const std::string& name) {
  const auto& all = recipe_settings();
  return *std::find_if(all.begin(), all.end(),
                       [&](const RecipeSetting& one) { return one.name == name; });
}

TEST(Recipes, EachKindMakesASurfaceOfItsGrid) {
  for (const std::string& kind : recipe_kinds()) {
    const topography::Topography surface = generate(request_of(kind), as_named);
    EXPECT_EQ(surface.height.rows(), 32) << kind;
    EXPECT_TRUE(surface.height.isFinite().all()) << kind;
  }
}

TEST(Recipes, EachSettingIsTakenByTheKindsItNames) {
  for (const RecipeSetting& setting : recipe_settings()) {
    const std::set<std::string> kinds(setting.kinds.begin(), setting.kinds.end());
    for (const std::string& kind : recipe_kinds()) {
      const bool is_named = std::any_of(kinds.begin(), kinds.end(), [&](const std::string& one) {
        return one.substr(0, one.find(',')) == kind;
      });
      const std::string said = complaint(with(request_of(kind), setting.name, some_value(setting)));
      EXPECT_EQ(said.find("does not belong") == std::string::npos, is_named)
          << kind << " " << setting.name;
    }
  }
}

TEST(Recipes, EachSettingIsDescribedWithTheKindsThatTakeItAndItsDefaults) {
  EXPECT_EQ(setting_of("hurst").help, "Hurst exponent");
  EXPECT_THAT(setting_of("hurst").defaults,
              ElementsAre(std::pair("self-affine", "0.8"), std::pair("edt", "0.75"),
                          std::pair("ground", "0.7")));
  EXPECT_EQ(setting_of("rms_height").help, "self-affine, ground: rms height");
  EXPECT_EQ(setting_of("pressure").help, "edt, stage after: mean pressure of the sliding");
  EXPECT_EQ(setting_of("radius").help, "sphere, bump: radius");
}

template <typename Recipe>
class RecipeTables : public testing::Test {};
using AllRecipes = testing::Types<SelfAffine, Edt, Ground, Sinusoid, Sphere, Bump>;
TYPED_TEST_SUITE(RecipeTables, AllRecipes);

TYPED_TEST(RecipeTables, HaveDefaultsThatTheirExamplesSayAndThatLieWithinBounds) {
  for (const RecipeParameter<TypeParam>& one : recipe_table<TypeParam>().parameters) {
    SCOPED_TRACE(one.name);
    EXPECT_FALSE(one.help.empty());
    EXPECT_EQ(one.has_default(), !one.example.empty());
    const auto numbers = one.numbers(TypeParam{});
    if (numbers.empty() || one.needed == Needed::yes) continue;
    EXPECT_TRUE(one.bounds.contain(numbers.front()));
    if (one.example.empty()) continue;
    EXPECT_DOUBLE_EQ(numbers.front(), parse_si(one.example, one.dimension, one.name));
  }
}

TYPED_TEST(RecipeTables, AreWhatDescribesASurfaceOneByOne) {
  TypeParam recipe;
  recipe.grid = {8, 8, 8e-6, 8e-6};
  const std::string text = describe(recipe);
  EXPECT_THAT(text, StartsWith("generate " + recipe_table<TypeParam>().kind + ": "));
  for (const RecipeParameter<TypeParam>& one : recipe_table<TypeParam>().parameters) {
    EXPECT_THAT(text, HasSubstr(one.phrase(recipe))) << one.name;
  }
}

TEST(Recipes, SayInWordsWhatWasGenerated) {
  EXPECT_EQ(describe(Edt{}),
            "generate edt: before sliding, Sa before sliding 900 nm, H = 0.75, waviness 600 nm, "
            "plateaus 50 % with 50 nm, noise 40 nm, periodic, seed 1");
  EXPECT_THAT(describe(Edt{.stage = EdtStage::after}),
              HasSubstr("edt: after sliding under 7 MPa with 0.45 g/m^2, Sa"));
  EXPECT_EQ(describe(Ground{}),
            "generate ground: Sq = 300 nm, H = 0.7, groove spacing 20 µm, length 400 µm, seed 1");
  SelfAffine rough;
  rough.rms_slope = 0.1;
  rough.short_cutoff_wavelength = 4e-6;
  EXPECT_EQ(describe(rough),
            "generate self-affine: H = 0.8, rms slope = 0.1, roll-off none, long cutoff none, "
            "short cutoff 4 µm, stretch 1, random phases, seed 1");
  EXPECT_EQ(describe(Sinusoid{.grid = {}, .wavelength_y = 8e-6}),
            "generate sinusoid: amplitude 1 µm, wavelengths none along x and 8 µm along y");
  EXPECT_EQ(describe(Bump{}), "generate bump: height 1 µm, radius 10 µm");
}

TEST(Recipes, ASettingThatDoesNotExistIsRejectedWithTheNearest) {
  EXPECT_THAT([&] { generate(with(request_of("edt"), "noize", 0.0), as_named); },
              ThrowsMessage<UsageError>(HasSubstr("did you mean 'noise'")));
}

TEST(Recipes, ASettingIsCalledAsItWasAskedFor) {
  Request request = request_of("bump");
  request.settings.erase("radius");
  EXPECT_THAT([&] { generate(request, as_option); },
              ThrowsMessage<UsageError>("generate bump: --radius is missing"));
  EXPECT_THAT([&] { generate(with(request_of("edt"), "hurst", 2.0), as_option); },
              ThrowsMessage<InputError>("--hurst: got 2; expected above 0 and at most 1"));
  EXPECT_THAT([&] { generate(with(request_of("edt"), "stage", std::string("afer")), as_option); },
              ThrowsMessage<InputError>(
                  "--stage: got 'afer'; expected before or after; did you mean 'after'?"));
}

TEST(Recipes, SettingsThatDoNotGoTogetherAreUsage) {
  Request before = with(request_of("edt"), "pressure", 7e6);
  before.settings["stage"] = std::string("before");
  EXPECT_THAT([&] { generate(before, as_option); },
              ThrowsMessage<UsageError>("generate edt: --pressure belongs to --stage after"));
  EXPECT_THAT(
      [&] { generate(with(request_of("self-affine"), "rms_slope", 0.1), as_option); },
      ThrowsMessage<UsageError>("generate self-affine: give either --rms_height or --rms_slope"));
  Request flat = request_of("sinusoid");
  flat.settings.erase("wavelength_x");
  EXPECT_THAT(
      [&] { generate(flat, as_option); },
      ThrowsMessage<UsageError>("generate sinusoid: give --wavelength_x, --wavelength_y or both"));
}

TEST(PixelSettings, MakeAGrid) {
  const Grid square = grid_of({}, as_named);
  EXPECT_EQ(square.nx, 512);
  EXPECT_EQ(square.ny, 512);
  EXPECT_DOUBLE_EQ(square.ly, 512 * 0.67e-6);
  const Grid grid = grid_of({.pixels = {4, 3}, .pixel = {1e-6, 2e-6}}, as_named);
  EXPECT_EQ(grid.nx, 4);
  EXPECT_EQ(grid.ny, 3);
  EXPECT_DOUBLE_EQ(grid.lx, 4e-6);
  EXPECT_DOUBLE_EQ(grid.ly, 6e-6);
}

TEST(PixelSettings, ThatAreNoneAreRejected) {
  for (const double count : {0.0, 2.5, 2e6}) {
    EXPECT_THAT(
        [&] {
          grid_of({.pixels = {8, count}}, as_option);
        },
        ThrowsMessage<InputError>(StartsWith("--pixels: got ")))
        << count;
  }
  EXPECT_THAT([] { grid_of({.pixel = {0}}, as_option); },
              ThrowsMessage<InputError>("--pixel: got 0 m; expected more than zero"));
  EXPECT_THROW(grid_of({.pixel = {1, 2, 3}}, as_option), UsageError);
  EXPECT_THROW(grid_of({.pixels = {}}, as_option), UsageError);
}

}  // namespace
}  // namespace tabor::synthesis::test
