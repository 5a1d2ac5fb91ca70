#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tabor::cli {

/// Rows of text under headings, aligned for a fixed-width screen: numbers right, words left.
class Table {
 public:
  explicit Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}
  void row(std::vector<std::string> cells);
  std::string text() const;

 private:
  std::vector<std::string> headings_;
  std::vector<std::vector<std::string>> rows_;
};

/// "label   value" lines, aligned; lines with an empty value are left out.
class Facts {
 public:
  void fact(const std::string& label, const std::string& value);
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

std::string percent(double fraction, int digits = 3);   ///< 0.02134 -> "2.13 %", NaN -> "-"
std::string si(double value, const std::string& unit);  ///< "7 MPa", NaN -> "-"
std::string plain(double value, int digits = 4);        ///< "0.2917", NaN -> "-"
std::string yes_no(bool value);

}  // namespace tabor::cli
