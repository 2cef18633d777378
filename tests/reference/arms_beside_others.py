"""A six-joint arm calibrated by several programs from the same poses: accuracy and processor time.

    python tests/reference/arms_beside_others.py [--truepose BINARY] [--poses 60,200,5000]
        [--unknown-base] [--with truepose,numpy,robotkinecal,figaroh,figaroh-map] [--repeats N]

The arm is "six" of arms.py with one target, position only: errors of 0.3 mm and 0.5 mrad before every
joint in all six directions, zeros 0.2 degrees, tool 1 mm, sigma 0.03 mm. The instrument's frame is off by
1 mm and 1 mrad, or anywhere (`--unknown-base`). What counts is the distance from the truth on poses that
no program has seen. Packages that the interpreter does not have are said and left out; `figaroh-map` is
figaroh's model with its weak priors. One thread: set OMP_NUM_THREADS=1 before numpy is loaded, as is done here.

Measured in November 2026 (a shared machine with two cores under load: times vary by a fifth):

| | 60 poses | | 200 poses | | 5000 poses | |
| --- | --- | --- | --- | --- | --- | --- |
| `truepose identify`, file, outliers, intervals, levels and all | 0.01902 mm | 0.035 s | 0.00924 mm | 0.039 s | 0.00199 mm | 0.155 s |
| least squares alone, in memory (`cargo bench --bench identification`, `arm_5000_poses`) | | | | | | 0.0041 s |
| numpy, Levenberg–Marquardt with analytic derivatives, of what pivoted QR keeps | 0.01904 mm | 0.003 s | 0.00923 mm | 0.004 s | 0.00199 mm | 0.046 s |
| `robotkinecal` 0.1.0 | 0.01904 mm | 0.11 s | 0.00923 mm | 0.48 s | 0.00199 mm | 12.0 s |
| `figaroh` 1.0.2 | 0.01904 mm | 0.20 s | 0.23601 mm | 0.58 s | 0.00199 mm | 13.2 s |
| `figaroh` 1.0.2, `map` | 0.01902 mm | 0.43 s | 0.00924 mm | 1.3 s | 0.00199 mm | 29 s |

All reach the same answer where they converge. At 200 poses `figaroh`'s default drops a parameter that the poses
show. With the instrument anywhere (`--unknown-base`, 200 poses) `robotkinecal` diverges and `figaroh` drops the same parameter; the others do as well as
before. `robotkinecal` takes the toolbox's links of base and tool for joints and is told which are; it and `figaroh` take
metres. On the 5000 poses the
least squares alone takes 4.1 ms where numpy takes 41: the same 27 parameters in four passes from the same start,
measured one after the other. The benchmark's own session, which needs a pass less, takes 3.2 ms. With the gauge, outliers,
noise and priors around it a fit in memory takes 90 ms, half of it for the search of a slow noise.
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
    """The whole command from the file to the answer; the unseen poses are held out of the fit."""
    if not options.truepose:
        raise ImportError("--truepose BINARY")
    with tempfile.TemporaryDirectory() as folder:
        path = written_session(poses, Path(options.keep or folder))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = subprocess.run([options.truepose, "identify", path, "--json"], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode:
        raise RuntimeError(run.stderr)
    answer = json.loads(run.stdout)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    free = sum(p["ci95"] is not None for p in answer["parameters"])
    return answer["held_out"]["after_mm"], spent, f"{free} parameters; the whole command"


def written_session(poses, folder):
    folder.mkdir(parents=True, exist_ok=True)
    joints = [
        {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [lo, hi]}
        for i, (k, a, p, lo, hi) in enumerate(ARMS["six"][0])
    ]
    tool = {"position_mm": poses.arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]}
    document = {
        "format": "truepose-session/1",
        "name": "beside others",
        "robot": {"name": "six", "joints": joints, "tool": tool},
        "targets": {"T1": TARGET.tolist()},
        "instrument": {"name": "tracker", "sigma_mm": SIGMA_MM},
        "samples": {"file": "beside.csv"},
    }
    (folder / "beside.json").write_text(json.dumps(document) + "\n")
    lines = [",".join([*(f"q{i + 1}_deg" for i in range(poses.arm.n)), "x_mm", "y_mm", "z_mm", "use"])]
    for use, shown, points in (
        ("fit", poses.shown, poses.measured),
        ("held-out", poses.unseen_shown, poses.unseen),
    ):
        for q, p in zip(shown, points):
            lines.append(",".join([*(f"{v:.6f}" for v in q), *(f"{v:.9f}" for v in p), use]))
    (folder / "beside.csv").write_text("\n".join(lines) + "\n")
    return str(folder / "beside.json")


def by_robotkinecal(poses, _):
    """Positions in metres in the frame of the instrument, as the package takes them."""
    import roboticstoolbox as rtb
    from robotkinecal import SerialRobotKineCal
    from spatialmath import SE3

    links = [rtb.PoERevolute(np.asarray(a, float), np.asarray(p) / 1e3) for _, a, p, _, _ in poses.arm.joints]
    robot = rtb.PoERobot(links, SE3(*((poses.arm.tool + TARGET) / 1e3)))
    np.random.seed(0)  # it draws the directions across the axes
    start = time.process_time()
    calibration = SerialRobotKineCal(robot)
    # It takes the links of the base and of the tool for joints.
    calibration.N_JOINTS = poses.arm.n
    calibration.joint_screw_axis = [np.asarray(link.S.A, float) for link in robot.links if link.isjoint]
    calibration.set_observations(list(poses.q), list(poses.measured / 1e3))
    result = calibration.solve()
    spent = time.process_time() - start
    p = np.tile(np.r_[calibration.zero_conf_EE_pose.t, 1.0], (len(poses.unseen_q), 1))
    for i in reversed(range(poses.arm.n)):
        screw = calibration.joint_screw_axis[i]
        p = np.einsum("nij,nj->ni", exp(np.r_[screw[3:], screw[:3]], poses.unseen_q[:, i]), p)
    word = "converged" if result.has_converged else "diverged" if result.is_diverging else "not converged"
    return p[:, :3] * 1e3, spent, f"27 parameters, {word}, {result.nb_iterations_executed} passes"


def by_figaroh(poses, _, method="structural"):
    """URDF and CSV in metres, base and tool frames unknown, in its way for tables of positions."""
    from figaroh.calibration.base_calibration import BaseCalibration
    from figaroh.calibration.calibration_tools import calc_updated_fkm
    from figaroh.tools.robot import create_robot

    class Calibration(BaseCalibration):
        def cost_function(self, var):
            there = calc_updated_fkm(self.model, self.data, var, self.q_measured, self.calib_config)
            return self.PEE_measured - there

    names = [f"j{i + 1}" for i in range(poses.arm.n)]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "arm.urdf").write_text(urdf(poses.arm))
        header = ",".join(["x1", "y1", "z1", *names])
        for name, q, points in (("fit", poses.q, poses.measured), ("unseen", poses.unseen_q, poses.unseen)):
            np.savetxt(folder / f"{name}.csv", np.c_[points / 1e3, q], delimiter=",", header=header, comments="")
        config = {
            "robot": {"name": "six"},
            "tasks": {
                "calibration": {
                    "enabled": True,
                    "type": "kinematic_calibration",
                    "kinematics": {"base_frame": "universe", "tool_frame": "tool"},
                    "parameters": {"calibration_level": "full_params", "estimation": {"method": method}},
                    "measurements": {"markers": [{"measurable_dof": [True] * 3 + [False] * 3}]},
                    "data": {"source_file": str(folder / "fit.csv"), "number_of_samples": len(poses.q)},
                }
            },
        }
        (folder / "arm.yaml").write_text(json.dumps(config))
        robot = create_robot(str(folder / "arm.urdf"), package_dirs=str(folder))
        start = time.process_time()
        with contextlib.redirect_stdout(io.StringIO()):
            calibration = Calibration(robot, str(folder / "arm.yaml"))
            calibration.calib_config.update(known_baseframe=False, known_tipframe=False)
            calibration.initialize()
            result, _ = calibration.solve_optimisation()
        spent = time.process_time() - start
        calibration.calib_config["NbSample"] = UNSEEN
        there = calc_updated_fkm(
            calibration.model, calibration.data, result.x, poses.unseen_q, calibration.calib_config
        )
    note = f"{len(result.x)} parameters, {'converged' if result.success else 'not converged'}"
    return np.asarray(there).reshape(3, -1).T * 1e3, spent, note


def urdf(arm):
    """The nominal arm: every joint where it is at home, axes as they are, a frame at the target."""
    places = [np.asarray(p, float) for _, _, p, _, _ in arm.joints] + [arm.tool + TARGET]
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    parts = ['<robot name="six">', '<link name="l0"/>']
    before = np.zeros(3)
    for i, place in enumerate(places):
        xyz = " ".join(f"{v / 1e3:.6f}" for v in place - before)
        before = place
        if i < arm.n:
            _, axis, _, low, high = arm.joints[i]
            turning = f'<axis xyz="{" ".join(map(str, axis))}"/>'
            turning += f'<limit lower="{np.radians(low)}" upper="{np.radians(high)}" effort="1" velocity="1"/>'
            name, kind = f"j{i + 1}", "revolute"
        else:
            name, kind, turning = "end", "fixed", ""
        child = f"l{i + 1}" if i < arm.n else "tool"
        parts.append(f'<link name="{child}">{inertial if i < arm.n else ""}</link>')
        parts.append(
            f'<joint name="{name}" type="{kind}"><parent link="l{i}"/><child link="{child}"/>'
            f'<origin xyz="{xyz}" rpy="0 0 0"/>{turning}</joint>'
        )
    return "\n".join([*parts, "</robot>", ""])


PROGRAMS = {
    "truepose": by_truepose,
    "numpy": by_numpy,
    "robotkinecal": by_robotkinecal,
    "figaroh": by_figaroh,
    "figaroh-map": lambda poses, options: by_figaroh(poses, options, "map"),
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--truepose", metavar="BINARY")
    parser.add_argument("--keep", metavar="FOLDER", help="where the session of truepose stays")
    parser.add_argument("--poses", default="60,200,5000")
    parser.add_argument("--unknown-base", action="store_true")
    parser.add_argument("--with", dest="programs", default=",".join(PROGRAMS))
    parser.add_argument("--repeats", type=int, default=3, help="of which the median time is said")
    options = parser.parse_args()
    print(f"{'program':14} {'poses':>5} {'from the truth, mm':>18} {'processor time, s':>17}")
    for count in map(int, options.poses.split(",")):
        poses = Poses(count, 1, options.unknown_base)
        for name in options.programs.split(","):
            times = []
            try:
                for _ in range(options.repeats):
                    predicted, spent, note = PROGRAMS[name](poses, options)
                    times.append(spent)
                    if spent > 20:
                        break
            except ImportError as missing:
                print(f"{name:14} {count:5} not here: {missing}", flush=True)
                continue
            except Exception as failed:  # noqa: BLE001: whatever a package raises is its answer
                print(f"{name:14} {count:5} failed: {type(failed).__name__}: {failed}", flush=True)
                continue
            off = from_truth(predicted, poses) if isinstance(predicted, np.ndarray) else predicted
            print(f"{name:14} {count:5} {off:18.5f} {np.median(times):17.4f}  {note}", flush=True)


if __name__ == "__main__":
    main()
