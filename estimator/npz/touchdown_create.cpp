// The functions of estimator/touchdown.h that read a file.

#include <string>

#include "estimator/c_handle.hpp"
#include "estimator/npz/load_estimator.hpp"

touchdown_estimator* touchdown_create(const char* model_path, const touchdown_use* use, char* error,
                                      size_t error_size) {
  return touchdown::handle_or_error(
      [&] {
        if (model_path == nullptr) {
          constexpr double usual_rate = 1000.0;  // Hz; the filter serves others, too
          return touchdown::new_handle(touchdown::load_filter_model({}, usual_rate, "upkie"),
                                       touchdown::use_of(use));
        }
        const touchdown::Model model = touchdown::load_model(model_path);
        try {
          return touchdown::new_handle(model, touchdown::use_of(use));
        } catch (const touchdown::InputError& caught) {
          throw touchdown::InputError(std::string(model_path) + ": " + caught.what());
        }
      },
      error, error_size);
}

int touchdown_load_closed_legs(touchdown_estimator* estimator, const char* path, char* error,
                               size_t error_size) {
  const auto load = [&] {
    if (estimator == nullptr || path == nullptr) {
      throw touchdown::InputError("touchdown_load_closed_legs: expected an estimator and a path");
    }
    touchdown::AssemblyConfig config = estimator->assembler.config();
    config.closed_legs = touchdown::load_closed_legs(path);
    estimator->assembler = touchdown::SignalAssembler(config);
    estimator->estimator->reset();
    return estimator;
  };
  return touchdown::handle_or_error(load, error, error_size) == nullptr ? 0 : 1;
}
