#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

bool is_asked(const io::Config& config) {
  return config.has("lubricant.fluid") &&
         at_key(config, "lubricant.fluid", [](const std::string& name) {
           return analysis::kFluids.parse(name, "fluid film") == analysis::Fluid::reynolds;
         });
}

void reject_idle_keys(const io::Config& config) {
  for (const char* key : {"sweep.sliding_speed", "lubricant.viscosity",
                          "lubricant.pressure_viscosity", "lubricant.eyring_stress"}) {
    if (config.has(key)) {
      reject(config, key, "a key of a film that flows", "lubricant.fluid = \"reynolds\" with it");
    }
  }
}

}  // namespace

void read_flowing_oil(const io::Config& config, Study& study) {
  if (!is_asked(config)) {
    reject_idle_keys(config);
    return;
  }
  analysis::FluidSettings& oil = study.settings.fluid;
  oil.fluid = analysis::Fluid::reynolds;
  oil.viscosity = positive(config, "lubricant.viscosity", dimension::viscosity);
  if (config.has("lubricant.pressure_viscosity")) {
    oil.pressure_viscosity =
        positive(config, "lubricant.pressure_viscosity", dimension::per_pressure);
  }
  if (config.has("lubricant.eyring_stress")) {
    oil.eyring_stress = positive(config, "lubricant.eyring_stress", dimension::pressure);
  }
  at_key(config, "lubricant.viscosity",
         [&](const std::string&) { return friction::lubricant_of(oil.oil()); });
  study.sliding_speeds = read_axis(config, "sweep.sliding_speed", dimension::speed, true);
  if (!study.settings.contact.is_periodic()) {
    reject(config, "contact.boundary", "'free'",
           "'periodic': a film that flows is solved on a patch that repeats");
  }
}

}  // namespace tabor::study
