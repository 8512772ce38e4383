#include "estimator/decision/training.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimator/decision/draws.hpp"

namespace touchdown {

namespace {

constexpr int input_count = static_cast<int>(decision_inputs);
constexpr int first_count = static_cast<int>(decision_first);
constexpr int second_count = static_cast<int>(decision_second);

// A model's weights as a matrix, outputs × inputs, in the order in which they are stored.
template <typename Model>
auto weights_of_first(Model& model) {
  using Matrix = Eigen::Matrix<float, first_count, input_count>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Model>, const Matrix, Matrix>>(
      model.first_weight.data());
}
template <typename Model>
auto weights_of_second(Model& model) {
  using Matrix = Eigen::Matrix<float, second_count, first_count>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Model>, const Matrix, Matrix>>(
      model.second_weight.data());
}
template <typename Model>
auto weights_of_servo(Model& model) {
  using Matrix =
      Eigen::Matrix<float, first_count, static_cast<int>(std::tuple_size_v<ServoLoadInputs>)>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Model>, const Matrix, Matrix>>(
      model.servo_weight.data());
}
template <std::size_t size>
Eigen::Map<const Eigen::Matrix<float, static_cast<int>(size), 1>> column(
    const std::array<float, size>& values) {
  return Eigen::Map<const Eigen::Matrix<float, static_cast<int>(size), 1>>(values.data());
}
template <std::size_t size>
Eigen::Map<Eigen::Matrix<float, static_cast<int>(size), 1>> column(
    std::array<float, size>& values) {
  return Eigen::Map<Eigen::Matrix<float, static_cast<int>(size), 1>>(values.data());
}

/// Calls `part` with the same parameters of all models, part by part.
template <typename Part, typename... Models>
void for_each_part(const Part& part, Models&... models) {
  part(std::span(models.first_weight)...);
  part(std::span(models.first_bias)...);
  part(std::span(models.second_weight)...);
  part(std::span(models.second_bias)...);
  part(std::span(models.last_weight)...);
  part(std::span(&models.last_bias, 1)...);
  part(std::span(models.servo_weight)...);
}

/// He's rule: the outputs of a rectified layer keep the size of its inputs.
DecisionModel drawn(Draws& draws, bool has_servo_load) {
  DecisionModel model;
  const auto fill = [&](auto& weights, int fan_in) {
    for (float& weight : weights) {
      weight = static_cast<float>(std::sqrt(2.0 / fan_in) * draws.normal());
    }
  };
  fill(model.first_weight, input_count);
  fill(model.second_weight, first_count);
  fill(model.last_weight, second_count);
  if (has_servo_load) {
    model.servo_weight.resize(servo_weights);
    fill(model.servo_weight, input_count);
  }
  return model;
}

}  // namespace

double decision_loss(const DecisionModel& model, const DecisionRows& rows,
                     DecisionModel* gradient) {
  using Values = Eigen::MatrixXf;
  Values h1 = (weights_of_first(model) * rows.inputs).colwise() + column(model.first_bias);
  if (rows.has_servo_load()) h1 += weights_of_servo(model) * rows.servo;
  h1 = h1.cwiseMax(0.0F);
  const Values h2 =
      ((weights_of_second(model) * h1).colwise() + column(model.second_bias)).cwiseMax(0.0F);
  const Eigen::RowVectorXf logit =
      (column(model.last_weight).transpose() * h2).array() + model.last_bias;
  const float all = rows.weight.sum();
  // log(1 + e^z) − y z, for any z.
  const Eigen::RowVectorXf tail = (-logit.array().abs()).exp();
  const float loss = ((logit.array().max(0.0F) + (tail.array() + 1.0F).log() -
                       rows.is_contact.array() * logit.array()) *
                      rows.weight.array())
                         .sum() /
                     all;
  if (gradient == nullptr) return loss;

  const Eigen::RowVectorXf p =
      (logit.array() >= 0.0F).select(1.0F, tail.array()) / (tail.array() + 1.0F);
  const Eigen::RowVectorXf to_logit = (p - rows.is_contact).cwiseProduct(rows.weight) / all;
  gradient->last_bias = to_logit.sum();
  column(gradient->last_weight) = h2 * to_logit.transpose();
  const Values to_second = (column(model.last_weight) * to_logit)
                               .cwiseProduct((h2.array() > 0.0F).cast<float>().matrix());
  column(gradient->second_bias) = to_second.rowwise().sum();
  weights_of_second(*gradient) = to_second * h1.transpose();
  const Values to_first = (weights_of_second(model).transpose() * to_second)
                              .cwiseProduct((h1.array() > 0.0F).cast<float>().matrix());
  column(gradient->first_bias) = to_first.rowwise().sum();
  weights_of_first(*gradient) = to_first * rows.inputs.transpose();
  if (rows.has_servo_load()) weights_of_servo(*gradient) = to_first * rows.servo.transpose();
  return loss;
}

DecisionModel train_decision_model(const DecisionRows& rows, const DecisionFitConfig& config,
                                   const std::function<void()>& before_step) {
  Draws draws(config.seed);
  DecisionModel model = drawn(draws, rows.has_servo_load());
  DecisionModel gradient;
  gradient.servo_weight.resize(model.servo_weight.size());
  DecisionModel mean = gradient;
  DecisionModel square = gradient;
  descend(rows, config, draws, before_step,
          [&](const DecisionRows& batch, const AdamStep& adam_step) {
            static_cast<void>(decision_loss(model, batch, &gradient));
            for_each_part(adam_step, model, gradient, mean, square);
          });
  return model;
}

}  // namespace touchdown
