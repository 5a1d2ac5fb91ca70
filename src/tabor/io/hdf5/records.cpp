#include "tabor/io/hdf5/records.hpp"

#include <algorithm>
#include <cstring>

namespace tabor::io::hdf5 {
namespace {

/// More than any table of names or scales needs.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 26;

template <typename T>
T value_at(const char* place) {
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

std::optional<double> number_at(hid_t type, const char* place) {
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_FLOAT) {
    if (size == sizeof(float)) return static_cast<double>(value_at<float>(place));
    if (size == sizeof(double)) return value_at<double>(place);
  }
  if (H5Tget_class(type) == H5T_INTEGER) {
    if (size == sizeof(std::int32_t)) return value_at<std::int32_t>(place);
    if (size == sizeof(std::int64_t)) return static_cast<double>(value_at<std::int64_t>(place));
  }
  return std::nullopt;
}

bool add_numbers(hid_t type, const char* place, std::size_t n, Hdf5Record& record) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto number = number_at(type, place + i * H5Tget_size(type));
    if (!number) return false;
    record.numbers.push_back(*number);
  }
  return true;
}

std::string text_at(hid_t type, const char* place) {
  if (H5Tis_variable_str(type) > 0) {
    const char* text = value_at<const char*>(place);
    return text == nullptr ? "" : text;
  }
  return {place, std::find(place, place + H5Tget_size(type), '\0')};
}

bool add_member(hid_t type, const char* place, Hdf5Record& record) {
  switch (H5Tget_class(type)) {
    case H5T_STRING:
      record.texts.push_back(text_at(type, place));
      return true;
    case H5T_ARRAY: {
      const Handle item(H5Tget_super(type), &H5Tclose);
      return add_numbers(item, place,
                         H5Tget_size(type) / std::max<std::size_t>(1, H5Tget_size(item)), record);
    }
    case H5T_VLEN: {
      const Handle item(H5Tget_super(type), &H5Tclose);
      const auto list = value_at<hvl_t>(place);
      return add_numbers(item, static_cast<const char*>(list.p), list.p == nullptr ? 0 : list.len,
                         record);
    }
    default:
      return add_numbers(type, place, 1, record);
  }
}

std::optional<Hdf5Record> record_at(hid_t type, const char* place) {
  Hdf5Record record;
  const int n_members = H5Tget_nmembers(type);
  for (unsigned i = 0; i < static_cast<unsigned>(std::max(n_members, 0)); ++i) {
    const Handle member(H5Tget_member_type(type, i), &H5Tclose);
    if (!add_member(member, place + H5Tget_member_offset(type, i), record)) return std::nullopt;
  }
  return record;
}

}  // namespace

std::optional<std::vector<Hdf5Record>> read_records(
    hid_t type, hid_t space, std::uint64_t count, const std::function<herr_t(hid_t, void*)>& read) {
  if (H5Tget_class(type) != H5T_COMPOUND) return std::nullopt;
  const Handle native(H5Tget_native_type(type, H5T_DIR_ASCEND), &H5Tclose);
  const std::size_t size = native.valid() ? H5Tget_size(native) : 0;
  if (size == 0 || count > kMaxBytes / size) return std::nullopt;
  std::vector<char> bytes(count * size, '\0');
  std::vector<Hdf5Record> records;
  if (count == 0) return records;
  if (read(native, bytes.data()) < 0) return std::nullopt;
  bool complete = true;
  for (std::uint64_t i = 0; i < count && complete; ++i) {
    auto record = record_at(native, bytes.data() + i * size);
    complete = record.has_value();
    if (complete) records.push_back(std::move(*record));
  }
  H5Dvlen_reclaim(native, space, H5P_DEFAULT, bytes.data());
  return complete ? std::optional(std::move(records)) : std::nullopt;
}

}  // namespace tabor::io::hdf5
