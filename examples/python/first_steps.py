#!/usr/bin/env python3
# Simulate, look, estimate, fit, score (docs/reference/python.md). first_steps.py [FIGURE.png]
# %%
import sys

import numpy as np

import touchdown

# %% Two runs down some stairs: one for fitting, one for testing.
fitted = touchdown.simulate("scenarios/stairs.yaml", seed=1, run=0)
run = touchdown.simulate("scenarios/stairs.yaml", seed=1, run=1)
print(run, run["torque"].shape, f"{1 - run['contact'].mean():.1%} without contact")

# %% The robust form of the paper's filter, which is fitted, and the filter of loads, which needs no fit.
estimators = {"robust": touchdown.Estimator(model=touchdown.fit(fitted, "robust")),
              "load_filter": touchdown.Estimator("load_filter")}  # of your robot: robot="mine.yaml"
for name, estimator in estimators.items():
    beliefs = estimator.run(run)
    scores = touchdown.score(beliefs, run)["wheels"]
    print(f"{name:<18} success {scores['success']:.4f}, mean takeoff latency {scores['takeoff_latency_ms']:.0f} ms")

# %% The same with torque noise: arrays may be changed.
noisy = touchdown.Recording(run, run.info)
noisy["torque"] = run["torque"] + np.random.default_rng(1).normal(0.0, 1.0, run["torque"].shape)
print(f"{name} under 1 N·m  success {touchdown.score(estimator.run(noisy), run)['wheels']['success']:.4f}")

# %% A figure, if matplotlib is installed.
try:
    import matplotlib
except ImportError:
    print("no matplotlib (Debian's python3-matplotlib): no picture")
    sys.exit()
matplotlib.use("Agg")
from matplotlib import pyplot

figure, (force, belief) = pyplot.subplots(2, sharex=True, figsize=(8, 4), layout="constrained")
force.plot(run["time"], run["normal_force"])
force.set(ylabel="normal force (N)", ylim=(0, 120))
belief.fill_between(run["time"], run["contact"][:, 0], color="0.9", label="contact")
belief.plot(run["time"], beliefs["p_contact"][:, 0], label="P(contact)")
belief.set(xlabel="time (s)", ylabel="left wheel")
belief.legend(loc="lower left")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "stairs.png", dpi=120)
