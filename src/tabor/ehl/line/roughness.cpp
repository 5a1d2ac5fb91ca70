#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/line/film.hpp"
#include "tabor/ehl/line/line.hpp"

namespace tabor::ehl {
namespace {

constexpr double kMinNodesPerAsperity = 8;

void check_length(const LineProblem& problem, const Eigen::ArrayXd& x, const char* what,
                  double length) {
  const double shortest = kMinNodesPerAsperity * (x[1] - x[0]);
  if (!(length >= shortest)) {
    throw InputError(
        what, format_si(length, "m"),
        fmt::format("{} or more with {} nodes", format_si(shortest, "m"), problem.nodes),
        "give more nodes");
  }
}

}  // namespace

double value_between_nodes(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, double at) {
  const double place = (at - x[0]) / (x[1] - x[0]);
  const Index i = std::clamp(static_cast<Index>(place), Index{0}, x.size() - 2);
  const double share = place - static_cast<double>(i);
  return (1 - share) * y[i] + share * y[i + 1];
}

Eigen::ArrayXd line_asperity(const LineProblem& problem, double height, double width,
                             double place) {
  const Eigen::ArrayXd x = line_nodes(problem);
  check_length(problem, x, "width of an asperity", width);
  if (!(place >= x[0] && place <= x[x.size() - 1])) {
    throw InputError(
        "place of an asperity", format_si(place, "m"),
        fmt::format("{} to {}, the domain", format_si(x[0], "m"), format_si(x[x.size() - 1], "m")),
        "");
  }
  return x.unaryExpr([=](double at) {
    const double wave = std::cos(std::numbers::pi * (at - place) / width);
    return std::abs(at - place) < width / 2 ? height * wave * wave : 0.0;
  });
}

Eigen::ArrayXd line_waves(const LineProblem& problem, double amplitude, double wavelength) {
  const Eigen::ArrayXd x = line_nodes(problem);
  check_length(problem, x, "wavelength of a roughness", wavelength);
  return amplitude * (2 * std::numbers::pi / wavelength * x).sin();
}

Eigen::ArrayXd line_profile(const LineProblem& problem, const Eigen::ArrayXd& height,
                            double spacing) {
  const Eigen::ArrayXd x = line_nodes(problem);
  const double length = spacing * static_cast<double>(height.size() - 1);
  const double needed = x[x.size() - 1] - x[0];
  if (!(length >= needed)) {
    throw InputError("profile of a roughness", format_si(length, "m"),
                     "the domain of the film or more, " + format_si(needed, "m"),
                     "a longer profile, or a shorter grid.inlet and grid.outlet");
  }
  if (!height.isFinite().all()) {
    throw InputError("profile of a roughness", "holes", "none", "fill them first: tabor convert");
  }
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(height.size(), 0, length);
  const double middle = (length - needed) / 2 - x[0];
  Eigen::ArrayXd heights =
      x.unaryExpr([&](double at) { return value_between_nodes(place, height, at + middle); });
  // Level what is used: a height or a slope of the profile would be taken for one of the cylinder.
  const Eigen::ArrayXd centred = x - x.mean();
  heights -= heights.mean();
  return heights - (heights * centred).sum() / centred.square().sum() * centred;
}

}  // namespace tabor::ehl
