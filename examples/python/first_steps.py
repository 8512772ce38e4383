#!/usr/bin/env python3
# Simulate, look, fit, listen, score (docs/python.md). first_steps.py [FIGURE.png]
# %%
import sys

import numpy as np

import touchdown

# %% Two runs down some stairs: one to fit to, one to be judged on.
fitted = touchdown.simulate("scenarios/stairs.yaml", seed=1, run=0)
heard = touchdown.simulate("scenarios/stairs.yaml", seed=1, run=1)
print(heard, heard["torque"].shape, f"{1 - heard['contact'].mean():.1%} of it without contact")

# %% Two estimators that are fitted: a logistic regression on loads, and the paper's filter, made robust.
for name in ("load_logistic", "robust"):
    model = touchdown.fit(fitted, name)
    estimator = touchdown.Estimator(model=model)
    beliefs = estimator.run(heard)
    scores = touchdown.score(beliefs, heard)["wheels"]
    print(f"{name:<18} success {scores['success']:.4f}, takeoffs told after {scores['takeoff_latency_ms']:.0f} ms")

# %% The same through noisy sensors: arrays are yours to change.
noisy = touchdown.Recording(heard, heard.info)
noisy["torque"] = heard["torque"] + np.random.default_rng(1).normal(0.0, 1.0, heard["torque"].shape)
print(f"{name} under 1 N·m  success {touchdown.score(estimator.run(noisy), heard)['wheels']['success']:.4f}")

# %% A picture, where there is matplotlib.
try:
    import matplotlib
except ImportError:
    print("no matplotlib (Debian's python3-matplotlib): no picture")
    sys.exit()
matplotlib.use("Agg")
from matplotlib import pyplot

figure, (force, belief) = pyplot.subplots(2, sharex=True, figsize=(8, 4), layout="constrained")
force.plot(heard["time"], heard["normal_force"])
force.set(ylabel="normal force (N)", ylim=(0, 120))
belief.fill_between(heard["time"], heard["contact"][:, 0], color="0.9", label="contact")
belief.plot(heard["time"], beliefs["p_contact"][:, 0], label="P(contact)")
belief.set(xlabel="time (s)", ylabel="left wheel")
belief.legend(loc="lower left")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "stairs.png", dpi=120)
