#include "estimator/phase/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "estimator/numerics/kernel_density.hpp"

namespace touchdown {
namespace {

struct Range {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void include(double value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

/// Covers the samples and four bandwidths more, where the kernels have fallen below the uniform
/// part of the mixture.
Axis axis_over(const Range& range, double bandwidth, double step) {
  const double lower = range.lower - 4.0 * bandwidth;
  const double upper = range.upper + 4.0 * bandwidth;
  const int count = std::max(2, 1 + static_cast<int>(std::ceil((upper - lower) / step)));
  return {lower, upper, count};
}

/// At most `largest` of the samples, evenly spaced in time.
template <typename Sample>
std::vector<Sample> thinned(const std::vector<Sample>& samples, std::size_t largest) {
  if (largest == 0 || samples.size() <= largest) return samples;
  std::vector<Sample> kept(largest);
  for (std::size_t i = 0; i < largest; ++i) kept[i] = samples[i * samples.size() / largest];
  return kept;
}

/// log((1 − ε) f + ε u) at every cell, phase by phase within; f is the `density` of what is kept of
/// a phase's samples, and nothing for a phase without any.
template <typename Samples, typename Density>
std::vector<float> log_mixtures(const Samples& samples, std::size_t cells, double uniform,
                                const PhaseFitConfig& config, const Density& density) {
  std::vector<float> log_density(cells * samples.size());
  for (std::size_t phase = 0; phase < samples.size(); ++phase) {
    const auto kept = thinned(samples[phase], config.largest_sample);
    const std::vector<double> f = kept.empty() ? std::vector<double>() : density(kept);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double mixture =
          f.empty() ? uniform
                    : (1.0 - config.contamination) * f[cell] + config.contamination * uniform;
      log_density[cell * samples.size() + phase] = static_cast<float>(std::log(mixture));
    }
  }
  return log_density;
}

/// Adds one run's samples, transitions and labelled time.
class Collector {
 public:
  Collector(double sample_rate, const PhaseLabelConfig& labels)
      : sample_rate_(sample_rate), labels_(labels) {}

  void add(const PhaseFitRun& run) {
    const std::size_t steps = run.signals.size();
    if (run.contact[0].size() != steps || run.contact[1].size() != steps) {
      throw InputError("phase fit: signals and contact of a run must be equally long");
    }
    std::vector<std::uint8_t> held;
    if (run.may_be_held) held = held_steps(run.signals, sample_rate_, labels_);
    std::vector<std::uint8_t> carried;
    if (run.may_be_held && !run.normal_force[0].empty()) {
      carried = carried_steps(run.normal_force, held, sample_rate_, labels_);
    }
    const std::vector<Phase> phases =
        label_phases(run.contact, held, sample_rate_, labels_, carried);
    const std::size_t skip = std::min(run.skip, steps);
    const PhaseTransition counts = count_transitions(std::span(phases).subspan(skip));
    for (std::size_t i = 0; i < phase_count; ++i) {
      for (std::size_t j = 0; j < phase_count; ++j) counts_[i][j] += counts[i][j];
    }
    for (std::size_t k = skip; k < steps; ++k) add_step(run.signals[k], phases[k]);
  }

  void forget_single_wheels() {
    samples_.torque[supporting_leg].clear();
    samples_.torque[airborne_leg].clear();
  }

  [[nodiscard]] const PhaseSamples& samples() const { return samples_; }
  [[nodiscard]] const PhaseTransition& counts() const { return counts_; }
  [[nodiscard]] const std::array<double, phase_count>& seconds() const { return seconds_; }

 private:
  void add_step(const Signals& signals, Phase phase) {
    seconds_[index(phase)] += 1.0 / sample_rate_;
    samples_.acceleration[std::min(index(phase), acceleration_density_count - 1)].push_back(
        signals.vertical_acceleration);
    const bool touches[2] = {left_touches(phase), right_touches(phase)};
    for (std::size_t side = 0; side < 2; ++side) {
      const double mirror = side == 0 ? 1.0 : -1.0;
      const LegSignals& leg = signals.leg[side];
      const std::size_t density = touches[0] == touches[1] ? index(phase)
                                  : touches[side]          ? supporting_leg
                                                           : airborne_leg;
      samples_.torque[density].push_back({mirror * leg.knee.torque, mirror * leg.wheel.torque});
    }
  }

  double sample_rate_;
  PhaseLabelConfig labels_;
  PhaseSamples samples_;
  PhaseTransition counts_{};
  std::array<double, phase_count> seconds_{};
};

}  // namespace

PhaseTransition count_transitions(std::span<const Phase> phases) {
  PhaseTransition counts{};
  for (std::size_t k = 1; k < phases.size(); ++k) {
    counts[index(phases[k - 1])][index(phases[k])] += 0.5;
    counts[index(mirrored(phases[k - 1]))][index(mirrored(phases[k]))] += 0.5;
  }
  return counts;
}

PhaseTransition transition_probabilities(const PhaseTransition& counts, double pseudo_count) {
  PhaseTransition transition{};
  for (std::size_t i = 0; i < phase_count; ++i) {
    double sum = 0.0;
    for (const double count : counts[i]) sum += count + pseudo_count;
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition[i][j] = (counts[i][j] + pseudo_count) / sum;
    }
  }
  return transition;
}

PhaseTorqueDensity fit_torque_density(const PhaseSamples& samples, const TorqueSample& noise,
                                      const PhaseFitConfig& config) {
  const TorqueSample h = {std::hypot(config.torque_bandwidth, noise.knee),
                          std::hypot(config.torque_bandwidth, noise.wheel)};
  Range knee_range;
  Range wheel_range;
  for (const auto& of_phase : samples.torque) {
    for (const TorqueSample& sample : of_phase) {
      knee_range.include(sample.knee);
      wheel_range.include(sample.wheel);
    }
  }
  PhaseTorqueDensity result{
      noise,
      h,
      axis_over(knee_range, h.knee, std::min(config.grid_step * h.knee, config.largest_knee_step)),
      axis_over(wheel_range, h.wheel,
                std::min(config.grid_step * h.wheel, config.largest_wheel_step)),
      {}};
  const double uniform =
      1.0 / (4.0 * (config.knee_range + 4.0 * h.knee) * (config.wheel_range + 4.0 * h.wheel));
  const auto density = [&](const std::vector<TorqueSample>& kept) {
    std::vector<double> knee(kept.size());
    std::vector<double> wheel(kept.size());
    std::transform(kept.begin(), kept.end(), knee.begin(), [](const auto& s) { return s.knee; });
    std::transform(kept.begin(), kept.end(), wheel.begin(), [](const auto& s) { return s.wheel; });
    return kernel_density(wheel, knee, h.wheel, h.knee, result.wheel, result.knee);
  };
  const auto cells =
      static_cast<std::size_t>(result.knee.count) * static_cast<std::size_t>(result.wheel.count);
  result.log_density = log_mixtures(samples.torque, cells, uniform, config, density);
  const auto borrow = [&](std::size_t borrower, Phase lender) {
    if (!samples.torque[borrower].empty()) return;
    for (std::size_t cell = 0; cell < result.log_density.size(); cell += torque_density_count) {
      result.log_density[cell + borrower] = result.log_density[cell + index(lender)];
    }
  };
  borrow(supporting_leg, Phase::rolling);
  borrow(airborne_leg, Phase::flight);
  return result;
}

PhaseAccelerationDensity fit_acceleration_density(const PhaseSamples& samples, double noise,
                                                  const PhaseFitConfig& config) {
  const double h = std::hypot(config.acceleration_bandwidth, noise);
  Range range;
  for (const auto& of_phase : samples.acceleration) {
    for (const double sample : of_phase) range.include(sample);
  }
  PhaseAccelerationDensity result{noise, h, axis_over(range, h, config.grid_step * h), {}};
  const double uniform = 1.0 / (2.0 * (config.acceleration_range + 4.0 * h));
  result.log_density = log_mixtures(
      samples.acceleration, static_cast<std::size_t>(result.axis.count), uniform, config,
      [&](const std::vector<double>& kept) { return kernel_density(kept, h, result.axis); });
  return result;
}

PhaseModel fit_phase_model(std::span<const PhaseFitRun> runs, double sample_rate,
                           const PhaseFitConfig& config,
                           const std::function<void()>& before_density) {
  check_phase_fit_config(config);
  if (!(std::isfinite(sample_rate) && sample_rate > 0.0)) {
    throw InputError("phase fit: the sample rate must be positive (Hz)");
  }
  Collector collector(sample_rate, config.labels);
  for (const PhaseFitRun& run : runs) collector.add(run);
  for (const Phase needed : {Phase::rolling, Phase::flight}) {
    if (!(collector.seconds()[index(needed)] > 0.0)) {
      throw InputError("phase fit: the runs contain no " + std::string(phase_names[index(needed)]));
    }
  }
  const double single_wheel =
      collector.seconds()[index(Phase::left_only)] + collector.seconds()[index(Phase::right_only)];
  if (single_wheel < config.least_single_wheel) collector.forget_single_wheels();
  PhaseModel model;
  model.sample_rate = sample_rate;
  model.transition = transition_probabilities(collector.counts(), config.pseudo_count);
  model.seconds = collector.seconds();
  for (const double knee : config.torque_noise) {
    for (const double wheel : config.torque_noise) {
      if (before_density) before_density();
      model.torque.push_back(fit_torque_density(collector.samples(), {knee, wheel}, config));
    }
  }
  for (const double noise : config.acceleration_noise) {
    if (before_density) before_density();
    model.acceleration.push_back(fit_acceleration_density(collector.samples(), noise, config));
  }
  return model;
}

}  // namespace touchdown
