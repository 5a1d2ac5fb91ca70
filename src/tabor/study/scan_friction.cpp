#include "tabor/study/scan_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/engine/engine.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/study/friction_graph.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

constexpr Index kFewestPixels = 32;  // along a side that is still coarsened
constexpr double kManyDroplets = 4;  // per pixel: as good as vanishing ones, for a difference

/// Returns a pointer to what outlives it.
template <typename Value>
std::shared_ptr<const Value> lent(const Value& value) {
  return {std::shared_ptr<const Value>(), &value};
}

/// One condition for each density: the speed is that of the settings.
std::vector<FilmCondition> conditions_of(const cases::CaseSettings& settings) {
  std::vector<FilmCondition> conditions;
  for (std::size_t d = 0; d < settings.film.lubricant_densities.size(); ++d) {
    conditions.push_back({d, settings.fluid});
  }
  return conditions;
}

/// Results of one surface in memory. The lists of a contact have one element per density.
class FrictionInMemory : public FrictionStore {
 public:
  struct Solved {
    cases::ContactRecord contact;
    std::shared_ptr<const Mask> touching;
    std::vector<std::optional<cases::TrappedRecord>> trapped;
    std::vector<std::optional<cases::FluidRecord>> fluids;
    std::vector<std::optional<cases::FrictionRecord>> frictions;

    cases::Oil oil(const cases::FilmRecord& film, std::size_t density) const {
      return {film, trapped[density] ? &*trapped[density] : nullptr,
              fluids[density] ? &*fluids[density] : nullptr};
    }
  };

  FrictionInMemory(const topography::Topography& surface, const cases::CaseSettings& settings,
                   bool drops_maps, bool keeps_oil_maps)
      : FrictionStore(settings, conditions_of(settings)),
        surface_(surface),
        drops_maps_(drops_maps),
        keeps_oil_maps_(keeps_oil_maps),
        contacts_(settings.mean_pressures.size() * n_places()),
        summaries_(contacts_.size()),
        wet_shares_(contacts_.size()) {}

  void describe(const FrictionPlace& place, engine::Job& job) override {
    job.stage = job.kind;
    if (place.kind == FrictionJob::film || place.kind == FrictionJob::wetting_doses) return;
    job.stage += " " + format_si(mean_pressure_of(place.contact), "Pa");
  }

  Surface surface(const engine::Monitor&) override { return lent(surface_); }
  std::shared_ptr<const Mask> touching(std::size_t contact) override {
    return contacts_[contact].touching;
  }
  std::shared_ptr<const contact::State> dry_contact(
      std::size_t contact, const std::function<contact::State()>&) override {
    return lent(contacts_[contact].contact.state);
  }
  std::shared_ptr<const Field> film(std::size_t density) override {
    return lent(films_[density].film.thickness);
  }
  FrictionInputs inputs(const FrictionPlace& place) override {
    const Solved& one = contacts_[place.contact];
    const cases::Oil oil = one.oil(films_[place.condition], place.condition);
    return {lent(one.contact),
            one.touching,
            lent(one.contact.state.gap),
            surface_.grid,
            lent(oil.film),
            oil.trapped != nullptr ? lent(*oil.trapped) : nullptr,
            oil.fluid != nullptr ? lent(*oil.fluid) : nullptr};
  }

  void store_films(const Surface&, const LayFilms& lay) override {
    films_.resize(settings().film.lubricant_densities.size());
    lay([this](cases::FilmRecord&& film) { films_[film.film.request] = std::move(film); });
  }
  void store(const FrictionPlace& place, const Surface&, cases::ContactRecord&& contact) override {
    Solved& one = contacts_[place.contact];
    one.contact = std::move(contact);
    one.touching = std::make_shared<const Mask>(contact::contact_mask(one.contact.state));
    one.trapped.resize(conditions().size());
    one.fluids.resize(conditions().size());
    one.frictions.resize(conditions().size());
    summaries_[place.contact] = one.contact.summary;
    contact::State& state = one.contact.state;
    if (!drops_maps_) return;
    state.pressure = state.displacement = Field();
    one.contact.tool.reset();
  }
  void store(const FrictionPlace& place, WetShares&& shares) override {
    wet_shares_[place.contact] = std::move(shares);
  }
  void store(const FrictionPlace& place, const Surface&, cases::TrappedRecord&& trapped) override {
    Solved& one = contacts_[place.contact];
    trapped.surface = one.contact.surface;
    const bool is_shown = place.contact % n_places() == 0 && keeps_oil_maps_;
    if (!is_shown) trapped.state = {};
    one.trapped[place.condition] = std::move(trapped);
  }
  void store(const FrictionPlace& place, const Surface&, cases::FluidRecord&& fluid) override {
    Solved& one = contacts_[place.contact];
    fluid.surface = one.contact.surface;
    one.fluids[place.condition] = std::move(fluid);
  }
  void store(const FrictionPlace& place, cases::FrictionRecord&& friction) override {
    contacts_[place.contact].frictions[place.condition] = std::move(friction);
  }

  const std::vector<cases::FilmRecord>& films() const { return films_; }
  /// Takes what was computed under a pressure, with the contact at the first place of the tool.
  Solved take(std::size_t pressure) {
    const std::size_t first = pressure * n_places();
    for (std::size_t i = 1; i < n_places(); ++i) contacts_[first + i] = {};
    if (drops_maps_) contacts_[first].contact.state.gap = Field();
    return std::exchange(contacts_[first], {});
  }

  /// Returns one curve for each pressure, none for a surface without heights.
  std::vector<cases::DensityCurve> density_curves() const {
    std::vector<cases::DensityCurve> curves;
    for (std::size_t i = 0; i < wet_shares_.size(); ++i) {
      const WetShares& shares = wet_shares_[i];
      if (shares.lubricant_densities.empty()) continue;
      curves.push_back(cases::density_curve(shares.lubricant_densities, shares.lubricated_shares,
                                            summaries_[i], settings()));
    }
    return curves;
  }

 private:
  const topography::Topography& surface_;
  bool drops_maps_;
  bool keeps_oil_maps_;  // of trapped oil
  std::vector<cases::FilmRecord> films_;
  std::vector<Solved> contacts_;
  std::vector<contact::Summary> summaries_;  // they outlive the contacts
  std::vector<WetShares> wet_shares_;
};

/// Returns how many contacts may wait for the rain: what fits in a quarter of the memory, at least
/// two.
std::size_t n_waiting(const Grid& grid, bool maps_are_kept) {
  const std::size_t bytes_per_pixel =
      sizeof(double) + sizeof(bool) + (maps_are_kept ? 2 * sizeof(double) : 0);
  const std::size_t bytes = static_cast<std::size_t>(grid.nx * grid.ny) * bytes_per_pixel;
  return std::max<std::size_t>(2, available_memory_bytes() / 4 / std::max<std::size_t>(1, bytes));
}

/// True where the limit of small droplets stands for the droplets: they are whole, and each film
/// has many.
bool is_near_limit(const cases::FilmSettings& settings) {
  return settings.model == deposition::Model::droplets &&
         settings.reading == deposition::Reading::conserving &&
         std::all_of(settings.lubricant_densities.begin(), settings.lubricant_densities.end(),
                     [&](double density) {
                       const double film = deposition::mean_film(density, settings.oil_density);
                       return film == 0 || film >= kManyDroplets * settings.droplet_height;
                     });
}

/// Computes rain and contacts on a quarter of the pixels. Small droplets rain as their limit: it is
/// much closer to them than the two pixel sizes are to each other.
CoarsePixels coarse_pixels(const topography::Topography& surface,
                           const cases::CaseSettings& settings, const Observer& observer) {
  const Grid& grid = surface.grid;
  const topography::Topography coarse = topography::apply(
      {fmt::format("resample={},{}", grid.nx / 2, grid.ny / 2)}, surface, observer);
  cases::FilmSettings rain = settings.film;
  if (is_near_limit(rain)) rain.model = deposition::Model::limit;
  const auto films = cases::film_state(coarse, rain, observer);
  CoarsePixels result{coarse.grid.dx(), {}};
  const auto receive = [&](const cases::ContactRecord& contact) {
    const Mask touching = contact::contact_mask(contact.state);
    std::vector<double>& shares = result.lubricated_shares.emplace_back();
    for (const cases::FilmRecord& film : films) {
      shares.push_back(
          friction::lubricated_share(touching, film.film.thickness, settings.friction.dry_below));
    }
  };
  const auto elasticity = cases::make_operator(settings.contact, coarse.grid);
  cases::contact_states(*elasticity, coarse, settings.contact, cases::controls_of(settings),
                        receive, observer);
  return result;
}

engine::Job hand_on_job(const std::shared_ptr<FrictionInMemory>& store, std::size_t pressure,
                        const std::function<void(const FrictionState&)>& receive) {
  engine::Job job;
  job.kind = job.stage = kHandOn;
  job.compute = [store, pressure, &receive](const engine::Monitor&) {
    const FrictionInMemory::Solved one = store->take(pressure);
    for (std::size_t d = 0; d < one.frictions.size(); ++d) {
      receive({.friction = *one.frictions[d],
               .contact = one.contact,
               .oil = one.oil(store->films()[d], d)});
    }
  };
  return job;
}

engine::Job coarse_job(const std::shared_ptr<FrictionInMemory>& store, const Grid& grid,
                       CoarsePixels& result) {
  engine::Job job;
  job.kind = job.stage = kCoarsePixels;
  job.memory = [store, &grid](const engine::Monitor&) {
    return bytes_of_job(grid, store->settings());
  };
  job.compute = [store, &result](const engine::Monitor& monitor) {
    result = coarse_pixels(*store->surface(monitor), store->settings(), monitor.own);
  };
  return job;
}

}  // namespace

ScanFrictionResult friction_of(const topography::Topography& surface,
                               const cases::CaseSettings& settings,
                               const std::function<void(const FrictionState&)>& receive,
                               ContactMaps maps, const engine::RunOptions& options,
                               bool compares_pixels) {
  const bool drops_maps = maps == ContactMaps::dropped && !settings.fluid.flows() &&
                          !settings.trapped.is_asked();  // oil in it needs all of a contact
  const auto store =
      std::make_shared<FrictionInMemory>(surface, settings, drops_maps, maps == ContactMaps::kept);
  const bool has_curves = cases::has_density_curve(settings);
  const std::size_t window =
      std::max<std::size_t>(1, n_waiting(surface.grid, !drops_maps) / store->n_places());
  std::vector<engine::Job> jobs;
  FrictionGraph graph(store, jobs);
  graph.add_rain(has_curves);
  ScanFrictionResult result;
  if (compares_pixels && std::min(surface.grid.nx, surface.grid.ny) >= kFewestPixels) {
    // Its rain is serial, too: beside the other it leaves no thread idle at the end.
    graph.add(coarse_job(store, surface.grid, result.coarse), {});
  }
  std::vector<std::size_t> handed_on;  // places
  for (std::size_t i = 0; i < settings.mean_pressures.size(); ++i) {
    std::vector<std::size_t> before;
    if (i >= window) before.push_back(handed_on[i - window]);
    graph.add_contact(i, before);
    std::vector<std::size_t> needs;
    if (has_curves) needs.push_back(graph.add_wet_shares(i));
    for (const std::size_t place : graph.add_frictions(i)) needs.push_back(place);
    if (i > 0) needs.push_back(handed_on[i - 1]);  // in their order
    engine::Job hand_on = hand_on_job(store, i, receive);
    hand_on.is_brief = drops_maps;  // a receiver of maps writes them
    handed_on.push_back(graph.add(std::move(hand_on), std::move(needs)));
  }
  const engine::Report report = engine::run_jobs(std::move(jobs), nullptr, options);
  report.rethrow();
  if (!report.failures.empty()) throw InputError(report.failures.front());
  result.density_curves = store->density_curves();
  result.seconds = report.seconds;
  return result;
}

}  // namespace tabor::study
