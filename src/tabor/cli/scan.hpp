#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cli/table.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/treatment.hpp"

// Declares the argument SCAN with its treatment options, and reads and treats the scan.
namespace tabor::cli {

/// File, reading options and treatment of a scan, as given on the command line.
struct ScanRequest {
  std::string file;
  scan::ReadOptions read;
  topography::Treatment treatment;  ///< in the order given
};

/// A treated scan with its origin.
struct Scan {
  topography::Topography surface;  ///< treated
  std::string path;
  std::string sha256;
  topography::Treatment treatment;
};

/// Declares SCAN and how it is read; with_treatment adds the treatment steps, each an option of its
/// own, applied in the order given.
void declare_scan(OptionSet& set, ScanRequest& request, bool with_treatment = true);
/// Declares any number of scans, all read and treated alike.
void declare_scans(OptionSet& set, ScanRequest& request, std::vector<std::string>& files,
                   bool with_treatment = true);

/// Throws UsageError where steps of the treatment contradict each other.
void check(const ScanRequest& request);

/// Reads and treats a scan. Warnings about the surface are left to the warnings of the numbers that
/// follow from it (cases/warnings.hpp).
Scan read_scan(const ScanRequest& request, Context& context);
/// Does the same on any thread, watched by an observer of its own.
Scan read_scan(const ScanRequest& request, const Context& context, const Observer& observer);
/// Reads and treats a scan from an open file.
Scan read_scan(const scan::ScanFile& file, const ScanRequest& request, const Context& context,
               const Observer& observer);

/// Returns the warnings about numbers of the surface itself, such as its roughness.
results::Case doubts_of(const Scan& scan);

/// Rejects a scan with holes; the message names the option that fills them.
void require_no_holes(const Scan& scan);

/// Returns "512 x 256 pixels of 2 µm x 3 µm".
std::string pixels_text(const Grid& grid);

/// Adds file, pixels and treatment to the facts.
void describe(const Scan& scan, Facts& facts);

}  // namespace tabor::cli
