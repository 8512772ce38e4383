#include "core/error.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// The network's weights.
TOUCHDOWN_FUZZ(neural_network) {
  const fuzz::MemoryFile file(fuzz::archive_of(
      input, {"period", "input_mean", "input_scale", "gru_input_weight", "gru_input_bias",
              "gru_hidden_weight", "gru_hidden_bias", "first_weight", "first_bias", "second_weight",
              "second_bias", "heads_weight", "heads_bias"}));
  try {
    (void)load_model(file.path());
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
