#include <fmt/format.h>

#include <string_view>

#include "tabor/study/study.hpp"

namespace tabor::study {
namespace {

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    result += control ? fmt::format("\\u{:04X}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return result + "\"";
}

std::string quantity(double value, std::string_view unit) {
  return toml_text(fmt::format("{:.17g} {}", value, unit));
}

std::string quantities(const std::vector<double>& values, std::string_view unit) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(quantity(value, unit));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string decimal(double value) {
  // TOML tells integers from floats by their look.
  const std::string text = fmt::format("{:.17g}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string solid_lines(double youngs_modulus, double poissons_ratio, std::string_view prefix) {
  return fmt::format("{0}youngs_modulus = {1}\n{0}poissons_ratio = {2}\n", prefix,
                     quantity(youngs_modulus, "Pa"), decimal(poissons_ratio));
}

std::string material_table(const analysis::ContactSettings& contact) {
  std::string text =
      "\n[material]\n" + solid_lines(contact.youngs_modulus, contact.poissons_ratio, "");
  if (contact.counter_youngs_modulus) {
    text += solid_lines(*contact.counter_youngs_modulus, contact.counter_poissons_ratio.value_or(0),
                        "counter_");
  }
  if (contact.saturation_pressure) {
    text += fmt::format("saturation_pressure = {}\n", quantity(*contact.saturation_pressure, "Pa"));
  }
  return text;
}

/// Lines of the table [lubricant] that only a film that flows has.
std::string flowing_lines(const analysis::FluidSettings& oil) {
  std::string text =
      fmt::format("fluid = \"reynolds\"\nviscosity = {}\n", quantity(*oil.viscosity, "Pa s"));
  if (oil.pressure_viscosity) {
    text += fmt::format("pressure_viscosity = {}\n", quantity(*oil.pressure_viscosity, "1/Pa"));
  }
  if (oil.eyring_stress) {
    text += fmt::format("eyring_stress = {}\n", quantity(*oil.eyring_stress, "Pa"));
  }
  return text;
}

std::string lubricant_table(const analysis::FilmSettings& lubricant,
                            const analysis::FluidSettings& fluid) {
  const std::string text = fmt::format(
      "\n[lubricant]\noil_density = {}\nmodel = {}\nreading = {}\nedge = {}\ndroplet = {}\n"
      "seed = {}\n",
      quantity(lubricant.oil_density, "kg/m^3"), toml_text(deposition::name(lubricant.model)),
      toml_text(deposition::name(lubricant.reading)), toml_text(deposition::name(lubricant.edge)),
      quantity(lubricant.droplet_height, "m"), lubricant.seed);
  return fluid.flows() ? text + flowing_lines(fluid) : text;
}

std::string step_list(const topography::Treatment& treatment) {
  std::vector<std::string> steps;
  steps.reserve(treatment.size());
  for (const std::string& step : treatment) steps.push_back(toml_text(step));
  return fmt::format("[{}]", fmt::join(steps, ", "));
}

std::string own_lines(const OwnSettings& own) {
  std::string text;
  if (own.mean_pressures) {
    text += fmt::format("pressure = {}\n", quantities(*own.mean_pressures, "Pa"));
  }
  if (own.lubricant_densities) {
    text += fmt::format("density = {}\n", quantities(*own.lubricant_densities, "kg/m^2"));
  }
  if (own.treatment) text += fmt::format("treatment = {}\n", step_list(*own.treatment));
  if (own.deformation) {
    text += fmt::format("contact = {}\n", toml_text(kDeformations.of(*own.deformation)));
  }
  if (own.reading) text += fmt::format("reading = {}\n", toml_text(deposition::name(*own.reading)));
  return text;
}

std::string scan_table(const Scan& scan) {
  std::string text = fmt::format("\n[[scan]]\nfile = {}\ngroup = {}\n", toml_text(scan.label),
                                 toml_text(scan.group));
  if (scan.read.channel) text += fmt::format("channel = {}\n", toml_text(*scan.read.channel));
  if (scan.read.pixel_x) text += fmt::format("pixel = {}\n", quantity(*scan.read.pixel_x, "m"));
  if (scan.read.unit) text += fmt::format("unit = {}\n", toml_text(*scan.read.unit));
  return text + own_lines(scan.own);
}

}  // namespace

std::string to_toml(const Study& study) {
  const analysis::CaseSettings& settings = study.settings;
  std::string text =
      fmt::format("title = {}\nshear_strength = {}\nboundary_shear_strength = {}\n",
                  toml_text(study.title), quantity(settings.friction.shear_strength, "Pa"),
                  quantity(settings.friction.boundary_strength(), "Pa"));
  if (settings.friction.area) {  // otherwise each scan's contact chooses
    text += fmt::format("area = {}\n", toml_text(friction::name(*settings.friction.area)));
  }
  text += material_table(settings.contact);
  text += fmt::format("\n[treatment]\nsteps = {}\n", step_list(study.treatment));
  text += fmt::format("\n[contact]\nboundary = {}\nsolver = {}\ntolerance = {}\n",
                      toml_text(analysis::kBoundaries.of(settings.contact.boundary)),
                      toml_text(analysis::kSolvers.of(settings.contact.solver)),
                      decimal(settings.contact.tolerance));
  text += "\n[sweep]\n";
  if (!settings.mean_pressures.empty()) {  // unless every scan has its own
    text += fmt::format("mean_pressure = {}\n", quantities(settings.mean_pressures, "Pa"));
  }
  text += fmt::format("lubricant_density = {}\n",
                      quantities(settings.film.lubricant_densities, "kg/m^2"));
  if (study.flows()) {
    text += fmt::format("sliding_speed = {}\n", quantities(study.sliding_speeds, "m/s"));
  }
  text += lubricant_table(settings.film, settings.fluid);
  for (const Scan& scan : study.scans) text += scan_table(scan);
  if (study.experiment) {
    text += fmt::format(
        "\n[experiment]\nfile = {}\n",
        toml_text(
            study.experiment->file.lexically_relative(study.file.parent_path()).generic_string()));
  }
  return text;
}

}  // namespace tabor::study
