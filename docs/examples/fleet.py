"""What is wrong with the machines of a folder? Needs numpy, and truepose in PATH (or in $TRUEPOSE).

    python3 docs/examples/fleet.py FOLDER
"""
# %% Every session of the folder in one call; a bad file stops nothing.
import json
import os
import subprocess
import sys

import numpy as np

folder = sys.argv[1] if len(sys.argv) > 1 else "sessions"
program = os.environ.get("TRUEPOSE", "truepose")
ran = subprocess.run([program, "diagnose", folder, "--json-lines"], capture_output=True, encoding="utf-8")
answers = [json.loads(line) for line in ran.stdout.splitlines()]
if not answers:
    sys.exit(ran.stderr)
for answer in answers:
    if "error" in answer:
        print("not diagnosed:", answer["error"].splitlines()[0])
answers = [answer for answer in answers if "error" not in answer]

# %% Errors as arrays: nominal, identified, with what was found; and the floor that noise allows.
steps = ["start_mm", "identified_mm", "end_mm"]
errors_mm = np.array([[answer["gap"][step] for step in steps] for answer in answers]).reshape(-1, 3)
floor_mm = np.array([answer["floor"]["mm"] for answer in answers])
order = np.argsort(-errors_mm[:, 2])
print(f"{'session':28} {'verdict':18} {'nominal':>9} {'identified':>10} {'found':>9} {'floor':>9}   mm")
for k in order:
    numbers = " ".join(f"{value:{width}.4f}" for value, width in zip([*errors_mm[k], floor_mm[k]], [9, 10, 9, 9]))
    print(f"{answers[k]['session'][:28]:28} {answers[k]['verdict']:18} {numbers}")

# %% Which names occur, how often, and how large: the median and the largest of each parameter.
sizes = {}
for answer in answers:
    for found in answer["found"]:
        for parameter in found["parameters"]:
            if parameter["value"] is not None:
                sizes.setdefault((found["effect"], parameter["name"]), []).append(parameter["value"])
for (effect, name), values in sorted(sizes.items()):
    size = np.abs(values)
    print(f"{effect:28} {name:18} {len(values):3} times, median {np.median(size):.4g}, largest {size.max():.4g}")

# %% Machines that are worse than the others: more than three robust deviations above the median.
spread = 1.4826 * np.median(np.abs(errors_mm[:, 2] - np.median(errors_mm[:, 2]))) if len(answers) else 0.0
strange = errors_mm[:, 2] > np.median(errors_mm[:, 2]) + 3 * max(spread, 1e-6) if len(answers) else []
print("to look at:", ", ".join(answers[k]["file"] for k in np.flatnonzero(strange)) or "none")
