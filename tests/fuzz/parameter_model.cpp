#include "recordings/models/parameter_model.hpp"

#include "core/error.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// A model of parameters.
TOUCHDOWN_FUZZ(parameter_model) {
  const fuzz::MemoryFile file(
      fuzz::archive_of(input, {"estimator", "provenance", "slope", "force_mean"}));
  try {
    const recordings::Parameters parameters =
        recordings::read_parameter_model(file.path()).parameters;
    (void)recordings::parameter(parameters, "slope");
    (void)recordings::parameter(parameters, "force_mean", 2);
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
