"""Sessions of an arm for ISO 9283 and their figures, from the text of the standard alone (1998, clauses
7.2, 7.3, 8.2, 8.3): numpy and scipy, sharing nothing with src/.

    python tests/reference/iso9283.py tests/data/standards

writes `poses.json` (five poses in 30 cycles, with orientations), `paths.json` (a time series of a straight
path in 10 cycles and its way back, sampled at other instants in every cycle, and a circle in 4), and
`expected.json` with AP, RP, AT and RT of position and orientation.
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from programs import LIMITS, SIX, TOOL, Robot

RNG = np.random.default_rng(9283)
ARM = Robot([("revolute", a, p) for a, p in SIX], TOOL)


def inverse(pose, start):
    """Joint values that bring the nominal tool to a pose."""

    def missing(q):
        here = ARM.pose(q)
        turn = Rotation.from_matrix(here[:3, :3].T @ pose[:3, :3]).as_rotvec()
        return np.r_[(here - pose)[:3, 3] / 100, turn]

    found = least_squares(missing, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.abs(found.fun).max() < 1e-9
    return found.x


def robot():
    q = Rotation.from_matrix(TOOL[:3, :3]).as_quat()
    return {
        "name": "six",
        "joints": [
            {"name": f"j{k + 1}", "kind": "revolute", "axis": a, "point_mm": p, "limits": LIMITS[k]}
            for k, (a, p) in enumerate(SIX)
        ],
        "tool": {"position_mm": TOOL[:3, 3].tolist(), "quaternion_wxyz": [q[3], *q[:3]]},
    }


def session(name, q, poses, more):
    turns = np.array([Rotation.from_matrix(p[:3, :3]).as_quat() for p in poses])
    columns = {f"q{k + 1}_deg": np.degrees(q[:, k]).tolist() for k in range(6)}
    columns |= {c: [p[k, 3] for p in poses] for k, c in enumerate(["x_mm", "y_mm", "z_mm"])}
    columns |= {c: turns[:, k].tolist() for c, k in (("qw", 3), ("qx", 0), ("qy", 1), ("qz", 2))}
    columns |= more
    return {
        "format": "truepose-session/1",
        "name": name,
        "robot": robot(),
        "samples": {"columns": columns},
    }


def off(pose, turn_deg, shift):
    out = pose.copy()
    out[:3, :3] = Rotation.from_rotvec(np.radians(turn_deg)).as_matrix() @ pose[:3, :3]
    out[:3, 3] += shift
    return out


def turn_deg(attained, commanded):
    return np.degrees(Rotation.from_matrix(attained[:3, :3] @ commanded[:3, :3].T).as_rotvec())


def spread(points):
    """Barycentre, and mean + 3 S of the distances from it."""
    centre = np.mean(points, axis=0)
    far = np.linalg.norm(points - centre, axis=1)
    return centre, far.mean() + 3 * far.std(ddof=1)


def pose_test():
    commanded = np.radians(
        [
            [10, 25, -20, 15, 40, -30],
            [30, 40, -35, -20, 55, 60],
            [-25, 10, 5, 35, -50, 80],
            [-40, 35, -15, -10, 65, -45],
            [20, -15, 20, 50, 45, 20],
        ]
    )
    biases = [(RNG.normal(0, 0.05, 3), RNG.normal(0, 0.4, 3)) for _ in commanded]
    rows, attained = [], []
    for _ in range(30):
        for k in range(4, -1, -1):
            turn, shift = biases[k]
            noise = RNG.normal(0, 0.01, 3), RNG.normal(0, 0.03, 3)
            rows.append(k)
            attained.append(off(ARM.pose(commanded[k]), turn + noise[0], shift + noise[1]))
    figures = []
    for k in range(4, -1, -1):
        mine = [p for p, row in zip(attained, rows) if row == k]
        target = ARM.pose(commanded[k])
        centre, repeatability = spread(np.array([p[:3, 3] for p in mine]))
        turns = np.array([turn_deg(p, target) for p in mine])
        figures.append(
            {
                "AP_p_mm": np.linalg.norm(centre - target[:3, 3]),
                "AP_mm": (centre - target[:3, 3]).tolist(),
                "RP_l_mm": repeatability,
                "AP_deg": turns.mean(axis=0).tolist(),
                "RP_deg": (3 * turns.std(axis=0, ddof=1)).tolist(),
            }
        )
    return session("poses", commanded[rows], attained, {}), figures


def followed(start, places):
    """Joint values along places of the tool, the orientation kept."""
    q, pose = [start], ARM.pose(start)
    for place in places:
        goal = pose.copy()
        goal[:3, 3] = place
        q.append(inverse(goal, q[-1]))
    return q[1:]


def path_test():
    start = np.radians([10, 25, -20, 15, 40, -30])
    home = ARM.pose(start)[:3, 3]
    way = np.array([-90.0, 140.0, 60.0])
    across = np.array([-0.6, 0.0, -0.8])
    along = np.array([0.0, 1.0, 0.0])
    q, attained, names = [], [], []

    def pass_over(name, places, error):
        values = followed(start if not q else q[-1], places)
        for k, value in enumerate(values):
            turn, shift = error(k / (len(values) - 1))
            noise = RNG.normal(0, 0.002, 3), RNG.normal(0, 0.01, 3)
            attained.append(off(ARM.pose(value), turn + noise[0], shift + noise[1]))
            q.append(value)
            names.append(name)

    unit = way / np.linalg.norm(way)
    n = 41
    for cycle in range(10):
        phase = 0 if cycle == 0 else RNG.uniform(-0.4, 0.4)
        parts = np.clip((np.arange(n) + phase) / (n - 1), 0, 1)
        own, own_turn = RNG.normal(0, 0.05, 3), RNG.normal(0, 0.01, 3)

        def error(u, own=own, own_turn=own_turn, sign=1.0):
            lag = -0.8 * sign * unit * min(1.0, 6 * u, 6 * (1 - u))
            bump = np.array([0.1, 0.05, 0.35]) * np.sin(np.pi * u)
            return own_turn + np.array([0.04, -0.02, 0.03]) * u, own + bump + lag

        pass_over("line", home + parts[:, None] * way, error)
        back = np.linspace(1, 0, 16)[1:-1] + (0.0 if cycle == 0 else RNG.uniform(-0.02, 0.02))
        pass_over("back", home + back[:, None] * way, lambda u, e=error: e(u, sign=-1.0))
    for cycle in range(4):
        angles = np.linspace(0, 2 * np.pi, 61)[:-1, None]
        own, own_turn = RNG.normal(0, 0.08, 3), RNG.normal(0, 0.01, 3)
        places = home + 40 * (np.sin(angles) * along + (1 - np.cos(angles)) * across)
        pass_over("circle", places, lambda u, o=own, t=own_turn: (t, o + [0.2 * np.sin(9 * u), 0, 0]))
    time = (0.05 * np.arange(len(q))).tolist()
    q, names = np.array(q), np.array(names)
    return session("paths", q, attained, {"time_s": time}), q, attained, names


def path_figures(q, attained, commanded):
    """AT and RT of cycles (lists of rows): where they cross the planes across the first one's path."""
    at = np.array([ARM.pose(v)[:3, 3] for v in commanded])
    accuracy, repeatability, turns, scatter, judged = 0.0, 0.0, np.zeros(3), np.zeros(3), 0
    for i, place in enumerate(at):
        tangent = at[min(i + 1, len(at) - 1)] - at[max(i - 1, 0)]
        tangent /= np.linalg.norm(tangent)
        points, angles = [], []
        for cycle in attained:
            places = np.array([p[:3, 3] for p in cycle])
            height = (places - place) @ tangent
            up = [
                k
                for k in range(len(cycle) - 1)
                if height[k] <= 0 <= height[k + 1] and height[k] < height[k + 1] and abs(k - i) < 10
            ]
            if not up:
                break
            k = min(up, key=lambda k: (abs(k - i), k))
            part = height[k] / (height[k] - height[k + 1])
            points.append(places[k] + part * (places[k + 1] - places[k]))
            a, b = (Rotation.from_matrix(cycle[j][:3, :3]) for j in (k, k + 1))
            here = (Rotation.from_rotvec(part * (b * a.inv()).as_rotvec()) * a).as_matrix()
            target = ARM.pose(commanded[i])[:3, :3]
            angles.append(np.degrees(Rotation.from_matrix(here @ target.T).as_rotvec()))
        if len(points) < len(attained):
            continue
        judged += 1
        centre, far = spread(np.array(points))
        accuracy = max(accuracy, np.linalg.norm(centre - place))
        repeatability = max(repeatability, far)
        turns = np.maximum(turns, np.abs(np.mean(angles, axis=0)))
        scatter = np.maximum(scatter, 3 * np.std(angles, axis=0, ddof=1))
    return {
        "cycles": len(attained),
        "points": judged,
        "AT_p_mm": accuracy,
        "RT_p_mm": repeatability,
        "AT_deg": turns.tolist(),
        "RT_deg": scatter.tolist(),
    }


def cycles_of(names, name, count):
    rows = np.nonzero(names == name)[0]
    return np.split(rows, count)


def main(folder):
    folder = Path(folder)
    poses, figures = pose_test()
    paths, q, attained, names = path_test()
    expected = {"poses": figures, "paths": {}}
    line, back, circle = (
        cycles_of(names, n, c) for n, c in (("line", 10), ("back", 10), ("circle", 4))
    )
    # The way there and the way back share the point at which it turns, and the one where it began.
    back = [np.r_[there[-1], rows] for there, rows in zip(line, back)]
    for name, cycles in (("line", line), ("back", back), ("circle", circle)):
        of = [[attained[k] for k in rows] for rows in cycles]
        expected["paths"][name] = path_figures(q, of, q[cycles[0]])
    for name, document in (("poses", poses), ("paths", paths), ("expected", expected)):
        text = json.dumps(document, default=float)
        if name != "expected":
            columns = document["samples"]["columns"]
            table = zip(*columns.values())
            lines = [",".join(columns)] + [",".join(f"{v:.9g}" for v in row) for row in table]
            (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
            text = json.dumps(document | {"samples": {"file": f"{name}.csv"}}, indent=1)
        else:
            text = json.dumps(expected, indent=1, default=float)
        (folder / f"{name}.json").write_text(text + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
