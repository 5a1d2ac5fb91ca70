#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {

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
      if (rejection.got() != last_found) found += (found.empty() ? "" : "; ") + rejection.got();
      if (rejection.remedy() != last_remedy) {
        remedy += (remedy.empty() ? "" : "; or ") + rejection.remedy();
      }
      last_found = rejection.got();
      last_remedy = rejection.remedy();
    }
  }
  throw InputError(contents.file.string(), found, "a scan file", remedy);
}

}  // namespace tabor::scan::format
