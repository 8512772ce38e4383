#!/usr/bin/env python3
# Your own estimator beside `robust`: on one run, then in an experiment (docs/reference/python.md).
# %%
import numpy as np

import touchdown


# %% Ten lines: a falling robot has no contact, and a loaded knee means contact.
class FallsOrPushes:
    """Contact if the knee bears load, or the robot does not fall."""
    title = "Falls or pushes"
    sensors = ("knee_torque", "acceleration")  # the sensors that it uses

    def run(self, signals):
        rate = 0.02 * signals["sample_rate"]  # steps of a mean over 20 ms
        mean = np.ones(int(rate)) / int(rate)
        upwards = np.convolve(signals["vertical_acceleration"], mean)[: len(signals["time"])]
        knees = np.stack([np.convolve(signals["torque"][:, i], mean)[: len(upwards)] for i in (1, 4)], axis=1)
        return 1.0 / (1.0 + np.exp(-(upwards[:, None] + 4.9) - 4.0 * (np.abs(knees) - 0.5)))


# %% On one run.
fitted = touchdown.simulate("scenarios/stairs.yaml", run=0)
run = touchdown.simulate("scenarios/stairs.yaml", run=1)
robust = touchdown.Estimator(model=touchdown.fit(fitted, "robust"))
for name, beliefs in (("robust", robust.run(run)),
                      ("mine", FallsOrPushes().run({**run, "sample_rate": run.sample_rate}))):
    print(f"{name:<8} success {touchdown.score(beliefs, run)['wheels']['success']:.4f}")

# %% In an experiment: more runs, optionally both engines, with noise and confidence intervals.
result = touchdown.run({
    "name": "own_estimator", "simulators": ["mujoco"], "estimators": ["robust", FallsOrPushes],
    "fit": {"scenarios": ["scenarios/stairs.yaml", "scenarios/push_off.yaml"]},
    "test": {"scenarios": ["scenarios/stairs.yaml"], "runs": 4},
    "noise": {"torque": [0, 1], "accelerometer": [0, 5], "seeds": 2}, "recordings": "none", "video": {"enabled": False}})
table = result.tables["success"]
for row in range(len(table["estimator"])):
    print(f"{table['estimator'][row]:<34} {table['torque_noise_nm'][row]:g} N·m, "
          f"{table['accelerometer_noise_mps2'][row]:g} m/s²: {table['success'][row]:.4f} "
          f"[{table['success_low'][row]:.4f}, {table['success_high'][row]:.4f}]")
