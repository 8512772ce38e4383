#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimator/decision/config.hpp"
#include "estimator/decision/draws.hpp"
#include "estimator/decision/network.hpp"

namespace touchdown {

/// The column that holds the inputs of a row: as they are, or those of the other wheel.
struct RowPlace {
  static constexpr std::uint32_t last_column = 0x7fffffff;

  std::uint32_t column : 31;
  std::uint32_t is_of_other_wheel : 1;
};

/// The rows that models on `FeatureExtractor` are fitted to. Each row has inputs, a label and a
/// weight.
struct DecisionRows {
  Eigen::Matrix<float, static_cast<int>(decision_inputs), Eigen::Dynamic> inputs;
  /// `ServoLoadInputs`, if the fit has them.
  Eigen::MatrixXf servo = {};
  /// The place of each row's inputs, so that both wheels share a column; empty: each row has its
  /// own.
  std::vector<RowPlace> places = {};
  Eigen::RowVectorXf is_contact;  ///< 1 or 0
  Eigen::RowVectorXf weight;

  [[nodiscard]] Eigen::Index count() const { return is_contact.size(); }
  [[nodiscard]] bool has_servo_load() const { return servo.rows() > 0; }
  [[nodiscard]] DecisionInputs inputs_of(Eigen::Index row) const;
  /// Zeros without the optional channel.
  [[nodiscard]] ServoLoadInputs servo_load_of(Eigen::Index row) const;
  /// One of the inputs, of all rows; those of the optional channel come last.
  [[nodiscard]] std::vector<float> values_of(std::size_t input) const;
};

/// One step of Adam (Kingma, Ba 2015) with decoupled weight decay. The learning rate falls to zero
/// along a cosine.
class AdamStep {
 public:
  AdamStep(std::size_t step, std::size_t steps, const DecisionFitConfig& config) {
    const double progress = static_cast<double>(step) / static_cast<double>(steps);
    const double rate = 0.5 * config.learning_rate * (1.0 + std::cos(std::numbers::pi * progress));
    const double n = static_cast<double>(step + 1);
    of_mean_ = static_cast<float>(rate / (1.0 - std::pow(keep_mean, n)));
    of_square_ = static_cast<float>(1.0 / (1.0 - std::pow(keep_square, n)));
    kept_ = static_cast<float>(1.0 - rate * config.decay);
  }

  /// Updates the weights `w` by the gradient `g`. `mean` and `square` hold the gradient's moments
  /// from step to step. All four have one size.
  void operator()(std::span<float> w, std::span<const float> g, std::span<float> mean,
                  std::span<float> square) const {
    constexpr float tiny = 1e-8F;
    for (std::size_t i = 0; i < w.size(); ++i) {
      mean[i] += static_cast<float>(1.0 - keep_mean) * (g[i] - mean[i]);
      square[i] += static_cast<float>(1.0 - keep_square) * (g[i] * g[i] - square[i]);
      w[i] = kept_ * w[i] - of_mean_ * mean[i] / (std::sqrt(of_square_ * square[i]) + tiny);
    }
  }

 private:
  static constexpr double keep_mean = 0.9;
  static constexpr double keep_square = 0.999;

  float of_mean_ = 0.0F;
  float of_square_ = 0.0F;
  float kept_ = 1.0F;
};

/// Calls `step(batch, adam)` for batches drawn with replacement, for the configured number of
/// epochs. `before_step` is called every 64 steps; an exception from it ends the descent.
template <typename Step>
void descend(const DecisionRows& rows, const DecisionFitConfig& config, Draws& draws,
             const std::function<void()>& before_step, const Step& step) {
  constexpr std::size_t between_calls = 64;
  DecisionRows batch;
  const auto count = static_cast<Eigen::Index>(config.batch);
  batch.inputs.resize(static_cast<int>(decision_inputs), count);
  batch.servo.resize(rows.servo.rows(), count);
  batch.is_contact.resize(count);
  batch.weight.resize(count);
  const auto all = static_cast<std::uint64_t>(rows.count());
  const std::size_t steps =
      (static_cast<std::size_t>(all) * config.epochs + config.batch - 1) / config.batch;
  for (std::size_t n = 0; n < steps; ++n) {
    if (before_step && n % between_calls == 0) before_step();
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(draws.below(all));
      const DecisionInputs inputs = rows.inputs_of(row);
      std::copy(inputs.begin(), inputs.end(), batch.inputs.col(i).data());
      if (rows.has_servo_load()) {
        const ServoLoadInputs servo = rows.servo_load_of(row);
        std::copy(servo.begin(), servo.end(), batch.servo.col(i).data());
      }
      batch.is_contact[i] = rows.is_contact[row];
      batch.weight[i] = rows.weight[row];
    }
    step(batch, AdamStep(n, steps, config));
  }
}

}  // namespace touchdown
