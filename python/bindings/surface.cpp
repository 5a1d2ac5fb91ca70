#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "parameters.hpp"
#include "tabor/cases/spectra.hpp"
#include "tabor/cases/surface_parameters.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/metrology/spectra/mean_spectrum.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/topography/digest.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/recipes.hpp"
#include "tabor/topography/treatment.hpp"
#include "tabor/topography/warnings.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using topography::Topography;

using Text = std::string;
using Texts = std::vector<std::string>;
using WarningState = std::pair<Text, Text>;               // code, text
using EdgesState = std::pair<std::optional<Text>, bool>;  // what was said of them, found to match
using TopographyState =
    std::tuple<double, double, bool, double, std::tuple<Text, Text, Text, Text>,
               std::map<Text, Text>, Texts, std::vector<WarningState>, EdgesState>;

/// "tile", "cut" or "end"; None where nothing was said.
std::optional<Text> edges_of(const Topography& surface) {
  if (!surface.edges) return std::nullopt;
  return Text(topography::kEdges.of(*surface.edges));
}

/// All but the heights.
TopographyState state_of(const Topography& one) {
  std::vector<WarningState> warnings;
  warnings.reserve(one.warnings.size());
  for (const Warning& warning : one.warnings) warnings.emplace_back(warning.code, warning.text);
  return {one.grid.lx,
          one.grid.ly,
          one.periodic,
          one.tiles,
          {one.source, one.format, one.instrument, one.channel},
          one.metadata,
          one.history,
          warnings,
          {edges_of(one), one.edges_match}};
}

Topography topography_of(const MapArgument& height, const TopographyState& state) {
  Topography one;
  one.height = field_of(height);
  one.grid = {one.height.cols(), one.height.rows(), std::get<0>(state), std::get<1>(state)};
  one.periodic = std::get<2>(state);
  one.tiles = std::get<3>(state);
  std::tie(one.source, one.format, one.instrument, one.channel) = std::get<4>(state);
  one.metadata = std::get<5>(state);
  one.history = std::get<6>(state);
  for (const auto& [code, text] : std::get<7>(state)) one.warnings.push_back({code, text});
  const auto& [edges, edges_match] = std::get<8>(state);
  if (edges) one.edges = topography::kEdges.parse(*edges, "edges");
  one.edges_match = edges_match;
  return one;
}

/// A surface of heights [m] that no file holds, on pixels of dx by dy [m]; look_at() has not
/// seen it yet.
Topography make_surface(const MapArgument& height, double dx, double dy, bool periodic,
                        const std::string& source) {
  return watched(nb::none(), [&](const Observer&) {
    Topography one;
    one.height = field_of(height);
    const auto nx = static_cast<double>(one.height.cols());
    const auto ny = static_cast<double>(one.height.rows());
    one.grid = {one.height.cols(), one.height.rows(), nx * dx, ny * dy};
    one.periodic = periodic;
    one.source = source;
    one.format = "array";
    return one;
  });
}

/// Finds edges and warnings of a surface from make_surface().
void look_at(Topography& surface) {
  watch(nb::none(), [&](const Observer&) { topography::look_at(surface); });
}

/// The surface with other heights on the same grid, which a step made that Python did: edges stay,
/// `note` becomes the last line of its history, and warnings about the heights are found anew.
/// Where a second surface took part, it repeats if both do, and has the edges that both have.
Topography with_heights(const Topography& surface, const MapArgument& height,
                        const std::string& note, const Topography* second) {
  return watched(nb::none(), [&](const Observer&) {
    Topography one = surface;
    one.height = field_of(height);
    one.history.push_back(note);
    if (second != nullptr) {
      const bool both_repeat = topography::repeats(surface) && topography::repeats(*second);
      if (one.edges != second->edges) one.edges = std::nullopt;
      one.periodic = both_repeat && surface.periodic;
      one.edges_match = both_repeat;
    }
    topography::renew_warnings(one);
    return one;
  });
}

/// The surface as one that came from `source`.
Topography from_source(const Topography& surface, const std::string& source) {
  Topography one = surface;
  one.source = source;
  return one;
}

/// With the digest of the file's bytes.
std::pair<Topography, std::string> read(const std::filesystem::path& file,
                                        const scan::ReadOptions& options,
                                        const nb::object& progress) {
  return watched(progress, [&](const Observer& observer) {
    const scan::ScanFile opened(file, observer);
    return std::make_pair(opened.read(options), opened.sha256());
  });
}

Topography apply(const Topography& surface, const topography::Treatment& treatment,
                 const nb::object& progress) {
  topography::check(treatment);
  return watched(progress, [&](const Observer& observer) {
    return topography::apply(treatment, surface, observer);
  });
}

/// (name, purpose, steps)
using RecipeTexts = std::vector<std::tuple<Text, Text, std::vector<Text>>>;
RecipeTexts recipes() {
  RecipeTexts texts;
  for (const topography::Recipe& recipe : topography::recipes()) {
    texts.emplace_back(recipe.name, recipe.purpose,
                       std::vector<Text>(recipe.steps.begin(), recipe.steps.end()));
  }
  return texts;
}

/// Slopes of the mean plane along x and y; none where heights do not determine it.
std::optional<std::pair<double, double>> tilt(const Topography& surface) {
  const nb::gil_scoped_release release;
  const auto fit = topography::try_fit_form(surface.height, 1);
  if (!fit) return std::nullopt;
  const auto [along_x, along_y] = topography::tilt_of(*fit, surface.grid);
  return std::pair(along_x, along_y);
}

using StepTexts = std::vector<std::tuple<Text, Text, Text>>;
StepTexts treatment_steps() {
  StepTexts steps;
  for (const topography::StepDescription& step : topography::treatment_steps()) {
    steps.emplace_back(step.name, step.argument, step.help);
  }
  return steps;
}

/// (symbol, value, unit, definition, note, set)
using ParameterRow = std::tuple<Text, double, Text, Text, Text, Text>;
std::vector<ParameterRow> parameters(const Topography& surface, const nb::object& progress) {
  const auto all = watched(progress, [&](const Observer& observer) {
    return cases::parameters_of(surface, {}, observer).parameters;
  });
  std::vector<ParameterRow> rows;
  rows.reserve(all.size());
  for (const metrology::Parameter& one : all) {
    rows.emplace_back(one.symbol, one.value, one.unit, one.definition, one.note,
                      metrology::name_of(one.set));
  }
  return rows;
}

/// (q, density, unit, Hurst exponent, its standard error)
using SpectrumRow = std::tuple<std::vector<double>, std::vector<double>, Text, double, double>;
SpectrumRow row_of(const metrology::Spectrum& one) {
  return {one.q, one.density, one.unit, one.hurst.hurst, one.hurst.standard_error};
}

metrology::PsdOptions psd_options(const std::string& convention,
                                  const std::optional<std::string>& window,
                                  const std::optional<double>& fit_min,
                                  const std::optional<double>& fit_max) {
  const auto known = metrology::psd_convention_from(convention);
  if (!known) {
    throw InputError("convention", "'" + convention + "'", "jacobs, persson or gwyddion", "");
  }
  metrology::PsdOptions options{
      .convention = *known, .window = {}, .fit_q_min = fit_min, .fit_q_max = fit_max};
  if (window) options.window = metrology::psd_window_from(*window);
  if (window && !options.window) {
    throw InputError("window", "'" + *window + "'", "none or hann", "");
  }
  return options;
}

nb::dict psd(const Topography& surface, const metrology::PsdOptions& options,
             const nb::object& progress) {
  const cases::SpectraRecord record = watched(progress, [&](const Observer& observer) {
    return cases::spectra_of(surface, {.psd = options}, observer);
  });
  const metrology::PowerSpectra& spectra = *record.spectra;
  nb::dict all;
  all["x"] = row_of(spectra.x);
  all["y"] = row_of(spectra.y);
  all["radial"] = row_of(spectra.radial);
  all["convention"] = std::string(metrology::name_of(spectra.convention));
  all["window"] = std::string(metrology::name_of(spectra.window));
  all["trusted"] = std::pair(record.trusted.shortest, record.trusted.longest);
  all["warnings"] = shown(record.warnings);
  return all;
}

/// (q, density, unit) of each spectrum -> (q, mean density, standard deviation, standard error,
/// unit)
using Densities = std::vector<std::tuple<std::vector<double>, std::vector<double>, std::string>>;
using MeanRow = std::tuple<std::vector<double>, std::vector<double>, std::vector<double>,
                           std::vector<double>, Text>;
MeanRow mean_spectrum(const Densities& densities) {
  std::vector<metrology::Spectrum> spectra(densities.size());
  for (std::size_t i = 0; i < densities.size(); ++i) {
    std::tie(spectra[i].q, spectra[i].density, spectra[i].unit) = densities[i];
  }
  const metrology::MeanSpectrum mean = metrology::mean_spectrum(spectra);
  MeanRow row{mean.q, {}, {}, {}, mean.unit};
  for (const Mean& one : mean.density) {
    std::get<1>(row).push_back(one.mean);
    std::get<2>(row).push_back(one.standard_deviation);
    std::get<3>(row).push_back(one.standard_error);
  }
  return row;
}

ShownWarnings warnings_about(const Topography& surface) {
  return shown(cases::of_surface(surface));
}

void require_no_holes(const Topography& surface) {
  topography::require_no_holes(surface, surface.source, "surface.fill('harmonic') fills them");
}

void bind_topography(nb::module_& module) {
  nb::class_<Topography>(module, "Topography")
      .def("__getstate__",
           [](nb::handle_t<Topography> self) {
             const auto& one = nb::cast<const Topography&>(self);
             return std::make_tuple(view_of(one.height, self), state_of(one));
           })
      .def("__setstate__",
           [](Topography& self, const std::tuple<MapArgument, TopographyState>& state) {
             new (&self) Topography(topography_of(std::get<0>(state), std::get<1>(state)));
           })
      .def_prop_ro("height",
                   [](nb::handle_t<Topography> self) {
                     return view_of(nb::cast<const Topography&>(self).height, self);
                   })
      .def_prop_ro("lx", [](const Topography& self) { return self.grid.lx; })
      .def_prop_ro("ly", [](const Topography& self) { return self.grid.ly; })
      .def_prop_ro("n_holes", &topography::count_holes)
      .def_prop_ro("warnings", &warnings_about)
      .def_prop_ro("periodic", &topography::repeats)
      .def_ro("source", &Topography::source)
      .def_ro("format", &Topography::format)
      .def_ro("instrument", &Topography::instrument)
      .def_ro("channel", &Topography::channel)
      .def_ro("metadata", &Topography::metadata)
      .def_ro("history", &Topography::history);
}

}  // namespace

void bind_surface(nb::module_& module) {
  using namespace nb::literals;
  bind_topography(module);
  nb::class_<scan::ReadOptions> options(module, "ReadOptions");
  options.def(nb::init<>())
      .def_rw("pixel_x", &scan::ReadOptions::pixel_x)
      .def_rw("pixel_y", &scan::ReadOptions::pixel_y);
  bind_parameters(options, scan::read_parameters());
  module.def("look_at", &look_at, "surface"_a);
  module.def("make_surface", &make_surface, "height"_a, "dx"_a, "dy"_a, "periodic"_a, "source"_a);
  module.def("with_heights", &with_heights, "surface"_a, "height"_a, "note"_a,
             "second"_a.none() = nb::none());
  module.def("from_source", &from_source, "surface"_a, "source"_a);
  module.def("read", &read, "file"_a, "options"_a, "progress"_a.none());
  module.def("write", &scan::write, "surface"_a, "file"_a);
  module.def("apply", &apply, "surface"_a, "treatment"_a, "progress"_a.none());
  module.def("treatment_steps", &treatment_steps);
  module.def("recipes", &recipes);
  module.def("tilt", &tilt, "surface"_a);
  module.def(
      "digest_of",
      [](const Topography& one) { return topography::digest_of(one.height, one.grid); },
      "surface"_a);
  module.def("mean_spectrum", &mean_spectrum, "spectra"_a);
  module.def("require_no_holes", &require_no_holes, "surface"_a);
  module.def("parameters", &parameters, "surface"_a, "progress"_a.none());
  module.def(
      "psd",
      [](const Topography& surface, const std::string& convention,
         const std::optional<std::string>& window, const std::optional<double>& fit_min,
         const std::optional<double>& fit_max, const nb::object& progress) {
        return psd(surface, psd_options(convention, window, fit_min, fit_max), progress);
      },
      "surface"_a, "convention"_a, "window"_a.none(), "fit_min"_a.none(), "fit_max"_a.none(),
      "progress"_a.none());
}

}  // namespace tabor::python
