#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "tabor/cases/parameters.hpp"
#include "tabor/scan/read_parameters.hpp"
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

/// "key = value" of a parameter as a study file has it; "" without a value.
std::string line_of(const ParameterHead& parameter, const Cell& cell) {
  const std::string key = parameter.study_name();
  if (const auto* word = std::get_if<std::string>(&cell)) {
    return fmt::format("{} = {}\n", key, toml_text(*word));
  }
  if (const auto* count = std::get_if<std::uint64_t>(&cell)) {
    return fmt::format("{} = {}\n", key, *count);
  }
  if (const auto* flag = std::get_if<bool>(&cell)) return fmt::format("{} = {}\n", key, *flag);
  const auto* number = std::get_if<double>(&cell);
  if (number == nullptr || std::isnan(*number)) return "";
  if (std::isinf(*number)) return fmt::format("{} = {}\n", key, toml_text(parameter.none));
  const std::string unit = si_unit(parameter.dimension);
  return fmt::format("{} = {}\n", key, unit.empty() ? decimal(*number) : quantity(*number, unit));
}

/// Returns the line of a list of numbers, of one alone where all are alike.
std::string line_of(const ParameterHead& parameter, const std::vector<double>& numbers) {
  if (numbers.empty()) return "";
  const bool are_alike = std::count(numbers.begin(), numbers.end(), numbers.front()) ==
                         static_cast<std::ptrdiff_t>(numbers.size());
  if (are_alike) return line_of(parameter, Cell(numbers.front()));
  return fmt::format("{} = {}\n", parameter.study_name(),
                     quantities(numbers, si_unit(parameter.dimension)));
}

/// The lines of one table, "material"; "" is the head of the file.
template <typename Settings>
std::string lines_of(std::string_view table, const Parameters<Settings>& parameters,
                     const Settings& settings) {
  std::string lines;
  for (const Parameter<Settings>& one : parameters) {
    if (!one.is_in_table(table)) continue;
    lines += one.kind == ValueKind::numbers ? line_of(one, one.numbers(settings))
                                            : line_of(one, one.value(settings));
  }
  return lines;
}

std::string lubricant_table(const cases::CaseSettings& settings) {
  std::string text =
      "\n[lubricant]\n" + lines_of("lubricant", cases::film_parameters(), settings.film);
  if (settings.friction.dry_below > 0) {
    text += lines_of("lubricant", cases::friction_parameters(), settings.friction);
  }
  if (settings.trapped.is_asked()) {
    text += lines_of("lubricant", cases::trapped_parameters(), settings.trapped);
  }
  if (settings.fluid.flows()) {
    text += lines_of("lubricant", cases::fluid_parameters(), settings.fluid);
  }
  return text;
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
  return text + lines_of("treatment", scan::read_parameters(), scan.read) + own_lines(scan.own);
}

/// True if any treatment says what lies beyond the edges.
bool steps_say_edges(const Study& study) {
  return topography::edges_of(study.treatment) ||
         std::any_of(study.scans.begin(), study.scans.end(), [](const Scan& scan) {
           return topography::edges_of(scan.own.treatment.value_or(topography::Treatment{}));
         });
}

std::string edges_line(const Study& study) {
  return study.edges ? fmt::format("edges = {}\n", toml_text(topography::kEdges.of(*study.edges)))
                     : "";
}

/// The boundary in force, nothing where edges decide about it.
std::optional<cases::Boundary> boundary_of(const Study& study) {
  const cases::ContactSettings& contact = study.settings.contact;
  if (contact.boundary || !(study.edges || steps_say_edges(study))) {
    return contact.boundary_in_force();
  }
  return std::nullopt;
}

}  // namespace

std::string to_toml(const Study& study) {
  const cases::CaseSettings& settings = study.settings;
  std::string text = fmt::format("title = {}\n", toml_text(study.title));
  text += lines_of("", cases::friction_parameters(), settings.friction);
  text += "\n[material]\n" + lines_of("material", cases::contact_parameters(), settings.contact);
  text += fmt::format("\n[treatment]\nsteps = {}\n", step_list(study.treatment));
  cases::ContactSettings contact = settings.contact;
  contact.boundary = boundary_of(study);
  text += "\n[contact]\n" + edges_line(study) +
          lines_of("contact", cases::contact_parameters(), contact);
  text += "\n[sweep]\n";
  if (!settings.mean_pressures.empty()) {  // unless every scan has its own
    text += fmt::format("mean_pressure = {}\n", quantities(settings.mean_pressures, "Pa"));
  }
  text += fmt::format("lubricant_density = {}\n",
                      quantities(settings.film.lubricant_densities, "kg/m^2"));
  if (study.flows()) {
    text += fmt::format("sliding_speed = {}\n", quantities(study.sliding_speeds, "m/s"));
  }
  text += lubricant_table(settings);
  if (study.slide) {
    text += "\n[slide]\n" + lines_of("slide", cases::slide_parameters(), *study.slide);
  }
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
