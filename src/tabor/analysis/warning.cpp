#include "tabor/analysis/warning.hpp"

#include <algorithm>

namespace tabor::analysis {

const std::vector<CodeEntry>& all_codes() {
  static const std::vector<CodeEntry> entries{{"file", About::surface},
                                              {"profile", About::surface},
                                              {"pixels-not-square", About::surface},
                                              {"slow-size", About::surface},
                                              {"missing-pixels", About::surface},
                                              {"tilt", About::surface},
                                              {"height-steps", About::surface},
                                              {"spikes", About::surface},
                                              {"despiked", About::surface},
                                              {"filter", About::surface},
                                              {"filled-holes", About::surface},
                                              {"not-levelled", About::surface},
                                              {"not-periodic", About::surface},
                                              {"steep", About::surface},
                                              {"hurst", About::surface},
                                              {"not-converged", About::contact},
                                              {"stiffness", About::contact},
                                              {"area-correction", About::contact},
                                              {"above-hardness", About::contact},
                                              {"resolution", About::contact},
                                              {"edge-load", About::contact},
                                              {"clamp", About::contact},
                                              {"flood", About::film},
                                              {"filtered", About::film},
                                              {"few-droplets", About::film},
                                              {"oil-lost", About::film},
                                              {"spill-over", About::friction},
                                              {"pixel", About::friction},
                                              {"frictionless", About::friction},
                                              {"implausible-friction", About::friction},
                                              {"fluid-film", About::flow}};
  return entries;
}

About about(std::string_view code) {
  for (const CodeEntry& entry : all_codes()) {
    if (entry.code == code) return entry.about;
  }
  return About::surface;
}

void add(const Warnings& more, Warnings& list) {
  for (const Warning& warning : more) {
    const bool is_there = std::any_of(list.begin(), list.end(), [&](const Warning& other) {
      return other.code == warning.code && other.text == warning.text;
    });
    if (!is_there) list.push_back(warning);
  }
}

std::vector<std::string> codes_of(const Warnings& warnings) {
  std::vector<std::string> codes;
  for (const Warning& warning : warnings) {
    if (std::find(codes.begin(), codes.end(), warning.code) == codes.end()) {
      codes.push_back(warning.code);
    }
  }
  return codes;
}

}  // namespace tabor::analysis
