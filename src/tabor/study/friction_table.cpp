#include "tabor/study/friction_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/averages.hpp"

namespace tabor::study {
namespace {

using forming::FrictionTable;

constexpr double kSameDensity = 1e-9;  // of a density: the rounding of its unit

using Place = std::tuple<double, double, std::optional<double>>;  ///< density, pressure, speed
Place place_of(const forming::Condition& at) {
  return {at.lubricant_density, at.mean_pressure, at.sliding_speed};
}

std::vector<std::string> groups_of(const std::vector<FrictionNumber>& numbers) {
  std::vector<std::string> groups;
  for (const FrictionNumber& number : numbers) {
    if (std::find(groups.begin(), groups.end(), number.group) == groups.end()) {
      groups.push_back(number.group);
    }
  }
  return groups;
}

std::string chosen_group(const std::vector<FrictionNumber>& numbers,
                         const std::optional<std::string>& asked) {
  const std::vector<std::string> groups = groups_of(numbers);
  if (!asked && groups.size() == 1) return groups.front();
  const bool is_there = asked && std::find(groups.begin(), groups.end(), *asked) != groups.end();
  if (is_there) return *asked;
  if (asked && groups.size() == 1 && groups.front().empty()) {
    throw InputError("<group>", fmt::format("'{}'", *asked), "scans in groups; these have none",
                     "leave it out");
  }
  throw InputError(asked ? "<group>" : "several groups of scans",
                   asked ? fmt::format("'{}'{}", *asked, suggestion(*asked, groups)) : "",
                   fmt::format("one of: {}", fmt::join(groups, ", ")),
                   asked ? "" : "choose one by <group>");
}

std::vector<FrictionNumber> of_group(const std::vector<FrictionNumber>& numbers,
                                     const std::string& group) {
  std::vector<FrictionNumber> all;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(all),
               [&](const FrictionNumber& number) { return number.group == group; });
  return all;
}

/// Without oil only the solids rub, and no warning about the oil counts.
FrictionNumber as_dry(FrictionNumber number) {
  number.at.lubricant_density = 0;
  number.friction = number.friction_dry;
  std::erase_if(number.codes, [](const std::string& code) {
    return code != "not-converged" && code != "implausible-friction";
  });
  return number;
}

/// Dry friction of each scan, once under each pressure and at each speed: where no row is dry, of
/// the first row that converged.
std::vector<FrictionNumber> dry_numbers(const std::vector<FrictionNumber>& numbers) {
  std::map<std::tuple<std::string, double, std::optional<double>>, FrictionNumber> found;
  const auto rank = [](const FrictionNumber& number) {
    return std::tuple(!number.failed && number.converged, number.at.lubricant_density == 0);
  };
  for (const FrictionNumber& number : numbers) {
    const auto [place, is_new] =
        found.try_emplace({number.scan, number.at.mean_pressure, number.at.sliding_speed}, number);
    if (!is_new && rank(number) > rank(place->second)) place->second = number;
  }
  std::vector<FrictionNumber> dry;
  dry.reserve(found.size());
  for (const auto& [place, number] : found) dry.push_back(as_dry(number));
  return dry;
}

std::vector<FrictionNumber> at_density(const std::vector<FrictionNumber>& numbers, double density) {
  if (density == 0) return dry_numbers(numbers);
  std::vector<FrictionNumber> all;
  std::set<std::string> there;
  for (const FrictionNumber& number : numbers) {
    const double other = number.at.lubricant_density;
    if (std::abs(other - density) <= kSameDensity * density) all.push_back(number);
    there.insert(fmt::format("{} g/m^2", in_g_per_m2(other)));
  }
  if (!all.empty()) return all;
  throw InputError("<density>", fmt::format("{} g/m^2", in_g_per_m2(density)),
                   fmt::format("0 g/m^2 (dry) or one of the result: {}", fmt::join(there, ", ")),
                   "");
}

std::vector<double> densities_of(const std::vector<FrictionNumber>& numbers,
                                 const std::vector<double>& asked) {
  std::set<double> densities(asked.begin(), asked.end());
  if (!asked.empty()) return {densities.begin(), densities.end()};
  for (const FrictionNumber& number : numbers) densities.insert(number.at.lubricant_density);
  return {densities.begin(), densities.end()};
}

void check_codes(const std::vector<std::string>& codes) {
  const std::vector<std::string>& known = untrusted_codes();
  for (const std::string& code : codes) {
    if (std::find(known.begin(), known.end(), code) != known.end()) continue;
    throw InputError("<keep>", fmt::format("'{}'{}", code, suggestion(code, known)),
                     fmt::format("{}", fmt::join(known, ", ")), "");
  }
}

/// Why a number cannot be used, the gravest reason; "" if it can.
std::string reason_against(const FrictionNumber& number, const std::vector<std::string>& kept) {
  const auto is_in = [](const std::string& code, const std::vector<std::string>& codes) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
  };
  if (number.failed) return "failed";
  const std::string& unconverged = untrusted_codes().front();
  if (!number.converged && !is_in(unconverged, kept)) return unconverged;
  if (std::isnan(number.friction)) return unconverged;
  for (const std::string& code : untrusted_codes()) {
    if (is_in(code, number.codes) && !is_in(code, kept)) return code;
  }
  return "";
}

/// Reasons for which a scan does not count; for the others the mean over the rest is wrong.
bool concerns_one_scan(const std::string& reason) {
  return reason == "failed" || reason == untrusted_codes().front();
}

/// What the scans say of one condition.
struct Gathered {
  std::vector<double> values;                               ///< that count
  std::map<std::string, std::vector<std::string>> reasons;  ///< with the scans that do not

  /// The reason for which there is no mean; "" if there is one.
  std::string against_mean() const {
    for (const auto& [reason, scans] : reasons) {
      if (!concerns_one_scan(reason)) return reason;
    }
    return values.empty() ? reasons.begin()->first : "";
  }
};

Gathered gather(const std::vector<FrictionNumber>& numbers, const std::vector<std::string>& kept) {
  Gathered gathered;
  for (const FrictionNumber& number : numbers) {
    const std::string reason = reason_against(number, kept);
    if (reason.empty()) {
      gathered.values.push_back(number.friction);
    } else if (std::vector<std::string>& scans = gathered.reasons[reason]; !number.scan.empty()) {
      scans.push_back(number.scan);
    }
  }
  return gathered;
}

/// The numbers of one condition become a mean, or the reason why there is none.
void add_mean(const std::vector<FrictionNumber>& numbers, const std::vector<std::string>& kept,
              FrictionTable& table) {
  const forming::Condition& at = numbers.front().at;
  const Gathered gathered = gather(numbers, kept);
  const std::string reason = gathered.against_mean();
  if (!reason.empty()) {
    table.left_out.push_back({.at = at, .code = reason, .scans = gathered.reasons.at(reason)});
    return;
  }
  for (const auto& [code, scans] : gathered.reasons) {
    table.left_out.push_back({.at = at, .code = code, .scans = scans, .whole = false});
  }
  const Mean mean = mean_of(gathered.values);
  table.entries.push_back({at, mean.mean, mean.standard_deviation, mean.n});
}

}  // namespace

const std::vector<std::string>& untrusted_codes() {
  static const std::vector<std::string> codes = {
      "not-converged", "flood",          "frictionless",  "flooded",    "implausible-friction",
      "fluid-film",    "fluid-pressure", "viscosity-law", "density-law"};
  return codes;
}

std::string refusal_of(const std::vector<std::string>& codes, bool converged) {
  FrictionNumber number;
  number.converged = converged;
  number.codes = codes;
  return reason_against(number, {});
}

std::string refusal_of(const std::vector<FrictionNumber>& numbers) {
  if (numbers.empty()) return "";
  std::vector<FrictionNumber> of_table;
  of_table.reserve(numbers.size());
  for (const FrictionNumber& number : numbers) {
    of_table.push_back(number.at.lubricant_density == 0 ? as_dry(number) : number);
  }
  return gather(of_table, {}).against_mean();
}

FrictionTable friction_table(const FrictionNumbers& numbers, const FrictionTableChoice& choice) {
  check_codes(choice.kept_codes);
  FrictionTable table;
  table.origin = numbers.origin;
  table.group = chosen_group(numbers.numbers, choice.group);
  const std::vector<FrictionNumber> chosen = of_group(numbers.numbers, table.group);
  std::map<Place, std::vector<FrictionNumber>> conditions;
  for (const double density : densities_of(chosen, choice.lubricant_densities)) {
    for (const FrictionNumber& number : at_density(chosen, density)) {
      conditions[place_of(number.at)].push_back(number);
    }
  }
  for (const auto& [place, of_condition] : conditions) {
    add_mean(of_condition, choice.kept_codes, table);
  }
  if (!table.entries.empty()) return table;
  throw InputError("friction table",
                   fmt::format("no number that can be trusted ({})", reasons_of(table)),
                   "one at least",
                   "docs/warnings.md says what to do about each; <keep=CODE> keeps them all the "
                   "same, <density=0g/m^2> takes dry friction");
}

}  // namespace tabor::study
