#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>

#include "estimator/assembly/signal_assembler.hpp"
#include "estimator/c_interface/touchdown.h"
#include "estimator/models/make_estimator.hpp"

/// What C knows by its address only; the functions of touchdown.h are in handle.cpp.
struct touchdown_estimator {
  std::string text;  ///< which model it is
  std::unique_ptr<touchdown::ContactEstimator> estimator;
  touchdown::SignalAssembler assembler;
};

namespace touchdown {

/// An estimator for C, of a model's arrays, wherever they come from. Errors: as `make_estimator`.
touchdown_estimator* new_handle(const ModelArrays& arrays, const ModelUse& use);

/// What a program in C expects, which may be nothing.
ModelUse use_of(const touchdown_use* use);

/// As much of an error's text as C has room for.
void tell(const char* what, char* error, std::size_t error_size) noexcept;

/// What `make` makes, a handle, or null and its error's text.
template <typename Make>
touchdown_estimator* handle_or_error(const Make& make, char* error,
                                     std::size_t error_size) noexcept {
  try {
    return make();
  } catch (const std::exception& caught) {
    tell(caught.what(), error, error_size);
  } catch (...) {
    tell("touchdown: failed", error, error_size);
  }
  return nullptr;
}

}  // namespace touchdown
