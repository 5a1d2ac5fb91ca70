#include "tabor/cases/parameters.hpp"

#include <algorithm>
#include <utility>

namespace tabor::cases {
namespace {

constexpr const char* kContactGroup = "Contact";
constexpr const char* kMaterialGroup = "Material";

const Bounds kPoissonsRatio{
    .least = -1, .most = 0.5, .least_is_out = true, .text = "above -1 and at most 0.5"};
const Bounds kTolerance{.least = 1e-12, .most = 1e-4, .text = "1e-12 to 1e-4"};
const Bounds kBulkModulus{
    .least = 0, .least_is_out = true, .infinity_is_in = true, .text = "more than zero, or inf"};
const Bounds kShare{.least = 0, .most = 1, .text = "a share of the shear strength, 0 to 1"};

Cell tau_of_wet_contact(const FrictionSettings& one) {
  const double strength = one.boundary_strength();
  return strength > 0 ? Cell(strength) : Cell();
}

}  // namespace

const Parameters<ContactSettings>& contact_parameters() {
  using Settings = ContactSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "youngs_modulus",
           .help = "Young's modulus of the rough body",
           .example = "70 GPa",
           .dimension = dimension::pressure,
           .bounds = bounds::above_zero,
           .study_key = "material.youngs_modulus",
           .placeholder = "E",
           .group = kMaterialGroup,
           .is_of_material = true,
           .needed = Needed::unless_material},
          &Settings::youngs_modulus),
      One({.name = "poissons_ratio",
           .help = "Poisson's ratio of the rough body",
           .example = "0.33",
           .bounds = kPoissonsRatio,
           .study_key = "material.poissons_ratio",
           .flag = "--poisson-ratio",
           .placeholder = "NU",
           .group = kMaterialGroup,
           .is_of_material = true,
           .needed = Needed::unless_material},
          &Settings::poissons_ratio),
      One({.name = "counter_youngs_modulus",
           .help = "Young's modulus of the flat",
           .example = "210 GPa",
           .dimension = dimension::pressure,
           .bounds = bounds::above_zero,
           .study_key = "material.counter_youngs_modulus",
           .placeholder = "E2",
           .absent = "rigid",
           .group = kMaterialGroup},
          &Settings::counter_youngs_modulus),
      One({.name = "counter_poissons_ratio",
           .help = "Poisson's ratio of the flat",
           .example = "0.3",
           .bounds = kPoissonsRatio,
           .study_key = "material.counter_poissons_ratio",
           .flag = "--counter-poisson-ratio",
           .placeholder = "NU2",
           .group = kMaterialGroup},
          &Settings::counter_poissons_ratio),
      One({.name = "saturation_pressure",
           .help = "largest contact pressure, at which the body yields",
           .example = "240 MPa",
           .dimension = dimension::pressure,
           .bounds = bounds::above_zero,
           .study_key = "material.saturation_pressure",
           .placeholder = "PS",
           .absent = "none",
           .none = "none",
           .group = kMaterialGroup,
           .is_of_material = true,
           .identity = Identity::yes},
          &Settings::saturation_pressure)
          .with_identifying_value([](const Settings& one) { return Cell(one.pressure_cap()); }),
      One({.name = "boundary",
           .help = "the surface repeats, or ends at its borders and stands alone",
           .example = "periodic",
           .study_key = "contact.boundary",
           .absent = "periodic",
           .identity = Identity::yes},
          &Settings::boundary, kBoundaries)
          .with_value_in_force([](const Settings& one) {
            return Cell(std::string(kBoundaries.of(one.boundary_in_force())));
          }),
      One({.name = "solver",
           .help = "solver of the contact; polonsky-keer is the textbook method",
           .example = "fast",
           .study_key = "contact.solver",
           .identity = Identity::yes},
          &Settings::solver, kSolvers),
      One({.name = "tolerance",
           .help = "certificate to reach, from 1e-12 to 1e-4",
           .example = "1e-6",
           .bounds = kTolerance,
           .study_key = "contact.tolerance",
           .placeholder = "T",
           .identity = Identity::yes},
          &Settings::tolerance),
      One({.name = "load_path",
           .help = "take the pressures as one history, in which each state starts from the "
                   "plastic indentation of the one before"},
          &Settings::load_path)};
  static const Parameters<Settings> with_tool =
      joined(grouped(kContactGroup, all), {within(tool_parameters(), &Settings::tool)});
  return with_tool;
}

const Parameters<FilmSettings>& film_parameters() {
  using Settings = FilmSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "lubricant_density",
           .help = "areal density of the lubricant as applied, a list or a range as for pressures",
           .example = "0.45 g/m^2,0.9 g/m^2",
           .dimension = dimension::areal_density,
           .bounds = bounds::zero_or_more,
           .study_key = "sweep.lubricant_density",
           .flag = "--density",
           .placeholder = "D[,D2,...]",
           .argument = "density",
           .needed = Needed::yes},
          &Settings::lubricant_densities),
      One({.name = "oil_density",
           .help = "density of the oil itself",
           .example = "900 kg/m^3",
           .dimension = dimension::density,
           .bounds = bounds::above_zero,
           .study_key = "lubricant.oil_density",
           .placeholder = "RHO",
           .identity = Identity::yes},
          &Settings::oil_density),
      One({.name = "model",
           .help = "oil settles as droplets that run downhill, as their limit for vanishing size, "
                   "to one level, or as a constant film",
           .example = "droplets",
           .study_key = "lubricant.model",
           .identity = Identity::yes},
          &Settings::model, deposition::kModels),
      One({.name = "reading",
           .help = "excess of a droplet that fills a depression: conserve or drop",
           .example = "conserving",
           .study_key = "lubricant.reading",
           .identity = Identity::yes},
          &Settings::reading, deposition::kReadings),
      One({.name = "edge",
           .help = "oil at the border of the scan stays, reappears at the opposite side, or leaves",
           .example = "closed",
           .study_key = "lubricant.edge",
           .identity = Identity::yes},
          &Settings::edge, deposition::kEdges),
      One({.name = "droplet_height",
           .help = "size of a droplet, as its volume over the area of a pixel",
           .example = "0.1 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .study_key = "lubricant.droplet",
           .flag = "--droplet",
           .placeholder = "D",
           .identity = Identity::yes},
          &Settings::droplet_height),
      One({.name = "seed",
           .help = "seed of the random places where droplets fall",
           .example = "1",
           .study_key = "lubricant.seed",
           .placeholder = "S",
           .identity = Identity::yes},
          &Settings::seed)};
  static const Parameters<Settings> all = grouped("Oil", table);
  return all;
}

const Parameters<TrappedSettings>& trapped_parameters() {
  using Settings = TrappedSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "trapped",
           .help = "let oil in closed pockets of the gap carry load, as far as their seals hold",
           .study_key = "lubricant.trapped"},
          &Settings::trapped),
      One({.name = "bulk_modulus",
           .help = "bulk modulus of the trapped oil; inf makes it incompressible",
           .example = "1.5 GPa",
           .dimension = dimension::pressure,
           .bounds = kBulkModulus,
           .study_key = "lubricant.bulk_modulus",
           .placeholder = "K",
           .none = "inf",
           .identity = Identity::yes},
          &Settings::bulk_modulus)};
  static const Parameters<Settings> all = grouped("Oil", table);
  return all;
}

const Parameters<FluidSettings>& fluid_parameters() {
  using Settings = FluidSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "fluid",
           .help = "with reynolds the oil flows and carries part of the load",
           .example = "none",
           .study_key = "lubricant.fluid"},
          &Settings::fluid, kFluids),
      One({.name = "sliding_speed",
           .help = "sliding speed along +x",
           .example = "5 mm/s",
           .dimension = dimension::speed,
           .bounds = bounds::zero_or_more,
           .study_key = "sweep.sliding_speed",
           .flag = "--speed",
           .placeholder = "U",
           .argument = "speed",
           .identity = Identity::yes},
          &Settings::sliding_speed),
      One({.name = "viscosity",
           .help = "dynamic viscosity of the oil",
           .example = "0.225 Pa s",
           .dimension = dimension::viscosity,
           .bounds = bounds::above_zero,
           .study_key = "lubricant.viscosity",
           .placeholder = "ETA",
           .identity = Identity::yes},
          &Settings::viscosity),
      One({.name = "pressure_viscosity",
           .help = "growth of the viscosity with pressure, by Roelands' law",
           .example = "2e-8 1/Pa",
           .dimension = dimension::per_pressure,
           .bounds = bounds::above_zero,
           .study_key = "lubricant.pressure_viscosity",
           .placeholder = "ALPHA",
           .absent = "constant",
           .identity = Identity::yes},
          &Settings::pressure_viscosity),
      One({.name = "eyring_stress",
           .help = "Ree-Eyring stress of the oil",
           .example = "5 MPa",
           .dimension = dimension::pressure,
           .bounds = bounds::above_zero,
           .study_key = "lubricant.eyring_stress",
           .placeholder = "TAU",
           .absent = "Newtonian",
           .identity = Identity::yes},
          &Settings::eyring_stress)};
  static const Parameters<Settings> all = grouped("Flowing oil", table);
  return all;
}

const Parameters<FrictionSettings>& friction_parameters() {
  using Settings = FrictionSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "shear_strength",
           .help = "shear strength of the contact",
           .example = "70 MPa",
           .dimension = dimension::pressure,
           .bounds = bounds::above_zero,
           .study_key = "shear_strength",
           .placeholder = "TAU",
           .is_of_material = true,
           .needed = Needed::unless_material,
           .identity = Identity::yes},
          &Settings::shear_strength),
      One({.name = "boundary_shear_strength",
           .help = "shear strength of wet contact, at most that of the contact",
           .example = "5 MPa",
           .dimension = dimension::pressure,
           .bounds = bounds::zero_or_more,
           .study_key = "boundary_shear_strength",
           .placeholder = "TAU_B",
           .absent = "0",
           .identity = Identity::yes},
          &Settings::boundary_shear_strength)
          .with_value_in_force(tau_of_wet_contact),
      One({.name = "boundary_shear_share",
           .help = "shear strength of wet contact as a share of that of dry contact",
           .example = "0.1",
           .bounds = kShare,
           .study_key = "boundary_shear_share",
           .placeholder = "X"},
          &Settings::boundary_shear_share)
          .with_value_in_force([](const Settings&) { return Cell(); }),  // the strength says it
      One({.name = "area",
           .help = "area that friction uses: the contact area corrected for its perimeter, or the "
                   "counted pixels",
           .example = "pixels",
           .study_key = "area",
           .absent = "pixels with a saturation pressure, else corrected"},
          &Settings::area, friction::kAreas),
      One({.name = "dry_below",
           .help = "a film up to this thickness counts as dry",
           .example = "2 nm",
           .dimension = dimension::length,
           .bounds = bounds::zero_or_more,
           .study_key = "lubricant.dry_below",
           .placeholder = "T",
           .absent = "0 nm",
           .group = "Oil",
           .identity = Identity::unless_default},
          &Settings::dry_below)};
  static const Parameters<Settings> all = grouped("Friction", table);
  return all;
}

const Parameters<CaseSettings>& case_parameters() {
  static const Parameters<CaseSettings> all = [] {
    Parameters<CaseSettings> list{
        {{.name = "mean_pressure",
          .help = "mean pressure (load over nominal area), a list or a range such as "
                  "2MPa..15MPa:7 (five values without :7) or 1MPa..100MPa:log:5",
          .example = "2 MPa,7 MPa",
          .dimension = dimension::pressure,
          .bounds = bounds::above_zero,
          .study_key = "sweep.mean_pressure",
          .flag = "--pressure",
          .placeholder = "P[,P2,...]",
          .argument = "pressure",
          .needed = Needed::yes},
         &CaseSettings::mean_pressures},
        {{.name = "separation",
          .help = "instead of pressures: height of the flat above the mean height of a levelled "
                  "surface, a list or a range as for pressures",
          .example = "0.5 um",
          .dimension = dimension::length,
          .placeholder = "D[,D2,...]"},
         &CaseSettings::separations},
        {{.name = "force",
          .help = "instead of pressures: force on the whole surface, which must end (boundary "
                  "free), a list or a range as for pressures",
          .example = "1 N",
          .dimension = dimension::force,
          .bounds = bounds::above_zero,
          .placeholder = "F[,F2,...]"},
         &CaseSettings::forces}};
    list = grouped(kContactGroup, std::move(list));
    for (const Parameters<CaseSettings>& part :
         {within(contact_parameters(), &CaseSettings::contact),
          within(film_parameters(), &CaseSettings::film),
          within(trapped_parameters(), &CaseSettings::trapped),
          within(fluid_parameters(), &CaseSettings::fluid),
          within(friction_parameters(), &CaseSettings::friction)}) {
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return all;
}

const ParameterHead* find_parameter(std::string_view name) {
  const auto& all = case_parameters();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ParameterHead& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace tabor::cases
