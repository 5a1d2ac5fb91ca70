#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "tabor/scan/formats/format.hpp"

// Parses and writes the serialised objects of Gwyddion's native format.
namespace tabor::scan::format {

struct GwyObject;

/// Component of a serialised object, as far as a reader of height maps needs it.
struct GwyValue {
  char type = 0;                      ///< as in the file: i, d, s, o, D, ...
  double number = 0;                  ///< b c i q d
  std::string text;                   ///< s
  std::string_view array;             ///< D: raw bytes of float64 values
  std::shared_ptr<GwyObject> object;  ///< o
};

/// Serialised object of Gwyddion's native file format.
struct GwyObject {
  std::string type;  ///< "GwyContainer", "GwyDataField", ...
  std::map<std::string, GwyValue> items;

  const GwyObject* object(const std::string& name, std::string_view type) const;  ///< or null
  double number(const std::string& name, double fallback) const;
  std::string text(const std::string& name) const;  ///< "" if absent
};

/// Returns the root object of a GWY file. Throws InputError for anything that contradicts its own
/// sizes.
GwyObject parse_gwy(const Contents& contents);

/// Writes components one by one; nested objects are given as the bytes of another builder.
class GwyBuilder {
 public:
  explicit GwyBuilder(std::string type) : type_(std::move(type)) {}
  void add(const std::string& name, std::int32_t value);
  void add(const std::string& name, double value);
  void add(const std::string& name, const std::string& value);
  void add(const std::string& name, const Field& values);
  void add(const std::string& name, const GwyBuilder& object);
  std::string bytes() const;  ///< type name, size, components

 private:
  void begin(const std::string& name, char type);
  std::string type_;
  std::string components_;
};

}  // namespace tabor::scan::format
