#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/scan/maps.hpp"

// Lists the maps of a result file by name: those that are stored and those that follow from them.
namespace tabor::results {

/// One state of a result.
struct ResultState {
  std::string label;  ///< "7 MPa, 0.9 g/m^2"
  std::vector<scan::NamedMap> maps;
};

/// All maps that a result holds of one surface.
struct ResultMaps {
  std::filesystem::path file;
  Grid grid;
  std::vector<scan::NamedMap> surface;  ///< of every state: the height
  std::vector<ResultState> states;
  double left = 0, top = 0;  ///< where the grid begins [m]
};

/// Groups of one state in the file, for add_state(). "": none.
struct StateGroups {
  std::string contact;       ///< pressure or state, and gap
  std::string film;          ///< film_thickness
  std::string trapped;       ///< liquid_pressure, ...
  std::string fluid;         ///< fluid_pressure, ...
  bool keeps_height = true;  ///< the surface is not one that earlier states have left
};

/// Reads the grid and height of a group like /surface. Throws InputError.
ResultMaps maps_on(const io::Hdf5Reader& reader, const std::filesystem::path& file,
                   const std::string& surface);
/// Adds a state: its maps in the file and, from them, `contact` (1 where solids touch) and
/// `displacement` (of the surface, into the body: gap + height - separation) [m].
void add_state(const io::Hdf5Reader& reader, const StateGroups& groups, ResultMaps& result);

/// Lists the maps of a file of contact, lubricate, friction or `ehl point`, whose film is called
/// film_thickness as in the others. Nothing is loaded yet. Throws InputError for a file without
/// maps, with the names of what it has.
ResultMaps read_result_maps(const io::Hdf5Reader& reader, const std::filesystem::path& file);

/// Selection of maps of a result.
struct MapChoice {
  std::string field = "all";
  std::optional<std::size_t> state = 0;  ///< from 0; nullopt: all of them
};

/// Returns the selected maps, under their own names for one state, followed by its number
/// ("gap_0001") for all states; the height, which all states share, comes first. Throws InputError
/// with the names that there are for another field, and with the number of states for another
/// state.
scan::MapSet chosen_maps(const ResultMaps& result, const MapChoice& choice);

/// Returns the file of a result: results.h5 of the folder of a study, else the file itself.
std::filesystem::path file_of_result(const std::filesystem::path& result);

}  // namespace tabor::results
