#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/ehl.hpp"
#include "tabor/io/file_lock.hpp"

/// Finished cases of a sweep that has not ended: what a killed one leaves for the next.
namespace tabor::cli {

/// Change it when the same case gives other numbers than before.
inline constexpr int kEhlAlgorithms = 2;

/// Everything that the result of a case depends on, as text. `before`: of the case that it may
/// start from, or empty.
std::string canonical_text(const EhlProgram& program, const io::Config& config,
                           const Context& context, const std::string& before);

/// States to context.files what the files of a case hold, so that a case is never kept under the
/// digest of other bytes than it was solved with.
void note_digests(const EhlProgram& program, const io::Config& config, Context& context);

/// One case that was solved, and what the program warned of meanwhile.
struct KeptCase {
  EhlAnswer answer;  ///< without its text and its maps
  std::vector<std::string> notices;
};

/// A folder for one sweep at a time, with one JSON file per case, named by the digest of its
/// canonical text, and the film of the last one, which the next may start from. Files appear
/// complete or not at all.
class KeptCases {
 public:
  /// Makes the folder. `texts`: the canonical ones, in the order in which the cases are solved.
  /// Throws InputError if another sweep works on it, OutputError if it cannot be written.
  KeptCases(std::filesystem::path folder, std::vector<std::string> texts);
  /// A folder that nothing was put into goes.
  ~KeptCases();
  KeptCases(const KeptCases&) = delete;
  KeptCases& operator=(const KeptCases&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::size_t n_kept() const { return n_kept_; }  ///< of these cases, found or added

  /// The cases that are there, by their place in the order. Of a chain only the first ones in a
  /// row, and the chain then stands behind the last of them. What is damaged counts as absent.
  std::vector<std::optional<KeptCase>> take(const EhlChain& chain);

  /// Damaged files that take() met, one line each, and the number of cases that it left alone.
  const std::vector<std::string>& complaints() const { return complaints_; }
  std::size_t n_unused() const { return n_unused_; }

  /// Adds a case, with what the chain says the next one may start from. Throws OutputError.
  void keep(std::size_t place, const KeptCase& kept, const EhlChain& chain);

  /// All files of cases, once the result of the whole sweep is written.
  void remove() const;

 private:
  std::filesystem::path case_file(std::size_t place) const;
  std::filesystem::path start_file(std::size_t place) const;
  std::optional<KeptCase> read(std::size_t place);
  bool read_start(std::size_t place, const EhlChain& chain);

  std::filesystem::path folder_;
  io::FileLock lock_;
  std::vector<std::string> texts_;
  std::vector<std::string> keys_;
  std::vector<std::string> complaints_;
  std::size_t n_kept_ = 0;
  std::size_t n_unused_ = 0;
};

}  // namespace tabor::cli
