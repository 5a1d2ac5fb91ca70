#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/engine/task.hpp"

// Defines a job of the engine: a task with what it needs and how it is computed.
namespace tabor::engine {

/// Quality of a stored result. --retry computes the last two again.
enum class Quality { converged, not_converged, failed };

/// Observers of a running job. Both throw Interrupted when the run ends.
struct Monitor {
  Observer own;  ///< of the job itself, under its stage; tells how much of it is done
  /// Makes the observer of work that jobs share, such as reading a scan, under a stage of its own.
  std::function<Observer(const std::string& stage)> shared;
};

/// Task with all that is needed to compute it. Functions are released as soon as the job has ended:
/// what jobs share in memory is best held by shared pointers that their functions capture.
struct Job {
  Task task;          ///< without a file nothing is stored: the job itself hands its result on
  std::string kind;   ///< "contact": jobs of a kind take about as long and are counted together
  std::string stage;  ///< "contact surface.x3p 7 MPa": what a person watching calls it

  /// Places in the list of the jobs whose results it uses; they stand before it. If one of them
  /// fails, the job fails with the same message.
  std::vector<std::size_t> needs;
  /// Places of jobs whose results are shown beside its own: it neither waits for them nor fails
  /// with them.
  std::vector<std::size_t> wants;
  /// Part of the job: shard i of n has the parts i - 1, i - 1 + n, ... A job without a part belongs
  /// to every shard that has a job which needs or wants it.
  std::optional<std::size_t> part;

  /// Computes the result, and stores it if there is a file. An InputError fails this job and those
  /// that need it; any other exception ends the run.
  std::function<void(const Monitor&)> compute;
  /// Returns "" if the stored file is complete, unchanged and of this task, otherwise its defect:
  /// then it is computed again.
  std::function<std::string()> defect;
  /// Returns the quality of a stored file without defect. Without this function it is always
  /// converged.
  std::function<Quality()> quality;
  /// Stores why there is no result. A job without this function leaves no file when it fails, and
  /// is not tried again as long as all jobs that need or want it are stored as failed.
  std::function<void(const std::string& error)> record_failure;
  /// Returns false if the stored file lacks what a job that needs this one still takes from it (the
  /// start of the next case of a chain): then it is computed again.
  std::function<bool()> can_serve;
  /// Returns the memory of the running job [bytes]. An InputError means that it is unknown.
  std::function<std::size_t(const Monitor&)> memory;

  bool is_serial = false;  ///< is given one thread: most of it would leave others idle
  /// True for a job of negligible time: it is neither estimated, locked nor interrupted.
  bool is_brief = false;
  bool restarts = false;  ///< starts its iteration again many times: its residual is no progress
};

}  // namespace tabor::engine
