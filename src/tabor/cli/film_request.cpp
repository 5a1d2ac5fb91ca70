#include "tabor/cli/film_request.hpp"

#include <fmt/format.h>

#include <utility>

#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/study/study.hpp"

namespace tabor::cli {

namespace {

lubrication::Dose dose_of(const FilmRequest& request, const Context& context) {
  lubrication::Dose dose;
  for (const double density : request.densities) {
    dose.mean_films.push_back(lubrication::mean_film(density, request.oil_density));
  }
  dose.droplet_height = request.droplet_height;
  dose.model = lubrication::parse_model(request.model);
  dose.reading = lubrication::parse_reading(request.reading);
  dose.edge = lubrication::parse_edge(request.edge);
  dose.seed = context.seed_or_default();
  return dose;
}

}  // namespace

std::string density_text(double density) { return plain(study::in_g_per_m2(density)) + " g/m^2"; }

void declare_film(OptionSet& set, FilmRequest& request) {
  set.group("Lubricant");
  set.quantities("--density", "D[,D2,...]", "areal lubricant density as dosed, e.g. 0.45g/m^2",
                 dimension::areal_density, request.densities)
      .required = true;
  set.quantity("--oil-density", "RHO", "density of the liquid [900kg/m^3]", dimension::density,
               request.oil_density);
  set.quantity("--droplet", "D", "droplet volume / pixel area [0.1um]", dimension::length,
               request.droplet_height);
  set.choice(
      "--model", {"droplets", "limit", "bottom-fill", "uniform"},
      "droplets run downhill; limit: vanishing droplets; one level; constant film [droplets]",
      request.model);
  set.choice("--reading", {"conserving", "literal"},
             "what a full pit does with the rest of a droplet: pass it on or drop it [conserving]",
             request.reading);
  set.choice("--edge", {"closed", "periodic", "open"}, "what the border of the scan is [closed]",
             request.edge);
}

void check(const FilmRequest& request) {
  for (const double density : request.densities) {
    if (density < 0) throw InputError("--density", density_text(density), "zero or more", "");
  }
  if (request.oil_density <= 0) {
    throw InputError("--oil-density", plain(request.oil_density) + " kg/m^3", "more than zero", "");
  }
  if (request.droplet_height <= 0) {
    throw InputError("--droplet", si(request.droplet_height, "m"), "more than zero", "");
  }
}

void rain(const Scan& scan, const FilmRequest& request, Context& context,
          const std::function<void(std::size_t, lubrication::Film&&)>& sink) {
  const auto receive = [&](lubrication::Film&& film) {
    const std::size_t place = film.request;
    sink(place, std::move(film));
  };
  lubrication::deposit(scan.surface.height, scan.surface.grid, dose_of(request, context), receive,
                       context.observer());
}

io::Json settings_json(const FilmRequest& request, const Context& context) {
  return {{"model", request.model},
          {"reading", request.reading},
          {"edge", request.edge},
          {"seed", context.seed_or_default()},
          {"droplet_height_m", request.droplet_height},
          {"oil_density_kg_per_m3", request.oil_density}};
}

io::Json state_json(double density, const lubrication::Film& film) {
  return {{"lubricant_density_g_per_m2", study::in_g_per_m2(density)},
          {"mean_film_m", film.mean_film},
          {"n_droplets", film.n_droplets},
          {"wet_fraction", film.wet_fraction},
          {"max_film_m", film.max_film},
          {"dosed_volume_m3", film.dosed_volume},
          {"deposited_volume_m3", film.deposited_volume},
          {"lost_volume_m3", film.lost_volume},
          {"n_pools", film.n_pools},
          {"flooded", film.flooded},
          {"height_quantum_m", film.height_quantum},
          {"seconds", film.seconds},
          {"peak_memory_bytes", peak_memory_bytes()}};
}

void describe(const FilmRequest& request, const Context& context, Facts& facts) {
  std::string text = request.model;
  if (request.model == "droplets") {
    text += fmt::format(" of {}, {}, seed {}", si(request.droplet_height, "m"), request.reading,
                        context.seed_or_default());
  }
  facts.fact("lubricant", fmt::format("{}, {} edge, oil {} kg/m^3", text, request.edge,
                                      plain(request.oil_density)));
}

std::vector<std::string> methods_of(const FilmRequest& request) {
  if (request.model == "limit") return {"costagliola2021", "barnes2021"};
  return {"costagliola2021"};
}

}  // namespace tabor::cli
