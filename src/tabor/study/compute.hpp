#pragma once

#include "tabor/analysis/density_curve.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/study/record.hpp"

// From a study to the files of its store, one task at a time.
namespace tabor::study {

/// Reads and treats one scan. Throws InputError, also for a surface that still has holes; Error if
/// the bytes that are read are not those of `scan_sha256`: the scan was replaced since the sweep
/// began, and every result of it would be stored as one of the scan before.
topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer);

/// Memory of one job with its surface [bytes].
std::size_t bytes_of_job(const Grid& grid, bool oil_flows);

/// Power spectra and map of the treated scan into the store.
void compute_surface(const Store& store, const Task& task,
                     const topography::Topography& topography);

/// One contact, converged or not. Throws Interrupted if `observer` stops it.
contact::State solve_contact(const Study& study, const topography::Topography& topography,
                             double mean_pressure, const Observer& observer);

/// Solves one contact and stores it.
void compute_contact(const Store& store, const Task& task, const Study& study,
                     const topography::Topography& topography, double mean_pressure,
                     const Observer& observer);

/// Lays down the films of all densities and stores them.
void compute_film(const Store& store, const Task& task, const Study& study,
                  const topography::Topography& topography, const Observer& observer);

/// Lets the stored film flow between the surfaces of `dry`, the contact as solve_contact() gives
/// it, and stores the state, converged or not.
void compute_fluid(const Store& store, const Study& study, const topography::Topography& topography,
                   const contact::State& dry, const ScanTasks& tasks, std::size_t pressure,
                   std::size_t condition, const Observer& observer);

/// The wet shares of one stored contact.
void compute_wet_shares(const Store& store, const Task& task, const Task& contact,
                        const analysis::WettingDoses& doses);

/// One row from what is in the store.
void compute_row(const Store& store, const Study& study, const Scan& scan, const ScanTasks& tasks,
                 std::size_t pressure, std::size_t condition);

/// The same row when there is no contact or no film, and why.
void record_failure(const Store& store, const Study& study, const Scan& scan,
                    const ScanTasks& tasks, std::size_t pressure, std::size_t condition,
                    const std::string& error);

}  // namespace tabor::study
