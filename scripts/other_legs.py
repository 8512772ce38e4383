#!/usr/bin/env python3
"""Print the tables of docs/guides/robots.md about robots with other legs: runs finished, and the
shipped model's mean balanced accuracy with the robot's own legs (and with Upkie's).

Run it in the checkout: scripts/other_legs.py [--runs 8] [ROBOT.yaml ...]
"""

import argparse
import pathlib
import re
import statistics
import subprocess
import tempfile

ROBOTS = [f"models/{name}.yaml" for name in ("knee_and_wheel", "hip_roll", "ros_style", "five_bar", "four_bar")]
SCENARIOS = {"step": "scenarios/one_step.yaml", "stairs": "scenarios/stairs.yaml"}
ENGINES = {"MuJoCo": "mujoco", "Bullet": "bullet"}
RECALL = re.compile(r"of contact (\S+) ([^\s,]+), of no contact (\S+) ([^\s,]+)")


def output_of(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout


def score(program, recording, robot):
    """Balanced accuracy on one recording; `robot` gives the legs, Upkie's if it is None."""
    legs = ["--robot", robot or "models/upkie.xml"]
    text = output_of(program, "estimate", recording, "--model", "models/evidence_curves.npz", "--transfer", *legs)
    recalls = [(float(m[1]) + float(m[3])) / 2 for m in RECALL.findall(text)]
    return statistics.mean(recalls)


def cells(program, robot, scenario, engine, runs, folder):
    finished, own, upkies = 0, [], []
    for run in range(runs):
        recording = str(folder / "run.mpack")
        text = output_of(program, "simulate", scenario, "--set", f"robot={robot}", "--simulator", engine,
                         "--run", str(run), "--seed", "1", "-o", recording)
        if "finished" not in text:
            continue
        finished += 1
        own.append(score(program, recording, robot))
        upkies.append(score(program, recording, None))
    scores = f"{statistics.mean(own):.3f} ({statistics.mean(upkies):.3f})" if finished else "–"
    return f"{finished}/{runs}", scores.replace("0.", ".")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*", default=ROBOTS)
    parser.add_argument("--runs", type=int, default=8)
    parser.add_argument("--program", default="build/release/touchdown")
    options = parser.parse_args()
    columns = [(s, e) for s in SCENARIOS for e in ENGINES]
    head = "| | " + " | ".join(f"{s}, {e}" for s, e in columns) + " |\n|" + "---|" * (1 + len(columns))
    finished, scores = [head], [head]
    with tempfile.TemporaryDirectory() as folder:
        for robot in options.robots:
            pairs = [cells(options.program, robot, SCENARIOS[s], ENGINES[e], options.runs, pathlib.Path(folder))
                     for s, e in columns]
            name = f"| `{pathlib.Path(robot).stem}` | "
            finished.append(name + " | ".join(p[0] for p in pairs) + " |")
            scores.append(name + " | ".join(p[1] for p in pairs) + " |")
    print("\n".join(finished), "\n".join(scores), sep="\n\n")


if __name__ == "__main__":
    main()
