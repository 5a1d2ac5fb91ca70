#pragma once

#include <string_view>

namespace tabor::analysis {

/// The content of references.bib, compiled in.
std::string_view bibliography_text();

}  // namespace tabor::analysis
