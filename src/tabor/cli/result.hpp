#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/fields_file.hpp"
#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/json.hpp"

namespace tabor::cli {

/// The keys every JSON object begins with.
io::Json json_head(const Context& context);
io::Json json_head(const Context& context, const Scan& scan);

/// What a result file of this command begins with; `methods` are keys of references.bib.
analysis::ResultHead head_of(const Context& context, const std::string& config_toml,
                             const std::vector<std::string>& methods);

/// Those of the context: a text each, or an object with code, text and cases.
io::Json json_warnings(const Context& context);

/// Prints the object (with the warnings) or the text (warnings on stderr); returns `code`.
int finish(Context& context, io::Json object, const std::string& text, int code = kDone);

/// Declares `-o OUT.h5|OUT.vti`.
void declare_output(OptionSet& set, std::optional<std::string>& target);

/// Declares `--template`, which stands for the file that it prints one for.
inline constexpr const char* kTemplate = "--template";
void declare_template(OptionSet& set, const std::string& what, bool& target);
int show_template(const std::string& text, Context& context);

/// Of the files that hold results, and of those that hold one surface.
const std::vector<std::string>& hdf5_extensions();
std::vector<std::string> scan_extensions();

}  // namespace tabor::cli
