#include "tabor/core/warning.hpp"

#include <algorithm>

namespace tabor {

void add(const Warnings& more, Warnings& list) {
  for (const Warning& warning : more) {
    const bool is_there = std::any_of(list.begin(), list.end(), [&](const Warning& other) {
      return other.code == warning.code && other.text == warning.text;
    });
    if (!is_there) list.push_back(warning);
  }
}

std::vector<std::string> texts_of(const Warnings& warnings) {
  std::vector<std::string> texts;
  texts.reserve(warnings.size());
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
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

}  // namespace tabor
