// Maps that are read back from result files, and those that follow from them.
#include "tabor/results/result_maps.hpp"

#include <gmock/gmock.h>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::results::test {
namespace {

using tabor::test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;

/// Three pixels: one in contact, two apart.
struct Sample {
  topography::Topography surface;
  Field gap{1, 3}, pressure{1, 3}, displacement{1, 3};
  double separation = 3e-6;

  Sample() {
    surface.grid = {.nx = 3, .ny = 1, .lx = 3e-6, .ly = 1e-6};
    surface.height = Field(1, 3);
    surface.height << 4e-6, 1e-6, -2e-6;
    displacement << 1e-6, 0.25e-6, 0.5e-6;
    gap = separation + displacement - surface.height;  // 0 in contact, as in solve_contact
    pressure << 5e6, 0, 0;
  }

  /// As FieldsFile leaves it.
  void write(const std::filesystem::path& file, std::size_t n_states, const FieldsOptions& options,
             const std::string& settings = "") const {
    FieldsFile fields(file, options, {"a command", settings, {}}, surface, {});
    for (std::size_t i = 0; i < n_states; ++i) {
      fields.add_state(i,
                       {{{.key = "separation_m", .unit = "m", .heading = ""}, separation},
                        {{.key = "mean_pressure_Pa", .unit = "Pa", .heading = ""}, 7e6}},
                       {{"pressure", "Pa", "pressure", pressure}, {"gap", "m", "gap", gap}});
    }
    fields.commit({});
  }
};

std::vector<std::string> names_in(const scan::MapSet& set) {
  std::vector<std::string> names;
  for (const scan::NamedMap& map : set.maps) names.push_back(map.name);
  return names;
}

ResultMaps maps_of(const std::filesystem::path& file) {
  return read_result_maps(io::Hdf5Reader(file), file);
}

std::string rejection_of(const ResultMaps& maps, const MapChoice& choice) {
  try {
    chosen_maps(maps, choice);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ResultMaps, HaveWhatTheFileHasAndWhatFollows) {
  const Folder folder;
  const Sample sample;
  sample.write(folder / "a.h5", 1, {.doubles = true});
  const ResultMaps maps = maps_of(folder / "a.h5");
  ASSERT_EQ(maps.states.size(), 1u);
  EXPECT_EQ(maps.states[0].label, "7 MPa");
  EXPECT_NEAR(maps.grid.lx, 3e-6, 1e-20);
  const scan::MapSet all = chosen_maps(maps, {.field = "all"});
  EXPECT_THAT(names_in(all), ElementsAre("height", "gap", "pressure", "contact", "displacement"));
  const Field displacement = all.maps[4].load(), contact = all.maps[3].load();
  for (Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(displacement(i), sample.displacement(i), 1e-20);
    EXPECT_EQ(contact(i), sample.pressure(i) > 0 ? 1 : 0);
  }
  EXPECT_EQ(all.maps[2].unit, "Pa");
  EXPECT_EQ(all.maps[2].precision, io::Precision::float64);
}

TEST(ResultMaps, OfAllStatesAreNumbered) {
  const Folder folder;
  Sample().write(folder / "a.h5", 2, {});
  const ResultMaps maps = maps_of(folder / "a.h5");
  EXPECT_THAT(names_in(chosen_maps(maps, {.field = "gap", .state = std::nullopt})),
              ElementsAre("gap_0000", "gap_0001"));
  EXPECT_THAT(names_in(chosen_maps(maps, {.field = "gap", .state = 1})), ElementsAre("gap"));
  EXPECT_EQ(chosen_maps(maps, {.field = "gap"}).maps[0].precision, io::Precision::float32);
}

TEST(ResultMaps, ThatAreNotThereAreNamed) {
  const Folder folder;
  Sample().write(folder / "a.h5", 2, {.fields = Fields::contact});
  const ResultMaps maps = maps_of(folder / "a.h5");
  EXPECT_THAT(rejection_of(maps, {.field = "gap"}), HasSubstr("contact, height, pressure or all"));
  EXPECT_THAT(rejection_of(maps, {.field = "presure"}), HasSubstr("did you mean 'pressure'?"));
  EXPECT_THAT(rejection_of(maps, {.field = "height", .state = 2}), HasSubstr("1 (7 MPa) or all"));
}

TEST(ResultMaps, HaveNoDisplacementOnASurfaceThatIsNotInTheFile) {
  const Folder folder;
  Sample().write(folder / "a.h5", 2, {}, "load_path = true\n");
  const ResultMaps maps = maps_of(folder / "a.h5");
  EXPECT_EQ(rejection_of(maps, {.field = "displacement", .state = 0}), "");
  EXPECT_THAT(rejection_of(maps, {.field = "displacement", .state = 1}),
              HasSubstr("got 1, which has no map 'displacement'; expected one of 0"));
}

TEST(ResultMaps, NeedAFileWithMaps) {
  const Folder folder;
  Sample().write(folder / "a.h5", 1, {.fields = Fields::none});
  EXPECT_THROW(maps_of(folder / "a.h5"), InputError);
}

TEST(FieldsFile, IsAVtiByItsExtension) {
  const Folder folder;
  const Sample sample;
  sample.write(folder / "a.vti", 1, {});
  sample.write(folder / "a.h5", 1, {});
  scan::write(chosen_maps(maps_of(folder / "a.h5"), {.field = "all"}), folder / "b.vti");
  EXPECT_EQ(tabor::test::bytes_of(folder / "a.vti"), tabor::test::bytes_of(folder / "b.vti"));
  EXPECT_EQ(folder.n_files(), 3u);
  EXPECT_THROW(sample.write(folder / "c.vti", 1, {.fields = Fields::none}), InputError);
  EXPECT_EQ(folder.n_files(), 3u);
}

}  // namespace
}  // namespace tabor::results::test
