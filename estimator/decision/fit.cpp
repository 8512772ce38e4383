#include "estimator/decision/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "estimator/decision/augmentation.hpp"
#include "estimator/decision/draws.hpp"
#include "estimator/decision/feature_extractor.hpp"

namespace touchdown {

namespace {

constexpr int input_count = static_cast<int>(decision_inputs);
constexpr int first_count = static_cast<int>(decision_first);
constexpr int second_count = static_cast<int>(decision_second);
constexpr int servo_count = static_cast<int>(std::tuple_size_v<ServoLoadInputs>);

/// Weights as a matrix, outputs × inputs, in the order in which they are stored.
template <int outputs, int inputs = 1, typename Numbers>
auto matrix_of(Numbers& weights) {
  using Matrix = Eigen::Matrix<float, outputs, inputs>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Numbers>, const Matrix, Matrix>>(
      weights.data());
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

std::size_t steps_of(const LabelledRun& run) {
  return run.signals.size() - std::min(run.signals.size(), run.skip);
}

/// P(reset) per step of one pass.
double reset_probability(const DecisionFitConfig& fit, const Augmentation& augmentation,
                         double sample_rate, Draws& draws) {
  if (!(fit.share_with_resets > 0.0 && draws.uniform() < fit.share_with_resets)) return 0.0;
  const double after = fit.reset_after + fit.reset_after_noise * augmentation.torque_noise();
  return 1.0 / (after * sample_rate);
}

/// The weight of each class: no contact, contact.
std::array<double, 2> class_weights(const DecisionRows& rows, double exponent) {
  const double contact = rows.is_contact.cast<double>().sum();
  const double air = static_cast<double>(rows.is_contact.size()) - contact;
  if (!(contact > 0.0 && air > 0.0)) {
    throw InputError("decision: runs with contact and without are needed");
  }
  return {std::pow(air, exponent), std::pow(contact, exponent)};
}

}  // namespace

double decision_loss(const DecisionModel& model, const DecisionRows& rows,
                     DecisionModel* gradient) {
  using Values = Eigen::MatrixXf;
  Values h1 = (matrix_of<first_count, input_count>(model.first_weight) * rows.inputs).colwise() +
              matrix_of<first_count>(model.first_bias);
  if (rows.has_servo_load())
    h1 += matrix_of<first_count, servo_count>(model.servo_weight) * rows.servo;
  h1 = h1.cwiseMax(0.0F);
  const Values h2 = ((matrix_of<second_count, first_count>(model.second_weight) * h1).colwise() +
                     matrix_of<second_count>(model.second_bias))
                        .cwiseMax(0.0F);
  const Eigen::RowVectorXf logit =
      (matrix_of<second_count>(model.last_weight).transpose() * h2).array() + model.last_bias;
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
  matrix_of<second_count>(gradient->last_weight) = h2 * to_logit.transpose();
  const Values to_second = (matrix_of<second_count>(model.last_weight) * to_logit)
                               .cwiseProduct((h2.array() > 0.0F).cast<float>().matrix());
  matrix_of<second_count>(gradient->second_bias) = to_second.rowwise().sum();
  matrix_of<second_count, first_count>(gradient->second_weight) = to_second * h1.transpose();
  const Values to_first =
      (matrix_of<second_count, first_count>(model.second_weight).transpose() * to_second)
          .cwiseProduct((h1.array() > 0.0F).cast<float>().matrix());
  matrix_of<first_count>(gradient->first_bias) = to_first.rowwise().sum();
  matrix_of<first_count, input_count>(gradient->first_weight) = to_first * rows.inputs.transpose();
  if (rows.has_servo_load())
    matrix_of<first_count, servo_count>(gradient->servo_weight) = to_first * rows.servo.transpose();
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
            for_each_part([&](const char*, auto... numbers) { adam_step(numbers...); }, model,
                          gradient, mean, square);
          });
  return model;
}

DecisionRows decision_rows(std::span<const LabelledRun> runs, const DecisionConfig& config,
                           const DecisionFitConfig& fit, const std::function<void()>& before_step) {
  std::size_t steps = 0;
  for (const LabelledRun& run : runs) {
    check_labels(run);
    steps += steps_of(run);
  }
  // A pass takes a row of each wheel every so many steps.
  const std::size_t stride = std::max<std::size_t>(1, 2 * steps * fit.passes / fit.rows);
  std::size_t most = 0;
  for (const LabelledRun& run : runs) most += fit.passes * (steps_of(run) / stride + 1);
  // Sized once and shortened at the end: pages that are not written take no memory.
  DecisionRows rows;
  rows.inputs.resize(static_cast<int>(decision_inputs), static_cast<Eigen::Index>(most));
  if (config.servo_load) {
    rows.servo.resize(servo_count, rows.inputs.cols());
  }
  rows.places.reserve(2 * most);
  rows.is_contact.resize(2 * rows.inputs.cols());
  Eigen::Index count = 0;
  std::uint32_t column = 0;
  Draws draws(fit.seed);
  for (std::size_t pass = 0; pass < fit.passes; ++pass) {
    for (const LabelledRun& run : runs) {
      if (before_step) before_step();
      const std::size_t interval = draws.uniform() < fit.share_slow ? fit.steps_of_slow : 1;
      DecisionConfig own = config;
      own.geometry = run.legs.value_or(config.geometry);
      own.sample_rate = run.sample_rate / static_cast<double>(interval);
      FeatureExtractor features(own);
      Augmentation augmentation(fit.augmentation, draws, config.servo_load);
      const double p_reset = reset_probability(fit, augmentation, own.sample_rate, draws);
      std::size_t next = run.skip + draws.below(stride);
      for (std::size_t k = 0; k < run.signals.size(); k += interval) {
        if (p_reset > 0.0 && draws.uniform() < p_reset) features.reset_features();
        const FeatureExtractor::Step step = features.update(augmentation(run.signals[k]));
        if (k < next) continue;
        next += stride;
        if (!step.is_valid[0] && !step.is_valid[1]) continue;
        features.compute_inputs();
        const DecisionInputs inputs = features.inputs(0);
        std::copy(inputs.begin(), inputs.end(), rows.inputs.col(column).data());
        if (config.servo_load) {
          const ServoLoadInputs servo = features.servo_load(0);
          std::copy(servo.begin(), servo.end(), rows.servo.col(column).data());
        }
        for (std::uint32_t side = 0; side < 2; ++side) {
          if (!step.is_valid[side]) continue;
          rows.places.push_back({column & RowPlace::last_column, side & 1U});
          rows.is_contact[count++] = run.contact[side][k] != 0 ? 1.0F : 0.0F;
        }
        ++column;
      }
    }
  }
  rows.inputs.conservativeResize(Eigen::NoChange, column);
  if (config.servo_load) rows.servo.conservativeResize(Eigen::NoChange, column);
  rows.is_contact.conservativeResize(count);
  rows.weight.resize(count);
  const std::array<double, 2> weights = class_weights(rows, fit.class_exponent);
  for (Eigen::Index i = 0; i < count; ++i) {
    rows.weight[i] = static_cast<float>(weights[rows.is_contact[i] > 0.0F ? 1 : 0] / weights[1]);
  }
  return rows;
}

float weights_offset(const DecisionRows& rows) {
  // Rows in contact weigh 1, those without this much.
  const float air_weight =
      rows.weight.cwiseProduct(Eigen::RowVectorXf::Ones(rows.weight.size()) - rows.is_contact)
          .sum() /
      (static_cast<float>(rows.is_contact.size()) - rows.is_contact.sum());
  return std::log(air_weight);
}

DecisionModel fit_decision_model(std::span<const LabelledRun> runs, const DecisionConfig& config,
                                 const DecisionFitConfig& fit,
                                 const std::function<void()>& before_step) {
  check_decision_config(config);
  check_decision_fit_config(fit);
  const DecisionRows rows = decision_rows(runs, config, fit, before_step);
  DecisionModel model = train_decision_model(rows, fit, before_step);
  model.last_bias += weights_offset(rows);
  return model;
}

}  // namespace touchdown
