"""A slide read by a laser: a lead error without a name, a reversal, and noise; writes sessions/slide-lead-error.

Exact geometry in plain Python, no code of the program. The deviation of approach s (+1, -1) at position p, mm:

    d(p, s) = lead(p) - s * REVERSAL / 2 + noise,   lead: four smooth bumps on a slope that no single wave follows

Positions are uneven, as ISO 230-2 asks, so that no short period hides behind the step.

    python3 tests/reference/lead_error_slide.py [FOLDER]
"""
import json
import math
import random
import sys
from pathlib import Path

NAME = "slide-lead-error"
TRAVEL, STEP, UNEVEN = 600.0, 25.0, 6.0
RUNS = 5
REVERSAL = 0.0035
NOISE = 0.0005
# Height um, middle mm, width mm.
BUMPS = [(7.5, 95, 52), (13.2, 268, 74), (5.1, 402, 33), (-8.4, 520, 61)]
SLOPE = 0.000012


def lead(p):
    """The error of the screw at a position, mm."""
    bumps = (1e-3 * high * math.exp(-(((p - at) / wide) ** 2) / 2) for high, at, wide in BUMPS)
    return sum(bumps) + SLOPE * p


def deviation(p, side):
    """Without noise, mm."""
    return lead(p) - side * REVERSAL / 2


def rows():
    rnd = random.Random(230)
    count = round(TRAVEL / STEP)
    inner = [round(STEP * k + rnd.uniform(-UNEVEN, UNEVEN), 1) for k in range(1, count)]
    targets = [0.0, *inner, TRAVEL]
    for run in range(RUNS):
        for side in (1, -1):
            for p in targets[::side]:
                yield run + 1, p, side, p + deviation(p, side) + rnd.gauss(0, NOISE)


def main(folder):
    session = {
        "format": "truepose-session/1",
        "name": "slide with a lead error",
        "note": "Simulated by tests/reference/lead_error_slide.py: a slide of 600 mm read by a laser in five runs both ways, "
        "25 uneven positions. Hidden: a smooth lead error of 18 um that is no effect of the catalogue, "
        "a reversal of 3.5 um, and 0.5 um of noise",
        "robot": {
            "name": "slide",
            "joints": [{"name": "x", "kind": "prismatic", "axis": [1, 0, 0], "point_mm": [0, 0, 0], "limits": [0, 600]}],
            "tool": {"position_mm": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0]},
        },
        "instrument": {"name": "laser interferometer"},
        "tolerance_mm": 0.005,
        "samples": {"file": f"{NAME}.csv"},
    }
    lines = [f"{p:g},{side},{x:.5f},0,0" for _, p, side, x in rows()]
    folder.joinpath(f"{NAME}.json").write_text(json.dumps(session, indent=2) + "\n")
    folder.joinpath(f"{NAME}.csv").write_text("\n".join(["q1_mm,dir1,x_mm,y_mm,z_mm", *lines]) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "sessions"))
