#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tabor/ehl/point/levels.hpp"
#include "tabor/ehl/point/lines.hpp"

// Preconditions Newton steps of a point contact by one V-cycle of multigrid.
namespace tabor::ehl {

/// Nodes of a mixed film whose equation or unknown is another one. Empty masks: none.
struct PointExceptions {
  Mask depth;    ///< pressure given, unknown: what is added to the film
  Mask contact;  ///< equation: one for the film, instead of the balance
};

/// Nearly inverts, in O(n log n), the linear equations of one Newton step of a point contact: one
/// V-cycle of multigrid with lines along the flow as smoothers. Residuals are those of the whole
/// elastic kernel on every grid; equations of the coarser grids are made anew from the mean
/// pressures and films (Venner & Lubrecht, Multilevel Methods in Lubrication, 2000, chapters 4 and
/// 7). As a preconditioner it may fail to converge by itself.
class PointMultigrid {
 public:
  /// `balance` and `held`: of the finest level, at the state in `flow` and `storage`.
  PointMultigrid(const std::vector<PointLevel>& levels, const PointBalance& balance,
                 const Mask& held, const PointFlow& flow, const PointStorage& storage,
                 const PointUnits& units, const PointExceptions& exceptions = {});

  bool ok() const { return ok_; }  ///< false: singular
  /// Residuals in, pressures (or depths) out; what stands at held nodes stays.
  Field operator()(const Field& right) const;

 private:
  struct Stage {
    const PointLevel* level;
    PointBalance balance;
    Mask held;
    Mask depth;
    std::unique_ptr<PointLines> lines;    // of all stages but the last
    std::unique_ptr<PointDirect> direct;  // of the last
  };
  void add_stage(const PointLevel& level, PointBalance balance, const Mask& held,
                 const Mask& depth);
  Field cycle(std::size_t stage, const Field& right) const;

  std::vector<Stage> stages_;
  Mask uncorrected_;  // exceptions, which coarser grids do not know; empty: none
  bool ok_ = true;
};

}  // namespace tabor::ehl
