"""Arms measured in every way that a session knows: numpy only, written from the equations of
`truepose effects` with a chain of matrices from link to link, and sharing nothing with src/.

    python tests/reference/observations.py tests/data/observations

writes for each case a session (poses to fit, and as many that are held out), and `expected.json` with
poses that nobody measured, where the real robot has its target there, and how far from that a least
squares of everything, written here, ends once the two are laid upon each other by what the case
leaves open: nothing, a rigid motion, or a rigid motion and a scale.

Errors of the real robot: 0.3 mm and 0.5 mrad before every joint in all six directions, zeros 0.1
degrees, tool 3 mm and 5 mrad, one standard deviation each.
"""

import json
import sys
from pathlib import Path

import numpy as np

R, P = "revolute", "prismatic"
ARMS = {
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
    "scara": (
        [
            (R, (0, 0, 1), (0, 0, 0), -130, 130),
            (R, (0, 0, 1), (300, 0, 0), -140, 140),
            (P, (0, 0, -1), (550, 0, 0), 0, 180),
            (R, (0, 0, -1), (550, 0, 0), -170, 170),
        ],
        (550, 0, 120),
    ),
}
TARGET = np.array([10.0, 5.0, 70.0])
POSES, HELD_OUT, UNSEEN = 120, 30, 40


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def rotations(axis, angle):
    """Rodrigues, for many angles about one axis of unit length."""
    k = skew(axis)
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def small(v):
    """Rotation of one rotation vector."""
    angle = np.linalg.norm(v)
    return np.eye(3) if angle == 0 else rotations(np.asarray(v) / angle, np.array([angle]))[0]


def vector(m):
    """Rotation vectors of many rotations, none of them near half a turn."""
    w = 0.5 * np.stack([m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]], 1)
    s = np.linalg.norm(w, axis=1)
    angle = np.arctan2(s, (np.trace(m, axis1=1, axis2=2) - 1) / 2)
    return w * np.where(s > 1e-12, angle / np.where(s > 0, s, 1), 1.0)[:, None]


class Arm:
    """Errors: (shift, turn) before each joint, zeros, tool (shift, turn), frame (shift, turn)."""

    def __init__(self, name):
        self.joints, tool = ARMS[name]
        self.n = len(self.joints)
        points = np.array([j[2] for j in self.joints] + [tool], float)
        self.steps = np.diff(np.vstack([[0, 0, 0], points]), axis=0)
        self.size = 6 * self.n + self.n + 6 + 6

    def pose(self, x, q):
        n = self.n
        turn = np.broadcast_to(small(x[7 * n + 9 : 7 * n + 12]), (len(q), 3, 3))
        at = np.tile(x[7 * n + 6 : 7 * n + 9], (len(q), 1))
        for i, (kind, axis, _, _, _) in enumerate(self.joints):
            own = x[6 * i : 6 * i + 6]
            at = at + turn @ (self.steps[i] + own[:3])
            turn = turn @ small(own[3:])
            a = np.asarray(axis, float)
            value = q[:, i] + x[6 * n + i]
            if kind == R:
                turn = turn @ rotations(a, value)
            else:
                at = at + (turn @ a) * value[:, None]
        at = at + turn @ (self.steps[n] + x[7 * n : 7 * n + 3])
        turn = turn @ small(x[7 * n + 3 : 7 * n + 6])
        return at, turn

    def target(self, x, q):
        at, turn = self.pose(x, q)
        return at + turn @ TARGET

    def truth(self, rng):
        x = np.zeros(self.size)
        for i in range(self.n):
            x[6 * i : 6 * i + 3] = 0.3 * rng.standard_normal(3)
            x[6 * i + 3 : 6 * i + 6] = 5e-4 * rng.standard_normal(3)
            revolute = self.joints[i][0] == R
            x[6 * self.n + i] = rng.standard_normal() * (np.radians(0.1) if revolute else 0.3)
        x[7 * self.n : 7 * self.n + 3] = 3 * rng.standard_normal(3)
        x[7 * self.n + 3 : 7 * self.n + 6] = 5e-3 * rng.standard_normal(3)
        x[7 * self.n + 6 : 7 * self.n + 9] = 2 * rng.standard_normal(3)
        x[7 * self.n + 9 :] = 2e-3 * rng.standard_normal(3)
        return x

    def sigma(self):
        """What the least squares here expects of each, so that nothing runs away."""
        each = [0.5] * 3 + [1e-3] * 3
        zeros = [0.02 if j[0] == R else 5.0 for j in self.joints]
        return np.array(each * self.n + zeros + [20.0] * 3 + [0.1] * 3 + [20.0] * 3 + [0.02] * 3)

    def random(self, rng, count):
        low = np.array([j[3] for j in self.joints], float)
        high = np.array([j[4] for j in self.joints], float)
        scale = [np.radians(1) if j[0] == R else 1.0 for j in self.joints]
        return (low + (high - low) * rng.random((count, self.n))) * scale

    def reach(self, rng, x, goal, count):
        """Poses with goal(points) = 0, by Newton from random ones."""
        low = np.array([j[3] for j in self.joints], float)
        high = np.array([j[4] for j in self.joints], float)
        scale = np.array([np.radians(1) if j[0] == R else 1.0 for j in self.joints])
        found = []
        while len(found) < count:
            q = self.random(rng, 1)
            for _ in range(40):
                left = goal(self.target(x, q))[0]
                if np.abs(left).max() < 1e-10:
                    break
                columns = []
                for k in range(self.n):
                    step = np.zeros(self.n)
                    step[k] = 1e-6
                    columns.append((goal(self.target(x, q + step))[0] - left) / 1e-6)
                move = -np.linalg.pinv(np.array(columns).T) @ left
                q = q + move * min(1.0, 0.3 / max(np.abs(move / np.where(scale < 1, 1, 100)).max(), 1e-9))
            inside = np.all((q[0] >= low * scale) & (q[0] <= high * scale))
            if inside and np.abs(left).max() < 1e-9:
                found.append(q[0])
        return np.array(found)


def angles(direction):
    x, y, z = direction.T
    return np.stack([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))], 1)


def wrapped(a):
    return (a + np.pi) % (2 * np.pi) - np.pi


def direction_rows(measured, direction):
    left = measured - angles(direction)
    return np.stack([wrapped(left[:, 0]) * np.cos(measured[:, 1]), left[:, 1]], 1)


# Every kind: residuals in units of the noise, from the arm's errors x and the places y.
SIGMA = {"point": 0.03, "turn": 2e-4, "distance": 0.005, "direction": 1e-5, "touch": 0.01, "socket": 0.02}
TRACKER = np.array([-2500.0, 800.0, 400.0])
BEAM = (0.005, 5e-6)
ANCHORS = np.array([[900.0, -700, -200], [-600, 900, 100], [200, 1100, 1500], [-900, -800, 900]])
OFFSETS = np.array([0.8, -1.2, 0.3, 2.0])
STATIONS = [
    (np.array([1800.0, -900, 500]), np.array([0.02, -0.03, 2.4])),
    (np.array([-400.0, 2100, 900]), np.array([-0.01, 0.04, -1.3])),
]
PLANES = [
    (np.array([0.0, 0.1, 1.0]), 260.0),
    (np.array([1.0, 0.05, -0.1]), 380.0),
    (np.array([-0.1, 1.0, 0.2]), 300.0),
    (np.array([0.7, -0.7, 0.3]), 250.0),
]
PLANES = [(n / np.linalg.norm(n), d) for n, d in PLANES]
SOCKETS = np.array([[380.0, 150, 260], [350, -260, 420], [150, 420, 330], [-100, -380, 500]])
AXIS = np.array([0.2, 0.1, 1.0]) / np.linalg.norm([0.2, 0.1, 1.0])


class Case:
    """One session: which robot, which kind, what is known."""

    def __init__(self, name, arm, kind, known=True, free=0, **more):
        self.name, self.arm, self.kind, self.known, self.free = name, Arm(arm), kind, known, free
        self.robot, self.more = arm, more


CASES = [
    Case("six-partial", "six", "partial"),
    Case("six-tracker", "six", "tracker"),
    Case("six-pose", "six", "pose"),
    Case("six-distance", "six", "distance"),
    Case("six-distance-unknown", "six", "distance", known=False, free=6),
    Case("six-bearing", "six", "bearing"),
    Case("six-bearing-unknown", "six", "bearing", known=False, free=7),
    Case("six-pointing", "six", "pointing"),
    Case("six-socket", "six", "socket"),
    Case("six-socket-unknown", "six", "socket", known=False, free=7),
    Case("six-socket-length", "six", "socket", known=False, free=6, length=True),
    Case("six-touch", "six", "touch"),
    Case("six-touch-unknown", "six", "touch", known=False, free=7),
    Case("six-mix", "six", "mix"),
    Case("scara-partial", "scara", "partial"),
    Case("scara-distance-unknown", "scara", "distance", known=False, free=6),
    Case("scara-bearing-unknown", "scara", "bearing", known=False, free=6),
    Case("scara-mix", "scara", "mix"),
]


def poses(case, x, rng):
    arm, count = case.arm, POSES + HELD_OUT
    if case.kind == "socket":
        which = np.arange(count) % len(SOCKETS)
        rows = [arm.reach(rng, x, lambda p, s=SOCKETS[k]: p - s, 1)[0] for k in which]
        return np.array(rows), which
    if case.kind == "touch":
        which = np.arange(count) % len(PLANES)
        goal = lambda p, k: (p @ PLANES[k][0] - PLANES[k][1])[:, None]
        rows = [arm.reach(rng, x, lambda p, k=k: goal(p, k), 1)[0] for k in which]
        return np.array(rows), which
    return arm.random(rng, count), np.arange(count) % {"distance": 4, "bearing": 2, "mix": 3}.get(case.kind, 1)


def measure(case, x, q, which, rng):
    """What the instruments show, as columns; cells that are empty are None."""
    at, turn = case.arm.pose(x, q)
    p = at + turn @ TARGET
    n = len(q)
    noise = lambda *shape: rng.standard_normal(shape)
    out = {}
    kind = case.kind
    points = kind in ("partial", "pose", "tracker") or kind == "mix"
    if points:
        m = p + SIGMA["point"] * noise(n, 3)
        if kind == "tracker":
            beam = p - TRACKER
            far = np.linalg.norm(beam, axis=1)[:, None]
            along = beam / far
            e = noise(n, 3)
            across = e - along * np.sum(e * along, 1)[:, None]
            m = p + along * BEAM[0] * noise(n, 1) + across * BEAM[1] * far
        there = np.ones((n, 3), bool)
        if kind == "partial":
            there = rng.random((n, 3)) < 0.7
            there[~there.any(1), 0] = True
        if kind == "mix":
            there[which != 0] = False
        for k, c in enumerate("xyz"):
            out[c + "_mm"] = [float(v) if t else None for v, t in zip(m[:, k], there[:, k])]
    if kind == "pose":
        measured = np.array([small(v) for v in SIGMA["turn"] * noise(n, 3)]) @ turn
        quaternions = np.array([quaternion(m) for m in measured])
        for k, c in enumerate(["qw", "qx", "qy", "qz"]):
            out[c] = quaternions[:, k].tolist()
    if kind in ("distance", "mix"):
        own = which % 4
        far = np.linalg.norm(p - ANCHORS[own], axis=1) + OFFSETS[own] + SIGMA["distance"] * noise(n)
        use = np.ones(n, bool) if kind == "distance" else which == 1
        out["distance_mm"] = [float(v) if u else None for v, u in zip(far, use)]
        out["anchor"] = [f"A{k + 1}" if u else None for k, u in zip(own, use)]
    if kind in ("bearing", "mix"):
        own = np.arange(n) // 3 % 2 if kind == "mix" else which
        use = np.ones(n, bool) if kind == "bearing" else which == 2
        seen = np.zeros((n, 2))
        for s, (stands, w) in enumerate(STATIONS):
            seen[own == s] = angles((p[own == s] - stands) @ small(w))
        e = SIGMA["direction"] * noise(n, 2)
        e[:, 0] /= np.cos(seen[:, 1])
        shown = seen + e
        # The second counts clockwise, and reads in degrees from 0 to 360.
        shown[own == 1, 0] = -shown[own == 1, 0] % (2 * np.pi)
        for k, c in enumerate(["azimuth_deg", "elevation_deg"]):
            out[c] = [float(np.degrees(v)) if u else None for v, u in zip(shown[:, k], use)]
        out["station"] = [f"S{k + 1}" if u else None for k, u in zip(own, use)]
    if kind == "pointing":
        seen = angles(turn @ AXIS)
        e = SIGMA["direction"] * noise(n, 2)
        e[:, 0] /= np.cos(seen[:, 1])
        for k, c in enumerate(["azimuth_deg", "elevation_deg"]):
            out[c] = np.degrees(seen + e)[:, k].tolist()
    if kind == "socket":
        out["socket"] = [f"K{k + 1}" for k in which]
    if kind == "touch":
        out["plane"] = [f"F{k + 1}" for k in which]
    return out


def quaternion(m):
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], 0, 0, 0],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], 0, 0],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], 0],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], np.trace(m)],
        ]
    )
    values, vectors = np.linalg.eigh(k / 3)
    x, y, z, w = vectors[:, np.argmax(values)]
    return np.array([w, x, y, z]) * (1 if w >= 0 else -1)


def column(values):
    return np.array([np.nan if v is None else v for v in values], float)


def residuals(case, x, y, q, which, seen):
    """In units of the noise, one array; y are the places that the case does not know."""
    at, turn = case.arm.pose(x, q)
    p = at + turn @ TARGET
    kind, rows = case.kind, []
    if "x_mm" in seen:
        m = np.stack([column(seen[c + "_mm"]) for c in "xyz"], 1)
        e = (m - p) / SIGMA["point"]
        if kind == "tracker":
            beam = m - TRACKER
            far = np.linalg.norm(beam, axis=1)[:, None]
            along = beam / far
            part = np.sum((m - p) * along, 1)[:, None]
            e = part * along / BEAM[0] + (m - p - part * along) / (BEAM[1] * far)
        rows.append(e[~np.isnan(e)])
    if "qw" in seen:
        w, a, b, c = (np.array(seen[k]) for k in ["qw", "qx", "qy", "qz"])
        m = np.array([from_quaternion(*v) for v in zip(w, a, b, c)])
        rows.append((vector(m @ turn.transpose(0, 2, 1)) / SIGMA["turn"]).ravel())
    if "distance_mm" in seen:
        m = column(seen["distance_mm"])
        own = which % 4
        at, add = (ANCHORS, OFFSETS) if case.known else (y[:12].reshape(4, 3), y[12:16])
        e = (m - np.linalg.norm(p - at[own], axis=1) - add[own]) / SIGMA["distance"]
        rows.append(e[~np.isnan(e)])
    if "station" in seen:
        n = len(q)
        own = np.arange(n) // 3 % 2 if kind == "mix" else which
        m = np.radians(np.stack([column(seen["azimuth_deg"]), column(seen["elevation_deg"])], 1))
        for s in range(2):
            stands, w = STATIONS[s] if case.known else (y[6 * s : 6 * s + 3], y[6 * s + 3 : 6 * s + 6])
            use = (own == s) & ~np.isnan(m[:, 0])
            shown = m[use].copy()
            if s == 1:
                shown[:, 0] = -shown[:, 0]
            rows.append((direction_rows(shown, (p[use] - stands) @ small(w)) / SIGMA["direction"]).ravel())
    elif "azimuth_deg" in seen:
        m = np.radians(np.stack([column(seen["azimuth_deg"]), column(seen["elevation_deg"])], 1))
        rows.append((direction_rows(m, turn @ AXIS) / SIGMA["direction"]).ravel())
    if kind == "socket":
        at = SOCKETS if case.known else y.reshape(-1, 3)
        rows.append(((p - at[which]) / SIGMA["socket"]).ravel())
        if case.more.get("length"):
            rows.append(np.array([(np.linalg.norm(at[0] - at[1]) - LENGTH) / 0.02]))
    if kind == "touch":
        for k, (n0, d0) in enumerate(PLANES):
            normal, d = n0, d0
            if not case.known:
                normal = n0 + y[4 * k : 4 * k + 3]
                normal, d = normal / np.linalg.norm(normal), d0 + y[4 * k + 3]
            rows.append((p[which == k] @ normal - d) / SIGMA["touch"])
    return np.concatenate(rows)


LENGTH = float(np.linalg.norm(SOCKETS[0] - SOCKETS[1]))


def from_quaternion(w, x, y, z):
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def start_of_places(case):
    """The places as they are: a reference may cheat where it begins."""
    if case.known:
        return np.zeros(0), np.zeros(0)
    if case.kind == "distance":
        return np.r_[ANCHORS.ravel(), OFFSETS], np.full(16, 100.0)
    if case.kind == "bearing":
        y = np.concatenate([np.r_[s, w] for s, w in STATIONS])
        return y, np.tile([100.0] * 3 + [0.1] * 3, 2)
    if case.kind == "socket":
        return SOCKETS.ravel().copy(), np.full(12, 100.0)
    if case.kind == "touch":
        return np.zeros(16), np.tile([0.1] * 3 + [100.0], 4)
    return np.zeros(0), np.zeros(0)


def fitted(case, q, which, seen):
    """Gauss-Newton on everything, with what is expected of each as rows."""
    nx = case.arm.size
    y0, sy = start_of_places(case)
    z = np.r_[np.zeros(nx), y0]
    centre = z.copy()
    sigma = np.r_[case.arm.sigma(), sy]
    f = lambda z: np.r_[residuals(case, z[:nx], z[nx:], q, which, seen), (z - centre) / sigma]
    for _ in range(12):
        left = f(z)
        columns = []
        for k in range(len(z)):
            step = np.zeros(len(z))
            step[k] = 1e-5 * min(sigma[k], 1.0)
            columns.append((f(z + step) - f(z - step)) / (2 * step[k]))
        move = np.linalg.lstsq(np.array(columns).T, -left, rcond=None)[0]
        z = z + move
        if np.abs(move / sigma).max() < 1e-7:
            break
    return z[:nx]


def laid_upon(a, b, free):
    """a after the motion (and scale) that brings it closest to b."""
    if free == 0:
        return a
    ca, cb = a.mean(0), b.mean(0)
    u, s, vt = np.linalg.svd((b - cb).T @ (a - ca))
    d = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    turn = u @ d @ vt
    scale = (s * np.diag(d)).sum() / ((a - ca) ** 2).sum() if free == 7 else 1.0
    return (a - ca) @ turn.T * scale + cb


def rms(e):
    return float(np.sqrt((e**2).sum(-1).mean()))


def document(case):
    joints = [
        {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [lo, hi]}
        for i, (k, a, p, lo, hi) in enumerate(case.arm.joints)
    ]
    tool = {"position_mm": ARMS[case.robot][1], "quaternion_wxyz": [1, 0, 0, 0]}
    instrument = {"name": "simulated by numpy"}
    out = {
        "format": "truepose-session/1",
        "name": case.name,
        "robot": {"name": case.robot, "joints": joints, "tool": tool},
        "targets": {"T1": TARGET.tolist()},
        "instrument": instrument,
    }
    known, kind = case.known, case.kind
    if kind in ("partial", "pose", "mix"):
        instrument["sigma_mm"] = SIGMA["point"]
    if kind == "tracker":
        instrument["sigma_range_mm"], instrument["sigma_angle_urad"] = BEAM[0], BEAM[1] * 1e6
        instrument["position_mm"] = TRACKER.tolist()
    if kind == "pose":
        instrument["sigma_mrad"] = SIGMA["turn"] * 1e3
    if kind in ("distance", "mix"):
        instrument["sigma_distance_mm"] = SIGMA["distance"]
        out["anchors"] = {
            f"A{k + 1}": {
                "position_mm": ANCHORS[k].tolist() if known else None,
                "offset_mm": float(OFFSETS[k]) if known else None,
            }
            for k in range(4)
        }
    if kind in ("bearing", "mix"):
        out["stations"] = {
            f"S{k + 1}": {
                "position_mm": s.tolist() if known else None,
                "quaternion_wxyz": quaternion(small(w)).tolist() if known else None,
                "azimuth": ["counterclockwise", "clockwise"][k],
            }
            for k, (s, w) in enumerate(STATIONS)
        }
    if kind in ("bearing", "mix", "pointing"):
        instrument["sigma_direction_urad"] = SIGMA["direction"] * 1e6
    if kind == "pointing":
        out["pointing"] = {"axis": AXIS.tolist()}
    if kind == "socket":
        instrument["sigma_mm"] = SIGMA["socket"]
        out["sockets"] = {
            f"K{k + 1}": {"position_mm": s.tolist() if known else None} for k, s in enumerate(SOCKETS)
        }
        if case.more.get("length"):
            out["socket_distances_mm"] = [["K1", "K2", LENGTH]]
    if kind == "touch":
        instrument["sigma_touch_mm"] = SIGMA["touch"]
        out["planes"] = {
            f"F{k + 1}": {"normal": n.tolist(), "distance_mm": d} if known else None
            for k, (n, d) in enumerate(PLANES)
        }
    out["compensated_by"] = None
    out["samples"] = {"file": f"{case.name}.csv"}
    return out


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    expected = {}
    for seed, case in enumerate(CASES):
        rng = np.random.default_rng(1000 + seed)
        arm = case.arm
        x = arm.truth(rng)
        q, which = poses(case, x, rng)
        exact = q
        if case.kind in ("socket", "touch"):
            # The seat or the touch is off by its noise: the pose that closes is another one.
            sigma = SIGMA[case.kind]
            for i in range(len(q)):
                if case.kind == "socket":
                    goal = lambda p, s=SOCKETS[which[i]] + sigma * rng.standard_normal(3): p - s
                else:
                    n, d = PLANES[which[i]]
                    goal = lambda p, n=n, d=d + sigma * rng.standard_normal(): (p @ n - d)[:, None]
                exact = q.copy()
                q[i] = nearby(arm, x, goal, q[i : i + 1])
        seen = measure(case, x, q, which, rng)
        digits = 7
        degrees = [np.degrees if j[0] == R else (lambda v: v) for j in arm.joints]
        inner = [np.radians if j[0] == R else (lambda v: v) for j in arm.joints]
        shown = np.stack([np.round(f(q[:, i]), digits) for i, f in enumerate(degrees)], 1)
        q = np.stack([f(shown[:, i]) for i, f in enumerate(inner)], 1)
        table = {
            f"q{i + 1}_{'deg' if j[0] == R else 'mm'}": shown[:, i].tolist()
            for i, j in enumerate(arm.joints)
        }
        for name, values in seen.items():
            places = {"_mm": 6, "deg": 9}.get(name[-3:], 9)
            seen[name] = [round(v, places) if isinstance(v, float) else v for v in values]
        table |= seen
        table["use"] = ["fit"] * POSES + ["held-out"] * HELD_OUT
        rows = zip(*table.values())
        text = ",".join(table) + "\n"
        text += "".join(",".join("" if v is None else str(v) for v in row) + "\n" for row in rows)
        (folder / f"{case.name}.csv").write_text(text)
        (folder / f"{case.name}.json").write_text(json.dumps(document(case), indent=1) + "\n")
        fit = {k: v[:POSES] for k, v in seen.items()}
        unseen = arm.random(rng, UNSEEN)
        shown = np.stack([np.round(f(unseen[:, i]), 5) for i, f in enumerate(degrees)], 1)
        unseen = np.stack([f(shown[:, i]) for i, f in enumerate(inner)], 1)
        true, turned = arm.pose(x, unseen)
        true = true + turned @ TARGET
        own = fitted(case, q[:POSES], which[:POSES], fit)
        if case.kind == "pointing":
            _, mine = arm.pose(own, unseen)
            off = np.degrees(np.arccos(np.clip(np.sum((mine @ AXIS) * (turned @ AXIS), 1), -1, 1)))
            distance = rms(np.radians(off)[:, None]) * 1e3
        else:
            distance = rms(laid_upon(arm.target(own, unseen), true, case.free) - true)
        expected[case.name] = {
            "free": case.free,
            "q": np.round(shown, 5).tolist(),
            "points_mm": np.round(true, 6).tolist(),
            "axes": np.round(turned @ AXIS, 9).tolist(),
            "from_truth": distance,
        }
        print(f"{case.name:24} {distance:.5f}")
    (folder / "expected.json").write_text(json.dumps(expected, separators=(",", ":")) + "\n")


def nearby(arm, x, goal, q):
    fixed = goal
    for _ in range(30):
        left = fixed(arm.target(x, q))[0]
        if np.abs(left).max() < 1e-10:
            break
        columns = []
        for k in range(arm.n):
            step = np.zeros(arm.n)
            step[k] = 1e-6
            columns.append((fixed(arm.target(x, q + step))[0] - left) / 1e-6)
        q = q - np.linalg.pinv(np.array(columns).T) @ left
    return q[0]


if __name__ == "__main__":
    main(sys.argv[1])
