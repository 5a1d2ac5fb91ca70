#pragma once

#include <vector>

#include "tabor/contact/preconditioner.hpp"
#include "tabor/core/types.hpp"
#include "tabor/elastic/border.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::contact {

/// Adds long waves to a preconditioned direction (second level of the preconditioner). The compact
/// kernel M ignores the interaction of contacts farther apart than its taper. This class adds that
/// interaction on a grid of blocks of pixels: with P the bilinear interpolation from that grid to
/// the pixels of a set, m the row sums of M on the set and S_c the compliance of long waves that M
/// leaves out,
///
///     e = S_c P^T (d - m P e),     d <- d - m P e
///
/// e [m] is the long-wave displacement the corrected direction d [Pa] causes. It is solved by
/// conjugate gradients in the inner product of K = P^T m P, in which I + S_c K is symmetric.
class LongWaves {
 public:
  /// Prepares the blocks of a grid. plateau: value of M at long waves [Pa/m]; border: what lies
  /// beyond the grid.
  LongWaves(const Grid& grid, double effective_modulus, double plateau, elastic::Border border);

  /// True unless the grid has only a few blocks, on which nothing is left to correct.
  bool useful() const { return blocks_y_ >= kLeastBlocks && blocks_x_ >= kLeastBlocks; }

  /// Accuracy of the solution on the blocks: `rough` suffices to tell which pixels a bound will
  /// hold.
  enum class Accuracy { rough, full };

  /// Sets e to zero: the next solution starts from there.
  void start_anew();

  /// Sets direction[k] = compact[k] - (m P e)[k] at pixel set[k]; the solution for e starts from
  /// the previous e. compact: the direction M gives; stiffness: m [Pa/m]; moved: the part of the
  /// direction that the bounds on the pressure let through. A pixel where it differs from the
  /// compact direction is held by a bound: it adds to the load of its block but not to its
  /// stiffness.
  void correct(const PixelList& set, const std::vector<float>& stiffness,
               const std::vector<float>& moved, const std::vector<float>& compact,
               Accuracy accuracy, std::vector<float>& direction);

 private:
  static constexpr Index kLeastBlocks = 4;

  struct Neighbours {  // two blocks between whose centres a pixel lies, along one axis
    Index lower;
    Index upper;
    float weight;  // of the upper one
  };

  static std::vector<Neighbours> neighbours(Index n_pixels, Index n_blocks, bool repeats);
  void gather(const PixelList& set, const std::vector<float>& stiffness,
              const std::vector<float>& moved, const std::vector<float>& compact);
  void gather_row(const PixelList& set, const std::vector<float>& stiffness,
                  const std::vector<float>& moved, const std::vector<float>& compact, Index y);
  struct Sums;
  void add(const Sums& sums, const Neighbours& row, const Neighbours& column);
  void apply_compliance(const FieldF& load, FieldF& displacement);
  void apply_stiffness(const FieldF& displacement, FieldF& load) const;
  void solve(double tolerance);

  Grid grid_;
  Index blocks_y_;
  Index blocks_x_;
  std::vector<Neighbours> rows_;     // of every pixel row
  std::vector<Neighbours> columns_;  // of every pixel column
  FieldF compliance_;                // S_c [m/Pa], shape (half spectrum of x, half spectrum of y)
  FieldF load_;                      // P^T moved [Pa]
  FieldF stiffness_;                 // K [Pa/m], 9 maps: to each of the 3 x 3 blocks around
  FieldF displacement_;              // e [m]
  double first_square_ = 0;          // energy of the error for e = 0
  spectral::Convolution<float> convolution_;
};

}  // namespace tabor::contact
