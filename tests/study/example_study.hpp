#pragma once

#include <gmock/gmock.h>

#include <string>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/study/study.hpp"
#include "tabor/study/sweep.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {

inline constexpr const char* kStudyText = R"(title = "two small scans"
shear_strength = "70 MPa"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
saturation_pressure = "240 MPa"
[treatment]
steps = ["level=mean"]
[sweep]
mean_pressure = ["5 MPa", "15 MPa"]
lubricant_density = ["0.45 g/m^2", "0.9 g/m^2"]
[[scan]]
file = "scan_*.h5"
group = "side A"
)";

/// A folder with two small periodic scans and a study of them: 2 scans x 2 pressures x 2 densities.
class ExampleStudy {
 public:
  ExampleStudy() {
    add_scan("scan_1.h5", 1);
    add_scan("scan_2.h5", 2);
    write(kStudyText);
  }

  void add_scan(const std::string& name, std::uint64_t seed, bool with_hole = false) const {
    synthesis::SelfAffine recipe;
    recipe.grid = {32, 24, 32e-6, 24e-6};
    recipe.rms_height = 0.5e-6;
    recipe.seed = seed;
    topography::Topography scan = synthesis::self_affine(recipe);
    if (with_hole) scan.height(3, 4) = std::numeric_limits<double>::quiet_NaN();
    scan::write(scan, folder / name);
  }

  void write(const std::string& text) const { put_bytes(folder / "study.toml", text); }

  study::Study read() const { return study::read_study(folder / "study.toml"); }

  std::filesystem::path results(const std::string& name = "results") const { return folder / name; }

  std::string csv(const std::string& name = "results") const {
    return bytes_of(results(name) / "results.csv");
  }

  study::Outcome run(const study::SweepOptions& options = {},
                     const std::string& name = "results") const {
    return study::run(read(), results(name), options);
  }

  Folder folder;
};

/// What a study whose oil flows has in front of its [[scan]].
inline constexpr const char* kFlow =
    "[lubricant]\nfluid = \"reynolds\"\nviscosity = \"0.2 Pa s\"\n";

/// The example with oil that flows, at the speeds given as TOML.
inline std::string flowing_study(const std::string& speeds = "[\"0.1 m/s\", \"1 m/s\"]") {
  std::string text = kStudyText;
  const auto put_before = [&](const std::string& part, const std::string& added) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    text.insert(at, added);
  };
  put_before("[[scan]]", "sliding_speed = " + speeds + "\n" + kFlow);
  return text;
}

/// The message of the InputError that `action` throws.
template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

/// The text with one part replaced; fails the test if the part is not there.
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

}  // namespace tabor::test
