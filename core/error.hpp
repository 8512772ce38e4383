#pragma once

#include <stdexcept>
#include <string>

namespace touchdown {

/// Base of every exception that touchdown throws: something that was asked for could not be done.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The request itself was wrong: a configuration, a model, a log, a flag. The command line answers
/// with exit code 2; the message is one line, `file:line:column: what was expected`.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop; what was computed so far is saved.
class Stopped : public Error {
 public:
  Stopped()
      : Error("stopped; what is finished is saved, and the same command goes on from there") {}
  /// `message` says what is saved and how to go on.
  explicit Stopped(const std::string& message) : Error(message) {}
};

}  // namespace touchdown
