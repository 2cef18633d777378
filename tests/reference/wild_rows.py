#!/usr/bin/env python3
"""What the program says of mistakes in the rows of a session, and of sessions without one.

    tests/reference/wild_rows.py BINARY [--count 100] [--kinds slip-axis,clean-arm,…] [--keep FOLDER]

Sessions come from exact geometry (product of exponentials, nothing linearised) that shares nothing with
the program: one axis and six-joint arms, swept, in random order, with and without a frame of their own.
Each kind makes one mistake that people make, or none. A line for each kind: in how many sessions it was
said, in how many something else was said, how many ended with a name, and how far the identified model
is from where it is without the mistake.

Measured in November 2026:

"said" is that the mistake was named, "else" sessions in which something else was said, "names" sessions with
a name of an effect (right in `sorted` only, where a drift is hidden), "end/floor" the median of the final
error over the floor.

100 sessions a kind; "before" is of 25 sessions of the program before these checks:

| kind | said before | said now | else now | names before | names now | end/floor before | end/floor now |
| --- | --- | --- | --- | --- | --- | --- | --- |
| nothing wrong, axis (30 to 200 poses, some without a clock, some with two digits) | – | – | 0 | 0 | 0 | 0.99 | 0.99 |
| nothing wrong, arm | – | – | 0 | 0 | 0 | 0.91 | 0.93 |
| poor poses and large true errors, arm (14 to 60 poses) | – | – | 0 | 8 | 0 | 0.97 | 0.98 |
| rows shifted, axis | 0 of 25 | 64 of 64 (90 of 100 before a point lost near the end was found) | 0 | 8 of 25 | 0 | 4406 | 0.98 |
| rows shifted, arm | | 64 of 64 (90 of 100) | 0 | | 1 | | 0.95 |
| copies, axis | 0 of 25 | 100 | 0 | 0 | 0 | 3 · 10⁷ | 1.00 |
| copies, arm | | 100 | 0 | | 1 | | 0.95 |
| sorted by angle, drift, axis | 0 of 25 | 100 | 0 | 2 of 25 right | 100 | 10.2 | 0.99 |
| rounded, axis (0.2 to 0.025 mm) | 0 of 25 | 100 | 0 | 0 | 1 | 1.35 | 0.96 |
| rounded, arm (0.025 mm need not be said) | | 75 of 75 | 0 | | 0 | | 0.96 |
| sign of speed, axis | 0 of 25 | 100 | 0 | 0 | 1 | 1.00 | 0.99 |
| loads in grams, axis | | 100 | 0 | | 0 | | 1.00 |
| target 1.5 to 2.3 mm off, axis | 0 of 25 | 100 | 0 | 0 | 0 | 38 | 0.99 |
| target 1.5 to 2.3 mm off, arm | 0 of 25 | 100 | 0 | 0 | 0 | 0.96 | 0.95 |

The kinds below came later; "before" is again of 25 sessions of the program before their checks:

| kind | said before | said now | else now | names before | names now | noise before | noise now | end/floor before | end/floor now |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
| a joint value of −999, axis / arm | 0 / 0 | 100 / 100 | 0 / 0 | 0 / 0 | 0 / 0 | 10 / 0 of 25 | 100 / 98 | 2403 / 3657 | 0.99 / 0.96 |
| a joint value of 0 that was none, axis / arm (on an arm they are outliers) | 0 | 100 | 0 / 32 | 0 / 0 | 0 / 1 | 7 / 0 of 25 | 99 / 95 | 4136 / 1483 | 0.99 / 0.94 |
| temperatures of 0 that were none | 0 | 100 | 0 | 0 | 0 | 25 of 25 | 100 | 0.99 | 0.99 |
| gradians, axis / arm | 0 / 0 | 100 / 100 | 0 / 0 | 25 / 20 of 25 | 0 / 1 | 0 / 0 | 100 / 98 | 0.97 / 0.97 | 0.99 / 0.95 |
| a joint in turns, axis / arm | 0 / 0 | 100 / 100 | 0 / 1 | 19 / 14 of 25 | 1 / 1 | 0 / 0 | 99 / 99 | 1.01 / 3.30 | 1.00 / 0.95 |
| values of a motor or counts of an encoder, axis / arm | 0 / 0 | 100 / 100 | 0 / 0 | 0 / 0 | 0 / 0 | 0 / 0 | 98 / 100 | 10502 / 6223 | 0.99 / 0.95 |
| one coordinate in metres, inches or micrometres, axis / arm | 0 / 0 | 100 / 100 | 0 / 0 | 0 / 0 | 0 / 0 | 0 / 0 | 100 / 100 | 5857 / 6320 | 0.99 / 0.96 |
| targets as places in the base frame, axis / arm (the tool takes it up; what is corrected is off) | 0 / 0 | 100 / 100 | 0 / 0 | 0 / 0 | 0 / 0 | 25 / 24 of 25 | 100 / 97 | 0.95 / 0.94 | 0.98 / 0.95 |
| two to six signs and homes, some with a parallelogram or the columns reversed, arm | 0 | 100 | 0 | 1 of 25 | 0 | 2 of 25 | 99 | 4175 | 0.95 |
| 13 to 25 % of the points off by millimetres, axis / arm | 0 / 0 | 100 / 100 | 0 / 0 | 0 / 0 | 0 / 0 | 25 / 24 of 25 | 99 / 98 | 0.98 / 0.95 | 0.99 / 0.94 |
| a slide in inches | 0 | 100 | 0 | 22 of 25 | 0 | 3 of 25 | 100 | 0.99 | 1.00 |
| a bent guide (to be unexplained) | – | – | 0 | 1 of 25 | 0 | 7 of 25 | 0 | 3.71 | 3.71 |
| a straight guide | – | – | 0 | 0 | 0 | 25 of 25 | 99 | 0.98 | 1.01 |

The eight names of poor poses ("before": of 100 sessions) were taken up by what priors of the geometry left of robots
that are farther off than those know.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np


def rotation(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class Arm:
    """Joints as lines at home; a pose is the product of their turns."""

    def __init__(self, axes, points, tool):
        self.axes = [np.array(a, float) for a in axes]
        self.points = [np.array(p, float) for p in points]
        self.tool = np.array(tool, float)

    def pose(self, q):
        turn, shift = np.eye(3), np.zeros(3)
        for axis, point, angle in zip(self.axes, self.points, q):
            own = rotation(axis, angle)
            turn, shift = turn @ own, turn @ (point - own @ point) + shift
        return turn, shift

    def point(self, q, target):
        turn, shift = self.pose(q)
        return turn @ (self.tool + target) + shift

    def spoilt(self, rng, mm, mrad):
        """The same with every line a little off."""
        axes = [a + rng.normal(0, mrad * 1e-3, 3) for a in self.axes]
        points = [p + rng.normal(0, mm, 3) for p in self.points]
        return Arm([a / np.linalg.norm(a) for a in axes], points, self.tool + rng.normal(0, mm, 3))


SIX = Arm(
    [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0]],
    [[0, 0, 0], [25, 0, 400], [25, 0, 850], [25, 0, 885], [445, 0, 885], [445, 0, 885]],
    [535, 0, 885],
)
AXIS = Arm([[0, 0, 1]], [[0, 0, 0]], [320, 0, 210])
SLIDE = Arm([[1, 0, 0]], [[0, 0, 0]], [0, 50, 80])


class Session:
    """Columns of a session and what goes around them."""

    def __init__(self, robot, targets, sigma):
        self.robot, self.targets, self.sigma = robot, targets, sigma
        self.columns = {}
        self.references = {}

    def rows(self):
        return len(next(iter(self.columns.values())))

    def take(self, rows):
        self.columns = {k: [v[r] for r in rows] for k, v in self.columns.items()}

    def document(self):
        joints = [
            {
                "name": f"j{k + 1}",
                "kind": "prismatic" if self.robot is SLIDE else "revolute",
                "axis": list(a),
                "point_mm": list(p),
                "limits": [0, 2000] if self.robot is SLIDE else [-180, 180],
            }
            for k, (a, p) in enumerate(zip(self.robot.axes, self.robot.points))
        ]
        tool = {"position_mm": list(self.robot.tool), "quaternion_wxyz": [1, 0, 0, 0]}
        own = {
            "format": "truepose-session/1",
            "name": "rows",
            "robot": {"name": "r", "joints": joints, "tool": tool, "gravity_m_s2": [0, 0, -9.81]},
            "targets": {k: list(v) for k, v in self.targets.items()},
            "instrument": {"name": "t", "sigma_mm": self.sigma},
            "samples": {"columns": self.columns},
        }
        own.update(self.references)
        return own


def axis_session(rng, n=80, design="random", sigma=0.02, both=True, places=None):
    robot = AXIS
    targets = {"A": np.zeros(3), "B": np.array([90.0, 30, 50])}
    true = {k: v.copy() for k, v in targets.items()}
    for name, by in (places or {}).items():
        true[name] = true[name] + by
    zero, length = np.radians(rng.normal(0, 0.3)), rng.normal(0, 0.7)
    if design == "random":
        q = rng.uniform(-170, 170, n)
    else:
        half = np.linspace(-170, 170, n // 2 if both else n) + rng.uniform(-1, 1, n // 2 if both else n)
        q = np.concatenate([half, half[::-1]]) if both else half
    q = q[:n]
    came = np.sign(np.diff(q, prepend=q[0] - 1))
    came = np.array([c if c else -1.0 for c in came])
    length_of = robot.tool + [length, 0, 0]
    s = Session(robot, targets, sigma)
    names = ["A" if k % 2 == 0 else "B" for k in range(len(q))]
    points = [
        rotation([0, 0, 1], np.radians(a) + zero) @ (length_of + true[t]) + rng.normal(0, sigma, 3)
        for a, t in zip(q, names)
    ]
    points = np.array(points)
    speed = rng.choice([0.0, 8.0, 20.0], len(q)) * came
    s.columns = {
        "q1_deg": list(np.round(q, 7)),
        "x_mm": list(np.round(points[:, 0], 6)),
        "y_mm": list(np.round(points[:, 1], 6)),
        "z_mm": list(np.round(points[:, 2], 6)),
        "dir1": list(came),
        "speed1_deg_s": list(speed),
        "load_kg": list(rng.choice([0.0, 2.0, 3.0], len(q))),
        "temperature_c": list(np.round(20 + 2 * (1 - np.exp(-np.arange(len(q)) / 60)), 4)),
        "time_s": [8.0 * k for k in range(len(q))],
        "target": names,
    }
    return s


def slide_session(rng, n=80, design="random", sigma=0.02, bent=0.0, unit=1.0):
    """A slide of 2 m along x; its guide is bent across by `bent` mm, as a parabola or as a double bow."""
    s = Session(SLIDE, {"A": np.zeros(3)}, sigma)
    if design == "random":
        q = rng.uniform(20, 1980, n)
    else:
        half = np.linspace(20, 1980, n // 2) + rng.uniform(-5, 5, n // 2)
        q = np.concatenate([half, half[::-1]])
    u = (q - 1000) / 1000
    across = bent * np.array([u**2 if rng.random() < 0.5 else u**3 - u for _ in range(2)])
    points = np.array([q + rng.normal(0, 0.4), 50 + across[0], 80 + across[1]]).T + rng.normal(0, sigma, (len(q), 3))
    s.columns = {"q1_mm": list(np.round(q / unit, 7))}
    for k, axis in enumerate("xyz"):
        s.columns[f"{axis}_mm"] = list(np.round(points[:, k], 6))
    s.columns["time_s"] = [8.0 * k for k in range(len(q))]
    return s


def arm_session(rng, n=120, design="random", sigma=0.03, poor=0, places=None, frame=True):
    targets = {"T1": np.array([0.0, 0, 70]), "T2": np.array([60.0, 25, 40]), "T3": np.array([-35.0, 55, 60])}
    true_places = {k: v.copy() for k, v in targets.items()}
    for name, by in (places or {}).items():
        true_places[name] = true_places[name] + by
    true = SIX.spoilt(rng, 0.5, 1.0)
    zeros = np.radians(rng.normal(0, 0.2, 6))
    if poor:
        true = SIX.spoilt(rng, rng.uniform(1, 5), 2.0)
        true.tool = true.tool + rng.normal(0, 17, 3)
        zeros = np.radians(rng.normal(0, 1.7, 6))
    wide = np.array([150, 60, 60, 150, 100, 150.0])
    if poor:
        wide = wide * rng.choice([0.02, 0.1, 0.3, 1.0], 6)
    if design == "sweep":
        q = np.zeros((n, 6))
        for k in range(n):
            q[k] = wide * 0.6 * np.sin(2 * np.pi * k / n * np.array([1, 2, 3, 2, 3, 1]) + np.arange(6))
    else:
        q = rng.uniform(-1, 1, (n, 6)) * wide
    turn = rotation(rng.normal(0, 1, 3), rng.uniform(0, 3)) if frame else np.eye(3)
    shift = rng.uniform(-2000, 2000, 3) if frame else np.zeros(3)
    names = [f"T{k % 3 + 1}" for k in range(n)]
    points = np.array(
        [turn @ true.point(np.radians(a) + zeros, true_places[t]) + shift for a, t in zip(q, names)]
    ) + rng.normal(0, sigma, (n, 3))
    came = np.sign(np.diff(q, axis=0, prepend=q[:1] - 1))
    came[came == 0] = -1.0
    s = Session(SIX, targets, sigma)
    for k in range(6):
        s.columns[f"q{k + 1}_deg"] = list(np.round(q[:, k], 7))
    for k, axis in enumerate("xyz"):
        s.columns[f"{axis}_mm"] = list(np.round(points[:, k], 4))
    for k in range(6):
        s.columns[f"dir{k + 1}"] = list(came[:, k])
    s.columns["time_s"] = [15.0 * k for k in range(n)]
    s.columns["target"] = names
    if frame:
        s.columns["setup"] = ["st"] * n
    return s


def slip(s, row, lost=True):
    """A point is missing, or there twice, in the file of the instrument."""
    n = s.rows()
    for axis in ("x_mm", "y_mm", "z_mm"):
        v = list(s.columns[axis])
        if lost:
            del v[row]
        else:
            v.insert(row, v[row - 1] if row else v[0])
        s.columns[axis] = v[:n]
    if lost:
        s.columns = {k: v[: n - 1] for k, v in s.columns.items()}


def anywhere(rng, n, index):
    return [2, n - 3, 0, n // 2][index % 8] if index % 8 < 4 else int(rng.integers(2, n - 2))


def make(kind, index):
    rng = np.random.default_rng([sum(map(ord, kind)), index])
    what, _, robot = kind.partition("-")
    design = ["random", "sweep"][index % 2]
    arm = robot == "arm"
    if robot == "slide":
        bent = rng.uniform(0.08, 0.4) if what == "guide" else 0.0
        s = slide_session(rng, design=design, bent=bent, unit=25.4 if what == "inches" else 1.0)
        return s, "in inches" if what == "inches" else None
    session = (lambda **k: arm_session(rng, design=design, **k)) if arm else (lambda **k: axis_session(rng, design=design, **k))
    if what == "clean":
        n = [30, 60, 120, 200][index % 4]
        s = session(n=n, frame=index % 3 > 0) if arm else session(n=n, both=index % 3 > 0)
        if index % 5 == 0:
            s.columns.pop("time_s")
        if index % 7 == 0:
            s.columns = {k: (list(np.round(v, 2)) if k in ("x_mm", "y_mm", "z_mm") else v) for k, v in s.columns.items()}
        return s, None
    s = session(poor=1, n=int(rng.integers(14, 60))) if what == "poor" else None
    if what == "slip":
        s = session()
        row = anywhere(rng, s.rows(), index // 2)
        slip(s, row, lost=index % 3 > 0 or row == 0)
        return s, "rows shifted by one"
    if what == "copies":
        s = session()
        n = s.rows()
        block = [list(range(n)) * 2, list(range(n)) + list(range(20, 35)), list(range(40)) + [39] + list(range(40, n))]
        s.take(block[index % 3])
        return s, "copied rows"
    if what == "sorted":
        s = session() if arm else axis_session(rng)
        drift = rng.choice([-2, 2], 3) / 3600
        for k, axis in enumerate(("x_mm", "y_mm", "z_mm")):
            s.columns[axis] = [v + drift[k] * t for v, t in zip(s.columns[axis], s.columns["time_s"])]
        s.take(list(np.argsort(s.columns["q1_deg"])))
        return s, "rows out of order"
    if what == "rounded":
        step = [0.1, 0.05, 0.0254, 0.2][index % 4]
        s = session()
        for axis in ("x_mm", "y_mm", "z_mm"):
            s.columns[axis] = [round(round(v / step) * step, 6) for v in s.columns[axis]]
        return s, "resolution" if step / 12**0.5 > s.sigma / 3 else None
    if what == "speed":
        s = session()
        s.columns["speed1_deg_s"] = [-v for v in s.columns["speed1_deg_s"]]
        return s, "speed"
    if what == "grams":
        s = session()
        s.columns["load_kg"] = [1000 * v for v in s.columns["load_kg"]]
        return s, "load"
    if what == "target":
        name = "T2" if arm else "B"
        by = rng.normal(0, 1, 3)
        by *= rng.uniform(1.5, 2.3) / np.linalg.norm(by)
        return session(places={name: by}), f"target {name}"
    if what in ("code", "lost"):
        # What is missing is written as −999, or as 0.
        s, column = session(), "q2_deg" if arm else "q1_deg"
        rows = rng.choice(s.rows(), int(rng.integers(3, 3 + s.rows() // 8)), replace=False)
        for row in rows:
            s.columns[column][row] = -999.0 if what == "code" else 0.0
            if what == "lost" and not arm:
                # Whatever the clock and the load say, the joint column repeats.
                for name, value in (("dir1", 1.0), ("speed1_deg_s", 0.0), ("load_kg", 0.0)):
                    s.columns[name][row] = value
        return s, "missing values" if what == "code" else None if arm else "returns"
    if what == "warmth":
        s = session()
        for row in rng.choice(s.rows(), int(rng.integers(3, 10)), replace=False):
            s.columns["temperature_c"][row] = 0.0
        return s, "missing values"
    if what == "gradians":
        s = session()
        for column in s.columns:
            if column.startswith("q"):
                s.columns[column] = [v / 0.9 for v in s.columns[column]]
        return s, "in gradians"
    if what == "turns":
        s, column = session(), "q2_deg" if arm else "q1_deg"
        s.columns[column] = [v / 360 for v in s.columns[column]]
        return s, "in turns"
    if what == "motor":
        # What the controller shows of a motor, or of an encoder, through a gear whose ratio the session does not state.
        s, joint = session(), int(rng.integers(1, 7)) if arm else 1
        ratio = float(rng.choice([50, 80, 101, -121, 157, 4096 / 360, 65536 / 360]))
        for column, by in ((f"q{joint}_deg", ratio), (f"dir{joint}", np.sign(ratio)), (f"speed{joint}_deg_s", ratio)):
            if column in s.columns:
                s.columns[column] = [v if v is None or v == "" else v * by for v in s.columns[column]]
        return s, "times too large"
    if what == "coordinate":
        s, axis = session(), str(rng.choice(["x", "y", "z"] if arm else ["x", "y"]))
        unit, name = [(0.001, "metres"), (1 / 25.4, "inches"), (1000.0, "micrometres")][int(rng.integers(3))]
        s.columns[f"{axis}_mm"] = [v * unit for v in s.columns[f"{axis}_mm"]]
        return s, f"measured {axis} is in {name}"
    if what == "placed":
        # Targets as places at home in the base frame.
        s = session()
        s.targets = {name: place + s.robot.tool for name, place in s.targets.items()}
        return s, "places in the base frame"
    if what == "conventions":
        # Signs, homes, a parallelogram and columns as the maker has them, not as the description does.
        s, wrong = session(), rng.permutation(12)[: int(rng.integers(2, 7))]
        q = np.array([s.columns[f"q{k + 1}_deg"] for k in range(6)])
        for k in wrong[wrong < 6]:
            q[k] -= rng.choice([90.0, -90.0, 180.0])
        for k in wrong[wrong >= 6] - 6:
            q[k] = -q[k]
        if index % 3 == 1:
            q[2] -= rng.choice([-1, 1]) * q[1]
        if index % 5 == 2:
            q = q[::-1]
        for k in range(6):
            s.columns[f"q{k + 1}_deg"] = list(q[k])
        return s, ("counts the other way round", "home position", "coupled", "exchanged")
    if what == "aside":
        s, by = session(), rng.uniform(1, 4)
        for row in rng.choice(s.rows(), int(rng.uniform(0.13, 0.25) * s.rows()), replace=False):
            for axis in ("x_mm", "y_mm", "z_mm"):
                s.columns[axis][row] += by * rng.normal()
        return s, "do not follow the model"
    if what == "poor":
        return s, None
    raise SystemExit(f"no kind is called {kind}")


KINDS = [
    "clean-axis", "clean-arm", "poor-arm", "slip-axis", "slip-arm", "copies-axis", "copies-arm", "sorted-axis",
    "rounded-axis", "rounded-arm", "speed-axis", "grams-axis", "target-axis", "target-arm", "code-axis", "code-arm",
    "lost-axis", "lost-arm", "warmth-axis", "gradians-axis", "gradians-arm", "conventions-arm", "turns-axis", "turns-arm",
    "motor-axis", "motor-arm", "coordinate-axis", "coordinate-arm", "placed-axis", "placed-arm", "aside-axis",
    "aside-arm",
    "guide-slide", "straight-slide", "inches-slide",
]


def run(binary, kind, index, folder):
    session, word = make(kind, index)
    path = os.path.join(folder, f"{kind}-{index}.json")
    with open(path, "w") as out:
        json.dump(session.document(), out, default=float)
    done = subprocess.run([binary, "diagnose", path, "--json"], capture_output=True, text=True, timeout=300)
    if done.returncode:
        return {"failed": done.stderr.strip().splitlines()[-1:], "index": index}
    answer = json.loads(done.stdout)
    what = [p["what"] for p in answer["data_problems"]]
    words = word if isinstance(word, tuple) else (word,) if word else ()
    said = any(word in w for w in what for word in words)
    other = [w for w in what if not any(word in w for word in words)]
    return {
        "index": index,
        "said": said,
        "other": other,
        "names": [f["effect"] for f in answer["found"]],
        "verdict": answer["verdict"],
        "end": answer["gap"]["end_mm"],
        "ratio": answer["gap"]["end_mm"] / max(answer["floor"]["mm"], 1e-9),
    }


def main():
    a = argparse.ArgumentParser()
    a.add_argument("binary")
    a.add_argument("--count", type=int, default=100)
    a.add_argument("--kinds", default=",".join(KINDS))
    a.add_argument("--keep")
    a.add_argument("--jobs", type=int, default=1)
    a.add_argument("--verbose", action="store_true")
    given = a.parse_args()
    print(f"{'kind':14} {'said':>9} {'else':>5} {'names':>6} {'noise':>6} {'end/floor':>10} {'failed':>6}")
    with tempfile.TemporaryDirectory() as folder:
        for kind in given.kinds.split(","):
            with ThreadPoolExecutor(given.jobs) as pool:
                all_ = list(pool.map(lambda k: run(given.binary, kind, k, given.keep or folder), range(given.count)))
            good = [r for r in all_ if "failed" not in r]
            ratio = np.median([r["ratio"] for r in good]) if good else np.nan
            count = lambda of: sum(bool(of(r)) for r in good)
            print(
                f"{kind:14} {count(lambda r: r['said']):4}/{len(good):<4} {count(lambda r: r['other']):5} "
                f"{count(lambda r: r['names']):6} {count(lambda r: r['verdict'] == 'noise'):6} {ratio:10.2f} {len(all_) - len(good):6}",
                flush=True,
            )
            if given.verbose:
                for r in all_:
                    if "failed" in r or r["other"] or (r["names"] and kind != "sorted-axis") or not r["said"]:
                        if kind.startswith(("clean", "poor")) and "failed" not in r and not r["other"] and not r["names"]:
                            continue
                        print("   ", r, file=sys.stderr)


if __name__ == "__main__":
    main()
