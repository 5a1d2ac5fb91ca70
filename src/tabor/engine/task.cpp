#include "tabor/engine/task.hpp"

#include <fmt/format.h>

#include "tabor/io/files/digest.hpp"

namespace tabor::engine {

Task make_task(std::string_view kind, std::string_view extension, const std::string& text) {
  Task task{.text = text, .key = io::sha256(text).substr(0, 16), .file = {}};
  task.file = fmt::format("{}-{}.{}", kind, task.key, extension);
  return task;
}

std::string text_line(std::string_view name, double value) {
  return fmt::format("{} = {:.17g}\n", name, value);
}

std::string text_line(std::string_view name, std::string_view value) {
  return fmt::format("{} = {}:{}\n", name, value.size(), value);
}

}  // namespace tabor::engine
