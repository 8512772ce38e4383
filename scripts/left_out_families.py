#!/usr/bin/env python3
"""Print the table of docs/results.md about families left out of the fit: what each family loses.

A fit to all families and one to all others run on the same scenes and draws of a family. Run it in the checkout
after `make python`: PYTHONPATH=build/release/python scripts/left_out_families.py [--fitted 4] [--tested 6]
"""

import argparse
import random
import statistics
import subprocess

import touchdown

from scene_tables import NOISE, by, rows_of, short, table

FIT_SEED = 101
RESAMPLES = 2000
EXPERIMENT = {"robot": "models/upkie.xml", "sensors": "noise/profiles/upkie.yaml", "recordings": "none",
              "noise": {"torque": [0.0, 1.0], "accelerometer": [0.0, 5.0], "hips": True},
              "highlights": [{"torque": 0.0, "accelerometer": 0.0}, {"torque": 1.0, "accelerometer": 5.0}],
              "benchmark": {"robots": []}, "video": {"enabled": False}}


def families(program):
    text = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    lines = text[text.index("families of drawn scenarios"):].partition("\n\n")[0].splitlines()[1:]
    return [line.split()[0] for line in lines]


def drawn(seed, each, of):
    return {"generate": {"seed": seed, "count": each * len(of), "families": of}}


def fit(options, name, of):
    """Fits the estimators to drawn scenes of these families, and returns the folder of their models."""
    result = touchdown.run({**EXPERIMENT, "name": "left_out_" + name, "estimators": options.estimators,
                            "simulators": options.simulators, "seed": options.seed,
                            "fit": {"scenarios": drawn(FIT_SEED, options.fitted, of), "runs": 1, "servo_load": True},
                            "test": {"scenarios": ["scenarios/flat.yaml"], "runs": 1}})
    return result.path / "models"


def decider(name, file):
    """A class of an experiment that decides as this model does; the experiment finds it in this module."""
    model = touchdown.Model.load(str(file))

    def run(self, signals):
        return touchdown.Estimator(model=model, sample_rate=signals["sample_rate"]).run(signals)["contact"]

    globals()[name] = type(name, (), {"__doc__": name, "__module__": __name__, "run": run})
    return globals()[name]


def accuracies(options, family, models):
    """The balanced accuracy by estimator, models and (scene, noise), as means over engines."""
    rows = []
    fits = "_".join(folder.parent.name for folder in models.values())  # so that other fits give another run
    for engine in options.simulators:
        classes = [decider(f"{estimator}_{which}", folder / f"{engine}_{estimator}.npz")
                   for estimator in options.estimators for which, folder in models.items()]
        result = touchdown.run({**EXPERIMENT, "name": f"left_out_{engine}_{fits}", "estimators": classes,
                                "simulators": [engine], "seed": options.seed,
                                "fit": {"scenarios": ["scenarios/flat.yaml"], "runs": 1},
                                "test": {"scenarios": drawn(options.seed, options.tested, [family]), "runs": 1}})
        rows += rows_of(result.path)
    scored = [row for row in rows if row["balanced_accuracy"] != "nan"]  # without runs that fell
    groups = by(scored, lambda row: (row["estimator"].rpartition(".")[2], row["scene"], *(row[name] for name in NOISE)))
    return {key: statistics.mean(float(row["balanced_accuracy"]) for row in rows) for key, rows in groups.items()}


def interval(differences):
    draw = random.Random(1)
    means = sorted(statistics.mean(draw.choices(differences, k=len(differences))) for _ in range(RESAMPLES))
    return means[int(0.025 * RESAMPLES)], means[int(0.975 * RESAMPLES) - 1]


def signed(number):
    return ("−" if number < -0.0005 else "") + short(abs(number), 3)


def change(complete, without):
    differences = [after - before for before, after in zip(complete, without)]
    low, high = interval(differences)
    return f"{signed(statistics.mean(differences))} [{signed(low)}, {signed(high)}]"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/touchdown")
    parser.add_argument("--fitted", type=int, default=4, help="scenes of each fitted family")
    parser.add_argument("--tested", type=int, default=6, help="scenes of each tested family")
    parser.add_argument("--seed", type=int, default=102, help="of the tested scenes")
    parser.add_argument("--estimators", nargs="+", default=["evidence_curves", "decision_network"])
    parser.add_argument("--simulators", nargs="+", default=["mujoco", "bullet"])
    parser.add_argument("--only", nargs="+", help="these families")
    options = parser.parse_args()
    names = families(options.program)
    complete = fit(options, "none", names)
    lines = []
    for family in options.only or names:
        models = {"all": complete, "others": fit(options, family, [name for name in names if name != family])}
        found = accuracies(options, family, models)
        line = [family.replace("_", " ")]
        for estimator in options.estimators:
            cells = []
            for noise in sorted({key[2:] for key in found}):
                cells.append([[found[key] for key in sorted(found) if key[0] == f"{estimator}_{which}" and key[2:] == noise]
                              for which in models])
            line += [" / ".join(short(statistics.mean(without), 3) for _, without in cells),
                     " / ".join(change(*cell) for cell in cells)]
        lines.append(line)
    table(["family left out", *(title for name in options.estimators for title in (f"`{name}`", "change"))], lines)


if __name__ == "__main__":
    main()
