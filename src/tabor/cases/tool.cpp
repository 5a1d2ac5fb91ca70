#include "tabor/cases/tool.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "tabor/core/advice.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/synthesis/recipe_text.hpp"
#include "tabor/topography/digest.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cases {
namespace {

constexpr double kSamePixel = 1e-3;  // relative, as scan files round theirs

[[noreturn]] void reject(const ToolSettings& settings, const std::string& got,
                         const std::string& expected, const std::string& remedy) {
  throw InputError("tool " + *settings.tool, got, expected, remedy);
}

std::string pixels_of(const Grid& grid) {
  return fmt::format("pixels of {} x {}", format_si(grid.dx(), "m"), format_si(grid.dy(), "m"));
}

/// Returns how many pixels of the tool make one of the sheet along an axis; 0 where it is no whole
/// number.
Index pixels_in(double sheet, double tool) {
  const double ratio = sheet / tool;
  const double whole = std::round(ratio);
  return whole >= 1 && std::abs(ratio - whole) <= kSamePixel * whole ? static_cast<Index>(whole)
                                                                     : 0;
}

topography::Topography read_tool(const ToolSettings& settings, const Observer& observer) {
  const scan::ScanFile file(settings.file(), observer);
  if (!settings.sha256.empty() && file.sha256() != settings.sha256) {
    throw Error(*settings.tool + ": replaced or changed while it was in use; start again");
  }
  try {
    topography::Topography tool = file.read();
    tool.source = *settings.tool;
    return tool;
  } catch (const IncompleteError& error) {
    throw IncompleteError(fmt::format("tool {} with 'tabor convert TOOL OUT', and give OUT",
                                      advised(error.what(), as_option)));
  }
}

/// The surface that is the tool, from a file or from memory.
topography::Topography scanned_tool(const ToolSettings& settings, const Observer& observer) {
  topography::Topography tool =
      settings.surface ? *settings.surface : read_tool(settings, observer);
  topography::require_no_holes(tool, "tool " + *settings.tool,
                               "fill them: tabor convert TOOL OUT --fill harmonic");
  return tool;
}

topography::Topography generated_tool(const ToolSettings& settings, const Grid& sheet) {
  try {
    return synthesis::generate(synthesis::parse_recipe(*settings.tool), sheet);
  } catch (const InputError& error) {
    throw InputError(fmt::format("tool {}: {}", *settings.tool, error.what()));
  }
}

/// Averages the tool onto the pixels of the sheet.
topography::Topography on_pixels_of(const Grid& sheet, const ToolSettings& settings,
                                    topography::Topography tool, const Observer& observer) {
  const Index nx = pixels_in(sheet.dx(), tool.grid.dx());
  const Index ny = pixels_in(sheet.dy(), tool.grid.dy());
  if (nx == 0 || ny == 0) {
    reject(settings, pixels_of(tool.grid), "those of the sheet, " + pixels_of(sheet),
           "resample it first: tabor convert TOOL OUT --resample NX,NY");
  }
  if (nx == 1 && ny == 1) return tool;
  const std::string step = fmt::format("resample={},{}", tool.grid.nx / nx, tool.grid.ny / ny);
  return topography::apply({step}, std::move(tool), observer);
}

/// Settings of a tool where there is none.
std::optional<Objection> objection_without_tool(
    const ToolSettings& settings, const std::function<std::string(std::string_view)>& spelling) {
  const std::pair<const char*, bool> given[] = {{"tool_x", settings.tool_x.has_value()},
                                                {"tool_places", settings.tool_places != 1},
                                                {"tool_lowpass", settings.tool_lowpass.has_value()},
                                                {"tool_repeats", settings.tool_repeats}};
  for (const auto& [setting, is_given] : given) {
    if (!is_given) continue;
    return objection_to_use(setting, fmt::format("{} needs {}, e.g. <tool=ground:Sa=0.1um>",
                                                 spelling(setting), spelling("tool")));
  }
  return std::nullopt;
}

void check_size(const Grid& sheet, const ToolSettings& settings, const Grid& tool) {
  if (tool.ny != sheet.ny) {
    reject(settings, fmt::format("{} rows", tool.ny),
           fmt::format("as many as the sheet has, {}", sheet.ny),
           tool.ny > sheet.ny ? "crop it first: tabor convert TOOL OUT --crop X,Y,NX,NY"
                              : "crop the sheet, or give a larger tool");
  }
  if (tool.nx >= sheet.nx || settings.tool_repeats) return;
  reject(settings, fmt::format("{} columns", tool.nx),
         fmt::format("at least as many as the sheet has, {}", sheet.nx),
         "give a longer tool, or let it repeat (<tool_repeats>)");
}

}  // namespace

bool ToolSettings::is_scan() const {
  return is_rough() && !surface && !synthesis::is_recipe(*tool);
}

const Parameters<ToolSettings>& tool_parameters() {
  using Settings = ToolSettings;
  using One = tabor::Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "tool",
           .help = "rough tool instead of the flat: a scan, or a generator with its numbers",
           .example = "ground:Sa=0.1um",
           .study_key = "contact.tool",
           .placeholder = "SCAN|RECIPE",
           .absent = "flat",
           .identity = Identity::unless_default},
          &Settings::tool)
          .with_identifying_value([](const Settings& one) {
            if (!one.is_rough()) return Cell();
            return Cell(one.sha256.empty() ? *one.tool : one.sha256);
          }),
      One({.name = "tool_x",
           .help = "position of the tool along x, rounded to whole pixels",
           .example = "100 um",
           .dimension = dimension::length,
           .study_key = "contact.tool_x",
           .placeholder = "X",
           .absent = "0 um",
           .identity = Identity::unless_default},
          &Settings::tool_x),
      One({.name = "tool_places",
           .help = "number of positions along the tool over which friction is averaged",
           .example = "1",
           .study_key = "contact.tool_places",
           .placeholder = "N"},
          &Settings::tool_places),
      One({.name = "tool_lowpass",
           .help = "low-pass filter for the tool, as for a scan",
           .example = "gauss:8um",
           .study_key = "contact.tool_lowpass",
           .placeholder = "FILTER",
           .absent = "none",
           .identity = Identity::unless_default},
          &Settings::tool_lowpass),
      One({.name = "tool_repeats",
           .help = "repeat a tool that is shorter than the sheet",
           .study_key = "contact.tool_repeats",
           .identity = Identity::unless_default},
          &Settings::tool_repeats)};
  static const Parameters<Settings> all = grouped("Rough tool", table);
  return all;
}

std::optional<Objection> objection(const ToolSettings& settings,
                                   const std::function<std::string(std::string_view)>& spelling) {
  if (!settings.is_rough()) return objection_without_tool(settings, spelling);
  if (settings.tool_places == 0) {
    return Objection{.setting = "tool_places", .got = "0", .expected = "one or more"};
  }
  if (settings.tool->empty()) {
    return Objection{.setting = "tool",
                     .got = "''",
                     .expected = "a scan file, or a generator such as ground:Sa=0.1um"};
  }
  if (!settings.surface && !settings.is_scan()) synthesis::parse_recipe(*settings.tool);
  if (!settings.tool_lowpass) return std::nullopt;
  try {
    topography::check({"lowpass=" + *settings.tool_lowpass});
  } catch (const InputError&) {
    return Objection{.setting = "tool_lowpass",
                     .got = "'" + *settings.tool_lowpass + "'",
                     .expected = "a low-pass filter and its cutoff, such as gauss:8um"};
  }
  return std::nullopt;
}

void find_tool(ToolSettings& settings, const std::filesystem::path& folder) {
  if (!settings.is_scan()) return;
  settings.folder = folder;
  const bool is_there = std::filesystem::exists(settings.file());
  if (!is_there && settings.tool->find(':') != std::string::npos) {
    throw InputError("<tool>", "'" + *settings.tool + "', which is no file and no generator",
                     fmt::format("a scan file or one of {}, such as ground:Sa=0.1um",
                                 fmt::join(synthesis::recipe_kinds(true), ", ")),
                     "");
  }
  settings.sha256 = io::sha256_of_file(settings.file());
}

void take_tool(ToolSettings& settings, topography::Topography surface) {
  settings.tool = surface.source.empty() ? "surface" : surface.source;
  settings.sha256 = fmt::format("{:016x}", topography::digest_of(surface.height, surface.grid));
  settings.surface = std::make_shared<const topography::Topography>(std::move(surface));
}

Tool make_tool(const ToolSettings& settings, const Grid& sheet, const Observer& observer) {
  topography::Topography made =
      settings.surface || settings.is_scan()
          ? on_pixels_of(sheet, settings, scanned_tool(settings, observer), observer)
          : generated_tool(settings, sheet);
  if (settings.tool_lowpass) {
    made = topography::apply({"lowpass=" + *settings.tool_lowpass}, std::move(made), observer);
  }
  check_size(sheet, settings, made.grid);
  Tool tool;
  made.height -= made.height.mean();
  tool.rms_height = metrology::rms_height(made);
  tool.height = std::move(made.height);
  tool.grid = made.grid;
  return tool;
}

std::vector<Index> places_of(const ToolSettings& settings, const Tool& tool) {
  const auto first = static_cast<Index>(std::llround(settings.tool_x.value_or(0) / tool.grid.dx()));
  const auto n = static_cast<Index>(settings.tool_places);
  std::vector<Index> places;
  for (Index i = 0; i < n; ++i) places.push_back(first + i * tool.grid.nx / n);
  return places;
}

Field height_at(const Tool& tool, Index place, const Grid& sheet) {
  return sliding::tool_at(tool.height, place, sheet.nx);
}

Warnings of_tool(const topography::Topography& sheet, const Tool& tool) {
  const double own = metrology::rms_height(sheet);
  if (!(tool.rms_height > own)) return {};
  return {{"rough-tool",
           fmt::format("The tool (Sq {}) is rougher than the sheet (Sq {}). The model takes the "
                       "sheet as the softer body that yields",
                       format_si(tool.rms_height, "m"), format_si(own, "m")),
           tool.rms_height / own}};
}

}  // namespace tabor::cases
