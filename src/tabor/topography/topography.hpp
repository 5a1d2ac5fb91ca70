#pragma once

#include <map>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::topography {

/// What a careful user should know, in one sentence, and how long it holds.
struct Warning {
  /// How long a warning holds.
  enum class About {
    record,   ///< the file or a step of its treatment: for good
    heights,  ///< the heights as they are: asked anew after a treatment
    spikes    ///< until a step looks for spikes: a filter hides them, what they did stays
  };
  std::string text;
  About about = About::record;
  std::string code = "file";  ///< its name in docs/warnings.md
};

/// The sentences alone.
std::vector<std::string> texts(const std::vector<Warning>& warnings);

/// A measured or generated height map. A value: treatments return new ones.
struct Topography {
  Grid grid;
  Field height;            ///< [m], asperities up, NaN = hole
  bool periodic = false;   ///< true for generated surfaces that tile without a seam
  double tiles = 1;        ///< copies of the scan along each side, made by mirror()
  std::string source;      ///< file name or recipe
  std::string format;      ///< as in `tabor formats`, e.g. "x3p"
  std::string instrument;  ///< as the file names it, "" if it does not
  std::string channel;     ///< title of the channel that was read
  std::map<std::string, std::string> metadata;
  std::vector<std::string> history;  ///< treatment steps so far, canonical text with numbers
  std::vector<Warning> warnings;     ///< about the file, the treatment and the heights
};

/// One row or one column: its width counts for nothing.
bool is_profile(const Grid& grid);

Mask holes(const Topography& topography);  ///< true where height is NaN
Index count_holes(const Topography& topography);

/// Throws InputError if heights are missing: how many, and the remedy. `name`: of the scan.
void require_no_holes(const Topography& topography, const std::string& name,
                      const std::string& remedy);

}  // namespace tabor::topography
