"""Old robots, and what their diagnosis costs: numpy, from the equations that `truepose effects` prints and sharing nothing with
src/; the arms are those of arms.py.

    python tests/reference/old_robots.py BINARY [--count N] [--from N] [--seed S] [--limit SECONDS] [--keep FOLDER]

Strain-wave gears of orders n and 2n on most joints, sag of two or three, backlash of two to four, a wobble, a coupled
wrist, joints that drift with the temperature: 12 to 20 effects, each clear of the noise, in 300 to 1000 poses of six-
and seven-joint arms; every fourth is measured with its orientation. Of each: processor time (user + system) and memory
of the process, what is left of poses that no fit has seen, and how many names are right, wrong and not found, of
those that the points show at all.
"""

import argparse
import csv
import json
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from arm_rates import GRAVITY, Session  # noqa: E402
from arms import SIGMA_MM, TARGETS, about, exp  # noqa: E402

SIGMA_MRAD = 0.05
# Odds of 1000 : 1 among a few thousand candidates.
LEAST = 30.0
SIZES = (300, 300, 400, 500, 700, 1000)


def across(axis):
    """A unit vector across an axis."""
    a = np.asarray(axis, float) / np.linalg.norm(axis)
    other = np.eye(3)[np.argmin(np.abs(a))]
    u = np.cross(a, other)
    return u / np.linalg.norm(u), a


class OldRobot(Session):
    def __init__(self, name, poses, rng):
        super().__init__(name, poses, rng)
        n = self.arm.n
        self.effects = []
        add = lambda kind, joint, **more: self.effects.append({"effect": kind, "joint": joint, **more})
        phase = lambda: float(rng.uniform(0, 2 * np.pi))
        # Sizes in mm at the tool, by the lever of the joint.
        lever = [self.lever(j) for j in range(n)]
        size = lambda j, low, high: float(rng.uniform(low, high)) / max(lever[j], 60.0)
        for j in rng.choice(n, int(rng.integers(4, n + 1)), replace=False):
            teeth = int(rng.choice([80, 81, 100, 101, 120, 121, 160]))
            add("gear-transmission-error", int(j), order=teeth, size=size(j, 0.03, 0.09), phase=phase())
            if rng.random() < 0.6:
                add("gear-transmission-error", int(j), order=2 * teeth, size=size(j, 0.03, 0.09), phase=phase())
        for j in rng.choice(n, int(rng.integers(2, 5)), replace=False):
            add("backlash", int(j), size=size(j, 0.06, 0.16))
        for j in rng.choice([1, 2, 3], int(rng.integers(1, 3)), replace=False):
            add("joint-compliance", int(j), size=float(rng.uniform(0.5e-6, 2e-6)))
        if rng.random() < 0.6:
            j = int(rng.integers(0, n))
            add("axis-wobble", j, order=int(rng.integers(2, 5)), size=float(rng.uniform(0.1e-3, 0.3e-3)), phase=phase())
        if rng.random() < 0.6:
            add("wrist-coupling", n - 1, size=float(rng.uniform(3e-4, 1e-3)))
        if rng.random() < 0.5:
            j = int(rng.integers(0, n - 1))
            add("thermal-zero-drift", j, size=size(j, 0.02, 0.05))
        self.effects = self.effects[:20]

    def lever(self, joint):
        """Median distance of the targets from the axis, mm."""
        homes = self.arm.tool + np.array(list(TARGETS.values()))
        _, _, point, *_ = self.arm.joints[joint]
        _, a = across(self.arm.joints[joint][1])
        d = homes - np.asarray(point, float)
        return float(np.median(np.linalg.norm(d - np.outer(d @ a, a), axis=1)))

    def angles(self):
        theta = self.q.copy()
        sags = []
        for e in self.effects:
            j, a = e["joint"], e["size"]
            q = self.q[:, j]
            if e["effect"] == "gear-transmission-error":
                theta[:, j] += a * np.sin(e["order"] * q + e["phase"])
            elif e["effect"] == "backlash":
                theta[:, j] -= self.dir[:, j] * a / 2
            elif e["effect"] == "wrist-coupling":
                theta[:, j] += a * self.q[:, j - 1]
            elif e["effect"] == "thermal-zero-drift":
                theta[:, j] += a * self.warmth
            elif e["effect"] == "joint-compliance":
                sags.append(e)
        driven = theta.copy()
        for _ in range(3 if sags else 0):
            now = theta.copy()
            for e in sags:
                now[:, e["joint"]] = driven[:, e["joint"]] + e["size"] * self.weight_torque(e["joint"], theta)
            theta = now
        return theta

    def poses_of(self):
        """Measured points and the attitude of the tool, as rotation matrices."""
        arm, theta = self.arm, self.angles()
        x = self.x
        homes = arm.tool + np.array(list(TARGETS.values())) + x[6 * arm.n + 6 :].reshape(-1, 3)
        t = np.tile(np.eye(4), (self.poses, 1, 1))
        for i in range(arm.n):
            link = exp(about(arm.joints[i][2], x[6 * i : 6 * i + 6]))
            t = t @ link
            for e in (e for e in self.effects if e["effect"] == "axis-wobble" and e["joint"] == i):
                t = t @ self.wobble(e, homes, theta)
            t = t @ exp(arm.screws[i], theta[:, i])
        t = self.frame @ t
        p = np.einsum("nij,nj->ni", t, np.c_[homes[self.target], np.ones(self.poses)])[:, :3]
        return p, t[:, :3, :3]

    def wobble(self, e, homes, theta):
        """The contract's: along the axis by R w cos(k q + phi), R the distance of the target from the axis."""
        arm, i = self.arm, e["joint"]
        p = np.c_[homes[self.target], np.ones(self.poses)]
        for k in reversed(range(i, arm.n)):
            p = np.einsum("nij,nj->ni", exp(arm.screws[k], theta[:, k]), p)
            if k > i:
                link = exp(about(arm.joints[k][2], self.x[6 * k : 6 * k + 6]))
                p = np.einsum("nij,nj->ni", np.broadcast_to(link, (self.poses, 4, 4)), p)
        _, a = across(arm.joints[i][1])
        d = p[:, :3] - np.asarray(arm.joints[i][2], float)
        radius = np.linalg.norm(d - (d @ a)[:, None] * a, axis=1)
        by = e["size"] * radius * np.cos(e["order"] * self.q[:, i] + e["phase"])
        t = np.tile(np.eye(4), (self.poses, 1, 1))
        t[:, :3, 3] = by[:, None] * a
        return t

    def visible(self):
        """Of each effect what the points show of it beyond all geometry and all other effects, as squares over the
        noise: below LEAST no analysis that has hundreds of candidates can name it."""
        all_effects, columns = self.effects, []
        whole = self.poses_of()[0]
        for k in range(len(all_effects)):
            self.effects = all_effects[:k] + all_effects[k + 1 :]
            columns.append((whole - self.poses_of()[0]).ravel())
        self.effects = all_effects
        j = self.arm.jacobian(self.x, self.frame, self.q, self.target)
        j = j / np.maximum(np.linalg.norm(j, axis=0), 1e-9)
        lengths = []
        for k, own in enumerate(columns):
            rest = np.column_stack([j] + [c / max(np.linalg.norm(c), 1e-12) for c in columns[:k] + columns[k + 1 :]])
            u, s, _ = np.linalg.svd(rest, full_matrices=False)
            u = u[:, s > 1e-6]
            lengths.append(float(np.sum((own - u @ (u.T @ own)) ** 2)) / SIGMA_MM**2)
        return lengths

    def save(self, folder, name, rng, orientation):
        if orientation:
            self.target[:] = 0
        p, turn = self.poses_of()
        measured = p + self.noise
        quaternions = None
        if orientation:
            small = rng.normal(0, SIGMA_MRAD * 1e-3, (self.poses, 3))
            quaternions = [quaternion(turn[i] @ exp(np.r_[small[i], 0, 0, 0])[0][:3, :3]) for i in range(self.poses)]
        document = {
            "format": "truepose-session/1",
            "name": name,
            "robot": {
                "name": self.name,
                "joints": [
                    {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": at, "limits": [lo, hi]}
                    for i, (k, a, at, lo, hi) in enumerate(self.arm.joints)
                ],
                "tool": {"position_mm": self.arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]},
                "gravity_m_s2": GRAVITY.tolist(),
            },
            "targets": {"T1": TARGETS["T1"]} if orientation else TARGETS,
            "instrument": {"name": "tracker", "sigma_mm": SIGMA_MM}
            | ({"sigma_mrad": SIGMA_MRAD} if orientation else {}),
            "samples": {"file": f"{name}.csv"},
        }
        (folder / f"{name}.json").write_text(json.dumps(document) + "\n")
        n = self.arm.n
        heading = [f"q{i + 1}_deg" for i in range(n)] + ["x_mm", "y_mm", "z_mm"]
        heading += ["qw", "qx", "qy", "qz"] if orientation else []
        heading += [f"dir{i + 1}" for i in range(n)] + ["time_s", "target", "load_kg", "temperature_c", "setup"]
        with open(folder / f"{name}.csv", "w", newline="") as f:
            out = csv.writer(f, lineterminator="\n")
            out.writerow(heading)
            for i in range(self.poses):
                row = [f"{v:.5f}" for v in self.shown[i]] + [f"{v:.5f}" for v in measured[i]]
                row += [f"{v:.9f}" for v in quaternions[i]] if orientation else []
                row += [str(v) for v in self.dir[i]] + [f"{self.time[i]:.0f}", f"T{self.target[i] + 1}"]
                out.writerow([*row, f"{self.load[i]:.0f}", f"{20 + self.warmth[i]:.3f}", "station"])


def quaternion(r):
    """w, x, y, z of a rotation matrix."""
    k = np.array(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
            [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
            [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], 0],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
        ]
    )
    _, v = np.linalg.eigh(k, UPLO="L")
    q = np.r_[v[3, -1], v[:3, -1]]
    return q if q[0] >= 0 else -q


def diagnose(binary, path, limit):
    """The answer, or None after the limit, with processor time in s and memory in MB."""
    out = path.with_suffix(".answer.json")
    child = os.fork()
    if child == 0:
        import resource

        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
        with open(out, "w") as f, open(os.devnull, "w") as nothing:
            os.dup2(f.fileno(), 1)
            os.dup2(nothing.fileno(), 2)
            os.execv(binary, [binary, "diagnose", str(path), "--json"])
    _, status, used = os.wait4(child, 0)
    seconds, memory = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024
    answer = json.loads(out.read_text()) if os.WIFEXITED(status) and out.stat().st_size else None
    return answer, seconds, memory


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--from", dest="first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=int, default=120)
    parser.add_argument("--keep", help="folder that the sessions stay in")
    args = parser.parse_args()
    folder = Path(args.keep or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    print("session              effects   s     MB  held-out mm / floor   right wrong missing  verdict")
    totals = []
    for i in range(args.first, args.first + args.count):
        rng = np.random.default_rng([args.seed, 77, i])
        kind = ("six", "seven", "parallel", "six")[i % 4]
        poses, orientation = int(rng.choice(SIZES)), i % 4 == 3
        robot = OldRobot(kind, poses, rng)
        while not 12 <= len(robot.effects):
            robot = OldRobot(kind, poses, rng)
        name = f"old-{i}-{kind}-{poses}" + ("-turned" if orientation else "")
        robot.save(folder, name, rng, orientation)
        answer, seconds, memory = diagnose(args.binary, folder / f"{name}.json", args.limit)
        key = lambda effect, joint, order: (effect, joint, order if effect == "gear-transmission-error" else None)
        truth = {key(e["effect"], e["joint"] + 1, e.get("order")) for e in robot.effects}
        shown = zip(robot.effects, robot.visible())
        hidden = {key(e["effect"], e["joint"] + 1, e.get("order")) for e, size in shown if size < LEAST}
        if answer is None:
            print(f"{name:22} {len(truth):4} {seconds:7.1f} {memory:6.0f}  not finished", flush=True)
            totals.append((seconds, memory, np.nan, np.nan, np.nan))
            continue
        order_of = lambda f: next((round(p["value"]) for p in f["parameters"] if p["name"] == "order"), None)
        found = {key(f["effect"], f.get("joint"), order_of(f)) for f in answer["found"]}
        unseen, floor = answer["held_out"]["end_mm"], answer["floor"]["mm"]
        right, wrong, missing = len(found & truth), len(found - truth), len(truth - found - hidden)
        print(
            f"{name:22} {len(truth):4} {seconds:7.1f} {memory:6.0f} {unseen:9.4f} / {floor:.4f}"
            f" {right:12} {wrong:5} {missing:6}   {answer['verdict']} {sorted(found - truth, key=str) or ''}"
            f" {sorted(truth - found - hidden, key=str) or ''}",
            flush=True,
        )
        totals.append((seconds, memory, right, wrong, missing))
    t = np.array(totals, float)
    done = ~np.isnan(t[:, 2])
    print(
        f"{len(t)} sessions, {done.sum()} finished: {np.median(t[:, 0]):.1f} s in the median, {t[:, 0].max():.1f} at most,"
        f" {t[:, 1].max():.0f} MB; names right {t[done, 2].sum():.0f}, wrong {t[done, 3].sum():.0f},"
        f" not found {t[done, 4].sum():.0f}"
    )


if __name__ == "__main__":
    main()
