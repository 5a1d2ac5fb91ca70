#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/core/warning.hpp"

// Defines Topography, a measured or generated height map with its origin, history and warnings.
namespace tabor::topography {

/// Surface beyond the edges of a map.
enum class Edges {
  tile,  ///< the surface repeats
  cut,   ///< it is a cut-out of a larger one, which its mirror images continue
  end    ///< the body ends there
};

/// Measured or generated height map. A value: treatments return new ones.
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
  Warnings warnings;                 ///< about the file, the treatment and the heights
  std::optional<Edges> edges = {};   ///< as the user says; absent: found from the heights
  /// True where opposite edges were found to match (edges.hpp). It survives levelling, which tilts
  /// the tile.
  bool edges_match = false;
  /// True where a filter that wraps round has joined edges that did not match.
  bool edges_joined = false;
};

/// True for a map of one row or one column: its width has no meaning.
bool is_profile(const Grid& grid);

Mask holes(const Topography& topography);  ///< true where height is NaN
Index count_holes(const Topography& topography);

/// Throws InputError if heights are missing: how many, and the remedy. `name` of the scan.
void require_no_holes(const Topography& topography, const std::string& name,
                      const std::string& remedy);

}  // namespace tabor::topography
