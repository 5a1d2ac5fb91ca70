#include "tabor/cli/command_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::cli {

namespace {

namespace fs = std::filesystem;

/// With every link on the way resolved, as far as it exists.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  const fs::path known = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : known;
}

bool lies_in(const fs::path& folder, const fs::path& file) {
  const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

void check_extension(const fs::path& file, const std::vector<std::string>& extensions) {
  if (extensions.empty()) return;
  const std::string extension = lower(file.extension().string());
  if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  throw InputError(
      file.string(), "extension '" + file.extension().string() + "'",
      fmt::format("{}{}", extensions.size() > 1 ? "one of " : "", fmt::join(extensions, " ")),
      "the extension names what is written");
}

void check_can_write(const fs::path& file) {
  const fs::path target = io::written_file(file);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw OutputError(fmt::format("{}: the folder {} does not exist; create it first",
                                  file.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw OutputError(fmt::format("{}: the folder {} cannot be written to; choose another name",
                                  file.string(), folder.string()));
  }
}

}  // namespace

std::set<CommandFiles::Identity> CommandFiles::identity_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {{status.st_dev, status.st_ino}};
}

void CommandFiles::reject_if_replaced(const fs::path& input, const Output& output) {
  const fs::path place = resolved(input);
  const std::set<Identity> identity = identity_of(input);
  const bool is_same = !identity.empty() && output.there.contains(*identity.begin());
  const bool is_inside = output.is_folder && lies_in(output.folder, place);
  const bool is_leftover = io::is_temporary_name(place) && place.parent_path() == output.folder;
  if (!is_same && !is_inside && !is_leftover) return;
  throw OutputError(fmt::format(
      "{}: would replace the input {}; expected another name: an input is never written over",
      output.name.string(), input.string()));
}

void CommandFiles::reads(const fs::path& file) {
  for (const Output& output : outputs_) reject_if_replaced(file, output);
  inputs_.push_back(file);
}

void CommandFiles::add(Output output) {
  for (const fs::path& input : inputs_) reject_if_replaced(input, output);
  outputs_.push_back(std::move(output));
}

void CommandFiles::writes(const fs::path& file) {
  add({.name = file, .folder = resolved(file).parent_path(), .there = identity_of(file)});
}

void CommandFiles::fills(const fs::path& folder) {
  Output output{.name = folder, .folder = resolved(folder), .is_folder = true};
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    output.there.merge(identity_of(entry.path()));
  }
  add(std::move(output));
}

OptionSet noting_files(const OptionSet& set, NamedFiles& named) {
  OptionSet noting;
  for (Option option : set.options()) {
    if (option.names != FileRole::none) {
      option.assign = [option, &named](const std::string& word) {
        option.assign(word);
        if (word != option.if_bare) named.emplace_back(word, option);
      };
    }
    noting.add(option);
  }
  return noting;
}

void check_files(const NamedFiles& named, CommandFiles& files) {
  for (const auto& [word, option] : named) {
    if (option.names == FileRole::input) {
      files.reads(word);
    } else {
      files.writes(word);
    }
  }
  for (const auto& [word, option] : named) {
    if (option.names != FileRole::output) continue;
    check_extension(word, option.extensions);
    check_can_write(word);
    io::remove_leftovers(word);
  }
}

}  // namespace tabor::cli
