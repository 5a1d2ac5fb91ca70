#pragma once

#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {

/// The public list of channels of a document.
std::vector<Channel> channels_of(const Document& document);

/// The layer the user asked for, or the only one with heights. Throws InputError listing the
/// channels when several hold heights, none does, or the name is unknown.
const Layer& choose_layer(const Contents& contents, const Document& document,
                          const ReadOptions& options);

/// The grid of a layer from its own pixel size or the user's. Contradictions are rejected unless
/// overridden; then they are noted in `warnings`.
Grid resolve_grid(const Contents& contents, const Layer& layer, const ReadOptions& options,
                  std::vector<std::string>& warnings);

/// Metres per stored value, by the same rules.
double resolve_height_factor(const Contents& contents, const Layer& layer,
                             const ReadOptions& options, std::vector<std::string>& warnings);

}  // namespace tabor::scan::format
