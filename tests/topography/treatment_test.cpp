#include "tabor/topography/treatment.hpp"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/recipes.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

const Grid kGrid{40, 30, 40e-6, 30e-6};

std::string message_of(const Treatment& treatment) {
  try {
    check(treatment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Treatment, AppliesItsStepsInOrderAndRemembersThem) {
  auto rough = noise(kGrid);
  rough.height.block(3, 3, 4, 4) = kHole;
  const auto treated = apply(
      {"level=plane", "fill=harmonic", "lowpass=gauss:3um", "crop=5,5,20,20", "flip=x"}, rough);
  ASSERT_EQ(treated.history.size(), 5u);
  EXPECT_THAT(treated.history[0], testing::StartsWith("level=plane:"));
  EXPECT_THAT(treated.history[1], testing::StartsWith("fill=harmonic: 16 pixels"));
  EXPECT_THAT(treated.history[2], testing::StartsWith("lowpass=gauss:3um:"));
  EXPECT_THAT(treated.history[3], testing::StartsWith("crop=5,5,20,20:"));
  EXPECT_EQ(treated.history[4], "flip=x");
  EXPECT_EQ(treated.height.cols(), 20);
}

TEST(Treatment, EqualsTheFunctionsItNames) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(same_bits(apply({"level=poly2"}, rough).height, level(rough, Form::poly2).height));
  EXPECT_TRUE(same_bits(apply({"mirror"}, rough).height, mirror(rough).height));
  EXPECT_TRUE(same_bits(apply({"resample=20,15"}, rough).height, resample(rough, 20, 15).height));
}

TEST(Recipes, HaveNamesOfTheirOwnAndStepsThatExist) {
  std::set<std::string> names;
  for (const Recipe& recipe : recipes()) {
    EXPECT_NO_THROW(check(recipe.steps)) << recipe.name;
    EXPECT_FALSE(recipe.purpose.empty()) << recipe.name;
    EXPECT_TRUE(names.insert(recipe.name).second) << recipe.name;
  }
  EXPECT_FALSE(names.empty());
}

TEST(Recipes, AreTheirSteps) {
  const auto rough = noise(kGrid);
  for (const Recipe& recipe : recipes()) {
    const auto named = apply({"flip=x", "recipe=" + recipe.name}, rough);
    Treatment written{"flip=x"};
    written.insert(written.end(), recipe.steps.begin(), recipe.steps.end());
    const auto typed = topography::apply(written, rough);  // std::apply takes vectors, too
    EXPECT_TRUE(same_bits(named.height, typed.height)) << recipe.name;
    EXPECT_EQ(named.history, typed.history) << recipe.name;
    EXPECT_EQ(expanded({"flip=x", "recipe=" + recipe.name}), written);
  }
}

TEST(Recipes, ContradictStepsAsTheirOwnStepsDo) {
  EXPECT_EQ(edges_of({"recipe=part"}), Edges::cut);
  EXPECT_THAT(message_of({"recipe=pad", "edges=cut"}), HasSubstr("'cut' after 'end'"));
  EXPECT_THAT(message_of({"recipe=pad", "mirror"}), HasSubstr("with mirror"));
}

TEST(Treatment, DependsOnTheOrderOfItsSteps) {
  const auto rough = noise(kGrid);
  const Field a = apply({"level=plane", "crop=0,0,20,30"}, rough).height;
  const Field b = apply({"crop=0,0,20,30", "level=plane"}, rough).height;
  EXPECT_GT(largest_difference(a, b), 1e-9);
}

TEST(Treatment, OfNoStepsChangesNothing) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(same_bits(apply({}, rough).height, rough.height));
}

TEST(Crop, TakesLengthsAsWellAsPixels) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(same_bits(apply({"crop=4um, 2um, 20um, 0.01mm"}, rough).height,
                        apply({"crop=4,2,20,10"}, rough).height));
}

TEST(CheckTreatment, AcceptsEveryStepWithTheExamplesOfItsArgument) {
  for (const StepDescription& step : treatment_steps()) {
    if (step.argument.find('|') != std::string::npos) {
      std::string alternatives = step.argument + '|';
      while (!alternatives.empty()) {
        const auto bar = alternatives.find('|');
        EXPECT_EQ(message_of({step.name + "=" + alternatives.substr(0, bar)}), "");
        alternatives.erase(0, bar + 1);
      }
    }
    EXPECT_FALSE(step.help.empty());
  }
  EXPECT_EQ(message_of({"mirror", "crop=0,0,4,4", "resample=8,8"}), "");
}

TEST(CheckTreatment, NamesTheNearestStepOrValue) {
  EXPECT_THAT(message_of({"levl=plane"}), HasSubstr("did you mean 'level'"));
  EXPECT_THAT(message_of({"level=plan"}), HasSubstr("did you mean 'plane'"));
  EXPECT_THAT(message_of({"fill=harmonc"}), HasSubstr("did you mean 'harmonic'"));
  EXPECT_THAT(message_of({"lowpass=han:512/L"}), HasSubstr("did you mean 'hann'"));
  EXPECT_THAT(message_of({"recipe=shet"}), HasSubstr("did you mean 'sheet'"));
}

TEST(CheckTreatment, RejectsWhatMakesNoSense) {
  for (const std::string step : {"",
                                 "=",
                                 "level",
                                 "level=",
                                 "level=plane=1",
                                 "fill",
                                 "lowpass",
                                 "lowpass=hann",
                                 "crop=1,2,3",
                                 "crop=1,2,3,x",
                                 "crop=-1,0,3,3",
                                 "crop=1.5,0,3,3",
                                 "crop=0,0,1e99,3",
                                 "crop=0,0,3kg,3",
                                 "crop=0,0,nan,3",
                                 "resample=3",
                                 "resample=3um,4um",
                                 "mirror=2",
                                 "flip",
                                 "flip=z"}) {
    EXPECT_NE(message_of({step}), "") << step;
    EXPECT_EQ(message_of({step}).find('\n'), std::string::npos) << step;
  }
}

TEST(Treatment, FindsAWrongLastStepBeforeTheFirstOneRuns) {
  int calls = 0;
  const Observer observer = [&](const Progress&) { return ++calls > 0; };
  EXPECT_THROW(apply({"level=plane", "lowpas=gauss:3um"}, noise(kGrid), observer), InputError);
  EXPECT_EQ(calls, 0);
}

TEST(Treatment, StopsWhenTheObserverAsks) {
  EXPECT_THROW(apply({"level=plane"}, noise(kGrid), [](const Progress&) { return false; }),
               Interrupted);
}

}  // namespace
}  // namespace tabor::topography::test
