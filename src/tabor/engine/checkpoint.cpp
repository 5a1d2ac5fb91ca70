#include "tabor/engine/checkpoint.hpp"

#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/sealed_file.hpp"

namespace tabor::engine {

void write_checkpoint(const Store& store, const Task& task, const io::Json& numbers) {
  io::Json json = {{"canonical_text", task.text}};
  json.update(numbers);
  io::write_file(store.path(task), io::to_text(io::sealed(std::move(json))) + "\n");
}

io::Json read_checkpoint(const Store& store, const Task& task) {
  const auto reject = [&](const char* why) {
    throw InputError(store.path(task).string() + ": " + why);
  };
  io::Json json;
  try {
    json = io::read_json(store.path(task));
  } catch (const InputError&) {
    reject("damaged");
  }
  if (!json.is_object() || !io::is_sealed(json)) reject("damaged");
  if (!json.contains("canonical_text") || json["canonical_text"] != task.text) {
    reject("of another task");
  }
  json.erase("canonical_text");
  json.erase("sha256");
  return json;
}

std::string defect_of_checkpoint(const Store& store, const Task& task) {
  try {
    read_checkpoint(store, task);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace tabor::engine
