#include "core/error.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// A phase model.
TOUCHDOWN_FUZZ(phase_model) {
  const fuzz::MemoryFile file(fuzz::archive_of(
      input, {"sample_rate", "seconds", "transition", "provenance", "torque_0_noise",
              "torque_0_knee", "torque_0_wheel", "torque_0_log_density", "torque_1_noise",
              "torque_1_knee", "torque_1_wheel", "torque_1_log_density", "acceleration_0_noise",
              "acceleration_0_axis", "acceleration_0_log_density", "acceleration_1_noise"}));
  try {
    (void)load_model(file.path());
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
