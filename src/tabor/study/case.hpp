#pragma once

#include <string>
#include <vector>

#include "tabor/study/study.hpp"
#include "tabor/study/task.hpp"

namespace tabor::study {

// The tasks of a study, and the texts that their keys are made of. Where a scan has settings of its
// own, the study of its tasks is Study::of(scan).

/// Change it when the same text gives other numbers than before.
inline constexpr int kAlgorithms = 4;
inline constexpr int kFluidAlgorithms = 1;  ///< the same for films that flow alone

/// The treated scan; `scan_sha256` is of the scan file's bytes.
Task surface_task(const Study& study, const Scan& scan, const std::string& scan_sha256);

/// One contact: surface and pressure.
Task contact_task(const Study& study, const Task& surface, double mean_pressure);

/// The films of all densities on one surface.
Task film_task(const Study& study, const Task& surface);

/// The film that flows between one contact's surfaces, under one condition.
Task fluid_task(const Study& study, const Task& contact, const Task& film,
                const Condition& condition);

/// One row of the results. Names of scan and group belong to it: they are columns. `fluid` is null
/// where the oil does not flow.
Task case_task(const Study& study, const Scan& scan, const Task& contact, const Task& film,
               double lubricant_density, const Task* fluid = nullptr);

/// The share of one contact that each of many densities wets.
inline constexpr const char* kWetSharesKind = "wetshares";
Task wet_shares_task(const Study& study, const Task& contact);

/// Everything a study needs of one scan.
struct ScanTasks {
  std::string sha256;
  Task surface;
  Task film;
  std::vector<Task> contacts;             ///< one per pressure
  std::vector<Task> wet_shares;           ///< the same; empty where there are none
  std::vector<std::vector<Task>> cases;   ///< [pressure][condition]
  std::vector<std::vector<Task>> fluids;  ///< the same; empty lists where the oil does not flow
};

/// Reads every scan file once, for its digest. Throws InputError.
std::vector<ScanTasks> tasks_of(const Study& study, const Observer& observer = {});

/// "contact surface.x3p 7 MPa": what a person watching calls the task.
std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure = 0);

}  // namespace tabor::study
