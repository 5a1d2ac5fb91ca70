#include <fmt/format.h>

#include <cstdint>

#include "tabor/cases/states.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/results/fields_file.hpp"

// Fills the result file of contacts, films and frictions.
namespace tabor::results {

namespace {

double x_of(const cases::ContactRecord& record) {
  return record.tool_place ? record.tool_place->x : 0;
}

/// Returns what tells a contact from the others of its surface: along a load path, two of one
/// pressure differ in their separation.
std::string owner_of(const cases::ContactRecord& record) {
  return fmt::format("{} {} {}", record.summary.mean_pressure, record.summary.separation,
                     x_of(record));
}

template <typename Settings>
ResultHead head_of(const FieldsTarget& target, const Settings& settings) {
  return {target.command, toml_of(settings_json(settings)), cases::references_of(settings)};
}

}  // namespace

std::vector<StateField> fields_of(const cases::ContactRecord& record) {
  std::vector<StateField> fields{
      {"pressure", "Pa", "contact pressure", record.state.pressure},
      {"gap", "m", "gap between the deformed surface and what presses on it", record.state.gap}};
  if (record.tool) {
    fields.push_back({"tool", "m", "heights of the tool, towards the surface", *record.tool,
                      fmt::format("{}", x_of(record))});
  }
  return fields;
}

std::vector<StateField> fields_of(const cases::FilmRecord& record) {
  return {{"film_thickness", "m", "thickness of the lubricant film", record.film.thickness}};
}

std::vector<StateField> fields_of(const cases::TrappedRecord& record) {
  return {{"liquid_pressure", "Pa", "pressure of the trapped oil", record.state.liquid_pressure},
          {"trapped_pressure", "Pa", "pressure of solids and trapped oil",
           record.state.contact.pressure},
          {"trapped_gap", "m", "gap over the trapped oil", record.state.contact.gap}};
}

std::vector<StateField> fields_of(const cases::FluidRecord& record) {
  return {
      {"fluid_pressure", "Pa", "pressure of the oil", record.state.film.pressure},
      {"fluid_fill", "1", "share of the gap that oil fills while sliding", record.state.film.fill},
      {"fluid_gap", "m", "gap while sliding", record.state.contact.gap},
      {"fluid_solid_pressure", "Pa", "contact pressure while sliding",
       record.state.contact.pressure}};
}

std::vector<StateField> fields_of(const cases::ContactRecord& contact, const cases::Oil& oil) {
  std::vector<StateField> fields = fields_of(contact);
  for (StateField& field : fields) {
    if (field.owner.empty()) field.owner = owner_of(contact);
  }
  for (StateField& field : fields_of(oil.film)) {
    field.owner = fmt::format("{}", oil.film.lubricant_density);
    fields.push_back(field);
  }
  const auto add = [&fields](const auto* record) {
    if (record == nullptr) return;
    for (const StateField& field : fields_of(*record)) fields.push_back(field);
  };
  add(oil.trapped);
  add(oil.fluid);
  return fields;
}

io::ByteMap contact_map(const contact::State& state, double saturation_pressure) {
  return contact::contact_mask(state).cast<std::uint8_t>() +
         contact::saturated_mask(state, saturation_pressure).cast<std::uint8_t>();
}

FieldsFile::FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
                       const cases::ContactSettings& settings)
    : FieldsFile(target.file, target.options, head_of(target, settings), surface, target.origin) {
  cap_ = settings.pressure_cap();
}

FieldsFile::FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
                       const cases::FilmSettings& settings)
    : FieldsFile(target.file, target.options, head_of(target, settings), surface, target.origin) {}

FieldsFile::FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
                       const cases::CaseSettings& settings)
    : FieldsFile(target.file, target.options, head_of(target, settings), surface, target.origin) {
  cap_ = settings.contact.pressure_cap();
}

FieldsFile::FieldsFile(const FieldsTarget& target, const topography::Topography& surface,
                       const cases::CaseSettings& settings, const cases::SlideSettings& sliding)
    : FieldsFile(target.file, target.options,
                 {target.command, toml_of(settings_json(settings, sliding)),
                  cases::references_of(settings, sliding)},
                 surface, target.origin) {}

void FieldsFile::write_contact(std::size_t number, const contact::State& state,
                               const std::string& owner) {
  if (options_.fields == Fields::none) return;
  const std::string path = state_group(number) + "/state";
  if (!is_first("state", owner, path)) return;
  writer_.write(path, contact_map(state, cap_));
  writer_.describe(path, "1", kContactMap);
  writer_.attach_axes(path);
}

void FieldsFile::add(std::size_t number, const cases::ContactRecord& record) {
  add_state(number, cells_of(cases::contact_columns(), record, cases::media::kObject),
            fields_of(record));
  write_contact(number, record.state, "");
}

void FieldsFile::add(std::size_t number, const cases::FilmRecord& record) {
  add_state(number, cells_of(cases::film_columns(), record, cases::media::kObject),
            fields_of(record));
}

void FieldsFile::add(std::size_t number, const cases::FrictionRecord& record,
                     const cases::ContactRecord& contact, const cases::Oil& oil) {
  add_state(number, cells_of(cases::friction_columns(), record, cases::media::kObject),
            fields_of(contact, oil));
  write_contact(number, contact.state, owner_of(contact));
}

namespace {

std::vector<StateField> fields_of(const cases::SlideState& state) {
  if (state.maps == nullptr) return {};
  const cases::SlideMaps& maps = *state.maps;
  std::vector<StateField> fields{
      {"sheet", "m", "heights of the sheet after the contact, unloaded", maps.sheet},
      {"pressure", "Pa", "contact pressure", maps.pressure},
      {"gap", "m", "gap between the sheet and the tool", maps.gap}};
  if (state.film != nullptr) {
    fields.push_back({"film_thickness", "m", "oil that stays on its pixels", *state.film, "film"});
  }
  const auto add = [&fields](const char* name, const char* unit, const char* text,
                             const Field& map) {
    if (map.size() > 0) fields.push_back({name, unit, text, map});
  };
  add("squeezed_film", "m", "oil that contacts squeeze out, as this one meets it", maps.squeezed);
  add("liquid_pressure", "Pa", "pressure of the trapped oil", maps.liquid_pressure);
  add("saturation_pressure", "Pa", "pressure at which the sheet yields here",
      maps.saturation_pressure);
  return fields;
}

}  // namespace

void FieldsFile::add(std::size_t number, const cases::SlideState& state,
                     const cases::SlideParts& parts) {
  add_state(number, cells_of(cases::slide_columns(parts), state.numbers, cases::media::kObject),
            fields_of(state));
  if (state.maps != nullptr && options_.fields != Fields::none) {
    const std::string path = state_group(number) + "/state";
    writer_.write(path, state.maps->state);
    writer_.describe(path, "1", kContactMap);
    writer_.attach_axes(path);
  }
  write_spectra(fmt::format("/spectra/{:04}", number), state.spectra);
}

void FieldsFile::add_run(const cases::SlideResult& result) {
  write_spectra("/spectra/before", result.before);
  writer_.attribute("/states", "step_m", result.step);
  writer_.attribute("/states", "steps", static_cast<std::int64_t>(result.steps));
  if (result.steady) writer_.attribute("/states", "steady", std::int64_t{*result.steady});
  writer_.attribute("/states", "history", result.after.history.back());
}

void FieldsFile::write_spectra(const std::string& group, const cases::SheetSpectra& spectra) {
  const auto write = [&](const char* name, const char* unit, const std::vector<double>& list) {
    if (list.empty()) return;
    const std::string path = group + "/" + name;
    writer_.write(path, list);
    writer_.describe(path, unit, "");
  };
  writer_.group(group);
  write("q_x_rad_per_m", "rad/m", spectra.q_x);
  write("psd_x_m3", "m^3", spectra.density_x);
  write("q_y_rad_per_m", "rad/m", spectra.q_y);
  write("psd_y_m3", "m^3", spectra.density_y);
}

}  // namespace tabor::results
