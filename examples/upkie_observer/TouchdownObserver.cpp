#include "TouchdownObserver.h"

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace upkie::cpp::observers {

namespace {

constexpr std::array<const char*, 6> joint_names = {"left_hip",  "left_knee",  "left_wheel",
                                                    "right_hip", "right_knee", "right_wheel"};

/// The dictionary at a key, or null.
const Dictionary* find(const Dictionary& dictionary, const char* key) {
  return dictionary.has(key) ? &dictionary(key) : nullptr;
}

/// Reads a value if the key exists; otherwise `value` stays unchanged.
template <typename T>
bool take(const Dictionary* dictionary, const char* key, T& value) {
  if (dictionary == nullptr || !dictionary->has(key)) return false;
  try {
    value = dictionary->get<T>(key);
    return true;
  } catch (const std::exception&) {
    return false;  // a value of another type counts as not reported
  }
}

void take_vector(const Dictionary* dictionary, const char* key, double* values) {
  Eigen::Vector3d vector;
  if (take(dictionary, key, vector)) std::copy(vector.begin(), vector.end(), values);
}

}  // namespace

void TouchdownObserver::Parameters::configure(const Dictionary& config) {
  const Dictionary* const section = find(config, "touchdown");
  take(section, "model", model);
  take(section, "robot", robot);
  take(section, "decides", decides);
}

TouchdownObserver::TouchdownObserver(const Parameters& params) : params_(params) { load(); }

TouchdownObserver::TouchdownObserver(const Parameters& params, Estimator estimator)
    : params_(params), estimator_(std::move(estimator)), loaded_(params.model) {}

void TouchdownObserver::load() {
  if (params_.model.empty()) return;
  std::array<char, 400> error{};
  const touchdown_use use = {nullptr, 1.0 / params_.dt,
                             params_.robot.empty() ? nullptr : params_.robot.c_str()};
  estimator_.reset(touchdown_create(params_.model.c_str(), &use, error.data(), error.size()));
  if (estimator_ == nullptr) {
    throw std::runtime_error("[TouchdownObserver] " + std::string(error.data()));
  }
  loaded_ = params_.model;
}

void TouchdownObserver::reset(const Dictionary& config) {
  params_.configure(config);
  belief_ = {};
  time_ = 0.0;
  if (params_.model != loaded_) {
    load();
  } else if (estimator_ != nullptr) {
    touchdown_reset(estimator_.get());
  }
  if (estimator_ == nullptr) {
    throw std::runtime_error("[TouchdownObserver] no model: expected touchdown.model");
  }
}

void TouchdownObserver::read(const Dictionary& observation) {
  if (estimator_ == nullptr) return;
  touchdown_record record = touchdown_empty_record();
  time_ += params_.dt;  // for observations without a time, as in some simulators
  record.time = time_;
  take(&observation, "time", record.time);
  const Dictionary* const servos = find(observation, "servo");
  for (std::size_t i = 0; servos != nullptr && i < joint_names.size(); ++i) {
    const Dictionary* const servo = find(*servos, joint_names[i]);
    take(servo, "position", record.joint[i].position);
    take(servo, "velocity", record.joint[i].velocity);
    take(servo, "torque", record.joint[i].torque);
  }
  const Dictionary* const imu = find(observation, "imu");
  Eigen::Quaterniond orientation;
  if (take(imu, "orientation", orientation)) {
    record.orientation[0] = orientation.w();
    const Eigen::Vector3d vector = orientation.vec();
    std::copy(vector.begin(), vector.end(), &record.orientation[1]);
  }
  take_vector(imu, "angular_velocity", record.angular_velocity);
  take_vector(imu, "linear_acceleration", record.linear_acceleration);
  take_vector(imu, "raw_linear_acceleration", record.proper_acceleration);
  belief_ = touchdown_update(estimator_.get(), &record);
}

void TouchdownObserver::write(Dictionary& observation) {
  if (estimator_ == nullptr) return;
  Dictionary& output = observation(prefix());
  const std::array<const char*, 2> wheels = {"left_wheel", "right_wheel"};
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (params_.decides) output(wheels[i])("contact") = belief_.contact[i] != 0;
    output(wheels[i])("p_contact") = belief_.p_contact[i];
  }
  if (params_.decides) output("contact") = belief_.contact[0] != 0 || belief_.contact[1] != 0;
  output("p_any_wheel") = belief_.p_any_wheel;
  output("p_both_wheels") = belief_.p_both_wheels;
  output("status") = std::string(touchdown_status_text(belief_.status));
  output("faults") = static_cast<unsigned>(belief_.faults);
}

std::string TouchdownObserver::model() const {
  return estimator_ == nullptr ? "" : touchdown_model_text(estimator_.get());
}

}  // namespace upkie::cpp::observers
