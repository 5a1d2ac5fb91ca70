#include "tabor/cases/slide/slide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tabor/cases/parameters.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

// The settings of sliding and the columns of its states.
namespace tabor::cases {
namespace {

constexpr double kMostPixels = 1e5;  // of one distance: more take days, and the tool wears, too

}  // namespace

double distance_of(const SlideSettings& sliding, const Tool& tool, double dx) {
  if (sliding.step && *sliding.step < 0.5 * dx) {
    throw InputError("<step>", format_si(*sliding.step, "m"),
                     "at least a pixel, " + format_si(dx, "m"), "");
  }
  const double most = kMostPixels * dx;
  const double distance = sliding.distance.value_or(std::min(kMostPasses * tool.grid.lx, most));
  if (distance >= 0.5 * dx && distance <= most) return distance;
  throw InputError("<distance>", format_si(distance, "m"),
                   fmt::format("one to {} pixels, {} to {}", kMostPixels, format_si(dx, "m"),
                               format_si(most, "m")),
                   "");
}

const Parameters<SlideSettings>& slide_parameters() {
  using Settings = SlideSettings;
  using One = tabor::Parameter<Settings>;
  static const Parameters<Settings> table{
      One({.name = "distance",
           .help = "distance of sliding",
           .example = "100 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .study_key = "slide.distance",
           .placeholder = "L",
           .absent = "20 lengths of the tool, with until_steady",
           .identity = Identity::yes},
          &Settings::distance),
      One({.name = "step",
           .help = "distance between two contacts, rounded to whole pixels",
           .example = "1.34 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .study_key = "slide.step",
           .placeholder = "S",
           .absent = "auto",
           .none = "auto",
           .identity = Identity::yes},
          &Settings::step),
      One({.name = "every",
           .help = "distance between two states of the table",
           .example = "10 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .study_key = "slide.every",
           .placeholder = "L",
           .absent = "a twentieth of the distance",
           .identity = Identity::yes},
          &Settings::every),
      One({.name = "displaced",
           .help = "where displaced material goes: up beside its contact, evenly over the sheet, "
                   "or away",
           .example = "near",
           .study_key = "slide.displaced",
           .identity = Identity::yes},
          &Settings::displaced, sliding::kDisplaced),
      One({.name = "reach",
           .help = "width over which displaced material rises beside its contact, at least two "
                   "pixels",
           .example = "2 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .study_key = "slide.reach",
           .placeholder = "L",
           .identity = Identity::yes},
          &Settings::reach),
      One({.name = "wear_coefficient",
           .help = "Archard's k: depth worn off per distance and pressure where solids touch",
           .example = "1e-15 m^2/N",
           .dimension = dimension::per_pressure,
           .unit = "m^2/N",
           .bounds = bounds::above_zero,
           .study_key = "slide.wear_coefficient",
           .placeholder = "K",
           .absent = "no wear",
           .identity = Identity::yes},
          &Settings::wear_coefficient),
      One({.name = "hardening",
           .help = "rise of the saturation pressure of a pixel per depth of yielding",
           .example = "100 MPa/um",
           .dimension = dimension::pressure_gradient,
           .bounds = bounds::above_zero,
           .study_key = "slide.hardening",
           .placeholder = "H",
           .absent = "none",
           .identity = Identity::unless_default},
          &Settings::hardening),
      One({.name = "liquid",
           .help = "oil stays on its pixels (lower bound of friction), or is squeezed out of "
                   "contacts (upper bound), or both are computed",
           .example = "both",
           .study_key = "slide.liquid",
           .identity = Identity::yes},
          &Settings::liquid, kSlidingOils),
      One({.name = "until_steady",
           .help = "end early once a period of the tool displaces under 1 % of the first and "
                   "friction changes by under 1 %",
           .study_key = "slide.until_steady",
           .identity = Identity::unless_default},
          &Settings::until_steady),
      One({.name = "maps_at",
           .help = "distances at which maps are saved, in addition to both ends",
           .example = "20 um,50 um",
           .dimension = dimension::length,
           .bounds = bounds::zero_or_more,
           .placeholder = "L[,L2,...]",
           .absent = "both ends"},
          &Settings::maps_at)};
  static const Parameters<Settings> all = grouped("Sliding", table);
  return all;
}

SlideParts parts_of(const CaseSettings& settings, const SlideSettings& sliding) {
  const bool has_oil = !settings.film.lubricant_densities.empty();
  return {.kept = has_oil && sliding.liquid != SlidingOil::squeezed,
          .squeezed = has_oil && sliding.liquid != SlidingOil::kept,
          .trapped = has_oil && settings.trapped.is_asked(),
          .lost = sliding.displaced == sliding::Displaced::lost,
          .worn = sliding.wear_coefficient.has_value(),
          .hardened = sliding.hardening.has_value()};
}

Columns<SlideRecord> slide_columns(const SlideParts& parts) {
  using Record = SlideRecord;
  constexpr ColumnStyle percent{.shown = Shown::percent};
  // What a run has not stands in its files all the same, and leaves the table of the terminal.
  const auto shown = [](bool is_there, const char* heading) { return is_there ? heading : ""; };
  Columns<Record> all{
      {"distance_m", "m", "distance", &Record::distance},
      {"mean_pressure_Pa", "Pa", "", member_of(&Record::contact, &contact::Summary::mean_pressure)},
      {"contact_area_fraction", "", "",
       member_of(&Record::contact, &contact::Summary::contact_area_fraction)},
      {"contact_area_fraction_pixels", "", "counted contact",
       member_of(&Record::contact, &contact::Summary::contact_area_fraction_pixels), percent},
      {"saturated_area_fraction", "", "",
       member_of(&Record::contact, &contact::Summary::saturated_area_fraction)},
      {"highest_saturation_pressure_Pa", "Pa", shown(parts.hardened, "p_sat up to"),
       &Record::highest_saturation_pressure},
      {"mean_gap_m", "m", "mean gap", member_of(&Record::contact, &contact::Summary::mean_gap)},
      {"mean_film_m", "m", "", &Record::mean_film},
      {"", "", shown(parts.kept || parts.squeezed, "film / gap"),
       [](const Record& one) { return one.mean_film / one.contact.mean_gap; }, percent},
      {"lubricated_share", "", shown(parts.kept, "wet share"), &Record::lubricated_share, percent},
      {"squeezed_lubricated_share", "", shown(parts.squeezed, "if squeezed"),
       &Record::squeezed_share, percent},
      {"friction_dry", "", "friction dry", &Record::friction_dry},
      {"friction_lubricated", "", shown(parts.kept, "friction wet"), &Record::friction_lubricated},
      {"friction_lubricated_squeezed", "", shown(parts.squeezed, "if squeezed"),
       &Record::friction_squeezed},
      {"friction_ploughing", "", "of it ploughing", &Record::friction_ploughing},
      {"friction_ploughing_lower", "", "at least", &Record::friction_ploughing_lower},
      {"friction_ploughing_upper", "", "at most", &Record::friction_ploughing_upper},
      {"step_certificate", "", "", &Record::step_certificate},
      {"squeezed_film_m", "m", "", &Record::squeezed_film},
      {"squeezed_away_m", "m", "", &Record::squeezed_away},
      {"moved_volume_m3_per_m2", "m", "moved", &Record::moved_volume},
      {"lost_volume_m3_per_m2", "m", shown(parts.lost, "lost"), &Record::lost_volume},
      {"worn_volume_m3_per_m2", "m", shown(parts.worn, "worn"), &Record::worn_volume},
      {"rms_height_m", "m", "Sq", &Record::rms_height},
      {"mean_roughness_m", "m", "", &Record::mean_roughness},
      {"core_height_m", "m", "", &Record::core_height},
      {"peak_height_m", "m", "", &Record::peak_height},
      {"dale_height_m", "m", "", &Record::dale_height},
      {"certificate", "", "", &Record::certificate},
      {"converged", "", "converged", &Record::converged}};
  if (!parts.trapped) return all;
  Columns<TrappedFriction> trapped = trapped_friction_columns();
  for (Column<TrappedFriction>& one : trapped) {
    if (one.key != "liquid_load_share") one.heading.clear();
  }
  return joined<Record>(all, within(trapped, &Record::trapped));
}

std::vector<std::string> references_of(const CaseSettings& settings, const SlideSettings& sliding) {
  std::vector<std::string> all = references_of(settings.contact);
  if (!settings.film.lubricant_densities.empty()) {
    add(references_of(settings.film), all);
    add(references_of(settings.trapped), all);
  }
  add(references_of(settings.friction), all);
  add({"goddard1962"}, all);
  if (sliding.displaced == sliding::Displaced::uniform) add({"pullen1972"}, all);
  if (sliding.wear_coefficient) add({"archard1953"}, all);
  return all;
}

std::optional<Objection> objection(const SlideSettings& settings, const CaseSettings& all,
                                   const Spelling& spelling) {
  if (!all.contact.tool.is_rough()) {
    return objection_to_use(
        "tool", fmt::format("sliding needs a rough tool; give {}, a scan or e.g. ground:Sa=0.1um",
                            spelling("tool")));
  }
  if (!all.contact.saturation_pressure && !settings.wear_coefficient) {
    return objection_to_use(
        "saturation_pressure",
        fmt::format("sliding needs {} or {}, because an elastic contact displaces nothing",
                    spelling("saturation_pressure"), spelling("wear_coefficient")));
  }
  if (settings.hardening && !all.contact.saturation_pressure) {
    return objection_to_use("hardening", fmt::format("hardening needs {}, because an elastic "
                                                     "sheet does not harden",
                                                     spelling("saturation_pressure")));
  }
  if (settings.hardening && all.trapped.is_asked()) {
    return objection_to_use(
        "hardening", fmt::format("trapped oil is not solved on a sheet that hardens; leave out {}",
                                 spelling("trapped")));
  }
  if (all.mean_pressures.size() != 1 || all.film.lubricant_densities.size() > 1) {
    const std::string setting =
        all.mean_pressures.size() != 1 ? "mean_pressure" : "lubricant_density";
    return objection_to_use(
        setting,
        fmt::format("give one {}, because the sheet changes as it slides", spelling(setting)));
  }
  if (all.contact.load_path) {
    return objection_to_use(
        "load_path",
        fmt::format("leave out {}, because sliding keeps the displaced material in any case",
                    spelling("load_path")));
  }
  if (all.trapped.is_asked() && all.film.lubricant_densities.empty()) {
    return objection_to_use("trapped", fmt::format("{} needs oil; give {}", spelling("trapped"),
                                                   spelling("lubricant_density")));
  }
  if (auto found = objection_to_trapped(all, spelling)) return found;
  if (auto found = objection_to_bounds(slide_parameters(), settings)) return found;
  if (!settings.distance && !settings.until_steady) {
    return objection_to_use(
        "distance", fmt::format("the distance is missing; give {} or {}", spelling("distance"),
                                spelling("until_steady")));
  }
  const double distance = settings.distance.value_or(std::numeric_limits<double>::infinity());
  if (settings.step && *settings.step > distance) {
    return Objection{.setting = "step",
                     .got = format_si(*settings.step, "m"),
                     .expected = "at most the distance, " + format_si(distance, "m")};
  }
  for (const double place : settings.maps_at) {
    if (place > distance) {
      return Objection{.setting = "maps_at",
                       .got = format_si(place, "m"),
                       .expected = "at most the distance, " + format_si(distance, "m")};
    }
  }
  return std::nullopt;
}

}  // namespace tabor::cases
