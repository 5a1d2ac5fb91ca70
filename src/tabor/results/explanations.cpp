#include "tabor/results/explanations.hpp"

#include <algorithm>

#include "tabor/core/text.hpp"

namespace tabor::results {
namespace {

/// Cells of a row of a Markdown table; none of any other line.
std::vector<std::string> cells_of(const std::string& line) {
  if (!line.starts_with('|')) return {};
  std::vector<std::string> cells = {""};
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
      cells.back() += line[++i];
    } else if (line[i] == '|') {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  cells.pop_back();  // behind the last bar
  for (std::string& cell : cells) cell = std::string(trim(cell));
  return cells;
}

/// "[text](address)" becomes "text (address)", and code loses its quotes.
std::string without_markup(std::string text) {
  std::erase(text, '`');
  for (std::size_t middle = text.find("]("); middle != std::string::npos;
       middle = text.find("](", middle)) {
    const std::size_t begin = text.rfind('[', middle);
    if (begin == std::string::npos) break;
    text.replace(middle, 2, " (");
    text.erase(begin, 1);
  }
  return text;
}

std::vector<Explanation> read_explanations() {
  std::vector<Explanation> all;
  std::string heading;
  for (const std::string& line : split(warnings_text(), '\n')) {
    if (line.starts_with("## ")) heading = line.substr(3);
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != 3 || !cells[0].starts_with('`')) continue;
    all.push_back(
        {without_markup(cells[0]), heading, without_markup(cells[1]), without_markup(cells[2])});
  }
  return all;
}

}  // namespace

const std::vector<Explanation>& explanations() {
  static const std::vector<Explanation> all = read_explanations();
  return all;
}

const Explanation* explanation_of(std::string_view code) {
  const std::vector<Explanation>& all = explanations();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.code == code; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace tabor::results
