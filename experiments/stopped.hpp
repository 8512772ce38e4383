#pragma once

#include <string>

#include "core/error.hpp"

namespace touchdown {

/// The user asked to stop; what was computed so far is saved.
class Stopped : public Error {
 public:
  Stopped()
      : Error("stopped; what is finished is saved, and the same command goes on from there") {}
  /// `message` says what is saved and how to go on.
  explicit Stopped(const std::string& message) : Error(message) {}
};

}  // namespace touchdown
