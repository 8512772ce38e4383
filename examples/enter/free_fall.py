#!/usr/bin/env python3
# Free fall means no contact. free_fall.py SIGNALS BELIEFS (docs/guides/enter.md)
import csv, math, pathlib, sys
import numpy as np

signals, beliefs = map(pathlib.Path, sys.argv[1:])
for row in csv.DictReader((signals / "index.csv").open()):
    if row["role"] != "test":  # "fit": to learn from
        continue
    run = np.load(signals / row["file"])
    steps = zip(*(run[name].tolist() for name in ("time", "has_record", "vertical_acceleration")))
    gain = -math.expm1(-float(row["control_period_s"]) / 0.01)  # of a low-pass of 10 ms
    acceleration, p, lines = 0.0, 0.5, ["time,p_left,p_right"]
    for time, has_record, upwards in steps:
        if has_record and math.isfinite(upwards):
            acceleration += gain * (upwards - acceleration)
            p = 1 / (1 + math.exp(-(acceleration + 4.9)))  # half way from standing to falling
        lines.append(f"{time},{p},{p}")
    out = (beliefs / row["file"]).with_suffix(".csv")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(lines) + "\n")
