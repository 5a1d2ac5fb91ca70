#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/units.hpp"

namespace tabor::io {

/// Reads a TOML file, or one table of it. Keys are dotted paths ("material.youngs_modulus"). Every
/// wrong value throws InputError with file, line, key, what stands there and what should.
class Config {
 public:
  static Config read(const std::filesystem::path& file);
  static Config parse(std::string_view text, const std::string& name);

  bool has(std::string_view key) const;

  std::string text(std::string_view key) const;
  double number(std::string_view key) const;
  std::int64_t integer(std::string_view key) const;
  bool flag(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;  ///< an array of strings, or one

  /// Returns texts as they are, numbers as TOML writes them; an array or one value.
  std::vector<std::string> words(std::string_view key) const;

  /// Returns a value with its unit ("70 GPa") in SI. A number without a unit is rejected with the
  /// corrected form, unless `expected` is dimensionless.
  double quantity(std::string_view key, Dimension expected) const;
  std::vector<double> quantities(std::string_view key, Dimension expected) const;

  /// Returns the tables of an array [[key]]; empty if the key is absent.
  std::vector<Config> tables(std::string_view key) const;

  /// Returns the dotted paths of all values in the order of the file; those inside an array of
  /// tables are written "scan[].file".
  std::vector<std::string> keys() const;

  /// Throws for the first key that is not in `known`, naming the nearest. Keys inside an array of
  /// tables are written "scan[].file".
  void reject_unknown(const std::vector<std::string>& known) const;

  /// Returns "study.toml:7: scan.file", the begin of a message about the value at `key`.
  std::string place(std::string_view key) const;
  const std::string& name() const;  ///< of the file

  /// Returns the table as TOML text without comments.
  std::string to_text() const;

  /// Replaces or adds one value: `value` is TOML ("3", "\"5 MPa\"", "true"); text that is none of
  /// these is taken as a string, so that "5 MPa" needs no quotes. Missing tables are made.
  Config with(std::string_view key, std::string_view value) const;

 private:
  struct Table;
  explicit Config(std::shared_ptr<const Table> table);
  std::shared_ptr<const Table> table_;
};

}  // namespace tabor::io
