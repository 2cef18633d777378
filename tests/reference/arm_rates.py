"""How often the diagnosis of simulated arms is right: numpy, from the equations that `truepose effects` prints and
sharing nothing with src/; the arms are those of arms.py.

    python tests/reference/arm_rates.py BINARY [--count N] [--kinds six,seven] [--poses 60,200]
        [--tasks one,three,none,bump,setup] [--seed S]

Every session: geometry errors of tenths of mm and mrad, unknown frame of the instrument, three
targets, sigma 0.03 mm, loads of 0, 3 and 6 kg, both directions of approach, a temperature that rises by
6 degrees, one pose every 12 s. Effects have lambda = |effect beside all geometry|^2 / sigma^2 = 400.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from arms import ARMS, R, SIGMA_MM, TARGETS, Arm, exp  # noqa: E402

LAMBDA = 400.0
GRAVITY = np.array([0.0, 0.0, -9.81])
SECONDS_PER_POSE = 12.0


class Session:
    """An arm with geometry errors, its poses and conditions, and effects of unit size times `size`."""

    def __init__(self, name, poses, rng, side=None, load=None):
        self.name, self.arm, self.poses = name, Arm(name), poses
        arm = self.arm
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
        self.x = x
        turn = rng.normal(size=3)
        turn *= rng.uniform(1.5, 2.6) / np.linalg.norm(turn)
        self.frame = exp(np.r_[turn, 0, 0, 0])[0]
        self.frame[:3, 3] = rng.normal(0, 2000, 3)
        low = np.array([j[3] for j in arm.joints], float)
        high = np.array([j[4] for j in arm.joints], float)
        if side is not None:
            high = low + side * (high - low)
        self.shown = np.round(rng.uniform(low, high, (poses, arm.n)), 5)
        self.inner = np.array([np.radians(1.0) if j[0] == R else 1.0 for j in arm.joints])
        self.q = self.shown * self.inner
        self.low, self.high = low * self.inner, high * self.inner
        self.target = rng.integers(0, 3, poses)
        self.target[: min(3, poses)] = range(min(3, poses))
        self.dir = rng.choice([-1, 1], (poses, arm.n))
        self.load = rng.choice([0.0, 3.0, 6.0], poses)
        if load is not None:
            self.load[:] = load
        self.time = np.arange(poses) * SECONDS_PER_POSE
        self.warmth = 6 * (1 - np.exp(-self.time / 1200)) + rng.normal(0, 0.05, poses)
        self.noise = rng.normal(0, SIGMA_MM, (poses, 3))
        # Links that stand in no file: mass in kg and centre at home, beside the middle between two axes.
        places = [np.asarray(j[2], float) for j in arm.joints] + [np.asarray(arm.tool, float)]
        self.links = [
            (12.0 * 0.6**k, 0.5 * (places[k] + places[k + 1]) + rng.normal(0, 30, 3)) for k in range(arm.n)
        ]

    def weight_torque(self, joint, q):
        """Torque of the load, and of the links behind, about a joint, Nm."""
        torque = self.torque(joint, q, self.arm.tool, self.arm.n - 1, self.load)
        for k, (mass, centre) in enumerate(self.links):
            if k >= joint:
                torque = torque + self.torque(joint, q, centre, k, np.full(len(q), mass))
        return torque

    def torque(self, joint, q, home, behind, mass):
        """Torque about a joint of a mass behind another one: axis . ((mass - axis point) x m g)."""
        p = np.tile(np.r_[home, 1.0], (len(q), 1))
        for i in reversed(range(joint, behind + 1)):
            p = np.einsum("nij,nj->ni", exp(self.arm.screws[i], q[:, i]), p)
        a = np.tile(np.r_[self.arm.joints[joint][1], 0.0], (len(q), 1)).astype(float)
        a /= np.linalg.norm(a[:, :3], axis=1, keepdims=True)
        point = np.tile(np.r_[self.arm.joints[joint][2], 1.0], (len(q), 1)).astype(float)
        for i in reversed(range(joint)):
            turn = exp(self.arm.screws[i], q[:, i])
            p, a, point = (np.einsum("nij,nj->ni", turn, v) for v in (p, a, point))
        force = mass[:, None] * GRAVITY
        arm_m = (p - point)[:, :3] * 1e-3
        return np.einsum("ni,ni->n", a[:, :3], np.cross(arm_m, force))

    def turned(self, effects):
        """True joint values with the effects."""
        theta = self.q.copy()
        sags = []
        for e in effects:
            kind, j, a = e["effect"], e.get("joint"), e["size"]
            q = self.q[:, j - 1] if j else None
            if kind == "joint-scale":
                theta[:, j - 1] += a * q
            elif kind == "encoder-eccentricity":
                phi = np.radians(e["phase_deg"])
                theta[:, j - 1] += np.arctan2(a * np.sin(q - phi), 1 - a * np.cos(q - phi)) if a else 0
            elif kind == "encoder-two-cycle":
                theta[:, j - 1] += a * np.sin(2 * q + np.radians(e["phase_deg"]))
            elif kind == "gear-transmission-error":
                theta[:, j - 1] += a * np.sin(e["order"] * q + np.radians(e["phase_deg"]))
            elif kind == "backlash":
                theta[:, j - 1] -= self.dir[:, j - 1] * a / 2
            elif kind == "thermal-zero-drift":
                theta[:, j - 1] += a * self.warmth
            elif kind == "wrist-coupling":
                theta[:, j - 1] += a * self.q[:, j - 2]
            elif kind == "bump":
                theta[:, j - 1] += a * np.exp(-0.5 * ((q - e["at"]) / e["width"]) ** 2)
            elif kind == "joint-compliance":
                sags.append(e)
        driven = theta.copy()
        for e in sags:
            for _ in range(3):
                sag = e["size"] * self.weight_torque(e["joint"] - 1, theta)
                theta[:, e["joint"] - 1] = driven[:, e["joint"] - 1] + sag
        return theta

    def points(self, effects):
        p = self.arm.points(self.x, self.frame, self.turned(effects), self.target)
        for e in effects:
            v = np.asarray(e.get("direction", [0, 0, 0]), float)
            if e["effect"] == "frame-drift":
                p = p + e["size"] * self.time[:, None] / 3600 * v
            elif e["effect"] == "frame-shift":
                p = p + e["size"] * (self.time >= e["time_s"])[:, None] * v
        return p

    def effect(self, kind, rng):
        """A random effect at lambda = 400, or None where geometry takes all of it."""
        turning = [i + 1 for i, j in enumerate(self.arm.joints) if j[0] == R]
        e = {"effect": kind, "phase_deg": float(rng.uniform(0, 360)), "size": 1e-4}
        if kind.startswith("frame"):
            v = rng.normal(size=3)
            e.update(joint=None, size=0.05, direction=(v / np.linalg.norm(v)).tolist())
            e["time_s"] = float(self.time[int(rng.uniform(0.25, 0.75) * self.poses)]) - 1.0
        elif kind == "wrist-coupling":
            if self.arm.n < 6:
                return None
            e["joint"] = int(rng.integers(5, self.arm.n + 1))
        else:
            e["joint"] = int(rng.choice(turning))
        if kind == "joint-compliance":
            e["size"] = 1e-6
        if kind == "gear-transmission-error":
            e["order"] = int(rng.integers(5, 40))
        if kind == "bump":
            k = e["joint"] - 1
            span = self.high[k] - self.low[k]
            e["at"] = float(self.low[k] + rng.uniform(0.25, 0.75) * span)
            e["width"] = float(rng.uniform(0.03, 0.06) * span)
        j = self.arm.jacobian(self.x, self.frame, self.q, self.target)
        u, s, _ = np.linalg.svd(j / np.maximum(np.linalg.norm(j, axis=0), 1e-9), full_matrices=False)
        u = u[:, s > 1e-6]
        for _ in range(3):
            d = (self.points([e]) - self.points([])).ravel()
            free = d - u @ (u.T @ d)
            norm = np.linalg.norm(free)
            if norm < 0.02 * np.linalg.norm(d) or norm == 0:
                return None
            e["size"] *= SIGMA_MM * np.sqrt(LAMBDA) / norm
        limit = {"joint-compliance": 2e-5, "wrist-coupling": 0.02}.get(kind, 0.01)
        if not kind.startswith("frame") and abs(e["size"]) > limit:
            return None
        return e

    def write(self, folder, name, effects, mistake=None, setup=True, note=""):
        measured = np.round(self.points(effects) + self.noise, 5)
        shown = self.shown.copy()
        if mistake:
            shown = mistake(self, shown)
        unit = ["deg" if j[0] == R else "mm" for j in self.arm.joints]
        document = {
            "format": "truepose-session/1",
            "name": name,
            "note": note,
            "robot": {
                "name": self.name,
                "joints": [
                    {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [lo, hi]}
                    for i, (k, a, p, lo, hi) in enumerate(self.arm.joints)
                ],
                "tool": {"position_mm": self.arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]},
                "gravity_m_s2": GRAVITY.tolist(),
            },
            "targets": TARGETS,
            "instrument": {"name": "tracker", "sigma_mm": SIGMA_MM},
            "samples": {"file": f"{name}.csv"},
        }
        (folder / f"{name}.json").write_text(json.dumps(document) + "\n")
        n = self.arm.n
        heading = [f"q{i + 1}_{u}" for i, u in enumerate(unit)] + ["x_mm", "y_mm", "z_mm"]
        heading += [f"dir{i + 1}" for i in range(n)]
        heading += ["time_s", "target", "load_kg", "temperature_c"] + (["setup"] if setup else [])
        with open(folder / f"{name}.csv", "w", newline="") as f:
            out = csv.writer(f, lineterminator="\n")
            out.writerow(heading)
            for i in range(self.poses):
                # Radians need more digits.
                row = [f"{v:.{7 if mistake else 5}f}" for v in shown[i]]
                row += [f"{v:.5f}" for v in measured[i]] + [str(v) for v in self.dir[i]]
                row += [f"{self.time[i]:.0f}", f"T{self.target[i] + 1}", f"{self.load[i]:.0f}"]
                row += [f"{20 + self.warmth[i]:.3f}"] + (["station"] if setup else [])
                out.writerow(row)


EFFECTS = [
    "joint-scale",
    "encoder-eccentricity",
    "encoder-two-cycle",
    "gear-transmission-error",
    "backlash",
    "thermal-zero-drift",
    "joint-compliance",
    "wrist-coupling",
    "frame-drift",
    "frame-shift",
]


def mistakes(session, rng):
    """A random mistake of setting up: what it does, and what has to be said."""
    joints = session.arm.joints
    n = len(joints)
    turning = [j for j in range(n) if joints[j][0] == R]
    parallel = [
        j
        for j in range(1, n)
        if j in turning and j - 1 in turning and abs(np.dot(joints[j][1], joints[j - 1][1])) > 0.99
    ]
    kind = rng.choice(["sign", "home", "exchange", "unit"] + (["couple"] if parallel else []))
    j = int(rng.choice(turning))
    if kind == "sign":
        def change(_, q):
            q[:, j] *= -1
            return q
        return kind, change, [f"joint {j + 1} counts"]
    if kind == "home":
        j = int(rng.choice([k for k in turning if k > 0]))
        by = float(rng.choice([90.0, -90.0, 180.0]))
        def change(_, q):
            q[:, j] -= by
            return q
        return kind, change, [f"home position of joint {j + 1} is off by {by:.0f}°"]
    if kind == "exchange":
        a, b = sorted(int(v) for v in rng.choice(turning, 2, replace=False))
        def change(_, q):
            q[:, [a, b]] = q[:, [b, a]]
            return q
        return kind, change, [f"joints {a + 1} and {b + 1} are exchanged"]
    if kind == "couple":
        j = int(rng.choice(parallel))
        def change(_, q):
            q[:, j] += q[:, j - 1]
            return q
        return kind, change, [f"joints {j} and {j + 1} are"]
    def change(_, q):
        q[:, j] = np.radians(q[:, j])
        return q
    return kind, change, [f"joint {j + 1} are in radians"]


def diagnose(binary, path):
    start = time.time()
    done = subprocess.run([binary, "diagnose", str(path), "--json"], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout), time.time() - start


def one_session(binary, folder, task, name, poses, rng, load):
    """(right, in the answer's set, wrongly named, seconds, what was seen)."""
    session = Session(name, poses, rng, load=load)
    effects, change, words = [], None, []
    if task == "sag":
        for _ in range(40):
            effects = effects or [e for e in [session.effect("joint-compliance", rng)] if e]
    elif task in ("one", "three"):
        while len(effects) < (1 if task == "one" else 3):
            e = session.effect(str(rng.choice(EFFECTS)), rng)
            there = [(o["effect"], o["joint"]) for o in effects]
            if e and (e["effect"], e["joint"]) not in there:
                effects.append(e)
    elif task == "bump":
        while not effects:
            effects = [e for e in [session.effect("bump", rng)] if e]
    elif task == "setup":
        _, change, words = mistakes(session, rng)
    session.write(folder, "s", effects, change)
    answer, seconds = diagnose(binary, folder / "s.json")
    found = sorted((f["effect"], f.get("joint") or 0) for f in answer["found"])
    truth = sorted((e["effect"], e["joint"] or 0) for e in effects if e["effect"] != "bump")
    rest = answer["unexplained"]["present"]
    said = [p["what"] for p in answer["data_problems"]]
    if task == "setup":
        right = any(w in s for w in words for s in said)
    elif task == "bump":
        right = rest and not found
    elif task == "none":
        right = not found and not rest
    else:
        right = found == truth
    in_set = right
    name_of = lambda t: f"{t[0]} {t[1]}" if t[1] else t[0]
    for e in answer["equivalent"]:
        names = [name_of(f) for f in found]
        names = [n for n in names if n not in e["explanation"]] + e["instead"]
        in_set |= sorted(names) == sorted(name_of(t) for t in truth)
    false = [f for f in found if f not in truth]
    left = answer["gap"]["end_mm"] / answer["floor"]["mm"]
    seen = f"{found} {answer['verdict']} {left:.2f} truth {truth or words} {said}"
    return right, in_set, bool(false), seconds, seen


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=4)
    parser.add_argument("--kinds", default=",".join(ARMS))
    parser.add_argument("--poses", default="60,200")
    parser.add_argument("--tasks", default="one,three,none,bump,setup")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--load", type=float, help="one load for all poses, kg; without: 0, 3 and 6")
    args = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    for poses in map(int, args.poses.split(",")):
        for task in args.tasks.split(","):
            totals = np.zeros(5)
            for k, name in enumerate(args.kinds.split(",")):
                for i in range(args.count):
                    rng = np.random.default_rng([args.seed, poses, sum(map(ord, task)), k, i])
                    right, in_set, false, seconds, seen = one_session(
                        args.binary, folder, task, name, poses, rng, args.load
                    )
                    totals += [1, right, in_set, false, seconds]
                    if not right:
                        print(f"    {name} {poses} {task} {i}: {seen}", flush=True)
            n, right, in_set, false, seconds = totals
            print(
                f"{poses} poses, {task}: right {right:.0f}, with its set {in_set:.0f}, "
                f"a false name {false:.0f} of {n:.0f}; {seconds / n:.1f} s each",
                flush=True,
            )


if __name__ == "__main__":
    main()
