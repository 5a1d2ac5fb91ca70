#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// What the fuzzer throws bytes at. The same functions replay known inputs in the ordinary tests.
namespace tabor::fuzz {

struct Target {
  std::string name;  ///< a reader's name in the format table, or what else is read ("study")
  std::function<void(std::string_view)> run;
  bool packed = false;  ///< may unpack compressed data: a small input may rightly need much memory
  /// What a foreign library may ask for before it notices that a file lies [bytes]: users' files
  /// are read in a copy of the process with such a limit (io/hdf5/guard.cpp).
  std::size_t library_bytes = 0;
};

/// One target per reader of the format table, so that a new format is fuzzed without new code, and
/// one for every other thing that reads what a user or another program wrote. run() takes the
/// user's way: it opens, lists the channels, loads each of them. Whatever the bytes, it throws
/// nothing; but std::logic_error if a message does not name the file or a map has no size, and any
/// exception other than InputError comes out as it is: a mistake of the reader.
const std::vector<Target>& targets();

/// Throws std::logic_error for an unknown name.
const Target& target(const std::string& name);

}  // namespace tabor::fuzz
