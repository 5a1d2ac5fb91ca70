#pragma once

#include <string>
#include <string_view>

namespace tabor::study {

/// One thing that a store keeps. Its text states everything its result depends on, in SI with 17
/// digits; its key, the first 16 hexadecimal digits of the text's SHA-256, names its file.
struct Task {
  std::string text;
  std::string key;
  std::string file;  ///< name inside the folder of the store
};

/// A task whose file is "kind-key.extension".
Task make_task(std::string_view kind, std::string_view extension, const std::string& text);

/// One line of a task's text. A text comes with its length before it, so that none can look like
/// the lines around it.
std::string text_line(std::string_view name, double value);
std::string text_line(std::string_view name, std::string_view value);

}  // namespace tabor::study
