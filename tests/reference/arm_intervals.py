"""How often the 95 % intervals of an arm's geometry hold the truth: numpy, from the equations that `truepose effects` prints and
sharing nothing with src/; the arms are those of arms.py, the sessions those of arm_rates.py.

    python tests/reference/arm_intervals.py BINARY [--count N] [--kinds six,seven] [--poses 60,200] [--seed S]

What the samples cannot tell apart is held at zero by the program, and said. A first session without errors shows
which parameters these are; the errors of all others are drawn (zeros 0.2 degrees or 0.2 mm, axes 0.3 mm and 0.5 mrad,
tool 5 mm, targets 0.05 mm, one standard deviation each), so that the true value of each is known.
"""

import argparse
import json
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

from arm_rates import Session
from arms import ARMS, R, TARGETS

SIZES = {"offset_deg": 0.2, "offset_mm": 0.2, "x_mm": 0.3, "y_mm": 0.3, "about_x_mrad": 0.5, "about_y_mrad": 0.5}
GEOMETRY = ("joint-zero-offset", "link-geometry")


def across(axis):
    """The directions x and y of link geometry: the base axis least parallel to the joint's, and axis cross x."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    least = np.eye(3)[np.argmin(np.round(np.abs(axis), 12))]
    x = least - (least @ axis) * axis
    x /= np.linalg.norm(x)
    return x, np.cross(axis, x)


def identified(binary, folder, session):
    session.write(folder, "s", [], None)
    command = [binary, "identify", str(folder / "s.json"), "--json"]
    out = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(out.stdout)["parameters"]


def with_errors(name, poses, rng, errors, tool, own):
    """A session with these errors alone: {(effect, joint, parameter): value}."""
    session = Session(name, poses, rng)
    arm = session.arm
    x = np.zeros(arm.size)
    offset = np.zeros(arm.n)
    for (effect, joint, parameter), value in errors.items():
        kind, axis = arm.joints[joint - 1][:2]
        along = dict(zip("xy", across(axis)))
        if effect == "joint-zero-offset":
            offset[joint - 1] = np.radians(value) if kind == R else value
        else:
            turns = parameter.startswith("about")
            first = 6 * (joint - 1) + (0 if turns else 3)
            letter = parameter[6] if turns else parameter[0]
            x[first : first + 3] += (1e-3 if turns else 1.0) * value * along[letter]
    x[6 * arm.n + 6 :] = (tool + own).ravel()
    session.x = x
    commanded = session.q
    session.turned = lambda effects: commanded + offset
    return session


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--kinds", default=",".join(ARMS))
    parser.add_argument("--poses", default="60,200")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    for poses in map(int, args.poses.split(",")):
        held, all_of = Counter(), Counter()
        for k, name in enumerate(args.kinds.split(",")):
            rng = np.random.default_rng([args.seed, poses, k])
            nothing = np.zeros((len(TARGETS), 3))
            first = identified(args.binary, folder, with_errors(name, poses, rng, {}, nothing[0], nothing))
            known = [p for p in first if p["effect"] in GEOMETRY and p["ci95"] is not None]
            for _ in range(args.count):
                errors = {
                    (p["effect"], p["joint"], p["name"]): rng.normal(0, SIZES[p["name"]]) for p in known
                }
                tool, own = rng.normal(0, 5, 3), rng.normal(0, 0.05, (len(TARGETS), 3))
                session = with_errors(name, poses, rng, errors, tool, own)
                for p in identified(args.binary, folder, session):
                    truth = errors.get((p["effect"], p.get("joint"), p["name"]))
                    if p["effect"] == "tool-position":
                        letter = "xyz".index(p["name"][0])
                        which = list(TARGETS).index(p["target"]) if p.get("target") else None
                        truth = tool[letter] if which is None else own[which][letter]
                    if truth is None or p["ci95"] is None:
                        continue
                    kind = "targets" if p.get("target") else p["effect"]
                    low, high = p["ci95"]
                    all_of[kind, name] += 1
                    held[kind, name] += low <= truth <= high
        kinds = sorted({kind for kind, _ in all_of})
        for kind in kinds:
            of = {name: (held[kind, name], n) for (k, name), n in all_of.items() if k == kind}
            right, n = (sum(v[i] for v in of.values()) for i in (0, 1))
            each = ", ".join(f"{name} {100 * a / b:.1f}" for name, (a, b) in of.items())
            print(f"{poses} poses, {kind}: {right} of {n} = {100 * right / n:.1f} % ({each})", flush=True)


if __name__ == "__main__":
    main()
