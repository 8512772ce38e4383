#!/usr/bin/env python3
# How much labelled data does an estimator need? Fits to 2, 20, 120, 1200 s of runs and tests on others
# (docs/estimator.md). labelled_seconds.py [--seconds 2 20] [--estimators robust] [--draws 3]
# %%
import argparse

import numpy as np

import touchdown

FITTED = ("stairs", "push_off", "lift_slowly", "hop", "roam")
TESTED = FITTED + ("kerb", "kerb_turn", "ramp_jump", "put_down", "washboard", "squat", "pushed", "hang")
SEGMENT = 2.0  # s; each segment is of another run
NOISE = ((0.0, 0.0), (1.0, 5.0))  # N·m, m/s²


def segment(number, draw, simulator, length):
    """Some seconds of one run, around its first flight if it has one."""
    scene = FITTED[number % len(FITTED)]
    run = touchdown.simulate(f"scenarios/{scene}.yaml", simulator, seed=1000 + draw, run=number)
    air = np.flatnonzero(~run["contact"].all(axis=1) & (run["time"] > 0.5))
    middle = air[0] if len(air) else run.steps // 2
    steps = round(length / run.period)
    begin = min(max(0, middle - steps // 2), max(0, run.steps - steps))
    return touchdown.Recording({name: values[begin:begin + steps].copy() for name, values in run.items()}, run.info)


def noisy(run, torque, acceleration, seed):
    draws = np.random.default_rng(seed)
    noisy_run = touchdown.Recording(run, run.info)
    noisy_run["torque"] = run["torque"] + draws.normal(0.0, torque, run["torque"].shape)
    noisy_run["vertical_acceleration"] = run["vertical_acceleration"] + draws.normal(0.0, acceleration, run.steps)
    return noisy_run


def balanced_accuracy(contact, truth):
    """Mean of the two recalls, both wheels pooled; one recall if there is only one state."""
    recalls = [(contact[truth == state] == state).mean() for state in (False, True) if (truth == state).any()]
    return float(np.mean(recalls))


# %%
parser = argparse.ArgumentParser(description="How much labelled data does an estimator need?")
parser.add_argument("--seconds", type=float, nargs="+", default=[2, 20, 120, 1200])
parser.add_argument("--estimators", nargs="+", default=["robust", "phase", "load_logistic", "touchdown"])
parser.add_argument("--scenes", nargs="+", default=TESTED)
parser.add_argument("--simulator", default="mujoco")
parser.add_argument("--draws", type=int, default=3, help="number of fits, each to other runs")
options = parser.parse_args()

tested = [touchdown.simulate(f"scenarios/{scene}.yaml", options.simulator, seed=5, run=run)
          for scene in options.scenes for run in range(2)]
runs = {noise: [noisy(run, *noise, seed) for seed, run in enumerate(tested)] for noise in NOISE}
most = max(options.seconds)
fitted = [[segment(number, draw, options.simulator, min(SEGMENT, most)) for number in range(max(1, round(most / SEGMENT)))]
          for draw in range(options.draws)]

# %% Balanced accuracy, averaged over scenes, without and with noise: mean [worst, best] of the draws.
print("estimator          seconds" + "".join(f"   {torque:g} N·m, {acceleration:g} m/s²" for torque, acceleration in NOISE))
for estimator in options.estimators:
    for seconds in options.seconds:
        scores = {noise: [] for noise in NOISE}
        for draw in range(options.draws):
            segments = fitted[draw][:max(1, round(seconds / SEGMENT))]
            fitted_estimator = touchdown.Estimator(model=touchdown.fit(segments, estimator, skip=0.0))
            for noise in NOISE:
                scores[noise].append(np.mean([
                    balanced_accuracy(fitted_estimator.run(noisy_run)["contact"][300:], run["contact"][300:])
                    for noisy_run, run in zip(runs[noise], tested)]))
        print(f"{estimator:<18} {seconds:7g}" + "".join(
            f"   {np.mean(found):.3f} [{min(found):.3f}, {max(found):.3f}]" for found in scores.values()), flush=True)
