#pragma once

#include "tabor/elastic/border.hpp"
#include "tabor/spectral/fft.hpp"

// Chooses the convolution that continues a map beyond its borders.
namespace tabor::elastic {

inline spectral::Padding padding_of(Border border) {
  if (border == Border::repeats) return spectral::Padding::none;
  return border == Border::mirrors ? spectral::Padding::mirror : spectral::Padding::zero;
}

}  // namespace tabor::elastic
