#include "estimator/decision/network.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// One rectified layer.
template <std::size_t inputs, std::size_t outputs>
std::array<float, outputs> rectified(const std::array<float, inputs * outputs>& weight,
                                     const std::array<float, outputs>& bias,
                                     const std::array<float, inputs>& x) noexcept {
  constexpr auto rows = static_cast<int>(outputs);
  constexpr auto columns = static_cast<int>(inputs);
  std::array<float, outputs> values = bias;
  Eigen::Map<Eigen::Matrix<float, rows, 1>> sums(values.data());
  sums.noalias() += Eigen::Map<const Eigen::Matrix<float, rows, columns>>(weight.data()) *
                    Eigen::Map<const Eigen::Matrix<float, columns, 1>>(x.data());
  sums = sums.cwiseMax(0.0F);
  return values;
}

template <typename Numbers>
bool is_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

float decision_logit(const DecisionModel& model, const DecisionInputs& inputs) noexcept {
  const auto first = rectified(model.first_weight, model.first_bias, inputs);
  const auto second = rectified(model.second_weight, model.second_bias, first);
  float logit = model.last_bias;
  for (std::size_t k = 0; k < second.size(); ++k) logit += model.last_weight[k] * second[k];
  return logit;
}

void check_decision_model(const DecisionModel& model) {
  if (is_finite(model.first_weight) && is_finite(model.first_bias) &&
      is_finite(model.second_weight) && is_finite(model.second_bias) &&
      is_finite(model.last_weight) && std::isfinite(model.last_bias)) {
    return;
  }
  throw InputError("decision network: its weights must be finite");
}

}  // namespace touchdown
