#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/scan/formats/format.hpp"
#include "tabor/scan/formats/text_grid.hpp"
#include "tabor/scan/formats/text_header.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

// Turns the numbers of a text file into layers: a matrix, points x y z, or a profile.
namespace tabor::scan::format {

/// Layers that the numbers after one header form.
struct TextLayers {
  std::string format;  ///< "matrix", "xyz", "profile"
  std::vector<Layer> layers;
  std::vector<std::string> warnings = {};
};

/// Returns a layer of the header's name, unit and scale without heights.
Layer layer_of(const TextHeader& header, Index ny, Index nx);
/// Returns the same layer with these heights, which are complete.
Layer layer_of(const TextHeader& header, Field heights);

/// Return column `i` of the table from row `first_row` on, or a row from column `first_column` on.
TextColumn column_of(const TextNumbers& numbers, std::size_t i, std::size_t first_row = 0);
TextColumn row_of(const TextNumbers& numbers, std::size_t i, std::size_t first_column = 0);

/// Reads points x y z of a regular grid, or a profile x z, recognised by the names or the values of
/// the columns; nullopt for numbers that may be a map. Throws InputError for columns of
/// coordinates, by name or by value, that form neither: coordinates are never heights.
std::optional<TextLayers> read_table(const Contents& contents, const TextNumbers& numbers,
                                     const TextHeader& header);

}  // namespace tabor::scan::format
