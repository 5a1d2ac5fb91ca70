#include "tabor/cli/failure.hpp"

#include <algorithm>
#include <ostream>
#include <string_view>

#include "tabor/cli/result.hpp"
#include "tabor/core/printable.hpp"

namespace tabor::cli {

namespace {

constexpr std::string_view kGot = "got ";
constexpr std::string_view kExpected = "expected ";

/// Takes a part and its separator off the front of `rest`.
std::string take_until(std::string_view& rest, std::string_view separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  std::string part(rest.substr(0, end));
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return part;
}

/// The first "; " that stands in no brackets.
std::size_t end_of_clause(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth <= 0 && text[i] == ';' && text[i + 1] == ' ') return i;
  }
  return text.size();
}

/// Where the subject of the line ends: before ": got " or ": expected ", else at the first "; ".
std::string take_subject(std::string_view& rest) {
  const std::size_t got = rest.find(": " + std::string(kGot));
  const std::size_t expected = rest.find(": " + std::string(kExpected));
  const bool has_parts = std::min(got, expected) != std::string_view::npos;
  std::string what(rest.substr(0, has_parts ? std::min(got, expected) : end_of_clause(rest)));
  rest.remove_prefix(std::min(what.size() + 2, rest.size()));
  return what;
}

io::Json take_got(std::string_view& rest) {
  if (!rest.starts_with(kGot)) return nullptr;
  rest.remove_prefix(kGot.size());
  // What was given may hold any character: it ends where the next part begins, if that is there.
  const std::string next = "; " + std::string(kExpected);
  if (rest.find(next) == std::string_view::npos) return take_until(rest, "; ");
  std::string got(rest.substr(0, rest.find(next)));
  rest.remove_prefix(got.size() + 2);
  return got;
}

io::Json take_expected(std::string_view& rest) {
  if (!rest.starts_with(kExpected)) return nullptr;
  rest.remove_prefix(kExpected.size());
  return take_until(rest, "; ");
}

}  // namespace

bool asks_for_json(const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), "--json") != words.end();
}

io::Json error_json(const std::string& line) {
  std::string_view rest = line;
  io::Json error = {{"what", take_subject(rest)}};
  error["got"] = take_got(rest);
  error["expected"] = take_expected(rest);
  error["remedy"] = rest.empty() ? io::Json(nullptr) : io::Json(std::string(rest));
  error["text"] = line;
  return error;
}

int fail(Context& context, const std::string& line, int code) {
  if (context.progress) context.progress->clear();
  std::string text = line;
  std::replace(text.begin(), text.end(), '\n', ' ');
  text = printable(text);
  context.err << "tabor: " << text << '\n';
  if (context.json) {
    io::Json object = json_head(context);
    object["error"] = error_json(text);
    object["error"]["exit_code"] = code;
    object["warnings"] = json_warnings(context);
    context.out << io::to_text(object) << std::endl;
  }
  return code;
}

}  // namespace tabor::cli
