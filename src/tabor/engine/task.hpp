#pragma once

#include <string>
#include <string_view>

// Defines a task: the canonical text that a stored result depends on, and the name of its file.
namespace tabor::engine {

/// Unit of work whose result a store holds in one file. Its text states everything that its result
/// depends on, in SI with 17 digits; its key, the first 16 hexadecimal digits of the text's
/// SHA-256, names its file.
struct Task {
  std::string text;
  std::string key;
  std::string file;  ///< name inside the folder of the store
};

/// Makes a task whose file is "kind-key.extension".
Task make_task(std::string_view kind, std::string_view extension, const std::string& text);

/// Return one line of a task's text. A text value is preceded by its length, so that it cannot look
/// like the lines around it.
std::string text_line(std::string_view name, double value);
std::string text_line(std::string_view name, std::string_view value);

}  // namespace tabor::engine
