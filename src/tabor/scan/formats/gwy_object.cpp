#include "tabor/scan/formats/gwy_object.hpp"

#include <fmt/format.h>

#include "tabor/scan/formats/bytes.hpp"

namespace tabor::scan::format {
namespace {

/// Real files nest four deep; a limit keeps a forged one from exhausting the stack.
constexpr int kMaxDepth = 16;

GwyObject take_object(const Contents& contents, Cursor& cursor, int depth);

/// Bytes per item of an array type, 0 for types whose items have no fixed size.
std::size_t item_size(char type) {
  switch (type) {
    case 'C':
      return 1;
    case 'I':
      return 4;
    case 'Q':
    case 'D':
      return 8;
    default:
      return 0;
  }
}

void skip_array(const Contents& contents, Cursor& cursor, char type, int depth) {
  const auto count = cursor.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (type == 'S') {
      cursor.take_terminated();
    } else {
      take_object(contents, cursor, depth + 1);
    }
  }
}

GwyValue take_value(const Contents& contents, Cursor& cursor, int depth) {
  GwyValue value;
  value.type = cursor.take<char>();
  switch (value.type) {
    case 'b':
    case 'c':
      value.number = cursor.take<std::uint8_t>();
      break;
    case 'i':
      value.number = cursor.take<std::int32_t>();
      break;
    case 'q':
      value.number = static_cast<double>(cursor.take<std::int64_t>());
      break;
    case 'd':
      value.number = cursor.take<double>();
      break;
    case 's':
      value.text = cursor.take_terminated();
      break;
    case 'o':
      value.object = std::make_shared<GwyObject>(take_object(contents, cursor, depth + 1));
      break;
    case 'C':
    case 'I':
    case 'Q':
    case 'D': {
      const std::size_t count = cursor.take<std::uint32_t>();
      value.array = cursor.take(count * item_size(value.type));
      break;
    }
    case 'S':
    case 'O':
      skip_array(contents, cursor, value.type, depth);
      break;
    default:
      reject(contents,
             fmt::format("component type {:#x} at byte {}", static_cast<unsigned char>(value.type),
                         cursor.position()),
             "a type of Gwyddion's file format", kDamaged);
  }
  return value;
}

GwyObject take_object(const Contents& contents, Cursor& cursor, int depth) {
  if (depth > kMaxDepth) reject(contents, "objects nested too deep", "a scan", kDamaged);
  GwyObject object;
  object.type = cursor.take_terminated();
  const std::size_t size = cursor.take<std::uint32_t>();
  const Contents inside = contents.part(cursor.take(size));
  Cursor components(inside);
  while (components.left() > 0) {
    std::string name = components.take_terminated();
    object.items.insert_or_assign(std::move(name), take_value(inside, components, depth));
  }
  return object;
}

}  // namespace

const GwyObject* GwyObject::object(const std::string& name, std::string_view wanted) const {
  const auto item = items.find(name);
  const bool found =
      item != items.end() && item->second.object && item->second.object->type == wanted;
  return found ? item->second.object.get() : nullptr;
}

double GwyObject::number(const std::string& name, double fallback) const {
  const auto item = items.find(name);
  return item == items.end() ? fallback : item->second.number;
}

std::string GwyObject::text(const std::string& name) const {
  const auto item = items.find(name);
  return item == items.end() ? "" : item->second.text;
}

GwyObject parse_gwy(const Contents& contents) {
  Cursor cursor(contents);
  cursor.skip(4);
  return take_object(contents, cursor, 0);
}

void GwyBuilder::begin(const std::string& name, char type) {
  components_ += name;
  components_ += '\0';
  components_ += type;
}

void GwyBuilder::add(const std::string& name, std::int32_t value) {
  begin(name, 'i');
  put(components_, value);
}

void GwyBuilder::add(const std::string& name, double value) {
  begin(name, 'd');
  put(components_, value);
}

void GwyBuilder::add(const std::string& name, const std::string& value) {
  begin(name, 's');
  components_ += value.substr(0, value.find('\0'));
  components_ += '\0';
}

void GwyBuilder::add(const std::string& name, const Field& values) {
  begin(name, 'D');
  put(components_, static_cast<std::uint32_t>(values.size()));
  put_field(components_, values);
}

void GwyBuilder::add(const std::string& name, const GwyBuilder& object) {
  begin(name, 'o');
  components_ += object.bytes();
}

std::string GwyBuilder::bytes() const {
  std::string bytes = type_;
  bytes += '\0';
  put(bytes, static_cast<std::uint32_t>(components_.size()));
  return bytes + components_;
}

}  // namespace tabor::scan::format
