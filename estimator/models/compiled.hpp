#pragma once

#include <memory>
#include <span>

#include "estimator/models/make_estimator.hpp"

namespace touchdown {

/// One array of a model that is compiled into a program; `touchdown export model.npz -o model.hpp`
/// writes them. Exactly one of the last three members is set.
struct CompiledArray {
  const char* name;
  std::size_t rows;
  std::size_t columns;  ///< 0: the array has one axis
  const double* doubles;
  const float* floats;  ///< where single precision holds all bits
  const char* text;     ///< of `rows` bytes
};

/// The arrays as they were in the file.
ModelArrays arrays_of(std::span<const CompiledArray> model);

/// Makes the estimator of a compiled model. Its beliefs are to the bit those of the model's file.
/// Errors: as `make_estimator` of arrays.
std::unique_ptr<ContactEstimator> make_estimator(std::span<const CompiledArray> model,
                                                 const ModelUse& use = {});

}  // namespace touchdown
