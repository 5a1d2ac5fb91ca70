#include "tabor/scan/formats/text_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/text.hpp"

namespace tabor::scan::format {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Words instruments write for a missing height.
bool is_missing(std::string_view field) {
  static constexpr std::string_view words[]{"nan", "-nan", "nm",  "bad",  "inf", "-inf",     "+inf",
                                            "--",  "---",  "***", "null", "n/a", "-nan(ind)"};
  const std::string word = lower(field);
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// True if a number that no double can hold is too small, not too large.
bool is_below_range(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1).starts_with('-');
  return number.find_first_of("123456789") > number.find('.');
}

/// A number with a decimal point or, if told, a decimal comma.
std::optional<double> number(std::string_view field, bool decimal_comma) {
  if (field.starts_with('+')) field.remove_prefix(1);
  std::string replaced;
  if (decimal_comma && field.find(',') != std::string_view::npos) {
    replaced = field;
    std::replace(replaced.begin(), replaced.end(), ',', '.');
    field = replaced;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return is_below_range(field) ? 0.0 : kHole;
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// The same for spellings that the C locale does not know: Fortran's 1.5D-06, a typeset minus.
std::optional<double> foreign_number(std::string_view field, bool decimal_comma) {
  constexpr std::string_view kMinus = "\xE2\x88\x92";
  std::string plain(field);
  for (std::size_t at = 0; (at = plain.find(kMinus, at)) != std::string::npos;) {
    plain.replace(at, kMinus.size(), "-");
  }
  std::replace(plain.begin(), plain.end(), 'D', 'e');
  std::replace(plain.begin(), plain.end(), 'd', 'e');
  return plain == field ? std::nullopt : number(plain, decimal_comma);
}

bool is_comment(std::string_view line) {
  line = trim(line);
  return line.starts_with('#') || line.starts_with("//");
}

/// How the commas of a text are used.
struct Commas {
  bool decimal = false;
  std::string_view doubtful = {};  ///< a line that may be read in two ways, or empty
};

/// The start of a text, whole lines if it has any, else whole fields.
std::string_view sample_of(std::string_view text, char line_end) {
  constexpr std::size_t kSample = 16384;
  if (text.size() <= kSample) return text;
  const std::size_t line = text.rfind(line_end, kSample);
  const std::size_t end =
      line != std::string_view::npos ? line : text.find_last_of(" \t;", kSample);
  return text.substr(0, end);
}

/// What one line says about commas.
struct LineCommas {
  std::size_t between_digits = 0, elsewhere = 0, most_per_field = 0;
  bool has_other_separators = false;
};

LineCommas commas_in(std::string_view line) {
  LineCommas found;
  std::size_t in_field = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ',') {
      const bool inside =
          i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
      ++(inside ? found.between_digits : found.elsewhere);
      found.most_per_field = std::max(found.most_per_field, ++in_field);
    } else if (line[i] == ' ' || line[i] == '\t' || line[i] == ';') {
      in_field = 0;
      // Blanks beside a comma only set it off.
      const std::size_t before = line.find_last_not_of(" \t", i);
      const std::size_t behind = line.find_first_not_of(" \t", i);
      const bool beside = (before != std::string_view::npos && line[before] == ',') ||
                          (behind != std::string_view::npos && line[behind] == ',');
      found.has_other_separators |= line[i] == ';' || !beside;
    }
  }
  return found;
}

/// Commas between digits of fields that something else separates are decimal commas if no field has
/// two of them and no point occurs. "1,5" alone on each line may be two numbers or one.
Commas commas_of(std::string_view text, const TextHints& hints) {
  const char line_end = line_end_of(text);
  text = sample_of(text, line_end);
  bool has_points = false, all_decimal = true, all_pairs = true, separated = false;
  std::size_t n_commas = 0, n_lines = 0;
  std::string_view mixed, first;
  while (!text.empty()) {
    const std::string_view line = trim(take_line(text, line_end));
    if (line.empty() || is_comment(line)) continue;
    const LineCommas found = commas_in(line);
    ++n_lines;
    has_points |= line.find('.') != std::string_view::npos;
    n_commas += found.between_digits;
    separated |= found.has_other_separators;
    all_decimal &= found.elsewhere == 0 && found.most_per_field <= 1;
    all_pairs &= found.between_digits == 1 && found.elsewhere == 0 && !found.has_other_separators;
    if (first.empty()) first = line;
    if (mixed.empty() && found.between_digits > 0 && found.has_other_separators) mixed = line;
  }
  if (n_commas == 0) return {};
  all_decimal &= !has_points;
  all_pairs &= !has_points;
  if (all_decimal && (separated || hints.one_per_line)) return {.decimal = true};
  if (all_pairs && n_lines > 1 && !hints.two_columns) return {.doubtful = first};
  return {.doubtful = mixed};
}

/// What separates fields. Blanks do; so does one hard separator (';' or ','), between two of which
/// an empty field means a missing value.
struct Separators {
  explicit Separators(bool comma_is_decimal) : decimal_comma(comma_is_decimal) {
    for (const char c : {' ', '\t', '\r'}) kinds[static_cast<unsigned char>(c)] = Kind::blank;
    kinds[static_cast<unsigned char>(';')] = Kind::hard;
    if (!decimal_comma) kinds[static_cast<unsigned char>(',')] = Kind::hard;
  }
  enum class Kind : unsigned char { none, blank, hard };
  Kind kind(char c) const { return kinds[static_cast<unsigned char>(c)]; }

  bool decimal_comma;
  std::array<Kind, 256> kinds{};
};

/// Takes field after field from a line.
class Fields {
 public:
  Fields(std::string_view line, const Separators& separators)
      : at_(line.data()), end_(line.data() + line.size()), separators_(&separators) {
    skip_blanks();
  }

  bool at_end() const { return at_ == end_; }
  /// Two tabs in a row were passed: a cell without a number, or columns that are set in line.
  bool has_empty_cell() const { return has_empty_cell_; }

  /// The next field as a number if it is a plain one, which nearly all are.
  std::optional<double> take_plain_number() {
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    const bool whole = stop == end_ || separators_->kind(*stop) != Separators::Kind::none;
    if (error != std::errc{} || !whole) return std::nullopt;
    at_ = stop;
    skip_separator();
    return value;
  }

  std::string_view take() {
    const char* begin = at_;
    while (at_ != end_ && separators_->kind(*at_) == Separators::Kind::none) ++at_;
    const std::string_view field(begin, static_cast<std::size_t>(at_ - begin));
    skip_separator();
    return field;
  }

 private:
  void skip_blanks() {
    for (; at_ != end_ && separators_->kind(*at_) == Separators::Kind::blank; ++at_) {
      n_tabs_ += *at_ == '\t' ? 1 : 0;
    }
  }
  void skip_separator() {
    n_tabs_ = 0;
    skip_blanks();
    if (at_ != end_ && separators_->kind(*at_) == Separators::Kind::hard) {
      ++at_;
      skip_blanks();
    }
    has_empty_cell_ |= n_tabs_ > 1 && at_ != end_;
  }
  const char* at_;
  const char* end_;
  const Separators* separators_;
  int n_tabs_ = 0;
  bool has_empty_cell_ = false;
};

constexpr std::string_view kTwoTabs = "\t\t";

/// Some lines of the text, parsed on their own.
struct Block {
  std::string_view text = {};
  TextNumbers numbers = {};     ///< lines counted from 0
  std::size_t n_lines = 0;      ///< parsed
  std::string_view wrong = {};  ///< the field on line n_lines that is no number, or empty
  std::optional<std::string_view> section = {};  ///< from line n_lines on, which begins another one
};

void add_row(TextNumbers& numbers, std::size_t line, std::size_t n_columns) {
  if (!numbers.rows.empty()) {
    TextRows& last = numbers.rows.back();
    if (last.n_columns == n_columns && last.first_line + last.n_rows == line) {
      ++last.n_rows;
      return;
    }
  }
  numbers.rows.push_back({line, 1, n_columns});
}

/// Adds the numbers of one line; the field that is none, or "".
std::string_view parse_line(std::string_view line, const Separators& separators,
                            std::vector<double>& values) {
  Fields fields(line, separators);
  while (!fields.at_end()) {
    if (const auto plain = fields.take_plain_number()) {
      values.push_back(std::isfinite(*plain) ? *plain : kHole);
      continue;
    }
    const std::string_view field = fields.take();
    auto value = number(field, separators.decimal_comma);
    if (!value && !field.empty() && !is_missing(field)) {
      value = foreign_number(field, separators.decimal_comma);
      if (!value) return field;
    }
    values.push_back(value && std::isfinite(*value) ? *value : kHole);
  }
  return fields.has_empty_cell() ? kTwoTabs : std::string_view();
}

void parse(Block& block, const Separators& separators, char line_end, const TextHints& hints) {
  // No number takes less than a digit and a separator; what is not used is never touched.
  block.numbers.values.reserve(block.text.size() / 2 + 1);
  std::string_view rest = block.text;
  for (; !rest.empty(); ++block.n_lines) {
    const std::size_t before = block.numbers.values.size();
    const std::string_view from_here = rest;
    const std::string_view line = take_line(rest, line_end);
    if (is_comment(line)) {
      if (hints.begins_section == nullptr || !hints.begins_section(trim(line))) continue;
      block.section = from_here;
      return;
    }
    block.wrong = parse_line(line, separators, block.numbers.values);
    if (!block.wrong.empty()) return;
    const std::size_t n_columns = block.numbers.values.size() - before;
    if (n_columns > 0) add_row(block.numbers, block.n_lines, n_columns);
  }
}

/// Whole lines of about kBlockBytes.
std::string_view take_block(std::string_view& text, char line_end) {
  constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
  const std::size_t end =
      text.size() > kBlockBytes ? text.find(line_end, kBlockBytes) : text.size();
  const std::string_view block = text.substr(0, end == std::string_view::npos ? end : end + 1);
  text.remove_prefix(block.size());
  return block;
}

void append(TextNumbers& numbers, Block& block, std::size_t first_line) {
  if (numbers.values.capacity() == 0) {
    numbers.values = std::move(block.numbers.values);
  } else {
    numbers.values.insert(numbers.values.end(), block.numbers.values.begin(),
                          block.numbers.values.end());
  }
  release(block.numbers.values);
  for (TextRows rows : block.numbers.rows) {
    rows.first_line += first_line;
    const bool continues =
        !numbers.rows.empty() && numbers.rows.back().n_columns == rows.n_columns &&
        numbers.rows.back().first_line + numbers.rows.back().n_rows == rows.first_line;
    if (continues) {
      numbers.rows.back().n_rows += rows.n_rows;
    } else {
      numbers.rows.push_back(rows);
    }
  }
}

/// Reserves memory for the numbers of these blocks and, so that they are not copied again, for all
/// that the rest of the text will give if it goes on like the `share` that is parsed.
void reserve_numbers(TextNumbers& numbers, const std::vector<Block>& blocks, double share) {
  constexpr double kMargin = 1.02;
  std::size_t n = numbers.values.size();
  for (const Block& block : blocks) n += block.numbers.values.size();
  if (n <= numbers.values.capacity()) return;
  numbers.values.reserve(static_cast<std::size_t>(kMargin * static_cast<double>(n) / share) + 1);
}

}  // namespace

std::size_t TextNumbers::n_rows() const {
  std::size_t n = 0;
  for (const TextRows& some : rows) n += some.n_rows;
  return n;
}

const TextRows* TextNumbers::odd_rows() const {
  const auto odd = std::find_if(rows.begin(), rows.end(), [this](const TextRows& some) {
    return some.n_columns != n_columns();
  });
  return odd == rows.end() ? nullptr : &*odd;
}

char line_end_of(std::string_view text) {
  const std::size_t first = text.find_first_of("\r\n");
  const bool is_old_macintosh = first != std::string_view::npos && text[first] == '\r' &&
                                first + 1 < text.size() && text[first + 1] != '\n';
  return is_old_macintosh ? '\r' : '\n';
}

std::string_view take_line(std::string_view& text, char line_end) {
  const std::size_t end = std::min(text.find(line_end), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool starts_with_number(std::string_view line) {
  const Separators separators(true);
  Fields fields(trim(line), separators);
  if (fields.at_end()) return false;
  const std::string_view field = fields.take();
  if (is_missing(field)) return true;
  const std::size_t comma = field.find(',');
  const std::string_view first = field.substr(0, comma);
  return number(field, true).has_value() || number(first, false).has_value() ||
         foreign_number(field, true).has_value() || foreign_number(first, false).has_value();
}

namespace {

[[noreturn]] void reject_line(const Contents& contents, const Block& block,
                              std::size_t first_line) {
  const std::size_t line = first_line + block.n_lines;
  if (block.wrong == kTwoTabs) {
    reject(contents, fmt::format("two tabs in a row on line {}", line), "one between numbers",
           "write NaN where a height is missing");
  }
  reject(contents, fmt::format("'{}' on line {}", block.wrong.substr(0, 40), line), "a number",
         "remove lines that are not data, or mark them as comments");
}

}  // namespace

TextNumbers parse_numbers(const Contents& contents, std::string_view text, const TextHints& hints) {
  constexpr std::size_t kBlocksPerWave = 32;
  const Commas commas = commas_of(text, hints);
  if (!commas.doubtful.empty()) {
    reject(contents, fmt::format("'{}'", commas.doubtful.substr(0, 40)),
           "commas that separate numbers or commas before decimals, not what may be either",
           "write decimal points, or ';' between columns");
  }
  std::size_t first_line = hints.first_line;
  const Separators separators(commas.decimal);
  const char line_end = line_end_of(text);
  const std::string_view whole = text;
  const double n_bytes = static_cast<double>(text.size());
  TextNumbers numbers;
  while (!text.empty()) {
    const std::string_view before = text;
    std::vector<Block> blocks;
    while (!text.empty() && blocks.size() < kBlocksPerWave) {
      blocks.push_back({.text = take_block(text, line_end)});
    }
    parallel_for(std::ssize(blocks), 1, [&](Index begin, Index) {
      parse(blocks[static_cast<std::size_t>(begin)], separators, line_end, hints);
    });
    const double share = 1 - static_cast<double>(text.size()) / n_bytes;
    if (blocks.size() > 1 || !text.empty()) reserve_numbers(numbers, blocks, share);
    for (Block& block : blocks) {
      if (!block.wrong.empty()) reject_line(contents, block, first_line);
      append(numbers, block, first_line);
      first_line += block.n_lines;
      if (!block.section) continue;
      numbers.rest = whole.substr(static_cast<std::size_t>(block.section->data() - whole.data()));
      numbers.rest_line = first_line;
      return numbers;
    }
    contents.finished(before.substr(0, before.size() - text.size()), share);
  }
  return numbers;
}

namespace {

/// A cell in quotation marks: as a number with a point if it is one with a comma, as it stands
/// without them if it has none.
std::string unquoted(std::string_view cell) {
  const std::size_t n_commas = static_cast<std::size_t>(std::count(cell.begin(), cell.end(), ','));
  if (n_commas == 0) return std::string(cell);
  std::string pointed(cell);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (n_commas == 1 && number(trim(pointed), false)) return pointed;
  const bool has_digit = std::any_of(cell.begin(), cell.end(), is_digit);
  if (has_digit) return '"' + std::string(cell) + '"';
  std::replace(pointed.begin(), pointed.end(), '.', ' ');  // a name, "height, smoothed"
  return pointed;
}

}  // namespace

std::optional<std::string> without_quotes(std::string_view text) {
  if (sample_of(text, line_end_of(text)).find('"') == std::string_view::npos) return std::nullopt;
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    const std::size_t open = text.find('"');
    const std::size_t close = open == std::string_view::npos ? open : text.find('"', open + 1);
    const bool is_cell = close != std::string_view::npos &&
                         text.substr(open, close - open).find('\n') == std::string_view::npos;
    plain += text.substr(0, open);
    if (open == std::string_view::npos) break;
    if (is_cell) plain += unquoted(text.substr(open + 1, close - open - 1));
    text.remove_prefix(is_cell ? close + 1 : open + 1);
  }
  return plain;
}

std::optional<std::string> utf8_from_utf16(std::string_view text) {
  const bool little = text.starts_with("\xFF\xFE");
  if (!little && !text.starts_with("\xFE\xFF")) return std::nullopt;
  const auto unit = [&](std::size_t i) -> unsigned {
    const auto first = static_cast<unsigned char>(text[i]);
    const auto second = static_cast<unsigned char>(text[i + 1]);
    return little ? first | second << 8 : second | first << 8;
  };
  std::string utf8;
  for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
    const unsigned code = unit(i);
    if (code < 0x80) {
      utf8 += static_cast<char>(code);
    } else if (code < 0x800) {
      utf8 += static_cast<char>(0xC0 | code >> 6);
      utf8 += static_cast<char>(0x80 | (code & 0x3F));
    } else {  // halves of a surrogate pair too: no header or number has one
      utf8 += static_cast<char>(0xE0 | code >> 12);
      utf8 += static_cast<char>(0x80 | (code >> 6 & 0x3F));
      utf8 += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return utf8;
}

}  // namespace tabor::scan::format
