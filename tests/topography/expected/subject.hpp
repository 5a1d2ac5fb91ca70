#pragma once

#include <map>
#include <string>
#include <vector>

#include "tabor/topography/levelling.hpp"
#include "tabor/topography/parameters.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::topography::test {

/// A surface with what is asked about it, computed once.
class Subject {
 public:
  explicit Subject(Topography as_read) : as_read_(std::move(as_read)) {}

  const Topography& as_read() const { return as_read_; }
  const Topography& levelled(Form form);
  const Parameter& parameter(Form form, ParameterSet set, const std::string& symbol);

 private:
  Topography as_read_;
  std::map<Form, Topography> levelled_;
  std::map<std::pair<Form, ParameterSet>, std::vector<Parameter>> parameters_;
};

/// The measured scan of that name, read with what the file itself leaves open.
Topography read_shared_scan(const std::string& file);
bool needs_gwyddion(const std::string& file);

}  // namespace tabor::topography::test
