#include "core/error.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// A measurement model.
TOUCHDOWN_FUZZ(measurement_model) {
  const fuzz::MemoryFile file(fuzz::archive_of(
      input, {"knee_torque", "wheel_torque", "contact_likelihood", "no_contact_likelihood"}));
  try {
    const MeasurementModel model = *load_model(file.path()).grid;
    (void)model({0.5, 1e308});
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
