// A compiled-in model, for a cross-compiled spine: without libzip, and without a file to copy. This
// file is C++20, as the library; the observer and the spine use C only. `touchdown convert
// models/upkie.xml -o model.hpp` writes the header.

#include "compiled_model.h"

#include <touchdown/estimator.hpp>
#include <touchdown/estimator/c_handle.hpp>

#include "model.hpp"

touchdown_estimator* compiled_model(const touchdown_use* use, char* error, size_t error_size) {
  return touchdown::handle_or_error(
      [&] {
        return touchdown::new_handle(touchdown::arrays_of(touchdown::compiled::model),
                                     touchdown::use_of(use));
      },
      error, error_size);
}
