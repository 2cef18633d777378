"""Arms measured by a tracker, and a least squares of everything: numpy, written from the equations
of `truepose effects` (product of exponentials) and sharing nothing with src/.

    python tests/reference/arms.py tests/data/arms

writes, for five kinds of arm with 60 and with 200 poses, a session with samples to fit (sigma 0.03 mm,
three targets, the frame of the instrument unknown) and samples held out that carry no noise, so that
the error on those is the distance from the truth; and `expected.json` with what plain least squares
of all geometry leaves there: a free rigid motion before every joint, at the base and for every target.

Geometry errors: 0.3 mm and 0.5 mrad of every axis in all six directions, zeros 0.2 degrees, tool
5 mm, targets 0.05 mm, one standard deviation each.
"""

import json
import sys
from pathlib import Path

import numpy as np

SIGMA_MM = 0.03
UNSEEN = 80
R, P = "revolute", "prismatic"

ARMS = {
    # name: (joints as (kind, axis, point, low, high), tool at home)
    "six": (
        [
            (R, (0, 0, 1), (0, 0, 0), -165, 165),
            (R, (0, 1, 0), (0, 0, 330), -90, 110),
            (R, (0, 1, 0), (0, 0, 640), -110, 65),
            (R, (1, 0, 0), (0, 0, 710), -160, 160),
            (R, (0, 1, 0), (340, 0, 710), -115, 115),
            (R, (1, 0, 0), (340, 0, 710), -175, 175),
        ],
        (420, 0, 710),
    ),
    "parallel": (
        [
            (R, (0, 0, 1), (0, 0, 0), -170, 170),
            (R, (0, -1, 0), (0, 0, 150), -150, 0),
            (R, (0, -1, 0), (-430, 0, 150), -130, 130),
            (R, (0, -1, 0), (-820, 0, 150), -160, 160),
            (R, (0, 0, -1), (-820, -110, 150), -160, 160),
            (R, (0, -1, 0), (-820, -110, 55), -170, 170),
        ],
        (-820, -190, 55),
    ),
    "seven": (
        [
            (R, (0, 0, 1), (0, 0, 0), -165, 165),
            (R, (0, 1, 0), (0, 0, 340), -110, 110),
            (R, (0, 0, 1), (0, 0, 340), -165, 165),
            (R, (0, -1, 0), (0, 0, 740), -110, 110),
            (R, (0, 0, 1), (0, 0, 740), -165, 165),
            (R, (0, 1, 0), (0, 0, 1140), -110, 110),
            (R, (0, 0, 1), (0, 0, 1140), -170, 170),
        ],
        (0, 0, 1270),
    ),
    "scara": (
        [
            (R, (0, 0, 1), (0, 0, 0), -130, 130),
            (R, (0, 0, 1), (300, 0, 0), -140, 140),
            (P, (0, 0, -1), (550, 0, 0), 0, 180),
            (R, (0, 0, -1), (550, 0, 0), -170, 170),
        ],
        (550, 0, 120),
    ),
    "positioner": (
        [
            (R, (0, 1, 0), (0, 0, 500), -80, 80),
            (R, (0, 0.02, 1), (0, 0, 620), -175, 175),
        ],
        (180, 40, 640),
    ),
}
TARGETS = {"T1": (10.0, 5.0, 70.0), "T2": (75.0, -20.0, 35.0), "T3": (-45.0, 60.0, 50.0)}


def cross_matrix(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp(screw, angle=1.0):
    """SE(3) exponential of a screw (w, v), for one angle or many: 4 x 4 matrices."""
    w, v = np.asarray(screw[:3], float), np.asarray(screw[3:], float)
    angle = np.atleast_1d(np.asarray(angle, float))
    norm = np.linalg.norm(w)
    out = np.zeros((len(angle), 4, 4))
    out[:, 3, 3] = 1
    if norm == 0:
        out[:, :3, :3] = np.eye(3)
        out[:, :3, 3] = angle[:, None] * v
        return out
    w, v, angle = w / norm, v / norm, angle * norm
    k = cross_matrix(w)
    k2 = k @ k
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    out[:, :3, :3] = np.eye(3) + s * k + (1 - c) * k2
    g = np.eye(3) * angle[:, None, None] + (1 - c) * k + (angle[:, None, None] - s) * k2
    out[:, :3, 3] = g @ v
    return out


def joint_screw(kind, axis, point):
    a = np.asarray(axis, float) / np.linalg.norm(axis)
    return np.r_[a, np.cross(point, a)] if kind == R else np.r_[0, 0, 0, a]


def about(point, screw):
    """A screw given about a point, about the origin."""
    w = np.asarray(screw[:3], float)
    return np.r_[w, np.asarray(screw[3:], float) + np.cross(point, w)]


class Arm:
    """The arm with a rigid motion before every joint, a frame and a shift of every target."""

    def __init__(self, name):
        self.joints, tool = ARMS[name]
        self.tool = np.asarray(tool, float)
        self.screws = [joint_screw(k, a, p) for k, a, p, _, _ in self.joints]
        self.n = len(self.joints)
        self.size = 6 * self.n + 6 + 3 * len(TARGETS)

    def points(self, x, frame, q, target):
        """Measured points of poses q (inner units): x = links, frame increment, targets."""
        homes = self.tool + np.array(list(TARGETS.values())) + x[6 * self.n + 6 :].reshape(-1, 3)
        p = np.c_[homes[target], np.ones(len(target))]
        for i in reversed(range(self.n)):
            p = np.einsum("nij,nj->ni", exp(self.screws[i], q[:, i]), p)
            link = about(self.joints[i][2], x[6 * i : 6 * i + 6])
            p = np.einsum("nij,nj->ni", exp(link), p)
        small = exp(x[6 * self.n : 6 * self.n + 6])[0]
        return (p @ (frame @ small).T)[:, :3]

    def jacobian(self, x, frame, q, target):
        columns = []
        for k in range(self.size):
            h = 1e-5 if k < 6 * self.n + 6 and k % 6 < 3 else 1e-3
            step = np.zeros(self.size)
            step[k] = h
            ahead, behind = (self.points(x + s * step, frame, q, target) for s in (1, -1))
            columns.append(((ahead - behind) / (2 * h)).ravel())
        return np.array(columns).T


def rigid(a, b):
    ca, cb = a.mean(0), b.mean(0)
    u, _, vt = np.linalg.svd((b - cb).T @ (a - ca))
    d = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    out = np.eye(4)
    out[:3, :3] = u @ d @ vt
    out[:3, 3] = cb - out[:3, :3] @ ca
    return out


def least_squares_of_everything(arm, q, target, measured):
    x, still = np.zeros(arm.size), np.eye(4)
    frame = rigid(arm.points(x, still, q, target), measured)
    for _ in range(30):
        left = (measured - arm.points(x, frame, q, target)).ravel()
        jacobian = arm.jacobian(x, frame, q, target)
        # Columns of unit length; what cannot be told is left out by the singular values.
        scale = np.linalg.norm(jacobian, axis=0)
        scale[scale < 1e-9] = 1
        step = np.linalg.lstsq(jacobian / scale, left, rcond=1e-7)[0] / scale
        x = x + step
        if np.linalg.norm(jacobian @ step) < 1e-7 * np.sqrt(len(left)):
            break
    return x, frame


def simulate(name, poses, seed):
    rng = np.random.default_rng(seed)
    arm = Arm(name)
    x = np.zeros(arm.size)
    for i, (kind, axis, _, _, _) in enumerate(arm.joints):
        a = np.asarray(axis, float) / np.linalg.norm(axis)
        x[6 * i : 6 * i + 3] = rng.normal(0, 0.5e-3, 3)
        x[6 * i + 3 : 6 * i + 6] = rng.normal(0, 0.3, 3)
        if kind == R:
            x[6 * i : 6 * i + 3] += a * rng.normal(0, np.radians(0.2))
        else:
            x[6 * i + 3 : 6 * i + 6] += a * rng.normal(0, 0.5)
    shift = rng.normal(0, 5, 3)
    x[6 * arm.n + 6 :] = (shift + rng.normal(0, 0.05, (3, 3))).ravel()
    turn = rng.normal(size=3)
    turn *= rng.uniform(1.5, 2.6) / np.linalg.norm(turn)
    frame = exp(np.r_[turn, 0, 0, 0])[0]
    frame[:3, 3] = rng.normal(0, 2000, 3)
    count = poses + UNSEEN
    low = np.array([j[3] for j in arm.joints], float)
    high = np.array([j[4] for j in arm.joints], float)
    shown = np.round(rng.uniform(low, high, (count, arm.n)), 5)
    inner = [np.radians(1.0) if j[0] == R else 1.0 for j in arm.joints]
    q = shown * inner
    target = rng.integers(0, 3, count)
    target[:3] = [0, 1, 2]
    true = arm.points(x, frame, q, target)
    measured = true.copy()
    measured[:poses] += rng.normal(0, SIGMA_MM, (poses, 3))
    return arm, q, shown, target, np.round(measured, 6), true, frame


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    expected = {}
    for number, name in enumerate(ARMS):
        for poses in (60, 200):
            arm, q, shown, target, measured, true, _ = simulate(name, poses, 100 * number + poses)
            fit, held = slice(0, poses), slice(poses, None)
            x, frame = least_squares_of_everything(arm, q[fit], target[fit], measured[fit])
            off = arm.points(x, frame, q[held], target[held]) - true[held]
            left = arm.points(x, frame, q[fit], target[fit]) - measured[fit]
            rms = lambda e: float(np.sqrt((e**2).sum(1).mean()))
            session = f"{name}-{poses}"
            expected[session] = {"from_truth_mm": round(rms(off), 6), "left_mm": round(rms(left), 6)}
            print(session, expected[session], flush=True)
            unit = ["deg" if j[0] == R else "mm" for j in arm.joints]
            joints = [
                {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [lo, hi]}
                for i, (k, a, p, lo, hi) in enumerate(arm.joints)
            ]
            document = {
                "format": "truepose-session/1",
                "name": session,
                "note": "simulated by tests/reference/arms.py; the held-out samples carry no noise",
                "robot": {
                    "name": name,
                    "joints": joints,
                    "tool": {"position_mm": arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]},
                },
                "targets": TARGETS,
                "instrument": {"name": "tracker", "sigma_mm": SIGMA_MM},
                "samples": {"file": f"{session}.csv"},
            }
            (folder / f"{session}.json").write_text(json.dumps(document) + "\n")
            heading = [f"q{i + 1}_{u}" for i, u in enumerate(unit)]
            rows = [",".join([*heading, "x_mm", "y_mm", "z_mm", "target", "setup", "use"])]
            for i in range(len(q)):
                numbers = [f"{v:.5f}" for v in shown[i]] + [f"{v:.6f}" for v in measured[i]]
                last = [f"T{target[i] + 1}", "station", "fit" if i < poses else "held-out"]
                rows.append(",".join([*numbers, *last]))
            (folder / f"{session}.csv").write_text("\n".join(rows) + "\n")
    (folder / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tests/data/arms")
