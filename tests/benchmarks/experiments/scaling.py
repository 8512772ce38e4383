#!/usr/bin/env python3
"""How time and memory of an experiment grow with its cells, seeds and duration.

tests/benchmarks/experiments/scaling.py build/release/touchdown docs/images/performance

Runs small noise studies from the checkout's root, one growing at a time, and draws the processor
seconds (user time, which other programs on the machine change little) and the largest memory of
each as <stem>.png, with <stem>.dat and <stem>.gp beside.
"""
import os
import subprocess
import sys
import tempfile

program, stem = os.path.abspath(sys.argv[1]), sys.argv[2]

EXPERIMENT = """name: scaling
estimators: [robust, reference, paper, measurement_only, load_filter, upkie_observer, nmn, free_fall]
fit: {{scenarios: [scenarios/stairs.yaml], runs: 1, perturbed: false}}
test: {{scenarios: [{scenario}], runs: 2}}
noise: {{torque: {torque}, accelerometer: {accelerometer}, seeds: {seeds}}}
video: {{enabled: false}}
"""

SCENARIO = """name: drive
terrain: {{pieces: [{{flat: {{length: 100.0}}}}]}}
velocity: [{{time: 1.0, velocity: 0.5}}]
end: {{duration: {duration}}}
perturbation: {{velocity: 0.1}}
"""


def levels(count, last):
    return [round(last * i / (count - 1), 6) for i in range(count)]


def measure(side=7, seeds=2, duration=12.0):
    """Processor seconds and megabytes of one study of side × side cells; the better of two."""
    best = (float("inf"), float("inf"))
    for _ in range(2):
        with tempfile.TemporaryDirectory() as folder:
            scenario, experiment = folder + "/drive.yaml", folder + "/scaling.yaml"
            with open(scenario, "w") as file:
                file.write(SCENARIO.format(duration=duration))
            with open(experiment, "w") as file:
                file.write(EXPERIMENT.format(scenario=scenario, torque=levels(side, 4.0),
                                             accelerometer=levels(side, 12.0), seeds=seeds))
            child = subprocess.Popen([program, "run", experiment, "--out", folder + "/out",
                                      "--no-pictures"],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
            if status != 0:
                sys.exit("the experiment failed")
            best = (min(best[0], usage.ru_utime), min(best[1], usage.ru_maxrss / 1024.0))
    return best


sweeps = {
    "cells": [(side * side, measure(side=side, seeds=4)) for side in (3, 7, 13, 18, 23, 27)],
    "noise seeds": [(seeds, measure(seeds=seeds)) for seeds in (1, 2, 4, 8, 16)],
    "seconds per run": [(duration, measure(duration=duration))
                        for duration in (5.0, 10.0, 20.0, 40.0)],
}

with open(stem + ".dat", "w") as file:
    for name, rows in sweeps.items():
        file.write(f"# {name}\tprocessor_s\tmemory_mb\n")
        for x, (seconds, megabytes) in rows:
            file.write(f"{x:g}\t{seconds:.2f}\t{megabytes:.0f}\n")
            print(f"{name:16} {x:6g}  {seconds:7.2f} s  {megabytes:5.0f} MB")
        file.write("\n\n")

name = os.path.basename(stem)
with open(stem + ".gp", "w") as file:
    file.write(f"""set terminal pngcairo size 1100,380 font 'DejaVu Sans,9'
set output '{name}.png'
set multiplot layout 1,3 margins 0.06,0.94,0.15,0.9 spacing 0.1
set yrange [0:*]
set y2range [0:*]
set xrange [0:*]
set ytics nomirror
set y2tics
set grid ytics lc rgb '#e0e4e8'
set key bottom right
""")
    for index, axis in enumerate(sweeps):
        file.write(f"""set xlabel '{axis}'
set ylabel '{"processor time (s)" if index == 0 else ""}'
set y2label '{"largest memory (MB)" if index == 2 else ""}'
plot '{name}.dat' index {index} using 1:2 with linespoints pt 7 lw 2 lc rgb '#1f5fa8' title 'time', \\
     '' index {index} using 1:3 axes x1y2 with linespoints pt 5 lw 2 dt 2 lc rgb '#c0392b' title 'memory'
""")
    file.write("unset multiplot\n")
subprocess.run(["gnuplot", name + ".gp"], cwd=os.path.dirname(os.path.abspath(stem)), check=True)
