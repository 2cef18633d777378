"""A six-joint arm calibrated by several programs from the same poses: accuracy and processor time.

    python tests/reference/arms_beside_others.py [--truepose BINARY] [--poses 200,5000] [--unknown-base]
        [--with numpy,truepose,robotkinecal,figaroh,figaroh-map] [--seeds N] [--keep FOLDER]

The arm is "six" of arms.py with one target, position only: errors of 0.3 mm and 0.5 mrad before every
joint in all six directions, zeros 0.2 degrees, tool 1 mm, sigma 0.03 mm. The instrument's frame is off by
1 mm and 1 mrad, or anywhere (`--unknown-base`). What counts is the distance from the truth on poses that
no program has seen. Packages that the interpreter does not have are said and left out; `figaroh-map` is
figaroh's model with its weak priors. One thread: set OMP_NUM_THREADS=1 before numpy is loaded, as is done here.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse  # noqa: E402
import contextlib  # noqa: E402
import io  # noqa: E402
import json  # noqa: E402
import resource  # noqa: E402
import subprocess  # noqa: E402
import sys  # noqa: E402
import tempfile  # noqa: E402
import time  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy as np  # noqa: E402

sys.path.insert(0, str(Path(__file__).parent))
from arms import ARMS, SIGMA_MM, Arm, exp  # noqa: E402

UNSEEN = 2000
TARGET = np.array([10.0, 5.0, 70.0])


class Poses:
    """What is measured, and what is not shown: `seen` and `unseen` are (joint values, points)."""

    def __init__(self, count, seed, unknown_base):
        rng = np.random.default_rng([seed, count])
        self.arm = arm = Arm("six")
        x = np.zeros(arm.size)
        for i, (_, axis, _, _, _) in enumerate(arm.joints):
            x[6 * i : 6 * i + 3] = rng.normal(0, 0.5e-3, 3)
            x[6 * i + 3 : 6 * i + 6] = rng.normal(0, 0.3, 3)
            x[6 * i : 6 * i + 3] += np.asarray(axis, float) * rng.normal(0, np.radians(0.2))
        # The points of arms.py have three targets: this one is the first.
        x[6 * arm.n + 6 : 6 * arm.n + 9] = rng.normal(0, 1, 3)
        frame = exp(rng.normal(0, 1, 6) * ([1e-3] * 3 + [1.0] * 3))[0]
        if unknown_base:
            turn = rng.normal(size=3)
            frame = exp(np.r_[turn * rng.uniform(1.5, 2.6) / np.linalg.norm(turn), 0, 0, 0])[0]
            frame[:3, 3] = rng.normal(0, 2000, 3)
        low = np.array([j[3] for j in arm.joints], float)
        high = np.array([j[4] for j in arm.joints], float)
        shown = np.round(rng.uniform(low, high, (count + UNSEEN, arm.n)), 6)
        q = np.radians(shown)
        true = arm.points(x, frame, q, np.zeros(len(q), int))
        measured = np.round(true[:count] + rng.normal(0, SIGMA_MM, (count, 3)), 6)
        self.shown, self.q, self.measured = shown[:count], q[:count], measured
        self.unseen_shown, self.unseen_q, self.unseen = shown[count:], q[count:], true[count:]


def from_truth(predicted, poses):
    return float(np.sqrt(((predicted - poses.unseen) ** 2).sum(1).mean()))


def fitted_frame(points, measured):
    """The best rigid motion, as a 4 x 4 matrix."""
    a, b = points.mean(0), measured.mean(0)
    u, _, vt = np.linalg.svd((measured - b).T @ (points - a))
    out = np.eye(4)
    out[:3, :3] = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    out[:3, 3] = b - out[:3, :3] @ a
    return out


class Chain:
    """Levenberg-Marquardt with analytic derivatives: a constant rigid motion before every joint, the
    base and the tool, of which pivoted QR keeps what the poses show (27); columns are turns and shifts in
    the base frame, a x (p - c) and a."""

    def __init__(self, poses):
        arm = poses.arm
        self.axes = [np.asarray(a, float) / np.linalg.norm(a) for _, a, _, _, _ in arm.joints]
        self.centres = [np.asarray(p, float) for _, _, p, _, _ in arm.joints]
        self.links = [np.eye(4) for _ in arm.joints] + [np.eye(4)]
        self.tool = arm.tool + TARGET

    def sines(self, q):
        return np.sin(q.T), np.cos(q.T)

    def frames(self, sin, cos):
        """Before every link: directions (3, 3, n) and where the joint's point is (3, n); and the target."""
        n = sin.shape[1]
        turn = np.broadcast_to(np.eye(3)[:, :, None], (3, 3, n))
        shift = np.zeros((3, n))
        out = []
        for axis, centre, link, s, c in zip(self.axes, self.centres, self.links, sin, cos):
            out.append((turn, shift + np.einsum("ijn,j->in", turn, centre)))
            shift = shift + np.einsum("ijn,j->in", turn, link[:3, 3])
            turn = np.einsum("ijn,jk->ikn", turn, link[:3, :3])
            at = shift + np.einsum("ijn,j->in", turn, centre)
            k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
            turn = turn + np.einsum("ijn,jk->ikn", turn, k) * s + np.einsum("ijn,jk->ikn", turn, k @ k) * (1 - c)
            shift = at - np.einsum("ijn,j->in", turn, centre)
        out.append((turn, None))
        tool = (self.links[-1] @ np.r_[self.tool, 1.0])[:3]
        point = shift + np.einsum("ijn,j->in", turn, tool)
        return out, point

    def predict(self, q):
        return self.frames(*self.sines(q))[1].T

    def columns(self, frames, point, chosen):
        """Rows of the transposed Jacobian: (link, 0-2 a turn about the joint's point, 3-5 a shift)."""
        rows = np.empty((len(chosen), 3, point.shape[1]))
        for row, (link, k) in zip(rows, chosen):
            turn, at = frames[link]
            if k >= 3:
                row[:] = turn[:, k - 3]
                continue
            a, arm = turn[:, k], point - at
            row[0] = a[1] * arm[2] - a[2] * arm[1]
            row[1] = a[2] * arm[0] - a[0] * arm[2]
            row[2] = a[0] * arm[1] - a[1] * arm[0]
        return rows.reshape(len(chosen), -1)

    def choose(self, q):
        """Which of all turns and shifts to fit: those that pivoted QR keeps."""
        joints = len(self.axes)
        every = [(i, k) for i in range(joints) for k in range(6)] + [(joints, k) for k in range(3, 6)]
        rows = self.columns(*self.frames(*self.sines(q[:500])), every)
        left = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        kept = []
        while True:
            norms = np.linalg.norm(left, axis=1)
            best = int(np.argmax(norms))
            if norms[best] < 1e-6:
                return [every[k] for k in sorted(kept)]
            kept.append(best)
            unit = left[best] / norms[best]
            left = left - np.outer(left @ unit, unit)

    def moved(self, chosen, step):
        links = [link.copy() for link in self.links]
        screws = np.zeros((len(links), 6))
        for (link, k), value in zip(chosen, step):
            screws[link, k] = value
        for i, screw in enumerate(screws):
            about = self.centres[i] if i < len(self.centres) else np.zeros(3)
            w, v = screw[:3], screw[3:]
            links[i] = exp(np.r_[w, v + np.cross(about, w)])[0] @ links[i]
        return links

    def fit(self, q, measured, chosen):
        sin, cos = self.sines(q)
        target, damping = measured.T, 0.0
        frames, point = self.frames(sin, cos)
        left = (target - point).ravel()
        cost, passes = left @ left, 1
        while passes < 60:
            rows = self.columns(frames, point, chosen)
            gram, gradient = rows @ rows.T, rows @ left
            while True:
                step = np.linalg.solve(gram + damping * np.diag(np.diag(gram)), gradient)
                done = step @ gram @ step <= 1e-12 * cost
                before, self.links = self.links, self.moved(chosen, step)
                if done:
                    return passes
                frames, point = self.frames(sin, cos)
                left = (target - point).ravel()
                passes += 1
                if left @ left <= cost:
                    cost, damping = left @ left, damping / 10 if damping > 1e-9 else 0.0
                    break
                self.links, damping = before, max(damping * 10, 1e-6)
        return passes


def by_numpy(poses, _):
    chain = Chain(poses)
    chain.links[0] = fitted_frame(chain.predict(poses.q), poses.measured)
    chosen = chain.choose(poses.q)
    start = time.process_time()
    passes = chain.fit(poses.q, poses.measured, chosen)
    spent = time.process_time() - start
    return chain.predict(poses.unseen_q), spent, f"{len(chosen)} parameters, {passes} passes"


def by_truepose(poses, options):
    folder = Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    joints = [
        {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [lo, hi]}
        for i, (k, a, p, lo, hi) in enumerate(ARMS["six"][0])
    ]
    document = {
        "format": "truepose-session/1",
        "name": "beside others",
        "robot": {
            "name": "six",
            "joints": joints,
            "tool": {"position_mm": poses.arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]},
        },
        "targets": {"T1": TARGET.tolist()},
        "instrument": {"name": "tracker", "sigma_mm": SIGMA_MM},
        "samples": {"file": "beside.csv"},
    }
    (folder / "beside.json").write_text(json.dumps(document) + "\n")
    heading = [f"q{i + 1}_deg" for i in range(poses.arm.n)]
    lines = [",".join([*heading, "x_mm", "y_mm", "z_mm", "use"])]
    for q, p in zip(poses.shown, poses.measured):
        lines.append(",".join([*(f"{v:.6f}" for v in q), *(f"{v:.6f}" for v in p), "fit"]))
    for q, p in zip(poses.unseen_shown, poses.unseen):
        lines.append(",".join([*(f"{v:.6f}" for v in q), *(f"{v:.9f}" for v in p), "held-out"]))
    (folder / "beside.csv").write_text("\n".join(lines) + "\n")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(
        [options.truepose, "identify", str(folder / "beside.json"), "--json"], capture_output=True, text=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode:
        raise RuntimeError(run.stderr)
    answer = json.loads(run.stdout)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return answer, spent, "the whole command: file, outliers, intervals, levels"


def run_one(name, poses, options):
    work = {"numpy": by_numpy, "truepose": by_truepose}[name]
    predicted, spent, note = work(poses, options)
    if isinstance(predicted, dict):
        print(json.dumps(predicted)[:3000])
    else:
        print(name, len(poses.q), from_truth(predicted, poses), spent, note)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--truepose")
    parser.add_argument("--keep")
    parser.add_argument("--poses", default="200,5000")
    parser.add_argument("--unknown-base", action="store_true")
    parser.add_argument("--with", dest="programs", default="numpy,truepose")
    o = parser.parse_args()
    for n in map(int, o.poses.split(",")):
        p = Poses(n, 1, o.unknown_base)
        for name in o.programs.split(","):
            run_one(name, p, o)
