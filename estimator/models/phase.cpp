#include <algorithm>

#include "core/error.hpp"
#include "estimator/models/model.hpp"

namespace touchdown {

namespace {

std::string numbered(const char* what, std::size_t i) {
  return std::string(what) + "_" + std::to_string(i) + "_";
}

ModelArray ends(const Axis& axis) {
  return {{3}, {axis.lower, axis.upper, static_cast<double>(axis.count)}};
}

ModelArray table(const std::vector<float>& values, std::size_t columns) {
  return {{values.size() / columns, columns}, {values.begin(), values.end()}};
}

/// Reads arrays of a model. Errors: `InputError` that names a missing array or one of a wrong size.
class PhaseArrays {
 public:
  explicit PhaseArrays(const ModelArrays& arrays) : arrays_(arrays) {}

  bool has(const std::string& name) const { return arrays_.contains(name); }

  const std::vector<double>& take(const std::string& name) const {
    require_arrays(arrays_, "phase model", {name});
    return arrays_.at(name).data;
  }

  const std::vector<double>& take(const std::string& name, std::size_t size) const {
    const std::vector<double>& data = take(name);
    if (data.size() != size) {
      throw InputError(name + ": expected " + std::to_string(size) + " values, found " +
                       std::to_string(data.size()));
    }
    return data;
  }

  Axis axis(const std::string& name) const {
    const std::vector<double>& data = take(name, 3);
    constexpr double most = 1e8;
    if (!(data[2] >= 2.0 && data[2] <= most)) {
      throw InputError(name + ": expected 2 points or more");
    }
    return {data[0], data[1], static_cast<int>(data[2])};
  }

  std::vector<float> floats(const std::string& name) const {
    const std::vector<double>& data = take(name);
    return {data.begin(), data.end()};
  }

 private:
  const ModelArrays& arrays_;
};

}  // namespace

ModelArrays arrays_of(const PhaseModel& model) {
  ModelArrays arrays;
  arrays["sample_rate"] = {{1}, {model.sample_rate}};
  arrays["seconds"] = {{phase_count}, {model.seconds.begin(), model.seconds.end()}};
  ModelArray transition{{phase_count, phase_count}, {}};
  for (const auto& row : model.transition) {
    transition.data.insert(transition.data.end(), row.begin(), row.end());
  }
  arrays["transition"] = transition;
  for (std::size_t i = 0; i < model.torque.size(); ++i) {
    const PhaseTorqueDensity& density = model.torque[i];
    const std::string name = numbered("torque", i);
    arrays[name + "noise"] = {
        {4},
        {density.noise.knee, density.noise.wheel, density.bandwidth.knee, density.bandwidth.wheel}};
    arrays[name + "knee"] = ends(density.knee);
    arrays[name + "wheel"] = ends(density.wheel);
    arrays[name + "log_density"] = table(density.log_density, torque_density_count);
  }
  for (std::size_t i = 0; i < model.acceleration.size(); ++i) {
    const PhaseAccelerationDensity& density = model.acceleration[i];
    const std::string name = numbered("acceleration", i);
    arrays[name + "noise"] = {{2}, {density.noise, density.bandwidth}};
    arrays[name + "axis"] = ends(density.axis);
    arrays[name + "log_density"] = table(density.log_density, acceleration_density_count);
  }
  return arrays;
}

PhaseModel phase_model_of(const ModelArrays& arrays) {
  const PhaseArrays reader(arrays);
  PhaseModel model;
  model.sample_rate = reader.take("sample_rate", 1)[0];
  const std::vector<double>& seconds = reader.take("seconds", phase_count);
  std::copy(seconds.begin(), seconds.end(), model.seconds.begin());
  const std::vector<double>& transition = reader.take("transition", phase_count * phase_count);
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      model.transition[i][j] = transition[i * phase_count + j];
    }
  }
  for (std::size_t i = 0; reader.has(numbered("torque", i) + "noise"); ++i) {
    const std::string name = numbered("torque", i);
    const std::vector<double>& noise = reader.take(name + "noise", 4);
    model.torque.push_back({{noise[0], noise[1]},
                            {noise[2], noise[3]},
                            reader.axis(name + "knee"),
                            reader.axis(name + "wheel"),
                            reader.floats(name + "log_density")});
  }
  for (std::size_t i = 0; reader.has(numbered("acceleration", i) + "noise"); ++i) {
    const std::string name = numbered("acceleration", i);
    const std::vector<double>& noise = reader.take(name + "noise", 2);
    model.acceleration.push_back(
        {noise[0], noise[1], reader.axis(name + "axis"), reader.floats(name + "log_density")});
  }
  check_phase_model(model);
  return model;
}

}  // namespace touchdown
