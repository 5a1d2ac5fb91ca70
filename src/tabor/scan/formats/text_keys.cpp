// Keys and values in the headers of text exports.
#include "tabor/scan/formats/text_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::scan::format {
namespace {

/// What a key of Gwyddion's export means, in the languages it is translated to.
enum class Meaning { none, channel, width, height, unit };

Meaning meaning_of(std::string_view key) {
  using enum Meaning;
  static constexpr std::array keys{std::pair<std::string_view, Meaning>{"channel", channel},
                                   std::pair<std::string_view, Meaning>{"width", width},
                                   std::pair<std::string_view, Meaning>{"height", height},
                                   std::pair<std::string_view, Meaning>{"value units", unit},
                                   std::pair<std::string_view, Meaning>{"kanal", channel},
                                   std::pair<std::string_view, Meaning>{"breite", width},
                                   std::pair<std::string_view, Meaning>{"höhe", height},
                                   std::pair<std::string_view, Meaning>{"h\xf6he", height},
                                   std::pair<std::string_view, Meaning>{"einheiten", unit},
                                   std::pair<std::string_view, Meaning>{"kanál", channel},
                                   std::pair<std::string_view, Meaning>{"Šířka", width},
                                   std::pair<std::string_view, Meaning>{"výška", height},
                                   std::pair<std::string_view, Meaning>{"jednotky hodnot", unit},
                                   std::pair<std::string_view, Meaning>{"canal", channel},
                                   std::pair<std::string_view, Meaning>{"largeur", width},
                                   std::pair<std::string_view, Meaning>{"hauteur", height},
                                   std::pair<std::string_view, Meaning>{"unités", unit},
                                   std::pair<std::string_view, Meaning>{"canale", channel},
                                   std::pair<std::string_view, Meaning>{"larghezza", width},
                                   std::pair<std::string_view, Meaning>{"altezza", height},
                                   std::pair<std::string_view, Meaning>{"unità valore", unit},
                                   std::pair<std::string_view, Meaning>{"anchura", width},
                                   std::pair<std::string_view, Meaning>{"altura", height},
                                   std::pair<std::string_view, Meaning>{"unidades de valor", unit},
                                   std::pair<std::string_view, Meaning>{"チャネル", channel},
                                   std::pair<std::string_view, Meaning>{"幅", width},
                                   std::pair<std::string_view, Meaning>{"高さ", height},
                                   std::pair<std::string_view, Meaning>{"値の単位", unit},
                                   std::pair<std::string_view, Meaning>{"Канал", channel},
                                   std::pair<std::string_view, Meaning>{"Ширина", width},
                                   std::pair<std::string_view, Meaning>{"Высота", height},
                                   std::pair<std::string_view, Meaning>{"Единицы измерения", unit}};
  for (const auto& [known, meaning] : keys) {
    if (key == known) return meaning;
  }
  return key.starts_with("wert") ? unit : none;
}

/// A number with a decimal point or comma.
std::optional<double> number_of(std::string_view text) {
  std::string plain(trim(text));
  std::replace(plain.begin(), plain.end(), ',', '.');
  return parse_number(plain);
}

/// "10.00 µm" or "10,00 µm" in metres, whatever number it is; nullopt without a unit of length.
std::optional<double> length_of(std::string_view text) {
  std::size_t end = std::min(text.find_first_not_of("+-0123456789.,eE"), text.size());
  if (!number_of(text.substr(0, end))) end = std::min(text.find(' '), text.size());
  const auto number = number_of(text.substr(0, end));
  const auto factor = unit_factor(text.substr(end), dimension::length);
  return number && factor ? std::optional(*number * *factor) : std::nullopt;
}

/// A length of the header; one without a unit is not known, which is said.
void read_length(const KeyLine& line, std::optional<double>& length, std::string& said,
                 TextHeader& header) {
  said = fmt::format("{} '{}'", line.key, line.value);
  length = length_of(line.value);
  if (!length && header.pixel_hint.empty()) {
    header.pixel_hint = fmt::format("{}, no length with its unit", said);
  }
}

double positive(const Contents& contents, std::string_view text) {
  const auto value = number_of(text);
  if (!value || !(*value > 0)) {
    reject(contents, fmt::format("'{}' in its header", trim(text)), "a positive number", kDamaged);
  }
  return *value;
}

void read_gwyddion(const KeyLine& line, TextHeader& header) {
  switch (meaning_of(line.key)) {
    case Meaning::channel:
      header.channel = line.value;
      break;
    case Meaning::width:
      read_length(line, header.width, header.said_x, header);
      header.is_map = true;
      break;
    case Meaning::height:
      read_length(line, header.height, header.said_y, header);
      break;
    case Meaning::unit:
      header.unit = line.value;
      break;
    case Meaning::none:
      break;
  }
}

/// Wyko's "key=value" lines; the first line has two of them.
void read_wyko(const Contents& contents, const KeyLine& line, TextHeader& header) {
  header.is_map = true;
  if (line.key == "h") {
    header.ny = positive(contents, line.value.substr(0, line.value.find(' ')));
    const std::size_t second = line.value.find("w=");
    if (second != std::string_view::npos) {
      header.nx = positive(contents, line.value.substr(second + 2));
    }
  }
  if (line.key == "pixel size") {
    read_length(line, header.pixel_x, header.said_x, header);
    header.pixel_y = header.pixel_x;
    header.said_y = header.said_x;
  }
  if (line.key == "data unit" && header.unit.empty()) header.unit = line.value;
  if (line.key.starts_with("height conversion factor")) {
    header.scale = positive(contents, line.value);
    const std::size_t arrow = line.key.find("->");
    const std::size_t bracket = line.key.find(')');
    if (arrow != std::string::npos && bracket != std::string::npos) {
      header.unit = trim(std::string_view(line.key).substr(arrow + 2, bracket - arrow - 2));
    }
  }
}

bool is_wyko(std::string_view key) {
  return key == "h" || key == "pixel size" || key == "data unit" ||
         key.starts_with("height conversion factor");
}

constexpr std::array<std::string_view, 11> kSpipKeys{
    "x-pixels", "y-pixels", "x-length", "y-length",   "x-unit",     "y-unit",
    "z-unit",   "bit2nm",   "display",  "voidpixels", "file format"};

/// "[nm]" without its brackets.
std::string without_brackets(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  return std::string(trim(text));
}

constexpr std::string_view kNovaFirst = "file format";

}  // namespace

KeyLine key_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t"), line.size()));
  constexpr std::string_view wide_colon = "：";
  const std::size_t wide = line.find(wide_colon);
  const std::size_t end = std::min(line.find_first_of(":="), wide);
  if (end == std::string_view::npos) return {};
  const std::size_t size = end == wide ? wide_colon.size() : 1;
  return {.key = lower(trim(line.substr(0, end))), .value = trim(line.substr(end + size))};
}

bool is_known_key(const KeyLine& line) {
  const Meaning meaning = meaning_of(line.key);
  // A remark may say a height or a value; a channel or a width is one of a map.
  if (meaning == Meaning::width) return length_of(line.value).has_value();
  return meaning == Meaning::channel || line.key == "x-pixels" || line.key == "file format";
}

bool is_assignment(std::string_view line) {
  if (line.find('=') == std::string_view::npos) return false;
  const KeyLine pair = key_of(line);
  return is_wyko(pair.key) || (pair.key == kNovaFirst && lower(pair.value) == "ascii");
}

void TextKeys::read(const Contents& contents, std::string_view line, TextHeader& header) {
  const KeyLine pair = key_of(line);
  const bool is_comment = line.starts_with('#') || line.starts_with("//");
  if (is_nova_) {
    read_nova(pair, header);
    if (lower(line).starts_with("start of data")) is_nova_ = false;
  } else if (is_comment) {
    const bool is_spip = std::find(kSpipKeys.begin(), kSpipKeys.end(), pair.key) != kSpipKeys.end();
    is_spip ? read_spip(pair, header) : read_gwyddion(pair, header);
  } else if (pair.key == kNovaFirst) {
    is_nova_ = true;
    has_nova_ = true;
    header.is_map = true;
  } else if (is_assignment(line)) {
    read_wyko(contents, pair, header);
  }
}

/// SPIP's "# x-length = 2000", in nanometres if it names no unit; Attocube's "# x-length: 2000".
void TextKeys::read_spip(const KeyLine& line, TextHeader& header) {
  if (line.key == "file format") return;
  const auto number = number_of(line.value);
  if (line.key == "x-pixels") header.nx = number;
  if (line.key == "y-pixels") header.ny = number;
  if (line.key == "x-length") x_.number = number.value_or(kHole);
  if (line.key == "y-length") y_.number = number.value_or(kHole);
  if (line.key == "x-length") x_.said = fmt::format("x-length {}", line.value);
  if (line.key == "y-length") y_.said = fmt::format("y-length {}", line.value);
  if (line.key == "x-unit") x_.unit = without_brackets(line.value);
  if (line.key == "y-unit") y_.unit = without_brackets(line.value);
  if (line.key == "z-unit") header.unit = without_brackets(line.value);
  if (line.key == "bit2nm") scale_ = number;
  if (line.key == "display") header.channel = line.value;
  if (line.key == "voidpixels") header.n_void = number.value_or(0);
  has_spip_ = has_spip_ || x_.number || y_.number;
  header.is_map = header.is_map || x_.number || header.nx;
}

void TextKeys::read_nova(const KeyLine& line, TextHeader& header) {
  const auto number = number_of(line.value);
  if (line.key == "nx") header.nx = number;
  if (line.key == "ny") header.ny = number;
  if (line.key == "scale x") x_.number = number.value_or(kHole);
  if (line.key == "scale y") y_.number = number.value_or(kHole);
  if (line.key == "scale x") x_.said = fmt::format("Scale X {}", line.value);
  if (line.key == "scale y") y_.said = fmt::format("Scale Y {}", line.value);
  if (line.key == "unit x") x_.unit = line.value;
  if (line.key == "unit y") y_.unit = line.value;
  if (line.key == "unit data") header.unit = line.value;
  if (line.key == "scale data") scale_ = number;
  if (line.key == "bias data" && number) bias_ = *number;
  if (line.key == "datascaleneeded") scale_needed_ = lower(line.value);
}

void TextKeys::finish(TextHeader& header) const {
  if (!has_nova_ && !has_spip_) return;
  const auto metres = [&](const Axis& axis, const std::string& unit) -> std::optional<double> {
    const auto factor = unit_factor(unit, dimension::length);
    const bool is_stated = axis.number && *axis.number != 0 && factor;
    return is_stated ? std::optional(*axis.number * *factor) : std::nullopt;
  };
  const std::string x_unit = !x_.unit.empty() ? x_.unit : has_spip_ ? "nm" : "";
  const auto x = metres(x_, x_unit), y = metres(y_, y_.unit.empty() ? x_unit : y_.unit);
  if (has_nova_) {
    header.pixel_x = x;
    header.pixel_y = y;
  } else {
    header.width = x;
    header.height = y;
  }
  header.said_x = x_.said;
  header.said_y = y_.said;
  if (!x || !y) {
    header.pixel_hint = fmt::format("no pixel size in the file ({})", x ? y_.said : x_.said);
  }
  const bool is_scaled = scale_.value_or(0) != 0;
  if (has_spip_ && header.unit.empty() && is_scaled) {
    header.unit = "nm";
    header.scale = *scale_;
  }
  // Without a word about it, data that have a scale need it.
  if (has_nova_ && scale_needed_ != "no" && is_scaled) {
    header.scale = *scale_;
    header.offset = bias_;
  }
}

}  // namespace tabor::scan::format
