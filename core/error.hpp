#pragma once

#include <stdexcept>
#include <string>

namespace touchdown {

/// Base of every exception that touchdown throws: a request could not be fulfilled.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The request itself was wrong: a configuration, a model, a log or a flag. The command line exits
/// with code 2. The message is one line, `file:line:column: what was expected`.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop. Finished results are saved.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped; finished work is saved, and the same command continues from there") {}
  /// `message` states what is saved and how to continue.
  explicit Stopped(const std::string& message) : Error(message) {}
};

}  // namespace touchdown
