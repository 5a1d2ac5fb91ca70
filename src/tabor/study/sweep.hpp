#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/engine/run_options.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/study/averages.hpp"
#include "tabor/study/density_curves.hpp"
#include "tabor/study/slide_rows.hpp"
#include "tabor/study/study.hpp"

// Runs a study into its folder of results, whole or in parts.
namespace tabor::study {

/// Settings for running a study.
struct SweepOptions : engine::RunOptions {
  std::string command;  ///< command line, stored in results.h5
};

/// End of a sweep.
struct Outcome {
  std::size_t n_cases = 0;          ///< of the study
  std::size_t n_done = 0;           ///< rows in results.csv, those of earlier runs included
  std::size_t n_failed = 0;         ///< of them without numbers
  std::size_t n_not_converged = 0;  ///< of them with numbers of less than the quality asked for
  std::size_t n_surfaces = 0;       ///< tasks this run computed
  std::size_t n_contacts = 0;
  std::size_t n_films = 0;
  std::size_t n_trapped = 0;  ///< contacts with oil whose pockets carry load
  std::size_t n_fluids = 0;   ///< states whose oil flows
  std::size_t n_rows = 0;
  std::size_t n_slides = 0;
  std::size_t n_failed_slides = 0;         ///< stored without states
  std::vector<std::string> failures;       ///< one line per scan and pressure that has no numbers
  std::vector<std::string> warnings;       ///< about the sweep itself
  std::vector<results::Finding> findings;  ///< about the numbers of its rows
  std::vector<Average> averages;           ///< over the scans of each group
  std::vector<GroupCurve> density_curves;  ///< friction against density, the same
  std::vector<SlideRow> slides;            ///< states of the slides
};

/// Returns the parts that processes may compute into one store at the same time: one scan under one
/// pressure each. The study of a part has this scan alone, with the pressure as its own, and no
/// experiment.
std::vector<Study> parts_of(const Study& study);

/// Parts of a study that the store lacks.
struct Missing {
  std::vector<std::size_t> parts;  ///< places in parts_of(), the first pressures of all scans first
  std::vector<std::string> warnings;  ///< one per damaged file, which is removed
};
/// Finds the missing parts by checking every file of the store. With `retry`, results that failed
/// or did not converge are missing, too. Throws as run().
Missing missing_parts(const Study& study, const std::filesystem::path& directory,
                      bool retry = false, const Observer& observer = {});

/// Outcome of a run of one part.
struct PartOutcome {
  std::size_t n_contacts = 0;         ///< that it computed
  std::vector<std::string> failures;  ///< of what has no numbers
};
/// Computes what the store does not hold yet of a part, while other processes may compute other
/// parts into the same store. Writes no tables; run() does that later. Throws as run().
PartOutcome run_part(const Study& part, const std::filesystem::path& directory,
                     const engine::RunOptions& options = {});

/// Computes what the store in `directory` does not hold yet: each scan is treated once, each
/// contact solved once per scan and pressure, each film laid down once per scan for all densities;
/// where the oil flows, every condition of a contact is one more task.
/// A case that fails is recorded and the rest goes on. results.csv, averages.csv and results.h5 are
/// rebuilt from the store at the end, also of an interrupted run. Results do not depend on jobs,
/// shards, threads or interruptions.
///
/// Throws InputError (unreadable scan file, store in use), Error (a scan was replaced meanwhile),
/// OutputError (cannot write), Interrupted (the observer returned false; finished results are
/// stored).
Outcome run(const Study& study, const std::filesystem::path& directory,
            const SweepOptions& options = {});

}  // namespace tabor::study
