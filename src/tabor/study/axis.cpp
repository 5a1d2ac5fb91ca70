#include "tabor/study/axis.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

namespace tabor::study {
namespace {

std::optional<Quantity> quantity_in(const std::string& value) {
  try {
    return parse_quantity(value);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// [SI]
std::optional<double> number_in(const std::string& value) {
  const std::optional<Quantity> quantity = quantity_in(value);
  return quantity ? std::optional(quantity->value) : std::nullopt;
}

struct NamedDimension {
  Dimension dimension;
  const char* unit;
};

/// Units of the keys that cases have.
constexpr NamedDimension kUnits[] = {
    {dimension::none, ""},          {dimension::length, "m"},
    {dimension::pressure, "Pa"},    {dimension::speed, "m/s"},
    {dimension::viscosity, "Pa s"}, {dimension::per_pressure, "1/Pa"},
    {dimension::force, "N"},        {dimension::force_per_length, "N/m"},
    {dimension::mass, "kg"},        {dimension::mass_per_length, "kg/m"},
    {dimension::time, "s"},         {dimension::temperature, "K"}};

}  // namespace

std::vector<double> SweepAxis::numbers() const {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    numbers.push_back(number_in(value).value_or(static_cast<double>(numbers.size())));
  }
  return numbers;
}

bool SweepAxis::has_words() const {
  return std::any_of(values.begin(), values.end(),
                     [](const std::string& value) { return !number_in(value); });
}

std::string SweepAxis::unit() const {
  const std::optional<Quantity> first = quantity_in(values.front());
  if (!first) return "";
  for (const NamedDimension& named : kUnits) {
    if (named.dimension == first->dimension) return named.unit;
  }
  return "SI";
}

std::vector<Places> combinations(const std::vector<SweepAxis>& axes) {
  std::vector<Places> all = {{}};
  for (const SweepAxis& axis : axes) {
    std::vector<Places> longer;
    for (const Places& places : all) {
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        longer.push_back(places);
        longer.back().push_back(i);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::size_t> solving_order(const std::vector<SweepAxis>& axes,
                                       const std::vector<Places>& all,
                                       const std::vector<std::string>& downwards) {
  std::vector<double> others_first(all.size() * axes.size() * 2, 0);
  const std::size_t width = axes.size() * 2;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::vector<double> numbers = axes[a].numbers();
    const bool goes_down =
        std::find(downwards.begin(), downwards.end(), axes[a].key) != downwards.end();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t place = all[i][a];
      if (goes_down) {
        others_first[i * width + axes.size() + a] = -numbers[place];
      } else {
        others_first[i * width + a] = static_cast<double>(place);
      }
    }
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return others_first.begin() + std::ptrdiff_t(i * width); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::lexicographical_compare(key(a), key(a + 1), key(b), key(b + 1));
  });
  return order;
}

}  // namespace tabor::study
