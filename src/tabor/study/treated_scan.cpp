#include "tabor/study/treated_scan.hpp"

#include "tabor/core/error.hpp"
#include "tabor/io/files/digest.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {
namespace {

[[noreturn]] void reject_replaced(const Scan& scan) {
  throw Error(scan.file.string() +
              ": replaced or changed while the sweep ran; nothing of it was kept, start the sweep "
              "again");
}

bool holds(const Scan& scan, const std::string& sha256) {
  try {
    return io::sha256_of_file(scan.file) == sha256;
  } catch (const InputError&) {
    return false;
  }
}

topography::Topography read_unchanged(const Scan& scan, const std::string& sha256,
                                      const Observer& observer) {
  try {
    const scan::ScanFile file(scan.file, observer);
    if (file.sha256() != sha256) reject_replaced(scan);
    return file.read(scan.read);
  } catch (const InputError&) {  // of this scan, or of what took its place
    if (!holds(scan, sha256)) reject_replaced(scan);
    throw;
  }
}

}  // namespace

topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer) {
  topography::Topography treated =
      topography::apply(study.treatment, read_unchanged(scan, scan_sha256, observer), observer);
  treated.source = scan.label;  // wherever the study lies
  topography::require_no_holes(treated, scan.label, "add \"fill=harmonic\" to treatment.steps");
  return treated;
}

}  // namespace tabor::study
