"""Runs as dicts of NumPy arrays: simulated, read, written, fitted to, scored."""
from __future__ import annotations

import os
from typing import Any, Iterable, Mapping

import numpy as np

from touchdown import _touchdown
from touchdown._touchdown import InputError, Model
from touchdown.overrides import assignments

Path = str | os.PathLike


class Recording(dict):
    """One run: a dict of NumPy arrays with one row per control step, and `info` about its origin.

    Measurements and commands, all float64:

    ========================== ========== ========= ============================================================
    `time`                     (steps,)   s         since the start of the run
    `position`                 (steps, 6) rad       of the joints: left hip, knee, wheel, right hip, knee, wheel
    `velocity`                 (steps, 6) rad/s
    `torque`                   (steps, 6) N·m       as the servos report them
    `orientation`              (steps, 4)           of the IMU, w x y z, to a frame x forward, y right, z down
    `angular_velocity`         (steps, 3) rad/s     of the IMU, in its own frame (x back, y left, z down)
    `linear_acceleration`      (steps, 3) m/s²      of the IMU, in its own frame, without gravity
    `raw_linear_acceleration`  (steps, 3) m/s²      of the IMU, in its own frame, with gravity
    `vertical_acceleration`    (steps,)   m/s²      `linear_acceleration` along the world's upward vertical
    `ground_velocity_command`  (steps,)   m/s       of the step before
    `target_position`, …       (steps, 6)           commands of the step before, NaN: none: also `_velocity`,
                                                    `_torque` (feed-forward), `_kp` (N·m/rad), `_kd` (N·m·s/rad)
    `pitch`, `yaw`             (steps,)   rad       of the base; rates: `pitch_rate`, `yaw_rate` (rad/s)
    `command_position`, …      (steps, 6)           commands of the servos: also `_velocity`,
                                                    `_feedforward_torque`, `_kp_scale`, `_kd_scale`,
                                                    `_maximum_torque`
    ========================== ========== ========= ============================================================

    Ground truth of simulated runs:

    ========================== ========== ========= ============================================================
    `contact`                  (steps, 2) bool      as `contact_labels` defines it
    `normal_force`             (steps, 2) N         between tyre and terrain
    `base_position`            (steps, 3) m         world: x forward, y left, z up
    `base_orientation`         (steps, 4)           w x y z, from base to world
    `base_linear_velocity`     (steps, 3) m/s       in the world
    `base_angular_velocity`    (steps, 3) rad/s     in the world
    `imu_linear_velocity`      (steps, 3) m/s       in the world
    `body_touches_terrain`     (steps,)   bool      a part other than a tyre touches the terrain
    `joint_torque`             (steps, 6) N·m       applied to joints; only for robots with non-ideal actuators
    `held_position`            (steps, n) rad       of held joints, in the order of the robot's file; also
                                                    `held_velocity` and `held_torque`; only for robots with some
    ========================== ========== ========= ============================================================

    Most arrays are views of the run's memory, which lives as long as any of them. You may write into
    them: `Estimator.run`, `fit` and `save` use the changed values.
    """

    def __init__(self, arrays: Mapping[str, np.ndarray], info: Mapping[str, Any]):
        super().__init__(arrays)
        #: `scenario`, `simulator`, `seed`, `run`, `control_period_us`, `outcome` ("finished",
        #: "timed_out", "fell", "diverged", "left_terrain", or None), `scenario_yaml`, `robot_digest`, `robot_mass` (kg; 0: unknown).
        self.info: dict[str, Any] = dict(info)

    @classmethod
    def load(cls, path: Path, mapping: Path | None = None) -> Recording:
        """Read a log in Upkie's layout (`.mpack`): a robot's, or one that touchdown wrote.

        mapping: a mapping file, for the log of another robot: a ROS 2 bag, CSV or NumPy arrays. Joints, frames, signs
            and units then are those above. What `touchdown convert` prints, such as ages of held values, are warnings.
        """
        return cls(*_touchdown.load(path, mapping))

    def save(self, path: Path) -> None:
        """Write such a log, atomically, with the same bytes as `touchdown simulate`."""
        _touchdown.save(self, self.info, path)

    @property
    def period(self) -> float:
        """Time between two steps (s)."""
        return 1e-6 * self.info["control_period_us"]

    @property
    def sample_rate(self) -> float:
        """Steps per second (Hz)."""
        return 1e6 / self.info["control_period_us"]

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self["time"])

    def __repr__(self) -> str:
        of = " of ".join(filter(None, (self.info["scenario"], self.info["simulator"]))) or "a robot's log"
        return f"<Recording: {of}, {self.steps} steps of {1e3 * self.period:g} ms>"


def simulate(scenario: Path, simulator: str = "mujoco", *, seed: int = 1, run: int | None = None,
             overrides: Mapping[str, Any] | Iterable[str] | None = None) -> Recording:
    """Simulate one run of a scenario file, as `touchdown simulate` does.

    scenario: a path, or one of the shipped ones ("scenarios/stairs.yaml")
    simulator: one of `simulators()`
    run: draws the perturbations of this run from `seed`; without it, the scenario is not perturbed
    overrides: values of the scenario to change, by dotted key: {"end.duration": 5}
    """
    return Recording(*_touchdown.simulate(scenario, simulator, seed, run, assignments(overrides)))


def contact_labels(normal_force: Any, period: float, *, robot_mass: float = 5.33922,
                   share: float = 0.019, window: float = 0.01) -> np.ndarray:
    """Contact of the wheels from their normal forces: (steps, 2) in N → (steps, 2) of bool.

    period: time between two steps (s)
    robot_mass: of the whole robot (kg)
    share: a wheel is in contact where its mean force is above this share of the robot's weight
    window: the mean is over this time around each step (s)
    """
    return _touchdown.contact_labels(normal_force, period, robot_mass, share, window)


def _several(runs: Any) -> list:
    return [runs] if isinstance(runs, (dict, str, os.PathLike)) else list(runs)


def check(log: Any, *, robot: str = "", mapping: Path | None = None) -> list[str]:
    """What is implausible about a run, one line each, as `touchdown check` prints: clock, units, signs, axes, gravity,
    loads, dead channels. An empty list: nothing.

    log: a `Recording`, or the path of a log
    robot: its file, which gives weight, legs and ranges of joints
    mapping: a mapping file, for the path of another robot's log: a ROS 2 bag, CSV or NumPy arrays. The list then begins
        with what `touchdown convert` prints about the conversion, such as ages of held values
    """
    return _touchdown.check(log, robot, mapping)


def fit(runs: Any = (), estimator: str = "robust", *, contact: Any = (), no_contact: Any = (), skip: float = 0.3,
        label_share: float = 0.019, label_window: float = 0.01) -> Model:
    """Fit an estimator's model, as `touchdown fit` does.

    runs: a `Recording` with ground truth, or a path to one, or several
    estimator: its name, as in `estimators()`
    contact, no_contact: the same, for runs in which both wheels, or neither, are in contact all the time
    skip: time at the beginning of each run that is not used (s)
    label_share, label_window: definition of contact (`contact_labels`)
    """
    declared = [(one, None) for one in _several(runs)]
    declared += [(one, True) for one in _several(contact)]
    declared += [(one, False) for one in _several(no_contact)]
    for one, _ in declared:
        if isinstance(one, dict) and not isinstance(one, Recording):
            raise InputError("fit: expected a Recording, which has scenario and seed, or a path; found a dict")
    return _touchdown.fit(declared, estimator, skip, label_share, label_window)


def score(beliefs: Any, recording: Mapping[str, np.ndarray], *, skip: float = 0.3, hold_off: float = 0.25,
          takeoff_opens: float = 0.06, landing_opens: float = 0.02,
          minimum_flight: float = 0.05) -> dict[str, dict[str, float]]:
    """Score beliefs about a run by the definitions of docs/reference/metrics.md.

    beliefs: a result of `Estimator.run`, or an array of probabilities or decisions, (steps, 2) for the
        wheels or (steps,) for both
    recording: has `contact`, (steps, 2), and its period, or `time`

    Returns a number by view ("wheels": both pooled, "left_wheel", "right_wheel", "any_wheel",
    "both_wheels") and metric ("success", "takeoff_latency_ms", …); NaN where it is not defined.
    """
    if "contact" not in recording:
        raise InputError("score: the recording has no ground truth: 'contact' is missing")
    period = recording.period if isinstance(recording, Recording) else float(np.median(np.diff(recording["time"])))
    return _touchdown.score(beliefs, recording["contact"], period, skip, hold_off, takeoff_opens, landing_opens,
                            minimum_flight)
