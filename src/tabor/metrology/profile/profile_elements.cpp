#include "tabor/metrology/profile/profile_elements.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::metrology {
namespace {

/// A stretch on one side of the mean line, with what it took in.
struct Portion {
  bool hill = false;
  double begin = 0, end = 0;  ///< crossings [points]
  double highest = 0, lowest = 0;
};

bool counts(const Portion& portion, const Discrimination& least) {
  return (portion.hill ? portion.highest >= least.hill : -portion.lowest >= least.dale) &&
         portion.end - portion.begin >= least.spacing;
}

/// Reads one stretch without holes, point by point.
class Reader {
 public:
  Reader(const Discrimination& least, std::vector<ProfileElement>& elements)
      : least_(least), elements_(elements) {}

  void point(double at, double z) {
    if (z != 0 && started_ && (z > 0) != now_.hill) {
      const double crossing = at - z / (z - before_) * (at - before_at_);
      finish_portion(crossing);
      now_ = {z > 0, crossing, crossing, z, z};
    } else if (!started_) {
      now_ = {z > 0, at, at, z, z};
      started_ = true;
    }
    now_.highest = std::max(now_.highest, z);
    now_.lowest = std::min(now_.lowest, z);
    before_ = z;
    before_at_ = at;
  }

  /// The portion that the end of the stretch cuts off still ends the one before it.
  void end_of_stretch() {
    if (started_) finish_portion(before_at_);
    started_ = false;
    kept_.clear();
  }

 private:
  void finish_portion(double crossing) {
    now_.end = crossing;
    if (!kept_.empty() && (kept_.back().hill == now_.hill || !counts(now_, least_))) {
      Portion& last = kept_.back();
      last.end = now_.end;
      last.highest = std::max(last.highest, now_.highest);
      last.lowest = std::min(last.lowest, now_.lowest);
    } else if (counts(now_, least_)) {
      take_element();
      kept_.push_back(now_);
    }
  }

  /// Two portions between crossings, the next one has begun: the first of a stretch begins at no
  /// crossing unless something too small went before it.
  void take_element() {
    if (kept_.size() == 3) {
      const Portion &a = kept_[1], &b = kept_[2];
      elements_.push_back(
          {b.end - a.begin, std::max(a.highest, b.highest) - std::min(a.lowest, b.lowest)});
      kept_.erase(kept_.begin(), kept_.begin() + 2);
    }
  }

  const Discrimination& least_;
  std::vector<ProfileElement>& elements_;
  bool started_ = false;
  Portion now_;
  double before_ = 0, before_at_ = 0;
  std::vector<Portion> kept_;  ///< the one that a new element follows, then the element's portions
};

}  // namespace

std::vector<ProfileElement> profile_elements(const Eigen::ArrayXd& z,
                                             const Discrimination& discrimination) {
  std::vector<ProfileElement> elements;
  Reader reader(discrimination, elements);
  for (Index i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) {
      reader.end_of_stretch();
    } else {
      reader.point(static_cast<double>(i), z[i]);
    }
  }
  reader.end_of_stretch();
  return elements;
}

}  // namespace tabor::metrology
