#pragma once

#include <map>
#include <string>
#include <vector>

#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::scan::test {

/// A surface with what is asked about it, computed once.
class Subject {
 public:
  explicit Subject(topography::Topography as_read) : as_read_(std::move(as_read)) {}

  const topography::Topography& as_read() const { return as_read_; }
  const topography::Topography& levelled(topography::Form form);
  const metrology::Parameter& parameter(topography::Form form, metrology::ParameterSet set,
                                        const std::string& symbol);

 private:
  topography::Topography as_read_;
  std::map<topography::Form, topography::Topography> levelled_;
  std::map<std::pair<topography::Form, metrology::ParameterSet>, std::vector<metrology::Parameter>>
      parameters_;
};

/// The measured scan of that name, read with what the file itself leaves open.
topography::Topography read_shared_scan(const std::string& file);
bool needs_gwyddion(const std::string& file);

}  // namespace tabor::scan::test
