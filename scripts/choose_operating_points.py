#!/usr/bin/env python3
"""Choose the thresholds of the shipped model's operating points and print them with their scores.

Balanced: the best balanced accuracy, mean over the robots of the fit, drawn scenes, engines and both noises,
among the points with at most 22 extra switches a minute on crouched legs under noise. Quiet: with at most 10.
Two thirds of them are in scenes where wheels rock: rubble, light robots, hard tyres.
The named scenes, without noise, are printed beside and do not decide.

Run it in the checkout: scripts/choose_operating_points.py [--program build/release/touchdown]
"""

import argparse
import collections
import csv
import pathlib
import statistics
import subprocess
import tempfile

from scene_tables import table

EXPERIMENT = "experiments/shipped_operating_points.yaml"
ROBOTS = ["upkie.xml", "upkie_actuated.yaml", "upkie_straight.yaml", "upkie_straight_actuated.yaml"]
NAMED = ["stairs", "roam", "lift_slowly", "hop", "kerb"]
CROUCHED = 2  # the first of them
MOST_SWITCHES = {"balanced": 22.0, "quiet": 10.0}  # per minute, on crouched legs under noise


def rows_of(program, folder, name, *settings):
    """Rows of a run's table `name`."""
    flags = [flag for setting in settings for flag in ("--set", setting)]
    subprocess.run([program, "run", EXPERIMENT, "--no-pictures", "--out", folder, *flags],
                   stdout=subprocess.DEVNULL, check=True)
    with open(pathlib.Path(folder) / "tables" / name, newline="") as file:
        return list(csv.DictReader(file))


def point_of(row):
    return float(row["leave_below"]), float(row["return_above"]), float(row["settle_at"])


def is_noisy(row):
    return float(row["torque_noise_nm"]) > 0.0


def is_scored(row):
    """Whether a row is of other thresholds than the model's own, and of both noises or of neither."""
    return row["estimator"] == "shipped" and row["leave_below"] and \
        is_noisy(row) == (float(row["accelerometer_noise_mps2"]) > 0.0)


def choose(accuracies, switches, most):
    """The best point by mean accuracy among those with at most so many switches on crouched legs."""
    allowed = [point for point in accuracies if statistics.mean(switches[point][:CROUCHED]) <= most]
    return max(allowed, key=lambda point: statistics.mean(accuracies[point]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/touchdown")
    program = parser.parse_args().program
    accuracies = collections.defaultdict(list)  # of each point, by robot and noise
    switches = collections.defaultdict(list)    # under noise, by robot
    with tempfile.TemporaryDirectory() as folder:
        for robot in ROBOTS:
            rows = rows_of(program, f"{folder}/{robot}", "operating_points.csv", f"robot=models/{robot}")
            for row in filter(is_scored, rows):
                accuracies[point_of(row)].append(float(row["balanced_accuracy"]))
                if is_noisy(row):
                    switches[point_of(row)].append(float(row["extra_switches_per_minute"]))
        files = ", ".join(f"scenarios/{scene}.yaml" for scene in NAMED)
        named = collections.defaultdict(lambda: collections.defaultdict(list))  # of each point, by scene
        for row in rows_of(program, f"{folder}/named", "operating_points_by_scene.csv", f"test.scenarios=[{files}]",
                           "test.runs=6", "noise.torque=[0]", "noise.accelerometer=[0]",
                           "highlights=[{torque: 0, accelerometer: 0}]"):
            if is_scored(row):
                named[point_of(row)][row["scenario"]].append(float(row["balanced_accuracy"]))
    scenes = list(next(iter(named.values())))
    cells = ["leave_below, return_above, settle_at", *(f"{pathlib.Path(robot).stem}, {noise}" for robot in ROBOTS
                                            for noise in ("no noise", "(1, 5)")),
             *(f"switches, {pathlib.Path(robot).stem}" for robot in ROBOTS), *scenes]
    table(cells, [[f"{point[0]:g}, {point[1]:g}, {point[2]:g}", *(f"{x:.4f}" for x in accuracies[point]),
                   *(f"{x:.1f}" for x in switches[point]),
                   *(f"{statistics.mean(named[point][scene]):.4f}" for scene in scenes)]
                  for point in sorted(accuracies)])
    for name, most in MOST_SWITCHES.items():
        point = choose(accuracies, switches, most)
        print(f"{name}: leave_below {point[0]:g}, return_above {point[1]:g}, settle_at {point[2]:g} (0: none)")


if __name__ == "__main__":
    main()
