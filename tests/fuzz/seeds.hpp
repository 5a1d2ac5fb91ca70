#pragma once

#include <string>
#include <vector>

namespace tabor::fuzz {

/// A sound input that mutations start from.
struct Seed {
  std::string target;
  std::string name;
  std::string bytes;
};

/// At least one for every target: files of our writers, files made byte by byte from published
/// layouts, and texts.
std::vector<Seed> seeds();

}  // namespace tabor::fuzz
