#!/usr/bin/env python3
"""Print the numbers of docs/results.md about drawn scenes: means over scenes and engines, and by family.

Run it on the folders of finished experiments: scripts/scene_tables.py RUN [RUN ...] [--estimators A,B]
"""

import argparse
import collections
import csv
import math
import pathlib
import re
import statistics

NOISE = ("torque_noise_nm", "accelerometer_noise_mps2")
RANKING = (("extra_switches_per_minute", 1), ("long_errors_s_per_minute", 2), ("takeoff_latency_median_ms", 1),
           ("landing_latency_median_ms", 1), ("no_contact_precision", 3), ("mean_balanced_accuracy", 3))


def rows_of(folder):
    with (pathlib.Path(folder) / "tables" / "benchmark.csv").open(encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(file) if row["fitted_on"] in ("own", "")]


def family_of(scene):
    """`slow_lifts_102_003` is number 3 of the family `slow_lifts` with seed 102."""
    return re.sub(r"_\d+_\d+$", "", scene)


def mean(rows, column):
    numbers = [float(row[column]) for row in rows if row[column] not in ("", "nan")]
    return statistics.mean(numbers) if numbers else math.nan


def short(number, decimals):
    """A number without the zero before its point, and without decimals if it is 0 or 1."""
    text = re.sub(r"^(-?)0\.", r"\1.", f"{number:.{decimals}f}")
    return {"." + decimals * "0": "0", "1." + decimals * "0": "1"}.get(text, text)


def by(rows, key):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    return groups


def table(head, lines):
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    print("".join("| " + " | ".join(line) + " |\n" for line in lines))


def intervals_of(folder):
    with (pathlib.Path(folder) / "tables" / "benchmark_standings.csv").open(encoding="utf-8", newline="") as file:
        return {(row["robot"], row["estimator"], row[NOISE[0]], row[NOISE[1]]): row for row in csv.DictReader(file)}


def print_means(folder, rows):
    intervals = intervals_of(folder)
    for robot, of_robot in by(rows, lambda row: row["robot"]).items():
        lines = []
        for estimator, own in by(of_robot, lambda row: row["estimator"]).items():
            cells = sorted(by(own, lambda row: tuple(row[name] for name in NOISE)).items())
            standings = [intervals[robot, estimator, *cell] for cell, _ in cells]
            line = [f"`{estimator}`"] + [
                f"{short(float(s['event_f1']), 3)} [{short(float(s['event_f1_low']), 3)}, "
                f"{short(float(s['event_f1_high']), 3)}]" for s in standings]
            for column, decimals in RANKING:
                line.append(" / ".join(short(float(s[column]), decimals) for s in standings))
            line.append(" / ".join(short(mean(rows, "calibration_error"), 3) for _, rows in cells))
            lines.append(line)
        scenes = len({row["scene"] for row in of_robot})
        print(f"{robot}, {scenes} scenes\n")
        table(["estimator", "F1, no noise", "F1, with noise", "extra switches/min", "long errors (s/min)", "takeoff (ms)",
               "landing (ms)", "precision of air", "balanced accuracy", "calibration error"], lines)


def print_families(rows, estimators):
    for robot, of_robot in by(rows, lambda row: row["robot"]).items():
        names = estimators or list(by(of_robot, lambda row: row["estimator"]))
        lines = []
        for family, of_family in by(of_robot, lambda row: family_of(row["scene"])).items():
            line = [family.replace("_", " ")]
            for name in names:
                own = [row for row in of_family if row["estimator"] == name]
                cells = sorted(by(own, lambda row: tuple(row[name] for name in NOISE)).items())
                line.append(" / ".join(short(mean(rows, "balanced_accuracy"), 3) for _, rows in cells))
            lines.append(line)
        print(f"{robot}, by family\n")
        table(["family"] + [f"`{name}`" for name in names], lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--estimators", type=lambda text: text.split(","), help="of the table by family")
    options = parser.parse_args()
    for folder in options.runs:
        rows = rows_of(folder)
        print_means(folder, rows)
        print_families(rows, options.estimators)


if __name__ == "__main__":
    main()
