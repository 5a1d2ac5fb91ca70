#pragma once

#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

namespace tabor::test {

/// Where validation rows say a number of tests/independent comes from.
inline std::string independent_source(const std::string& name) {
  return "tests/independent/" + name + ".py";
}

/// A number of tests/independent/NAME.json, which NAME.py computes without tabor; `path`: its keys
/// from the outside in. Throws where there is none.
inline double independent(const std::string& name, std::initializer_list<std::string> path) {
  std::ifstream file(std::string(TABOR_SOURCE_DIR) + "/tests/independent/" + name + ".json");
  nlohmann::json value = nlohmann::json::parse(file);
  for (const std::string& key : path) value = nlohmann::json(value.at(key));
  return value.get<double>();
}

}  // namespace tabor::test
