#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tabor/scan/formats/bytes.hpp"

// Reads and writes the header of classic NetCDF files ("NetCDF Classic Format Specification",
// Unidata): dimensions, attributes and variables.
namespace tabor::scan::format {

/// Value of an attribute: text, or numbers.
using NetcdfValue = std::variant<std::string, std::vector<double>>;
using NetcdfAttributes = std::map<std::string, NetcdfValue>;

/// Named length of arrays. The unlimited dimension has length 0.
struct NetcdfDimension {
  std::string name;
  std::uint64_t length = 0;
};

/// Array of a file.
struct NetcdfVariable {
  std::string name;
  std::vector<NetcdfDimension> dimensions = {};
  NetcdfAttributes attributes = {};
  Sample sample = Sample::f64;
  std::uint64_t begin = 0;  ///< its first byte in the file
};

/// Content of a file but for the values of its variables.
struct NetcdfHeader {
  NetcdfAttributes attributes;
  std::vector<NetcdfVariable> variables;

  /// Returns the variable of this name, or null.
  const NetcdfVariable* variable(std::string_view name) const;
};

/// True for a row of square pixels, which SurfaceTopography stores as a line without y.
bool is_line(const Grid& grid);

/// True where the bytes begin like a classic NetCDF file of versions 1, 2 or 5.
bool is_netcdf(std::string_view head);

/// Reads the header; lists of more than 1024 numbers come back empty. Throws InputError for a
/// damaged one.
NetcdfHeader read_netcdf_header(const Contents& contents);

/// Return an attribute as text or as one number; "" and nullopt if there is no such attribute.
std::string text_of(const NetcdfAttributes& attributes, const std::string& name);
std::optional<double> number_of(const NetcdfAttributes& attributes, const std::string& name);

/// Returns the bytes of a file with 64-bit offsets (version 2) up to the values of its first
/// variable. Sets `begin` of each variable; the caller appends the values in the same order,
/// big-endian and each padded to 4 bytes.
std::string netcdf_header_bytes(NetcdfHeader& header);

}  // namespace tabor::scan::format
