#include "tabor/study/friction_graph.hpp"

#include <mutex>
#include <utility>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/engine/made_once.hpp"

namespace tabor::study {
namespace {

/// Memory of a job with its surface; tools/bench/study prints it. With oil that flows, what the
/// peak of `tabor friction --fluid reynolds` grows by with the pixels of a flooded scan, and a
/// little.
constexpr std::size_t kBytesPerPixel = 80;
constexpr std::size_t kBytesPerFlowingPixel = 500;
constexpr std::size_t kBytesPerPixelOfTrapped = 60;
constexpr std::size_t kMoreBytesPerPixelOfSlide = 60;
/// The tool, its heights over the surface, and the sum of both.
constexpr std::size_t kBytesPerPixelOfTool = 3 * sizeof(double);

/// Elastic operators of one half-space, each lent to one job at a time.
class Operators {
 public:
  using Operator = elastic::ElasticOperator;

  /// Lends an operator, which comes back by itself. The pool must outlive it.
  std::shared_ptr<Operator> borrow(const cases::ContactSettings& settings, const Grid& grid) {
    return {take(settings, grid).release(),
            [this](Operator* used) { give_back(std::unique_ptr<Operator>(used)); }};
  }

 private:
  std::unique_ptr<Operator> take(const cases::ContactSettings& settings, const Grid& grid) {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Operator> one = std::move(idle_.back());
        idle_.pop_back();
        return one;
      }
    }
    return cases::make_operator(settings, grid);
  }

  void give_back(std::unique_ptr<Operator> used) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(used));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Operator>> idle_;
};

}  // namespace

std::size_t bytes_of_job(const Grid& grid, const cases::CaseSettings& settings) {
  const std::size_t bytes_per_pixel =
      (settings.fluid.flows() ? kBytesPerFlowingPixel : kBytesPerPixel) +
      (settings.trapped.is_asked() ? kBytesPerPixelOfTrapped : 0) +
      (settings.contact.tool.is_rough() ? kBytesPerPixelOfTool : 0);
  return static_cast<std::size_t>(grid.nx * grid.ny) * bytes_per_pixel;
}

std::size_t bytes_of_slide(const Grid& grid, const cases::CaseSettings& settings) {
  return bytes_of_job(grid, settings) +
         static_cast<std::size_t>(grid.nx * grid.ny) * kMoreBytesPerPixelOfSlide;
}

FrictionStore::FrictionStore(cases::CaseSettings settings, std::vector<FilmCondition> conditions)
    : settings_(std::move(settings)), conditions_(std::move(conditions)) {}

/// All that the jobs of one surface share; gone with the last of them.
struct FrictionGraph::Shared {
  std::shared_ptr<FrictionStore> store;
  Operators operators = {};
  engine::MadeOnce<cases::Tool> tool = {};
  std::vector<cases::Pressing> load_paths = {};  // contacts of a load path wait for each other
  cases::WettingDoses doses = {};

  const cases::CaseSettings& settings() const { return store->settings(); }
  double mean_pressure(const FrictionPlace& place) const {
    return store->mean_pressure_of(place.contact);
  }
  contact::Control control(const FrictionPlace& place) const {
    return contact::MeanPressure{mean_pressure(place)};
  }
  std::shared_ptr<Operators::Operator> operator_on(const Grid& grid) {
    return operators.borrow(settings().contact, grid);
  }

  /// Films and doses in one run: they share a tree of pools.
  void lay_films(bool has_wet_shares, const engine::Monitor& monitor) {
    const auto surface = store->surface(monitor);
    store->store_films(surface, [&](const auto& receive) {
      if (has_wet_shares) {
        doses = cases::wetting_doses(*surface, settings().film, receive, monitor.own);
      } else {
        cases::film_state(*surface, settings().film, receive, monitor.own);
      }
    });
  }

  void find_doses(const engine::Monitor& monitor) {
    if (!doses.first.empty()) return;  // found with the films
    doses = cases::wetting_doses(*store->surface(monitor), settings().film, Mask(), monitor.own);
  }

  /// Puts the tool over the surface, where a contact has it.
  cases::Pressing pressing_at(const topography::Topography& surface, std::size_t contact) {
    const cases::ToolSettings& asked = settings().contact.tool;
    const auto made = tool.get([&] { return cases::make_tool(asked, surface.grid); });
    return cases::pressing(surface, *made,
                           cases::places_of(asked, *made)[contact % store->n_places()]);
  }

  void solve_contact(const FrictionPlace& place, const engine::Monitor& monitor) {
    const auto surface = store->surface(monitor);
    const std::size_t n_places = store->n_places();
    cases::Pressing own;
    const bool continues = settings().contact.load_path && place.contact >= n_places;
    cases::Pressing& pressing =
        settings().contact.load_path ? load_paths[place.contact % n_places] : own;
    if (!continues && settings().contact.tool.is_rough()) {
      pressing = pressing_at(*surface, place.contact);
    }
    store->store(place, surface,
                 cases::contact_state(*operator_on(surface->grid), *surface, settings().contact,
                                      control(place), pressing, monitor.own));
  }

  void share_of_wet(const FrictionPlace& place) {
    const auto touching = store->touching(place.contact);
    if (!doses.first.empty() && doses.first.size() != static_cast<std::size_t>(touching->size())) {
      throw InputError("the store", "a surface and a contact of two sizes", "both of one surface",
                       "remove the folder store and run the sweep again");
    }
    store->store(place,
                 WetShares{doses.lubricant_densities, cases::lubricated_shares(doses, *touching)});
  }

  /// A contact with all its maps, for the oil in it.
  std::shared_ptr<const contact::State> dry_contact(const FrictionPlace& place,
                                                    const topography::Topography& surface,
                                                    elastic::ElasticOperator& elasticity,
                                                    cases::Pressing& pressing,
                                                    const Observer& observer) {
    return store->dry_contact(place.contact, [&] {
      return cases::contact_state(elasticity, surface, settings().contact, control(place), pressing,
                                  observer)
          .state;
    });
  }

  void solve_trapped(const FrictionPlace& place, const engine::Monitor& monitor) {
    const auto surface = store->surface(monitor);
    const auto elasticity = operator_on(surface->grid);
    cases::Pressing pressing;
    if (settings().contact.tool.is_rough()) pressing = pressing_at(*surface, place.contact);
    const auto dry = dry_contact(place, *surface, *elasticity, pressing, monitor.own);
    store->store(place, surface,
                 cases::trapped_state(*elasticity, pressing.height_of(*surface), *dry,
                                      *store->film(store->conditions()[place.condition].density),
                                      settings(), monitor.own));
  }

  void solve_flow(const FrictionPlace& place, const engine::Monitor& monitor) {
    const auto surface = store->surface(monitor);
    const auto elasticity = operator_on(surface->grid);
    cases::Pressing flat;
    const auto dry = dry_contact(place, *surface, *elasticity, flat, monitor.own);
    const FilmCondition& condition = store->conditions()[place.condition];
    store->store(place, surface,
                 cases::fluid_state(*elasticity, surface->height, *dry, mean_pressure(place),
                                    *store->film(condition.density), settings().contact,
                                    condition.fluid, monitor.own));
  }

  void estimate_friction(const FrictionPlace& place) {
    std::vector<cases::FrictionRecord> at_places;
    FrictionPlace one = place;
    for (std::size_t i = 0; i < store->n_places(); ++i, ++one.contact) {
      const FrictionInputs in = store->inputs(one);
      at_places.push_back(cases::friction_state(*in.contact, {*in.touching, *in.gap, in.grid},
                                                {*in.film, in.trapped.get(), in.fluid.get()},
                                                settings().contact, settings().friction));
    }
    store->store(place, cases::mean_over_places(at_places));
  }
};

FrictionGraph::FrictionGraph(std::shared_ptr<FrictionStore> store, std::vector<engine::Job>& jobs)
    : shared_(new Shared{std::move(store)}), jobs_(jobs) {
  shared_->load_paths.resize(shared_->store->n_places());
}

std::size_t FrictionGraph::add(engine::Job job, std::vector<std::size_t> needs) {
  job.needs = std::move(needs);
  jobs_.push_back(std::move(job));
  return jobs_.size() - 1;
}

engine::Job FrictionGraph::job_of(const FrictionPlace& place,
                                  std::function<void(const engine::Monitor&)> compute) const {
  engine::Job job;
  job.kind = kind_of(place.kind);
  job.compute = std::move(compute);
  job.memory = [shared = shared_](const engine::Monitor& monitor) {
    return bytes_of_job(shared->store->surface(monitor)->grid, shared->settings());
  };
  shared_->store->describe(place, job);
  return job;
}

engine::Job FrictionGraph::brief_job_of(const FrictionPlace& place,
                                        std::function<void(const engine::Monitor&)> compute) const {
  engine::Job job = job_of(place, std::move(compute));
  job.is_brief = true;
  job.memory = nullptr;
  return job;
}

void FrictionGraph::add_rain(bool has_wet_shares) {
  engine::Job film =
      job_of({FrictionJob::film}, [shared = shared_, has_wet_shares](const engine::Monitor& m) {
        shared->lay_films(has_wet_shares, m);
      });
  film.is_serial = true;
  film_ = add(std::move(film), {});
  if (!has_wet_shares) return;
  engine::Job doses =
      job_of({FrictionJob::wetting_doses},
             [shared = shared_](const engine::Monitor& m) { shared->find_doses(m); });
  doses.is_serial = true;
  doses_ = add(std::move(doses), {film_});
}

void FrictionGraph::add_contact(std::size_t pressure, const std::vector<std::size_t>& needs) {
  const std::size_t n_places = shared_->store->n_places();
  for (std::size_t i = 0; i < n_places; ++i) {
    const FrictionPlace place{FrictionJob::contact, pressure * n_places + i};
    std::vector<std::size_t> own_needs = needs;
    if (shared_->settings().contact.load_path && pressure > 0) {
      own_needs.push_back(contacts_[place.contact - n_places]);
    }
    contacts_.push_back(add(job_of(place,
                                   [shared = shared_, place](const engine::Monitor& monitor) {
                                     shared->solve_contact(place, monitor);
                                   }),
                            std::move(own_needs)));
  }
}

std::size_t FrictionGraph::add_wet_shares(std::size_t pressure) {
  const FrictionPlace place{FrictionJob::wet_shares, pressure};
  return add(brief_job_of(place, [shared = shared_,
                                  place](const engine::Monitor&) { shared->share_of_wet(place); }),
             {contacts_[pressure], doses_});
}

std::size_t FrictionGraph::add_oil(const FrictionPlace& place) {
  const bool flows = place.kind == FrictionJob::fluid;
  return add(job_of(place,
                    [shared = shared_, place, flows](const engine::Monitor& monitor) {
                      flows ? shared->solve_flow(place, monitor)
                            : shared->solve_trapped(place, monitor);
                    }),
             {contacts_[place.contact], film_});
}

std::vector<std::size_t> FrictionGraph::add_frictions(std::size_t pressure) {
  std::vector<std::size_t> places;
  const std::size_t n_places = shared_->store->n_places();
  const std::size_t first = pressure * n_places;
  for (std::size_t i = 0; i < shared_->store->conditions().size(); ++i) {
    std::vector<std::size_t> needs = {film_};
    for (std::size_t k = 0; k < n_places; ++k) {
      needs.push_back(contacts_[first + k]);
      if (!shared_->store->is_trapped()) continue;
      needs.push_back(add_oil({FrictionJob::trapped, first + k, i}));
    }
    if (shared_->store->flows()) needs.push_back(add_oil({FrictionJob::fluid, first, i}));
    const FrictionPlace place{FrictionJob::friction, first, i};
    places.push_back(add(
        brief_job_of(place, [shared = shared_,
                             place](const engine::Monitor&) { shared->estimate_friction(place); }),
        std::move(needs)));
  }
  return places;
}

}  // namespace tabor::study
