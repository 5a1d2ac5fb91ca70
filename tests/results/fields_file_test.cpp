// Result files: settings as TOML, and a contact that several films share, stored once.
#include "tabor/results/fields_file.hpp"

#include <gmock/gmock.h>

#include "support/folder.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/io/toml.hpp"

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
  const auto under_thin = fields_of(contact, thin, nullptr);
  const auto under_thick = fields_of(contact, thick, nullptr);
  const auto of_other = fields_of(other, thick, nullptr);
  EXPECT_EQ(owner_of("pressure", under_thin), owner_of("pressure", under_thick));
  EXPECT_NE(owner_of("pressure", under_thick), owner_of("pressure", of_other));
  EXPECT_NE(owner_of("film_thickness", under_thin), owner_of("film_thickness", under_thick));
  EXPECT_EQ(owner_of("film_thickness", under_thick), owner_of("film_thickness", of_other));
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

}  // namespace
}  // namespace tabor::results::test
