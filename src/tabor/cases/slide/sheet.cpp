#include "tabor/cases/slide/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/loops.hpp"
#include "tabor/metrology/areal/abbott.hpp"
#include "tabor/metrology/spectra/psd.hpp"

namespace tabor::cases {

double mean_patch_length(const Mask& contact) {
  double n_ends = 0;
  for (Index y = 0; y < contact.rows(); ++y) {
    for (Index x = 0; x < contact.cols(); ++x) {
      if (contact(y, x) && !contact(y, (x + 1) % contact.cols())) n_ends += 1;
    }
  }
  return static_cast<double>(contact.count()) / std::max(1.0, n_ends);
}

ByteMap state_map(const Mask& touching, const Field& pressure, const contact::Caps& caps) {
  ByteMap state(touching.rows(), touching.cols());
  for_each(state.size(), [&](Index i) {
    const bool is_saturated = touching(i) && contact::at_cap(pressure(i), caps(i));
    state(i) = static_cast<std::uint8_t>(touching(i) + is_saturated);
  });
  return state;
}

void measure(const Field& sheet, SlideRecord& record) {
  const double mean = sheet.mean();
  record.rms_height = std::sqrt((sheet - mean).square().mean());
  record.mean_roughness = (sheet - mean).abs().mean();
  const metrology::Core core = metrology::AbbottCurve(sheet).core();
  record.core_height = core.height;
  record.peak_height = core.peak_height;
  record.dale_height = core.dale_height;
}

SheetSpectra spectra_of_sheet(const topography::Topography& sheet) {
  metrology::PowerSpectra found = metrology::power_spectra(sheet);
  return {.q_x = std::move(found.x.q),
          .density_x = std::move(found.x.density),
          .q_y = std::move(found.y.q),
          .density_y = std::move(found.y.density)};
}

}  // namespace tabor::cases
