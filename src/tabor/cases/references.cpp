#include <algorithm>

#include "tabor/cases/states.hpp"

namespace tabor::cases {

std::vector<std::string> references_of(const ContactSettings& settings) {
  std::vector<std::string> keys = {"polonsky1999", "yastrebov2017",
                                   settings.is_periodic() ? "stanley1997" : "love1929"};
  if (settings.solver == contact::Solver::fast) keys.insert(keys.begin(), "rey2017");
  if (settings.saturation_pressure) keys.emplace_back("almqvist2007");
  return keys;
}

std::vector<std::string> references_of(const FilmSettings& settings) {
  if (settings.model == deposition::Model::limit) return {"costagliola2021", "barnes2021"};
  return {"costagliola2021"};
}

std::vector<std::string> references_of(const TrappedSettings& settings) {
  if (!settings.is_asked()) return {};
  return {"costagliola2021"};
}

std::vector<std::string> references_of(const FluidSettings& settings) {
  if (!settings.flows()) return {};
  return {"elrod1981"};
}

std::vector<std::string> references_of(const FrictionSettings&) { return {"bowden1950"}; }

std::vector<std::string> references_of(const CaseSettings& settings) {
  std::vector<std::string> all = references_of(settings.contact);
  add(references_of(settings.film), all);
  add(references_of(settings.friction), all);
  add(references_of(settings.trapped), all);
  add(references_of(settings.fluid), all);
  return all;
}

void add(const std::vector<std::string>& more, std::vector<std::string>& references) {
  for (const std::string& key : more) {
    if (std::find(references.begin(), references.end(), key) == references.end()) {
      references.push_back(key);
    }
  }
}

}  // namespace tabor::cases
