#include "tabor/study/unit_file.hpp"

namespace tabor::study {
namespace {

/// Numbers of a summary with their names in the file, those of `tabor friction --json` where it
/// has them.
struct Member {
  const char* name;
  double friction::FluidSummary::*value;
};
constexpr Member kMembers[] = {
    {"fluid_load_share", &friction::FluidSummary::load_share},
    {"solid_load_share", &friction::FluidSummary::solid_share},
    {"fluid_max_pressure_Pa", &friction::FluidSummary::max_pressure},
    {"contact_area_fraction", &friction::FluidSummary::contact_area_fraction},
    {"contact_area_fraction_pixels", &friction::FluidSummary::contact_area_fraction_pixels},
    {"lubricated_share", &friction::FluidSummary::lubricated_share},
    {"fluid_mean_gap_m", &friction::FluidSummary::mean_gap},
    {"fluid_full_fraction", &friction::FluidSummary::full_fraction},
    {"fluid_outside_film_m", &friction::FluidSummary::outside_film},
    {"viscous_stress_Pa", &friction::FluidSummary::viscous_stress},
    {"fluid_load_error", &friction::FluidSummary::load_error},
    {"fluid_gap_error", &friction::FluidSummary::gap_error},
    {"fluid_pressure_error", &friction::FluidSummary::pressure_error},
};

/// All but the maps.
StoredFluid fluid_numbers(const io::Hdf5Reader& reader) {
  StoredFluid stored;
  for (const Member& member : kMembers) {
    stored.summary.*member.value = reader.number("/fluid", member.name);
  }
  stored.summary.converged = reader.number("/fluid", "converged") != 0;
  stored.doubts = reader.attribute_texts("/fluid", "warnings");
  return stored;
}

}  // namespace

void write_fluid(const Store& store, const Unit& unit, const Grid& grid,
                 const friction::FluidFilmState& state, const StoredFluid& stored,
                 const Scalars& conditions) {
  const std::string group = "/fluid";
  io::Hdf5Writer writer = unit_writer(store, unit, "fluid");
  writer.axes(group, grid);
  write_map(writer, group, {"fluid_pressure", "Pa", "pressure of the oil"}, state.film.pressure);
  write_map(writer, group, {"fluid_fill", "1", "share of the gap that oil fills while sliding"},
            state.film.fill);
  write_map(writer, group, {"fluid_gap", "m", "gap while sliding"}, state.contact.gap);
  writer.nxdata(group, "fluid_pressure");
  write_attributes(writer, group, conditions);
  for (const Member& member : kMembers) {
    writer.attribute(group, member.name, stored.summary.*member.value);
  }
  writer.attribute(group, "fluid_evaluations", stored.summary.evaluations);
  writer.attribute(group, "fluid_iterations", stored.summary.iterations);
  writer.attribute(group, "converged", stored.summary.converged ? 1.0 : 0.0);
  writer.attribute(group, "warnings", stored.doubts);
  writer.commit();
}

StoredFluid read_fluid(const Store& store, const Unit& unit) {
  return io::read_guarded(store.path(unit), fluid_numbers);
}

}  // namespace tabor::study
