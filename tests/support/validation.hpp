#pragma once

#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace tabor::test {

/// A text as a JSON string. Control characters become spaces: our texts are single lines.
inline std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

inline std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

inline std::string current_test_name() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  return info ? fmt::format("{}.{}", info->test_suite_name(), info->name()) : "";
}

/// Appends a JSON line to the file that the environment variable TABOR_VALIDATION_FILE names; does
/// nothing without it. `tools/validation` gathers the lines.
inline void append_validation(const std::string& line) {
  const char* path = std::getenv("TABOR_VALIDATION_FILE");
  if (!path || !*path) return;
  // One write() in append mode: lines of tests that run side by side do not mix.
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const bool written =
      file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (file >= 0) close(file);
  EXPECT_TRUE(written) << "cannot append to " << path;
}

/// One row of docs/validation.md.
///
///   section           "Contact", "Elastic operator", "Lubricant", ...
///   case_name         "Westergaard wave, n = 256"
///   quantity          "peak pressure, relative"
///   reference_source  "Westergaard 1939" (whose number we are compared with)
///   measured_error    what was measured, in the same measure as the tolerance
///   tolerance         what the test allows; the assertion itself stands in the test
inline void record_validation(std::string_view section, std::string_view case_name,
                              std::string_view quantity, std::string_view reference_source,
                              double measured_error, double tolerance) {
  append_validation(fmt::format(
      "{{\"section\": {}, \"case\": {}, \"quantity\": {}, \"reference\": {}, \"error\": {}, "
      "\"tolerance\": {}, \"test\": {}}}\n",
      json_string(section), json_string(case_name), json_string(quantity),
      json_string(reference_source), json_number(measured_error), json_number(tolerance),
      json_string(current_test_name())));
}

/// A number of a measured scan beside the one expected of it; all in `unit`.
struct Comparison {
  std::string file, quantity, convention, unit;
  double expected = 0, ours = 0, tolerance = 0;
};

/// One row of the table of scans in docs/validation.md.
inline void record_comparison(const Comparison& row) {
  append_validation(fmt::format(
      "{{\"scan\": {}, \"quantity\": {}, \"convention\": {}, \"unit\": {}, \"expected\": {}, "
      "\"ours\": {}, \"tolerance\": {}}}\n",
      json_string(row.file), json_string(row.quantity), json_string(row.convention),
      json_string(row.unit), json_number(row.expected), json_number(row.ours),
      json_number(row.tolerance)));
}

/// A number that a source prints although it does not follow from the source's own inputs: ours,
/// the printed one and the reason stand in a table of their own. Nothing is asserted.
inline void record_unreproduced(std::string_view section, std::string_view case_name,
                                std::string_view quantity, std::string_view source, double printed,
                                double ours, std::string_view reason) {
  append_validation(fmt::format(
      "{{\"section\": {}, \"case\": {}, \"quantity\": {}, \"reference\": {}, \"printed\": {}, "
      "\"ours\": {}, \"reason\": {}, \"test\": {}}}\n",
      json_string(section), json_string(case_name), json_string(quantity), json_string(source),
      json_number(printed), json_number(ours), json_string(reason),
      json_string(current_test_name())));
}

/// Asserts error <= tolerance (NaN fails) and records the row.
inline void expect_within(std::string_view section, std::string_view case_name,
                          std::string_view quantity, std::string_view reference_source,
                          double measured_error, double tolerance) {
  record_validation(section, case_name, quantity, reference_source, measured_error, tolerance);
  EXPECT_LE(measured_error, tolerance) << case_name << ": " << quantity;
}

}  // namespace tabor::test
