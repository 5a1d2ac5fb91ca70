#include <fmt/format.h>

#include "tabor/cases/slide/slide.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cases {
namespace {

constexpr double kMilling = 0.05;  // of Sq: more has left the sheet than its roughness bears

}  // namespace

Warnings of_sliding(const sliding::Ploughing& all, double mean_pressure, double rms_height,
                    double tool_length, std::optional<bool> steady) {
  constexpr double often = 2;  // passes of the tool, after which the sheet has its envelope
  Warnings list;
  if (steady == false) {
    list.push_back({"not-steady",
                    fmt::format("Sliding is not steady after {}. The sheet still changes, and "
                                "friction with it",
                                format_si(all.distance, "m")),
                    0});
  }
  if (const double passes = all.distance / tool_length; passes > often) {
    list.push_back({"tool-envelope",
                    fmt::format("The tool of {} has passed {:.1f} times: the sheet takes its "
                                "envelope. Use a longer tool",
                                format_si(tool_length, "m"), passes),
                    passes});
  }
  if (const double apart = all.certificate(mean_pressure); apart > kFineStep) {
    list.push_back(
        {"tool-pixel",
         fmt::format("The bounds on ploughing differ by {:.2g} of its value, because the step "
                     "does not resolve the tool along x",
                     apart),
         apart});
  }
  if (all.lost > kMilling * rms_height) {
    list.push_back({"milling",
                    fmt::format("A layer of {} is worn off a sheet with an Sq of {}. Let displaced "
                                "material rise instead",
                                format_si(all.lost, "m"), format_si(rms_height, "m")),
                    all.lost / rms_height});
  }
  return list;
}

}  // namespace tabor::cases
