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

/// An axis over the samples and four bandwidths more, where the kernels are below the uniform part
/// of the mixture.
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

/// Which of `count` densities in a table, which stores them cell by cell.
struct DensityColumn {
  std::size_t number = 0;
  std::size_t count = 1;
};

/// log((1 − ε) f + ε u) at every cell; without f, log u.
void put_log_mixture(const std::vector<double>& f, double uniform, const PhaseFitConfig& config,
                     const DensityColumn& column, std::vector<float>& table) {
  for (std::size_t cell = 0; cell * column.count < table.size(); ++cell) {
    const double mixture =
        f.empty() ? uniform
                  : (1.0 - config.contamination) * f[cell] + config.contamination * uniform;
    table[cell * column.count + column.number] = static_cast<float>(std::log(mixture));
  }
}

/// Torques of many steps, joint by joint.
struct JointTorques {
  explicit JointTorques(const std::vector<TorqueSample>& samples) {
    for (const TorqueSample& sample : samples) {
      knee.push_back(sample.knee);
      wheel.push_back(sample.wheel);
    }
  }
  std::vector<double> knee;
  std::vector<double> wheel;
};

/// The kernel axis of one joint's torque for each noise.
std::vector<KernelAxis> kernel_axes(const Range& range, std::span<const double> noise,
                                    const PhaseFitConfig& config, double largest_step) {
  std::vector<KernelAxis> axes;
  for (const double sigma : noise) {
    const double h = std::hypot(config.torque_bandwidth, sigma);
    axes.push_back({h, axis_over(range, h, std::min(config.grid_step * h, largest_step))});
  }
  return axes;
}

/// Copies the density of `lender` to a borrower without samples.
void borrow_if_none(const PhaseSamples& samples, std::size_t borrower, Phase lender,
                    PhaseTorqueDensity& density) {
  if (!samples.torque[borrower].empty()) return;
  for (std::size_t cell = 0; cell < density.log_density.size(); cell += torque_density_count) {
    density.log_density[cell + borrower] = density.log_density[cell + index(lender)];
  }
}

/// Collects samples, transitions and labelled time of all runs.
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

  void drop_single_wheel_samples() {
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
    const bool in_contact[2] = {left_in_contact(phase), right_in_contact(phase)};
    for (std::size_t side = 0; side < 2; ++side) {
      const double mirror = side == 0 ? 1.0 : -1.0;
      const LegSignals& leg = signals.leg[side];
      const std::size_t density = in_contact[0] == in_contact[1] ? index(phase)
                                  : in_contact[side]             ? supporting_leg
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

std::vector<PhaseTorqueDensity> fit_torque_densities(const PhaseSamples& samples,
                                                     std::span<const double> knee_noise,
                                                     std::span<const double> wheel_noise,
                                                     const PhaseFitConfig& config,
                                                     const std::function<void()>& before_density) {
  Range knee_range;
  Range wheel_range;
  for (const auto& of_phase : samples.torque) {
    for (const TorqueSample& sample : of_phase) {
      knee_range.include(sample.knee);
      wheel_range.include(sample.wheel);
    }
  }
  const std::vector<KernelAxis> knees =
      kernel_axes(knee_range, knee_noise, config, config.largest_knee_step);
  const std::vector<KernelAxis> wheels =
      kernel_axes(wheel_range, wheel_noise, config, config.largest_wheel_step);
  std::vector<PhaseTorqueDensity> results;
  for (std::size_t i = 0; i < knees.size(); ++i) {
    for (std::size_t j = 0; j < wheels.size(); ++j) {
      PhaseTorqueDensity& result = results.emplace_back();
      result.noise = {knee_noise[i], wheel_noise[j]};
      result.bandwidth = {knees[i].bandwidth, wheels[j].bandwidth};
      result.knee = knees[i].axis;
      result.wheel = wheels[j].axis;
      result.log_density.resize(static_cast<std::size_t>(result.knee.count) *
                                static_cast<std::size_t>(result.wheel.count) *
                                torque_density_count);
    }
  }
  for (std::size_t phase = 0; phase < torque_density_count; ++phase) {
    if (before_density) before_density();
    const JointTorques kept(thinned(samples.torque[phase], config.largest_sample));
    // Rows along the wheel's torque.
    const std::vector<std::vector<double>> densities =
        kept.knee.empty() ? std::vector<std::vector<double>>()
                          : kernel_densities(kept.wheel, kept.knee, wheels, knees);
    for (std::size_t k = 0; k < results.size(); ++k) {
      const TorqueSample& h = results[k].bandwidth;
      const double uniform =
          1.0 / (4.0 * (config.knee_range + 4.0 * h.knee) * (config.wheel_range + 4.0 * h.wheel));
      const std::size_t at = k % wheels.size() * knees.size() + k / wheels.size();
      put_log_mixture(densities.empty() ? std::vector<double>() : densities[at], uniform, config,
                      {phase, torque_density_count}, results[k].log_density);
    }
  }
  for (PhaseTorqueDensity& result : results) {
    borrow_if_none(samples, supporting_leg, Phase::rolling, result);
    borrow_if_none(samples, airborne_leg, Phase::flight, result);
  }
  return results;
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
  result.log_density.resize(static_cast<std::size_t>(result.axis.count) *
                            acceleration_density_count);
  for (std::size_t phase = 0; phase < acceleration_density_count; ++phase) {
    const std::vector<double> kept = thinned(samples.acceleration[phase], config.largest_sample);
    put_log_mixture(kept.empty() ? kept : kernel_density(kept, h, result.axis), uniform, config,
                    {phase, acceleration_density_count}, result.log_density);
  }
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
  const double single_wheel =
      collector.seconds()[index(Phase::left_only)] + collector.seconds()[index(Phase::right_only)];
  for (const Phase needed : {Phase::rolling, Phase::flight}) {
    if (!(collector.seconds()[index(needed)] > 0.0)) {
      throw InputError("phase fit: the runs contain no " + std::string(phase_names[index(needed)]) +
                       " of both wheels" + (single_wheel > 0.0 ? ", only of one" : ""));
    }
  }
  if (single_wheel < config.least_single_wheel) collector.drop_single_wheel_samples();
  PhaseModel model;
  model.sample_rate = sample_rate;
  model.transition = transition_probabilities(collector.counts(), config.pseudo_count);
  model.seconds = collector.seconds();
  model.torque = fit_torque_densities(collector.samples(), config.torque_noise, config.torque_noise,
                                      config, before_density);
  for (const double noise : config.acceleration_noise) {
    if (before_density) before_density();
    model.acceleration.push_back(fit_acceleration_density(collector.samples(), noise, config));
  }
  return model;
}

}  // namespace touchdown
