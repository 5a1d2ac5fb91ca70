#pragma once

#include <string>

#include "tabor/io/json.hpp"
#include "tabor/study/store.hpp"

// Files of JSON that hold the numbers of one finished task.
namespace tabor::study {

/// Writes an object together with the task's text and the digest of both. Throws OutputError.
void write_checkpoint(const Store& store, const Task& task, const io::Json& numbers);

/// The object as it was written. Throws InputError if it is damaged or of another task.
io::Json read_checkpoint(const Store& store, const Task& task);

/// What read_checkpoint() would complain of, or "".
std::string defect_of_checkpoint(const Store& store, const Task& task);

}  // namespace tabor::study
