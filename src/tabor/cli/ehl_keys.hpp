#pragma once

#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"
#include "tabor/io/toml.hpp"

/// Keys of the cases of `tabor ehl`: what is known, and what help says about it.
namespace tabor::cli {

/// One key of a case. A program reads no other ones than those of its table.
struct EhlKey {
  std::string name;          ///< "ball.radius"
  std::string unit = {};     ///< "m"; "" for plain numbers and words
  std::string usual = {};    ///< its value if it is not given, or what takes its place
  std::string meaning = {};  ///< one sentence at most
};
using EhlKeys = std::vector<EhlKey>;

inline constexpr const char* kRequired = "required";

struct EhlProgram;

/// All programs in the order people meet them.
const std::vector<EhlProgram>& ehl_programs();

/// Throws InputError for a key that no case of the program has, naming the nearest one or, if the
/// case is of another program, that one.
void reject_unknown_keys(const EhlProgram& program, const io::Config& config);

/// The keys of every program, for `tabor ehl PROGRAM --help` and docs/options.md.
std::vector<HelpTable> ehl_key_tables();

/// Key lists one after the other.
EhlKeys joined(EhlKeys keys, const std::vector<EhlKeys>& more);

}  // namespace tabor::cli
