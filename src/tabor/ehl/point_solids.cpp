#include "tabor/ehl/point_solids.hpp"

#include <vector>

namespace tabor::ehl {
namespace {

/// Cells still to be visited on the way of the liquid from the border.
class Flood {
 public:
  explicit Flood(const Mask& touching)
      : closed_(Mask::Constant(touching.rows(), touching.cols(), true)), touching_(touching) {}

  void reach(Index j, Index i) {
    if (j < 0 || i < 0 || j >= closed_.rows() || i >= closed_.cols()) return;
    if (touching_(j, i) || !closed_(j, i)) return;
    closed_(j, i) = false;
    waiting_.push_back(j * closed_.cols() + i);
  }
  void run() {
    while (!waiting_.empty()) {
      const Index j = waiting_.back() / closed_.cols();
      const Index i = waiting_.back() % closed_.cols();
      waiting_.pop_back();
      reach(j, i - 1);
      reach(j, i + 1);
      reach(j - 1, i);
      reach(j + 1, i);
    }
  }
  const Mask& closed() const { return closed_; }

 private:
  Mask closed_;
  const Mask& touching_;
  std::vector<Index> waiting_;
};

}  // namespace

Mask closed_to_flow(const Mask& touching) {
  Flood flood(touching);
  for (Index i = 0; i < touching.cols(); ++i) {
    flood.reach(0, i);
    flood.reach(touching.rows() - 1, i);
  }
  for (Index j = 0; j < touching.rows(); ++j) {
    flood.reach(j, 0);
    flood.reach(j, touching.cols() - 1);
  }
  flood.run();
  return flood.closed();
}

}  // namespace tabor::ehl
