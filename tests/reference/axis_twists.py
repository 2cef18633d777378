#!/usr/bin/env python3
"""The tables of `axis_tables.py` where the axis is measured in less usual ways.

    python tests/reference/axis_twists.py BINARY [--count 2] [--seed 5] [--twists few,jitter]

few: 4 to 7 targets, three runs at least. jitter: each visit of a target is commanded by a twentieth of a step elsewhere.
dense: 300 targets in one run. far: a slide 5000 mm from its origin. huge: twenty times the error. pilgrim: both sides of a
target, then the next. shuffled: rows in any order. sparse: every third target from the other side. bumped: the instrument
is moved between two runs. warming: the axis grows from run to run. unequal: one side has four times the noise. coarse:
readings rounded to four times the noise. swap: the readings of two neighbours are exchanged.

`good`: at most 1.1 times what the mean by target leaves, plus a tenth of the noise; `worse` than no table; `stated`: the
larger of `leaves_mm` and `between_targets_mm` is at least 0.8 of the true figure. A constant that is the instrument's as
much as the axis's does not count where the instrument is moved or the axis grows.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import axis_tables  # noqa: E402

KINDS = ["bow", "waves", "dent", "irregular", "steps", "scale", "cyclic", "backlash", "order", "noise"]
TWISTS = "few jitter dense far huge pilgrim shuffled sparse bumped warming unequal coarse swap".split()


class Twisted(axis_tables.Axis):
    def __init__(self, seed, index, kind, twist):
        self.twist = twist
        super().__init__(seed, index, kind)
        self.name = f"{twist}-{kind}-{seed}-{index}"

    def make_error(self, rng, targets):
        if self.twist == "few":
            self.at = np.round(np.linspace(self.low, self.high, int(rng.integers(4, 8))), 3)
            self.runs, targets = max(self.runs, 3), 13
        if self.twist == "dense":
            self.at, self.runs, self.sides = np.round(np.linspace(self.low, self.high, 300), 3), 1, [1, -1]
        if self.twist == "far" and not self.turns:
            self.low, self.high, self.at = self.low + 5000, self.high + 5000, self.at + 5000
        super().make_error(rng, targets)
        if self.twist == "huge":
            once = self.error
            self.error = lambda q, side: 20 * once(q, side)

    def rows(self, rng):
        """Target, side and run of every reading."""
        order = np.sort(self.at)
        for run in range(self.runs):
            if self.twist == "pilgrim" and len(self.sides) > 1:
                yield from ((q, side, run) for q in order for side in (1, -1))
                continue
            for side in self.sides:
                own = order if side > 0 else order[::-1]
                own = own[::3] if self.twist == "sparse" and side < 0 else own
                yield from ((q, side, run) for q in own)

    def measure(self, rng):
        rows = list(self.rows(rng))
        if self.twist == "shuffled":
            rng.shuffle(rows)
        self.nominal, self.side, run = np.array(rows, float).T
        self.q, n = self.nominal.copy(), len(rows)
        if self.twist == "jitter":
            step = (self.high - self.low) / max(1, len(self.at) - 1)
            self.q = np.clip(np.round(self.q + rng.normal(0, 0.05 * step, n), 3), self.low, self.high)
        self.time = np.cumsum(rng.choice([4.0, 5.0, 6.0], n) + 20.0 * (np.diff(self.side, prepend=0) != 0))
        along = self.error(self.q, self.side)
        self.wanders = self.twist in ("bumped", "warming") and self.runs > 1
        if self.wanders and self.twist == "bumped":
            first = int(rng.integers(1, self.runs))
            along = along + (run >= first) * rng.choice([-1, 1]) * rng.uniform(5, 20) * self.sigma
        elif self.wanders:
            along = along + run * rng.uniform(1, 3) * self.sigma * (self.q - self.low) / (self.high - self.low)
        sigma = self.sigma * np.where((self.twist == "unequal") & (self.side < 0), 4.0, 0.4 if self.twist == "coarse" else 1.0)
        noise = rng.normal(0, 1, (n, 3)) * sigma[:, None]
        if self.twist == "swap":
            k = int(rng.integers(0, n - 1))
            along[[k, k + 1]] = along[[k + 1, k]] + np.diff(self.q)[k] * np.array([1, -1]) * self.unit * self.reach
        if self.turns:
            angle, length = self.q * self.unit + along / self.reach, self.reach + self.longer
            if self.reading == "angle":
                angle, noise = angle + noise[:, 0] / self.reach, 0 * noise
            self.points = np.c_[length * np.cos(angle), length * np.sin(angle), np.full(n, 210.0)] + noise
        else:
            across = rng.uniform(0, 8) * self.sigma * np.sin(np.pi * (self.q - self.low) / (self.high - self.low))
            self.points = np.c_[self.q + along, 50 + across, 80 - across] + noise
        if self.twist == "coarse" and not (self.turns and self.reading == "angle"):
            self.points = np.round(self.points / (4 * self.sigma)) * 4 * self.sigma


def by_hand(axis):
    values, means = axis.deviations(), {}
    middle = np.median if axis.twist == "swap" else np.mean
    for side in axis.sides:
        own = [(axis.nominal == q) & (axis.side == side) for q in np.unique(axis.nominal)]
        own = [rows for rows in own if rows.any()]
        means[side] = [axis.q[rows].mean() for rows in own], [middle(values[rows]) for rows in own]
    return lambda q, side: -np.interp(q, *means[side])


def one(binary, seed, index, kind, twist, folder):
    axis = Twisted(seed, index, kind, twist)
    correction, verdict, found, stated, _ = axis_tables.of_program(binary, axis, folder, [])
    none, hand = axis.left(lambda q, _: 0 * q), axis.left(by_hand(axis))
    left = axis.left(correction) if correction else none
    table = Path(folder) / f"{axis.name}.csv.meta.json"
    if stated is not None and table.exists():
        stated = max(stated, json.loads(table.read_text())["leaves"]["between_targets_mm"] or 0)
    return {
        "name": axis.name, "none": none, "hand": hand, "left": left, "good": left <= 1.1 * hand + 0.1,
        "worse": left > none + max(0.1, 2 / len(axis.q) ** 0.5), "verdict": verdict, "found": found,
        "stated": None if stated is None else stated / axis.sigma / np.hypot(left, 1),
    }


def main():
    a = argparse.ArgumentParser()
    a.add_argument("binary")
    a.add_argument("--count", type=int, default=2)
    a.add_argument("--seed", type=int, default=5)
    a.add_argument("--twists", default=",".join(TWISTS))
    given = a.parse_args()
    good = all_ = 0
    with tempfile.TemporaryDirectory() as folder:
        for twist in given.twists.split(","):
            results = [one(given.binary, given.seed, i, kind, twist, folder) for i in range(given.count) for kind in KINDS]
            good, all_ = good + sum(r["good"] for r in results), all_ + len(results)
            known = [r["stated"] for r in results if r["stated"] is not None]
            ratio = np.median([r["left"] / max(r["hand"], 1e-9) for r in results])
            print(
                f"{twist}: {sum(r['good'] for r in results)} of {len(results)} good, {sum(r['worse'] for r in results)} worse, "
                f"{ratio:.2f} of the table by hand in the median, {sum(s >= 0.8 for s in known)} of {len(known)} stated",
                flush=True,
            )
            for r in results:
                if r["worse"] or not r["good"] or r["stated"] is None or r["stated"] < 0.5:
                    print("   ", *(f"{k} {r[k]:.2f}" if isinstance(r[k], float) else str(r[k]) for k in r if k not in ("good", "worse")))
    print(f"{good} of {all_}")


if __name__ == "__main__":
    main()
