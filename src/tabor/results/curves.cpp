#include "tabor/results/curves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::results {

namespace {

/// NXdata of a density against its wavevector, the radial one where there is one.
void make_plot(const CurveSet& set, io::Hdf5Writer& writer) {
  std::string density;
  for (const Curve& curve : set.curves) {
    const bool is_radial = curve.name.starts_with("psd_radial");
    if (is_radial || (density.empty() && curve.name.starts_with("psd_"))) density = curve.name;
    if (is_radial) break;
  }
  if (density.empty()) return;
  const std::string axis = density.substr(4, density.find('_', 4) - 4);
  writer.nxdata(set.place, density, {"q_" + axis + "_rad_per_m"});
  writer.attribute(set.place, "SILX_style",
                   R"({"axes_scale_types": ["log"], "signal_scale_type": "log"})");
}

void write_curve_set(const CurveSet& set, io::Hdf5Writer& writer) {
  writer.group(set.place);
  for (const auto& [name, texts] : set.attributes) {
    if (texts.size() == 1) {
      writer.attribute(set.place, name, texts.front());
    } else {
      writer.attribute(set.place, name, texts);
    }
  }
  for (const Curve& curve : set.curves) {
    const std::string path = set.place + "/" + curve.name;
    writer.write(path, curve.values);
    writer.describe(path, curve.unit, curve.long_name);
    for (const auto& [name, number] : curve.attributes) writer.attribute(path, name, number);
  }
  make_plot(set, writer);
}

/// What NeXus programs show of a file at once: the group of the first set.
void make_default(const CurveSet& set, io::Hdf5Writer& writer) {
  const std::size_t end = set.place.rfind('/');
  if (end > 0) writer.attribute(set.place.substr(0, end), "default", set.place.substr(end + 1));
  writer.attribute("/", "default", set.place.substr(1, end > 0 ? end - 1 : std::string::npos));
}

}  // namespace

std::string csv_of(const std::vector<CurveSet>& sets) {
  std::size_t n_rows = 0;
  std::vector<std::string> cells;
  std::vector<const std::vector<double>*> columns;
  for (const CurveSet& set : sets) {
    for (const Curve& curve : set.curves) {
      n_rows = std::max(n_rows, curve.values.size());
      cells.push_back(set.heading.empty() ? curve.name : set.heading + " " + curve.name);
      columns.push_back(&curve.values);
    }
  }
  std::string text = io::csv_line(cells);
  for (std::size_t row = 0; row < n_rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::vector<double>& values = *columns[i];
      cells[i] = row < values.size() ? io::csv_number(values[row]) : "";
    }
    text += io::csv_line(cells);
  }
  return text;
}

void write_curves(const std::vector<CurveSet>& sets, const std::filesystem::path& file,
                  const ResultHead& head, const std::vector<Finding>& warnings) {
  if (lower(file.extension().string()) == ".csv") {
    io::write_file(file, csv_of(sets));
    return;
  }
  io::Hdf5Writer writer(file);
  write_result_head(writer, head);
  for (const CurveSet& set : sets) write_curve_set(set, writer);
  if (!sets.empty()) make_default(sets.front(), writer);
  write_warnings(writer, warnings);
  writer.commit();
}

}  // namespace tabor::results
