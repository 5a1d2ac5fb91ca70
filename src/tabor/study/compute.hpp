#pragma once

#include "tabor/cases/density_curve.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/study/record.hpp"

// Computes the tasks of a study, one at a time, and stores their results.
namespace tabor::study {

/// Reads and treats one scan. Throws InputError, also for a surface that still has holes; Throws
/// Error if the bytes that are read are not those of `scan_sha256`: the scan was replaced since the
/// sweep began, and its results would be stored as those of the earlier scan.
topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer);

/// Returns the memory of one job with its surface [bytes].
std::size_t bytes_of_job(const Grid& grid, bool oil_flows);

/// Stores the power spectra and the map of the treated scan.
void compute_surface(const engine::Store& store, const engine::Task& task,
                     const topography::Topography& topography);

/// Solves one contact and returns it, converged or not. Throws Interrupted if `observer` stops it.
contact::State solve_contact(const Study& study, const topography::Topography& topography,
                             double mean_pressure, const Observer& observer);

/// Solves one contact and stores it.
void compute_contact(const engine::Store& store, const engine::Task& task, const Study& study,
                     const topography::Topography& topography, double mean_pressure,
                     const Observer& observer);

/// Lays down the films of all densities and stores them.
void compute_film(const engine::Store& store, const engine::Task& task, const Study& study,
                  const topography::Topography& topography, const Observer& observer);

/// Solves the flow of the stored film between the surfaces of `dry`, the contact as solve_contact()
/// gives it, and stores the state, converged or not.
void compute_fluid(const engine::Store& store, const Study& study,
                   const topography::Topography& topography, const contact::State& dry,
                   const ScanTasks& tasks, std::size_t pressure, std::size_t condition,
                   const Observer& observer);

/// Computes the wet shares of one stored contact and stores them.
void compute_wet_shares(const engine::Store& store, const engine::Task& task,
                        const engine::Task& contact, const cases::WettingDoses& doses);

/// Computes one row from what is in the store and stores it.
void compute_row(const engine::Store& store, const Study& study, const Scan& scan,
                 const ScanTasks& tasks, std::size_t pressure, std::size_t condition);

/// Stores the row of a case without contact or film, with the error.
void record_failure(const engine::Store& store, const Study& study, const Scan& scan,
                    const ScanTasks& tasks, std::size_t pressure, std::size_t condition,
                    const std::string& error);

}  // namespace tabor::study
