#pragma once

#include <string>

/// Tiny scan files of formats that programs exchange, made byte by byte from their published
/// descriptions: 3 x 2 pixels of 2 um x 4 um with the stored values 1 2 3 / 4 5 hole, unless said
/// otherwise.
namespace tabor::test {

/// Classic NetCDF as SurfaceTopography lays it out: x is the slow index, a mask marks the hole,
/// heights in um. `version`: 1, 2 or 5.
std::string netcdf(int version = 2);
/// A line scan at the positions 0 1 3 4.5 um with the heights 1 2 0 3 um.
std::string netcdf_line();

std::string opdx();  ///< values in nm, scaled by 0.5
/// A measurement whose only item of 2D_Data is a number.
std::string opdx_number(const std::string& name, double value);
std::string zygo_points();  ///< no unit; pixels of 2 um x 2 um
std::string zygo_counts();  ///< 600 nm, scale 0.5, 4096 counts; pixels of 2 um x 2 um

/// A container of contact.engineering around netcdf(). `index`: its name, index.json or meta.yml.
std::string container(const std::string& index = "meta.yml");
/// A container around a file of an instrument without unit and size, which the index knows.
std::string container_of_original(const std::string& name, const std::string& bytes,
                                  const std::string& size = "[6, 8]");

/// A spreadsheet of a profile: positions 0.1 to 0.4 mm, heights 1 2 4 8 um.
std::string mitutoyo();

/// Surface and intensity, one object after the other.
std::string layered_sur();

}  // namespace tabor::test
