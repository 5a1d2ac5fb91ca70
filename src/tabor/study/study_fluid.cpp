#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

void reject_idle_keys(const io::Config& config) {
  for (const ParameterHead& one : cases::fluid_parameters()) {
    if (one.name != "fluid" && config.has(one.study_key)) {
      reject(config, one.study_key, "a key of a film that flows",
             "lubricant.fluid = \"reynolds\" with it");
    }
  }
}

}  // namespace

void read_flowing_oil(const io::Config& config, Study& study) {
  if (!study.flows()) {
    reject_idle_keys(config);
    return;
  }
  at_key(config, "lubricant.viscosity",
         [&](const std::string&) { return friction::lubricant_of(study.settings.fluid.oil()); });
  const auto& speed = parameter_of(cases::fluid_parameters(), "sliding_speed");
  study.sliding_speeds = read_axis(config, speed.study_key, speed);
  if (!study.settings.contact.is_periodic()) {
    reject(config, "contact.boundary", "'free'",
           "'periodic': a film that flows is solved on a patch that repeats");
  }
}

}  // namespace tabor::study
