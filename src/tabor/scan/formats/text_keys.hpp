#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tabor/scan/formats/text_header.hpp"

// Interprets single header lines of text exports ("key = value").
namespace tabor::scan::format {

/// Header line "# Key: value" or "key = value"; an empty key for every other line.
struct KeyLine {
  std::string key;  ///< in lower case (of ASCII)
  std::string_view value;
};

KeyLine key_of(std::string_view line);

/// True where a program's text export has this key beside the size or the channel of a map.
bool is_known_key(const KeyLine& line);

/// True where a line that is no comment belongs to a known header: Wyko's and the first of Nova's.
bool is_assignment(std::string_view line);

/// Collects the keys of a header: several lines belong together, such as a length and its unit.
class TextKeys {
 public:
  /// True where all lines belong to the header, up to "Start of Data".
  bool is_nova() const { return is_nova_; }
  void read(const Contents& contents, std::string_view line, TextHeader& header);
  void finish(TextHeader& header) const;

 private:
  void read_spip(const KeyLine& line, TextHeader& header);
  void read_nova(const KeyLine& line, TextHeader& header);

  /// Length, or step, of one axis.
  struct Axis {
    std::optional<double> number = {};
    std::string said = {};
    std::string unit = {};
  };
  Axis x_, y_;
  bool is_nova_ = false;
  bool has_nova_ = false;  ///< steps of pixels, not lengths
  bool has_spip_ = false;
  std::string scale_needed_;
  std::optional<double> scale_;
  double bias_ = 0;
};

}  // namespace tabor::scan::format
