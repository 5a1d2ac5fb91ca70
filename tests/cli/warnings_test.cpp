// A number comes with the same warnings from the verb for one state and from a study.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cases/warning.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/core/advice.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/synthesis.hpp"
#include "tabor/topography/geometry.hpp"

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

void cut_out(Topography& surface) {
  surface = topography::crop(std::move(surface), {5, 3, 50, 40});
}
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

/// Words that begin with two dashes.
std::set<std::string> options_in(const std::string& text) {
  std::set<std::string> found;
  for (std::size_t begin = text.find("--"); begin != std::string::npos;) {
    const std::size_t end = text.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", begin);
    found.insert(text.substr(begin, end - begin));
    begin = text.find("--", std::min(end, text.size()));
  }
  return found;
}

std::set<std::string> options_of(const std::string& name) {
  std::set<std::string> flags;
  for (const cli::Verb& verb : cli::verbs()) {
    if (verb.name != name) continue;
    const cli::OptionSet set = cli::options_of(verb);
    for (const cli::Option& option : set.options()) flags.insert(option.flag);
  }
  return flags;
}

/// What people read of the verb and of the study: one line each, in the words that each has.
TEST_P(WarningsOfNumbers, FitALineAndAdviseWhatThereIs) {
  const std::string of_verb = run_tabor(verb()).err;
  const std::set<std::string> flags = options_of("friction");
  for (const std::string& option : options_in(of_verb)) EXPECT_THAT(flags, Contains(option));
  EXPECT_THAT(of_verb, testing::Not(HasSubstr("<")));
  const std::string of_study = run_tabor(sweep()).err;
  EXPECT_THAT(options_in(of_study), testing::IsEmpty()) << of_study;
  EXPECT_THAT(of_study, testing::Not(HasSubstr("<")));
  for (const std::string& line : split(of_verb + of_study, '\n')) {
    EXPECT_LE(line.size(), 160u) << line;
    EXPECT_THAT(line, testing::Not(HasSubstr(folder_.path().string())));
  }
}

TEST_P(WarningsOfNumbers, AreDoubtsFirst) {
  const io::Json warnings = json_of(verb()).at("warnings");
  bool is_information = false;
  for (const io::Json& warning : warnings) {
    EXPECT_EQ(warning.at("class"),
              cases::name_of(cases::class_of(warning.at("code").get<std::string>())));
    const bool was_information = is_information;
    is_information = warning.at("class") == "information";
    EXPECT_TRUE(is_information || !was_information) << warnings;
  }
}

/// Every code in the words of every verb: an option is named only where the verb has it.
TEST(Warnings, AdviseOptionsThatTheVerbHas) {
  const std::string text =
      "x; <level=plane>; <despike=auto>; <lowpass>; <lowpass_scan>; <resolution_scan>; <fit_min>; "
      "<saturation_pressure>; <boundary=free>; <area=pixels>; <model=limit>; <droplet_height>; "
      "<mirror>";
  for (const cli::Verb& verb : cli::verbs()) {
    const std::string said = advised(text, cli::spelling_of(cli::options_of(verb)));
    const std::set<std::string> flags = options_of(verb.name);
    for (const std::string& option : options_in(said)) EXPECT_THAT(flags, Contains(option));
    const bool has_scan = flags.contains("--lowpass-scan");
    EXPECT_EQ(said.find("--lowpass-scan") != std::string::npos, has_scan) << verb.name;
  }
}

/// No tile any more.
void raise_one_side(Topography& surface) {
  surface.periodic = surface.edges_match = false;
  for (Index x = 0; x < surface.grid.nx; ++x) surface.height.col(x) += 1e-7 * double(x);
}

TEST(Warnings, NoteWhatWasDoneBehindTheDoubts) {
  const Folder folder;
  synthesis::SelfAffine recipe;
  recipe.grid = {64, 48, 64e-6, 48e-6};
  recipe.rms_height = 1e-7;
  Topography surface = synthesis::self_affine(recipe);
  raise_one_side(surface);
  surface.height(20, 20) += 1e-4;
  surface.grid.ly *= 1.1;
  scan::write(surface, folder / "scan.h5");
  const Words words = {"params",  (folder / "scan.h5").string(), "--despike", "auto", "--fill",
                       "harmonic"};
  const std::string shown = run_tabor(words).err;
  EXPECT_THAT(shown, AllOf(testing::StartsWith("warning: The surface is not levelled"),
                           HasSubstr("\nnote: despike took 1 spike"),
                           HasSubstr("\nnote: Pixels are not square")));
  EXPECT_EQ(shown.rfind("warning:"), 0u) << shown;
}

TEST(Warnings, NameScansWithoutTheirFolders) {
  const Folder folder;
  synthesis::SelfAffine recipe;
  recipe.grid = {32, 32, 32e-6, 32e-6};
  recipe.rms_height = 1e-7;
  Topography surface = synthesis::self_affine(recipe);
  Topography tilted = surface;
  raise_one_side(tilted);
  const std::string first = (folder / "first.h5").string();
  const std::string second = (folder / "second.h5").string();
  scan::write(tilted, first);
  scan::write(surface, second);
  const io::Json warnings = json_of({"params", first, second}).at("warnings");
  ASSERT_EQ(warnings.size(), 1u) << warnings;
  EXPECT_EQ(warnings.at(0).at("cases").get<Words>(), Words{"first.h5"});
}

TEST(Explain, PrintsTheEntryOfACodeBeforeAndBehindAnyVerb) {
  for (const cases::CodeEntry& entry : cases::all_codes()) {
    const std::string code(entry.code);
    const Outcome told = run_tabor({"--explain", code});
    EXPECT_EQ(told.code, 0);
    EXPECT_THAT(told.out, testing::StartsWith(code + " (" + cases::name_of(entry.kind)));
    EXPECT_THAT(told.out, HasSubstr("When: "));
  }
  const std::string shown = run_tabor({"--explain", "spill-over"}).out;
  EXPECT_THAT(shown, HasSubstr("tabor does not follow where it goes"));
  for (const cli::Verb& verb : cli::verbs()) {
    EXPECT_EQ(run_tabor({verb.name, "--explain", "spill-over"}).out, shown) << verb.name;
  }
  EXPECT_EQ(run_tabor({"friction", "scan.h5", "--explain=[spill-over]"}).out, shown);
  const io::Json object = json_of({"contact", "--explain", "despiked", "--json"});
  EXPECT_EQ(object.at("class"), "information");
  EXPECT_EQ(object.at("code"), "despiked");
}

TEST(Explain, NamesTheNearestCode) {
  const Outcome outcome = run_tabor({"--explain", "spil-over"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'spill-over'"));
  EXPECT_EQ(run_tabor({"contact", "--explain"}).code, 2);
}

/// A number that no table takes is marked where it stands, and the pixel is spoken of.
TEST(FrictionOutput, MarksWhatATableRefusesAndNamesThePixel) {
  const Folder folder;
  const std::string scan = (folder / "scan.h5").string();
  ASSERT_EQ(run_tabor({"generate", "edt", "-o", scan, "--pixels", "64", "--pixel", "2um"}).code, 0);
  const Words words = {"friction",         scan,         "--pressure",     "2MPa",    "--density",
                       "0.1g/m^2,20g/m^2", "--material", "aluminium-6016", "--model", "limit"};
  const std::string shown = run_tabor(words).out;
  EXPECT_THAT(shown, AllOf(HasSubstr("'tabor table' leaves out"), HasSubstr("flood\n"),
                           HasSubstr("with pixels of 2 µm"), HasSubstr("of 4 µm")));
  const io::Json pixels = json_of(words).at("pixel_dependence");
  ASSERT_EQ(pixels.size(), 2u);
  EXPECT_EQ(pixels.at(1).at("coarse_lubricated_share"), 1.0);  // flooded on any pixel
  EXPECT_EQ(pixels.at(0).at("coarse_pixel_x_m"), 4e-6);
  Words dry = words;
  dry[5] = "0g/m^2";
  EXPECT_THAT(run_tabor(dry).out,
              testing::Not(AllOf(HasSubstr("leaves out"), HasSubstr("with pixels of"))));
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
                               HasSubstr("--edges cut"), HasSubstr("--edges end")));
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
