// Surfaces asked for by names: every name that is listed is taken by a kind, and nothing else is.
#include "tabor/synthesis/recipes.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tabor/core/error.hpp"

namespace tabor::synthesis::test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string as_it_is(std::string_view name) { return std::string(name); }

/// Of a kind with what it cannot do without.
Request request_of(const std::string& kind) {
  Request request{.kind = kind, .grid = {32, 32, 32e-6, 32e-6}};
  request.stage = EdtStage::after;
  if (kind == "self-affine") request.numbers = {{"rms_height", 1e-7}};
  if (kind == "sinusoid") request.numbers = {{"amplitude", 1e-6}, {"wavelength_x", 8e-6}};
  if (kind == "sphere") request.numbers = {{"radius", 1e-3}};
  if (kind == "bump") request.numbers = {{"height", 1e-6}, {"radius", 1e-5}};
  return request;
}

/// Whether the kind knows the number; its value may be out of range.
bool takes(const std::string& kind, const std::string& name) {
  Request request = request_of(kind);
  request.numbers[name] = 1e-6;
  try {
    generate(request, as_it_is);
  } catch (const UsageError& error) {
    return std::string(error.what()).find("does not belong") == std::string::npos;
  } catch (const InputError&) {
    return true;
  }
  return true;
}

TEST(Recipes, EachKindMakesASurfaceOfItsGrid) {
  for (const std::string& kind : recipe_kinds()) {
    const topography::Topography surface = generate(request_of(kind), as_it_is);
    EXPECT_EQ(surface.height.rows(), 32) << kind;
    EXPECT_TRUE(surface.height.isFinite().all()) << kind;
  }
}

TEST(Recipes, EachNumberIsTakenByTheKindsItNames) {
  for (const RecipeNumber& number : recipe_numbers()) {
    const std::string of = number.help.substr(0, number.help.find(':'));
    for (const std::string& kind : recipe_kinds()) {
      if (number.name == "hurst") continue;  // its help names the exception alone
      EXPECT_EQ(takes(kind, number.name), of.find(kind) != std::string::npos)
          << kind << " " << number.name;
    }
  }
}

TEST(Recipes, ANumberThatDoesNotExistIsRejectedWithTheNearest) {
  Request request = request_of("edt");
  request.numbers["noize"] = 0;
  EXPECT_THAT([&] { generate(request, as_it_is); },
              ThrowsMessage<UsageError>(HasSubstr("did you mean 'noise'")));
}

TEST(Recipes, ANumberIsCalledAsItWasAskedFor) {
  Request request = request_of("bump");
  request.numbers.erase("radius");
  EXPECT_THAT([&] { generate(request, [](auto name) { return "--" + std::string(name); }); },
              ThrowsMessage<UsageError>("generate bump: --radius is missing"));
}

}  // namespace
}  // namespace tabor::synthesis::test
