// Writes the seeds of every fuzz target: FOLDER/<target>/<name>; without a folder lists the
// targets.
#include <cstdio>
#include <filesystem>

#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"
#include "support/folder.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    for (const auto& target : tabor::fuzz::targets()) std::puts(target.name.c_str());
    return 0;
  }
  for (const tabor::fuzz::Seed& seed : tabor::fuzz::seeds()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / seed.target;
    std::filesystem::create_directories(folder);
    tabor::test::put_bytes(folder / seed.name, seed.bytes);
  }
  return 0;
}
