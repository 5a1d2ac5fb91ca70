#include "tabor/material/library.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::material {
namespace {

const char* const kSheets = "Costagliola et al. 2022";
const char* const kTables =
    "Kaye & Laby, Tables of Physical and Chemical Constants, 16th ed., 2.2.2";
const char* const kEurocode = "EN 1993-1-1, 3.2.6, for structural steel";
// Tabor 1951, The Hardness of Metals: a fully plastic contact bears 2.8 times the yield stress.
const char* const kDeepDrawing =
    "2.8 times (Tabor 1951) the largest yield strength of EN 10130, 210 MPa";
const char* const kMises =
    "the largest yield strength of EN 10130, 210 MPa, over sqrt(3) (von Mises)";
const char* const kRockwell = "60 HRC, which is 697 HV by ISO 18265, as a mean pressure";
const char* const kPeek = "Victrex, data sheet of PEEK 450G";
const char* const kTreloar =
    "Treloar 1975, The Physics of Rubber Elasticity: shear modulus 0.39 MPa, incompressible";

}  // namespace

const std::vector<NamedSolid>& solids() {
  static const std::vector<NamedSolid> all = {
      {"aluminium-6016",
       "aluminium sheet, in the numbers of the sliding tests of Costagliola et al.",
       {70e9, kSheets},
       {0.33, kSheets},
       Sourced{240e6, kSheets},
       Sourced{70e6, kSheets}},
      {"copper", "pure copper", {129.8e9, kTables}, {0.343, kTables}, {}, {}},
      {"glass", "crown glass", {71.3e9, kTables}, {0.22, kTables}, {}, {}},
      {"peek", "PEEK, not filled, at 23 °C", {4.0e9, kPeek}, {0.4, kPeek}, {}, {}},
      {"rubber", "vulcanised natural rubber", {1.17e6, kTreloar}, {0.5, kTreloar}, {}, {}},
      {"steel-100cr6",
       "bearing steel 100Cr6, hardened to 60 HRC",
       {210e9, kEurocode},
       {0.3, kEurocode},
       Sourced{6.84e9, kRockwell},
       {}},
      {"steel-dc04",
       "deep-drawing steel sheet DC04",
       {210e9, kEurocode},
       {0.3, kEurocode},
       Sourced{590e6, kDeepDrawing},
       Sourced{121e6, kMises}}};
  return all;
}

const NamedSolid& find_solid(std::string_view name) {
  const std::string wanted = lower(name);
  std::vector<std::string> names;
  std::vector<const NamedSolid*> of_family;
  for (const NamedSolid& solid : solids()) {
    if (solid.name == wanted) return solid;
    if (split(solid.name, '-').front() == wanted) of_family.push_back(&solid);
    names.push_back(solid.name);
  }
  if (of_family.size() == 1) return *of_family.front();
  throw InputError("material", fmt::format("'{}'{}", name, suggestion(wanted, names)),
                   fmt::format("{}", fmt::join(names, ", ")), "");
}

}  // namespace tabor::material
