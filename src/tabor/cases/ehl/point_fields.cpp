#include "tabor/cases/ehl/point_case.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tabor/ehl/point/measures.hpp"

namespace tabor::ehl {

namespace {

constexpr int kLevels = 200;  // of the slice-plane graph

Field or_zero(const Field& field, const Field& like) {
  return field.size() > 0 ? field : Field(Field::Zero(like.rows(), like.cols()));
}

void write_curve(io::Hdf5Writer& writer, const std::string& path, const char* unit,
                 const char* long_name, const Eigen::ArrayXd& values) {
  writer.write(path, std::vector<double>(values.begin(), values.end()));
  writer.describe(path, unit, long_name);
}

void write_maps(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result) {
  struct Map {
    const char* name;
    const char* unit;
    const char* long_name;
    const Field& values;
  };
  const std::string group = "/contact";
  writer.group(group);
  const Grid& grid = result.grid;
  writer.axes(group, grid, point_x(problem)[0] - grid.dx() / 2,
              point_y(problem)[0] - grid.dy() / 2);
  for (const Map& map :
       {Map{"film", "m", "film thickness", result.film},
        Map{"pressure", "Pa", "pressure of the liquid", result.pressure},
        Map{"contact_pressure", "Pa", "pressure of touching solids", result.contact_pressure},
        Map{"plastic_depth", "m", "plastic deformation", result.plastic_depth},
        Map{"roughness", "m", "roughness, asperities up", problem.roughness}}) {
    if (map.values.size() == 0) continue;
    const std::string path = group + "/" + map.name;
    writer.write(path, map.values);
    writer.describe(path, map.unit, map.long_name);
    writer.attach_axes(path);
  }
  writer.nxdata(group, "film");
  writer.attribute("/", "default", "contact");
}

/// One row or column of every map.
struct Cut {
  std::string group;
  const char* place_name;
  Eigen::ArrayXd place;  // [m]
  Eigen::ArrayXd dry;    // [Pa]
  bool is_row = true;
  Index at = 0;

  Eigen::ArrayXd of(const Field& field) const {
    if (is_row) return field.row(at).transpose();
    return field.col(at);
  }
};

void write_cut(io::Hdf5Writer& writer, const Cut& cut, const PointResult& result,
               const PointResult* smooth) {
  writer.group(cut.group);
  const auto write = [&](const char* name, const char* unit, const char* long_name,
                         const Eigen::ArrayXd& values) {
    write_curve(writer, cut.group + "/" + name, unit, long_name, values);
  };
  write("place", "m", cut.place_name, cut.place);
  write("film", "m", "film thickness", cut.of(result.film));
  write("pressure", "Pa", "pressure of the liquid", cut.of(result.pressure));
  write("contact_pressure", "Pa", "pressure of touching solids",
        cut.of(or_zero(result.contact_pressure, result.film)));
  write("hertz_pressure", "Pa", "pressure of the smooth dry contact", cut.dry);
  if (!smooth) return;
  write("smooth_film", "m", "film thickness of smooth bodies", cut.of(smooth->film));
  write("smooth_pressure", "Pa", "pressure of smooth bodies", cut.of(smooth->pressure));
}

void write_cuts(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result,
                const PointResult* smooth) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  const Eigen::ArrayXd x = point_x(problem);
  const Eigen::ArrayXd y = point_y(problem);
  Index row = 0;
  Index column = 0;
  y.abs().minCoeff(&row);
  x.abs().minCoeff(&column);
  write_cut(writer,
            {.group = "/along",
             .place_name = "position along the flow, from the centre",
             .place = x,
             .dry = x.unaryExpr([&](double at) { return hertz_pressure(hertz, at, 0); }),
             .is_row = true,
             .at = row},
            result, smooth);
  write_cut(writer,
            {.group = "/across",
             .place_name = "place across the flow, from the centre",
             .place = y,
             .dry = y.unaryExpr([&](double at) { return hertz_pressure(hertz, 0, at); }),
             .is_row = false,
             .at = column},
            result, smooth);
}

void write_slices(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result,
                  const PointResult* smooth) {
  const auto largest = [&](const PointResult& of) {
    return hertz_area(problem).select(of.film, 0.0).maxCoeff();
  };
  const double highest = std::max(largest(result), smooth ? largest(*smooth) : 0.0);
  const Eigen::ArrayXd levels = Eigen::ArrayXd::LinSpaced(kLevels + 1, 0, highest);
  const std::vector<double> asked(levels.begin(), levels.end());
  const auto write = [&](const char* name, const char* long_name, const PointResult& of) {
    const std::string path = std::string("/slice_plane/") + name;
    writer.write(path, slice_plane(problem, of, asked));
    writer.describe(path, "1", long_name);
  };
  writer.group("/slice_plane");
  write_curve(writer, "/slice_plane/level", "m", "film thickness", levels);
  write("share", "share of the dry contact's area with a film up to the level", result);
  if (smooth) write("smooth_share", "the same of smooth bodies", *smooth);
}

}  // namespace

void write_point(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result,
                 const PointResult* smooth) {
  write_maps(writer, problem, result);
  write_cuts(writer, problem, result, smooth);
  write_slices(writer, problem, result, smooth);
}

}  // namespace tabor::ehl
