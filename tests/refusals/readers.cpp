#include "tests/refusals/readers.hpp"

#include <functional>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "estimator/npz/npz.hpp"
#include "estimator/touchdown.h"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/request.hpp"
#include "logs/log/beliefs.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/mapping/conversion.hpp"
#include "logs/model_file.hpp"
#include "models/profile.hpp"
#include "models/robot_draft.hpp"
#include "models/robot_model.hpp"
#include "models/terrain.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/estimator/models/models.hpp"
#include "tests/models/parallel_robot.hpp"
#include "tests/models/upkie.hpp"
#include "tests/models/urdf_biped.hpp"

namespace touchdown::refusals {
namespace {

namespace fs = std::filesystem;

/// KEY=NUMBER.
std::pair<std::string, double> assignment_in(const fs::path& file) {
  const std::string text = read_file(file);
  const std::size_t at = text.find('=');
  return {text.substr(0, at), std::stod(text.substr(at + 1))};
}

experiments::Experiment experiment_of(const fs::path& file) {
  return experiments::experiment_from_yaml(YamlDocument::load(file));
}

void read_log(const fs::path& file) {
  std::ostringstream stream;
  (void)logs::convert_log(file, file.parent_path() / "map.yaml", stream, {.with_labels = true});
}

/// A NumPy array of one line, its header, and as many bytes of data as the second line says.
void read_npy(const fs::path& file) {
  const std::string text = read_file(file);
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) {
    (void)from_npy(text, file.filename());
    return;
  }
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(end);
  bytes += '\0';
  bytes += text.substr(0, end);
  (void)from_npy(bytes + std::string(std::stoul(text.substr(end + 1)), '\0'), file.filename());
}

/// Writes arrays that are given as YAML, NAME: none | a list | {shape: …, all: number, INDEX:
/// number}, and returns their .npz file. `fitted` names the estimator whose fit they change.
fs::path npz_of(const fs::path& file) {
  const YAML::Node keys = YAML::LoadFile(file.string());
  ModelArrays arrays;
  if (keys["fitted"]) arrays = test::fitted_arrays(keys["fitted"].Scalar());
  for (const auto& entry : keys) {
    const std::string name = entry.first.Scalar();
    if (name == "fitted") continue;
    ModelArray& array = arrays[name];
    if (entry.second.IsScalar()) arrays.erase(name);
    if (entry.second.IsSequence()) {
      array.data = entry.second.as<std::vector<double>>();
      array.shape = {array.data.size()};
    }
    if (!entry.second.IsMap()) continue;
    for (const auto& change : entry.second) {
      const std::string key = change.first.Scalar();
      if (key == "shape") {
        array.shape = change.second.as<std::vector<std::size_t>>();
        array.data.resize(std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1},
                                          std::multiplies<>()));
      } else if (key == "all") {
        array.data.assign(array.data.size(), change.second.as<double>());
      } else {
        array.data.at(change.first.as<std::size_t>()) = change.second.as<double>();
      }
    }
  }
  fs::path npz = fs::path(file).replace_extension(".npz");
  logs::write_npz(arrays, npz);
  return npz;
}

using Message = std::array<char, 300>;

/// KEY: NUMBER for the sample rate or a convention, of the C interface.
void set_by_c_interface(const fs::path& file) {
  const fs::path model = file.parent_path() / "m.npz";
  logs::write_npz(test::fitted_model("nmn"), model);
  const YAML::Node keys = YAML::LoadFile(file.string());
  const touchdown_use use = {nullptr, keys["rate"].as<double>(1000.0), nullptr};
  Message message{};
  const std::string path = keys["model"] ? keys["model"].Scalar() : model.string();
  touchdown_estimator* const estimator =
      touchdown_create(path.c_str(), &use, message.data(), message.size());
  if (estimator == nullptr) throw InputError(message.data());
  touchdown_conventions conventions = touchdown_upkie_conventions();
  const std::map<std::string, double*> numbers = {
      {"imu_axes[0][0]", &conventions.imu_axes[0][0]},
      {"imu_axes[2][2]", &conventions.imu_axes[2][2]},
      {"torque_unit", &conventions.torque_unit},
      {"joint[5].sign", &conventions.joint[5].sign},
      {"joint[1].torque_scale", &conventions.joint[1].torque_scale}};
  for (const auto& [name, number] : numbers) {
    if (keys[name]) *number = keys[name].as<double>();
  }
  const int is_set =
      touchdown_set_conventions(estimator, &conventions, message.data(), message.size());
  touchdown_destroy(estimator);
  if (is_set == 0) throw InputError(message.data());
}

}  // namespace

Names names_of_tables() {
  constexpr bool with_columns = true;
  using File = const fs::path&;
  Names names;
  names.readers = {
      {"robot",
       {[](File f) { (void)models::compile_robot_model(f, models::Terrain{}); }, with_columns}},
      {"draft of a robot", {[](File f) { (void)models::drafted_robot(f); }}},
      {"terrain", {[](File f) {
         (void)models::Profile(from_yaml<models::Terrain>(YamlDocument::load(f))).edges();
       }}},
      {"scenario",
       {[](File f) { (void)scenarios::scenario_from_yaml(YamlDocument::load(f)); }, with_columns}},
      {"scenario of a robot", {[](File f) { (void)scenarios::find_scenario(f.string()); }}},
      {"varied scenario", {[](File f) {
         const auto [key, value] = assignment_in(f);
         (void)scenarios::varied(scenarios::find_scenario("scenarios/stairs.yaml"), key, value,
                                 "stairs.yaml");
       }}},
      {"drawn scenario", {[](File f) { (void)scenarios::generate_named(read_file(f)); }}},
      {"family of scenarios",
       {[](File f) { (void)scenarios::generate({.families = {read_file(f)}}); }}},
      {"experiment", {[](File f) { (void)experiment_of(f); }, with_columns}},
      {"files of an experiment",
       {[](File f) {
          (void)experiment_of(f);
          experiments::require_files(YamlDocument::load(f));
        },
        with_columns}},
      {"plan of an experiment",
       {[](File f) { (void)experiments::whole_plan(experiments::request_of(experiment_of(f))); }}},
      {"profile",
       {[](File f) { (void)from_yaml<noise::SensorProfile>(YamlDocument::load(f)); },
        with_columns}},
      {"name of a profile", {[](File f) { (void)noise::find_sensor_profile(read_file(f)); }}},
      {"varied profile", {[](File f) {
         const auto [key, value] = assignment_in(f);
         (void)noise::with_value({}, key, value);
       }}},
      {"log", {read_log}},
      {"log of arrays", {[](File f) { read_log(npz_of(f)); }}},
      {"beliefs", {[](File f) { (void)logs::read_beliefs(f); }}},
      {"beliefs of arrays", {[](File f) { (void)logs::read_beliefs(npz_of(f)); }}},
      {"labels", {[](File f) { (void)logs::read_contact_intervals(f); }}},
      {"npy", {read_npy}},
      {"npz", {[](File f) { (void)read_npz(f); }}},
      {"model", {[](File f) { (void)load_model(npz_of(f)); }}},
      {"C interface", {set_by_c_interface}}};
  names.texts = {{"upkie with hip rolls", [] { return rolling_upkie(); }},
                 {"parallelogram", models::parallel_robot},
                 {"urdf biped", [] { return models::urdf_biped(); }}};
  return names;
}

}  // namespace touchdown::refusals
