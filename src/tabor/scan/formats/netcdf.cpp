// Classic NetCDF: the header, without values.
#include "tabor/scan/formats/netcdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tabor::scan::format {
namespace {

constexpr std::size_t kAlignment = 4;
constexpr std::uint32_t kDimensions = 10, kVariables = 11, kAttributes = 12;
constexpr std::uint32_t kText = 2;
/// Limits far above those of any map: a header must not become much larger in memory.
constexpr std::uint64_t kLongestName = 1024, kMostItems = 100'000, kMostNumbers = 1024;

/// Number types of the specification, by code.
std::optional<Sample> sample_of(std::uint32_t code) {
  static constexpr std::pair<std::uint32_t, Sample> codes[]{
      {1, Sample::i8},   {3, Sample::i16},  {4, Sample::i32},   {5, Sample::f32},
      {6, Sample::f64},  {7, Sample::u8},   {8, Sample::u16},   {9, Sample::u32},
      {10, Sample::i64}, {11, Sample::u64}, {kText, Sample::u8}};
  for (const auto& [known, sample] : codes) {
    if (known == code) return sample;
  }
  return std::nullopt;
}

std::size_t padding(std::size_t size) { return (kAlignment - size % kAlignment) % kAlignment; }

/// Takes the parts of a header in order. Counts have 8 bytes in version 5, offsets also in version
/// 2.
class HeaderReader {
 public:
  explicit HeaderReader(const Contents& contents)
      : contents_(contents), cursor_(contents, std::endian::big) {}

  NetcdfHeader take() {
    cursor_.skip(3);
    version_ = cursor_.take<std::uint8_t>();
    take_count();  // records
    NetcdfHeader header;
    for (std::uint64_t n = begin_list(kDimensions); n > 0; --n) {
      const std::string name = take_name();
      dimensions_.push_back({name, take_count()});
    }
    header.attributes = take_attributes();
    for (std::uint64_t n = begin_list(kVariables); n > 0; --n) {
      header.variables.push_back(take_variable());
    }
    return header;
  }

 private:
  std::uint64_t take_count() {
    return version_ == 5 ? cursor_.take<std::uint64_t>() : cursor_.take<std::uint32_t>();
  }

  void count_items(std::uint64_t n) {
    if (n <= kMostItems - n_items_) {
      n_items_ += n;
      return;
    }
    reject(contents_, fmt::format("a header of more than {} items", kMostItems), "a map", kDamaged);
  }

  /// Returns the number of elements of a list, each of which takes more than 4 bytes.
  std::uint64_t begin_list(std::uint32_t expected) {
    const auto tag = cursor_.take<std::uint32_t>();
    const std::uint64_t n = take_count();
    if (tag == 0 && n == 0) return 0;
    if (tag != expected || n > cursor_.left() / kAlignment) {
      reject(contents_, fmt::format("a list {} of {} elements", tag, n), "a NetCDF header",
             kDamaged);
    }
    count_items(n);
    return n;
  }

  std::string_view take_padded(std::uint64_t size) {
    if (size > cursor_.left()) reject(contents_, "a text beyond its end", "", kDamaged);
    const std::string_view bytes = cursor_.take(size);
    cursor_.skip(padding(size));
    return bytes;
  }

  std::string take_name() {
    const std::uint64_t size = take_count();
    if (size > kLongestName) {
      reject(contents_, fmt::format("a name of {} bytes", size), "a NetCDF header", kDamaged);
    }
    return std::string(take_padded(size));
  }

  Sample take_type(std::uint32_t code) {
    const auto sample = sample_of(code);
    if (!sample) reject(contents_, fmt::format("values of type {}", code), "1 to 11", kDamaged);
    return *sample;
  }

  NetcdfValue take_value() {
    const auto code = cursor_.take<std::uint32_t>();
    const Sample sample = take_type(code);
    const std::uint64_t n = take_count();
    if (n > cursor_.left() / size_of(sample)) {
      reject(contents_, fmt::format("an attribute of {} values", n), "as many as follow", kDamaged);
    }
    const std::string_view bytes = take_padded(n * size_of(sample));
    if (code == kText) return std::string(bytes.substr(0, bytes.find('\0')));
    if (n == 0 || n > kMostNumbers) return std::vector<double>{};
    const Raster raster{
        .sample = sample, .order = std::endian::big, .nx = static_cast<Index>(n), .ny = 1};
    const Field values = decode(contents_.part(bytes), bytes, raster);
    return std::vector<double>(values.data(), values.data() + values.size());
  }

  NetcdfAttributes take_attributes() {
    NetcdfAttributes attributes;
    for (std::uint64_t n = begin_list(kAttributes); n > 0; --n) {
      const std::string name = take_name();
      attributes[name] = take_value();
    }
    return attributes;
  }

  NetcdfDimension take_dimension() {
    const std::uint64_t id = take_count();
    if (id >= dimensions_.size()) {
      reject(contents_, fmt::format("dimension {}", id),
             fmt::format("one of {}", dimensions_.size()), kDamaged);
    }
    return dimensions_[id];
  }

  NetcdfVariable take_variable() {
    NetcdfVariable variable{.name = take_name()};
    const std::uint64_t n = take_count();
    count_items(n);
    for (std::uint64_t i = 0; i < n; ++i) variable.dimensions.push_back(take_dimension());
    variable.attributes = take_attributes();
    variable.sample = take_type(cursor_.take<std::uint32_t>());
    take_count();  // size, which the dimensions say too
    variable.begin = version_ == 1 ? cursor_.take<std::uint32_t>() : cursor_.take<std::uint64_t>();
    return variable;
  }

  Contents contents_;
  Cursor cursor_;
  std::uint8_t version_ = 1;
  std::uint64_t n_items_ = 0;
  std::vector<NetcdfDimension> dimensions_;
};

template <typename T>
void put_big(std::string& bytes, T value) {
  put(bytes, in_order(value, std::endian::big));
}

void put_padded(std::string& bytes, std::string_view text) {
  bytes += text;
  bytes.append(padding(text.size()), '\0');
}

void put_name(std::string& bytes, std::string_view name) {
  put_big(bytes, static_cast<std::uint32_t>(name.size()));
  put_padded(bytes, name);
}

void put_list(std::string& bytes, std::uint32_t tag, std::size_t n) {
  put_big(bytes, n == 0 ? 0 : tag);
  put_big(bytes, static_cast<std::uint32_t>(n));
}

std::uint32_t code_of(Sample sample) { return sample == Sample::i8 ? 1 : 6; }

void put_attributes(std::string& bytes, const NetcdfAttributes& attributes) {
  put_list(bytes, kAttributes, attributes.size());
  for (const auto& [name, value] : attributes) {
    put_name(bytes, name);
    if (const auto* text = std::get_if<std::string>(&value)) {
      put_big(bytes, kText);
      put_name(bytes, *text);
      continue;
    }
    const auto& numbers = std::get<std::vector<double>>(value);
    put_big(bytes, code_of(Sample::f64));
    put_big(bytes, static_cast<std::uint32_t>(numbers.size()));
    for (const double number : numbers) put_big(bytes, number);
  }
}

std::uint64_t byte_size(const NetcdfVariable& variable) {
  std::uint64_t size = size_of(variable.sample);
  for (const NetcdfDimension& dimension : variable.dimensions) size *= dimension.length;
  return size + padding(size);
}

std::vector<NetcdfDimension> all_dimensions(const NetcdfHeader& header) {
  std::vector<NetcdfDimension> all;
  for (const NetcdfVariable& variable : header.variables) {
    for (const NetcdfDimension& dimension : variable.dimensions) {
      const auto has_name = [&](const auto& other) { return other.name == dimension.name; };
      if (std::none_of(all.begin(), all.end(), has_name)) all.push_back(dimension);
    }
  }
  return all;
}

void put_variable(std::string& bytes, const NetcdfVariable& variable,
                  const std::vector<NetcdfDimension>& dimensions) {
  put_name(bytes, variable.name);
  put_big(bytes, static_cast<std::uint32_t>(variable.dimensions.size()));
  for (const NetcdfDimension& dimension : variable.dimensions) {
    const auto place = std::find_if(dimensions.begin(), dimensions.end(), [&](const auto& other) {
      return other.name == dimension.name;
    });
    put_big(bytes, static_cast<std::uint32_t>(place - dimensions.begin()));
  }
  put_attributes(bytes, variable.attributes);
  put_big(bytes, code_of(variable.sample));
  // The specification's value for sizes that 32 bits do not hold.
  constexpr std::uint64_t kLarge = 0xFFFFFFFF;
  put_big(bytes, static_cast<std::uint32_t>(std::min(byte_size(variable), kLarge)));
  put_big(bytes, variable.begin);
}

std::string bytes_of(const NetcdfHeader& header) {
  const std::vector<NetcdfDimension> dimensions = all_dimensions(header);
  std::string bytes("CDF\x02", 4);
  put_big(bytes, std::uint32_t{0});  // records
  put_list(bytes, kDimensions, dimensions.size());
  for (const NetcdfDimension& dimension : dimensions) {
    put_name(bytes, dimension.name);
    put_big(bytes, static_cast<std::uint32_t>(dimension.length));
  }
  put_attributes(bytes, header.attributes);
  put_list(bytes, kVariables, header.variables.size());
  for (const NetcdfVariable& variable : header.variables) put_variable(bytes, variable, dimensions);
  return bytes;
}

}  // namespace

const NetcdfVariable* NetcdfHeader::variable(std::string_view name) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const auto& variable) { return variable.name == name; });
  return found == variables.end() ? nullptr : &*found;
}

bool is_line(const Grid& grid) {
  constexpr double kRounding = 1e-9;
  return grid.ny == 1 && std::abs(grid.dy() - grid.dx()) <= kRounding * grid.dx();
}

bool is_netcdf(std::string_view head) {
  return head.size() > 3 && head.starts_with("CDF") &&
         (head[3] == '\x01' || head[3] == '\x02' || head[3] == '\x05');
}

NetcdfHeader read_netcdf_header(const Contents& contents) { return HeaderReader(contents).take(); }

std::string text_of(const NetcdfAttributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  const auto* text = found == attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text == nullptr ? "" : *text;
}

std::optional<double> number_of(const NetcdfAttributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return std::nullopt;
  const auto* numbers = std::get_if<std::vector<double>>(&found->second);
  if (numbers == nullptr || numbers->size() != 1) return std::nullopt;
  return numbers->front();
}

std::string netcdf_header_bytes(NetcdfHeader& header) {
  // Offsets have a fixed width: the header's size does not depend on them.
  std::uint64_t begin = bytes_of(header).size();
  for (NetcdfVariable& variable : header.variables) {
    variable.begin = begin;
    begin += byte_size(variable);
  }
  return bytes_of(header);
}

}  // namespace tabor::scan::format
