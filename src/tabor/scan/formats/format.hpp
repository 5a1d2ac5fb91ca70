#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/files/mapped_file.hpp"
#include "tabor/scan/file.hpp"

// Defines what a reader returns for a file, and the table of formats.
namespace tabor::scan::format {

/// Bytes of a whole scan file, or of a part of one with a layout of its own.
struct Contents {
  std::filesystem::path file;
  std::string_view bytes;
  const io::MappedFile* source = nullptr;  ///< what `bytes` lie in, if they are a file's
  const Observer* observer = nullptr;      ///< who follows the reading

  /// Returns the contents of a part of the same file: an unpacked member, a block.
  Contents part(std::string_view bytes_of_part) const {
    return {file, bytes_of_part, source, observer};
  }
  /// Releases the memory of decoded bytes and reports that `share` of the reading is done. Throws
  /// Interrupted.
  void finished(std::string_view decoded, double share) const;
};

/// Image channel as the file describes it. A stored value times `scale` is the height in `unit`;
/// members that the file does not give stay empty and are asked from the user.
struct Layer {
  std::string name = {};
  std::string unit = {};    ///< as in the file; "" if the file does not say
  double scale = 1;         ///< stored value -> `unit`
  bool is_count = false;    ///< integers without any scale: needs ReadOptions::z_scale
  bool is_picture = false;  ///< known not to hold heights (intensity, colour), whatever its unit
  std::optional<int> index = {};  ///< number the file itself gives the channel, else its position
  Index nx = 0;
  Index ny = 0;
  std::optional<double> pixel_x = {};  ///< [m]; what no pixel can be is rejected when it is read
  std::optional<double> pixel_y = {};  ///< [m]
  std::string said_x = {};             ///< the file's words for it: "Increment 0 of axis CX"
  std::string said_y = {};
  std::optional<double> pixel_ratio = {};  ///< y over x, where the file gives no more
  std::string pixel_hint = {};  ///< what the file says about the missing pixel, for the message
  std::function<Field()> load = {};  ///< stored values (ny, nx), row 0 on top, NaN = hole
  std::shared_ptr<std::vector<std::string>> late_warnings = {};  ///< what load() found, or null
};

/// Content of a file before any heights are loaded.
struct Document {
  std::string format = {};  ///< name in the format table, or from a converter
  std::string instrument = {};
  std::map<std::string, std::string> metadata = {};
  std::vector<std::string> warnings = {};  ///< what the reader had to assume
  Warnings lasting = {};                   ///< recorded in the file; they always hold
  std::vector<std::string> history = {};   ///< treatment recorded in the file
  bool periodic = false;
  double tiles = 1;                             ///< as Topography has it
  std::optional<topography::Edges> edges = {};  ///< the same
  std::vector<Layer> layers = {};
};

enum class Match { no, maybe, yes };

/// Bytes from the start of a file that identify() may look at.
inline constexpr std::size_t kHeadSize = 4096;

/// Row of the format table: all that tabor knows about a format. Readers describe a file; choosing
/// the channel, applying the user's options and checking units is the same for all, in resolve.hpp.
struct Format {
  std::string name;
  std::string description;
  std::vector<std::string> extensions;
  Match (*identify)(std::string_view head) = nullptr;  ///< null: cannot be read
  Document (*open)(const Contents& contents) = nullptr;
  void (*write)(const topography::Topography& topography,
                const std::filesystem::path& file) = nullptr;
  bool via_gwyddion = false;
  /// What writing changes, for the user; null: nothing.
  std::string (*note)(const topography::Topography& topography) = nullptr;
};

/// Returns all formats in the order in which they are tried.
const std::vector<Format>& table();

/// Thrown by open() when the container is not this format after all (a ZIP archive without
/// main.xml): the next format is tried.
class Unrecognised : public InputError {
 public:
  Unrecognised(const Contents& contents, const std::string& got, const std::string& remedy)
      : InputError(contents.file.string(), got, "a scan file", remedy),
        got_(got),
        remedy_(remedy) {}
  const std::string& got() const { return got_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string got_;
  std::string remedy_;
};

/// Returns the document of the first format in the table that recognises the content, but for the
/// format named `except`. Throws InputError if none does.
Document open_document(const Contents& contents, std::string_view except = {});

/// Throws InputError "<file>: got ...; expected ...; <remedy>".
[[noreturn]] void reject(const Contents& contents, const std::string& got,
                         const std::string& expected, const std::string& remedy = "");

/// Throws IncompleteError for a sound file that lacks information which only the user has.
[[noreturn]] void ask(const Contents& contents, const std::string& got, const std::string& expected,
                      const std::string& remedy);

/// Remedy for all files that end too early or contradict themselves.
inline constexpr const char* kDamaged = "the file is damaged or truncated: export or copy it again";

/// Rejects sizes below one pixel and sizes that need more samples than `available`: a header must
/// not make a reader allocate more than its file can hold.
void check_size(const Contents& contents, double nx, double ny, std::size_t available);

/// Rejects sizes of packed samples: `sample_bytes` each, packed into `packed_bytes` by a factor of
/// at most `ratio`. Their number is not known before they are unpacked.
void check_packed_size(const Contents& contents, double nx, double ny, std::size_t packed_bytes,
                       std::size_t ratio, std::size_t sample_bytes);

/// True where a pixel can have this length [m]. Beyond, squares of lengths leave the range of
/// numbers.
bool is_pixel(double length);

/// Returns a number of a header, for Layer::said_x: NaN for text that is no number.
std::optional<double> stated_number(std::string_view text);

inline constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

}  // namespace tabor::scan::format
