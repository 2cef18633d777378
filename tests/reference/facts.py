"""Writes tests/data/facts/facts.json: one joint whose session has everything that an answer has to
say beside names and values. More noise than is stated, a part of it slow, three outliers, an order
that is a whole number, and an eccentricity larger than on any machine.

Run from the repository: python3 tests/reference/facts.py
"""

import json
import math
import random
from pathlib import Path

SAMPLES, SECONDS = 160, 10.0
RADIUS, HEIGHT = 250.0, 300.0
OFFSET_DEG, LENGTH_MM = 0.2, -0.5
ECCENTRICITY_DEG, ECCENTRICITY_PHASE_DEG = 0.9, 40.0
ORDER, RUNOUT_MM, RUNOUT_PHASE_DEG = 3, 0.4, 70.0
STATED_MM, WHITE_MM, SLOW_MM, TIME_CONSTANT_S = 0.02, 0.05, 0.1, 200.0
OUTLIERS = {16: (3.0, 0.0, 0.0), 70: (0.0, -2.5, 1.0), 121: (1.5, 1.5, -2.0)}

random.seed(7)
columns = {name: [] for name in ["q1_deg", "dir1", "time_s", "x_mm", "y_mm", "z_mm"]}
slow = [random.gauss(0.0, SLOW_MM) for _ in range(3)]
for k in range(SAMPLES):
    half = SAMPLES // 2
    up = k < half
    place = (k if up else SAMPLES - 1 - k) + 0.5
    q_deg = -150.0 + 300.0 * place / half
    q = math.radians(q_deg)
    # The encoder's own sine is q as a function of the true angle.
    eccentricity = math.radians(ECCENTRICITY_DEG)
    phase = math.radians(ECCENTRICITY_PHASE_DEG)
    true = q
    for _ in range(60):
        shown = math.atan2(
            math.sin(true) + eccentricity * math.sin(phase),
            math.cos(true) + eccentricity * math.cos(phase),
        )
        true += math.remainder(q - shown, math.tau)
    true += math.radians(OFFSET_DEG)
    centre = ORDER * q + math.radians(RUNOUT_PHASE_DEG)
    point = [
        (RADIUS + LENGTH_MM) * math.cos(true) + RUNOUT_MM * math.cos(centre),
        (RADIUS + LENGTH_MM) * math.sin(true) + RUNOUT_MM * math.sin(centre),
        HEIGHT,
    ]
    carry = math.exp(-SECONDS / TIME_CONSTANT_S)
    spread = SLOW_MM * math.sqrt(1.0 - carry * carry)
    slow = [carry * s + random.gauss(0.0, spread) for s in slow]
    off = OUTLIERS.get(k, (0.0, 0.0, 0.0))
    measured = [
        round(p + s + random.gauss(0.0, WHITE_MM) + o, 4) for p, s, o in zip(point, slow, off)
    ]
    values = [round(q_deg, 6), 1 if up else -1, k * SECONDS, *measured]
    for name, value in zip(columns, values):
        columns[name].append(value)

session = {
    "format": "truepose-session/1",
    "name": "facts",
    "note": "Made by tests/reference/facts.py",
    "robot": {
        "name": "column",
        "joints": [
            {"name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0]}
        ],
        "tool": {"position_mm": [RADIUS, 0, HEIGHT], "quaternion_wxyz": [1, 0, 0, 0]},
    },
    "instrument": {"name": "tracker", "sigma_mm": STATED_MM},
    "samples": {"columns": columns},
}
path = Path(__file__).parents[1] / "data" / "facts" / "facts.json"
path.parent.mkdir(exist_ok=True)
path.write_text(json.dumps(session) + "\n", encoding="utf-8")
