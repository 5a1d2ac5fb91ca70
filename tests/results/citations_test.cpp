// What is cited: entries of the bibliography, each once, in its order.
#include "tabor/results/citations.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "support/folder.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

namespace tabor::results::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

std::vector<std::string> keys_of(const std::vector<BibliographyEntry>& entries) {
  std::vector<std::string> keys;
  keys.reserve(entries.size());
  for (const BibliographyEntry& entry : entries) keys.push_back(entry.key);
  return keys;
}

TEST(Citations, BeginWithTaborAndAreWholeEntries) {
  const std::vector<BibliographyEntry> all = citations();
  EXPECT_EQ(all.front().key, "tabor");
  for (const BibliographyEntry& entry : all) {
    EXPECT_THAT(entry.text, StartsWith("@")) << entry.key;
    EXPECT_THAT(entry.text, HasSubstr("{" + entry.key + ","));
    EXPECT_EQ(std::count(entry.text.begin(), entry.text.end(), '{'),
              std::count(entry.text.begin(), entry.text.end(), '}'))
        << entry.key;
  }
}

TEST(Citations, ContainEveryKeyOnce) {
  std::vector<std::string> keys = keys_of(citations());
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(Citations, HaveAnEntryForWhatSettingsAskFor) {
  cases::CaseSettings settings;
  settings.contact.saturation_pressure = 1e9;
  settings.fluid.fluid = cases::Fluid::reynolds;
  for (const std::string& key : references_of(settings)) {
    EXPECT_THAT(keys_of(citations({key})), ElementsAre("tabor", key));
  }
}

TEST(Citations, NameTheSoftwareBelow) {
  EXPECT_EQ(with_software({"costagliola2021"}), (ReferenceKeys{"costagliola2021", "salmon2011"}));
  EXPECT_EQ(with_software({"bowden1950"}), ReferenceKeys{"bowden1950"});
}

TEST(Citations, AreWrittenWithEmptyLinesBetween) {
  EXPECT_EQ(bibtex_of({{"a", "@book{a,\n}"}, {"b", "@book{b,\n}"}}),
            "@book{a,\n}\n\n@book{b,\n}\n");
}

TEST(Citations, OfAnotherProgramsFileAreRejected) {
  const tabor::test::Folder folder;
  const auto file = folder / "other.h5";
  io::Hdf5Writer writer(file);
  writer.attribute("/", "format", "other");
  writer.commit();
  EXPECT_THAT([&] { references_in(file); },
              ThrowsMessage<InputError>(HasSubstr("an HDF5 file of another program")));
}

}  // namespace
}  // namespace tabor::results::test
