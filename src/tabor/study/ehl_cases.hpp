#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/engine/task.hpp"
#include "tabor/study/axis.hpp"

// Many cases of one elastohydrodynamic program.
namespace tabor::study {

/// Raise it when the same case gives other numbers than before.
inline constexpr int kEhlAlgorithms = 3;

/// Digests of the files that cases name, for several threads at a time: no case is stored under the
/// digest of other bytes than it was solved with.
class FileDigests {
 public:
  /// SHA-256 of a file, made once; "" for what is no file, which is rejected where it is used.
  /// Throws Interrupted when the observer stops it.
  std::string of(const std::filesystem::path& file, const Observer& observer);
  /// States the digest of the bytes that were read of a file. Throws Error if it is not that of the
  /// last time: the file was replaced meanwhile, and no result would say what it was made of.
  void hold(const std::filesystem::path& file, const std::string& sha256);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::string> digests_;
};

/// One case of a series.
struct EhlCase {
  io::Config config;
  std::string name;         ///< what tells it from the others: "lapped-like / 1 m/s"
  std::size_t place = 0;    ///< among the cases as they were asked for
  std::size_t chain = 0;    ///< each case of a chain but the first may start from the one before
  bool starts_anew = true;  ///< the first of its chain
  engine::Task task = {};   ///< without a file where nothing is stored
  std::string start_file =
      {};  ///< name in the store of what the next case of the chain starts from
};

/// The cases of a series in the order in which each is the best start of the next.
struct EhlSeries {
  ehl::Program program;
  std::vector<EhlCase> cases;
  std::uint64_t seed = 1;
  ehl::SurfaceSource surfaces;
  std::shared_ptr<FileDigests> digests = std::make_shared<FileDigests>();

  /// What a case is solved with; scans are rejected whose bytes changed since they were first read.
  ehl::CaseSetting setting(const Observer& observer) const;
};

/// All combinations of the values on the axes, put into a case. A chain ends where a value changes
/// whose key begins like one of Program::chain_ends. Throws InputError for a key that no case has.
EhlSeries ehl_sweep(const ehl::Program& program, const io::Config& config,
                    const std::vector<SweepAxis>& axes, std::uint64_t seed);

/// The case with each of these values of one key, every one by itself.
EhlSeries ehl_variants(const ehl::Program& program, const io::Config& config,
                       const std::string& key, const std::vector<std::string>& values,
                       std::uint64_t seed);

/// Gives each case the task under which it is stored. Its text is everything that the result
/// depends on: program, version, case file, seed, values, the bytes of the files that it names, and
/// the key of the case before it in the chain. Throws Interrupted when the observer stops it.
void give_tasks(EhlSeries& series, const Observer& observer = {});

/// The files that the cases name, each once.
std::vector<std::filesystem::path> files_of(const EhlSeries& series);

/// What tells each of the cases from the others: its values, plain numbers behind their keys,
/// "lapped-like / 1 m/s / grid.nodes=65".
std::vector<std::string> names_of(const std::vector<SweepAxis>& axes,
                                  const std::vector<Places>& all);

}  // namespace tabor::study
