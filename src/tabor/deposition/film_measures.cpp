#include "tabor/deposition/film_measures.hpp"

#include <numeric>

#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

/// Wet pixels that follow one another in a row: [begin, end).
struct Run {
  Index begin = 0;
  Index end = 0;
  std::size_t label = 0;
};

/// Labels of runs, united where runs touch; counts how many stay apart.
class Labels {
 public:
  std::size_t add() {
    up_.push_back(up_.size());
    ++count_;
    return up_.back();
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) {
      up_[b] = a;
      --count_;
    }
  }
  Index count() const { return count_; }

 private:
  std::size_t root(std::size_t a) {
    while (up_[a] != a) {
      up_[a] = up_[up_[a]];
      a = up_[a];
    }
    return a;
  }
  std::vector<std::size_t> up_;
  Index count_ = 0;
};

std::vector<Run> runs_of(const Field& thickness, Index row, Labels& labels) {
  std::vector<Run> runs;
  for (Index column = 0; column < thickness.cols(); ++column) {
    if (!(thickness(row, column) > 0)) continue;
    if (runs.empty() || runs.back().end != column) runs.push_back({column, column, labels.add()});
    runs.back().end = column + 1;
  }
  return runs;
}

void unite_touching(const std::vector<Run>& above, const std::vector<Run>& below, Labels& labels) {
  auto upper = above.begin();
  auto lower = below.begin();
  while (upper != above.end() && lower != below.end()) {
    if (upper->begin < lower->end && lower->begin < upper->end) {
      labels.unite(upper->label, lower->label);
    }
    (upper->end < lower->end ? upper : lower)++;
  }
}

void unite_ends(const std::vector<Run>& row, Index n_columns, Labels& labels) {
  if (!row.empty() && row.front().begin == 0 && row.back().end == n_columns) {
    labels.unite(row.front().label, row.back().label);
  }
}

}  // namespace

Index count_wet_regions(const Field& thickness, bool periodic) {
  Labels labels;
  std::vector<Run> first;
  std::vector<Run> previous;
  for (Index row = 0; row < thickness.rows(); ++row) {
    go_on_or_throw();
    std::vector<Run> current = runs_of(thickness, row, labels);
    unite_touching(previous, current, labels);
    if (periodic) unite_ends(current, thickness.cols(), labels);
    if (row == 0) first = current;
    previous = std::move(current);
  }
  if (periodic) unite_touching(previous, first, labels);
  return labels.count();
}

void measure(Film& film, Edge edge) {
  film.n_pools = count_wet_regions(film.thickness, edge == Edge::periodic);
  film.wet_fraction = static_cast<double>((film.thickness > 0).count()) /
                      static_cast<double>(film.thickness.size());
  film.max_film = film.thickness.maxCoeff();
}

}  // namespace tabor::deposition
