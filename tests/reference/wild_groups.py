#!/usr/bin/env python3
"""One group of a session (a target, a socket, a setup, a station, a plane, an anchor) that is elsewhere, or was
moved between two visits: does the answer name it?

    python3 tests/reference/wild_groups.py BINARY [--count 12] [--kinds anchor,…] [--verbose]

Exact geometry of a six-joint arm, nothing of the program: 150 poses, several groups of the kind, one of which is
0.3 to 1.5 mm (a station also 0.2 to 1 mrad) elsewhere from a third or a half of its rows on (`moved`), or not
where the session says (`stated`, where a session may say it). Everything else is as it should be: 0.02 mm of
noise and geometry errors of 0.3 mm and 0.5 mrad.

Measured in November 2026, 8 sessions a kind: before (with four planes instead of six), none of 80 was named, twelve
had the name of an effect instead, and the final error was 0.8 to 11 times the floor in the median of a kind (one
answer said "noise" at 14.9 times it). Then 78 of 80 were named with the right group: one plane that moved ended at the
noise without, and of four anchors one was taken for another. Of four planes one that is not where it is stated cannot
be told, as frame and overall size take up four. With the bounds that were set later, on how many
numbers show a place and how little another group than a socket has to leave: 59 of 60 (6 a kind).

"named" is that `unexplained.where` or the problem of the data names the group, "others" that another group is
named, "names" that an effect is, and "end" the median of the final error over the floor.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from wild_rows import SIX, rotation  # noqa: E402

SIGMA, SIGMA_ANGLE = 0.02, 1e-5
TARGETS = {"T1": np.array([0.0, 0, 70]), "T2": np.array([60.0, 25, 40]), "T3": np.array([-35.0, 55, 60])}
KINDS = [
    "target-moved", "socket-moved", "socket-stated", "setup-moved", "station-moved", "station-stated", "plane-moved",
    "plane-stated", "anchor-moved", "anchor-stated",
]
WIDE = np.array([140, 50, 50, 140, 90, 140.0])


def offset(rng, least=0.3, most=1.5):
    v = rng.normal(size=3)
    return v / np.linalg.norm(v) * rng.uniform(least, most)


def reach(arm, goal, rows, target, rng):
    """Joint values that bring a target onto what `goal` asks to be zero, by Newton's method."""
    for _ in range(60):
        q = rng.uniform(-1, 1, 6) * WIDE
        for _ in range(30):
            e = goal(arm.point(np.radians(q), target))
            j = np.stack([(goal(arm.point(np.radians(q + d), target)) - e) / 1e-4 for d in np.eye(6) * 1e-4], -1)
            q = q - np.linalg.lstsq(j, e, rcond=1e-6)[0]
            if np.abs(e).max() < 1e-9:
                break
        if np.abs(e).max() < 1e-9 and (np.abs(q) < WIDE * 1.2).all():
            return q
    return None


def make(kind, index, n=150):
    what, how = kind.split("-")
    rng = np.random.default_rng([sum(map(ord, kind)), index])
    true = SIX.spoilt(rng, 0.3, 0.5)
    zeros = np.radians(rng.normal(0, 0.1, 6))
    moved = type(true)(true.axes, true.points, true.tool)
    point = lambda q, t: moved.point(np.radians(q) + zeros, t)
    columns = {}
    several = {"target": 3, "socket": 6, "setup": 3, "station": 3, "plane": 6, "anchor": 4}[what]
    group = rng.integers(0, several, n)
    wrong = int(rng.integers(0, several))
    own = np.flatnonzero(group == wrong)
    late = set(own[int(len(own) * rng.choice([1 / 3, 1 / 2])) :]) if how == "moved" else set(own)
    by = offset(rng)
    names = [f"G{g + 1}" for g in group]
    document = {"targets": {"T1": [0, 0, 70.0]}}
    q = rng.uniform(-1, 1, (n, 6)) * WIDE
    instrument = {"name": "i", "sigma_mm": SIGMA}
    if what == "target":
        places = list(TARGETS.values())
        points = np.array([point(q[i], places[group[i]] + (by if i in late else 0)) for i in range(n)])
        names = [f"T{g + 1}" for g in group]
        document["targets"] = {k: list(v) for k, v in TARGETS.items()}
        columns["target"] = names
    elif what == "setup":
        frames = [(rotation(rng.normal(size=3), rng.uniform(0, 3)), rng.uniform(-1500, 1500, 3)) for _ in range(several)]
        points = np.array([
            frames[g][0] @ point(q[i], TARGETS["T1"]) + frames[g][1] + (by if i in late else 0) for i, g in enumerate(group)
        ])
        columns["setup"] = names
    elif what in ("socket", "plane"):
        places = []
        for _ in range(several):
            if what == "socket":
                places.append(np.array([rng.uniform(350, 600), rng.uniform(-350, 350), rng.uniform(350, 800)]))
            else:
                normal = rng.normal(size=3) * 0.3 + [[0, 0, 1], [1, 0, 0], [0, 1, 0], [1, 1, 1], [1, -1, 1], [1, 0, -1]][len(places)]
                normal /= np.linalg.norm(normal)
                places.append((normal, normal @ np.array([450, 30, 600]) + rng.uniform(-60, 60)))
        driven = np.zeros((n, 6))
        base = type(true)(true.axes, true.points, true.tool)
        shift = {i: (by if i in late else np.zeros(3)) for i in range(n)}
        amount = rng.uniform(0.3, 1.5) * rng.choice([-1, 1])
        for i in range(n):
            place = places[group[i]]
            if what == "socket":
                goal = lambda p: p - place - shift[i] - noise
                noise = rng.normal(0, SIGMA, 3)
            else:
                noise = rng.normal(0, SIGMA)
                goal = lambda p: np.array([place[0] @ p - place[1] - (amount if i in late else 0) - noise])
            # The controller's values are those without the true zero offsets.
            found = reach(base, goal, 3, TARGETS["T1"], rng)
            while found is None:
                found = reach(base, goal, 3, TARGETS["T1"], rng)
            driven[i] = found - np.degrees(zeros)
        q = driven
        if what == "socket":
            instrument["sigma_mm"] = SIGMA
            document["sockets"] = {f"G{k + 1}": {"position_mm": list(p)} for k, p in enumerate(places)}
            if how == "moved":
                document["sockets"] = {f"G{k + 1}": ({"position_mm": list(p)} if k < 3 and k != wrong else {}) for k, p in enumerate(places)}
        else:
            instrument["sigma_touch_mm"] = SIGMA
            document["planes"] = {f"G{k + 1}": {"normal": list(p[0]), "distance_mm": p[1]} for k, p in enumerate(places)}
            if how == "moved":
                document["planes"] = {k: ({} if k == f"G{wrong + 1}" else v) for k, v in document["planes"].items()}
        columns[what] = names
    elif what == "anchor":
        places = [np.array(p, float) for p in ([1200, 900, 100], [1100, -1000, 300], [-900, 800, 1200], [-800, -900, 200])]
        columns["distance_mm"] = [
            float(np.linalg.norm(point(q[i], TARGETS["T1"]) - places[g] - (by if i in late else 0)) + rng.normal(0, SIGMA))
            for i, g in enumerate(group)
        ]
        columns["anchor"] = names
        instrument = {"name": "i", "sigma_distance_mm": SIGMA}
        document["anchors"] = {f"G{k + 1}": {"position_mm": list(p), "offset_mm": 0} for k, p in enumerate(places)}
        if how == "moved":
            document["anchors"][f"G{wrong + 1}"] = {"offset_mm": 0}
    elif what == "station":
        places = [np.array(p, float) for p in ([2200, 900, 600], [300, -2400, 500], [-1900, 1200, 900])]
        turn = rotation(rng.normal(size=3), rng.uniform(2e-4, 1e-3))
        azimuth, elevation = [], []
        for i, g in enumerate(group):
            d = point(q[i], TARGETS["T1"]) - places[g] - (by if i in late else 0)
            d = turn @ d if i in late else d
            azimuth.append(float(np.degrees(np.arctan2(d[1], d[0]) + rng.normal(0, SIGMA_ANGLE))))
            elevation.append(float(np.degrees(np.arctan2(d[2], np.hypot(d[0], d[1])) + rng.normal(0, SIGMA_ANGLE))))
        columns.update(azimuth_deg=azimuth, elevation_deg=elevation, station=names)
        instrument = {"name": "i", "sigma_direction_urad": SIGMA_ANGLE * 1e6}
        level = {"quaternion_wxyz": [1, 0, 0, 0]}
        document["stations"] = {f"G{k + 1}": {"position_mm": list(p), **level} for k, p in enumerate(places)}
        if how == "moved":
            document["stations"][f"G{wrong + 1}"] = {}
    if what in ("target", "setup"):
        points = points + rng.normal(0, SIGMA, points.shape)
        for k, axis in enumerate("xyz"):
            columns[f"{axis}_mm"] = list(np.round(points[:, k], 6))
    columns.update({f"q{k + 1}_deg": list(np.round(q[:, k], 8)) for k in range(6)})
    columns["time_s"] = [10.0 * i for i in range(n)]
    joints = [
        {"name": f"j{k + 1}", "kind": "revolute", "axis": list(a), "point_mm": list(p), "limits": [-180, 180]}
        for k, (a, p) in enumerate(zip(SIX.axes, SIX.points))
    ]
    document = {
        "format": "truepose-session/1",
        "name": f"{kind}-{index}",
        "robot": {"name": "r", "joints": joints, "tool": {"position_mm": list(SIX.tool), "quaternion_wxyz": [1, 0, 0, 0]}},
        "instrument": instrument,
        "samples": {"columns": columns},
        **document,
    }
    name = names[own[0]]
    return document, f"{what} {name}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--keep")
    parser.add_argument("--verbose", action="store_true")
    given = parser.parse_args()
    print(f"{'kind':16} {'named':>8} {'others':>7} {'names':>6} {'end/floor':>10}")
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or temporary
        for kind in given.kinds.split(","):
            named = others = names = failed = 0
            ratios = []
            for index in range(given.count):
                document, wanted = make(kind, index)
                path = os.path.join(folder, f"{kind}-{index}.json")
                with open(path, "w") as file:
                    json.dump(document, file, default=float)
                done = subprocess.run([given.binary, "diagnose", path, "--json"], capture_output=True, text=True)
                if done.returncode:
                    failed += 1
                    print("   ", kind, index, done.stderr.strip()[-200:], file=sys.stderr)
                    continue
                answer = json.loads(done.stdout)
                place = answer["unexplained"]["where"] or {}
                said = [p["what"] for p in answer["data_problems"]] + [str(place.get("variable"))]
                hit = any(f"{wanted} " in f"{s} " for s in said)
                what = wanted.split(" ")[0]
                other = any(f"{what} " in s and f"{wanted} " not in f"{s} " for s in said)
                named, others, names = named + hit, others + other, names + bool(answer["found"])
                ratios.append(answer["gap"]["end_mm"] / max(answer["floor"]["mm"], 1e-9))
                if given.verbose and (not hit or other or answer["found"]):
                    found = [(f["effect"], f.get("joint")) for f in answer["found"]]
                    print("   ", kind, index, wanted, answer["verdict"], said, found, round(ratios[-1], 2), file=sys.stderr)
            print(f"{kind:16} {named:3}/{given.count:<4} {others:7} {names:6} {np.median(ratios) if ratios else np.nan:10.2f}" + (f"  {failed} failed" if failed else ""), flush=True)


if __name__ == "__main__":
    main()
