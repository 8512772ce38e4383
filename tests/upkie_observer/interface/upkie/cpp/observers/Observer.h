#pragma once

#include <palimpsest/Dictionary.h>
#include <string>

namespace upkie::cpp::observers {

using palimpsest::Dictionary;

/// The interface of Upkie's observers, for tests.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual inline std::string prefix() const noexcept { return "unknown"; }
  virtual void reset(const Dictionary& /*config*/) {}
  virtual void read(const Dictionary& /*observation*/) {}
  virtual void write(Dictionary& /*observation*/) {}
};

}  // namespace upkie::cpp::observers
