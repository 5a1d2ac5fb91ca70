#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/study/task.hpp"

namespace tabor::study {

/// What a stored result is worth. --retry computes the last two again.
enum class Quality { converged, not_converged, failed };

/// What a job reports to while it is computed. Both observers throw Interrupted when the run ends.
struct Monitor {
  Observer own;  ///< of the job itself, under its stage; tells how much of it is done
  /// Of work that jobs share, such as reading a scan, under a stage of its own.
  std::function<Observer(const std::string& stage)> shared;
};

/// A task with what it takes to compute it. Functions are released as soon as the job has ended:
/// what jobs share in memory is best held by shared pointers that their functions capture.
struct Job {
  Task task;          ///< without a file nothing is stored: the job itself hands its result on
  std::string kind;   ///< "contact": jobs of a kind take about as long and are counted together
  std::string stage;  ///< "contact surface.x3p 7 MPa": what a person watching calls it

  /// Places in the list of the jobs whose results it takes; they stand before it. If one of them
  /// fails, the job fails with the same message.
  std::vector<std::size_t> needs;
  /// The same of jobs whose results stand beside its own in what is shown: it neither waits for
  /// them nor fails with them.
  std::vector<std::size_t> wants;
  /// Shard i of n has the parts i - 1, i - 1 + n, ... A job without a part belongs to every shard
  /// that has a job which needs or wants it.
  std::optional<std::size_t> part;

  /// Computes, and stores if there is a file. An InputError fails this job and those that need it,
  /// anything else ends the run. Nothing else is run in its place after Interrupted.
  std::function<void(const Monitor&)> compute;
  /// "" if the stored file has all its bytes as they were written and is the task's, otherwise what
  /// is wrong with it: then it is computed again.
  std::function<std::string()> defect;
  /// Of a stored file without defect. Without this function it is always converged.
  std::function<Quality()> quality;
  /// Stores why there is no result. A job without this function leaves no file when it fails, and
  /// is not tried again as long as all jobs that need or want it are stored as failed.
  std::function<void(const std::string& error)> record_failure;
  /// False if the stored file does not hold what a job that needs this one and is still to be done
  /// takes from it (the start of the next case of a chain): then it is computed again.
  std::function<bool()> can_serve;
  /// Memory that it takes while it runs [bytes]. An InputError means that nobody knows.
  std::function<std::size_t(const Monitor&)> memory;

  bool is_serial = false;  ///< is given one thread: most of it would leave others idle
  /// Takes next to no time: it is neither estimated, locked nor interrupted.
  bool is_brief = false;
  bool restarts = false;  ///< iterates anew many times: its residual does not tell how far it is
};

}  // namespace tabor::study
