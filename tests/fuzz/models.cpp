#include <string>

#include "core/error.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "models/robot_source.hpp"
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
      {"estimator", "provenance", "values", "metadata"}};
  return names;
}

}  // namespace

/// A model: densities of torques, the network's weights, or an estimator's name and metadata.
TOUCHDOWN_FUZZ(models) {
  if (input.empty()) return;
  const auto& kinds = names_of_arrays();
  const std::size_t kind = static_cast<unsigned char>(input.front()) % kinds.size();
  const MemoryFile file(archive_of(input.substr(1), kinds[kind]));
  const Model model = load_model(file.path());
  if (model.grid) (void)(*model.grid)({0.5, 1e308});
}

/// A robot's MJCF, up to its compilation by MuJoCo.
TOUCHDOWN_FUZZ(mjcf) {
  const MemoryFile file(input);
  try {
    models::RobotFile robot{models::MjcfDocument::load(file.path())};
    models::keep_robot_only(robot);
    models::complete_loops(robot, {}, models::RobotKeys(file.path()));
    models::translate_later_versions(robot);
    models::note_computed_masses(robot);
    models::drop_missing_assets(robot);
    models::PartNames parts;
    parts.tyre_radius = 0.1;
    models::add_spheres(robot.document, parts);
    (void)robot.document.edited("<option/>\n");
    (void)robot.document.place_in(1, "left_hip");
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
