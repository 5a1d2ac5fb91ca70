#pragma once

#include <string>

#include "tabor/engine/store.hpp"
#include "tabor/io/text/json.hpp"

// Writes and reads checkpoints: JSON files with the numbers of one finished task.
namespace tabor::engine {

/// Writes an object together with the task's text and the digest of both. Throws OutputError.
void write_checkpoint(const Store& store, const Task& task, const io::Json& numbers);

/// Reads the object as it was written. Throws InputError if it is damaged or of another task.
io::Json read_checkpoint(const Store& store, const Task& task);

/// Returns the error that read_checkpoint() would throw, or "".
std::string defect_of_checkpoint(const Store& store, const Task& task);

}  // namespace tabor::engine
