// The only function of estimator/c_interface/touchdown.h that reads a file.

#include "estimator/c_interface/handle.hpp"
#include "onboard/model_needs.hpp"

touchdown_estimator* touchdown_create(const char* model_path, const touchdown_use* use, char* error,
                                      size_t error_size) {
  return touchdown::handle_or_error(
      [&] {
        if (model_path == nullptr) {
          throw touchdown::InputError("touchdown_create: the model's path is missing");
        }
        return touchdown::made_of_npz(model_path, touchdown::model_needs(model_path),
                                      [&](const touchdown::ModelArrays& arrays) {
                                        return touchdown::new_handle(arrays,
                                                                     touchdown::use_of(use));
                                      });
      },
      error, error_size);
}
