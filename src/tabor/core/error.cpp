#include "tabor/core/error.hpp"

#include "tabor/core/printable.hpp"

namespace tabor {
namespace {

std::string one_line(const std::string& what, const std::string& got, const std::string& expected,
                     const std::string& remedy) {
  std::string line = what;
  const char* separator = ": ";
  if (!got.empty()) {
    line += separator + ("got " + got);
    separator = "; ";
  }
  if (!expected.empty()) {
    line += separator + ("expected " + expected);
    separator = "; ";
  }
  if (!remedy.empty()) line += separator + remedy;
  return line;
}

}  // namespace

InputError::InputError(const std::string& what, const std::string& got, const std::string& expected,
                       const std::string& remedy)
    : Error(printable(one_line(what, got, expected, remedy))) {}

}  // namespace tabor
