#include <cmath>

#include "study/example_study.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/task_file.hpp"

// Rows of a study as files of its store, whole, damaged and of earlier versions.
namespace tabor::study {
namespace {

using engine::Store;
using engine::Task;
using test::Folder;
using test::message_of;
using testing::HasSubstr;

/// A row says what it depends on, which a test leaves alone.
std::string without_head(const std::string& row) { return row.substr(row.find("\"scan\"")); }

TEST(Row, ReadsBackToTheSameBits) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  row.scan = "a \"b\"\xff.x3p";
  row.mean_pressure = 1.0 / 3;
  row.friction_dry = 0.1 + 0.2;
  row.mean_gap = 4.9e-324;
  row.converged = true;
  write_row(store, task, row);
  const Row again = read_row(store, task);
  EXPECT_EQ(again.mean_pressure, row.mean_pressure);
  EXPECT_EQ(again.friction_dry, row.friction_dry);
  EXPECT_EQ(again.mean_gap, row.mean_gap);
  EXPECT_TRUE(std::isnan(again.friction_lubricated));
  EXPECT_TRUE(again.converged);
  EXPECT_TRUE(defect(store, task).empty());
}

TEST(Row, AnyOtherByteIsADefectOrSaysTheSame) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  row.scan = "a.h5";
  row.friction_dry = 0.1 + 0.2;
  row.contact_area_fraction = 0.125;
  row.converged = true;
  write_row(store, task, row);
  const std::string all = test::bytes_of(store.path(task));
  int n_found = 0;
  for (std::size_t at = 0; at < all.size(); ++at) {
    for (const int flip : {1, 2, 4, 8, 16, 32, 64, 128}) {
      std::string bytes = all;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      test::put_bytes(store.path(task), bytes);
      if (!defect(store, task).empty()) {
        ++n_found;
        continue;
      }
      write_row(store, task, read_row(store, task));
      EXPECT_EQ(without_head(test::bytes_of(store.path(task))), without_head(all)) << at;
    }
  }
  EXPECT_GT(n_found, std::ssize(all) * 7);
}

TEST(Task, AnyOtherByteOfItsFileIsADefect) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "contact-0123456789abcdef.h5"};
  task_writer(store, task, "contact").commit();
  ASSERT_EQ(defect(store, task), "");
  EXPECT_NE(defect(store, {"another text", task.key, task.file}), "");
  const std::string all = test::bytes_of(store.path(task));
  for (std::size_t at = 0; at < all.size(); at += 7) {
    std::string bytes = all;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    test::put_bytes(store.path(task), bytes);
    EXPECT_THAT(defect(store, task), HasSubstr(task.file)) << at;
    test::put_bytes(store.path(task), all.substr(0, at));
    EXPECT_THAT(defect(store, task), HasSubstr(task.file)) << at;
  }
}

TEST(Row, EveryTruncationIsADefect) {
  const Folder folder;
  const Store store(folder / "out", Store::Use::alone);
  const Task task{"text", "0123456789abcdef", "case-0123456789abcdef.json"};
  Row row;
  row.case_id = task.key;
  write_row(store, task, row);
  const std::string all = test::bytes_of(store.path(task));
  for (std::size_t size = 0; size + 2 < all.size(); ++size) {
    test::put_bytes(store.path(task), all.substr(0, size));
    EXPECT_FALSE(defect(store, task).empty()) << size;
  }
}

}  // namespace
}  // namespace tabor::study
