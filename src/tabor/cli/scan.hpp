#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cli/table.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cli {

/// A scan as the command line asks for it.
struct ScanRequest {
  std::string file;
  scan::ReadOptions read;
  topography::Treatment treatment;  ///< in the order given
};

/// A scan as the verbs work on it.
struct Scan {
  topography::Topography surface;  ///< treated
  std::string path;
  std::string sha256;
  topography::Treatment treatment;
};

/// Declares SCAN and how it is read; with_treatment adds the treatment steps, each an option of its
/// own, applied in the order given.
void declare_scan(OptionSet& set, ScanRequest& request, bool with_treatment = true);
/// The same with as many scans as one likes, all read and treated alike.
void declare_scans(OptionSet& set, ScanRequest& request, std::vector<std::string>& files);

/// Reads and treats. Warnings about the surface are left to the warnings of the numbers that follow
/// from it (analysis/warnings.hpp).
Scan read_scan(const ScanRequest& request, Context& context);
/// The same for a file that is open already.
Scan read_scan(const scan::ScanFile& file, const ScanRequest& request, Context& context);

/// What there is to doubt about numbers of the surface itself, such as its roughness.
analysis::Case doubts_of(const Scan& scan);

/// Rejects holes with the option that fills them.
void require_no_holes(const Scan& scan);

/// "512 x 256 pixels of 2 µm x 3 µm".
std::string pixels_text(const Grid& grid);

/// File, pixels and treatment, for people.
void describe(const Scan& scan, Facts& facts);

}  // namespace tabor::cli
