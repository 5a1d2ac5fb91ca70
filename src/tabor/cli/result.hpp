#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/fields_file.hpp"

// Begins and ends the output of every verb: JSON head, warnings, result files, templates.
namespace tabor::cli {

/// Returns the keys that every JSON object begins with.
io::Json json_head(const Context& context);
io::Json json_head(const Context& context, const Scan& scan);

/// Returns the head of a result file of this command; `methods` are keys of references.bib.
results::ResultHead head_of(const Context& context, const std::string& config_toml,
                            const std::vector<std::string>& methods);

/// Returns the warnings of the context: a text each, or an object with code, text and cases.
io::Json json_warnings(const Context& context);

/// Prints the object (with the warnings) or the text (warnings on stderr); returns `code`.
int finish(Context& context, io::Json object, const std::string& text, int code = kDone);

/// Declares `-o OUT.h5|OUT.vti`.
void declare_output(OptionSet& set, std::optional<std::string>& target);

/// Declares `--template`, which prints a file to start from and does nothing else.
inline constexpr const char* kTemplate = "--template";
void declare_template(OptionSet& set, const std::string& what, bool& target);
int show_template(const std::string& text, Context& context);

/// Return the extensions of files that hold results, and of files that hold one surface.
const std::vector<std::string>& hdf5_extensions();
std::vector<std::string> scan_extensions();

}  // namespace tabor::cli
