#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace tabor::test {

/// A measured scan that is not part of the project (third-party data).
inline std::filesystem::path shared_scan(const std::string& name) {
  return std::filesystem::path(TABOR_SHARED_SCANS) / name;
}

/// A sample surface that is part of the project.
inline std::filesystem::path sample_surface(const std::string& name) {
  return std::filesystem::path(TABOR_SOURCE_DIR) / "surfaces" / name;
}

}  // namespace tabor::test

/// Skips the test, with the reason, where the measured scans are not at hand.
#define TABOR_NEEDS_SHARED_SCAN(name)                                      \
  if (!std::filesystem::exists(tabor::test::shared_scan(name))) {          \
    GTEST_SKIP() << "the measured scan " << (name) << " is not available"; \
  }                                                                        \
  static_assert(true, "")
