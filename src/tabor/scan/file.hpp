#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

// Opens scan files of any known format, lists their channels, reads heights and writes scans.
namespace tabor::scan {

/// Image channel of a scan file.
struct Channel {
  int index = 0;
  std::string name;
  std::string unit;        ///< as in the file
  bool is_height = false;  ///< its unit is a length (only such channels can be read as heights)
  Index nx = 0;
  Index ny = 0;
};

/// Information from the user that the file lacks. A value that the file fixes takes precedence, and
/// a contradiction is rejected, unless override_unit is set.
struct ReadOptions {
  std::optional<std::string> channel;  ///< name or index
  std::optional<double> pixel_x;       ///< [m]
  std::optional<double> pixel_y;       ///< [m]
  std::optional<std::string> unit;     ///< of the heights in the file: "um", "nm", ...
  std::optional<double> z_scale;       ///< [m] per count, for integer images
  bool override_unit = false;
  /// Origin ("tabor.toml") of the options above that nobody typed ("pixel"), for the warnings
  /// about what they override.
  std::map<std::string, std::string> origin = {};
};

/// Format and channels of a file, without loading heights where the format allows that.
struct FileInfo {
  std::string format;
  std::string instrument;
  std::vector<Channel> channels;
};

/// Row of the explicit, ordered format table.
struct FormatRow {
  std::string name;                     ///< "x3p"
  std::string description;              ///< "ISO 25178-72 / 5436-2 XML"
  std::vector<std::string> extensions;  ///< {".x3p"}
  bool reads = false;
  bool writes = false;
  bool via_gwyddion = false;
};

/// Returns all formats, in the order in which they are tried.
std::vector<FormatRow> formats();

/// Programs that convert files of other formats, the preferred one first.
inline constexpr std::array kGwyddionPrograms{"gwyddion", "gwyconvert"};

/// Returns the program that converts files of other formats, the first of the list, if one is
/// installed.
std::optional<std::filesystem::path> gwyddion_program();

/// Opens a scan file: recognises it by its content and describes it without loading heights. The
/// file must not be changed meanwhile.
class ScanFile {
 public:
  /// Throws InputError (file, what was found, what to do); Interrupted when the observer stops it.
  explicit ScanFile(const std::filesystem::path& file, const Observer& observer = {});
  ~ScanFile();
  ScanFile(ScanFile&&) noexcept;
  ScanFile& operator=(ScanFile&&) = delete;

  /// Returns format and channels.
  FileInfo info() const;
  /// Reads the heights of one channel. Throws InputError where file and options leave a unit open.
  topography::Topography read(const ReadOptions& options = {}) const;
  /// Returns the SHA-256 of the file's bytes, hexadecimal. `between` is called after every 4 MiB;
  /// what it throws ends the reading.
  std::string sha256(const std::function<void()>& between = {}) const;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
};

/// Open a file for one use: its description, or its heights.
FileInfo inspect(const std::filesystem::path& file);
topography::Topography read(const std::filesystem::path& file, const ReadOptions& options = {},
                            const Observer& observer = {});

/// Throws InputError if no format that can be written has the file name's extension.
void require_writer(const std::filesystem::path& file);

/// Writes by the file name's extension (.h5 .x3p .nc .zip .gwy .gsf .sdf .asdf .npy .sur .png
/// .tif .txt .xyz .stl .vti), to a temporary name that is then renamed. Throws OutputError, or
/// InputError for an unknown extension.
void write(const topography::Topography& topography, const std::filesystem::path& file);

/// Returns what a file of this name does not hold exactly, or needs to be read: "16 bits: heights
/// in steps of 2 nm"; "" if there is nothing to say.
std::string note_of(const topography::Topography& topography, const std::filesystem::path& file);

/// Returns the SHA-256 of the file's bytes, hexadecimal.
std::string sha256(const std::filesystem::path& file);

}  // namespace tabor::scan
