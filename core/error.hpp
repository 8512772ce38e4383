#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace touchdown {

/// Base of every exception that touchdown throws: a request could not be fulfilled. Bytes of value
/// 0 in its message, at which `what()` would end, become ␀ (U+2400).
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message) : std::runtime_error(whole(std::move(message))) {}

 private:
  static std::string whole(std::string message) {
    for (std::size_t at = 0; (at = message.find('\0', at)) != std::string::npos;) {
      message.replace(at, 1, "\u2400");
    }
    return message;
  }
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
