#include "tabor/study/study.hpp"

namespace tabor::study {

std::string study_template() {
  return R"(# A study: scans x pressures x lubricant densities. Lines that begin with # show what else there is.
title = "Sheets before sliding"
# shear_strength = "70 MPa"               # of the contact; else that of the material
# boundary_shear_strength = "5 MPa"       # of contact that stands in liquid; nothing if left out
# boundary_shear_share = 0.1              # the same as a share of shear_strength
# area = "pixels"                         # what friction counts: pixels or corrected

[material]
name = "aluminium-6016"                   # 'tabor materials' lists them; or, or to override:
# youngs_modulus = "70 GPa"
# poissons_ratio = 0.33
# saturation_pressure = "240 MPa"         # cap on the contact pressure; "none": elastic
# counter_youngs_modulus = "210 GPa"      # of the flat; rigid if left out
# counter_poissons_ratio = 0.3

[treatment]
steps = ["level=plane"]                   # in this order, as 'tabor params --help' names them
# channel = "1"                           # height channel, as in 'tabor info'
# pixel = "0.67 um"                       # where files have none
# unit = "um"

[contact]
# boundary = "periodic"                   # or free
# solver = "fast"                         # or polonsky-keer
# tolerance = 1e-6

[sweep]
mean_pressure = ["2 MPa", "7 MPa", "15 MPa"]
lubricant_density = ["0.45 g/m^2", "0.9 g/m^2"]
# sliding_speed = ["0.01 m/s", "0.1 m/s"] # with fluid = "reynolds"

[lubricant]
# oil_density = "900 kg/m^3"
# model = "droplets"                      # or limit, bottom-fill, uniform
# reading = "conserving"                  # or literal
# edge = "closed"                         # or periodic, open
# droplet = "0.1 um"
# seed = 1
# fluid = "reynolds"                      # the oil flows, carries load and shears; with:
# viscosity = "0.1 Pa s"
# pressure_viscosity = "2e-8 1/Pa"
# eyring_stress = "5 MPa"

[[scan]]
file = "surfaces/edt_before.x3p"          # or a pattern, "scans/before_*.x3p"; from this file's folder
group = "before"                          # averages are taken over a group
# channel = "1"                           # of these scans alone, as the rest of this table:
# pixel = "0.67 um"
# unit = "um"
# pressure = "7 MPa"
# density = "0 g/m^2"
# treatment = ["level=plane", "lowpass=hann:4.5um"]
# contact = "elastic"                     # or saturated
# reading = "literal"

# [experiment]
# file = "measured.csv"                   # friction to compare with; docs/results.md says its columns
)";
}

}  // namespace tabor::study
