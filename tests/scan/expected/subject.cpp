#include "subject.hpp"

#include <stdexcept>

#include "support/scans.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::scan::test {
namespace {

ReadOptions options_for(const std::string& file) {
  ReadOptions options;
  if (file == "afm_512_nm_matrix.txt") options.pixel_x = 1e-6;
  if (file.starts_with("profile_")) {
    options.pixel_x = 1.5e-6;
    options.unit = "um";
  }
  if (file.starts_with("nanovea")) {
    options.pixel_x = 5e-6;
    options.unit = "um";
  }
  if (file == "afm_10um_bruker.di" || file == "afm_20um_asylum.ibw") options.channel = "0";
  return options;
}

}  // namespace

const topography::Topography& Subject::levelled(topography::Form form) {
  const auto found = levelled_.find(form);
  if (found != levelled_.end()) return found->second;
  return levelled_.emplace(form, topography::level(as_read_, form)).first->second;
}

const metrology::Parameter& Subject::parameter(topography::Form form, metrology::ParameterSet set,
                                               const std::string& symbol) {
  std::vector<metrology::Parameter>& known = parameters_[{form, set}];
  if (known.empty()) known = metrology::parameters(levelled(form), {.sets = {set}});
  for (const metrology::Parameter& parameter : known) {
    if (parameter.symbol == symbol) return parameter;
  }
  throw std::out_of_range("no parameter " + symbol);
}

topography::Topography read_shared_scan(const std::string& file) {
  return read(tabor::test::shared_scan(file), options_for(file));
}

bool needs_gwyddion(const std::string& file) {
  return file.ends_with(".frt") || file.ends_with(".di") || file.ends_with(".ibw") ||
         file.ends_with(".tiff");
}

}  // namespace tabor::scan::test
