#include "tabor/cases/warning.hpp"

namespace tabor::cases {

const std::vector<CodeEntry>& all_codes() {
  static const std::vector<CodeEntry> entries{
      {"file", About::surface, Class::doubt},
      {"override", About::surface, Class::information},
      {"profile", About::surface, Class::doubt},
      {"pixels-not-square", About::surface, Class::information},
      {"slow-size", About::surface, Class::information},
      {"missing-pixels", About::surface, Class::doubt},
      {"tilt", About::surface, Class::doubt},
      {"height-steps", About::surface, Class::doubt},
      {"spikes", About::surface, Class::doubt},
      {"despiked", About::surface, Class::information},
      {"row-jumps", About::surface, Class::doubt},
      {"filter", About::surface, Class::doubt},
      {"filter-wraps", About::surface, Class::doubt},
      {"filled-holes", About::surface, Class::doubt},
      {"not-levelled", About::surface, Class::doubt},
      {"not-periodic", About::surface, Class::doubt},
      {"steep", About::surface, Class::doubt},
      {"hurst", About::surface, Class::doubt},
      {"not-converged", About::contact, Class::doubt},
      {"stiffness", About::contact, Class::doubt},
      {"area-correction", About::contact, Class::doubt},
      {"above-hardness", About::contact, Class::doubt},
      {"resolution", About::contact, Class::doubt},
      {"edge-load", About::contact, Class::doubt},
      {"seam-load", About::contact, Class::doubt},
      {"clamp", About::contact, Class::doubt},
      {"rough-tool", About::contact, Class::doubt},
      {"flood", About::film, Class::doubt},
      {"filtered", About::film, Class::doubt},
      {"few-droplets", About::film, Class::doubt},
      {"oil-lost", About::film, Class::doubt},
      {"overdosed", About::film, Class::doubt},
      {"spill-over", About::friction, Class::doubt},
      {"flooded", About::friction, Class::doubt},
      {"pixel", About::friction, Class::doubt},
      {"frictionless", About::friction, Class::doubt},
      {"implausible-friction", About::friction, Class::doubt},
      {"tool-pixel", About::friction, Class::doubt},
      {"milling", About::friction, Class::doubt},
      {"not-steady", About::friction, Class::doubt},
      {"tool-envelope", About::friction, Class::information},
      {"trapped-oil", About::friction, Class::doubt},
      {"leaked", About::friction, Class::doubt},
      {"fluid-film", About::flow, Class::doubt},
      {"viscosity-law", About::flow, Class::doubt},
      {"density-law", About::flow, Class::doubt},
      {"fluid-pressure", About::flow, Class::doubt},
      {"rejected", About::ehl, Class::doubt},
      {"no-film", About::ehl, Class::doubt},
      {"coarse-grid", About::ehl, Class::doubt},
      {"coarse-roughness", About::ehl, Class::doubt},
      {"coarse-steps", About::ehl, Class::doubt},
      {"short-domain", About::ehl, Class::doubt},
      {"short-inlet", About::ehl, Class::doubt},
      {"short-outlet", About::ehl, Class::doubt},
      {"newtonian-shear", About::ehl, Class::doubt},
      {"boundary-friction", About::ehl, Class::doubt},
      {"resting-roughness", About::ehl, Class::doubt},
      {"pressure-spike", About::ehl, Class::doubt},
      {"dry-contact", About::ehl, Class::doubt},
      {"lost-film", About::ehl, Class::doubt},
      {"no-rebound", About::ehl, Class::doubt}};
  return entries;
}

namespace {

/// Null for a code that is not in the list.
const CodeEntry* entry_of(std::string_view code) {
  for (const CodeEntry& entry : all_codes()) {
    if (entry.code == code) return &entry;
  }
  return nullptr;
}

}  // namespace

About about(std::string_view code) {
  const CodeEntry* entry = entry_of(code);
  return entry != nullptr ? entry->about : About::surface;
}

Class class_of(std::string_view code) {
  const CodeEntry* entry = entry_of(code);
  return entry != nullptr ? entry->kind : Class::doubt;
}

const char* name_of(Class kind) { return kind == Class::doubt ? "doubt" : "information"; }

}  // namespace tabor::cases
