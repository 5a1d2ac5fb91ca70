#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/types.hpp"

// Holds a map of pressure as the list of its pressed pixels, which are few.
namespace tabor::contact {

/// Map of pressure in the memory of the pixels that have some: 12 bytes each.
class PressureList {
 public:
  PressureList() = default;  ///< no map
  /// Takes what is not zero of a map [Pa].
  PressureList(const Field& pressure);  // NOLINT(google-explicit-constructor): the same pressure

  bool empty() const { return rows_ == 0 || cols_ == 0; }        ///< no map
  Index rows() const { return rows_; }                           ///< of the map
  Index cols() const { return cols_; }                           ///< of the map
  const std::vector<double>& values() const { return values_; }  ///< those that are not zero [Pa]

  /// Returns the map [Pa]; an empty one of no map.
  Field map() const;

 private:
  Index rows_ = 0;
  Index cols_ = 0;
  std::vector<std::uint32_t> pixels_;  ///< ascending
  std::vector<double> values_;
};

}  // namespace tabor::contact
