#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/slide/slide.hpp"
#include "tabor/cases/slide/steadiness.hpp"
#include "tabor/cases/tool.hpp"

// Keeps a run of sliding in a folder, so that a killed one goes on with the same bits.
namespace tabor::cases {

/// Returns all that the numbers of a run depend on, as text.
std::string identity_of(const topography::Topography& surface, const CaseSettings& settings,
                        const SlideSettings& sliding, const Tool& tool);

/// What a run has reached after some steps.
struct ReachedSlide {
  sliding::Slider::Reached slider;
  sliding::Ploughing since;  ///< the last state
  sliding::Ploughing all;
  std::uint64_t steps = 0;
  std::uint64_t pixels = 0;  ///< of a step
  bool converged = true;
  Field squeezed;   ///< film [m]; or empty
  double away = 0;  ///< of it, without space [m]
  std::vector<Period> periods;
  std::vector<SlideRecord> states;
  std::vector<SheetSpectra> spectra;
  std::vector<std::uint64_t> with_maps;  ///< numbers of the states whose maps are stored
};

/// Folder of one run: its last state, and the maps of each state that has some. Files are sealed,
/// and replaced when they are complete.
class SlideCheckpoint {
 public:
  /// `identity` names everything that the run depends on.
  SlideCheckpoint(std::filesystem::path folder, std::string identity)
      : folder_(std::move(folder)), identity_(std::move(identity)) {}

  /// Returns what was saved; nothing in an empty folder. Throws InputError where it is of another
  /// run, or damaged.
  std::optional<ReachedSlide> load() const;
  SlideMaps load_maps(std::uint64_t state) const;

  void save(const ReachedSlide& reached) const;
  void save_maps(std::uint64_t state, const SlideMaps& maps) const;

  /// Removes the files of a run that is complete, and the folder if nothing else is in it.
  void remove() const;

 private:
  std::filesystem::path file() const { return folder_ / "slide.h5"; }
  std::filesystem::path maps_file(std::uint64_t state) const;

  std::filesystem::path folder_;
  std::string identity_;
};

}  // namespace tabor::cases
