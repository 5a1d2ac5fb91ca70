#pragma once

#include <filesystem>
#include <string>

/// Tiny scan files of formats that wrap others or carry a text header, made from their published
/// layouts: 3 x 2 pixels of 2 um x 4 um with the stored values 1 2 3 / 4 5 hole, unless said
/// otherwise.
namespace tabor::test {

std::string plux();            ///< values in um
std::string two_layer_plux();  ///< the second layer holds ten times the heights
std::string vk4();             ///< 0.5 nm a count, no hole but 6; a light image beside the heights
std::string vk6();             ///< the same wrapped
std::string bcr();             ///< int16, 0.5 nm a count, big-endian
std::string bcrf(bool wide);   ///< float32 in nm; `wide`: the header in UTF-16
/// 16-bit grey without hole (6 instead), in one strip; `format`: 1 unsigned, 2 signed, 3 float;
/// `missing`: what stands for a missing sample, up to 4 letters.
std::string tiff(int bits = 16, int format = 1, int photometric = 1,
                 const std::string& missing = "");

/// Zygo's HDF5: heights in nm.
void write_datx(const std::filesystem::path& file, const std::string& unit = "NanoMeters");

}  // namespace tabor::test
