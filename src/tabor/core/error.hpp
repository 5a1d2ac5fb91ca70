#pragma once

#include <stdexcept>
#include <string>

// Defines the exceptions that the library throws on purpose; their classes tell exit codes apart.
namespace tabor {

/// Base of everything that the library throws on purpose. what() is one line fit for a user's eyes.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Input that cannot be read or is invalid (exit code 3 of the command line).
class InputError : public Error {
 public:
  /// Makes the message "<what>: got <got>; expected <expected>; <remedy>"; empty parts are left
  /// out.
  InputError(const std::string& what, const std::string& got, const std::string& expected,
             const std::string& remedy);
  /// A message that already is one clear line.
  explicit InputError(const std::string& message) : Error(message) {}
};

/// Input that is sound but lacks what only the user can say: a unit, a pixel size, which channel.
class IncompleteError : public InputError {
 public:
  using InputError::InputError;
};

/// A result that cannot be written (exit code 5).
class OutputError : public Error {
 public:
  using Error::Error;
};

/// A word of the command line itself is wrong: an unknown option, a missing argument (exit code 2).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop (exit code 130). Finished results remain.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace tabor
