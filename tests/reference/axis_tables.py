#!/usr/bin/env python3
"""What the table of one axis leaves on the true axis, beside two tables that anyone makes by hand.

    python tests/reference/axis_tables.py BINARY [--count 72] [--seed 1] [--kinds bow,dent] [--jobs 1]
        [--list] [--keep FOLDER] [-- --correct-unexplained]

What follows `--` goes to `diagnose`. Sessions are slides of 200 to 1500 mm (read along the axis only, as by a laser, or in
x, y, z by a tracker) and turntables (x, y or x, y, z of a reflector, or the angle alone, as x and y on the nominal radius;
over a part of the turn or round it), from exact geometry with nothing of the program: 13 to 37 targets, equal or uneven,
1 to 5 runs, both directions in five of six; no reversal, a constant one or one that depends on position; an outlier or
two in one of ten, a frame that wanders by two or three times the noise in one of ten. The error's RMS is 6 to 30 times
the noise:

    bow, wave, waves, dent, bend, ends, irregular, steps, scurve    no name in the catalogue
    scale, cyclic (tables: once, twice a turn), backlash, order (a screw's lead, a gear), length     a name in it
    noise                                                           nothing

The table is applied as a controller does: linear between entries, by direction, the end values held; what is left is
e(q + c) + c over 2001 positions of the measured range in the directions that were measured, RMS in units of the noise. The
base is known, so that the zero offset is real and counts; where the frame wanders the zero is the wander's as much as the
axis's, and a constant left does not count there. A session without model or table has no correction.

Beside it: `none`; `hand`, the mean of the deviations by target and direction, linear between targets (what a laser's own
software writes); `gp`, a Gaussian process (Matérn 5/2 or squared exponential, whichever is likelier, for the common part
and for half the reversal, periodic round a full turn; strengths, lengths and noise by restricted likelihood). `good`: at
most 1.1 times the better of hand and gp, plus 0.1; `not worse`: at most none + 0.1, or + 2/√samples where that is more (what
the mean of so many costs: the zero offset belongs to every calibration). `stated`: `leaves_mm` of `export --json`, which
is over samples, over what is left and the noise of one sample together, in the median, and how many state at least 0.8 of it.

Measured in November 2026, 75 sessions of seed 1, before the rest was in every model (medians; "c-u" with
`--correct-unexplained`, which was a flag then):

| kind | none | hand | gp | truepose | c-u | good, plain / c-u | not worse, plain / c-u |
| --- | --- | --- | --- | --- | --- | --- | --- |
| bow | 21.4 | 0.45 | 0.19 | 94.6 (leads that equal steps take for a bow) | 94.6 | 0 / 0 of 5 | 2 / 2 of 5 |
| wave | 16.1 | 0.50 | 0.26 | 10.1 | 0.49 | 0 / 3 of 5 | 4 / 4 of 5 |
| waves | 22.6 | 0.94 | 0.31 | 22.5 | 24.8 (once 6771) | 0 / 0 of 5 | 3 / 2 of 5 |
| dent | 19.7 | 0.74 | 0.36 | 7.3 | 0.66 | 0 / 1 of 5 | 5 / 5 of 5 |
| bend | 21.7 | 0.61 | 0.38 | 14.9 | 0.38 | 1 / 4 of 5 | 5 / 5 of 5 |
| ends | 32.7 | 0.82 | 0.47 | 17.4 | 7.6 | 0 / 2 of 5 | 4 / 5 of 5 |
| irregular | 13.0 | 0.49 | 0.26 | 8.1 | 0.36 | 0 / 5 of 5 | 5 / 5 of 5 |
| steps | 20.8 | 0.79 | 0.96 | 19.4 | 5.2 | 0 / 2 of 5 | 5 / 4 of 5 |
| scurve | 28.1 | 0.49 | 0.26 | 1.1 | 1.1 | 2 / 2 of 5 | 4 / 4 of 5 |
| scale, cyclic, backlash, length | 10 to 20 | 0.4 to 0.6 | 0.16 | 0.08 to 0.13 | the same | 19 / 20 of 20 | 20 / 20 of 20 |
| order | 15.3 | 3.14 | 0.69 | 0.96 | 0.96 | 3 / 3 of 5 | 3 / 3 of 5 |
| noise | 0 | 0.53 | 0.12 | 0.08 | 0.08 | 5 / 5 of 5 | 5 / 5 of 5 |
| without a name | 20.9 | 0.62 | 0.34 | 14.1, 36 times the better one | 0.74, 2.2 times | 3 / 19 of 45 | 37 / 36 of 45 |
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from wild_rows import Arm, Session  # noqa: E402

NAMELESS = ["bow", "wave", "waves", "dent", "bend", "ends", "irregular", "steps", "scurve"]
NAMED = ["scale", "cyclic", "backlash", "order", "length"]
KINDS = [*NAMELESS, *NAMED, "noise"]
GRID = 2001


def shape(kind, rng, targets):
    """An error over u in 0 … 1, of any size."""
    at, wide, phase = rng.uniform(0.25, 0.75), rng.uniform(0.04, 0.12), rng.uniform(0, 2 * np.pi)
    if kind == "bow":
        return lambda u: (u - at) ** 2
    if kind in ("wave", "waves"):
        cycles = rng.uniform(0.8, 1.7) if kind == "wave" else rng.uniform(2, max(2.5, (targets - 1) / 4.5))
        return lambda u: np.sin(2 * np.pi * cycles * u + phase)
    if kind == "dent":
        return lambda u: np.exp(-0.5 * ((u - at) / wide) ** 2)
    if kind == "bend":
        low, high = rng.normal(0, 1, 2)
        return lambda u: np.where(u < at, low, high) * (u - at)
    if kind == "ends":
        low, high = rng.uniform(0.3, 1, 2) * rng.choice([1, 1, 0], 2, replace=False)
        return lambda u: -low * np.exp(-u / wide) - high * np.exp((u - 1) / wide)
    if kind == "irregular":
        knots = np.linspace(-0.5, 1.5, 60)
        length = rng.uniform(0.08, 0.25)
        values = rng.normal(0, 1, 60)
        return lambda u: np.exp(-0.5 * ((np.asarray(u)[..., None] - knots) / (length / 2**0.5)) ** 2) @ values
    if kind == "steps":
        edges, heights = np.sort(rng.uniform(0.1, 0.9, 3)), rng.normal(0, 1, 3)
        if rng.random() < 0.5:
            return lambda u: sum(h * np.tanh((u - e) / 0.02) for e, h in zip(edges, heights))
        teeth = int(rng.integers(2, 4))
        # A sawtooth whose flank takes a twentieth of the tooth.
        return lambda u: np.interp((teeth * u + at) % 1, [0, 0.95, 1], [0, 1, 0])
    return lambda u: np.tanh((u - at) / (2 * wide))




class Axis:
    """One axis, its true error in inner units (mm, rad), its session."""

    def __init__(self, seed, index, kind):
        rng = np.random.default_rng([seed, index])
        self.name, self.kind = f"{kind}-{seed}-{index}", kind
        self.turns = kind == "cyclic" or kind == "length" or rng.random() < 0.5
        targets = int(rng.integers(13, 38))
        self.runs = int(rng.integers(1, 6))
        self.sides = [1, -1] if rng.random() < 5 / 6 or kind == "backlash" else [int(rng.choice([1, -1]))]
        self.period = None
        self.round = self.turns and rng.random() < 0.4
        if self.turns:
            half = 180.0 if self.round else rng.choice([45.0, 90.0, 120.0, 170.0])
            low, high = (0.0, 360.0) if self.round and rng.random() < 0.5 else (-half, half)
            self.unit, self.reach = np.radians(1), float(rng.choice([120.0, 250.0, 500.0]))
            self.reading = str(rng.choice(["angle", "xy", "xyz"])) if kind != "length" else "xy"
            self.sigma = float(rng.choice([0.001, 0.003])) if self.reading == "angle" else float(rng.choice([0.005, 0.015]))
        else:
            low, high = 0.0, float(rng.choice([200, 300, 450, 600, 1000, 1500]))
            if kind == "order":
                self.period = float(rng.choice([25, 32, 40]))
                high = np.ceil(self.period * (targets - 1) / rng.uniform(3, 6))
            self.unit, self.reach = 1.0, 1.0
            self.reading = "x" if rng.random() < 2 / 3 else "xyz"
            self.sigma = float(rng.choice([0.0005, 0.001])) if self.reading == "x" else float(rng.choice([0.005, 0.01]))
        self.low, self.high = low, high
        self.at = np.linspace(low, high, targets)
        if rng.random() < 0.4:
            # As ISO 230-2 wants them: equal steps, each target moved by a random part of one.
            self.at[1:-1] += rng.uniform(-0.35, 0.35, targets - 2) * (high - low) / (targets - 1)
        self.at = np.round(self.at, 3)
        self.make_error(rng, targets)
        self.measure(rng)

    def make_error(self, rng, targets):
        """`self.error(q, side)` along the motion, mm at the reflector; q as commanded."""
        kind, span = self.kind, self.high - self.low
        u = lambda q: (q - self.low) / span
        size = self.sigma * np.exp(rng.uniform(np.log(6), np.log(30)))
        grid = np.linspace(self.low, self.high, GRID)
        phase = rng.uniform(0, 2 * np.pi)
        if kind == "scale":
            curve = lambda q: q - (self.low + self.high) / 2
        elif kind == "cyclic":
            cycles = int(rng.integers(1, 3))
            curve = lambda q: np.sin(cycles * q * self.unit + phase)
        elif kind == "order":
            # Three to six targets a period; orders of a gear are whole from 3, leads those of ball screws.
            period = self.period or 360 / max(3, round(360 / (span / (targets - 1) * rng.uniform(3, 6))))
            curve = lambda q: np.sin(2 * np.pi * q / period + phase)
        elif kind in NAMELESS:
            own = shape(kind, rng, targets)
            # Round a turn an error closes: faded to its mean value at both ends.
            ends = own(np.array([0.0, 1.0]))
            closed = self.round
            curve = lambda q: own(u(q)) - (closed * (ends[0] + (ends[1] - ends[0]) * u(q)))
        else:
            curve = lambda q: 0 * q
        strength = np.std(curve(grid))
        scale = size / strength if strength > 0 else 0.0
        width = 0.0 if kind == "noise" or rng.random() < 0.5 else size * rng.uniform(0.1, 0.6)
        if kind == "backlash":
            width = 2 * size
        uneven = rng.random() < 0.4 and kind in NAMELESS
        lean = lambda q: 1 + uneven * 0.7 * np.sin(np.pi * u(q) + phase)
        zero = 0.0 if kind == "noise" or rng.random() < 0.5 else rng.normal(0, 8 * self.sigma)
        self.longer = rng.normal(0, 20 * self.sigma) if kind == "length" else 0.0
        if kind == "length":
            zero = size
        self.error = lambda q, side: zero + scale * curve(q) - side * width / 2 * lean(q)

    def measure(self, rng):
        order = np.sort(self.at)
        rows = [(q, s) for _ in range(self.runs) for s in self.sides for q in (order if s > 0 else order[::-1])]
        self.q, self.side = (np.array(v, float) for v in zip(*rows))
        n = len(self.q)
        self.time = np.cumsum(rng.choice([4.0, 5.0, 6.0], n) + 20.0 * (np.diff(self.side, prepend=0) != 0))
        wander = np.zeros((n, 3))
        self.wanders = rng.random() < 0.1 and self.kind != "noise"
        if self.wanders:
            step = rng.normal(0, 1, (n, 3)) * np.sqrt(np.diff(self.time, prepend=0))[:, None]
            walk = np.cumsum(step, axis=0)
            wander = rng.uniform(1.5, 3) * self.sigma * (walk - walk.mean(0)) / walk.std(0)
        apart = np.zeros(n)
        if rng.random() < 0.1 and self.runs > 1:
            which = rng.choice(n, int(rng.integers(1, 3)), replace=False)
            apart[which] = rng.choice([-1, 1], len(which)) * rng.uniform(20, 60, len(which)) * self.sigma
        along = self.error(self.q, self.side) + apart
        noise = rng.normal(0, self.sigma, (n, 3)) + wander
        if not self.turns:
            across = rng.uniform(0, 8) * self.sigma * np.sin(np.pi * (self.q - self.low) / (self.high - self.low))
            self.points = np.c_[self.q + along, 50 + across, 80 - across] + noise
            return
        angle = self.q * self.unit + along / self.reach
        if self.reading == "angle":
            angle = angle + noise[:, 0] / self.reach
            noise = 0 * noise
        length = self.reach + self.longer
        self.points = np.c_[length * np.cos(angle), length * np.sin(angle), np.full(n, 210.0)] + noise

    def deviations(self):
        """Measured deviations along the motion, mm."""
        if not self.turns:
            return self.points[:, 0] - self.q
        apart = np.arctan2(self.points[:, 1], self.points[:, 0]) - self.q * self.unit
        return self.reach * ((apart + np.pi) % (2 * np.pi) - np.pi)

    def write(self, folder):
        robot = Arm([[0, 0, 1]] if self.turns else [[1, 0, 0]], [[0, 0, 0]], [self.reach, 0, 210] if self.turns else [0, 50, 80])
        session = Session(robot, {}, self.sigma)
        read = {"x": "x", "xyz": "xyz", "xy": "xy", "angle": "xy"}[self.reading]
        session.columns = {f"q1_{'deg' if self.turns else 'mm'}": self.q.tolist()}
        for k, axis in enumerate("xyz"):
            if axis in read or not self.turns:
                session.columns[f"{axis}_mm"] = [round(v, 7) if axis in read else None for v in self.points[:, k].tolist()]
        session.columns.update(dir1=[int(s) for s in self.side], time_s=self.time.tolist())
        document = session.document()
        del document["targets"]
        document["name"] = self.name
        kind = "revolute" if self.turns else "prismatic"
        document["robot"]["joints"][0].update(kind=kind, limits=[self.low, self.high])
        path = Path(folder) / f"{self.name}.json"
        path.write_text(json.dumps(document) + "\n")
        return path

    def left(self, correction):
        """RMS of what a correction (command, side) in mm along the motion leaves, in units of the noise."""
        q = np.linspace(self.low, self.high, GRID)
        left = []
        for side in self.sides:
            c = correction(q, side)
            left.append(c + self.error(q + c / (self.reach * self.unit), side))
        left = np.concatenate(left)
        return float(np.sqrt(np.mean((left - self.wanders * left.mean()) ** 2)) / self.sigma)


def by_hand(axis):
    values = axis.deviations()
    means = {s: [values[(axis.q == q) & (axis.side == s)].mean() for q in axis.at] for s in axis.sides}
    return lambda q, side: -np.interp(q, axis.at, means[side])


def kernel(form, a, b, length, period):
    apart = np.abs(a[:, None] - b[None, :])
    if period:
        apart = period / np.pi * np.abs(np.sin(np.pi * apart / period))
    r = apart / length
    if form == "matern":
        return (1 + 5**0.5 * r + 5 * r * r / 3) * np.exp(-(5**0.5) * r)
    return np.exp(-0.5 * r * r)


def simplex(of, start, step=1.0, rounds=160):
    """Nelder and Mead's minimum of a function."""
    points = [np.array(start, float)] + [np.array(start, float) + step * e for e in np.eye(len(start))]
    values = [of(p) for p in points]
    for _ in range(rounds):
        order = np.argsort(values)
        points, values = [points[k] for k in order], [values[k] for k in order]
        if values[-1] - values[0] < 1e-3:
            break
        centre = np.mean(points[:-1], axis=0)
        tried = [centre + by * (points[-1] - centre) for by in (-1, -2, 0.5)]
        first = of(tried[0])
        if first < values[0]:
            further = of(tried[1])
            points[-1], values[-1] = (tried[1], further) if further < first else (tried[0], first)
        elif first < values[-2]:
            points[-1], values[-1] = tried[0], first
        else:
            inner = of(tried[2])
            if inner < values[-1]:
                points[-1], values[-1] = tried[2], inner
            else:
                points = [points[0]] + [points[0] + 0.5 * (p - points[0]) for p in points[1:]]
                values = [values[0]] + [of(p) for p in points[1:]]
    best = int(np.argmin(values))
    return points[best], values[best]


def gaussian_process(axis):
    """The likelier of two Gaussian processes through the means by target and side; the scatter within them is the noise's."""
    values = axis.deviations() / axis.sigma
    span = axis.high - axis.low
    period = 1.0 if axis.round else None
    cells = [(q, s, values[(axis.q == q) & (axis.side == s)]) for s in axis.sides for q in axis.at]
    u = np.array([(q - axis.low) / span for q, _, _ in cells])
    side, count = np.array([s for _, s, _ in cells]), np.array([len(v) for _, _, v in cells])
    mean = np.array([v.mean() for _, _, v in cells])
    within, spare = sum(((v - v.mean()) ** 2).sum() for _, _, v in cells), sum(len(v) - 1 for _, _, v in cells)
    both = len(axis.sides) > 1
    trend = lambda u, s: np.c_[np.ones(len(u)), *([] if period else [u - 0.5]), *([s / 2] if both else [])]
    x = trend(u, side)

    def covariance(form, p, a, sa, b, sb):
        k = np.exp(2 * p[0]) * kernel(form, a, b, np.exp(p[1]), period)
        if both:
            k = k + np.exp(2 * p[3]) * kernel(form, a, b, np.exp(p[4]), period) * np.outer(sa, sb) / 4
        return k

    def solved(form, p):
        c = covariance(form, p, u, side, u, side) + np.diag(np.exp(2 * p[2]) / count)
        lower = np.linalg.cholesky(c)
        half = np.linalg.solve(lower, np.c_[x, mean])
        xs, ys = half[:, :-1], half[:, -1]
        fisher = xs.T @ xs
        beta = np.linalg.solve(fisher, xs.T @ ys)
        return lower, beta, ((ys - xs @ beta) ** 2).sum(), np.log(np.diag(lower)).sum() + np.linalg.slogdet(fisher)[1] / 2

    def minus(form, p):
        # Lengths between a third of a step and three ranges.
        if np.any(np.abs(p) > 8) or not np.log(0.3 / len(axis.at)) < p[1] < np.log(3.0) or (both and not -3.5 < p[4] < 1.1):
            return 1e9
        try:
            _, _, chi, logs = solved(form, p)
        except np.linalg.LinAlgError:
            return 1e9
        return chi / 2 + logs + within / 2 * np.exp(-2 * p[2]) + spare * p[2]

    best = None
    for form in ("matern", "square"):
        for length in (0.1, 0.4):
            start = [np.log(mean.std() + 0.1), np.log(length), 0.0] + ([0.0, np.log(0.5)] if both else [])
            p, value = simplex(lambda p: minus(form, p), start)
            if best is None or value < best[0]:
                best = value, form, p
    _, form, p = best
    lower, beta, _, _ = solved(form, p)
    weights = np.linalg.solve(lower.T, np.linalg.solve(lower, mean - x @ beta))

    def correction(q, s):
        a, sides = (q - axis.low) / span, np.full(len(q), float(s))
        return -axis.sigma * (trend(a, sides) @ beta + covariance(form, p, a, sides, u, side) @ weights)

    return correction


def of_program(binary, axis, folder, options):
    """(correction, verdict, found, stated leaves_mm, seconds) of the program's own table."""
    path = axis.write(folder)
    model, table = path.with_suffix(".model"), path.with_suffix(".csv")
    start = time.time()
    done = subprocess.run(
        [binary, "diagnose", path, "--json", "--force", "--out", model, *options], capture_output=True, text=True
    )
    if done.returncode:
        return None, done.stderr.strip().splitlines()[-1], [], None, time.time() - start
    answer = json.loads(done.stdout)
    seconds = time.time() - start
    found = [f["effect"] for f in answer["found"]]
    wrote = subprocess.run(
        [binary, "export", model, "--to", "csv", "--out", table, "--json", "--force"], capture_output=True, text=True
    )
    if wrote.returncode:
        return None, f"{answer['verdict']}, no table: {wrote.stderr.strip().splitlines()[-1]}", found, None, seconds
    stated = json.loads(wrote.stdout).get("leaves_mm")
    with open(table) as file:
        rows = np.array([[float(v) for v in row] for row in list(csv.reader(file))[1:]])
    to_mm = axis.reach * axis.unit
    # Some formats have one column for both directions.
    columns = {1: rows[:, 1], -1: rows[:, -1]}
    correction = lambda q, side: to_mm * np.interp(q, rows[:, 0], columns[int(np.sign(side))])
    return correction, answer["verdict"], found, stated, seconds


def one(binary, seed, index, kind, folder, options):
    axis = Axis(seed, index, kind)
    correction, verdict, found, stated, seconds = of_program(binary, axis, folder, options)
    none = axis.left(lambda q, _: 0 * q)
    left = axis.left(correction) if correction else none
    hand, smooth = axis.left(by_hand(axis)), axis.left(gaussian_process(axis))
    return {
        "name": axis.name, "kind": kind, "none": none, "hand": hand, "gp": smooth, "left": left,
        "good": left <= 1.1 * min(hand, smooth) + 0.1, "not_worse": left <= none + max(0.1, 2 / len(axis.q) ** 0.5),
        "verdict": verdict, "found": found, "stated": stated / axis.sigma / np.hypot(left, 1) if stated is not None else None,
        "seconds": seconds,
        "how": f"{'table' if axis.turns else 'slide'} {axis.reading}{' round' if axis.round else ''}, {len(axis.at)} targets, "
        f"{axis.runs} runs, {len(axis.sides)} sides{', wanders' if axis.wanders else ''}",
    }


def row(name, all_):
    middle = lambda key: np.median([r[key] for r in all_])
    ratio = np.median([r["left"] / min(r["hand"], r["gp"]) for r in all_])
    share = lambda key: f"{sum(r[key] for r in all_)}/{len(all_)}"
    verdicts = {}
    for r in all_:
        verdicts[r["verdict"].split(":")[0]] = verdicts.get(r["verdict"].split(":")[0], 0) + 1
    stated = [r["stated"] for r in all_ if r["stated"] is not None]
    says = f"{np.median(stated):.2f}, {sum(s >= 0.8 for s in stated)}/{len(stated)}" if stated else "–"
    said = ", ".join(f"{v} {k}" for k, v in sorted(verdicts.items(), key=lambda v: -v[1]))
    print(
        f"| {name} | {middle('none'):.2f} | {middle('hand'):.2f} | {middle('gp'):.2f} | {middle('left'):.2f} | {ratio:.2f} | "
        f"{share('good')} | {share('not_worse')} | {says} | {middle('seconds'):.1f} | {said} |",
        flush=True,
    )


def main():
    a = argparse.ArgumentParser()
    a.add_argument("binary")
    a.add_argument("--count", type=int, default=72)
    a.add_argument("--seed", type=int, default=1)
    a.add_argument("--kinds", default=",".join(KINDS))
    a.add_argument("--jobs", type=int, default=1)
    a.add_argument("--list", action="store_true")
    a.add_argument("--keep")
    argv = sys.argv[1:]
    cut = argv.index("--") if "--" in argv else len(argv)
    given, options = a.parse_args(argv[:cut]), argv[cut + 1 :]
    if given.keep:
        Path(given.keep).mkdir(parents=True, exist_ok=True)
    kinds = given.kinds.split(",")
    print("| kind | none | hand | gp | truepose | over the better | good | not worse | stated | s | verdicts |")
    print("| --- " * 11 + "|", flush=True)
    results = []
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(given.jobs) as pool:
        folder = given.keep or temporary
        for k, kind in enumerate(kinds):
            # A session is the same whatever other kinds are asked for.
            own = KINDS.index(kind)
            rounds = range(given.count // len(kinds) + (k < given.count % len(kinds)))
            todo = lambda r: one(given.binary, given.seed, own + len(KINDS) * r, kind, folder, options)
            of_kind = list(pool.map(todo, rounds))
            if of_kind:
                row(kind, of_kind)
            results += of_kind
    for name, kinds in (("without a name", NAMELESS), ("with a name", NAMED), ("all", KINDS)):
        part = [r for r in results if r["kind"] in kinds]
        if part:
            row(name, part)
    if given.list:
        for r in results:
            if not (r["good"] and r["not_worse"]):
                print(
                    f"{r['name']}: {r['how']}: none {r['none']:.2f}, hand {r['hand']:.2f}, gp {r['gp']:.2f}, truepose "
                    f"{r['left']:.2f}; {r['verdict']}, {r['found']}"
                )


if __name__ == "__main__":
    main()
