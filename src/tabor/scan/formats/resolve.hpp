#pragma once

#include "tabor/scan/formats/format.hpp"

// Chooses the channel, the pixel size and the height scale from the file and the user's options.
namespace tabor::scan::format {

/// Returns the public list of channels of a document.
std::vector<Channel> channels_of(const Document& document);

/// Returns the layer that the user asked for, or the only one with heights. Throws InputError
/// listing the channels when several hold heights, none does, or the name is unknown.
const Layer& choose_layer(const Contents& contents, const Document& document,
                          const ReadOptions& options);

/// Returns the grid of a layer from its own pixel size or the user's. Contradictions are rejected
/// unless overridden; then they are noted in `warnings`.
Grid resolve_grid(const Contents& contents, const Layer& layer, const ReadOptions& options,
                  std::vector<std::string>& warnings);

/// Returns metres per stored value, by the same rules.
double resolve_height_factor(const Contents& contents, const Layer& layer,
                             const ReadOptions& options, std::vector<std::string>& warnings);

}  // namespace tabor::scan::format
