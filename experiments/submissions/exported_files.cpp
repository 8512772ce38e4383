#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <openssl/evp.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/rows.hpp"
#include "core/yaml.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/benchmark.hpp"
#include "experiments/submissions/export.hpp"

namespace touchdown::experiments {

namespace {

struct Free {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

constexpr const char* readme = R"(# Inputs of the estimators

Runs of the benchmark `{name}` of touchdown (request {id}). Every file has the sensor signals of one robot in
one run, bit for bit the input of touchdown's own estimators. The task at every step: which wheels are in
contact with the ground?

`index.csv` lists the files, `sha256sum -c SHA256SUMS` checks them. `role` is `fit` for runs to fit to,
`test` for runs that are scored; use nothing of a test run for fitting. Fit each robot and its sensors
separately, as our estimators do. Test runs have noise added to the sensor signals: settings of `noise` and
draws (`seed`) of it, {noise}.

## Arrays

`numpy.load(file)` opens a file. All arrays are float64, one row per control step (n steps).

| array | shape | |
|---|---|---|
| `time` | n | s, from 0, one control period apart |
| `has_record` | n | 1: there is a record of this step. 0: there is none, sensors are NaN, an estimator is not called and its last belief holds |
| `position`, `velocity`, `torque` | n × 6 | rad, rad/s, N·m as servos report them: left hip, left knee, left wheel, right hip, right knee, right wheel |
| `linear_acceleration` | n × 3 | m/s², without gravity, in the frame of the IMU |
| `angular_velocity` | n × 3 | rad/s, of the IMU in its own frame |
| `vertical_acceleration` | n | m/s², `linear_acceleration` along the world's upward vertical by the IMU's attitude: 0 at rest, −9.8 in free fall |
| `ground_velocity_command` | n | m/s, what the balancer asked for one step before; forward is positive |
| `target_position`, `target_velocity`, `target_torque` | n × 6 | rad, rad/s, N·m: commands of one step before, the last one feed-forward; NaN: none |
| `target_kp`, `target_kd` | n × 6 | N·m/rad, N·m·s/rad: the servos' gains, with torque = kp (target position − position) + kd (target velocity − velocity) + target torque |
| `contact` | n × 2 | the truth, left and right wheel: 1 contact, 0 none ({labels}) |

Signs are each joint's own. Legs mirror each other: a positive torque drives the left wheel forward and the
right one backward; hips and knees likewise. On Upkie the IMU has x back, y left, z down. Bad sensors report
NaN, repeat values or have a delay; that is part of the task. A belief at a step may use everything up to
that step and nothing after it. `contact` of test runs is for analysis of results, not an input.

## What to submit

A folder with a file of beliefs for every test file, under the same relative name: for
`upkie/ideal/x.npz` a file `upkie/ideal/x.csv`, `.npz` or `.mpack`. Its columns (CSV with a line of names;
arrays of float64; MessagePack dictionaries one after the other):

| | |
|---|---|
| `time` | s, increasing, within half a control period of the step's |
| `p_left`, `p_right` | probability of contact, 0 to 1 |
| `contact_left`, `contact_right` | optional decisions, 1 or 0; without them, contact is p ≥ 0.5 |

At a step without a belief the last one holds; before the first it is 0.5. `touchdown score` reports the
number of such steps. A run is scored if there are beliefs for all of its noise seeds. Other runs are counted
and named.

    touchdown score RUN --beliefs FOLDER --name NAME

adds it to the tables of a finished run of the benchmark, scored by the same code as our estimators. The first
{skip} ms of a run are not scored. Balanced accuracy is the mean of the recalls of contact and of flight, with
95 % bootstrap intervals over runs; docs/reference/metrics.md of touchdown defines the
other columns. Another build of touchdown may simulate other runs: export and score with the same build.
)";

std::string noise_of(const Experiment& experiment) {
  std::string all;
  for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
    all += fmt::format("{}{}: {}", cell == 0 ? "" : "; ", cell,
                       noise_text(experiment.highlights[cell]));
  }
  return all;
}

/// An array with `columns` numbers per step, appended by `put`.
template <typename Put>
ModelArray array_of(const std::vector<Signals>& steps, std::size_t columns, const Put& put) {
  ModelArray array{{steps.size()}, {}};
  if (columns > 1) array.shape.push_back(columns);
  array.data.reserve(steps.size() * columns);
  for (const Signals& signals : steps) put(signals, array.data);
  return array;
}

/// One number of each joint: of what its sensors report, or of its target.
template <typename Leg, typename Joint>
ModelArray joints(const std::vector<Signals>& steps, std::array<Leg, 2> Signals::*legs,
                  double Joint::*member) {
  return array_of(steps, 6, [&](const Signals& signals, std::vector<double>& data) {
    for (const Leg& leg : signals.*legs) {
      data.insert(data.end(), {leg.hip.*member, leg.knee.*member, leg.wheel.*member});
    }
  });
}

ModelArray vectors(const std::vector<Signals>& steps, Eigen::Vector3d Signals::*member) {
  return array_of(steps, 3, [&](const Signals& signals, std::vector<double>& data) {
    data.insert(data.end(), (signals.*member).begin(), (signals.*member).end());
  });
}

ModelArray numbers(const std::vector<Signals>& steps, double Signals::*member) {
  return array_of(steps, 1, [&](const Signals& signals, std::vector<double>& data) {
    data.push_back(signals.*member);
  });
}

ModelArrays arrays_of(const RunSignals& run,
                      const std::function<Signals(std::size_t step)>& signals_at) {
  std::vector<Signals> steps;
  steps.reserve(run.steps());
  ModelArray recorded{{run.steps()}, {}};
  ModelArray contact{{run.steps(), models::wheel_count}, {}};
  for (std::size_t k = 0; k < run.steps(); ++k) {
    steps.push_back(signals_at(k));
    recorded.data.push_back(has_record(steps.back()) ? 1.0 : 0.0);
    if (!has_record(steps.back())) {
      steps.back().time = run.period() * static_cast<double>(k);
    }
    for (const scoring::ContactSequence& label : run.contact) {
      contact.data.push_back(label[k] != 0 ? 1.0 : 0.0);
    }
  }
  return {{"time", numbers(steps, &Signals::time)},
          {"has_record", std::move(recorded)},
          {"position", joints(steps, &Signals::leg, &JointSignals::position)},
          {"velocity", joints(steps, &Signals::leg, &JointSignals::velocity)},
          {"torque", joints(steps, &Signals::leg, &JointSignals::torque)},
          {"linear_acceleration", vectors(steps, &Signals::linear_acceleration)},
          {"angular_velocity", vectors(steps, &Signals::angular_velocity)},
          {"vertical_acceleration", numbers(steps, &Signals::vertical_acceleration)},
          {"ground_velocity_command", numbers(steps, &Signals::ground_velocity_command)},
          {"target_position", joints(steps, &Signals::target, &JointTarget::position)},
          {"target_velocity", joints(steps, &Signals::target, &JointTarget::velocity)},
          {"target_torque", joints(steps, &Signals::target, &JointTarget::feedforward_torque)},
          {"target_kp", joints(steps, &Signals::target, &JointTarget::kp)},
          {"target_kd", joints(steps, &Signals::target, &JointTarget::kd)},
          {"contact", std::move(contact)}};
}

}  // namespace

std::string sha256(std::string_view bytes) {
  constexpr std::size_t digest_bytes = 32;
  const std::unique_ptr<EVP_MD_CTX, Free> context(EVP_MD_CTX_new());
  std::array<unsigned char, digest_bytes> digest{};
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1 ||
      EVP_DigestUpdate(context.get(), bytes.data(), bytes.size()) != 1 ||
      EVP_DigestFinal_ex(context.get(), digest.data(), nullptr) != 1) {
    throw Error("libcrypto could not compute a SHA-256");
  }
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string readme_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  return fmt::format(readme, fmt::arg("name", experiment.name), fmt::arg("id", request.id),
                     fmt::arg("noise", noise_of(experiment)),
                     fmt::arg("labels", labels_text(experiment)),
                     fmt::arg("skip", 1e3 * experiment.scoring.skip));
}

ModelArrays exported_arrays(const RunSignals& run) {
  return arrays_of(run, [&](std::size_t step) { return run.signals[step]; });
}

ModelArrays exported_arrays(const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels) {
  return arrays_of(run, [&](std::size_t step) { return noisy(run, noise, levels, step); });
}

double bytes_of_exported(double steps) {
  constexpr double numbers = 1 + 1 + 3 * 6 + 2 * 3 + 1 + 1 + 5 * 6 + 2;
  constexpr double heads = 15 * 300.0;
  return heads + numbers * sizeof(double) * steps;
}

namespace {

/// The scene's own name. On another robot, the name of a run's scenario ends with the robot's name.
std::string scene_name(const PlannedRun& run, const RunSetup& where) {
  const std::string& name = run.scenario.name;
  if (where.robot.empty()) return name;
  const std::string robot = std::filesystem::path(where.robot).stem().string();
  return name.substr(0, name.size() - robot.size() - 1);
}

bool is_of(const PlannedRun& run, const BenchmarkSetup& setup) {
  if (run.role == RunRole::test) return run.group == setup.group;
  return run.fit == setup.runs.fit && run.sensors == setup.runs.sensors;
}

/// Keeps the runs with a wanted name. Errors: `InputError` for a name that no run has.
void keep(std::vector<ExportedRun>& runs, const char* flag, const std::vector<std::string>& wanted,
          const std::function<std::string(const ExportedRun&)>& name_of) {
  if (wanted.empty()) return;
  const std::vector<std::string> known = unique(runs, name_of);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}: the benchmark has no '{}': expected one of {}{}", flag, name,
                                 fmt::join(known, ", "), did_you_mean(name, known)));
  }
  std::erase_if(runs, [&](const ExportedRun& run) {
    return std::find(wanted.begin(), wanted.end(), name_of(run)) == wanted.end();
  });
}

}  // namespace

std::vector<ExportedRun> exported_runs(const RunRequest& request, const Plan& plan) {
  const Experiment& experiment = request.experiment;
  if (!experiment.studies.has<BenchmarkConfig>()) {
    throw InputError(fmt::format(
        "experiment '{}' is no benchmark: expected a section 'benchmark', as in "
        "experiments/benchmark.yaml ('benchmark: {{}}' takes the scenes' own robot and sensors)",
        experiment.name));
  }
  std::vector<std::vector<std::size_t>> tasks(plan.runs.size());
  for (std::size_t t = 0; t < plan.tasks.size(); ++t) tasks[plan.tasks[t].run].push_back(t);
  std::vector<ExportedRun> all;
  for (const BenchmarkSetup& setup : benchmark_setups(request, plan)) {
    for (const std::string& name : {setup.robot, setup.sensors}) {
      if (is_name_word(name)) continue;
      throw InputError(fmt::format("benchmark: '{}': {}", name, expected_name_word));
    }
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      const PlannedRun& run = plan.runs[i];
      if (!is_of(run, setup)) continue;
      const std::string stem = fmt::format("{}/{}/{}", setup.robot, setup.sensors,
                                           std::filesystem::path(run.file).stem().string());
      ExportedRun exported{stem, setup.robot, setup.sensors, scene_name(run, setup.runs), i};
      if (run.role == RunRole::fit) all.push_back(exported);
      for (const std::size_t task : tasks[i]) {
        for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
          exported.name = fmt::format("{}_noise_{}_seed_{}", stem, cell, plan.tasks[task].seed);
          exported.task = task;
          exported.cell = cell;
          all.push_back(exported);
        }
      }
    }
  }
  return all;
}

std::vector<ExportedRun> part_of(const std::vector<ExportedRun>& all, const BenchmarkPart& part,
                                 const Plan& plan) {
  std::vector<ExportedRun> runs = all;
  keep(runs, "--robot", part.robots, [](const ExportedRun& run) { return run.robot; });
  keep(runs, "--sensors", part.sensors, [](const ExportedRun& run) { return run.sensors; });
  keep(runs, "--simulator", part.simulators,
       [&](const ExportedRun& run) { return plan.runs[run.run].simulator; });
  return runs;
}

}  // namespace touchdown::experiments
