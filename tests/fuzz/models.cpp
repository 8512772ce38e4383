#include <string>

#include "core/error.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "models/mjcf/document.hpp"
#include "models/mjcf/parts.hpp"
#include "models/mjcf/robot_file.hpp"
#include "models/robot_description.hpp"
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

namespace {

constexpr std::string_view own_part_names = R"(mjcf: robot.xml
joints: {left_hip: lh, left_knee: lk, left_wheel: lw, right_hip: rh, right_knee: rk, right_wheel: rw}
held: [arm]
tyres: {left: lt, right: rim}
imu: chip
)";

models::PartNames own_parts() {
  models::PartNames parts;
  parts.joint = {"lh", "lk", "lw", "rh", "rk", "rw"};
  parts.held = {"arm"};
  parts.tyre = {"lt", "rim"};
  parts.imu = "chip";
  return parts;
}

}  // namespace

/// A robot's MJCF, with its own names or those of the contract, up to its compilation by MuJoCo.
TOUCHDOWN_FUZZ(mjcf) {
  static const MemoryFile keys(own_part_names);
  const MemoryFile file(input);
  for (const models::PartNames& parts : {models::PartNames(), own_parts()}) {
    try {
      models::MjcfDocument document = models::MjcfDocument::load(file.path());
      models::FileFindings findings;
      models::keep_robot_only(document, findings);
      models::translate_later_versions(document, findings);
      models::drop_missing_assets(document, findings);
      models::name_parts(document, parts, findings, models::RobotKeys(keys.path()));
      models::swap_sides(document);
      (void)document.text("<option/>\n").place_of_name("left_hip");
    } catch (const Error& error) {
      expected(error, input);
    }
  }
}

}  // namespace touchdown::fuzz
