#pragma once

#include <string>

#include "tabor/cases/slide/slide.hpp"
#include "tabor/study/study.hpp"

// Defines the rows of slides.csv.
namespace tabor::study {

/// Row of slides.csv: one state of one slide.
struct SlideRow {
  std::string scan;
  std::string group;
  double lubricant_density = 0;  ///< [kg/m^2]
  cases::SlideRecord state;
};
/// Columns of these rows, with the parts that slides of the study have.
Columns<SlideRow> slide_row_columns(const Study& study);

}  // namespace tabor::study
