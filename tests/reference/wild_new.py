#!/usr/bin/env python3
"""A second adversary's sessions: poses that show little, parts of the rows that differ, what instrument and cell do.

    python tests/reference/wild_new.py BINARY [--count 3] [--seed 1] [--rows drift,slip] [--list] [--keep FOLDER]

Exact geometry of a six-joint arm (0.3 mm, 0.5 mrad, zeros 0.2°; a tracker 3.5 m away with its own frame, 0.02 mm, three reflectors)
or of one axis, nothing of the program. What each row has:

    drift       two poses in turn for three hours, while joint 2 warms up
    iso9283     five poses thirty times
    swept       one joint swept on the fly, the others stand
    probe       poses with orientation; the probe's frame is turned by 20° on the tool, unsaid
    radians, reversed       joint 4 is in radians, a joint is counted the other way, from some row on
    inches, cell            points are in inches, in another cell's frame, from some row on
    housing     one of three reflectors sits before the last joint
    slip, homed an encoder slips by 0.5° at a time; an encoder is homed anew before each of four runs (0.1°)
    side        backlash, and the side of approach written the other way from some row on
    warms, refraction, stations     a range offset of 0.1 to 0.5 mm that settles; a bent line of sight (the same at unseen poses);
                two stations, the second 60 to 250 ppm off
    slope, payload          gravity runs across the robot, unsaid; the load is declared at half, where joints sag
    bolts       the base steps half way
    again, stop joint 2 stands at its stop: the same command is sent again, or one that goes further each time
    cold, degmin            temperatures about 0 °C; speeds in degrees a minute (one axis, with a lag)
    belt, finer 3.37 and 100.6 cycles a turn (one axis)
    oldsign     a joint reversed, and 2 mm that no model takes
    horizontal  joint 3 counted from the horizontal, poses one joint at a time
    hobby       a servo that turns 0.465 times what it is told (one axis)

`> nominal`, `> identify`: on 150 unseen poses without noise the model of `diagnose --out` is worse (by 2 and by 5 %) than no
model and than the model of `identify --out` (`verify`; where the rows do not agree on a convention, in that which suits the
model best). `commands`: joint targets through `compensate`, driven by the true arm: error before → after in mm at three
points of the tool after the best rigid motion of the base, medians; how often worse (by 2 %), how often refused. `stated`:
`held_out.end_mm` over the error of unseen poses with noise, median. `named`: sessions with a name that is not there. `said`: the
cause is in `data_problems`, `found` or `unexplained.where`; for `again`, `stop`, `cold` nothing wrong is said.

Measured in November 2026 before any of it was answered, seed 1, two or three sessions a row (cell, housing, side, slip, inches,
cold and horizontal: one; oldsign not in its present form):

| row | what was seen |
| --- | --- |
| drift, iso9283, swept | models worse than nominal in 6 of 9, commands in 5 of 9 (1.7 → 2.8 mm in the median of `swept`); stated a fiftieth of the true error or less |
| probe | commands 1.6 → 13.5 mm, in 3 of 3 |
| radians, reversed | not said in 6; worse than nominal in 5 of 6 (3 → 48 and 62 mm), than identify's in 5 |
| inches | no model at all; the answer needs 30 to 60 s |
| cell, housing | not said; 882 and 40 mm where nominal has 4 and 2; commands are refused |
| slip, homed, side | not said in 4; worse than identify's in 3 |
| warms | names that are not there in 2 of 2, worse than identify's in 2, a fifth of the true error stated |
| refraction, stations | no names; scale not said |
| slope, payload, bolts | gravity not said (slope: `unexplained`); no wrong names |
| again, stop | "locked on a point that does not move" in 4 of 4; a frame shift named in one |
| cold | 0 °C is called missing in the one that ran |
| degmin | the lag is found, the unit not said, in 2 of 2 |
| belt, finer | the right order in 1 of 2 and 2 of 2 |
| horizontal | not said: 176 mm, 0.13 of the true error stated |
| hobby | not said: 180 mm left, "the tool is 125 mm from where the session states" |
"""

import argparse
import csv
import json
import re
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from wild_confidence import quat  # noqa: E402
from wild_leaving import aligned_rms, answer, run  # noqa: E402
from wild_rows import AXIS, SIX, Session, rotation  # noqa: E402

SIGMA = 0.02
WIDE = np.array([150, 60, 60, 150, 100, 150.0])
TARGETS = {"T1": np.array([0.0, 0, 70]), "T2": np.array([60.0, 25, 40]), "T3": np.array([-35.0, 55, 60])}
UNSEEN = 150
# Links' masses behind joints 2 and 3, kg, and their centres at home; how far joints give, rad/Nm.
LINKS = [(2, 14.0, np.array([25.0, 0, 620])), (3, 9.0, np.array([180.0, 10, 880]))]
GIVES = {0: 1.5e-6, 1: 2e-6, 2: 2.5e-6}


class Cell:
    """The true robot and where it stands."""

    def __init__(self, rng, robot=SIX):
        self.rng, self.robot = rng, robot
        self.true = robot.spoilt(rng, 0.3, 0.5) if robot is SIX else robot
        self.zeros = np.radians(rng.normal(0, 0.2, len(robot.axes)))
        turn = rotation(rng.normal(0, 1, 3), rng.uniform(0.3, 3)) if robot is SIX else np.eye(3)
        away = rng.normal(0, 1, 3) * [1, 1, 0.2]
        self.frame = turn, 3500 * away / np.linalg.norm(away) if robot is SIX else np.zeros(3)
        self.gravity = None
        # Errors of joints (angles in rad, row or None) that no model of the session has.
        self.more = lambda q, row: 0 * q

    def angles(self, q_deg, row=None, load=0.0):
        q = np.radians(q_deg)
        theta = q + self.zeros + self.more(q, row)
        if self.gravity is None:
            return theta
        driven = theta.copy()
        for _ in range(3):
            theta = driven + self.sag(theta, load)
        return theta

    def sag(self, theta, load):
        """What gravity's torque turns joints 1 to 3 by."""
        turn, shift, lines, links = np.eye(3), np.zeros(3), [], []
        for k, (axis, point) in enumerate(zip(self.true.axes, self.true.points)):
            lines.append((turn @ axis, turn @ point + shift))
            own = rotation(axis, theta[k])
            turn, shift = turn @ own, turn @ (point - own @ point) + shift
            links += [(k, m, turn @ c + shift) for behind, m, c in LINKS if behind == k + 1]
        links.append((5, load, turn @ self.true.tool + shift))
        out = np.zeros(6)
        for k, gives in GIVES.items():
            axis, point = lines[k]
            torque = sum(m * axis @ np.cross((c - point) * 1e-3, self.gravity) for behind, m, c in links if behind >= k)
            out[k] = gives * torque
        return out

    def points(self, q, names, rows=None, loads=None):
        """Measured without noise, in the instrument's frame."""
        turn, shift = self.frame
        at = lambda i: (None if rows is None else rows[i], 0.0 if loads is None else loads[i])
        return np.array(
            [turn @ self.true.point(self.angles(a, *at(i)), TARGETS[n]) + shift for i, (a, n) in enumerate(zip(q, names))]
        )


class Case:
    """A session with everything that judges it."""

    def __init__(self, rng, poses=120, robot=SIX, q=None, names=None, every=15.0, cell=None, loads=None):
        self.rng, self.cell = rng, cell or Cell(rng, robot)
        self.q = rng.uniform(-1, 1, (poses, 6)) * WIDE if q is None else q
        n = len(self.q)
        self.names = [f"T{k % 3 + 1}" for k in range(n)] if names is None else names
        self.time, self.loads = every * np.arange(n), loads
        self.from_row = int(rng.uniform(0.4, 0.7) * n)
        self.late = np.arange(n) >= self.from_row
        self.noise = rng.normal(0, SIGMA, (n, 3))
        self.columns, self.instrument, self.allowed, self.words, self.never = {}, {"sigma_mm": SIGMA}, set(), None, None
        # Conventions in which unseen poses may be asked for: what turns true values into the session's.
        self.as_written = [(lambda q: q, lambda p: p)]
        self.commands = robot is SIX
        self.points = self.shown = self.came = None
        self.sizes = lambda answer: True

    def measure(self):
        """Fills in what was not set: points, values and sides as written."""
        if self.points is None:
            self.points = self.cell.points(self.q, self.names, np.arange(len(self.q)), self.loads) + self.noise
        self.shown = self.q.copy() if self.shown is None else self.shown
        came = np.sign(np.diff(self.q, axis=0, prepend=self.q[:1] - 1))
        self.came = np.where(came == 0, -1, came) if self.came is None else self.came
        return self

    def save(self, folder, name):
        session = Session(self.cell.robot, TARGETS, SIGMA)
        six = self.cell.robot is SIX
        for k in range(self.q.shape[1]):
            session.columns[f"q{k + 1}_deg"] = np.round(self.shown[:, k], 7).tolist()
            session.columns[f"dir{k + 1}"] = self.came[:, k].tolist()
        for k, axis in enumerate("xyz"):
            session.columns[f"{axis}_mm"] = np.round(self.points[:, k], 5).tolist()
        session.columns.update(time_s=self.time.tolist(), target=list(self.names))
        if six:
            session.columns["setup"] = ["st"] * len(self.q)
        if self.loads is not None:
            session.columns["load_kg"] = list(self.loads)
        session.columns.update(self.columns)
        session.references = {"name": name, "instrument": {"name": "t", **self.instrument}}
        document = session.document()
        for joint, wide in zip(document["robot"]["joints"], WIDE if six else [400.0]):
            joint["limits"] = [-wide, wide]
        path = Path(folder) / f"{name}.json"
        path.write_text(json.dumps(document, default=float) + "\n")
        return path

    def unseen(self, folder, name):
        """Sessions of unseen poses, one for each convention."""
        six = self.cell.robot is SIX
        q = self.rng.uniform(-1, 1, (UNSEEN, 6)) * WIDE if six else self.rng.uniform(self.q.min(), self.q.max(), (UNSEEN, 1))
        paths = []
        for k, (joints, points) in enumerate(self.as_written):
            other = Case(self.rng, cell=self.cell, robot=self.cell.robot, q=q, names=[f"T{i % 3 + 1}" for i in range(UNSEEN)])
            other.points = points(self.cell.points(q, other.names))
            other.shown = joints(q.copy())
            other.measure()
            # Of what a joint does from a side on no unseen pose knows.
            other.came = 0 * other.came
            if "qw" in self.columns:
                other.columns, other.instrument = orientation(self, q, np.zeros((UNSEEN, 3))), self.instrument
                other.names = ["T1"] * UNSEEN
                other.points = points(self.cell.points(q, other.names))
            paths.append(other.save(folder, f"{name}-unseen{k}"))
        return paths


def part(case, change, rows=None):
    """Values as written, changed from some row on."""
    case.measure()
    rows = case.late if rows is None else rows
    case.shown[rows] = change(case.shown[rows].copy())
    case.as_written.append((change, lambda p: p))
    case.commands = False
    return case


def column(j, by):
    def change(q):
        q[:, j] = by(q[:, j])
        return q

    return change


def orientation(case, q, turn):
    """Measured quaternions of a probe that sits on the tool as `case.probe` says."""
    frame = case.cell.frame[0]
    quats = []
    for a, e in zip(q, turn):
        tool = frame @ case.cell.true.pose(case.cell.angles(a))[0] @ case.probe
        small = rotation(e, np.linalg.norm(e)) if np.linalg.norm(e) > 0 else np.eye(3)
        quats.append(quat(small @ tool))
    return {k: np.round(v, 8).tolist() for k, v in zip(("qw", "qx", "qy", "qz"), np.array(quats).T)}


def drift(rng):
    two = rng.uniform(-0.8, 0.8, (2, 6)) * WIDE
    c = Case(rng, q=np.tile(two, (90, 1)), names=["T1"] * 180, every=60.0)
    joint = np.eye(6)[1] * np.radians(rng.uniform(0.005, 0.02))
    c.cell.more = lambda q, row: 0 * q if row is None else joint * (1 - np.exp(-row * 60 / 2400))
    c.columns["temperature_c"] = np.round(22 + 6 * (1 - np.exp(-c.time / 2400)) + rng.normal(0, 0.05, 180), 2).tolist()
    c.allowed = {"thermal-zero-drift", "frame-drift", "thermal-growth", "frame-shift"}
    return c


def iso9283(rng):
    five = rng.uniform(-0.7, 0.7, (5, 6)) * WIDE
    return Case(rng, q=np.tile(five, (30, 1)), names=["T1"] * 150)


def swept(rng):
    j, n = int(rng.integers(0, 3)), 150
    q = np.tile(rng.uniform(-0.5, 0.5, 6) * WIDE, (n, 1))
    q[:, j] = np.concatenate([np.linspace(-WIDE[j], WIDE[j], n // 2), np.linspace(WIDE[j], -WIDE[j], n - n // 2)])
    c = Case(rng, q=q, names=["T1"] * n, every=0.5)
    c.columns[f"speed{j + 1}_deg_s"] = np.gradient(q[:, j], 0.5).tolist()
    return c


def probe(rng):
    c = Case(rng, poses=60, names=["T1"] * 60)
    c.probe = rotation(rng.normal(0, 1, 3), np.radians(20))
    c.columns = orientation(c, c.q, rng.normal(0, 1e-4, (60, 3)))
    c.instrument = {"sigma_mm": SIGMA, "sigma_mrad": 0.1}
    c.words = "turned|orientation|probe"
    return c


def radians(rng):
    c = part(Case(rng), column(3, np.radians))
    c.words = "joint 4.*radians|radians.*joint 4"
    return c


def reversed_(rng):
    j = int(rng.integers(1, 6))
    c = part(Case(rng), column(j, lambda v: -v))
    c.words = f"joint {j + 1} counts"
    return c


def inches(rng):
    c = Case(rng).measure()
    c.points[c.late] /= 25.4
    c.words = "inch"
    return c


def other_cell(rng):
    c = Case(rng).measure()
    turn, shift = rotation(rng.normal(0, 1, 3), np.radians(rng.uniform(3, 60))), rng.normal(0, 400, 3)
    moved = lambda p: p @ turn.T + shift
    c.points[c.late] = moved(c.points[c.late])
    c.as_written.append((lambda q: q, moved))
    c.words = "frame|setup"
    return c


def housing(rng):
    c = Case(rng)
    c.points = c.cell.points(c.q, c.names)
    for i, name in enumerate(c.names):
        if name == "T3":
            # The last joint does not turn it.
            theta = c.cell.angles(c.q[i])
            theta[5] = 0.0
            c.points[i] = c.cell.frame[0] @ c.cell.true.point(theta, TARGETS["T3"]) + c.cell.frame[1]
    c.points += c.noise
    c.words = "T3"
    return c


def slip(rng):
    j, c = int(rng.integers(0, 6)), Case(rng)
    by = np.eye(6)[j] * np.radians(rng.choice([-0.5, 0.5]))
    c.cell.more = lambda q, row: by * (row is not None and row >= c.from_row)
    c.as_written.append((lambda q: q - np.degrees(by), lambda p: p))
    c.commands = False
    c.words = f"joint {j + 1}\\D"
    return c


def homed(rng):
    j, c = int(rng.integers(0, 5)), Case(rng)
    homes = np.radians(rng.normal(0, 0.1, 4))
    unit = np.eye(6)[j]
    c.time = c.time + 900 * (np.arange(120) // 30)
    c.cell.more = lambda q, row: unit * (homes[row // 30] if row is not None else homes.mean())
    c.as_written += [(lambda q, h=h: q + np.degrees(unit * (homes.mean() - h)), lambda p: p) for h in homes]
    c.commands = False
    c.words = f"joint {j + 1}\\D"
    return c


def side(rng):
    c = Case(rng).measure()
    c.points, c.allowed = None, {"backlash", "lost-motion"}
    width = np.radians(np.where(rng.random(6) < 0.5, 0.03, 0.0))
    width[1] = np.radians(0.03)
    came = c.came.copy()
    c.cell.more = lambda q, row: 0 * q if row is None else -came[row] * width / 2
    c.measure()
    c.came[c.late] *= -1
    c.words = "direction|side"
    return c


def along_sight(case, by):
    """Points moved along the line of sight by `by` mm, the instrument at the origin of its frame."""
    case.measure()
    sight = case.points / np.linalg.norm(case.points, axis=1, keepdims=True)
    case.points = case.points + sight * by[:, None]
    return case


def warms(rng):
    c = Case(rng)
    return along_sight(c, rng.uniform(0.1, 0.5) * np.exp(-c.time / 600))


def refraction(rng):
    c, most = Case(rng).measure(), rng.uniform(0.1, 0.4)
    bent = lambda p: p + np.array([0, 0, most]) * (np.linalg.norm(p, axis=1, keepdims=True) / 3500) ** 2
    c.points = bent(c.points)
    c.as_written = [(lambda q: q, bent)]
    return c


def stations(rng):
    c = Case(rng).measure()
    c.points[c.late] *= 1 + rng.uniform(60, 250) * rng.choice([-1, 1]) * 1e-6
    c.columns["setup"] = np.where(c.late, "S2", "st").tolist()
    c.allowed, c.words = {"instrument-scale"}, "scale"
    return c


def loaded(rng, declared, tilt):
    loads = rng.choice([0.0, 5.0, 10.0], 120)
    c = Case(rng, loads=loads)
    down = rotation([np.cos(t := rng.uniform(0, 6.28)), np.sin(t), 0], np.radians(tilt)) @ [0, 0, -9.81]
    c.cell.gravity = np.array(down)
    c.measure()
    c.loads, c.allowed = declared * loads, {"joint-compliance"}
    return c


def slope(rng):
    c = loaded(rng, 1.0, rng.uniform(20, 90))
    c.words = "gravity"
    return c


def payload(rng):
    c = loaded(rng, 0.5, 0.0)
    c.words = None
    return c


def bolts(rng):
    c = Case(rng).measure()
    turn, shift = rotation(rng.normal(0, 1, 3), 3e-4), rng.normal(0, 0.4, 3)
    base = c.cell.frame[1]
    c.points[c.late] = (c.points[c.late] - base) @ turn.T + base + shift
    c.allowed, c.words = {"frame-shift"}, "frame-shift|step|moved"
    c.as_written.append((lambda q: q, lambda p: (p - base) @ turn.T + base + shift))
    return c


def stopped(rng, told):
    """Joint 2 is told to go beyond its stop, so far in each of some rows that follow each other; all others stay."""
    c, rows = Case(rng), slice(40, 40 + len(told))
    c.q[rows], c.names[rows] = c.q[40], [c.names[40]] * len(told)
    c.q[rows, 1] = 60.0
    c.shown = c.q.copy()
    c.shown[rows, 1] += told
    c.never = "locked"
    return c


def again(rng):
    return stopped(rng, np.full(8, rng.uniform(0.5, 3)))


def stop(rng):
    c = stopped(rng, 2.0 * np.arange(1, 9))
    c.words = "stop|limit|range"
    return c


def cold(rng):
    c = Case(rng)
    # A quarter of the poses in the morning at 0 °C, the others from noon on at 5 to 8 °C, a thermometer of half degrees.
    late = np.arange(120) >= 30
    c.time = c.time + 3 * 3600 * late
    c.columns["temperature_c"] = np.where(late, np.round(2 * np.linspace(4, 8, 120)) / 2, 0.0).tolist()
    c.never = "missing"
    return c


def one_axis(rng, q, more=None):
    c = Case(rng, robot=AXIS, q=np.asarray(q, float)[:, None])
    if more:
        c.cell.more = more
    return c


def degmin(rng):
    c = one_axis(rng, np.concatenate([np.linspace(-170, 170, 60), np.linspace(170, -170, 60)]))
    came = np.where(np.arange(120) < 60, 1, -1)
    speed = came * rng.choice([0.0, 8.0, 20.0], 120)
    c.cell.more = lambda q, row: 0 * q if row is None else 0 * q - np.radians(speed[row]) * 0.004
    c.columns["speed1_deg_s"] = (60 * speed).tolist()
    c.allowed, c.words, c.never = {"tracking-lag"}, "minute", "radian"
    return c


def periodic(rng, order):
    size, phase = np.radians(rng.uniform(0.01, 0.03)), rng.uniform(0, 6.28)
    half = np.sort(rng.uniform(-350, 350, 70))
    c = one_axis(rng, np.concatenate([half, half[::-1]]), lambda q, row: size * np.sin(order * q + phase))
    c.allowed = {"gear-transmission-error"}
    orders = lambda answer: [p["value"] for f in answer["found"] for p in f["parameters"] if p["name"] == "order"]
    c.sizes = lambda answer: any(abs(o - order) < 0.03 for o in orders(answer))
    c.words = "."
    return c


def oldsign(rng):
    j = int(rng.integers(1, 6))
    c = Case(rng)
    # Waves over all joints at once.
    across, phases = rng.normal(0, 1.5, (6, 6)), rng.uniform(0, 6.28, 6)
    c.cell.more = lambda q, row: np.radians(0.15) * np.sin(across @ q + phases)
    part(c, column(j, lambda v: -v), rows=np.arange(120) >= 0)
    c.as_written = c.as_written[1:]
    c.words = f"joint {j + 1} counts"
    return c


def horizontal(rng):
    q = np.zeros((78, 6)) + rng.uniform(-0.2, 0.2, 6) * WIDE
    for j in range(6):
        q[13 * j : 13 * j + 13, j] = np.linspace(-0.9, 0.9, 13) * WIDE[j]

    def counted(q):
        q[:, 2] += q[:, 1]
        return q

    c = part(Case(rng, q=q), counted, rows=np.arange(78) >= 0)
    c.as_written = c.as_written[1:]
    c.words = "joints 2 and 3"
    return c


def hobby(rng):
    q = np.tile(np.linspace(0, 179, 19), 4)
    c = one_axis(rng, q, lambda q, row: (0.465 - 1) * q)
    c.allowed, c.words = {"joint-scale"}, "scale"
    return c


ROWS = {
    "drift": drift, "iso9283": iso9283, "swept": swept, "probe": probe, "radians": radians, "reversed": reversed_,
    "inches": inches, "cell": other_cell, "housing": housing, "slip": slip, "homed": homed, "side": side, "warms": warms,
    "refraction": refraction, "stations": stations, "slope": slope, "payload": payload, "bolts": bolts, "again": again,
    "stop": stop, "cold": cold, "degmin": degmin, "belt": lambda rng: periodic(rng, 3.37),
    "finer": lambda rng: periodic(rng, 100.6), "oldsign": oldsign, "horizontal": horizontal, "hobby": hobby,
}


def driven(binary, case, model, folder):
    """Error of joint targets before and after `compensate`, mm; the second None where it refuses."""
    q = case.rng.uniform(-0.7, 0.7, (40, 6)) * WIDE
    asked, out = folder / "asked.csv", folder / "corrected.csv"
    with open(asked, "w", newline="") as file:
        csv.writer(file).writerows([[f"q{k + 1}_deg" for k in range(6)], *np.round(q, 7).tolist()])
    out.unlink(missing_ok=True)
    code, _, _ = run(binary, "compensate", model, asked, "--out", out, "--force")
    tip = lambda of: np.concatenate([[of(a, t) for a in np.radians(q)] for t in TARGETS.values()])
    true = lambda a, t: case.cell.true.point(case.cell.angles(np.degrees(a)), t)
    wanted, before = tip(SIX.point), tip(true)
    if code == 2 or not out.exists():
        return aligned_rms(wanted, before), None
    with open(out) as file:
        told = np.array([[float(v) for v in row[:6]] for row in list(csv.reader(file))[1:]])
    after = np.concatenate([[true(a, t) for a in np.radians(told)] for t in TARGETS.values()])
    return aligned_rms(wanted, before), aligned_rms(wanted, after)


def one(binary, folder, row, seed, k):
    rng = np.random.default_rng([list(ROWS).index(row), seed, k])
    case = ROWS[row](rng)
    case.measure()
    name = f"{row}-{seed}-{k}"
    path = case.save(folder, name)
    models = {command: folder / f"{name}.{command}" for command in ("diagnose", "identify")}
    start = time.time()
    said = answer(binary, "diagnose", path, "--out", models["diagnose"], "--force")
    seconds = time.time() - start
    plain = answer(binary, "identify", path, "--out", models["identify"], "--force")
    result = {"name": name, "row": row, "seconds": seconds}
    if "error" in said:
        return {**result, "failed": said["error"]}
    problems = [p["what"] for p in said["data_problems"]]
    names = [f["effect"] + (f" {f['joint']}" if f.get("joint") else "") for f in said["found"]]
    text = json.dumps([said["data_problems"], names, said["unexplained"]["where"]], ensure_ascii=False)
    result.update(verdict=said["verdict"], found=names, problems=problems)
    result["named"] = any(n.split(" ")[0] not in case.allowed for n in names)
    result["said"] = None if case.words is None and case.never is None else (
        (case.words is None or bool(re.search(case.words, text)))
        and not (case.never and re.search(case.never, str(problems)))
        and case.sizes(said)
    )
    gaps = {key: [] for key in models}
    nominal = []
    for unseen in case.unseen(folder, name):
        for key, model in models.items():
            verified = answer(binary, "verify", model, unseen)
            if "error" not in verified:
                gaps[key].append((verified["gap"]["model_mm"], verified["gap"]["nominal_mm"]))
    best = {key: min(v) if v else None for key, v in gaps.items()}
    if best["diagnose"]:
        own, nominal = best["diagnose"]
        result.update(own=own, nominal=nominal, worse=own > 1.02 * nominal)
        if best["identify"] and "error" not in plain:
            result["identify"], result["behind"] = best["identify"][0], own > 1.05 * best["identify"][0]
        stated = said["held_out"]["end_mm"]
        if stated is not None:
            result["stated"] = float(stated / np.hypot(own, SIGMA * 3**0.5))
    if case.commands and models["diagnose"].exists():
        result["before"], result["after"] = driven(binary, case, models["diagnose"], folder)
    return result


def line(name, all_):
    good = [r for r in all_ if "failed" not in r]
    of = lambda key: [r[key] for r in good if r.get(key) is not None]
    share = lambda key: f"{sum(of(key))}/{len(of(key))}" if of(key) else "–"
    middle = lambda key: f"{np.median(of(key)):.2f}" if of(key) else "–"
    sent = [r for r in good if "before" in r]
    driven_ = [r for r in sent if r["after"] is not None]
    worse = sum(r["after"] > 1.02 * r["before"] for r in driven_)
    commands = f"{middle('before')} → {middle('after')}, {worse} worse, {len(sent) - len(driven_)} refused" if sent else "–"
    verdicts = [r["verdict"] for r in good]
    says = ", ".join(f"{verdicts.count(v)} {v}" for v in sorted(set(verdicts)))
    print(
        f"| {name} | {share('worse')} | {share('behind')} | {middle('nominal')}, {middle('identify')}, {middle('own')} | {commands} "
        f"| {middle('stated')} | {share('named')} | {share('said')} | {says} | {np.median([r['seconds'] for r in all_]):.1f} "
        f"| {len(all_) - len(good)} |",
        flush=True,
    )


def main():
    a = argparse.ArgumentParser()
    a.add_argument("binary")
    a.add_argument("--count", type=int, default=3)
    a.add_argument("--seed", type=int, default=1)
    a.add_argument("--rows", default=",".join(ROWS))
    a.add_argument("--list", action="store_true")
    a.add_argument("--keep")
    given = a.parse_args()
    print("| row | > nominal | > identify | nominal, identify, own, mm | commands | stated | named | said | verdicts | s | failed |")
    print("| --- " * 11 + "|", flush=True)
    results = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(given.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for row in given.rows.split(","):
            of_row = [one(given.binary, folder, row, given.seed, k) for k in range(given.count)]
            line(row, of_row)
            results += of_row
    line("all", results)
    if given.list:
        for r in results:
            print({k: round(v, 3) if isinstance(v, float) else v for k, v in r.items()})


if __name__ == "__main__":
    main()
