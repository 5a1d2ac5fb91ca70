#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/types.hpp"

// Writes and reads HDF5 files: maps, lists, attributes, axes and links.
namespace tabor::io {

using tabor::ByteMap;

/// Value of a compound type: its texts and its numbers (lists laid out one after the other) in the
/// order of the members.
struct Hdf5Record {
  std::vector<std::string> texts;
  std::vector<double> numbers;
};

enum class Precision { float64, float32 };

enum class Seal { no, yes };

/// Writes one HDF5 file under a temporary name; commit() renames it. Without commit() no file
/// remains. Paths are absolute inside the file ("/surface/height"); missing groups are made. Maps
/// are chunked, shuffled and compressed. Throws OutputError (full disk, unwritable folder). Objects
/// of this and the next class may live on different threads.
class Hdf5Writer {
 public:
  /// Opens the temporary file. With a seal, commit() ends the file with the digest of its bytes
  /// (sealed_file.hpp).
  explicit Hdf5Writer(const std::filesystem::path& file, Seal seal = Seal::no);
  ~Hdf5Writer();
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) = delete;

  void commit();
  /// Closes the file without commit(), and returns the temporary name under which it can be read
  /// until the writer ends and removes it.
  const std::filesystem::path& close();

  void group(const std::string& path);
  void write(const std::string& path, const Field& map, Precision precision = Precision::float64);
  void write(const std::string& path, const ByteMap& map);
  void write(const std::string& path, const std::vector<double>& values);
  void write(const std::string& path, const std::vector<std::int64_t>& values);
  void write(const std::string& path, const std::vector<std::string>& values);

  /// Writes an attribute of the group or dataset at `path` ("/" for the file); replaces an older
  /// one.
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name,
                 const std::vector<std::string>& values);
  void attribute(const std::string& path, const std::string& name, int value) {
    attribute(path, name, static_cast<std::int64_t>(value));
  }
  void attribute(const std::string& path, const std::string& name, const char* value) {
    attribute(path, name, std::string(value));
  }
  void attribute(const std::string& path, const std::string& name, bool value) = delete;

  /// Writes `units` and `long_name` of a dataset.
  void describe(const std::string& path, const std::string& units, const std::string& long_name);

  /// Writes cell-centre coordinates `x` and `y` [m] of a grid into a group, as dimension scales;
  /// (left, top) [m] is the grid's corner.
  void axes(const std::string& group, const Grid& grid, double left = 0, double top = 0);
  /// Attaches the scales `y`, `x` of the map's own group.
  void attach_axes(const std::string& map);
  /// Makes the group NeXus NXdata with this default signal over `axes`, datasets of the group.
  void nxdata(const std::string& group, const std::string& signal,
              const std::vector<std::string>& axes = {"y", "x"});

  /// Makes a second name for the object at `target`.
  void link(const std::string& path, const std::string& target);

  /// Makes a link at `path` to `target` inside `file` (relative to this file's folder). It may
  /// dangle.
  void external_link(const std::string& path, const std::string& file, const std::string& target);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Reads an HDF5 file. Throws InputError (file, object, what to do) for everything that is absent,
/// of another kind, damaged, or larger than its own bytes can hold.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);
  ~Hdf5Reader();
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) = delete;

  bool exists(const std::string& path) const;
  /// Returns the names of the links in a group, sorted by bytes; dangling external links included.
  std::vector<std::string> children(const std::string& group) const;
  /// True for a dataset, false for a group.
  bool is_dataset(const std::string& path) const;
  std::vector<Index> shape(const std::string& path) const;
  /// Returns the rows and columns of a map, after checking that the file's bytes can hold them and
  /// that they fit into memory.
  std::array<Index, 2> map_shape(const std::string& path) const;

  /// Returns float32 where numbers are stored as float32 or smaller, else float64.
  Precision precision(const std::string& path) const;

  /// Reads any numeric two-dimensional dataset. `progress` is told the share of rows read so far.
  Field field(const std::string& path,
              const std::function<void(double share)>& progress = {}) const;
  /// Reads a map in pieces of some 32 MiB, whole chunks each: accept(first_row, rows).
  void for_rows(const std::string& path,
                const std::function<void(Index first_row, const Field& rows)>& accept) const;
  ByteMap bytes(const std::string& path) const;
  std::vector<double> numbers(const std::string& path) const;  ///< one-dimensional
  std::vector<std::int64_t> integers(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;
  std::vector<Hdf5Record> records(const std::string& path) const;

  bool has_attribute(const std::string& path, const std::string& name) const;
  std::vector<std::string> attribute_names(const std::string& path) const;
  double number(const std::string& path, const std::string& name) const;
  std::int64_t integer(const std::string& path, const std::string& name) const;
  std::string text(const std::string& path, const std::string& name) const;
  std::vector<std::string> attribute_texts(const std::string& path, const std::string& name) const;
  std::vector<Hdf5Record> attribute_records(const std::string& path, const std::string& name) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// True if the file begins like HDF5 (at offset 0).
bool is_hdf5(const std::filesystem::path& file);

}  // namespace tabor::io
