#include "experiments/submissions/prediction.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

/// The step of a belief.
std::size_t step_of(const recordings::Beliefs& beliefs, std::size_t index, const RunSignals& run) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  const double step = std::round(beliefs.time[index] / period);
  if (step >= 0.0 && step < static_cast<double>(run.steps())) return static_cast<std::size_t>(step);
  throw InputError(fmt::format("{}: time {} s: expected one of the run, from 0 to {:.6g} s",
                               beliefs.place(index), beliefs.time[index],
                               period * static_cast<double>(run.steps() - 1)));
}

Belief belief_of(const recordings::Beliefs& beliefs, std::size_t index) {
  Belief belief;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    belief.wheel[w] = {beliefs.p_contact[w][index], beliefs.contact[w][index] != 0};
  }
  multiply_wheels(belief);
  return belief;
}

}  // namespace

SubmittedPrediction prediction_of(const recordings::Beliefs& beliefs, const RunSignals& run) {
  SubmittedPrediction result;
  for (scoring::Track& track : result.prediction) {
    track.contact.reserve(run.steps());
    track.p_contact.reserve(run.steps());
  }
  Belief belief;
  apply_threshold(belief, 0.5);
  std::size_t next = 0;  // belief
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (next < beliefs.size() && step_of(beliefs, next, run) == k) {
      belief = belief_of(beliefs, next++);
      if (next < beliefs.size() && step_of(beliefs, next, run) == k) {
        throw InputError(fmt::format("{}: time {} s: expected one belief per step of {} ms",
                                     beliefs.place(next), beliefs.time[next],
                                     1e-3 * static_cast<double>(run.info.control_period_us)));
      }
    } else if (has_record(run.signals[k])) {
      ++result.without;
    }
    const auto views = scoring::views_of(belief);
    for (std::size_t v = 0; v < scoring::view_count; ++v) {
      result.prediction[v].contact.push_back(std::uint8_t{views[v].contact});
      result.prediction[v].p_contact.push_back(views[v].p_contact);
    }
  }
  return result;
}

}  // namespace touchdown::experiments
