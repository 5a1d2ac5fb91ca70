#pragma once

#include <string>

#include "tabor/cli/verb.hpp"
#include "tabor/io/text/json.hpp"

// Reports a run that ends without a result: one line on stderr and, with --json, an error object.
namespace tabor::cli {

/// True if the words ask for a JSON object, whether or not the rest of them is understood.
bool asks_for_json(const std::vector<std::string>& words);

/// Returns the parts of a line "<what>: got <got>; expected <expected>; <remedy>", as InputError
/// writes it; null for parts that it lacks. The whole line stands beside them as "text".
io::Json error_json(const std::string& line);

/// Ends a run that has no result: one line on stderr and, where JSON is asked for, the error object
/// on stdout. Returns `code`.
int fail(Context& context, const std::string& line, int code);

}  // namespace tabor::cli
