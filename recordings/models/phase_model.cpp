#include "recordings/models/phase_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

NpyArray ends(const Axis& axis) {
  return {{3}, {axis.lower, axis.upper, static_cast<double>(axis.count)}};
}

NpyArray table(const std::vector<float>& values, std::size_t columns) {
  return {{values.size() / columns, columns}, {values.begin(), values.end()}};
}

/// Takes arrays out of a file, and says which one is missing or has the wrong size.
class Reader {
 public:
  explicit Reader(const NpzArrays& arrays) : arrays_(arrays) {}

  bool has(const std::string& name) const { return arrays_.contains(name); }

  const std::vector<double>& take(const std::string& name) const { return array(name).data; }

  const std::vector<double>& take(const std::string& name, std::size_t size) const {
    const std::vector<double>& data = take(name);
    if (data.size() != size) {
      throw InputError(fmt::format("{}: expected {} values, found {}", name, size, data.size()));
    }
    return data;
  }

  Axis axis(const std::string& name) const {
    const std::vector<double>& data = take(name, 3);
    constexpr double most = 1e8;
    if (!(data[2] >= 2.0 && data[2] <= most)) {
      throw InputError(fmt::format("{}: expected 2 points or more", name));
    }
    return {data[0], data[1], static_cast<int>(data[2])};
  }

  std::vector<float> floats(const std::string& name) const {
    const std::vector<double>& data = take(name);
    return {data.begin(), data.end()};
  }

  const NpyArray& array(const std::string& name) const {
    require_arrays(arrays_, "phase model", {name});
    return arrays_.at(name);
  }

 private:
  const NpzArrays& arrays_;
};

std::size_t most_values(std::string_view name) {
  constexpr std::size_t most_cells = std::size_t{1} << 25U;
  constexpr std::size_t most_text = std::size_t{1} << 20U;
  constexpr std::size_t most_else = 1000;
  if (name == "provenance") return most_text;
  if (name == "sample_rate" || name == "seconds" || name == "transition") return most_else;
  if (!name.starts_with("torque_") && !name.starts_with("acceleration_")) return 0;
  return name.ends_with("_log_density") ? most_cells : most_else;
}

PhaseModelFile file_from(const Reader& reader) {
  PhaseModelFile file;
  PhaseModel& model = file.model;
  model.sample_rate = reader.take("sample_rate", 1)[0];
  const std::vector<double>& seconds = reader.take("seconds", phase_count);
  std::copy(seconds.begin(), seconds.end(), model.seconds.begin());
  const std::vector<double>& transition = reader.take("transition", phase_count * phase_count);
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      model.transition[i][j] = transition[i * phase_count + j];
    }
  }
  for (int i = 0; reader.has(fmt::format("torque_{}_noise", i)); ++i) {
    const std::string name = fmt::format("torque_{}_", i);
    const std::vector<double>& noise = reader.take(name + "noise", 4);
    model.torque.push_back({{noise[0], noise[1]},
                            {noise[2], noise[3]},
                            reader.axis(name + "knee"),
                            reader.axis(name + "wheel"),
                            reader.floats(name + "log_density")});
  }
  for (int i = 0; reader.has(fmt::format("acceleration_{}_noise", i)); ++i) {
    const std::string name = fmt::format("acceleration_{}_", i);
    const std::vector<double>& noise = reader.take(name + "noise", 2);
    model.acceleration.push_back(
        {noise[0], noise[1], reader.axis(name + "axis"), reader.floats(name + "log_density")});
  }
  if (reader.has("provenance")) file.provenance = provenance_from(reader.array("provenance"));
  check_phase_model(model);
  return file;
}

}  // namespace

void write_phase_model(const PhaseModelFile& file, const std::filesystem::path& path) {
  const PhaseModel& model = file.model;
  NpzArrays arrays;
  arrays["sample_rate"] = {{1}, {model.sample_rate}};
  arrays["seconds"] = {{phase_count}, {model.seconds.begin(), model.seconds.end()}};
  NpyArray transition{{phase_count, phase_count}, {}};
  for (const auto& row : model.transition) {
    transition.data.insert(transition.data.end(), row.begin(), row.end());
  }
  arrays["transition"] = transition;
  for (std::size_t i = 0; i < model.torque.size(); ++i) {
    const PhaseTorqueDensity& density = model.torque[i];
    const std::string name = fmt::format("torque_{}_", i);
    arrays[name + "noise"] = {
        {4},
        {density.noise.knee, density.noise.wheel, density.bandwidth.knee, density.bandwidth.wheel}};
    arrays[name + "knee"] = ends(density.knee);
    arrays[name + "wheel"] = ends(density.wheel);
    arrays[name + "log_density"] = table(density.log_density, torque_density_count);
  }
  for (std::size_t i = 0; i < model.acceleration.size(); ++i) {
    const PhaseAccelerationDensity& density = model.acceleration[i];
    const std::string name = fmt::format("acceleration_{}_", i);
    arrays[name + "noise"] = {{2}, {density.noise, density.bandwidth}};
    arrays[name + "axis"] = ends(density.axis);
    arrays[name + "log_density"] = table(density.log_density, acceleration_density_count);
  }
  arrays["provenance"] = array_of(file.provenance);
  write_npz(arrays, path);
}

PhaseModelFile read_phase_model(const std::filesystem::path& path) {
  return made_of_npz(path, most_values,
                     [](const NpzArrays& arrays) { return file_from(Reader(arrays)); });
}

}  // namespace touchdown::recordings
