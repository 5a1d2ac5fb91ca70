#pragma once

#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/format.hpp"
#include "tabor/scan/maps.hpp"

/// The readers and writers behind the format table, one .cpp file per format.
namespace tabor::scan::format {

/// Returns the heights as a set of one map.
MapSet as_maps(const topography::Topography& topography, const std::string& name);

Match identify_h5(std::string_view head);
Document open_h5(const Contents& contents);
void write_h5(const topography::Topography& topography, const std::filesystem::path& file);

Match identify_gwy(std::string_view head);
Document open_gwy(const Contents& contents);
void write_gwy(const topography::Topography& topography, const std::filesystem::path& file);
void write_gwy_maps(const MapSet& maps, const std::filesystem::path& file);

Match identify_gsf(std::string_view head);
Document open_gsf(const Contents& contents);
void write_gsf(const topography::Topography& topography, const std::filesystem::path& file);

Match identify_x3p(std::string_view head);
Document open_x3p(const Contents& contents);
void write_x3p(const topography::Topography& topography, const std::filesystem::path& file);

Match identify_sdf(std::string_view head);
Document open_sdf(const Contents& contents);
void write_sdf(const topography::Topography& topography, const std::filesystem::path& file);
Match identify_sdf_ascii(std::string_view head);
Document open_sdf_ascii(const Contents& contents);
void write_sdf_ascii(const topography::Topography& topography, const std::filesystem::path& file);

Match identify_npy(std::string_view head);
Document open_npy(const Contents& contents);
void write_npy(const topography::Topography& topography, const std::filesystem::path& file);
std::string note_npy(const topography::Topography& topography);
void write_npy_map(const MapSet& maps, const std::filesystem::path& file);

Match identify_sur(std::string_view head);
Document open_sur(const Contents& contents);
void write_sur(const topography::Topography& topography, const std::filesystem::path& file);
std::string note_sur(const topography::Topography& topography);

Match identify_nc(std::string_view head);
Document open_nc(const Contents& contents);
void write_nc(const topography::Topography& topography, const std::filesystem::path& file);
/// Appends what write_nc() writes, for files inside of others.
void append_nc(const topography::Topography& topography, const io::Append& append);

Match identify_ce(std::string_view head);
Document open_ce(const Contents& contents);
void write_ce(const topography::Topography& topography, const std::filesystem::path& file);

Match identify_mitutoyo(std::string_view head);
Document open_mitutoyo(const Contents& contents);

Match identify_stylus_text(std::string_view head);
Document open_stylus_text(const Contents& contents);

Match identify_zygo_text(std::string_view head);
Document open_zygo_text(const Contents& contents);

Match identify_opdx(std::string_view head);
Document open_opdx(const Contents& contents);

Match identify_plu(std::string_view head);
Document open_plu(const Contents& contents);

Match identify_al3d(std::string_view head);
Document open_al3d(const Contents& contents);

Match identify_opd(std::string_view head);
Document open_opd(const Contents& contents);

Match identify_metropro(std::string_view head);
Document open_metropro(const Contents& contents);

Match identify_nms(std::string_view head);
Document open_nms(const Contents& contents);

Match identify_tmd(std::string_view head);
Document open_tmd(const Contents& contents);

Match identify_plux(std::string_view head);
Document open_plux(const Contents& contents);

Match identify_vk(std::string_view head);
Document open_vk(const Contents& contents);

Match identify_bcr(std::string_view head);
Document open_bcr(const Contents& contents);

Match identify_datx(std::string_view head);
Document open_datx(const Contents& contents);

Match identify_tiff(std::string_view head);
Document open_tiff(const Contents& contents);
void write_tiff(const topography::Topography& topography, const std::filesystem::path& file);
std::string note_tiff(const topography::Topography& topography);

Match identify_png(std::string_view head);
Document open_png(const Contents& contents);
void write_png(const topography::Topography& topography, const std::filesystem::path& file);
std::string note_png(const topography::Topography& topography);

void write_stl(const topography::Topography& topography, const std::filesystem::path& file);
std::string note_stl(const topography::Topography& topography);

Match identify_pnm(std::string_view head);
Document open_pnm(const Contents& contents);

Match identify_text(std::string_view head);
Document open_text(const Contents& contents);
void write_matrix(const topography::Topography& topography, const std::filesystem::path& file);
void write_xyz(const topography::Topography& topography, const std::filesystem::path& file);
void write_matrix_map(const MapSet& maps, const std::filesystem::path& file);
void write_xyz_map(const MapSet& maps, const std::filesystem::path& file);
void write_csv_maps(const MapSet& maps, const std::filesystem::path& file);

void write_vti(const topography::Topography& topography, const std::filesystem::path& file);
void write_vti_maps(const MapSet& maps, const std::filesystem::path& file);

Match identify_gwyddion(std::string_view head);
/// True for a binary STL file by its size: a header and a number of triangles.
bool is_stl(std::string_view bytes);
Document open_gwyddion(const Contents& contents);

}  // namespace tabor::scan::format
