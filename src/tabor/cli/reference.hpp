#pragma once

#include <string>
#include <vector>

#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/verb.hpp"

// Describes the program and its verbs for everything that is printed about them: help,
// docs/options.md, man pages and the completion of shells each print this description.
namespace tabor::cli {

/// Options under one heading.
struct OptionGroup {
  std::string title;
  std::vector<Option> options;
};

/// A verb with its options under their headings, common ones last.
struct Reference {
  const Verb& verb;
  std::vector<OptionGroup> groups;

  std::string usage() const;                ///< "tabor info SCAN [options]"
  std::vector<HelpTable> tables() const;    ///< of every word
  std::vector<Option> positionals() const;  ///< in their order
  std::vector<Option> options() const;      ///< all that begin with a dash
};

/// Returns the description of one verb, or of each.
Reference reference_of(const Verb& verb);
std::vector<Reference> references();

/// Returns an option as it is typed: "-o, --output OUT.h5".
std::string form_of(const Option& option);

/// What an exit code says.
struct ExitMeaning {
  ExitCode code;
  const char* meaning;
};
inline constexpr ExitMeaning kExitMeanings[] = {{kDone, "done"},
                                                {kInternal, "internal error"},
                                                {kUsage, "wrong command line"},
                                                {kInput, "bad input"},
                                                {kNotConverged, "not converged"},
                                                {kOutput, "cannot write"},
                                                {kInterrupted, "interrupted"}};

/// One sentence about the program.
inline constexpr const char* kWhatItDoes =
    "tabor computes the real contact area, the oil and the friction of scanned rough surfaces.";

/// Heading of the options that every verb has.
inline constexpr const char* kCommonOptions = "Common options";

}  // namespace tabor::cli
