#include "estimator/decision/descent.hpp"

#include <numeric>

namespace touchdown {

namespace {

RowPlace place_of(const std::vector<RowPlace>& places, Eigen::Index row) {
  if (!places.empty()) return places[static_cast<std::size_t>(row)];
  return {static_cast<std::uint32_t>(row) & RowPlace::last_column, 0};
}

/// The numbers of a row: a column, or what the other wheel has for it.
template <typename Inputs>
Inputs inputs_at(const auto& columns, const std::vector<RowPlace>& places, Eigen::Index row) {
  const RowPlace place = place_of(places, row);
  Inputs inputs;
  std::copy_n(columns.col(static_cast<Eigen::Index>(place.column)).data(), inputs.size(),
              inputs.begin());
  return place.is_of_other_wheel != 0 ? of_other_wheel(inputs) : inputs;
}

template <typename Inputs>
std::vector<float> values_at(std::size_t input, const auto& columns,
                             const std::vector<RowPlace>& places, Eigen::Index count) {
  // Where the other wheel has this input in a column, and with which sign.
  Inputs numbers;
  std::iota(numbers.begin(), numbers.end(), 1.0F);
  const float number = of_other_wheel(numbers)[input];
  const auto others = static_cast<Eigen::Index>(std::abs(number)) - 1;
  std::vector<float> values(static_cast<std::size_t>(count));
  for (Eigen::Index row = 0; row < count; ++row) {
    const RowPlace place = place_of(places, row);
    const auto column = columns.col(static_cast<Eigen::Index>(place.column));
    values[static_cast<std::size_t>(row)] = place.is_of_other_wheel != 0
                                                ? (number < 0.0F ? -column[others] : column[others])
                                                : column[static_cast<Eigen::Index>(input)];
  }
  return values;
}

}  // namespace

DecisionInputs DecisionRows::inputs_of(Eigen::Index row) const {
  return inputs_at<DecisionInputs>(inputs, places, row);
}

ServoLoadInputs DecisionRows::servo_load_of(Eigen::Index row) const {
  return has_servo_load() ? inputs_at<ServoLoadInputs>(servo, places, row) : ServoLoadInputs{};
}

std::vector<float> DecisionRows::values_of(std::size_t input) const {
  return input < decision_inputs
             ? values_at<DecisionInputs>(input, inputs, places, count())
             : values_at<ServoLoadInputs>(input - decision_inputs, servo, places, count());
}

}  // namespace touchdown
