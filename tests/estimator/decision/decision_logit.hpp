#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "estimator/decision/network.hpp"

namespace touchdown::test {

/// ln P(contact) / P(no contact) of one wheel, layer by layer.
inline float decision_logit(const DecisionModel& model, const DecisionInputs& inputs,
                            const ServoLoadInputs& servo = {}) {
  const auto products = [](const auto& weights, const auto& x, Eigen::Index outputs) {
    Eigen::VectorXf sums = Eigen::VectorXf::Zero(outputs);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const auto unit = static_cast<Eigen::Index>(i) % outputs;
      sums[unit] += weights[i] * x.begin()[static_cast<Eigen::Index>(i) / outputs];
    }
    return sums;
  };
  const auto bias = [](const auto& numbers) {
    return Eigen::Map<const Eigen::VectorXf>(numbers.data(),
                                             static_cast<Eigen::Index>(numbers.size()));
  };
  Eigen::VectorXf first = bias(model.first_bias);
  first += products(model.first_weight, inputs, first.size());
  first += products(model.servo_weight, servo, first.size());
  first = first.cwiseMax(0.0F).eval();
  Eigen::VectorXf second = bias(model.second_bias);
  second += products(model.second_weight, first, second.size());
  second = second.cwiseMax(0.0F).eval();
  return model.last_bias + bias(model.last_weight).dot(second);
}

}  // namespace touchdown::test
