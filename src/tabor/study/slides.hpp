#pragma once

#include <string>
#include <vector>

#include "tabor/cases/slide/slide.hpp"
#include "tabor/engine/job.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/study/case.hpp"
#include "tabor/study/slide_rows.hpp"

// Slides of a study: one per scan, pressure and density, whose states stand in slides.csv.
namespace tabor::study {

/// One slide as the store has it.
struct StoredSlide {
  std::vector<cases::SlideRecord> states;
  Warnings warnings;
  std::string error = {};  ///< why there are no states
  bool converged = false;
};
void write_slide(const engine::Store& store, const engine::Task& task, const StoredSlide& slide);
/// Throws InputError for a file that is damaged or of another task.
StoredSlide read_slide(const engine::Store& store, const engine::Task& task);

/// Slides on a surface under one pressure and density of a study of one scan. While it runs its
/// state stands in the store, so that a killed study goes on within it.
StoredSlide compute_slide(const engine::Store& store, const engine::Task& task, const Study& study,
                          const topography::Topography& surface, double mean_pressure,
                          double lubricant_density, const Observer& observer = {});

/// Slides of a study that the store holds so far, in the order scan, pressure, density.
struct StudySlides {
  std::vector<SlideRow> rows;
  std::vector<results::Case> warnings;  ///< of each slide
  std::vector<std::string> failures;    ///< one line for each that failed
};
StudySlides slides_in(const engine::Store& store, const Study& study,
                      const std::vector<ScanTasks>& tasks);

}  // namespace tabor::study
