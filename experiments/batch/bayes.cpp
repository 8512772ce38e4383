#include "experiments/batch/bayes.hpp"

#include <utility>

#include "estimator/bayes/recursion.hpp"

namespace touchdown::experiments {
namespace {

LegSignals with_torques(const TorqueSample& torque) noexcept {
  LegSignals leg;
  leg.knee.torque = torque.knee;
  leg.wheel.torque = torque.wheel;
  return leg;
}

}  // namespace

BatchedMeasurement::BatchedMeasurement(MeasurementModel model, const BayesFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : model_(std::move(model), config.measurement),
      sigmas_(torque_sigmas(levels)),
      memory_(sigmas_.value.size(), TorqueMemory(config.measurement, config.sample_rate)),
      torque_(sigmas_.value.size()) {
  check_members(config);
  likelihoods_.fill(std::vector<Likelihoods>(levels.size()));
  p_contact_.fill(std::vector(levels.size(), 0.5));
}

void BatchedMeasurement::update(const Signals& clean, const NoiseStep& draws) noexcept {
  for (std::size_t i = 0; i < sigmas_.value.size(); ++i) {
    std::array<double, 2> knee{};
    std::array<double, 2> wheel{};
    for (std::size_t side = 0; side < 2; ++side) {
      const TorqueSample noisy =
          noisy_torque(clean.leg[side], draws.torque[side], sigmas_.value[i]);
      knee[side] = noisy.knee;
      wheel[side] = noisy.wheel;
      torque_[i][side] = memory_[i].leg[side].update(with_torques(noisy));  // Eq. (4)
    }
    memory_[i].noise.update(knee, wheel);
  }
  for (std::size_t i = 0; i < likelihoods_[0].size(); ++i) {
    const std::size_t knee = sigmas_.index[2 * i];
    const std::size_t wheel = sigmas_.index[2 * i + 1];
    const MeasurementModel& model = model_.at(memory_[knee].noise.level(memory_[wheel].noise));
    for (std::size_t side = 0; side < 2; ++side) {
      const TorqueSample m = {torque_[knee][side].knee, torque_[wheel][side].wheel};
      likelihoods_[side][i] = model_.likelihoods(model, m);                  // Eq. (5) and (6)
      p_contact_[side][i] = measurement_probability(likelihoods_[side][i]);  // Eq. (14)
    }
  }
}

BatchedBayesFilter::BatchedBayesFilter(MeasurementModel model, const BayesFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : torque_(torque_levels(levels)),
      acceleration_(acceleration_levels(levels)),
      measurement_(std::move(model), config, torque_.value),
      transition_(acceleration_.value.size(),
                  TransitionModel(config.transition, config.sample_rate)) {
  for (auto* belief : {&contact_, &no_contact_}) belief->fill(std::vector(levels.size(), 0.5));
}

void BatchedBayesFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  for (std::size_t i = 0; i < transition_.size(); ++i) {  // Eq. (7) to (13)
    transition_[i].update(clean.vertical_acceleration +
                          acceleration_.value[i] * draws.acceleration);
  }
  measurement_.update(clean, draws);  // Eq. (4) to (6)
  for (std::size_t side = 0; side < 2; ++side) {
    const std::span<const Likelihoods> likelihoods =
        measurement_.likelihoods(static_cast<Side>(side));
    double* const contact = contact_[side].data();
    double* const no_contact = no_contact_[side].data();
    for (std::size_t i = 0; i < contact_[side].size(); ++i) {
      const Transition& transition = transition_[acceleration_.index[i]].transition();
      const ContactState before{contact[i], no_contact[i]};
      const ContactState predicted = predict(transition, before);  // Eq. (2a)
      const ContactState after =
          correct(likelihoods[torque_.index[i]], predicted, before);  // Eq. (2b) and (3)
      contact[i] = after.contact;
      no_contact[i] = after.no_contact;
    }
  }
}

}  // namespace touchdown::experiments
