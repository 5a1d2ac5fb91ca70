#pragma once

#include <string_view>

namespace tabor::results {

/// Returns the content of references.bib, which is compiled in.
std::string_view bibliography_text();

}  // namespace tabor::results
