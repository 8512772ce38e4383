#include "core/error.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// A model of parameters.
TOUCHDOWN_FUZZ(parameter_model) {
  const fuzz::MemoryFile file(
      fuzz::archive_of(input, {"estimator", "provenance", "slope", "force_mean"}));
  try {
    const Parameters parameters = parameters_of(load_model(file.path()).arrays);
    (void)parameter(parameters, "slope");
    (void)parameter(parameters, "force_mean", 2);
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
