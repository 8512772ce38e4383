#include "estimator/evidence/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "estimator/decision/fit.hpp"
#include "estimator/evidence/channels.hpp"

namespace touchdown {

namespace {

/// Adds to each knot around the position its share of the amount.
void add(auto& values, const EvidencePosition& at, float amount) {
  const auto knot = static_cast<std::size_t>(at.knot);
  values[knot] += (1.0F - at.share) * amount;
  values[knot + 1] += at.share * amount;
}

/// Calls `part` with the same fitted numbers of all models, part by part.
template <typename Part, typename... Models>
void for_each_number(const Part& part, Models&... models) {
  const std::size_t count = std::min({curve_count(models)...});
  for (std::size_t i = 0; i < count; ++i) part(std::span(curve_of(models, i))...);
  part(std::span(&models.bias, 1)...);
}

/// Adds the gradient of `cost`/2 times the squared differences of neighbouring knots.
void add_smoothness(const EvidenceModel& model, float cost, EvidenceModel& gradient) {
  for (std::size_t i = 0; i < curve_count(model); ++i) {
    const EvidenceCurve& curve = curve_of(model, i);
    EvidenceCurve& slopes = curve_of(gradient, i);
    for (std::size_t k = 0; k + 1 < evidence_knots; ++k) {
      const float slope = cost * (curve[k + 1] - curve[k]);
      slopes[k] -= slope;
      slopes[k + 1] += slope;
    }
  }
}

/// The channels with curves that never fall (`EvidenceFitConfig::monotone`).
constexpr std::array<std::string_view, 5> monotone_channels = {
    "load", "servo_load", "axle_velocity", "axle_acceleration", "vertical_acceleration"};

void make_curves_monotone(EvidenceModel& model) {
  const auto along = [](const auto& channels, auto& curves) {
    for (std::size_t i = 0; i < channels.size() * decision_scales && i < curves.size(); ++i) {
      const std::string_view name = channels[i / decision_scales].name;
      if (std::ranges::find(monotone_channels, name) != monotone_channels.end()) {
        make_monotone(curves[i]);
      }
    }
  };
  along(evidence_channels, model.curve);
  along(servo_load_channels, model.servo_curve);
}

/// Subtracts from a curve its mean, given the weight of each knot. Returns the mean.
template <typename Values>
float centred(Values& values, const std::vector<double>& weight) {
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    sum += weight[k] * static_cast<double>(values[k]);
    all += weight[k];
  }
  const auto mean = static_cast<float>(sum / all);
  for (float& value : values) value -= mean;
  return mean;
}

/// Centres every curve over the rows and adds the means to the bias.
void centre(EvidenceModel& model, const DecisionRows& rows) {
  std::vector<double> weight(evidence_knots);
  for (std::size_t i = 0; i < curve_count(model); ++i) {
    const std::vector<float> inputs = rows.values_of(i);
    std::fill(weight.begin(), weight.end(), 0.0);
    for (std::size_t row = 0; row < inputs.size(); ++row) {
      add(weight, evidence_position(inputs[row]), rows.weight[static_cast<Eigen::Index>(row)]);
    }
    model.bias += centred(curve_of(model, i), weight);
  }
}

/// Sets for each input the range that holds all but two in a thousand rows.
void set_seen_ranges(EvidenceModel& model, const DecisionRows& rows) {
  const auto count = static_cast<std::size_t>(rows.count());
  const std::size_t beyond = count / 1000;
  model.servo_seen.resize(model.servo_curve.size());
  for (std::size_t input = 0; input < curve_count(model); ++input) {
    std::vector<float> values = rows.values_of(input);
    for (const bool upper : {false, true}) {
      const auto nth =
          values.begin() + static_cast<std::ptrdiff_t>(upper ? count - 1 - beyond : beyond);
      std::nth_element(values.begin(), nth, values.end());
      seen_by(model, input)[upper ? 1 : 0] = *nth;
    }
  }
}

}  // namespace

void check_evidence_fit_config(const EvidenceFitConfig& config) {
  check_decision_fit_config(config.descent);
  if (!(std::isfinite(config.smoothness) && config.smoothness >= 0.0)) {
    throw InputError("evidence curves: smoothness must not be negative");
  }
}

double evidence_loss(const EvidenceModel& model, const DecisionRows& rows,
                     EvidenceModel* gradient) {
  if (gradient != nullptr) {
    *gradient = {};
    gradient->servo_curve.assign(model.servo_curve.size(), EvidenceCurve{});
  }
  const float all = rows.weight.sum();
  double loss = 0.0;
  for (Eigen::Index row = 0; row < rows.count(); ++row) {
    const DecisionInputs inputs = rows.inputs_of(row);
    const ServoLoadInputs servo = rows.servo_load_of(row);
    const float logit = evidence_logit(model, inputs, servo);
    // log(1 + e^z) − y z, for any z.
    const float tail = std::exp(-std::abs(logit));
    loss += static_cast<double>(rows.weight[row] * (std::max(logit, 0.0F) + std::log1p(tail) -
                                                    rows.is_contact[row] * logit));
    if (gradient == nullptr) continue;
    const float p = (logit >= 0.0F ? 1.0F : tail) / (tail + 1.0F);
    const float to_logit = (p - rows.is_contact[row]) * rows.weight[row] / all;
    gradient->bias += to_logit;
    for (std::size_t i = 0; i < decision_inputs; ++i) {
      add(gradient->curve[i], evidence_position(inputs[i]), to_logit);
    }
    for (std::size_t i = 0; i < model.servo_curve.size(); ++i) {
      add(gradient->servo_curve[i], evidence_position(servo[i]), to_logit);
    }
  }
  return loss / static_cast<double>(all);
}

EvidenceModel train_evidence_model(const DecisionRows& rows, const EvidenceFitConfig& config,
                                   const std::function<void()>& before_step) {
  EvidenceModel model;
  if (rows.has_servo_load()) {
    model.servo_curve.assign(std::tuple_size_v<ServoLoadInputs>, EvidenceCurve{});
  }
  EvidenceModel gradient = model;
  EvidenceModel mean = model;
  EvidenceModel square = model;
  Draws draws(config.descent.seed);
  descend(rows, config.descent, draws, before_step,
          [&](const DecisionRows& batch, const AdamStep& adam_step) {
            static_cast<void>(evidence_loss(model, batch, &gradient));
            add_smoothness(model, static_cast<float>(config.smoothness), gradient);
            for_each_number(adam_step, model, gradient, mean, square);
            if (config.monotone) make_curves_monotone(model);
          });
  centre(model, rows);
  set_seen_ranges(model, rows);
  return model;
}

EvidenceModel fit_evidence_model(std::span<const LabelledRun> runs, const DecisionConfig& config,
                                 const EvidenceFitConfig& fit,
                                 const std::function<void()>& before_step) {
  check_decision_config(config);
  check_evidence_fit_config(fit);
  const DecisionRows rows = decision_rows(runs, config, fit.descent, before_step);
  EvidenceModel model = train_evidence_model(rows, fit, before_step);
  model.bias += weights_offset(rows);
  return model;
}

EvidenceCurveSets fit_evidence_curve_sets(std::span<const LabelledRun> runs,
                                          const DecisionConfig& config,
                                          const EvidenceFitConfig& fit,
                                          const std::function<void()>& before_step) {
  EvidenceModel usual = fit_evidence_model(runs, config, fit, before_step);
  if (!config.servo_load) return usual;
  DecisionConfig without_targets = config;
  without_targets.servo_load = false;
  return {std::move(usual), fit_evidence_model(runs, without_targets, fit, before_step)};
}

}  // namespace touchdown
