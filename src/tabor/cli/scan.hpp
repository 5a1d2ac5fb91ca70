#pragma once

#include <filesystem>
#include <string>

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

/// Every warning about the surface becomes a warning that names it.
void pass_on_warnings(const topography::Topography& surface, const std::string& name,
                      Context& context);

/// Reads and treats. Warnings about the surface are left to the warnings of the numbers that follow
/// from it (analysis/warnings.hpp).
Scan read_scan(const ScanRequest& request, Context& context);

/// The same where there are no such numbers: warnings become warnings at once.
Scan load_scan(const ScanRequest& request, Context& context);
/// The same for a file that is open already.
Scan load_scan(const scan::ScanFile& file, const ScanRequest& request, Context& context);

/// Warns when a scan that does not close on itself is used as it was read, and says by how much a
/// plane would change it.
void warn_if_not_levelled(const Scan& scan, Context& context);

/// Rejects holes with the option that fills them.
void require_no_holes(const Scan& scan);

/// "512 x 256 pixels of 2 µm x 3 µm".
std::string pixels_text(const Grid& grid);

/// File, pixels and treatment, for people.
void describe(const Scan& scan, Facts& facts);

}  // namespace tabor::cli
