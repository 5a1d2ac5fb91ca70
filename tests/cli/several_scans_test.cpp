// info and contact of several scans, side by side.
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SeveralScans : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, pixels] : {std::pair{"fine.h5", "64"}, std::pair{"coarse.h5", "32"}}) {
      const Outcome made = run_tabor({"generate", "self-affine", "-o", file(name), "--pixels",
                                      pixels, "--pixel", "1um", "--rms-slope", "0.1"});
      ASSERT_EQ(made.code, 0) << made.err;
    }
    put_bytes(folder_ / "bare.txt", "1 2 3\n4 5 6\n7 8 10\n");
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  Words contact(const Words& scans) const {
    return Words{"contact"} + scans + Words{"--pressure", "20MPa,50MPa",     "--youngs-modulus",
                                            "70GPa",      "--poisson-ratio", "0.33"};
  }

  Folder folder_;
};

/// The object of one scan without what belongs to the command.
io::Json alone(io::Json object) {
  for (const char* key : {"tabor_version", "command", "warnings"}) object.erase(key);
  return object;
}

TEST_F(SeveralScans, InfoHasARowForEach) {
  const Outcome outcome = run_tabor({"info", file("fine.h5"), file("coarse.h5")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(count_lines(outcome.out), 5u) << outcome.out;  // heading, rule, two rows, a note
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("64 x 64"), HasSubstr("32 x 32"), HasSubstr("tilt")));
}

TEST_F(SeveralScans, InfoJsonHoldsWhatThatOfEachHolds) {
  const io::Json both = json_of({"info", file("fine.h5"), file("coarse.h5")});
  ASSERT_EQ(both.at("scans").size(), 2u);
  EXPECT_EQ(both.at("scans").at(0), alone(json_of({"info", file("fine.h5")})));
  EXPECT_EQ(both.at("scans").at(1), alone(json_of({"info", file("coarse.h5")})));
}

TEST_F(SeveralScans, InfoNamesTheOneThatCannotBeReadAndShowsTheOthers) {
  const Words words = {"info", file("fine.h5"), file("absent.h5")};
  const Outcome outcome = run_tabor(words);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("64 x 64"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("not read: "), HasSubstr("absent.h5")));
  EXPECT_TRUE(json_of(words).at("scans").at(1).contains("failure"));
}

TEST_F(SeveralScans, InfoSaysWhatAFileWithoutAPixelNeeds) {
  const Outcome outcome = run_tabor({"info", file("fine.h5"), file("bare.txt")});
  EXPECT_EQ(outcome.code, 0);  // as of this file alone
  EXPECT_THAT(outcome.out, HasSubstr("incomplete"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bare.txt"), HasSubstr("--pixel")));
}

TEST_F(SeveralScans, ContactPutsTheStatesOfAllInOneTable) {
  const Outcome outcome = run_tabor(contact({file("fine.h5"), file("coarse.h5")}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(count_lines(outcome.out), 6u) << outcome.out;  // heading, rule, two states of each
  EXPECT_THAT(outcome.out,
              AllOf(testing::StartsWith("scan"), HasSubstr("fine.h5"), HasSubstr("coarse.h5")));
}

TEST_F(SeveralScans, ContactJsonHoldsTheStatesOfEach) {
  const io::Json both = json_of(contact({file("fine.h5"), file("coarse.h5")}));
  ASSERT_EQ(both.at("scans").size(), 2u);
  for (const auto& [place, name] : {std::pair{0, "fine.h5"}, std::pair{1, "coarse.h5"}}) {
    const io::Json& found = both.at("scans").at(place);
    const io::Json one = json_of(contact({file(name)}));
    EXPECT_EQ(found.at("scan"), one.at("scan"));
    EXPECT_EQ(found.at("nx"), one.at("nx"));
    for (const int state : {0, 1}) {
      for (const char* key : {"mean_pressure_Pa", "contact_area_fraction", "mean_gap_m"}) {
        EXPECT_EQ(found.at("states").at(state).at(key), one.at("states").at(state).at(key)) << key;
      }
    }
  }
}

TEST_F(SeveralScans, ContactCsvNamesTheScanOfEachRow) {
  const Outcome outcome = run_tabor(contact({file("fine.h5"), file("coarse.h5")}) + Words{"--csv"});
  EXPECT_THAT(outcome.out, testing::StartsWith("scan,mean_pressure_Pa,"));
  EXPECT_THAT(outcome.out, HasSubstr("\ncoarse.h5,"));
}

TEST_F(SeveralScans, ContactGoesOnBehindAScanThatCannotBeRead) {
  const Outcome outcome = run_tabor(contact({file("absent.h5"), file("fine.h5")}));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("fine.h5"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("not computed: "), HasSubstr("absent.h5")));
}

TEST_F(SeveralScans, ContactStoresMapsOfOneAlone) {
  const Outcome outcome =
      run_tabor(contact({file("fine.h5"), file("coarse.h5")}) + Words{"-o", file("maps.h5")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("tabor sweep"));
}

}  // namespace
}  // namespace tabor::test
