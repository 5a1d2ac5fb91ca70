#include "tabor/contact/long_waves.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/elastic/padding.hpp"

namespace tabor::contact {
namespace {

constexpr Index kPixelsPerBlock = 8;  // the reach of the compact kernel
/// Least energy of the error, as a share of the first. The correction cancels long waves of the
/// direction that are hundreds of times too large: what it leaves must be small against that.
constexpr double kTolerance = 1e-12;
constexpr double kRoughTolerance = 1e-6;
constexpr int kMostSteps = 100;

/// Even, so that bands of pixels between two rows of blocks can be gathered in two colours.
Index block_count(Index n_pixels) {
  return std::max<Index>(2, 2 * (n_pixels / (2 * kPixelsPerBlock)));
}

double product(const FieldF& a, const FieldF& b) {
  const auto dot = [](const auto& one, const auto& other) {
    return (one.template cast<double>() * other.template cast<double>()).sum();
  };
  return sum_over_blocks(a.size(), dot, a.data(), b.data());
}

/// Row k of the 3 x 3 blocks around a block: (dy, dx), each -1, 0 or 1.
Index slot(Index dy, Index dx) { return 3 * (dy + 1) + dx + 1; }

}  // namespace

LongWaves::LongWaves(const Grid& grid, double effective_modulus, double plateau,
                     elastic::Border border)
    : grid_(grid),
      blocks_y_(block_count(grid.ny)),
      blocks_x_(block_count(grid.nx)),
      rows_(neighbours(grid.ny, blocks_y_, border == elastic::Border::repeats)),
      columns_(neighbours(grid.nx, blocks_x_, border == elastic::Border::repeats)),
      convolution_(blocks_y_, blocks_x_, elastic::padding_of(border)) {
  const Index extent = border == elastic::Border::repeats ? 1 : 2;  // of zeros or images
  const Index ny = extent * blocks_y_;
  const Index nx = extent * blocks_x_;
  const auto cells = static_cast<double>(extent * extent * blocks_y_ * blocks_x_);
  const double blocks_per_pixel =
      cells / static_cast<double>(extent * extent) / static_cast<double>(grid.size());
  const auto compliance = [&](Index ky, Index kx) {
    const double stiffness =
        0.5 * effective_modulus *
        std::hypot(spectral::wavevector(kx, nx, static_cast<double>(extent) * grid.lx),
                   spectral::wavevector(ky, ny, static_cast<double>(extent) * grid.ly));
    return blocks_per_pixel * (1 / stiffness - 1 / std::hypot(stiffness, plateau));
  };
  compliance_.resize(nx / 2 + 1, ny / 2 + 1);
  for_each_pixel(nx / 2 + 1, ny / 2 + 1, [&](Index kx, Index ky) {
    compliance_(kx, ky) = kx + ky == 0 ? 0.0F : static_cast<float>(compliance(ky, kx));
  });
  // A stiff answer to the mean keeps the load; stiffer than the longest wave slows the solution.
  compliance_(0, 0) = compliance_.maxCoeff();
}

std::vector<LongWaves::Neighbours> LongWaves::neighbours(Index n_pixels, Index n_blocks,
                                                         bool repeats) {
  std::vector<Neighbours> list(static_cast<std::size_t>(n_pixels));
  for_each(n_pixels, [&](Index pixel) {
    Neighbours& found = list[static_cast<std::size_t>(pixel)];
    const double position = (static_cast<double>(pixel) + 0.5) * static_cast<double>(n_blocks) /
                                static_cast<double>(n_pixels) -
                            0.5;
    const auto lower = static_cast<Index>(std::floor(position));
    const auto weight = static_cast<float>(position - std::floor(position));
    if (repeats) {
      found = {(lower + n_blocks) % n_blocks, (lower + 1) % n_blocks, weight};
    } else {
      const Index inside = std::clamp<Index>(lower, 0, n_blocks - 2);
      found = {inside, inside + 1, lower == inside ? weight : (lower < inside ? 0.0F : 1.0F)};
    }
  });
  return list;
}

/// What the pixels of one row between the same two columns of blocks add, before the weights of
/// the row.
struct LongWaves::Sums {
  float load[2] = {0, 0};          // of the lower and the upper block
  float stiffness[3] = {0, 0, 0};  // lower to lower, lower to upper, upper to upper
};

void LongWaves::add(const Sums& sums, const Neighbours& row, const Neighbours& column) {
  const float wy[2] = {1 - row.weight, row.weight};
  const Index y[2] = {row.lower, row.upper};
  const Index x[2] = {column.lower, column.upper};
  for (Index i = 0; i < 4; ++i) {
    load_(y[i / 2], x[i % 2]) += wy[i / 2] * sums.load[i % 2];
    for (Index j = 0; j < 4; ++j) {
      stiffness_(slot(j / 2 - i / 2, j % 2 - i % 2) * blocks_y_ + y[i / 2], x[i % 2]) +=
          wy[i / 2] * wy[j / 2] * sums.stiffness[i % 2 + j % 2];
    }
  }
}

void LongWaves::gather_row(const PixelList& set, const std::vector<float>& stiffness,
                           const std::vector<float>& moved, const std::vector<float>& compact,
                           Index y) {
  const Index first = y * grid_.nx;
  auto k = static_cast<std::size_t>(
      std::lower_bound(set.begin(), set.end(), static_cast<std::uint32_t>(first)) - set.begin());
  const auto in_row = [&] { return k < set.size() && set[k] < first + grid_.nx; };
  while (in_row()) {
    const Neighbours& columns = columns_[static_cast<std::size_t>(set[k] - first)];
    Sums sums;
    for (; in_row(); ++k) {
      const Neighbours& column = columns_[static_cast<std::size_t>(set[k] - first)];
      if (column.lower != columns.lower || column.upper != columns.upper) break;
      const float upper = column.weight;
      const float lower = 1 - upper;
      const float m = moved[k] == compact[k] ? stiffness[k] : 0.0F;
      sums.load[0] += lower * moved[k];
      sums.load[1] += upper * moved[k];
      sums.stiffness[0] += lower * lower * m;
      sums.stiffness[1] += lower * upper * m;
      sums.stiffness[2] += upper * upper * m;
    }
    add(sums, rows_[static_cast<std::size_t>(y)], columns);
  }
}

/// load_ = P^T moved, stiffness_ = K. Pixels of one band between two rows of blocks add to these
/// two rows only: even bands first, then odd ones, each in parallel.
void LongWaves::gather(const PixelList& set, const std::vector<float>& stiffness,
                       const std::vector<float>& moved, const std::vector<float>& compact) {
  load_ = FieldF::Zero(blocks_y_, blocks_x_);
  stiffness_ = FieldF::Zero(9 * blocks_y_, blocks_x_);
  std::vector<std::vector<Index>> bands(static_cast<std::size_t>(blocks_y_));
  for (Index y = 0; y < grid_.ny; ++y) {  // raw loop: lists of rows grow in order
    bands[static_cast<std::size_t>(rows_[static_cast<std::size_t>(y)].lower)].push_back(y);
  }
  for (const Index colour : {0, 1}) {
    const auto gather_band = [&](Index half) {
      for (const Index y : bands[static_cast<std::size_t>(2 * half + colour)]) {
        gather_row(set, stiffness, moved, compact, y);
      }
    };
    for_each(blocks_y_ / 2, gather_band, 1);
  }
}

void LongWaves::apply_compliance(const FieldF& load, FieldF& displacement) {
  displacement.resize(blocks_y_, blocks_x_);
  convolution_.apply(
      load.data(),
      [this](Index kx, std::span<float> values) {
        std::copy_n(compliance_.data() + kx * compliance_.cols(), values.size(), values.begin());
      },
      displacement.data());
}

void LongWaves::apply_stiffness(const FieldF& displacement, FieldF& load) const {
  load.resize(blocks_y_, blocks_x_);
  const auto wrapped = [](Index k, Index n) { return k < 0 ? k + n : (k < n ? k : k - n); };
  const Index inside = blocks_x_ - 2;
  for_each_row(blocks_y_, [&](Index y) {
    load.row(y).setZero();
    for (Index dy = -1; dy <= 1; ++dy) {
      const auto from = displacement.row(wrapped(y + dy, blocks_y_));
      for (Index dx = -1; dx <= 1; ++dx) {
        const auto weight = stiffness_.row(slot(dy, dx) * blocks_y_ + y);
        load.row(y).segment(1, inside) += weight.segment(1, inside) * from.segment(1 + dx, inside);
        for (const Index x : {Index{0}, blocks_x_ - 1}) {
          load(y, x) += weight(x) * from(wrapped(x + dx, blocks_x_));
        }
      }
    }
  });
}

void LongWaves::start_anew() {
  displacement_ = FieldF::Zero(blocks_y_, blocks_x_);
  first_square_ = 0;
}

/// (I + S_c K) e = S_c load, from the e known so far.
void LongWaves::solve(double tolerance) {
  FieldF residual;
  FieldF stiff_residual;
  FieldF image;
  apply_stiffness(displacement_, image);
  image = load_ - image;
  apply_compliance(image, residual);
  residual -= displacement_;
  apply_stiffness(residual, stiff_residual);
  FieldF step = residual;
  FieldF stiff_step = stiff_residual;
  double square = product(residual, stiff_residual);
  first_square_ = std::max(first_square_, square);
  const double enough = tolerance * first_square_;
  const auto n = static_cast<std::size_t>(load_.size());
  float* const e = displacement_.data();
  float* const r = residual.data();
  float* const mr = stiff_residual.data();
  float* const d = step.data();
  float* const md = stiff_step.data();
  float* const s = image.data();
  for (int k = 0; k < kMostSteps && square > enough; ++k) {
    apply_compliance(stiff_step, image);
    for_each(n, [=](std::size_t i) { s[i] += d[i]; });
    const auto length = static_cast<float>(square / product(image, stiff_step));
    for_each(n, [=](std::size_t i) {
      e[i] += length * d[i];
      r[i] -= length * s[i];
    });
    apply_stiffness(residual, stiff_residual);
    const double next = product(residual, stiff_residual);
    const auto momentum = static_cast<float>(next / square);
    for_each(n, [=](std::size_t i) {
      d[i] = r[i] + momentum * d[i];
      md[i] = mr[i] + momentum * md[i];
    });
    square = next;
  }
  // One more round through S_c smooths what the inner product does not see: blocks out of contact.
  apply_stiffness(displacement_, image);
  image = load_ - image;
  apply_compliance(image, displacement_);
}

void LongWaves::correct(const PixelList& set, const std::vector<float>& stiffness,
                        const std::vector<float>& moved, const std::vector<float>& compact,
                        Accuracy accuracy, std::vector<float>& direction) {
  gather(set, stiffness, moved, compact);
  solve(accuracy == Accuracy::rough ? kRoughTolerance : kTolerance);
  direction.resize(set.size());
  for_each(set.size(), [&](std::size_t k) {
    const Neighbours& row = rows_[set[k] / static_cast<std::uint32_t>(grid_.nx)];
    const Neighbours& column = columns_[set[k] % static_cast<std::uint32_t>(grid_.nx)];
    const auto along_x = [&](Index y) {
      return (1 - column.weight) * displacement_(y, column.lower) +
             column.weight * displacement_(y, column.upper);
    };
    direction[k] = compact[k] - stiffness[k] * ((1 - row.weight) * along_x(row.lower) +
                                                row.weight * along_x(row.upper));
  });
}

}  // namespace tabor::contact
