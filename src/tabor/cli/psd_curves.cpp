#include "tabor/cli/psd_curves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/cli/result.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/atomic_file.hpp"
#include "tabor/io/csv.hpp"
#include "tabor/io/hdf5.hpp"

namespace tabor::cli {

namespace {

std::string csv_of(const std::vector<Curve>& curves) {
  std::size_t n_rows = 0;
  std::vector<std::string> cells;
  for (const Curve& curve : curves) {
    n_rows = std::max(n_rows, curve.values.size());
    cells.push_back(curve.name);
  }
  std::string text = io::csv_line(cells);
  for (std::size_t row = 0; row < n_rows; ++row) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const auto& values = curves[i].values;
      cells[i] = row < values.size() ? io::csv_number(values[row]) : "";
    }
    text += io::csv_line(cells);
  }
  return text;
}

}  // namespace

void write_curves(const std::vector<Curve>& curves, const std::filesystem::path& file,
                  const Context& context, const std::vector<std::string>& methods) {
  if (lower(file.extension().string()) == ".csv") {
    io::write_file(file, csv_of(curves));
    return;
  }
  io::Hdf5Writer writer(file);
  analysis::write_result_head(writer, head_of(context, "", methods));
  for (const Curve& curve : curves) {
    const std::string path = "/curves/" + curve.name;
    writer.write(path, curve.values);
    writer.describe(path, curve.unit, curve.long_name);
  }
  analysis::write_warnings(writer, context.warnings);
  writer.commit();
}

}  // namespace tabor::cli
