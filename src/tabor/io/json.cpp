#include "tabor/io/json.hpp"

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/io/atomic_file.hpp"

namespace tabor::io {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string to_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json read_json(const std::filesystem::path& file) {
  try {
    return Json::parse(read_text(file));
  } catch (const Json::parse_error& error) {
    throw InputError(file.string() + ": not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::out_of_range&) {
    throw InputError(file.string() + ": holds a number beyond the range of doubles");
  }
}

}  // namespace tabor::io
