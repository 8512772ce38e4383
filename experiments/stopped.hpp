#pragma once

#include "core/error.hpp"

namespace touchdown {

/// The user asked to stop; what was computed so far is saved.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped") {}
};

}  // namespace touchdown
