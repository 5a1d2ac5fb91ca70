#include "tabor/cases/ehl_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/advice.hpp"
#include "tabor/core/error.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/holes.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cases {
namespace {

using topography::Topography;

constexpr const char* kHolesRemedy = "treatment = [\"fill=harmonic\", \"level=plane\"]";

/// Reads a scan. A case names its channel; what else is missing must be in the file.
Topography heights_in(const scan::ScanFile& file, const std::optional<std::string>& channel) {
  scan::ReadOptions options;
  options.channel = channel;
  try {
    return file.read(options);
  } catch (const IncompleteError& error) {
    const auto is_of_channel = [](const Advice& advice) { return advice.setting == "channel"; };
    const std::vector<Advice> missing = advice_in(error.what());
    if (std::all_of(missing.begin(), missing.end(), is_of_channel)) {
      throw InputError(advised(error.what(), [](const Advice& advice) {
        return fmt::format("roughness.channel = \"{}\"", advice.value);
      }));
    }
    throw InputError(fmt::format("{} with 'tabor convert FILE OUT', and name OUT in the case",
                                 advised(error.what(), as_option)));
  }
}

ehl::Surface read(const ehl::NamedScan& named, const Observer& observer) {
  const scan::ScanFile file(named.file, observer);
  const std::string sha256 = file.sha256();
  const Topography scan =
      topography::apply(named.treatment, heights_in(file, named.channel), observer);
  ehl::Surface surface{.grid = scan.grid, .height = scan.height, .sha256 = sha256, .warnings = {}};
  for (const Warning& warning : scan.warnings) {
    surface.warnings.push_back(
        {warning.code, named.file.filename().string() + ": " + without_advice(warning.text)});
  }
  if (!named.rejects_holes_at.empty()) {
    topography::require_no_holes(scan, named.rejects_holes_at, kHolesRemedy);
  }
  return surface;
}

Topography grooves(const ehl::GeneratedSurface& finish) {
  return synthesis::ground({.grid = finish.grid,
                            .rms_height = finish.rms_height,
                            .hurst = finish.hurst,
                            .groove_spacing = finish.roll_off_wavelength,
                            .groove_length = finish.groove_length,
                            .seed = finish.seed});
}

Topography gaussian(const ehl::GeneratedSurface& finish) {
  synthesis::SelfAffine recipe;
  recipe.grid = finish.grid;
  recipe.hurst = finish.hurst;
  recipe.rms_height = finish.rms_height;
  recipe.roll_off_wavelength = finish.roll_off_wavelength;
  recipe.random_amplitudes = true;
  recipe.seed = finish.seed;
  return synthesis::self_affine(recipe);
}

ehl::Surface generate(const ehl::GeneratedSurface& finish) {
  const Topography surface = finish.groove_length > 0 ? grooves(finish) : gaussian(finish);
  return {.grid = surface.grid, .height = surface.height};
}

}  // namespace

ehl::SurfaceSource ehl_surfaces() { return {.read = read, .generate = generate}; }

}  // namespace tabor::cases
