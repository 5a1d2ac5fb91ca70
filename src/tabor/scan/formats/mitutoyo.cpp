// XLSX of Mitutoyo SurfTest: a spreadsheet with a profile in the columns E and F of the sheet DATA,
// parameters in its column A, and the cut-off in cell E48 of the sheet Certificate
// (SurfaceTopography, IO/Mitutoyo.py). The parameters tell the unit of the heights, the cut-off
// that of the positions.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/text/xml.hpp"
#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/profile.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

/// Texts of cells by their reference ("E48").
using Cells = std::map<std::string, std::string>;

/// A workbook: its sheets by name, and the texts that cells share.
class Workbook {
 public:
  explicit Workbook(const Contents& contents)
      : contents_(contents), archive_(contents, "xl/workbook.xml", "a spreadsheet") {
    const io::XmlDocument book(archive_.main(), name_of("xl/workbook.xml"));
    const io::XmlDocument links(text("xl/_rels/workbook.xml.rels"), name_of("its links"));
    std::map<std::string, std::string> targets;
    for (const io::XmlElement& link : links.root().children("Relationship")) {
      targets[link.attribute("Id")] = link.attribute("Target");
    }
    for (const io::XmlElement& sheet : book.root().at("sheets").children("sheet")) {
      sheets_[sheet.attribute("name")] = targets[sheet.attribute("id")];
    }
  }

  bool has(const std::string& sheet) const { return sheets_.contains(sheet); }

  /// Returns the cells of a sheet in the columns A, E and F.
  Cells cells(const std::string& sheet) {
    std::string target = sheets_.at(sheet);
    if (!target.starts_with("/")) target = "xl/" + target;
    const io::XmlDocument document(text(target), name_of(sheet));
    Cells cells;
    for (const io::XmlElement& row : document.root().at("sheetData").children("row")) {
      for (const io::XmlElement& cell : row.children("c")) {
        const std::string place = cell.attribute("r");
        if (place.empty() || std::string_view("AEF").find(place[0]) == std::string_view::npos) {
          continue;
        }
        cells[place] = text_of(cell);
      }
    }
    return cells;
  }

 private:
  std::string name_of(const std::string& part) const {
    return contents_.file.string() + ": " + part;
  }
  std::string text(const std::string& entry) const { return archive_.text(archive_.find(entry)); }

  void take_shared_texts() {
    const io::XmlDocument document(text("xl/sharedStrings.xml"), name_of("its texts"));
    for (const io::XmlElement& item : document.root().children("si")) {
      std::string whole = item.at("t").text();
      for (const io::XmlElement& run : item.children("r")) whole += run.at("t").text();
      shared_.push_back(whole);
    }
  }

  std::string text_of(const io::XmlElement& cell) {
    if (cell.attribute("t") == "inlineStr") return cell.at("is/t").text();
    const std::string value = cell.at("v").text();
    if (cell.attribute("t") != "s") return value;
    if (shared_.empty()) take_shared_texts();
    const double index = parse_number(value).value_or(-1);
    const bool is_known = index >= 0 && index < static_cast<double>(shared_.size());
    if (!is_known) reject(contents_, "a cell with a text that is not there", "", kDamaged);
    return shared_[static_cast<std::size_t>(index)];
  }

  Contents contents_;
  Archive archive_;
  std::map<std::string, std::string> sheets_;
  std::vector<std::string> shared_;
};

/// The first unit of length behind a number: of "Ra 3.308 um", "R1max 2um" or "2.5mm".
std::string unit_in(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789.", kEnds = " \t(),;";
  std::size_t begin = text.find_first_of(kDigits);
  while (begin != std::string::npos) {
    const std::size_t unit = text.find_first_not_of(kDigits, begin);
    if (unit == std::string::npos) break;
    const std::string_view behind = trim(std::string_view(text).substr(unit));
    const std::string_view word = behind.substr(0, behind.find_first_of(kEnds));
    if (unit_factor(word, dimension::length)) return std::string(word);
    begin = text.find_first_of(kDigits, unit);
  }
  return "";
}

/// The unit of the first parameter that has one.
std::string unit_of_heights(const Cells& cells) {
  std::map<double, std::string> units;
  for (const auto& [place, text] : cells) {
    const auto row = parse_number(place.substr(1));
    const std::string unit = unit_in(text);
    if (place.starts_with("A") && row && !unit.empty()) units[*row] = unit;
  }
  return units.empty() ? "" : units.begin()->second;
}

/// Rows with a number in both columns, from the top.
std::map<double, std::pair<double, double>> points_of(const Cells& cells) {
  std::map<double, std::pair<double, double>> points;
  for (const auto& [place, text] : cells) {
    const auto row = parse_number(place.substr(1));
    if (!place.starts_with("E") || !row) continue;
    const auto height = cells.find("F" + place.substr(1));
    const auto x = parse_number(text);
    const auto z = height == cells.end() ? std::nullopt : parse_number(height->second);
    if (x && z) points[*row] = {*x, *z};
  }
  return points;
}

}  // namespace

Match identify_mitutoyo(std::string_view head) { return is_zip(head) ? Match::maybe : Match::no; }

Document open_mitutoyo(const Contents& contents) {
  Workbook workbook(contents);
  if (!workbook.has("DATA") || !workbook.has("Certificate")) {
    throw Unrecognised(contents, "a spreadsheet without the sheets DATA and Certificate",
                       "save the heights as text");
  }
  const Cells data = workbook.cells("DATA");
  const Cells certificate = workbook.cells("Certificate");
  std::vector<double> positions, heights;
  for (const auto& [row, point] : points_of(data)) {
    positions.push_back(point.first);
    heights.push_back(point.second);
  }
  const auto cut_off = certificate.find("E48");
  const auto date = certificate.find("E2");
  Document document{.format = "mitutoyo", .instrument = "Mitutoyo SurfTest"};
  if (date != certificate.end()) document.metadata["Date"] = date->second;
  document.layers.push_back(
      profile_layer(even_profile(contents, std::move(positions), std::move(heights)),
                    cut_off == certificate.end() ? "" : unit_in(cut_off->second),
                    unit_of_heights(data), document));
  return document;
}

}  // namespace tabor::scan::format
