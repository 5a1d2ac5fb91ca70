#include "tabor/cases/slide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/metrology/areal/parameters.hpp"

namespace tabor::cases {
namespace {

constexpr double kFineStep = 0.3;    // step certificate of a step that is short enough
constexpr double kMilling = 0.05;    // of Sq: more has left the sheet than its roughness bears
constexpr double kUsualStates = 20;  // of one distance
constexpr double kMostPixels = 1e5;  // of one distance: more take days, and the tool wears, too

/// Mean length of the contact along x [pixels].
double mean_patch_length(const Mask& contact) {
  double n_ends = 0;
  for (Index y = 0; y < contact.rows(); ++y) {
    for (Index x = 0; x < contact.cols(); ++x) {
      if (contact(y, x) && !contact(y, (x + 1) % contact.cols())) n_ends += 1;
    }
  }
  return static_cast<double>(contact.count()) / std::max(1.0, n_ends);
}

/// What slides, and the numbers of its states.
class Run {
 public:
  Run(const topography::Topography& surface, const CaseSettings& settings,
      const SlideSettings& sliding, const Observer& observer)
      : surface_(surface),
        settings_(settings),
        sliding_(sliding),
        observer_(observer),
        elasticity_(make_operator(settings.contact, surface.grid)),
        tool_(make_tool(settings.contact.tool, surface.grid, observer)),
        slider_(*elasticity_, problem_of()) {
    result_.after = surface;
    result_.warnings = of_surface(surface);
    add(of_tool(surface, tool_), result_.warnings);
    result_.references = references_of(settings.contact);
    add(references_of(settings.friction), result_.references);
    rain();
  }

  SlideResult run(const std::function<void(const SlideRecord&)>& receive);

 private:
  sliding::Problem problem_of() const;
  void rain();
  Index first_step();
  void take(const sliding::Ploughing& step);
  SlideRecord record() const;
  void warn();
  double pressure() const { return settings_.mean_pressures.front(); }

  const topography::Topography& surface_;
  const CaseSettings& settings_;
  const SlideSettings& sliding_;
  const Observer& observer_;
  std::unique_ptr<elastic::ElasticOperator> elasticity_;
  Tool tool_;
  sliding::Slider slider_;
  std::optional<FilmRecord> film_;
  sliding::Ploughing since_;  // the last state
  sliding::Ploughing all_;
  bool converged_ = true;
  SlideResult result_;
};

sliding::Problem Run::problem_of() const {
  return {.sheet = surface_.height,
          .tool = tool_.height,
          .place = places_of(settings_.contact.tool, tool_).front(),
          .mean_pressure = pressure(),
          .saturation_pressure = settings_.contact.pressure_cap(),
          .displaced = sliding_.displaced,
          .reach = std::max(sliding_.reach, 2 * surface_.grid.dx()),
          .tolerance = settings_.contact.tolerance};
}

void Run::rain() {
  if (settings_.film.lubricant_densities.empty()) return;
  film_ = film_state(surface_, settings_.film, observer_).front();
  add(film_->warnings, result_.warnings);
  add(film_->references, result_.references);
}

void Run::take(const sliding::Ploughing& step) {
  since_ += step;
  all_ += step;
  converged_ = converged_ && slider_.state().convergence.converged();
  if (step.distance > 0) ++result_.steps;
}

SlideRecord Run::record() const {
  SlideRecord one;
  one.distance = all_.distance;
  one.contact = slider_.summary();
  one.friction_ploughing = since_.friction(since_.work, pressure());
  one.friction_ploughing_lower = since_.friction(since_.lower, pressure());
  one.friction_ploughing_upper = since_.friction(since_.upper, pressure());
  one.step_certificate = since_.certificate(pressure());
  const double ploughing = since_.distance > 0 ? one.friction_ploughing : 0;
  if (film_) {
    one.lubricated_share =
        friction::lubricated_share(contact::contact_mask(slider_.state()), film_->film.thickness,
                                   settings_.friction.dry_below);
  }
  const friction::Estimate estimate = estimate_of(one.contact, film_ ? one.lubricated_share : 0,
                                                  settings_.contact, settings_.friction);
  one.friction_dry = estimate.friction_dry + ploughing;
  if (film_) one.friction_lubricated = estimate.friction_lubricated + ploughing;
  one.moved_volume = all_.moved;
  one.lost_volume = all_.lost;
  const Field& sheet = slider_.sheet();
  const double mean = sheet.mean();
  one.rms_height = std::sqrt((sheet - mean).square().mean());
  one.mean_roughness = (sheet - mean).abs().mean();
  one.certificate = slider_.state().convergence.certificate;
  one.converged = converged_;
  return one;
}

/// Takes the first step: that of the settings, else a quarter of the length of the contact patches,
/// halved until the step certificate is small.
Index Run::first_step() {
  const double dx = surface_.grid.dx();
  const sliding::Slider pressed = slider_;
  auto pixels = static_cast<Index>(std::llround(
      sliding_.step ? *sliding_.step / dx
                    : 0.25 * mean_patch_length(contact::contact_mask(slider_.state()))));
  const auto most = static_cast<Index>(std::llround(sliding_.distance / dx));
  pixels = std::clamp<Index>(pixels, 1, most);
  while (true) {
    const sliding::Ploughing step = slider_.advance(pixels, observer_);
    const bool is_fine = !(step.certificate(pressure()) > kFineStep);
    if (sliding_.step || is_fine || pixels == 1) {
      take(step);
      return pixels;
    }
    slider_.restore(pressed);
    pixels /= 2;
  }
}

void Run::warn() {
  add(of_sliding(all_, pressure(), metrology::rms_height(surface_)), result_.warnings);
  if (!converged_) {
    result_.warnings.push_back({"not-converged", "some contacts along the way: NOT CONVERGED",
                                slider_.state().convergence.certificate});
  }
  if (film_) {
    add(of_film_in_gap(film_->film.mean_film, slider_.summary().mean_gap), result_.warnings);
  }
}

SlideResult Run::run(const std::function<void(const SlideRecord&)>& receive) {
  const auto keep = [&] {
    result_.states.push_back(record());
    if (receive) receive(result_.states.back());
    since_ = {};
  };
  take(slider_.press(observer_));
  keep();
  const Index pixels = first_step();
  const double dx = surface_.grid.dx();
  result_.step = static_cast<double>(pixels) * dx;
  const auto n_steps = std::max<Index>(1, std::llround(sliding_.distance / result_.step));
  const double every = sliding_.every.value_or(sliding_.distance / kUsualStates);
  double next = every;
  for (Index i = 1;; ++i) {
    const bool is_last = i == n_steps;
    if (is_last || all_.distance >= next - 0.5 * result_.step) {
      keep();
      next += every;
    }
    if (is_last) break;
    report_progress(observer_, "slide", static_cast<double>(i) / static_cast<double>(n_steps));
    take(slider_.advance(pixels));
  }
  result_.after.height = slider_.sheet();
  result_.after.history.push_back(
      fmt::format("slide: {} under {} in {} steps, {:.4g} m moved", format_si(all_.distance, "m"),
                  format_si(pressure(), "Pa"), result_.steps, all_.moved));
  result_.converged = converged_;
  warn();
  return std::move(result_);
}

Objection use(std::string setting, std::string remedy) {
  return {.setting = std::move(setting),
          .got = "",
          .expected = "",
          .remedy = std::move(remedy),
          .is_about_use = true};
}

}  // namespace

Warnings of_sliding(const sliding::Ploughing& all, double mean_pressure, double rms_height) {
  Warnings list;
  if (const double apart = all.certificate(mean_pressure); apart > kFineStep) {
    list.push_back(
        {"tool-pixel",
         fmt::format("bounds on ploughing differ by {:.2g} of it: the tool is rougher along x than "
                     "the step resolves",
                     apart),
         apart});
  }
  if (all.lost > kMilling * rms_height) {
    list.push_back({"milling",
                    fmt::format("{} of the sheet is worn off, its Sq was {}: material that is kept "
                                "rises beside its contact",
                                format_si(all.lost, "m"), format_si(rms_height, "m")),
                    all.lost / rms_height});
  }
  return list;
}

const Parameters<SlideSettings>& slide_parameters() {
  using Settings = SlideSettings;
  using One = tabor::Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "distance",
           .help = "distance of sliding",
           .example = "100 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .placeholder = "L",
           .needed = Needed::yes},
          &Settings::distance),
      One({.name = "step",
           .help = "distance between two contacts, rounded to whole pixels",
           .example = "1.34 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .placeholder = "S",
           .absent = "auto",
           .none = "auto"},
          &Settings::step),
      One({.name = "every",
           .help = "distance between two states of the table",
           .example = "10 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .placeholder = "L",
           .absent = "a twentieth of the distance"},
          &Settings::every),
      One({.name = "displaced",
           .help = "where displaced material goes: beside its contact, evenly up, or off the sheet",
           .example = "near"},
          &Settings::displaced, sliding::kDisplaced),
      One({.name = "reach",
           .help = "how far displaced material rises beside its contact, at least two pixels",
           .example = "2 um",
           .dimension = dimension::length,
           .bounds = bounds::above_zero,
           .placeholder = "L"},
          &Settings::reach)};
  return all;
}

const Columns<SlideRecord>& slide_columns() {
  using Record = SlideRecord;
  constexpr ColumnStyle percent{.shown = Shown::percent};
  static const Columns<Record> all{
      {"distance_m", "m", "distance", &Record::distance},
      {"mean_pressure_Pa", "Pa", "", member_of(&Record::contact, &contact::Summary::mean_pressure)},
      {"contact_area_fraction", "", "",
       member_of(&Record::contact, &contact::Summary::contact_area_fraction)},
      {"contact_area_fraction_pixels", "", "counted contact",
       member_of(&Record::contact, &contact::Summary::contact_area_fraction_pixels), percent},
      {"saturated_area_fraction", "", "",
       member_of(&Record::contact, &contact::Summary::saturated_area_fraction)},
      {"mean_gap_m", "m", "mean gap", member_of(&Record::contact, &contact::Summary::mean_gap)},
      {"lubricated_share", "", "wet share", &Record::lubricated_share, percent},
      {"friction_dry", "", "friction dry", &Record::friction_dry},
      {"friction_lubricated", "", "friction wet", &Record::friction_lubricated},
      {"friction_ploughing", "", "of it ploughing", &Record::friction_ploughing},
      {"friction_ploughing_lower", "", "at least", &Record::friction_ploughing_lower},
      {"friction_ploughing_upper", "", "at most", &Record::friction_ploughing_upper},
      {"step_certificate", "", "", &Record::step_certificate},
      {"moved_volume_m3_per_m2", "m", "moved", &Record::moved_volume},
      {"lost_volume_m3_per_m2", "m", "lost", &Record::lost_volume},
      {"rms_height_m", "m", "Sq", &Record::rms_height},
      {"mean_roughness_m", "m", "Sa", &Record::mean_roughness},
      {"certificate", "", "", &Record::certificate},
      {"converged", "", "converged", &Record::converged}};
  return all;
}

std::optional<Objection> objection(const SlideSettings& settings, const CaseSettings& all,
                                   const Spelling& spelling) {
  if (!all.contact.tool.is_rough()) {
    return use("tool", fmt::format("sliding needs a rough tool: {0} SCAN, or {0} ground:Sa=0.1um",
                                   spelling("tool")));
  }
  if (!all.contact.saturation_pressure) {
    return use("saturation_pressure",
               fmt::format("an elastic contact displaces nothing: sliding needs {}",
                           spelling("saturation_pressure")));
  }
  if (all.mean_pressures.size() != 1 || all.film.lubricant_densities.size() > 1) {
    const std::string setting =
        all.mean_pressures.size() != 1 ? "mean_pressure" : "lubricant_density";
    return use(setting,
               fmt::format("the sheet changes as it slides: give one {}", spelling(setting)));
  }
  if (all.contact.load_path) {
    return use("load_path",
               fmt::format("sliding keeps what it displaces: leave out {}", spelling("load_path")));
  }
  if (auto found = objection_to_bounds(slide_parameters(), settings)) return found;
  if (settings.step && *settings.step > settings.distance) {
    return Objection{.setting = "step",
                     .got = format_si(*settings.step, "m"),
                     .expected = "at most the distance, " + format_si(settings.distance, "m")};
  }
  return std::nullopt;
}

SlideResult slide(const topography::Topography& surface, const CaseSettings& settings,
                  const SlideSettings& sliding,
                  const std::function<void(const SlideRecord&)>& receive,
                  const Observer& observer) {
  if (sliding.step && *sliding.step < 0.5 * surface.grid.dx()) {
    throw InputError("step", format_si(*sliding.step, "m"),
                     "at least a pixel, " + format_si(surface.grid.dx(), "m"), "");
  }
  const double dx = surface.grid.dx();
  if (sliding.distance < 0.5 * dx || sliding.distance > kMostPixels * dx) {
    throw InputError("distance", format_si(sliding.distance, "m"),
                     fmt::format("one to {} pixels, {} to {}", kMostPixels, format_si(dx, "m"),
                                 format_si(kMostPixels * dx, "m")),
                     "");
  }
  return Run(surface, settings, sliding, observer).run(receive);
}

}  // namespace tabor::cases
