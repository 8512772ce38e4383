#!/usr/bin/env python3
# How much labelled data does an estimator need? Fitted to 2, 20, 120, 1200 s of runs, judged on others
# (docs/estimator.md). labelled_seconds.py [--seconds 2 20] [--estimators robust] [--draws 3]
# %%
import argparse

import numpy as np

import touchdown

FITTED = ("stairs", "push_off", "lift_slowly", "hop", "roam")
JUDGED = FITTED + ("kerb", "kerb_turn", "ramp_jump", "put_down", "washboard", "squat", "pushed", "hang")
STRETCH = 2.0  # s, of one run each
NOISE = ((0.0, 0.0), (1.0, 5.0))  # N·m, m/s²


def stretch(number, draw, simulator, length):
    """Some seconds of a run of its own, about its first flight if it has one."""
    scene = FITTED[number % len(FITTED)]
    run = touchdown.simulate(f"scenarios/{scene}.yaml", simulator, seed=1000 + draw, run=number)
    air = np.flatnonzero(~run["contact"].all(axis=1) & (run["time"] > 0.5))
    middle = air[0] if len(air) else run.steps // 2
    steps = round(length / run.period)
    begin = min(max(0, middle - steps // 2), max(0, run.steps - steps))
    return touchdown.Recording({name: values[begin:begin + steps].copy() for name, values in run.items()}, run.info)


def noisy(run, torque, acceleration, seed):
    draws = np.random.default_rng(seed)
    heard = touchdown.Recording(run, run.info)
    heard["torque"] = run["torque"] + draws.normal(0.0, torque, run["torque"].shape)
    heard["vertical_acceleration"] = run["vertical_acceleration"] + draws.normal(0.0, acceleration, run.steps)
    return heard


def balanced_accuracy(contact, truth):
    """Mean of the two recalls, both wheels together; of one where there is one state only."""
    recalls = [(contact[truth == state] == state).mean() for state in (False, True) if (truth == state).any()]
    return float(np.mean(recalls))


# %%
parser = argparse.ArgumentParser(description="How much labelled data does an estimator need?")
parser.add_argument("--seconds", type=float, nargs="+", default=[2, 20, 120, 1200])
parser.add_argument("--estimators", nargs="+", default=["robust", "phase", "load_logistic", "touchdown"])
parser.add_argument("--scenes", nargs="+", default=JUDGED)
parser.add_argument("--simulator", default="mujoco")
parser.add_argument("--draws", type=int, default=3, help="fits to other runs")
asked = parser.parse_args()

judged = [touchdown.simulate(f"scenarios/{scene}.yaml", asked.simulator, seed=5, run=run)
          for scene in asked.scenes for run in range(2)]
runs = {noise: [noisy(run, *noise, seed) for seed, run in enumerate(judged)] for noise in NOISE}
most = max(asked.seconds)
fitted = [[stretch(number, draw, asked.simulator, min(STRETCH, most)) for number in range(max(1, round(most / STRETCH)))]
          for draw in range(asked.draws)]

# %% Mean over scenes of balanced accuracy, without and with noise; of the draws the mean, the worst and the best.
print("estimator          seconds" + "".join(f"   {torque:g} N·m, {acceleration:g} m/s²" for torque, acceleration in NOISE))
for estimator in asked.estimators:
    for seconds in asked.seconds:
        scores = {noise: [] for noise in NOISE}
        for draw in range(asked.draws):
            stretches = fitted[draw][:max(1, round(seconds / STRETCH))]
            listener = touchdown.Estimator(model=touchdown.fit(stretches, estimator, skip=0.0))
            for noise in NOISE:
                scores[noise].append(np.mean([
                    balanced_accuracy(listener.run(heard)["contact"][300:], run["contact"][300:])
                    for heard, run in zip(runs[noise], judged)]))
        print(f"{estimator:<18} {seconds:7g}" + "".join(
            f"   {np.mean(found):.3f} [{min(found):.3f}, {max(found):.3f}]" for found in scores.values()), flush=True)
