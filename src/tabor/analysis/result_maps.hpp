#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/io/hdf5.hpp"
#include "tabor/scan/maps.hpp"

// The maps of a result file, by name: those that stand in it and those that follow from them.
namespace tabor::analysis {

/// One state of a result.
struct ResultState {
  std::string label;  ///< "7 MPa, 0.9 g/m^2"
  std::vector<scan::NamedMap> maps;
};

/// All that a result holds of one surface.
struct ResultMaps {
  std::filesystem::path file;
  Grid grid;
  std::vector<scan::NamedMap> surface;  ///< of every state: the height
  std::vector<ResultState> states;
  double left = 0, top = 0;  ///< where the grid begins [m]
};

/// What the groups of one state hold, for add_state(). Paths are in the file; "": none.
struct StateGroups {
  std::string contact;       ///< pressure or state, and gap
  std::string film;          ///< film_thickness
  std::string fluid;         ///< fluid_pressure, ...
  bool keeps_height = true;  ///< the surface is not one that earlier states have left
};

/// The grid and height of a group like /surface. Throws InputError.
ResultMaps maps_on(const io::Hdf5Reader& reader, const std::filesystem::path& file,
                   const std::string& surface);
/// Adds a state: its maps in the file and, from them, `contact` (1 where solids touch) and
/// `displacement` (of the surface, into the body: gap + height - separation) [m].
void add_state(const io::Hdf5Reader& reader, const StateGroups& groups, ResultMaps& result);

/// The maps of a file of contact, lubricate, friction or `ehl point`, whose film is called
/// film_thickness as in the others. Nothing is loaded yet. Throws InputError for a file without
/// maps, with the names of what it has.
ResultMaps read_result_maps(const io::Hdf5Reader& reader, const std::filesystem::path& file);

/// Which maps of a result.
struct MapChoice {
  std::string field = "all";
  std::optional<std::size_t> state = 0;  ///< from 0; nullopt: all of them
};

/// Those maps, under their own names for one state, with its number behind ("gap_0001") for all;
/// the height, which is the same in all, stands first. Throws InputError with the names that there
/// are for another field, and with the number of states for another state.
scan::MapSet chosen_maps(const ResultMaps& result, const MapChoice& choice);

}  // namespace tabor::analysis
