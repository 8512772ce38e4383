#include "core/error.hpp"
#include "estimator/models/parameters.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "tests/fuzz/archive.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

namespace {

/// The arrays of each kind of model, by the first byte of the input.
const std::vector<std::vector<std::string>>& names_of_arrays() {
  static const std::vector<std::vector<std::string>> names = {
      {"knee_torque", "wheel_torque", "contact_likelihood", "no_contact_likelihood"},
      {"period", "input_mean", "input_scale", "gru_input_weight", "gru_input_bias",
       "gru_hidden_weight", "gru_hidden_bias", "first_weight", "first_bias", "second_weight",
       "second_bias", "heads_weight", "heads_bias"},
      {"estimator", "provenance", "slope", "force_mean"},
      {"sample_rate", "seconds", "transition", "provenance", "torque_0_noise", "torque_0_knee",
       "torque_0_wheel", "torque_0_log_density", "torque_1_noise", "torque_1_knee",
       "torque_1_wheel", "torque_1_log_density", "acceleration_0_noise", "acceleration_0_axis",
       "acceleration_0_log_density", "acceleration_1_noise"}};
  return names;
}

}  // namespace

/// A model: densities of torques, the network's weights, parameters, or a phase model.
TOUCHDOWN_FUZZ(models) {
  if (input.empty()) return;
  const auto& kinds = names_of_arrays();
  const std::size_t kind = static_cast<unsigned char>(input.front()) % kinds.size();
  const MemoryFile file(archive_of(input.substr(1), kinds[kind]));
  try {
    const Model model = load_model(file.path());
    if (model.grid) (void)(*model.grid)({0.5, 1e308});
    if (kind != 2) return;
    const Parameters parameters = parameters_of(model.arrays);
    (void)parameter(parameters, "slope");
    (void)parameter(parameters, "force_mean", 2);
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
