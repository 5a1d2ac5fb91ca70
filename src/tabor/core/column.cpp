#include "tabor/core/column.hpp"

#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"

namespace tabor {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <typename Value>
const Value& text_in(const Cell& cell, const char* expected) {
  if (const auto* value = std::get_if<Value>(&cell); value != nullptr) return *value;
  throw InputError("a value of a record", "another kind of value", expected, "");
}

bool is_number(const Cell& cell) { return cell.index() >= 1 && cell.index() <= 4; }

void require_number(const Cell& cell) {
  if (!is_number(cell)) throw InputError("a value of a record", "no number", "a number", "");
}

}  // namespace

std::string_view name_of(Shown style) {
  static constexpr auto kStyles =
      names<Shown>("by_unit", "unscaled", "percent", "exponent", "alarm");
  return kStyles.of(style);
}

double number_in(const Cell& cell) {
  if (!is_number(cell)) return kNone;
  return std::visit(
      [](const auto& value) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
          return static_cast<double>(value);
        } else {
          return kNone;
        }
      },
      cell);
}

void assign(const Cell& cell, double& target) {
  require_number(cell);
  target = number_in(cell);
}

void assign(const Cell& cell, std::optional<double>& target) {
  require_number(cell);
  const double value = number_in(cell);
  target = std::isnan(value) ? std::nullopt : std::optional(value);
}

void assign(const Cell& cell, bool& target) {
  require_number(cell);
  target = number_in(cell) != 0;
}

void assign(const Cell& cell, std::string& target) {
  target = text_in<std::string>(cell, "a text");
}

void assign(const Cell& cell, std::vector<std::string>& target) {
  target = text_in<std::vector<std::string>>(cell, "a list of texts");
}

std::int64_t integer_in(const Cell& cell) {
  if (const auto* value = std::get_if<std::uint64_t>(&cell)) {
    return static_cast<std::int64_t>(*value);
  }
  if (const auto* value = std::get_if<std::int64_t>(&cell)) return *value;
  const double value = number_in(cell);
  if (!(std::abs(value) < 0x1p63)) {
    throw InputError("a value of a record", "no count", "a count", "");
  }
  return std::llround(value);
}

}  // namespace tabor
