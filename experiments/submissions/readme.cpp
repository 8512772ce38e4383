#include "experiments/submissions/readme.hpp"

#include <fmt/format.h>

#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* text = R"(# What an estimator hears

Runs of the benchmark `{name}` of touchdown (request {id}). Every file is what one robot's sensors say in
one run, to the bit what touchdown's own estimators are given. The question at every step: which wheels
touch the ground?

`index.csv` lists the files, `sha256sum -c SHA256SUMS` checks them. `role` is `fit` for runs to learn from,
`test` for runs that are scored; use nothing of a test run for fitting. Learn for each robot and its
sensors apart, as our estimators do. Test runs have noise on top of what the sensors do: settings of
`noise` and draws (`seed`) of it, {noise}.

## Arrays

`numpy.load(file)` opens a file. All arrays are float64, one row per control step (n steps).

| array | shape | |
|---|---|---|
| `time` | n | s, from 0, one control period apart |
| `heard` | n | 1: there is a record of this step. 0: there is none, sensors are NaN, an estimator is not called and its last belief stands |
| `position`, `velocity`, `torque` | n × 6 | rad, rad/s, N·m as servos report them: left hip, left knee, left wheel, right hip, right knee, right wheel |
| `linear_acceleration` | n × 3 | m/s², without gravity, in the frame of the IMU |
| `angular_velocity` | n × 3 | rad/s, of the IMU in its own frame |
| `vertical_acceleration` | n | m/s², `linear_acceleration` along the world's upward vertical by the IMU's attitude: 0 at rest, −9.8 in free fall |
| `ground_velocity_command` | n | m/s, what the balancer asked for one step before; forward is positive |
| `contact` | n × 2 | the truth, left and right wheel: 1 contact, 0 none ({labels}) |

Signs are each joint's own. Legs mirror each other: a positive torque drives the left wheel forward and the
right one backward; hips and knees likewise. On Upkie the IMU has x back, y left, z down. Bad sensors say
NaN, repeat themselves or come late; that is part of the task. A belief at a step may use everything up to
that step and nothing after it; `contact` of test runs is there to look at results, not to listen to.

## What to hand in

A folder with a file of beliefs for every test file, under the same relative name: for
`upkie/ideal/x.npz` a file `upkie/ideal/x.csv`, `.npz` or `.mpack`. Its columns (CSV with a line of names;
arrays of float64; MessagePack dictionaries one after the other):

| | |
|---|---|
| `time` | s, increasing, within half a control period of the step's |
| `p_left`, `p_right` | probability of contact, 0 to 1 |
| `contact_left`, `contact_right` | optional decisions, 1 or 0; without them, contact is p ≥ 0.5 |

At a step without a belief the last one stands; before the first it is 0.5. How many there are is said.
A run is scored if there are beliefs for all of its noise seeds. Runs without are counted and named.

    touchdown score RUN --beliefs FOLDER --name NAME

puts it into the tables of a finished run of the benchmark, beside ours and by the same code. The first
{skip} ms of a run are not scored. Balanced accuracy is the mean of the shares of contact and of flight that
are told right, with 95 % bootstrap intervals over runs; the other columns are in docs/benchmark.md and
docs/metrics.md of touchdown. Another build of touchdown may simulate other runs: export and score with one.
)";

std::string noise_of(const Experiment& experiment) {
  std::string all;
  for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
    all += fmt::format("{}{}: {}", cell == 0 ? "" : "; ", cell,
                       noise_text(experiment.highlights[cell]));
  }
  return all;
}

}  // namespace

std::string readme_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  return fmt::format(text, fmt::arg("name", experiment.name), fmt::arg("id", request.id),
                     fmt::arg("noise", noise_of(experiment)),
                     fmt::arg("labels", labels_text(experiment)),
                     fmt::arg("skip", 1e3 * experiment.scoring.skip));
}

}  // namespace touchdown::experiments
