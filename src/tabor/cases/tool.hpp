#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/warning.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/record/parameter.hpp"
#include "tabor/topography/topography.hpp"

// Makes the rough tool that a sheet is pressed with, from a scan or from a generator, and places it
// on the sheet.
namespace tabor::cases {

/// Settings of the tool. Without one the sheet is pressed with a flat.
struct ToolSettings {
  /// A scan file, or a generator with its numbers: "ground:Sa=0.1um,length=2mm". Absent: a flat.
  std::optional<std::string> tool = {};
  std::optional<double> tool_x = {};             ///< place of the tool along x [m]; absent: 0
  std::uint64_t tool_places = 1;                 ///< places along x, whose results are averaged
  std::optional<std::string> tool_lowpass = {};  ///< "hann:512/L": filter of the tool alone
  bool tool_repeats = false;  ///< a tool shorter than the sheet is put down again and again

  /// Returns the number of places in force: one under a flat.
  std::size_t n_places() const { return is_rough() ? tool_places : 1; }

  /// Heights in memory in place of a file, which `tool` names: see take_tool().
  std::shared_ptr<const topography::Topography> surface = {};

  std::filesystem::path folder = {};  ///< that the name of a scan file is relative to
  std::string sha256 = {};  ///< of that file, once it is known; the digest of heights in memory

  /// True where there is a tool.
  bool is_rough() const { return tool.has_value(); }
  /// True where the tool is a file.
  bool is_scan() const;
  /// Returns the path of a tool that is a file.
  std::filesystem::path file() const { return folder / *tool; }
};
const Parameters<ToolSettings>& tool_parameters();

/// Returns an objection to settings that name no tool, a generator that does not exist or numbers
/// that it does not take.
std::optional<Objection> objection(const ToolSettings& settings,
                                   const std::function<std::string(std::string_view)>& spelling);

/// Notes the folder and the SHA-256 of a tool that is a scan file. Throws InputError where it
/// cannot be read.
void find_tool(ToolSettings& settings, const std::filesystem::path& folder);

/// Presses with a surface in memory.
void take_tool(ToolSettings& settings, topography::Topography surface);

/// A tool on the pixels of a sheet: T(x, y), which repeats along x.
struct Tool {
  Field height;           ///< [m], positive towards the sheet, mean 0, shape (ny, nx_T)
  Grid grid;              ///< of all of the tool
  double rms_height = 0;  ///< [m]
};

/// Makes the tool of settings that name one on the pixels of a sheet. A scan whose pixels are a
/// whole part of the sheet's is averaged onto them. Throws InputError for a tool with holes, of
/// other pixels or another width, and for one shorter than the sheet that does not repeat.
Tool make_tool(const ToolSettings& settings, const Grid& sheet, const Observer& observer = {});

/// Returns the places of the tool [pixels]: the first at tool_x, the others evenly along the tool.
std::vector<Index> places_of(const ToolSettings& settings, const Tool& tool);

/// Returns the heights that press on the sheet at a place: T((x - place) mod nx_T, y) [m], of the
/// sheet's shape.
Field height_at(const Tool& tool, Index place, const Grid& sheet);

/// Returns the warnings of pressing this sheet with this tool.
Warnings of_tool(const topography::Topography& sheet, const Tool& tool);

}  // namespace tabor::cases
