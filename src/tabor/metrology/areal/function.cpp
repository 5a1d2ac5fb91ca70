// Material ratio parameters: what the Abbott curve says of core, peaks and valleys.
#include <fmt/format.h>

#include "tabor/metrology/areal/abbott.hpp"
#include "tabor/metrology/areal/sets.hpp"

namespace tabor::metrology {
namespace {

constexpr double kSxpUpper = 2.5, kSxpLower = 50;  ///< [%] ISO 25178-3

}  // namespace

std::vector<Parameter> function_parameters(const AbbottCurve& curve,
                                           const ParameterOptions& options) {
  const Core core = curve.core();
  const CoreLine& line = core.line;
  const double p = options.peak_ratio, q = options.valley_ratio;
  const std::string of_line =
      "the least-squares line over the 40 % of the Abbott curve with the "
      "flattest secant";
  std::vector<Parameter> found{
      {"Sk", core.height, "m", "core height: fall of " + of_line + ", 0 % to 100 %"},
      {"Spk", core.peak_height, "m",
       "reduced peak height 2 A1/Smrk1, A1 = 100 <max(z - line(0 %), 0)>"},
      {"Svk", core.dale_height, "m",
       "reduced dale height 2 A2/(100 - Smrk2), A2 = 100 <max(line(100 %) - z, 0)>"},
      {"Smrk1", core.peak_ratio, "%", "share of area above line(0 %), the hills above the core"},
      {"Smrk2", core.dale_ratio, "%",
       "share of area above line(100 %), all but the dales below the core"},
      {"Spkx", curve.highest() - line.upper, "m", "height of the highest peak above line(0 %)"},
      {"Svkx", line.lower - curve.lowest(), "m", "depth of the deepest pit below line(100 %)"},
      {"Sxp", curve.height_at(kSxpUpper) - curve.height_at(kSxpLower), "m",
       "peak extreme height Smc(2.5 %) - Smc(50 %)"},
      {"Sdc", curve.height_at(p) - curve.height_at(q), "m",
       fmt::format("material ratio height difference Smc({:g} %) - Smc({:g} %)", p, q)},
      {"Smc(p)", curve.height_at(p), "m",
       fmt::format("height above the mean with a material ratio of p = {:g} %", p)},
      {"Smc(q)", curve.height_at(q), "m",
       fmt::format("height above the mean with a material ratio of q = {:g} %", q)},
      {"Smr(c)", curve.ratio_above(options.smr_height), "%",
       fmt::format("material ratio: share of area above c = {:g} m from the mean",
                   options.smr_height)},
  };
  if (curve.size() < 2) {
    for (Parameter& parameter : found) {
      if (std::isnan(parameter.value)) parameter.note = "needs two valid points";
    }
  }
  return found;
}

std::vector<Parameter> volume_parameters(const AbbottCurve& curve,
                                         const ParameterOptions& options) {
  const double p = options.peak_ratio, q = options.valley_ratio;
  const double peak = curve.height_at(p), valley = curve.height_at(q);
  const double material_p = curve.material_above(peak), material_q = curve.material_above(valley);
  const double void_p = curve.void_below(peak), void_q = curve.void_below(valley);
  const std::string unit = "m^3/m^2";
  const auto with_p = [&](const char* text) { return fmt::format("{} p = {:g} %", text, p); };
  const auto with_both = [&](const char* text) {
    return fmt::format("{} p = {:g} %, q = {:g} %", text, p, q);
  };
  return {
      {"Vm(p)", material_p, unit, with_p("material volume <max(z - Smc(p), 0)>,")},
      {"Vv(p)", void_p, unit, with_p("void volume <max(Smc(p) - z, 0)>,")},
      {"Vmp", material_p, unit, with_p("peak material volume Vm(p),")},
      {"Vmc", material_q - material_p, unit, with_both("core material volume Vm(q) - Vm(p),")},
      {"Vvc", void_p - void_q, unit, with_both("core void volume Vv(p) - Vv(q),")},
      {"Vvv", void_q, unit, fmt::format("dale void volume Vv(q), q = {:g} %", q)},
  };
}

}  // namespace tabor::metrology
