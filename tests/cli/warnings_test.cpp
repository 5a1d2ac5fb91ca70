// A number comes with the same warnings from the verb for one state and from a study.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/analysis/warning.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/csv.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using topography::Topography;

/// How the surface is made, what is asked of it, and which warnings it must lead to.
struct Condition {
  std::string name;
  std::vector<std::string> expected;  ///< codes
  void (*change)(Topography&) = [](Topography&) {};
  std::string density = "0.2 g/m^2";
  std::string treatment = "";  ///< a step such as "level=plane"
  std::string cap = "8 GPa";   ///< saturation pressure; "" elastic
  std::string boundary = "periodic";
  std::string shear_strength = "70 MPa";
  std::string model = "limit";
  std::string edge = "closed";
};

void PrintTo(const Condition& one, std::ostream* out) { *out << one.name; }

void cut_out(Topography& surface) { surface.periodic = false; }
void tilt(Topography& surface) {
  cut_out(surface);
  for (Index x = 0; x < surface.grid.nx; ++x) surface.height.col(x) += 1e-7 * double(x);
}
void steepen(Topography& surface) { surface.height *= 6; }
void punch(Topography& surface) {
  surface.height.leftCols(40) = std::numeric_limits<double>::quiet_NaN();
}

const Condition kConditions[] = {
    {.name = "Sound", .expected = {}},
    {.name = "CutOut", .expected = {"not-periodic", "not-levelled"}, .change = cut_out},
    {.name = "Levelled", .expected = {"not-periodic"}, .change = tilt, .treatment = "level=plane"},
    {.name = "Tilted", .expected = {"not-levelled"}, .change = tilt},
    {.name = "Free", .expected = {"edge-load"}, .change = tilt, .boundary = "free"},
    {.name = "Holes", .expected = {"filled-holes"}, .change = punch, .treatment = "fill=harmonic"},
    {.name = "Steep", .expected = {"steep"}, .change = steepen},
    {.name = "Elastic", .expected = {"above-hardness"}, .change = steepen, .cap = ""},
    {.name = "Clamp", .expected = {"clamp"}, .cap = "120 MPa"},
    {.name = "Strong",
     .expected = {"implausible-friction"},
     .cap = "120 MPa",
     .shear_strength = "2 GPa"},
    {.name = "Flood", .expected = {"flood", "spill-over", "frictionless"}, .density = "9 g/m^2"},
    {.name = "Bath", .expected = {"flood", "frictionless"}, .model = "uniform"},
    {.name = "Spill", .expected = {"spill-over"}, .density = "1.2 g/m^2"},
    {.name = "Droplets",
     .expected = {"few-droplets"},
     .density = "0.02 g/m^2",
     .model = "droplets"},
    {.name = "Drain", .expected = {"oil-lost"}, .edge = "open"},
};

class WarningsOfNumbers : public testing::TestWithParam<Condition> {
 protected:
  void SetUp() override {
    synthesis::SelfAffine recipe;
    recipe.grid = {64, 48, 64e-6, 48e-6};
    recipe.rms_slope = 0.1;
    recipe.short_cutoff_wavelength = 8e-6;
    Topography surface = synthesis::self_affine(recipe);
    GetParam().change(surface);
    scan::write(surface, folder_ / "scan.h5");
    put_bytes(folder_ / "study.toml", study());
  }

  Words verb() const {
    const Condition& one = GetParam();
    Words words = {"friction",         (folder_ / "scan.h5").string(),
                   "--pressure",       "20MPa",
                   "--youngs-modulus", "70GPa",
                   "--poisson-ratio",  "0.33",
                   "--density",        one.density,
                   "--shear-strength", one.shear_strength,
                   "--boundary",       one.boundary,
                   "--model",          one.model,
                   "--edge",           one.edge,
                   "--droplet",        "0.1um"};
    if (!one.cap.empty()) words.insert(words.end(), {"--saturation-pressure", one.cap});
    if (!one.treatment.empty()) {
      const Words step = split(one.treatment, '=');
      words.insert(words.end(), {"--" + step.front(), step.back()});
    }
    return words;
  }

  std::string study() const {
    const Condition& one = GetParam();
    std::string text = "shear_strength = \"" + one.shear_strength +
                       "\"\n[material]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\n";
    if (!one.cap.empty()) text += "saturation_pressure = \"" + one.cap + "\"\n";
    if (!one.treatment.empty()) text += "[treatment]\nsteps = [\"" + one.treatment + "\"]\n";
    return text + "[contact]\nboundary = \"" + one.boundary + "\"\n[lubricant]\nmodel = \"" +
           one.model + "\"\nedge = \"" + one.edge +
           "\"\ndroplet = \"0.1 um\"\n[sweep]\nmean_pressure = [\"20 MPa\"]\n"
           "lubricant_density = [\"" +
           one.density + "\"]\n[[scan]]\nfile = \"scan.h5\"\n";
  }

  Words sweep() const {
    return {"sweep", (folder_ / "study.toml").string(), "-o", (folder_ / "out").string()};
  }

  Folder folder_;
};

std::set<std::string> codes_of(const io::Json& warnings) {
  std::set<std::string> codes;
  for (const io::Json& warning : warnings) codes.insert(warning.at("code").get<std::string>());
  return codes;
}

TEST_P(WarningsOfNumbers, AreTheSameFromTheVerbAndFromAStudy) {
  const io::Json one = json_of(verb());
  const io::Json many = json_of(sweep());
  ASSERT_TRUE(one.contains("states")) << one;
  ASSERT_TRUE(many.contains("warnings")) << many;
  const io::Json& state = one.at("states").at(0);
  const auto codes = state.at("warning_codes").get<Words>();
  for (const std::string& code : GetParam().expected) {
    EXPECT_THAT(codes, Contains(code));
  }
  EXPECT_EQ(codes.empty(), GetParam().expected.empty());
  EXPECT_EQ(codes_of(one.at("warnings")), std::set<std::string>(codes.begin(), codes.end()));
  EXPECT_EQ(codes_of(many.at("warnings")), codes_of(one.at("warnings")));

  const io::Hdf5Reader results(folder_ / "out" / "results.h5");
  EXPECT_EQ(split(results.texts("/table/warning_codes").at(0), ' '),
            codes.empty() ? Words{""} : codes);
  EXPECT_EQ(results.attribute_texts("/", "warnings").size(), many.at("warnings").size());
  for (const char* key : {"friction_dry", "friction_lubricated", "lubricated_share"}) {
    EXPECT_EQ(results.numbers(std::string("/table/") + key).at(0), state.at(key).get<double>())
        << key;
  }
  // The same when nothing is left to compute.
  EXPECT_EQ(json_of(sweep()).at("warnings"), many.at("warnings"));
}

INSTANTIATE_TEST_SUITE_P(Conditions, WarningsOfNumbers, testing::ValuesIn(kConditions),
                         [](const auto& suite) { return suite.param.name; });

std::string sheet_with_open_edges(const Folder& folder) {
  std::string scan = (folder / "scan.h5").string();
  const Words words = {"generate", "edt",           "-o", scan, "--pixels", "64", "--pixel",
                       "2um",      "--not-periodic"};
  EXPECT_EQ(run_tabor(words).code, 0);
  return scan;
}

/// Several states in one call: each reason once, with the cases it is about.
TEST(Warnings, AreSaidOnceOverManyStates) {
  const Folder folder;
  const std::string scan = sheet_with_open_edges(folder);
  const Words words = {"friction",
                       scan,
                       "--pressure",
                       "2MPa,5MPa,7MPa",
                       "--density",
                       "0.1g/m^2,20g/m^2",
                       "--youngs-modulus",
                       "70GPa",
                       "--poisson-ratio",
                       "0.33",
                       "--saturation-pressure",
                       "240MPa",
                       "--shear-strength",
                       "70MPa",
                       "--model",
                       "limit"};
  const io::Json result = json_of(words);
  const io::Json& warnings = result.at("warnings");
  EXPECT_EQ(codes_of(warnings).size(), warnings.size());
  const auto with = [&](const std::string& code) {
    for (const io::Json& warning : warnings) {
      if (warning.at("code") == code) return warning;
    }
    return io::Json();
  };
  EXPECT_EQ(with("flood").at("cases").get<Words>(), Words{"20 g/m^2"});
  EXPECT_EQ(with("spill-over").at("cases").size(), 3u);
  EXPECT_TRUE(with("not-periodic").at("cases").empty());
  EXPECT_EQ(with("not-periodic").at("n_cases"), 6);

  const Outcome shown = run_tabor(words);
  EXPECT_EQ(count_lines(shown.err), warnings.size()) << shown.err;
  EXPECT_THAT(shown.err, AllOf(HasSubstr("3 of 6 cases"), HasSubstr("[spill-over]"),
                               HasSubstr("--mirror"), HasSubstr("isolated body")));
}

/// The words by which people and scripts look for them.
TEST(Warnings, UseTheAgreedWords) {
  const Folder folder;
  const std::string scan = sheet_with_open_edges(folder);
  const std::string all =
      run_tabor({"friction", scan, "--pressure", "2MPa", "--density", "20g/m^2", "--youngs-modulus",
                 "70GPa", "--poisson-ratio", "0.33", "--saturation-pressure", "240MPa",
                 "--shear-strength", "70MPa"})
          .err;
  for (const char* word : {"flood", "periodic", "level", "spill-over", "frictionless", "clamp"}) {
    EXPECT_THAT(all, HasSubstr(word));
  }
}

}  // namespace
}  // namespace tabor::test
