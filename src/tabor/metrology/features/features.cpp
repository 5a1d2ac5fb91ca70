#include "tabor/metrology/features/features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/metrology/features/neighbours.hpp"
#include "tabor/metrology/features/watershed.hpp"

namespace tabor::metrology {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFive = 5;

/// A mean and how many values it is of.
struct Mean {
  double sum = 0;
  Index n = 0;

  void add(double value) {
    sum += value;
    ++n;
  }
  double value() const { return n > 0 ? sum / static_cast<double>(n) : kNan; }
};

/// What the parameters need of the hills, or of the dales.
struct FeatureMeans {
  Mean five;       ///< heights of the five highest peaks (deepest pits), as in the map
  Mean curvature;  ///< -(zxx + zyy)/2 at peaks, +(zxx + zyy)/2 at pits; counts them as well
  Mean area;       ///< of closed hills
  Mean volume;
};

/// (zxx + zyy) / 2 by second differences of next neighbours, all of which are valid.
double mean_curvature(const topography::Topography& topography, PixelIndex pixel) {
  const Field& z = topography.height;
  const Index nx = z.cols(), ny = z.rows();
  const Index y = pixel / nx, x = pixel % nx;
  const double dx = topography.grid.dx(), dy = topography.grid.dy();
  const double across = z(y, (x + 1) % nx) - 2 * z(y, x) + z(y, (x + nx - 1) % nx);
  const double along = z((y + 1) % ny, x) - 2 * z(y, x) + z((y + ny - 1) % ny, x);
  return (across / (dx * dx) + along / (dy * dy)) / 2;
}

FeatureMeans means_of(const topography::Topography& topography, MotifKind kind,
                      double least_difference, const Observer& observer) {
  const auto segmentation = segment(topography, kind, least_difference, observer);
  FeatureMeans means;
  for (const Motif& motif : segmentation.motifs) {  // highest peak (deepest pit) first
    if (motif.inner_extremum) {
      if (means.five.n < static_cast<Index>(kFive)) {
        means.five.add(topography.height.data()[motif.extremum]);
      }
      means.curvature.add(mean_curvature(topography, motif.extremum) *
                          (kind == MotifKind::hill ? -1 : 1));
    }
    if (motif.closed) {
      means.area.add(motif.n_pixels * topography.grid.pixel_area());
      means.volume.add(motif.volume);
    }
  }
  return means;
}

/// Points with eight valid neighbours, and those of them that stand above all eight.
struct Summits {
  double candidates = 0;
  double summits = 0;
};

Summits count_summits(const topography::Topography& topography) {
  const Field& z = topography.height;
  const Neighbours neighbours(topography);
  const auto sums = sum_over_rows<2>(z.rows(), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x < z.cols(); ++x) {
      int n_valid = 0, n_lower = 0;
      neighbours.for_each(y, x, [&](PixelIndex q, double) {
        n_valid += std::isnan(z.data()[q]) ? 0 : 1;
        n_lower += z.data()[q] < z(y, x) ? 1 : 0;
      });
      const bool candidate = n_valid == 8 && !std::isnan(z(y, x));
      row += Eigen::Array2d(candidate ? 1 : 0, candidate && n_lower == 8 ? 1 : 0);
    }
    return row;
  });
  return {sums[0], sums[1]};
}

/// Mean of the valid heights, summed about one of them: a scan may lie 1 m above its datum.
double mean_height(const Field& height, double near) {
  const auto sums = sum_over_rows<2>(height.rows(), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x < height.cols(); ++x) {
      if (!std::isnan(height(y, x))) row += Eigen::Array2d(height(y, x) - near, 1);
    }
    return row;
  });
  return near + sums[0] / sums[1];
}

/// Builds the list, one line of text per parameter.
class FeatureList {
 public:
  explicit FeatureList(double pruning)
      : after_pruning_(fmt::format("after Wolf pruning at {:g} % of Sz", 100 * pruning)) {}

  void add(std::string symbol, double value, std::string unit, const std::string& definition,
           std::string note = {}) {
    Parameter parameter;
    parameter.symbol = std::move(symbol);
    parameter.value = value;
    parameter.unit = std::move(unit);
    parameter.definition = definition;
    parameter.note = std::move(note);
    parameter.set = ParameterSet::feature;
    list_.push_back(std::move(parameter));
  }

  void density(const char* symbol, const char* what, Index n, double area) {
    add(symbol, area > 0 ? static_cast<double>(n) / area : kNan, "1/m^2",
        fmt::format("density of {} {}, among the points with eight valid neighbours, per area of "
                    "these points",
                    what, after_pruning_),
        area > 0 ? fmt::format("{} {}", n, what) : "no point has eight valid neighbours");
  }

  void curvature(const char* symbol, const char* what, const char* formula, const Mean& mean) {
    add(symbol, mean.value(), "1/m",
        fmt::format("mean curvature {} of the {} {}, second differences of next neighbours",
                    formula, what, after_pruning_),
        mean.n > 0 ? "" : fmt::format("no {} away from edges and holes", what));
  }

  void five(const char* symbol, const char* which, const char* what, const Mean& mean,
            double value) {
    add(symbol, value, "m",
        fmt::format("mean {} {}, from the mean of the valid points", which, after_pruning_),
        few(what, mean.n));
  }

  void closed(const char* symbol, const char* unit, const char* quantity, const char* what,
              const Mean& mean, double value) {
    add(symbol, value, unit,
        fmt::format("mean {} of closed {} (no pixel on the edge or beside a hole) {}", quantity,
                    what, after_pruning_),
        mean.n > 0 ? fmt::format("{} closed {}", mean.n, what)
                   : fmt::format("no closed {}: all reach the edge or a hole", what));
  }

  static std::string few(const char* what, Index n) {
    if (n >= static_cast<Index>(kFive)) return {};
    return n == 0 ? fmt::format("no {} away from edges and holes", what)
                  : fmt::format("mean of {} {} only", n, what);
  }

  std::vector<Parameter> list_;

 private:
  std::string after_pruning_;
};

}  // namespace

std::vector<Parameter> feature_parameters(const topography::Topography& topography,
                                          const FeatureOptions& options, const Observer& observer) {
  if (!(options.pruning >= 0 && options.pruning <= 1)) {
    throw InputError("pruning", fmt::format("{:g}", options.pruning),
                     "a share of Sz between 0 and 1", "the default is 0.05 (5 %)");
  }
  if (topography.height.isNaN().all()) {
    throw InputError("feature parameters", "a surface of holes only", "some valid heights", "");
  }
  const double lowest = topography.height.minCoeff<Eigen::PropagateNumbers>();
  const double highest = topography.height.maxCoeff<Eigen::PropagateNumbers>();
  const double least = options.pruning * (highest - lowest);
  FeatureMeans hills, dales;
  run_both([&] { hills = means_of(topography, MotifKind::hill, least, observer); },
           [&] { dales = means_of(topography, MotifKind::dale, least, {}); }, observer, "dales");
  const double mean = mean_height(topography.height, lowest);
  const auto summits = count_summits(topography);
  const double area = summits.candidates * topography.grid.pixel_area();
  const double s5p = hills.five.value() - mean, s5v = mean - dales.five.value();

  FeatureList list(options.pruning);
  list.density("Spd", "peaks", hills.curvature.n, area);
  list.density("Svd", "pits", dales.curvature.n, area);
  list.curvature("Spc", "peaks", "-(zxx + zyy)/2", hills.curvature);
  list.curvature("Svc", "pits", "(zxx + zyy)/2", dales.curvature);
  list.five("S5p", "height of the five highest peaks", "peaks", hills.five, s5p);
  list.five("S5v", "depth of the five deepest pits", "pits", dales.five, s5v);
  const auto few_peaks = FeatureList::few("peaks", hills.five.n);
  const auto few_pits = FeatureList::few("pits", dales.five.n);
  list.add("S10z", s5p + s5v, "m", "ten-point height S5p + S5v",
           few_peaks + (few_peaks.empty() || few_pits.empty() ? "" : ", ") + few_pits);
  list.closed("Sda", "m^2", "area", "dales", dales.area, dales.area.value());
  list.closed("Sha", "m^2", "area", "hills", hills.area, hills.area.value());
  list.closed("Sdv", "m^3", "volume below the lowest saddle", "dales", dales.area,
              dales.volume.value());
  list.closed("Shv", "m^3", "volume above the highest saddle", "hills", hills.area,
              hills.volume.value());
  list.add("Sds", area > 0 ? summits.summits / area : kNan, "1/m^2",
           "density of summits (EUR 15178): points above all eight neighbours, per area of the "
           "points with eight valid neighbours, not pruned",
           area > 0 ? fmt::format("{:.0f} summits", summits.summits)
                    : "no point has eight valid neighbours");
  return std::move(list.list_);
}

}  // namespace tabor::metrology
