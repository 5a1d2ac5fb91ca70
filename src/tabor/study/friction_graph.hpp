#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/core/names.hpp"
#include "tabor/engine/job.hpp"
#include "tabor/study/wet_shares.hpp"
#include "tabor/topography/topography.hpp"

// Lists the jobs that lead from a surface to its friction: rain, contacts, flows and what follows
// from them. A FrictionStore says where their results are: in memory or in the folder of a study.
namespace tabor::study {

/// Kind of a job of the graph.
enum class FrictionJob { film, wetting_doses, contact, wet_shares, trapped, fluid, friction };
inline constexpr auto kFrictionJobs =
    names<FrictionJob>("film", "doses that change the wet share", "contact", "wet shares",
                       "trapped oil", "fluid", "friction");
/// Returns the kind of an engine's job, by which a report counts what was computed.
inline std::string kind_of(FrictionJob job) { return std::string(kFrictionJobs.of(job)); }

/// One job of the graph: its kind, and its contact and condition where the kind has them. Flows and
/// frictions stand at the first contact of their pressure, trapped oil at each.
struct FrictionPlace {
  FrictionJob kind = FrictionJob::film;
  std::size_t contact =
      0;  ///< place among the contacts: the places of the tool, pressure by pressure
  std::size_t condition = 0;  ///< place among the conditions
};

/// Film and speed under which one contact gives one friction.
struct FilmCondition {
  std::size_t density = 0;  ///< place among the densities of the film settings
  cases::FluidSettings fluid;
};

/// Input of one friction. Maps of a store in memory are lent, those of a folder are read for it.
struct FrictionInputs {
  std::shared_ptr<const cases::ContactRecord> contact;
  std::shared_ptr<const Mask> touching;
  std::shared_ptr<const Field> gap;  ///< [m]
  Grid grid;
  std::shared_ptr<const cases::FilmRecord> film;
  std::shared_ptr<const cases::TrappedRecord> trapped;  ///< null where trapped oil carries nothing
  std::shared_ptr<const cases::FluidRecord> fluid;      ///< null where the oil does not flow
};

/// Store of the results of one surface. Functions of one instance are called by several threads,
/// each for a job of its own.
class FrictionStore {
 public:
  using Surface = std::shared_ptr<const topography::Topography>;
  /// Lays down films and hands each to the function it is given.
  using LayFilms = std::function<void(const std::function<void(cases::FilmRecord&&)>&)>;

  FrictionStore(cases::CaseSettings settings, std::vector<FilmCondition> conditions);
  virtual ~FrictionStore() = default;
  FrictionStore(const FrictionStore&) = delete;
  FrictionStore& operator=(const FrictionStore&) = delete;

  const cases::CaseSettings& settings() const { return settings_; }
  const std::vector<FilmCondition>& conditions() const { return conditions_; }
  bool flows() const { return settings_.fluid.flows(); }
  bool is_trapped() const { return settings_.trapped.is_asked(); }
  /// Returns the number of contacts under each pressure: the places of the tool.
  std::size_t n_places() const { return settings_.contact.tool.n_places(); }
  /// Returns the place of a contact's pressure among the mean pressures.
  std::size_t pressure_of(std::size_t contact) const { return contact / n_places(); }
  double mean_pressure_of(std::size_t contact) const {
    return settings_.mean_pressures[pressure_of(contact)];
  }

  /// Completes a job that has its kind, memory and computation: its stage, and for a folder its
  /// task, part and quality.
  virtual void describe(const FrictionPlace& place, engine::Job& job) = 0;

  virtual Surface surface(const engine::Monitor& monitor) = 0;
  virtual std::shared_ptr<const Mask> touching(std::size_t contact) = 0;
  /// Returns a contact with all its maps, for the oil in it; `solve` makes it again
  /// where the store has dropped maps.
  virtual std::shared_ptr<const contact::State> dry_contact(
      std::size_t contact, const std::function<contact::State()>& solve) = 0;
  virtual std::shared_ptr<const Field> film(std::size_t density) = 0;  ///< thickness [m]
  virtual FrictionInputs inputs(const FrictionPlace& place) = 0;

  virtual void store_films(const Surface& surface, const LayFilms& lay) = 0;
  virtual void store(const FrictionPlace& place, const Surface& surface,
                     cases::ContactRecord&& contact) = 0;
  virtual void store(const FrictionPlace& place, WetShares&& shares) = 0;
  virtual void store(const FrictionPlace& place, const Surface& surface,
                     cases::TrappedRecord&& trapped) = 0;
  virtual void store(const FrictionPlace& place, const Surface& surface,
                     cases::FluidRecord&& fluid) = 0;
  virtual void store(const FrictionPlace& place, cases::FrictionRecord&& friction) = 0;

 private:
  cases::CaseSettings settings_;
  std::vector<FilmCondition> conditions_;
};

/// Appends the jobs of one surface to a list, and says at which places of the list they stand.
class FrictionGraph {
 public:
  FrictionGraph(std::shared_ptr<FrictionStore> store, std::vector<engine::Job>& jobs);

  /// Appends any job.
  std::size_t add(engine::Job job, std::vector<std::size_t> needs);

  /// Appends the rain and, where wet shares will be asked for, the doses that wet each pixel. Most
  /// of both is serial: they come first, as the engine takes the first of the jobs that are ready.
  void add_rain(bool has_wet_shares);
  /// Appends the contacts under one pressure, one for each place of the tool, which wait for
  /// `needs`, and with a load path for the contact before it at their place; pressures come in
  /// their order.
  void add_contact(std::size_t pressure, const std::vector<std::size_t>& needs = {});
  /// Appends the wet shares of the one contact under a pressure and returns their place.
  std::size_t add_wet_shares(std::size_t pressure);
  /// Appends trapped and flowing oil and the frictions of one pressure and returns the places of
  /// the frictions.
  std::vector<std::size_t> add_frictions(std::size_t pressure);

 private:
  struct Shared;
  engine::Job job_of(const FrictionPlace& place,
                     std::function<void(const engine::Monitor&)> compute) const;
  engine::Job brief_job_of(const FrictionPlace& place,
                           std::function<void(const engine::Monitor&)> compute) const;
  std::size_t add_oil(const FrictionPlace& place);

  std::shared_ptr<Shared> shared_;
  std::vector<engine::Job>& jobs_;
  std::size_t film_ = 0;  // places in the list
  std::size_t doses_ = 0;
  std::vector<std::size_t> contacts_;  // places in the list
};

/// Returns the memory of one job with its surface [bytes].
std::size_t bytes_of_job(const Grid& grid, const cases::CaseSettings& settings);
/// Returns the memory of one slide with its surface [bytes].
std::size_t bytes_of_slide(const Grid& grid, const cases::CaseSettings& settings);

}  // namespace tabor::study
