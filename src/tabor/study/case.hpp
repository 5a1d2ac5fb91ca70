#pragma once

#include <string>
#include <vector>

#include "tabor/engine/task.hpp"
#include "tabor/study/study.hpp"

// Makes the tasks of a study and the texts that their keys are made of. Where a scan has settings
// of its own, the study of its tasks is Study::of(scan).
namespace tabor::study {

/// Version of the algorithms, part of the texts. Raise it when the same text gives other numbers
/// than before.
inline constexpr int kAlgorithms = 5;
inline constexpr int kImageAlgorithms = 2;      ///< the same for films on mirror images alone
inline constexpr int kFluidAlgorithms = 2;      ///< the same for films that flow alone
inline constexpr int kTrappedAlgorithms = 1;    ///< the same for trapped oil alone
inline constexpr int kSlideAlgorithms = 1;      ///< the same for slides alone
inline constexpr int kWetSharesAlgorithms = 2;  ///< the same for wet shares over the density alone

/// Makes the task of the treated scan; `scan_sha256` is of the scan file's bytes.
engine::Task surface_task(const Study& study, const Scan& scan, const std::string& scan_sha256);

/// Makes the task of one contact: surface, pressure and place of the tool.
engine::Task contact_task(const Study& study, const engine::Task& surface, double mean_pressure,
                          std::size_t place = 0);

/// Makes the task of the films of all densities on one surface.
engine::Task film_task(const Study& study, const engine::Task& surface);

/// Makes the task of the oil in one contact whose closed pockets carry load.
engine::Task trapped_task(const Study& study, const engine::Task& contact, const engine::Task& film,
                          double lubricant_density);

/// Makes the task of the film that flows between one contact's surfaces, under one condition.
engine::Task fluid_task(const Study& study, const engine::Task& contact, const engine::Task& film,
                        const Condition& condition);

/// Makes the task of one row of the results. Names of scan and group belong to it: they are
/// columns. `contacts`: one for each place of the tool, with the trapped oil of each where that
/// carries load; `fluid` is null where the oil does not flow.
engine::Task case_task(const Study& study, const Scan& scan,
                       const std::vector<engine::Task>& contacts, const engine::Task& film,
                       double lubricant_density, const std::vector<engine::Task>& trapped = {},
                       const engine::Task* fluid = nullptr);

/// Kind of the tasks of wet shares: the share of one contact that each of many densities wets,
/// those of the study among them.
inline constexpr const char* kWetSharesKind = "wetshares";
engine::Task wet_shares_task(const Study& study, const engine::Task& contact);

/// Makes the task of one slide.
inline constexpr const char* kSlideKind = "slide";
engine::Task slide_task(const Study& study, const engine::Task& surface, double mean_pressure,
                        double lubricant_density);

/// Tasks of one scan.
struct ScanTasks {
  std::string sha256;
  engine::Task surface;
  engine::Task film;
  std::vector<engine::Task> contacts;    ///< pressure by pressure, one per place of the tool
  std::vector<engine::Task> wet_shares;  ///< the same; empty where there are none
  std::vector<std::vector<engine::Task>> cases;  ///< [pressure][condition]
  /// [contact][condition]; empty where trapped oil carries nothing
  std::vector<std::vector<engine::Task>> trapped;
  std::vector<std::vector<engine::Task>>
      fluids;  ///< the same; empty lists where the oil does not flow
  std::vector<std::vector<engine::Task>> slides;  ///< [pressure][density]; empty without sliding
};

/// Reads every scan file once, for its digest. Throws InputError.
std::vector<ScanTasks> tasks_of(const Study& study, const Observer& observer = {});

/// Returns the name of a task in progress messages: "contact surface.x3p 7 MPa".
std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure = 0);

}  // namespace tabor::study
