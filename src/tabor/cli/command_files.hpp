#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tabor/cli/options.hpp"

// Collects the files that a command reads and writes, and rejects an output that would replace an
// input.
namespace tabor::cli {

/// Files that one command reads and writes. An output never replaces an input, whatever names or
/// links lead to them: every input is compared with every output as soon as both are known. Files
/// that options name are entered before the verb runs (noting_files()); a verb adds those that its
/// files name in turn.
class CommandFiles {
 public:
  /// Enters a file that the command reads. Throws OutputError if an output would replace it.
  void reads(const std::filesystem::path& file);
  /// Enters a file that the command writes. Throws OutputError if it would replace an input.
  void writes(const std::filesystem::path& file);
  /// Enters a folder whose files the command makes, replaces and removes. Throws as writes().
  void fills(const std::filesystem::path& folder);

 private:
  using Identity = std::pair<std::uint64_t, std::uint64_t>;  ///< device and number on it
  struct Output {
    std::filesystem::path name;
    std::filesystem::path folder;  ///< where it lies, or which is filled; links resolved
    bool is_folder = false;
    std::set<Identity> there = {};  ///< files that may be replaced
  };

  static std::set<Identity> identity_of(const std::filesystem::path& file);
  static void reject_if_replaced(const std::filesystem::path& input, const Output& output);
  void add(Output output);

  std::vector<std::filesystem::path> inputs_;
  std::vector<Output> outputs_;
};

/// Files that the words of a command line name.
using NamedFiles = std::vector<std::pair<std::string, Option>>;

/// Returns the same options; parse() then enters the files that they name.
OptionSet noting_files(const OptionSet& set, NamedFiles& named);

/// Enters them all and rejects, before anything is computed: an output that would replace an input
/// or cannot be written (OutputError), one of an extension the verb cannot write (InputError, with
/// those it can). Removes what a killed program left half-written under an output's name.
void check_files(const NamedFiles& named, CommandFiles& files);

}  // namespace tabor::cli
