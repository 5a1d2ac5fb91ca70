#include "tabor/forming/comments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/version.hpp"

namespace tabor::forming {
namespace {

constexpr std::size_t kWidth = 80;  // what the narrowest reader, that of LS-DYNA, takes of a line

/// "7 MPa, 0.45 g/m^2, 0.1 m/s": as the result has it, for those who look it up there.
std::string text_of(const Condition& at) {
  std::string text = fmt::format("{}, {} g/m^2", format_si(at.mean_pressure, "Pa"),
                                 in_g_per_m2(at.lubricant_density));
  if (at.sliding_speed) text += ", " + format_si(*at.sliding_speed, "m/s");
  return text;
}

std::string line_of(const LeftOut& one) {
  std::string scans;
  for (const std::string& scan : one.scans) scans += (scans.empty() ? "" : ", ") + scan;
  if (one.whole) {
    return fmt::format("left out: {}: {}{}", text_of(one.at), one.code,
                       scans.empty() ? "" : " (" + scans + ")");
  }
  return fmt::format("mean without {}: {}: {}", scans, text_of(one.at), one.code);
}

template <typename Value>
std::string range_of(const FrictionTable& table, const std::string& name, const std::string& unit,
                     const Value& value) {
  const auto [low, high] = std::minmax_element(
      table.entries.begin(), table.entries.end(),
      [&](const FrictionEntry& a, const FrictionEntry& b) { return value(a) < value(b); });
  const std::string first = digits(value(*low));
  const std::string last = digits(value(*high));
  return fmt::format("{} {}{} {}", name, first, first == last ? "" : " to " + last, unit);
}

/// What the numbers span: beyond it a program extrapolates.
std::string ranges_of(const FrictionTable& table, const UnitSystem& units) {
  std::string text = "range: " + range_of(table, "pressure", units.pressure.name, [&](auto& one) {
                       return units.pressure.of(one.at.mean_pressure);
                     });
  text += "; " + range_of(table, "density", units.areal_density.name, [&](auto& one) {
            return units.areal_density.of(one.at.lubricant_density);
          });
  if (!table.has_speeds()) return text + "; any sliding speed";
  return text + "; " + range_of(table, "speed", units.speed.name, [&](auto& one) {
           return units.speed.of(*one.at.sliding_speed);
         });
}

std::string counts_of(const FrictionTable& table) {
  const auto [least, most] =
      std::minmax_element(table.entries.begin(), table.entries.end(),
                          [](const FrictionEntry& a, const FrictionEntry& b) { return a.n < b.n; });
  std::string text = fmt::format("numbers: {}, ", table.entries.size());
  text += least->n == most->n
              ? fmt::format("each the mean of {} scan{}", most->n, most->n == 1 ? "" : "s")
              : fmt::format("means of {} to {} scans", least->n, most->n);
  const std::size_t n = n_left_out(table);
  const std::string fewer = reasons_for_fewer_scans(table);
  if (!fewer.empty()) text += fmt::format("; over fewer scans: {}", fewer);
  return text +
         (n == 0 ? "; none left out" : fmt::format("; {} left out ({})", n, reasons_of(table)));
}

/// Bytes that go into a line of this width: up to a space, if there is one, else whole characters.
std::size_t end_of_line(const std::string& text, std::size_t limit) {
  if (text.size() <= limit) return text.size();
  const std::size_t space = text.rfind(' ', limit);
  if (space != std::string::npos && space > 0) return space;
  std::size_t end = limit;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // within UTF-8
  return end;
}

}  // namespace

std::string digits(double value) { return fmt::format("{:.10g}", value); }

std::string density_text(double lubricant_density, const UnitSystem& units) {
  return fmt::format("lubricant density {} {} ({} g/m^2{})",
                     digits(units.areal_density.of(lubricant_density)), units.areal_density.name,
                     in_g_per_m2(lubricant_density), lubricant_density == 0 ? ", dry" : "");
}

std::vector<std::string> head_of(const FrictionTable& table, const UnitSystem& units,
                                 const std::string& program) {
  if (table.entries.empty()) throw InputError("friction table", "no number", "one at least", "");
  std::vector<std::string> lines = {
      fmt::format("friction coefficients for {}, by tabor {}", program, kVersion)};
  lines.insert(lines.end(), table.origin.begin(), table.origin.end());
  if (!table.group.empty()) lines.push_back("group: " + table.group);
  lines.push_back(fmt::format(
      "units: {}: pressure in {}, sliding speed in {}, lubricant density in {} (1 g/m^2 is {})",
      units.words, units.pressure.name, units.speed.name, units.areal_density.name,
      digits(units.areal_density.of(1e-3))));
  lines.push_back(ranges_of(table, units));
  lines.push_back(counts_of(table));
  for (const LeftOut& one : table.left_out) lines.push_back(line_of(one));
  return lines;
}

std::string comments(const std::string& mark, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    std::string rest = printable(line);
    std::string indent = " ";
    do {
      const std::size_t end = end_of_line(rest, kWidth - mark.size() - indent.size());
      text += mark + indent + rest.substr(0, end) + '\n';
      rest = std::string(trim(rest.substr(end)));
      indent = "   ";
    } while (!rest.empty());
  }
  return text;
}

}  // namespace tabor::forming
