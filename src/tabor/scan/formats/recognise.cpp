#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {
namespace {

/// Adds what a reader found; "a ZIP archive without " stands once for all that say it.
void add_finding(const std::string& got, const std::string& last, std::string& found) {
  constexpr std::string_view kWithout = " without ";
  const std::size_t place = got.find(kWithout);
  const std::size_t size = place == std::string::npos ? 0 : place + kWithout.size();
  const bool is_again = size > 0 && last.substr(0, size) == got.substr(0, size);
  found += (found.empty() ? "" : is_again ? ", " : "; ") + got.substr(is_again ? size : 0);
}

}  // namespace

Document open_document(const Contents& contents, std::string_view except) {
  const std::string_view head = contents.bytes.substr(0, kHeadSize);
  std::string found;
  std::string remedy;
  std::string last_found;  // one reader may stand behind two rows
  std::string last_remedy;
  for (const Format& row : table()) {
    if (row.identify == nullptr || row.name == except) continue;
    if (row.identify(head) == Match::no) continue;
    try {
      return row.open(contents);
    } catch (const Unrecognised& rejection) {
      if (rejection.got() != last_found) add_finding(rejection.got(), last_found, found);
      if (!rejection.remedy().empty() && rejection.remedy() != last_remedy) {
        remedy += (remedy.empty() ? "" : "; or ") + rejection.remedy();
      }
      last_found = rejection.got();
      last_remedy = rejection.remedy();
    }
  }
  throw InputError(contents.file.string(), found, "a scan file", remedy);
}

}  // namespace tabor::scan::format
