#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cases {
namespace {

constexpr ColumnStyle kPercent{.shown = Shown::percent};
constexpr ColumnStyle kObjectAlone{.media = media::kObject};
constexpr ColumnStyle kStoreAlone{.media = media::kStore};

const Columns<ToolPlace>& place_columns() {
  static const Columns<ToolPlace> all{{"tool_x_m", "m", "tool at", &ToolPlace::x}};
  return all;
}

}  // namespace

const Columns<ContactRecord>& contact_columns() {
  using Record = ContactRecord;
  static const Columns<contact::Summary> summary{
      {"mean_pressure_Pa", "Pa", "pressure", &contact::Summary::mean_pressure},
      {"contact_area_fraction", "", "contact area", &contact::Summary::contact_area_fraction,
       kPercent},
      {"contact_area_fraction_pixels", "", "counted contact",
       &contact::Summary::contact_area_fraction_pixels, kPercent},
      {"area_correction_valid", "", "", &contact::Summary::area_correction_valid, kObjectAlone},
      {"saturated_area_fraction", "", "saturated", &contact::Summary::saturated_area_fraction,
       kPercent},
      {"mean_gap_m", "m", "mean gap", &contact::Summary::mean_gap},
      {"separation_m", "m", "", &contact::Summary::separation},
      {"approach_m", "m", "", &contact::Summary::approach, kObjectAlone},
      {"max_pressure_Pa", "Pa", "max pressure", &contact::Summary::max_pressure},
      {"elastic_energy_J_per_m2", "J/m^2", "", &contact::Summary::elastic_energy},
      {"n_patches", "", "patches", &contact::Summary::n_patches},
      {"perimeter_m", "m", "", &contact::Summary::perimeter}};
  static const Columns<Record> all = joined<Record>(
      within(summary, &Record::summary),
      {{"certificate",
        "",
        "certificate",
        member_of(&Record::convergence, &Convergence::certificate),
        {.shown = Shown::exponent}},
       {"contact_gap_error_m", "m", "gap error",
        member_of(&Record::summary, &contact::Summary::contact_gap_error)},
       {"tolerance", "", "", member_of(&Record::convergence, &Convergence::tolerance), kStoreAlone},
       {"converged", "", "converged",
        [](const Record& record) { return record.convergence.converged(); }},
       {"status", "", "",
        [](const Record& record) { return std::string(name_of(record.convergence.status)); },
        kObjectAlone},
       {"warning_codes", "", "", [](const Record& record) { return codes_of(record.warnings); },
        kObjectAlone},
       {"iterations", "", "iterations", member_of(&Record::convergence, &Convergence::iterations)},
       {"operator_applications", "", "",
        member_of(&Record::convergence, &Convergence::operator_applications)},
       {"fft_seconds", "s", "", &Record::fft_seconds},
       {"seconds", "s", "time", &Record::seconds},
       {"peak_memory_bytes", "", "", &Record::peak_memory}},
      within(place_columns(), &Record::tool_place));
  return all;
}

const Columns<FilmRecord>& film_columns() {
  using deposition::Film;
  using Record = FilmRecord;
  static const Columns<Film> film{
      {"mean_film_m", "m", "oil as film", &Film::mean_film},
      {"n_droplets", "", "", &Film::n_droplets},
      {"wet_fraction", "", "wet", &Film::wet_fraction, kPercent},
      {"max_film_m", "m", "max film", &Film::max_film},
      {"dosed_volume_m3", "m^3", "", &Film::dosed_volume, kObjectAlone},
      {"deposited_volume_m3", "m^3", "", &Film::deposited_volume},
      {"lost_volume_m3", "m^3", "", &Film::lost_volume},
      {"n_pools", "", "pools", &Film::n_pools},
      {"", "", "droplets", &Film::n_droplets},
      {"", "", "lost", [](const Film& one) { return one.lost_volume / one.dosed_volume; },
       kPercent},
      {"flooded", "", "flooded", &Film::flooded, {.shown = Shown::alarm, .media = media::kObject}},
      {"height_quantum_m", "m", "", &Film::height_quantum, kObjectAlone},
      {"seconds", "s", "time", &Film::seconds}};
  static const Columns<Record> all = joined<Record>(
      joined<Record>({{"lubricant_density_g_per_m2",
                       "g/m²",
                       "density",
                       [](const Record& record) { return in_g_per_m2(record.lubricant_density); },
                       {.shown = Shown::unscaled}}},
                     within(film, &Record::film)),
      {{"peak_memory_bytes", "", "", &Record::peak_memory},
       {"warning_codes", "", "", [](const Record& record) { return codes_of(record.warnings); },
        kObjectAlone}});
  return all;
}

const Columns<FluidRecord>& fluid_columns() {
  using friction::FluidSummary;
  static const Columns<FluidSummary> summary{
      {"fluid_load_share", "", "", &FluidSummary::load_share},
      {"solid_load_share", "", "", &FluidSummary::solid_share},
      {"fluid_max_pressure_Pa", "Pa", "", &FluidSummary::max_pressure},
      {"contact_area_fraction", "", "", &FluidSummary::contact_area_fraction},
      {"contact_area_fraction_pixels", "", "", &FluidSummary::contact_area_fraction_pixels},
      {"lubricated_share", "", "", &FluidSummary::lubricated_share},
      {"fluid_mean_gap_m", "m", "", &FluidSummary::mean_gap},
      {"fluid_full_fraction", "", "", &FluidSummary::full_fraction},
      {"fluid_outside_film_m", "m", "", &FluidSummary::outside_film},
      {"viscous_stress_Pa", "Pa", "", &FluidSummary::viscous_stress},
      {"fluid_load_error", "", "", &FluidSummary::load_error},
      {"fluid_gap_error", "", "", &FluidSummary::gap_error},
      {"fluid_pressure_error", "", "", &FluidSummary::pressure_error},
      {"fluid_evaluations", "", "",
       member_of(&FluidSummary::convergence, &Convergence::iterations)},
      {"fluid_iterations", "", "", &FluidSummary::film_iterations},
      {"converged", "", "", [](const FluidSummary& one) { return one.convergence.converged(); }}};
  static const Columns<FluidRecord> all = within(summary, &FluidRecord::summary);
  return all;
}

const Columns<TrappedRecord>& trapped_columns() {
  using contact::LiquidSummary;
  using contact::Summary;
  using Record = TrappedRecord;
  static const Columns<Summary> solids{
      {"solid_pressure_Pa", "Pa", "", &Summary::mean_pressure},
      {"contact_area_fraction", "", "", &Summary::contact_area_fraction},
      {"contact_area_fraction_pixels", "", "", &Summary::contact_area_fraction_pixels},
      {"mean_gap_m", "m", "", &Summary::mean_gap}};
  static const Columns<LiquidSummary> liquid{
      {"liquid_load_share", "", "", &LiquidSummary::load_share},
      {"max_liquid_pressure_Pa", "Pa", "", &LiquidSummary::max_pressure},
      {"n_pockets", "", "", &LiquidSummary::n_pockets},
      {"n_squeezed", "", "", &LiquidSummary::n_squeezed},
      {"n_at_seal", "", "", &LiquidSummary::n_at_seal},
      {"leaked_fraction", "", "", &LiquidSummary::leaked_fraction},
      {"seals_settled", "", "", &LiquidSummary::seals_settled}};
  static const Columns<Record> all = joined<Record>(
      within(solids, &Record::solids), within(liquid, &Record::liquid),
      Columns<Record>{
          {"lubricated_share", "", "", &Record::lubricated_share},

          {"certificate", "", "", member_of(&Record::convergence, &Convergence::certificate)},
          {"converged", "", "", [](const Record& one) { return one.convergence.converged(); }}});
  return all;
}

const Columns<FrictionRecord>& friction_area_columns() {
  const auto used_as = [](friction::Area area) {
    return [area](const FrictionRecord& record) {
      return record.area == area ? Cell(record.friction_area_fraction) : Cell();
    };
  };
  const auto column = [&](friction::Area area) {
    return Column<FrictionRecord>("", "", std::string(friction::words_of(area)), used_as(area),
                                  kPercent);
  };
  static const Columns<FrictionRecord> all = {column(friction::Area::corrected),
                                              column(friction::Area::pixels)};
  return all;
}

const Columns<TrappedFriction>& trapped_friction_columns() {
  using Record = TrappedFriction;
  static const Columns<Record> all{
      {"liquid_load_share", "", "oil carries", &Record::load_share, kPercent},
      {"max_liquid_pressure_Pa", "Pa", "max oil pressure", &Record::max_pressure},
      {"n_pockets", "", "pockets", &Record::n_pockets},
      {"n_squeezed", "", "squeezed", &Record::n_squeezed},
      {"n_at_seal", "", "at seal", &Record::n_at_seal},
      {"leaked_fraction", "", "leaked", &Record::leaked_fraction, kPercent},
      {"trapped_contact_area_fraction", "", "solid contact", &Record::contact_area_fraction,
       kPercent},
      {"trapped_lubricated_share", "", "of it wet", &Record::lubricated_share, kPercent},
      {"trapped_mean_gap_m", "m", "", &Record::mean_gap},
      {"friction_solid", "", "solid", &Record::friction_solid},
      {"friction_boundary", "", "boundary", &Record::friction_boundary},
      {"trapped_certificate", "", "", &Record::certificate},
      {"trapped_converged", "", "", &Record::converged}};
  return all;
}

namespace {

const Columns<FlowingFriction>& flowing_columns() {
  using Record = FlowingFriction;
  static const Columns<Record> all{
      {"sliding_speed_m_per_s", "m/s", "", &Record::sliding_speed, {.media = media::kRow}},
      {"fluid_load_share", "", "oil carries", &Record::load_share, kPercent},
      {"fluid_max_pressure_Pa", "Pa", "", &Record::max_pressure, kObjectAlone},
      {"fluid_contact_area_fraction", "", "", &Record::contact_area_fraction},
      {"fluid_mean_gap_m", "m", "", &Record::mean_gap},
      {"fluid_full_fraction", "", "", &Record::full_fraction, kObjectAlone},
      {"fluid_outside_film_m", "m", "", &Record::outside_film, kObjectAlone},
      {"friction_solid", "", "", &Record::friction_solid},
      {"friction_viscous", "", "viscous", &Record::friction_viscous},
      {"friction_mixed", "", "friction mixed", &Record::friction_mixed},
      {"fluid_load_error", "", "", &Record::load_error},
      {"fluid_gap_error", "", "", &Record::gap_error},
      {"fluid_pressure_error", "", "", &Record::pressure_error},
      {"fluid_evaluations", "", "", &Record::evaluations, kObjectAlone},
      {"fluid_iterations", "", "", &Record::iterations, kObjectAlone},
      {"fluid_converged", "", "", &Record::converged}};
  return all;
}

const Columns<ToolFriction>& tool_columns() {
  using Record = ToolFriction;
  static const Columns<ToolSpread> spread{
      {"friction_area_fraction_std", "", "± area", &ToolSpread::area_fraction, kPercent},
      {"friction_dry_std", "", "± dry", &ToolSpread::friction_dry},
      {"friction_lubricated_std", "", "± wet", &ToolSpread::friction_lubricated}};
  static const Columns<Record> all =
      joined<Record>({{"tool_places", "", "", &Record::n_places}},
                     within(place_columns(), &Record::place), within(spread, &Record::spread));
  return all;
}

Columns<FrictionRecord> columns_before_the_film() {
  using Record = FrictionRecord;
  constexpr ColumnStyle stored_and_tabled{.media = media::kStore | media::kTable};
  return {{"mean_pressure_Pa", "Pa", "pressure", &Record::mean_pressure},
          {"lubricant_density_kg_per_m2", "kg/m^2", "", &Record::lubricant_density, kStoreAlone},
          {"lubricant_density_g_per_m2",
           "g/m²",
           "lubricant",
           [](const Record& record) { return in_g_per_m2(record.lubricant_density); },
           {.shown = Shown::unscaled, .media = media::kObject | media::kCsv | media::kTable}},
          {"contact_area_fraction", "", "", &Record::contact_area_fraction},
          {"contact_area_fraction_pixels", "", "", &Record::contact_area_fraction_pixels},
          {"saturated_area_fraction", "", "", &Record::saturated_area_fraction},
          {"mean_gap_m", "m", "", &Record::mean_gap},
          {"separation_m", "m", "", &Record::separation, kObjectAlone},
          {"mean_film_m",
           "m",
           "",
           &Record::mean_film,
           {.media = media::kObject | media::kStore | media::kTable}},
          {"", "", "film / gap", [](const Record& one) { return one.mean_film / one.mean_gap; },
           kPercent},
          friction_area_columns()[0],
          friction_area_columns()[1],
          {"lubricated_share", "", "wet share", &Record::lubricated_share, kPercent},
          {"spill_over_fraction", "", "spill-over", &Record::spill_over_fraction, kPercent},
          {"trapped_fraction",
           "",
           "",
           &Record::trapped_fraction,
           {.media = media::kObject | media::kStore | media::kTable}},
          {"escaping_fraction", "", "", &Record::escaping_fraction, stored_and_tabled},
          {"area", "", "", [](const Record& record) { return friction::name(record.area); },
           kObjectAlone},
          {"boundary_shear_strength_Pa", "Pa", "", &Record::boundary_shear_strength, kObjectAlone},
          {"friction_area_fraction", "", "", &Record::friction_area_fraction, kObjectAlone},
          {"dry_at_bound", "", "", &Record::dry_at_bound, kObjectAlone},
          {"friction_dry", "", "friction dry", &Record::friction_dry},
          {"friction_lubricated", "", "friction wet", &Record::friction_lubricated},
          {"certificate", "", "", &Record::certificate},
          {"contact_gap_error_m", "m", "", &Record::contact_gap_error, kObjectAlone},
          {"converged", "", "", &Record::converged}};
}

}  // namespace

FrictionParts parts_of(const CaseSettings& settings) {
  return {.trapped = settings.trapped.is_asked(),
          .fluid = settings.fluid.flows(),
          .tool = settings.contact.tool.is_rough()};
}

FrictionParts parts_of(const FrictionRecord& record) {
  return {.trapped = record.trapped.has_value(),
          .fluid = record.fluid.has_value(),
          .tool = record.tool.has_value()};
}

Columns<FrictionRecord> friction_columns(const FrictionParts& parts) {
  using Record = FrictionRecord;
  Columns<Record> all = columns_before_the_film();
  if (parts.tool) all = joined<Record>(all, within(tool_columns(), &Record::tool));
  if (parts.trapped) {
    all = joined<Record>(all, within(trapped_friction_columns(), &Record::trapped));
  }
  if (parts.fluid) all = joined<Record>(all, within(flowing_columns(), &Record::fluid));
  return joined<Record>(
      all, {{"", "", "certificate", &Record::certificate, {.shown = Shown::exponent}},
            {"", "", "converged", &Record::converged},
            {"warning_codes", "", "", [](const Record& one) { return codes_of(one.warnings); },
             kObjectAlone}});
}

}  // namespace tabor::cases
