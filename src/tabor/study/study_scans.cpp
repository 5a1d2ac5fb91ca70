#include <glob.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "tabor/core/text.hpp"
#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

void read_file_options(const io::Config& config, const std::string& prefix,
                       scan::ReadOptions& options) {
  if (config.has(prefix + "channel")) options.channel = config.text(prefix + "channel");
  if (config.has(prefix + "unit")) options.unit = config.text(prefix + "unit");
  if (config.has(prefix + "pixel")) {
    options.pixel_x = options.pixel_y = positive(config, prefix + "pixel", dimension::length);
  }
}

/// The characters of a folder's name mean themselves, whatever a pattern would make of them.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// Files that a pattern matches, in byte order whatever the locale.
std::vector<fs::path> matches(const fs::path& folder, const std::string& pattern) {
  const std::string whole =
      fs::path(pattern).is_absolute() ? pattern : escaped(folder.string()) + "/" + pattern;
  glob_t found{};
  std::vector<fs::path> files;
  if (::glob(whole.c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> names_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), error)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

std::vector<fs::path> find_files(const io::Config& config, const fs::path& folder,
                                 const std::string& name) {
  const fs::path exact = folder / name;
  if (fs::exists(exact)) return {exact};
  std::vector<fs::path> files = matches(folder, name);
  if (files.empty()) {
    throw InputError(config.place("file") + ": no file '" + name + "' in " + folder.string() +
                     suggestion(exact.filename().string(), names_beside(exact)));
  }
  return files;
}

/// Its path relative to the study; as written where one of the two is absolute and the other not.
std::string label_of(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return (relative.empty() ? file : relative).generic_string();
}

}  // namespace

void read_scans(const io::Config& config, const fs::path& folder, Study& study) {
  scan::ReadOptions common;
  read_file_options(config, "treatment.", common);
  std::set<fs::path> seen;
  for (const io::Config& entry : config.tables("scan")) {
    scan::ReadOptions options = common;
    read_file_options(entry, "", options);
    for (const std::string& name : entry.texts("file")) {
      for (const fs::path& file : find_files(entry, folder, name)) {
        if (!seen.insert(fs::weakly_canonical(file)).second) {
          reject(entry, "file", "'" + name + "' twice", "each scan once, it would count twice");
        }
        study.scans.push_back({file, label_of(file, folder),
                               entry.has("group") ? entry.text("group") : "all", options});
      }
    }
  }
  if (study.scans.empty()) throw InputError(config.name() + ": no [[scan]] with a file");
}

}  // namespace tabor::study
