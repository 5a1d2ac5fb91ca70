// A run of sliding that is stopped goes on with the same bits.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "cases/small_sheet.hpp"
#include "support/folder.hpp"
#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::cases {
namespace {

using testing::HasSubstr;

struct SlidingRun {
  CaseSettings settings;
  SlideSettings sliding{.distance = 12e-6, .step = 2e-6, .every = 4e-6, .maps_at = {6e-6}};

  SlidingRun() {
    settings.mean_pressures = {10e6};
    settings.contact = test::aluminium();
    settings.contact.tool.tool = "ground:Sa=0.1um,groove-length=50um,length=100um";
    settings.film.lubricant_densities = {0.2e-3};
    settings.friction = {.shear_strength = 70e6};
  }
};

/// All that a run hands over and returns.
struct Outcome {
  std::vector<NamedCells> numbers;
  std::vector<SlideMaps> maps;  ///< of the states that have some
  std::vector<SheetSpectra> spectra;
  Field after;
  bool stopped = false;
};

/// Slides until the observer is asked for the n-th time after the first step; 0: to the end. Every
/// loop asks it, as under a watch that never waits.
Outcome slid(const SlidingRun& run, const std::filesystem::path& folder, int n_questions = 0,
             double checkpoint_period = 1e9, bool ends_when_stopped = false) {
  Outcome outcome;
  const SlideParts parts = parts_of(run.settings, run.sliding);
  const SlideRun wanted{
      .receive =
          [&](const SlideState& state) {
            outcome.numbers.push_back(cells_of(slide_columns(parts), state.numbers));
            outcome.spectra.push_back(state.spectra);
            if (state.maps != nullptr) outcome.maps.push_back(*state.maps);
          },
      .wants_maps = true,
      .checkpoint = folder,
      .checkpoint_period = checkpoint_period,
      .ends_when_stopped = ends_when_stopped};
  int n_asked = 0;
  const Observer observer = [&](const Progress& progress) {
    if (n_asked > 0 || progress.stage.starts_with("slide,")) ++n_asked;
    return n_questions == 0 || n_asked < n_questions;
  };
  const test::EveryQuestion every;
  try {
    const Watch watch(observer, "");
    const SlideResult result =
        slide(test::small_sheet(), run.settings, run.sliding, wanted, observer);
    outcome.after = result.after.height;
    outcome.stopped = result.interrupted;
  } catch (const Interrupted&) {
    outcome.stopped = true;
  }
  return outcome;
}

bool same(const Field& one, const Field& other) {
  return one.rows() == other.rows() && one.cols() == other.cols() &&
         std::equal(one.data(), one.data() + one.size(), other.data());
}

std::string text_of(const std::vector<NamedCells>& rows) {
  std::string text;
  for (const NamedCells& row : rows) {
    for (const NamedCell& one : row) {
      text += fmt::format("{} {:.17g}\n", one.head.key, number_in(one.cell));
    }
  }
  return text;
}

void expect_same(const Outcome& found, const Outcome& expected) {
  EXPECT_EQ(text_of(found.numbers), text_of(expected.numbers));
  EXPECT_TRUE(same(found.after, expected.after));
  ASSERT_EQ(found.maps.size(), expected.maps.size());
  for (std::size_t i = 0; i < found.maps.size(); ++i) {
    EXPECT_TRUE(same(found.maps[i].sheet, expected.maps[i].sheet));
    EXPECT_TRUE(same(found.maps[i].pressure, expected.maps[i].pressure));
    EXPECT_TRUE(same(found.maps[i].gap, expected.maps[i].gap));
    EXPECT_TRUE(same(found.maps[i].squeezed, expected.maps[i].squeezed));
    EXPECT_TRUE(same(found.maps[i].liquid_pressure, expected.maps[i].liquid_pressure));
    EXPECT_TRUE((found.maps[i].state == expected.maps[i].state).all());
  }
  ASSERT_EQ(found.spectra.size(), expected.spectra.size());
  for (std::size_t i = 0; i < found.spectra.size(); ++i) {
    EXPECT_EQ(found.spectra[i].density_x, expected.spectra[i].density_x);
    EXPECT_EQ(found.spectra[i].density_y, expected.spectra[i].density_y);
  }
}

/// Stops a run again and again, each time a little later, until it ends. It saves itself before
/// each step, or, with a long period, only when it is stopped.
void expect_to_go_on(const SlidingRun& run, double checkpoint_period = 1e9) {
  const Outcome whole = slid(run, {});
  ASSERT_FALSE(whole.stopped);
  EXPECT_EQ(whole.maps.size(), 3U);  // both ends, and the one that was asked for
  const test::Folder folder;
  int n_stops = 0;
  Outcome found;
  for (int n_questions = 1; n_questions < 100000; n_questions += 1 + n_questions / 5, ++n_stops) {
    found = slid(run, folder / "run", n_questions, checkpoint_period);
    if (!found.stopped) break;
    ASSERT_TRUE(std::filesystem::exists(folder / "run/slide.h5")) << n_questions;
  }
  EXPECT_GE(n_stops, 5);
  expect_same(found, whole);
  EXPECT_EQ(folder.n_files(), 0U);
}

TEST(SlideCheckpoint, LetsAStoppedRunGoOnWithTheSameBits) {
  expect_to_go_on({});
  expect_to_go_on({}, 0);
}

TEST(SlideCheckpoint, LetsOneOnASheetThatHardensGoOn) {
  SlidingRun run;
  run.sliding.hardening = 1e14;
  expect_to_go_on(run);
}

TEST(SlideCheckpoint, LetsOneWithTrappedOilGoOn) {
  SlidingRun run;
  run.settings.trapped.trapped = true;
  run.sliding.until_steady = true;
  expect_to_go_on(run);
  run.sliding.liquid = SlidingOil::squeezed;
  expect_to_go_on(run);
}

/// Stops a run without a checkpoint in any loop of any step: the states before stay.
TEST(StoppedSlide, KeepsItsStates) {
  SlidingRun run;
  for (const bool is_trapped : {false, true}) {
    run.settings.trapped.trapped = is_trapped;
    const Outcome whole = slid(run, {});
    std::size_t most = 0;
    for (int n_questions = 1; n_questions < 100000; n_questions += 1 + n_questions / 5) {
      const Outcome part = slid(run, {}, n_questions, 1e9, true);
      if (!part.stopped) break;
      ASSERT_GE(part.numbers.size(), 1U);
      ASSERT_LT(part.numbers.size(), whole.numbers.size());
      const std::vector<NamedCells> expected(
          whole.numbers.begin(),
          whole.numbers.begin() + static_cast<std::ptrdiff_t>(part.numbers.size()));
      EXPECT_EQ(text_of(part.numbers), text_of(expected)) << n_questions;
      most = std::max(most, part.numbers.size());
    }
    EXPECT_GE(most, 2U);
  }
}

TEST(SlideCheckpoint, OfAnotherRunIsRejected) {
  const test::Folder folder;
  SlidingRun run;
  ASSERT_TRUE(slid(run, folder / "run", 30).stopped);
  ASSERT_TRUE(std::filesystem::exists(folder / "run"));
  run.settings.mean_pressures = {11e6};
  EXPECT_THAT(test::rejection([&] { slid(run, folder / "run"); }), HasSubstr("other settings"));
  run = {};
  run.sliding.distance = 13e-6;
  EXPECT_THAT(test::rejection([&] { slid(run, folder / "run"); }), HasSubstr("other settings"));
}

TEST(SlideCheckpoint, ThatIsDamagedIsRejected) {
  const test::Folder folder;
  ASSERT_TRUE(slid({}, folder / "run", 30).stopped);
  const std::filesystem::path file = folder / "run/slide.h5";
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
  stream.put('\x55').put('\xaa');
  stream.close();
  EXPECT_THAT(test::rejection([&] { slid({}, folder / "run"); }), HasSubstr("slide.h5"));
}

}  // namespace
}  // namespace tabor::cases
