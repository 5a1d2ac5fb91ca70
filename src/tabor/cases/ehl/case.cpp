#include "tabor/cases/ehl/case.hpp"

namespace tabor::ehl {

void reject_beside(const io::Config& file, std::string_view key, const std::string& other,
                   const std::string& remedy) {
  throw InputError(file.place(key), "beside " + other, "one of the two", remedy);
}

void reject_without(const io::Config& file, std::string_view key, const std::string& other,
                    const std::string& remedy) {
  throw InputError(file.place(key), "without " + other, other + " beside it", remedy);
}

void reject_lone(const io::Config& file, std::span<const LoneKey> keys) {
  for (const LoneKey& key : keys) {
    if (file.has(key.name) && !file.has(key.needed)) reject_without(file, key.name, key.needed);
  }
}

std::filesystem::path named_file(const io::Config& config, std::string_view key) {
  return std::filesystem::path(config.name()).parent_path() / config.text(key);
}

const SurfaceSource& with_source(const io::Config& config, std::string_view key,
                                 const CaseSetting& setting) {
  if (setting.surfaces.read && setting.surfaces.generate) return setting.surfaces;
  throw InputError(config.place(key), "nothing that makes surfaces", "CaseSetting::surfaces",
                   "cases::ehl_surfaces() reads scans and generates finishes");
}

}  // namespace tabor::ehl
