#include "tabor/io/columns.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"

namespace tabor::io {
namespace {

using test::Folder;

struct Flow {
  double speed = 0;
  int n_steps = 0;
};

struct Measured {
  double gap = 0;
};

struct Record {
  std::string name;
  Measured measured;
  std::size_t n_patches = 0;
  bool converged = false;
  std::vector<std::string> codes;
  std::optional<Flow> flow;

  double twice() const { return 2 * measured.gap; }
};

constexpr Media kTable = 1;
constexpr Media kObject = 2;

const Columns<Record>& columns() {
  static const Columns<Flow> flow{{"flow.speed_m_per_s", "m/s", "speed", &Flow::speed},
                                  {"flow.n_steps", "", "steps", &Flow::n_steps}};
  static const Columns<Record> all =
      joined<Record>({{"name", "", "name", &Record::name},
                      {"gap_m", "m", "gap", member_of(&Record::measured, &Measured::gap)},
                      {"n_patches", "", "patches", &Record::n_patches},
                      {"converged", "", "converged", &Record::converged},
                      {"codes", "", "", &Record::codes, {.media = kObject}},
                      {"twice_m", "m", "", &Record::twice},
                      {"", "m", "shown alone", member_of(&Record::measured, &Measured::gap)}},
                     within(flow, &Record::flow));
  return all;
}

Record full() {
  return {.name = "a",
          .measured = {.gap = 0.1},
          .n_patches = 7,
          .converged = true,
          .codes = {"x", "y"},
          .flow = Flow{.speed = 3, .n_steps = 4}};
}

TEST(Columns, MakeAnObjectInTheirOrder) {
  EXPECT_EQ(to_text(json_of(columns(), full()), -1),
            R"({"name":"a","gap_m":0.1,"n_patches":7,"converged":true,"codes":["x","y"],)"
            R"("twice_m":0.2,"flow":{"speed_m_per_s":3.0,"n_steps":4}})");
}

TEST(Columns, LeaveOutWhatARecordHasNotAndWriteNullForWhatWasNotFound) {
  Record record = full();
  record.flow.reset();
  record.measured.gap = std::nan("");
  EXPECT_EQ(to_text(json_of(columns(), record, kTable), -1),
            R"({"name":"a","gap_m":null,"n_patches":7,"converged":true,"twice_m":null})");
}

TEST(Columns, ReadTheObjectBack) {
  Record back;
  Json object = json_of(columns(), full());
  object["flow.speed_m_per_s"] = nullptr;  // a key of the same spelling plays no part
  object["codes"] = "not read";
  read_json(object, columns(), back, kTable);
  EXPECT_EQ(back.name, "a");
  EXPECT_EQ(back.measured.gap, 0.1);
  EXPECT_EQ(back.n_patches, 7u);
  EXPECT_TRUE(back.converged);
  ASSERT_TRUE(back.flow);
  EXPECT_EQ(back.flow->speed, 3);
  EXPECT_EQ(back.flow->n_steps, 4);
}

TEST(Columns, TakeANumberThatAnOlderObjectLacksAsUnknown) {
  Record back = full();
  Json object = json_of(columns(), full());
  object.erase("gap_m");
  read_json(object, columns(), back, kTable);
  EXPECT_TRUE(std::isnan(back.measured.gap));
  EXPECT_EQ(back.flow->speed, 3);
}

TEST(Columns, RejectObjectsThatLackAKeyOrHoldAnotherKind) {
  Record back;
  Json object = json_of(columns(), full());
  object.erase("name");
  EXPECT_THROW(read_json(object, columns(), back, kTable), InputError);
  object = json_of(columns(), full());
  object["gap_m"] = "0.1";
  EXPECT_THROW(read_json(object, columns(), back, kTable), InputError);
  object["gap_m"] = Json::array();
  EXPECT_THROW(read_json(object, columns(), back, kTable), InputError);
}

TEST(Columns, WriteAttributesThatReadBack) {
  const Folder folder;
  {
    Hdf5Writer writer(folder / "a.h5");
    writer.group("/g");
    Record record = full();
    record.measured.gap = std::nan("");
    write_attributes(writer, "/g", columns(), record);
    writer.commit();
  }
  const Hdf5Reader reader(folder / "a.h5");
  Record back;
  back.measured.gap = 1;
  read_attributes(reader, "/g", columns(), back);
  EXPECT_EQ(back.name, "a");
  EXPECT_TRUE(std::isnan(back.measured.gap));
  EXPECT_EQ(back.n_patches, 7u);
  EXPECT_TRUE(back.converged);
  EXPECT_EQ(back.codes, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(back.flow->n_steps, 4);
}

TEST(Columns, WriteDatasetsOfTheirKindEvenWithoutRecords) {
  const Folder folder;
  Record other = full();
  other.flow.reset();
  {
    Hdf5Writer writer(folder / "a.h5");
    write_datasets(writer, "/t", columns(), {full(), other}, kTable);
    write_datasets(writer, "/none", columns(), {}, kTable);
    writer.commit();
  }
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_EQ(reader.texts("/t/name"), (std::vector<std::string>{"a", "a"}));
  EXPECT_EQ(reader.integers("/t/n_patches"), (std::vector<std::int64_t>{7, 7}));
  EXPECT_EQ(reader.integers("/t/flow.n_steps"), (std::vector<std::int64_t>{4, 0}));
  const std::vector<double> speeds = reader.numbers("/t/flow.speed_m_per_s");
  EXPECT_EQ(speeds[0], 3);
  EXPECT_TRUE(std::isnan(speeds[1]));
  EXPECT_TRUE(reader.texts("/none/name").empty());
  EXPECT_TRUE(reader.integers("/none/converged").empty());
}

TEST(Columns, SayWhatADatasetIs) {
  const tabor::test::Folder folder;
  {
    Hdf5Writer writer(folder / "a.h5");
    writer.write("/t/share", std::vector<double>{0.5});
    describe(writer, "/t/share", {"share", "", "wet", {.shown = Shown::percent}});
    writer.write("/t/gap_m", std::vector<double>{1});
    describe(writer, "/t/gap_m", {"gap_m", "m", ""});
    write_column_table(writer, {{"gap_m", "m", "mean gap"},
                                {"share", "", "wet", {.shown = Shown::percent}},
                                {"gap_m", "m", "mean gap"}});
    writer.commit();
  }
  const Hdf5Reader reader(folder / "a.h5");
  EXPECT_EQ(reader.text("/t/share", "heading"), "wet");
  EXPECT_EQ(reader.text("/t/share", "style"), "percent");
  EXPECT_FALSE(reader.has_attribute("/t/share", "units"));
  EXPECT_EQ(reader.text("/t/gap_m", "units"), "m");
  EXPECT_FALSE(reader.has_attribute("/t/gap_m", "heading"));  // the terminal does not show it
  EXPECT_FALSE(reader.has_attribute("/t/gap_m", "style"));
  EXPECT_EQ(reader.texts("/columns/key"), (std::vector<std::string>{"gap_m", "share"}));
  EXPECT_EQ(reader.texts("/columns/heading"), (std::vector<std::string>{"mean gap", "wet"}));
  EXPECT_EQ(reader.texts("/columns/units"), (std::vector<std::string>{"m", ""}));
  EXPECT_EQ(reader.texts("/columns/style"), (std::vector<std::string>{"by_unit", "percent"}));
}

TEST(Columns, MakeATableOfCommas) {
  Record other = full();
  other.flow.reset();
  other.measured.gap = std::nan("");
  EXPECT_EQ(csv_of(columns(), {full(), other}, kTable),
            "name,gap_m,n_patches,converged,twice_m,flow.speed_m_per_s,flow.n_steps\n"
            "a,0.1,7,true,0.2,3,4\na,,7,true,,,\n");
}

}  // namespace
}  // namespace tabor::io
