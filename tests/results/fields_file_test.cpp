// Result files: settings as TOML, and a contact that several films share, stored once.
#include "tabor/results/fields_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>

#include "support/folder.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/io/text/toml.hpp"

namespace tabor::results::test {
namespace {

using testing::IsEmpty;

cases::ContactRecord contact_at(double mean_pressure) {
  cases::ContactRecord record;
  record.summary.mean_pressure = mean_pressure;
  record.state.pressure = record.state.gap = record.state.displacement = Field::Zero(2, 3);
  return record;
}

cases::FilmRecord film_of(double density) {
  cases::FilmRecord record;
  record.lubricant_density = density;
  record.film.thickness = Field::Zero(2, 3);
  return record;
}

std::string owner_of(const std::string& name, const std::vector<StateField>& fields) {
  for (const StateField& field : fields) {
    if (field.name == name) return field.owner;
  }
  return "no such field";
}

TEST(FieldsFile, SettingsAreTomlThatIsReadAgain) {
  cases::CaseSettings settings;
  settings.contact.youngs_modulus = 70e9;
  settings.contact.material = "aluminium \"6016\"";
  const std::string text = toml_of(settings_json(settings));
  const io::Config config = io::Config::parse(text, "settings");
  EXPECT_EQ(config.text("material"), settings.contact.material);
  EXPECT_EQ(config.number("youngs_modulus_Pa"), 70e9);
  EXPECT_FALSE(config.has("saturation_pressure_Pa"));  // elastic
  EXPECT_FALSE(config.has("fluid"));                   // the oil does not flow
  EXPECT_EQ(config.text("area"), "corrected");
}

TEST(FieldsFile, AContactIsTheSameUnderAllFilms) {
  const cases::ContactRecord contact = contact_at(7e6);
  const cases::ContactRecord other = contact_at(8e6);
  const cases::FilmRecord thin = film_of(1e-4);
  const cases::FilmRecord thick = film_of(1e-3);
  const auto under_thin = fields_of(contact, {thin});
  const auto under_thick = fields_of(contact, {thick});
  const auto of_other = fields_of(other, {thick});
  EXPECT_EQ(owner_of("pressure", under_thin), owner_of("pressure", under_thick));
  EXPECT_NE(owner_of("pressure", under_thick), owner_of("pressure", of_other));
  EXPECT_NE(owner_of("film_thickness", under_thin), owner_of("film_thickness", under_thick));
  EXPECT_EQ(owner_of("film_thickness", under_thick), owner_of("film_thickness", of_other));
}

TEST(FieldsFile, ContactsOfOnePressureAlongALoadPathDiffer) {
  const cases::ContactRecord loading = contact_at(7e6);
  cases::ContactRecord unloading = loading;
  unloading.summary.separation = -1e-7;
  const cases::FilmRecord film = film_of(1e-4);
  EXPECT_NE(owner_of("gap", fields_of(loading, {film})),
            owner_of("gap", fields_of(unloading, {film})));
}

TEST(FieldsFile, CasesSayWhatAWarningIsAbout) {
  EXPECT_EQ(case_of(contact_at(7e6)).pressure, "7 MPa");
  EXPECT_THAT(case_of(contact_at(7e6)).density, IsEmpty());
  EXPECT_EQ(case_of(film_of(9e-4)).density, "0.9 g/m^2");
}

TEST(FieldsFile, BeginsWithItsHead) {
  const tabor::test::Folder folder;
  topography::Topography surface;
  surface.height = Field::Zero(2, 3);
  surface.grid = {3, 2, 3e-6, 2e-6};
  FieldsFile file(folder / "a.h5", {}, {"a command", "a = 1\n", {"rey2017"}}, surface,
                  {"scan.h5", "abc"});
  file.add_state(0, {}, {{"gap", "m", "gap", surface.height}});
  file.commit({});
  const io::Hdf5Reader reader(folder / "a.h5");
  EXPECT_EQ(reader.text("/", "command"), "a command");
  EXPECT_EQ(reader.text("/", "config_toml"), "a = 1\n");
  EXPECT_EQ(reader.text("/", "input_sha256"), "abc");
  EXPECT_EQ(reader.text("/surface", "source"), "scan.h5");
  EXPECT_EQ(reader.attribute_texts("/", "methods"), std::vector<std::string>{"rey2017"});
}

topography::Topography flat() {
  topography::Topography surface;
  surface.height = Field::Zero(2, 3);
  surface.grid = {3, 2, 3e-6, 2e-6};
  return surface;
}

cases::ContactSettings steel(std::optional<double> saturation_pressure) {
  cases::ContactSettings settings;
  settings.youngs_modulus = 210e9;
  settings.poissons_ratio = 0.3;
  settings.saturation_pressure = saturation_pressure;
  return settings;
}

/// One pixel apart, one in contact, one just below saturation, one at it.
cases::ContactRecord saturated_contact(double cap) {
  cases::ContactRecord record = contact_at(7e6);
  record.state.pressure << 0, 1e6, cap * (1 - 1e-9), cap, 0, 0;
  return record;
}

std::vector<int> states_in(const std::filesystem::path& file, const std::string& path) {
  const io::ByteMap map = io::Hdf5Reader(file).bytes(path);
  return {map.data(), map.data() + map.size()};
}

TEST(FieldsFile, StoresWhichPixelsAreSaturated) {
  const tabor::test::Folder folder;
  const topography::Topography surface = flat();
  FieldsFile file({folder / "a.h5", {}, "a command", {}}, surface, steel(240e6));
  file.add(0, saturated_contact(240e6));
  file.commit({});
  // In single precision the third pressure is the saturation pressure; the map is not of it.
  EXPECT_EQ(states_in(folder / "a.h5", "/states/0000/state"), (std::vector<int>{0, 1, 1, 2, 0, 0}));
  FieldsFile elastic({folder / "b.h5", {}, "a command", {}}, surface, steel(std::nullopt));
  elastic.add(0, saturated_contact(240e6));
  elastic.commit({});
  EXPECT_EQ(states_in(folder / "b.h5", "/states/0000/state"), (std::vector<int>{0, 1, 1, 1, 0, 0}));
}

TEST(FieldsFile, StoresNoStateWithoutMaps) {
  const tabor::test::Folder folder;
  const topography::Topography surface = flat();
  FieldsFile file({folder / "a.h5", {.fields = Fields::none}, "a command", {}}, surface,
                  steel(std::nullopt));
  file.add(0, contact_at(7e6));
  file.commit({});
  EXPECT_FALSE(io::Hdf5Reader(folder / "a.h5").exists("/states/0000/state"));
}

TEST(FieldsFile, SharesTheStateOfAContactUnderAllFilms) {
  const tabor::test::Folder folder;
  const topography::Topography surface = flat();
  cases::CaseSettings settings;
  settings.contact = steel(240e6);
  FieldsFile file({folder / "a.h5", {}, "a command", {}}, surface, settings);
  const cases::ContactRecord contact = saturated_contact(240e6);
  file.add(0, {}, contact, {film_of(1e-4)});
  file.add(1, {}, contact, {film_of(1e-3)});
  file.commit({});
  for (const char* path : {"/states/0000/state", "/states/0001/state"}) {
    EXPECT_EQ(states_in(folder / "a.h5", path), (std::vector<int>{0, 1, 1, 2, 0, 0})) << path;
  }
}

TEST(FieldsFile, DescribesTheNumbersOfItsStates) {
  const tabor::test::Folder folder;
  const topography::Topography surface = flat();
  FieldsFile file({folder / "a.h5", {}, "a command", {}}, surface, steel(std::nullopt));
  file.add(0, contact_at(7e6));
  file.add(1, contact_at(8e6));
  file.commit({});
  const io::Hdf5Reader reader(folder / "a.h5");
  const std::vector<std::string> keys = reader.texts("/columns/key");
  std::vector<std::string> expected;
  for (const auto& column : cases::contact_columns()) {
    const bool is_of_a_tool = column.key == "tool_x_m";
    if (column.is_in(cases::media::kObject) && !is_of_a_tool) expected.push_back(column.key);
  }
  EXPECT_EQ(keys, expected);  // each once, in the order of the columns
  const auto place = std::find(keys.begin(), keys.end(), "contact_area_fraction") - keys.begin();
  EXPECT_EQ(reader.texts("/columns/heading").at(place), "contact area");
  EXPECT_EQ(reader.texts("/columns/units").at(0), "Pa");
  EXPECT_EQ(reader.texts("/columns/style").at(place), "percent");
}

}  // namespace
}  // namespace tabor::results::test
