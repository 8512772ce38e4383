#!/usr/bin/env python3
"""Print the table of docs/results.md about families left out of the fit: what each family loses.

Every family is tested with a fit to all families, and with one to all others. The scenes of a family are the
same in both. Run it in the checkout: scripts/left_out_families.py [--fitted 4] [--tested 6] [--seed 102]
"""

import argparse
import json
import pathlib
import random
import statistics
import subprocess

from scene_tables import NOISE, by, family_of, rows_of, short, table

EXPERIMENT = "experiments/drawn_scenes.yaml"
FIT_SEED = 101
RESAMPLES = 2000


def families(program):
    text = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    lines = text[text.index("families of drawn scenarios"):].partition("\n\n")[0].splitlines()[1:]
    return [line.split()[0] for line in lines]


def run(options, name, fitted, tested):
    """Runs the experiment with these families, unless it has finished, and returns rows of its benchmark."""
    folder = options.runs / name
    draws = [("fit", FIT_SEED, options.fitted, fitted), ("test", options.seed, options.tested, tested)]
    sets = [f"{part}.scenarios=" + json.dumps({"generate": {"seed": seed, "count": each * len(of), "families": of}})
            for part, seed, each, of in draws]
    sets += ["estimators=" + json.dumps(options.estimators), "simulators=" + json.dumps(options.simulators),
             "benchmark.robots=[]", f"seed={options.seed}"]
    words = [word for one in sets for word in ("--set", one)]
    subprocess.run([options.program, "run", EXPERIMENT, "--no-pictures", "--out", folder, *words], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return rows_of(folder)


def by_scene(rows, estimator):
    """Mean over engines, by scene and noise. Scenes in which the robot fell are left out."""
    own = [row for row in rows if row["estimator"] == estimator and row["balanced_accuracy"] != "nan"]
    groups = by(own, lambda row: (row["scene"], *(row[name] for name in NOISE)))
    return {key: statistics.mean(float(row["balanced_accuracy"]) for row in rows) for key, rows in groups.items()}


def interval(differences):
    draw = random.Random(1)
    means = sorted(statistics.mean(draw.choices(differences, k=len(differences))) for _ in range(RESAMPLES))
    return means[int(0.025 * RESAMPLES)], means[int(0.975 * RESAMPLES) - 1]


def signed(number):
    return ("−" if number < -0.0005 else "") + short(abs(number), 3)


def cell(complete, without, noise):
    pairs = [(complete[key], without[key]) for key in without if key[1:] == noise and key in complete]
    low, high = interval([after - before for before, after in pairs])
    before, after = (statistics.mean(values) for values in zip(*pairs))
    return f"{short(before, 3)} → {short(after, 3)} [{signed(low)}, {signed(high)}]"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/touchdown")
    parser.add_argument("--fitted", type=int, default=4, help="scenes of each fitted family")
    parser.add_argument("--tested", type=int, default=6, help="scenes of each tested family")
    parser.add_argument("--seed", type=int, default=102, help="of the tested scenes")
    parser.add_argument("--estimators", nargs="+", default=["evidence_curves", "decision_network"])
    parser.add_argument("--simulators", nargs="+", default=["mujoco"])
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("runs/left_out_families"))
    options = parser.parse_args()
    names = families(options.program)
    rows = run(options, "none", names, names)
    complete = {estimator: by_scene(rows, estimator) for estimator in options.estimators}
    settings = sorted({key[1:] for key in complete[options.estimators[0]]})
    lines = []
    for family in names:
        rows = run(options, family, [name for name in names if name != family], [family])
        without = {estimator: by_scene(rows, estimator) for estimator in options.estimators}
        assert all(family_of(key[0]) == family for key in without[options.estimators[0]])
        lines.append([family.replace("_", " ")] + [cell(complete[estimator], without[estimator], noise)
                                                   for estimator in options.estimators for noise in settings])
    head = [f"`{estimator}`, ({', '.join(noise)})" for estimator in options.estimators for noise in settings]
    table(["family left out"] + head, lines)


if __name__ == "__main__":
    main()
