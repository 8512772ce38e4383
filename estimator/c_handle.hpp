#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>

#include "estimator/models/make_estimator.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/touchdown.h"

/// C programs know this type only by its address. The functions of touchdown.h are in c_handle.cpp.
struct touchdown_estimator {
  std::string text;  ///< the model in one line
  std::unique_ptr<touchdown::ContactEstimator> estimator;
  touchdown::SignalAssembler assembler;
};

namespace touchdown {

/// Makes an estimator for C from a model, or from its arrays. Errors: as `make_estimator`.
touchdown_estimator* new_handle(const Model& model, const ModelUse& use);
touchdown_estimator* new_handle(const ModelArrays& arrays, const ModelUse& use);

/// A C program's requirements of the model; `use` may be null.
ModelUse use_of(const touchdown_use* use);

/// Copies the message to `error`, cut to `error_size` bytes with the terminating zero.
void write_error(const char* message, char* error, std::size_t error_size) noexcept;

/// The handle that `make` returns; null if it throws, with the message in `error`.
template <typename Make>
touchdown_estimator* handle_or_error(const Make& make, char* error,
                                     std::size_t error_size) noexcept {
  try {
    return make();
  } catch (const std::exception& caught) {
    write_error(caught.what(), error, error_size);
  } catch (...) {
    write_error("touchdown: failed", error, error_size);
  }
  return nullptr;
}

}  // namespace touchdown
