#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "tabor/core/types.hpp"

// Transforms large zero-padded maps a strip of frequencies at a time, to save memory.
namespace tabor::spectral {

/// Writes row y of a map; called from several threads.
template <typename Real>
using RowSource = std::function<void(Index y, std::span<Real> row)>;

/// Rows with the same y / kRowsPerStripBlock are handled by one thread, in their order.
inline constexpr Index kRowsPerStripBlock = 16;

/// Columns with the same (kx - begin of the range) / kColumnsPerStripBlock are shown by one thread,
/// in their order.
inline constexpr Index kColumnsPerStripBlock = 16;

/// Columns begin <= kx < end of a half spectrum.
struct ColumnRange {
  Index begin = 0;
  Index end = 0;
  Index size() const { return end - begin; }
};

/// Transforms zero-padded real maps in two dimensions, a strip of frequencies kx at a time, for
/// maps whose whole spectrum does not fit into memory. A map of shape (ny, nx) is the top left
/// corner of a zero map of shape (padded_ny, padded_nx). A strip has shape (ny, range.size()),
/// row-major. The same bits for any thread count; strips may be cut anywhere without changing a bit
/// of them.
template <typename Real>
class StripTransform {
 public:
  using Complex = std::complex<Real>;
  using Strip = std::vector<Complex>;
  /// Gets one column (kx, all padded_ny frequencies ky) of each map's spectrum and may change it.
  using ColumnWork = std::function<void(Index kx, std::span<Complex* const> columns)>;
  using RowSink = std::function<void(Index y, std::span<const Real> row)>;

  StripTransform(Index ny, Index nx, Index padded_ny, Index padded_nx);
  ~StripTransform();
  StripTransform(StripTransform&&) noexcept;
  StripTransform& operator=(StripTransform&&) noexcept;

  Index padded_ny() const;
  Index padded_nx() const;
  Index n_frequencies() const { return padded_nx() / 2 + 1; }  ///< columns of the half spectrum

  /// Transforms the rows of a map and stores the frequencies of the range.
  void rows_forward(const RowSource<Real>& map, ColumnRange range, Strip& strip) const;

  /// Transforms the columns of all strips (one per map, the same range) and shows them to `work`.
  void read_columns(std::span<Strip* const> strips, ColumnRange range,
                    const ColumnWork& work) const;
  /// Transforms as read_columns(), then back, and stores the first ny values of the changed
  /// columns.
  void change_columns(std::span<Strip* const> strips, ColumnRange range,
                      const ColumnWork& work) const;

  /// Transforms the rows of a strip, whose other frequencies are zero, back: padded_nx values per
  /// row, in any order of blocks of rows. The sum over all strips of a map is its inverse
  /// transform, not normalised (times padded_ny * padded_nx). `sink` may overwrite that row of the
  /// strip.
  void rows_inverse(const Strip& strip, ColumnRange range, const RowSink& sink) const;

 private:
  struct Plans;
  void for_columns(std::span<Strip* const> strips, ColumnRange range, const ColumnWork& work,
                   bool back) const;
  std::unique_ptr<Plans> plans_;
};

}  // namespace tabor::spectral
