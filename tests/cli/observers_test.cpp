// Whoever watches a computation is asked before it begins and goes on being asked: every function
// of the library that takes an Observer.
#include <gmock/gmock.h>

#include <functional>
#include <string>
#include <vector>

#include "support/folder.hpp"
#include "tabor/comparison/combine.hpp"
#include "tabor/comparison/registration.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/metrology/features/features.hpp"
#include "tabor/metrology/features/watershed.hpp"
#include "tabor/metrology/profile/profile.hpp"
#include "tabor/metrology/spectra/height_differences.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/holes.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::test {
namespace {

using topography::Topography;

Topography rough() {
  synthesis::SelfAffine recipe;
  recipe.grid = {256, 256, 256e-6, 256e-6};
  recipe.rms_height = 1e-6;
  recipe.short_cutoff_wavelength = 4e-6;
  Topography surface = synthesis::self_affine(recipe);
  surface.periodic = false;
  return surface;
}

Topography with_holes() {
  Topography surface = rough();
  surface.height.block(40, 40, 60, 60).setConstant(std::nan(""));
  return surface;
}

struct Watched {
  std::string name;
  std::size_t fewest;  ///< questions on 256 x 256 pixels when none is left out
  std::function<void(const Observer&)> run;
};

std::vector<Watched> everything(const std::string& file) {
  using metrology::ParameterOptions;
  std::vector<Watched> all;
  const Topography surface = rough();
  for (const auto model :
       {deposition::Model::droplets, deposition::Model::limit, deposition::Model::bottom_fill}) {
    all.push_back({"deposit " + std::string(deposition::name(model)), 10, [=](const Observer& o) {
                     deposition::Dose dose;
                     dose.mean_films = {1e-7};
                     dose.droplet_height = 1e-7;
                     dose.model = model;
                     deposition::deposit(surface.height, surface.grid, dose, o);
                   }});
  }
  for (const char* step : {"level=plane", "level=poly4", "lowpass=hann:64/L", "lowpass=gauss:8um",
                           "highpass=gauss:80um", "despike=auto"}) {
    all.push_back({step, 8, [=](const Observer& o) { topography::apply({step}, surface, o); }});
  }
  for (const auto fill : {topography::Fill::harmonic, topography::Fill::nearest}) {
    all.push_back({"fill holes", 2,
                   [=](const Observer& o) { topography::fill_holes(with_holes(), fill, o); }});
  }
  all.push_back({"read", 8, [=](const Observer& o) { scan::read(file, {}, o); }});
  for (const auto set : metrology::kParameterSets) {
    all.push_back({"parameters " + std::string(metrology::name_of(set)), 4, [=](const Observer& o) {
                     ParameterOptions options;
                     options.sets = {set};
                     metrology::parameters(surface, options, o);
                   }});
  }
  all.push_back({"height differences", 8, [=](const Observer& o) {
                   metrology::height_differences(surface.height, surface.grid, o);
                 }});
  all.push_back({"segment", 8, [=](const Observer& o) {
                   metrology::segment(surface, metrology::MotifKind::hill, 1e-7, o);
                 }});
  all.push_back(
      {"features", 12, [=](const Observer& o) { metrology::feature_parameters(surface, {}, o); }});
  all.push_back(
      {"profiles", 8, [=](const Observer& o) { metrology::profile_parameters(surface, {}, o); }});
  all.push_back({"registration", 8,
                 [=](const Observer& o) { comparison::register_scans(surface, surface, {}, o); }});
  all.push_back(
      {"combine", 8, [=](const Observer& o) { comparison::combine(surface, surface, {}, o); }});
  return all;
}

class Observers : public testing::Test {
 protected:
  void SetUp() override {
    scan::write(rough(), folder_ / "scan.sdf");
    set_watch_period(0);
    set_thread_count(1);  // with more, chance decides which blocks the thread that is watched gets
  }
  void TearDown() override {
    set_watch_period(kWatchPeriod);
    set_thread_count(0);
  }

  std::vector<Watched> all() const { return everything((folder_ / "scan.sdf").string()); }

  Folder folder_;
};

TEST_F(Observers, ThatSayStopAtOnceEndEveryFunctionThere) {
  for (const Watched& watched : all()) {
    int asked = 0;
    const Observer never = [&](const Progress&) { return ++asked < 1; };
    EXPECT_THROW(watched.run(never), Interrupted) << watched.name;
    EXPECT_EQ(asked, 1) << watched.name;
  }
}

TEST_F(Observers, AreAskedAllTheTime) {
  for (const Watched& watched : all()) {
    std::size_t asked = 0;
    const Observer counting = [&](const Progress&) { return ++asked > 0; };
    watched.run(counting);
    EXPECT_GE(asked, watched.fewest) << watched.name;
  }
}

TEST_F(Observers, ThatSayStopLaterEndEveryFunctionToo) {
  for (const Watched& watched : all()) {
    std::size_t asked = 0;
    const Observer later = [&](const Progress&) { return ++asked < watched.fewest; };
    EXPECT_THROW(watched.run(later), Interrupted) << watched.name;
    EXPECT_EQ(asked, watched.fewest) << watched.name << ": nothing is asked after a stop";
  }
}

}  // namespace
}  // namespace tabor::test
