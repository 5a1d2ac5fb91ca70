#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "bindings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/results/combination.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using topography::Topography;
using Text = std::string;
using Texts = std::vector<std::string>;

/// How two scans are put together; names are those of the command line.
comparison::CombineOptions combine_options(const std::string& mode, const std::string& match,
                                           bool search, const std::vector<double>& shift,
                                           double threshold) {
  comparison::CombineOptions options;
  const auto known_mode = comparison::combine_mode_from(mode);
  if (!known_mode) throw InputError("mode", "'" + mode + "'", "wear, difference or composite", "");
  const auto known_match = comparison::level_match_from(match);
  if (!known_match) throw InputError("match", "'" + match + "'", "none, offset or plane", "");
  options.mode = *known_mode;
  options.level = *known_match;
  options.search = search;
  options.threshold = threshold;
  if (!shift.empty()) {
    options.shift_x = shift.at(0);
    options.shift_y = shift.at(1);
  }
  return options;
}

/// (map, numbers as JSON, warnings)
using CombinedRow = std::tuple<Topography, Text, Texts>;
CombinedRow combine(const Topography& first, const Topography& second,
                    const comparison::CombineOptions& options, const nb::object& progress) {
  comparison::Combination found = watched(progress, [&](const Observer& observer) {
    return comparison::combine(first, second, options, observer);
  });
  const Text values = io::to_text(results::values_of(found));
  return {std::move(found.map), values, results::doubts_of(found)};
}

/// Writes the file of `tabor combine -o`; `values` are the numbers of combine() as JSON.
void save(const std::filesystem::path& file, const Topography& map, const Text& mode,
          const Text& values, const Texts& warnings, const Texts& methods) {
  std::vector<results::Finding> findings(warnings.size());
  for (std::size_t i = 0; i < findings.size(); ++i) findings[i].text = warnings[i];
  watched(nb::none(), [&](const Observer&) {
    results::write_combination({map, mode, io::Json::parse(values)}, {"tabor.save", "", methods},
                               findings, file);
    return true;
  });
}

}  // namespace

void bind_combine(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<comparison::CombineOptions>(module, "CombineOptions")
      .def(
          "__init__",
          [](comparison::CombineOptions* self, const std::string& mode, const std::string& match,
             bool search, const std::vector<double>& shift, double threshold) {
            new (self)
                comparison::CombineOptions(combine_options(mode, match, search, shift, threshold));
          },
          "mode"_a, "match"_a, "search"_a, "shift"_a, "threshold"_a);
  module.def("combine", &combine, "first"_a, "second"_a, "options"_a, "progress"_a.none());
  module.def("save_combination", &save, "file"_a, "map"_a, "mode"_a, "values"_a, "warnings"_a,
             "methods"_a);
}

}  // namespace tabor::python
