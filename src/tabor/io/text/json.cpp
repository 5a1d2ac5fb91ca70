#include "tabor/io/text/json.hpp"

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::io {
namespace {

/// Deepest nesting that is read: writing a value takes calls as deep as it is nested.
constexpr int kDeepest = 1000;

/// Says what is wrong in our words: the library's name its own parts.
std::string mistake_of(const Json::exception& error) {
  constexpr int kBeyondDoubles = 406;
  if (error.id == kBeyondDoubles) return "holds a number beyond the range of doubles";
  const auto* place = dynamic_cast<const Json::parse_error*>(&error);
  return "not JSON at byte " + std::to_string(place ? place->byte : 0);
}

}  // namespace

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string to_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json parse_json(std::string_view text) {
  const auto is_shallow = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) {
      throw InputError("JSON nested more than " + std::to_string(kDeepest) + " deep");
    }
    return true;
  };
  try {
    return Json::parse(text, is_shallow);
  } catch (const Json::exception& error) {
    throw InputError(mistake_of(error));
  }
}

Json read_json(const std::filesystem::path& file) {
  try {
    return parse_json(read_text(file));
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

}  // namespace tabor::io
