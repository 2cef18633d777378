"""What leaves the program, on sessions that hold more than its catalogue and on sessions that were set up
wrongly: numpy, exact geometry, nothing shared with src/. The arms are those of arms.py.

    python tests/reference/wild_leaving.py BINARY [--count 100] [--rows one,arms,checks] [--seed 1]
                                           [--only coupled,exchanged]

one     one axis, radius 320 mm, two reflectors, sigma 0.02 mm, 130 poses: the azimuth circle of the tracker
        is eccentric; coordinates rounded to 0.1 mm; the arm grows at 35 degrees and the bracket of the
        reflectors does not; a bump over 20 degrees of the joint; nothing at all. The model of `diagnose` is
        compared with that of `identify` in its own figures, and both tables drive the robot that was
        measured: the reflectors are to be where the nominal robot has them.
arms    five arms with geometry errors, and every kind of set-up error on one joint or on the measured
        coordinates: `verify` of the model of `identify` and of `diagnose` on the raw session against what
        these said, and raw joint targets driven through the robot as they are and corrected.
checks  one axis without anything hidden, and a check of it whose last third was measured 0.5 mm off: the
        headline of `verify` against the root mean square over all samples.

Measured in November 2026:

| hidden | RMS error above identify's, before | after | verify differs, before | after | table worse, before | after |
| --- | --- | --- | --- | --- | --- | --- |
| azimuth circle | 4 of 22, up to 1.1 times | 0 of 100 | 0 of 22 | 0 of 100 | 0 of 22 | 0 of 100 |
| rounded | 6 of 22, up to 91.7 times | 0 of 100 | 0 of 22 | 0 of 100 | 1 of 22 | 0 of 100 |
| hot | 0 of 22 | 0 of 100 | 0 of 22 | 0 of 100 | 0 of 22 | 0 of 100 |
| bump (before: 11 sessions) | 8 of 11, up to 1.5 times | 0 of 100 | 4 of 11 | 0 of 100 | 0 of 11 | 0 of 100 |
| nothing | 0 of 22 | 0 of 100 | 0 of 22 | 0 of 100 | 0 of 22 | 0 of 100 |

| set-up error | verify differs, before | after | verified, before, mm | after | targets worse, before | after | driven, before, mm | after |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
| none | 0 of 12 | 0 of 200 | 0.050 | 0.050 | 0 of 2 | 0 of 30 | 1.649 → 0.006 | 1.707 → 0.045 |
| inches | 12 of 12 | 0 of 200 | 2239 | 0.049 | | | | |
| metres | 10 of 10 | 0 of 199 | 881 | 0.050 | | | | |
| x and y exchanged | 10 of 10 | 0 of 200 | 721 | 0.050 | 0 of 3 | 0 of 60 | 1.642 → 0.006 | 1.726 → 0.090 |
| sign of a joint | 23 of 23 | 0 of 200 | 296 | 0.050 | 13 of 13 | 0 of 60 | 1.762 → 3.766 | 1.547 → 0.053 |
| home off by 90° | 23 of 23 | 0 of 200 | 288 | 0.050 | 9 of 13 | 0 of 60 | 1.447 → 2.038 | 1.507 → 0.084 |
| joints coupled | 2 of 5 | 0 of 200 | 358 | 0.050 | 1 of 2 | 0 of 50 | 1.475 → 2.530 | 1.725 → 0.139 |
| joints exchanged | 5 of 5 | 0 of 200 | 362 | 0.049 | 3 of 3 | 0 of 75 | 1.715 → 4.853 | 1.474 → 0.088 |

Before: 100 sessions in all, models of `identify`; after: 100 sessions a row, models of `identify` and of `diagnose`.
Driven are the targets that were corrected, in sessions in which at least six were and the arm has six joints or more.

| | headline off by more than 1 % | said, mm | true, mm | a finding |
| --- | --- | --- | --- | --- |
| before | 100 of 100 | 0.035 | 0.293 | 0 of 100 |
| after | 0 of 100 | 0.293 | 0.293 | 100 of 100 |
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from arms import ARMS, R, TARGETS, Arm, exp  # noqa: E402

RADIUS, HEIGHT = 320.0, 210.0
SIGMA = 0.02
POINTS = {"A": (0.0, 0.0, 0.0), "B": (90.0, 30.0, 50.0)}


def run(binary, *words):
    done = subprocess.run([binary, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def answer(binary, *words):
    code, out, err = run(binary, *words, "--json")
    return json.loads(out) if code == 0 else {"error": err.strip(), "code": code}


def write(folder, name, robot, targets, sigma, heading, rows):
    document = {
        "format": "truepose-session/1",
        "name": name,
        "robot": robot,
        "targets": targets,
        "instrument": {"name": "tracker", "sigma_mm": sigma},
        "samples": {"file": f"{name}.csv"},
    }
    (folder / f"{name}.json").write_text(json.dumps(document))
    with open(folder / f"{name}.csv", "w", newline="") as file:
        csv.writer(file).writerows([heading, *rows])
    return folder / f"{name}.json"


def figure_of(verified, said):
    """What `verify` has to repeat of an answer, and within what part."""
    trimmed = verified.get("trimmed")
    if said.get("outliers") and trimmed:
        return trimmed["model_mm"], 0.05
    return verified["gap"]["model_mm"], 0.01


def rms(e):
    return float(np.sqrt((np.asarray(e) ** 2).sum(-1).mean()))


# One axis


class Axis:
    """A turntable with an arm of RADIUS: what it does beyond the nominal robot."""

    def __init__(self, rng, hidden):
        self.offset = np.radians(rng.normal(0, 0.3))
        self.length = rng.normal(0, 1.0)
        self.hidden = hidden
        self.station = np.r_[rng.uniform(-1, 1, 2) * 1500 + [2500, 0], rng.uniform(-200, 900)]
        self.ecc, self.phase = rng.uniform(0.5, 1.5) * 40e-6, rng.uniform(0, 2 * np.pi)
        self.centre, self.width = rng.uniform(-120, 120), 20.0
        self.bump = rng.uniform(0.1, 0.3) / RADIUS
        self.alpha = rng.uniform(1, 2) * 12e-6

    def points(self, q, target, warm):
        """Where the reflectors really are; q in degrees, warm above 20 degrees C."""
        theta = np.radians(q) + self.offset
        if self.hidden == "bump":
            theta = theta + self.bump * np.exp(-0.5 * ((q - self.centre) / (self.width / 2.355)) ** 2)
        grown = 1 + (self.alpha * warm if self.hidden == "hot" else 0 * warm)
        local = np.array(list(POINTS.values()))[target]
        x = (RADIUS + self.length) * grown + local[:, 0]
        y, z = local[:, 1], HEIGHT + local[:, 2]
        c, s = np.cos(theta), np.sin(theta)
        return np.c_[c * x - s * y, s * x + c * y, z]

    def measured(self, points, rng):
        out = points + rng.normal(0, SIGMA, points.shape)
        if self.hidden == "azimuth":
            seen = out - self.station
            azimuth = np.arctan2(seen[:, 1], seen[:, 0])
            by = self.ecc * np.sin(azimuth - self.phase)
            c, s = np.cos(by), np.sin(by)
            out = self.station + np.c_[c * seen[:, 0] - s * seen[:, 1], s * seen[:, 0] + c * seen[:, 1], seen[:, 2]]
        return np.round(out, 1 if self.hidden == "rounded" else 4)


AXIS = {
    "name": "axis",
    "joints": [{"name": "a", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0], "limits": [-180, 180]}],
    "tool": {"position_mm": [RADIUS, 0, HEIGHT], "quaternion_wxyz": [1, 0, 0, 0]},
    "gravity_m_s2": [0, 0, -9.81],
}


def axis_session(folder, name, axis, rng, count, shift=None):
    q = rng.uniform(-170, 170, count)
    target = rng.integers(0, 2, count)
    time = 8.0 * np.arange(count)
    warm = (15 + 2 * (1 - np.exp(-time / 600))) if axis.hidden == "hot" else 3 * (1 - np.exp(-time / 400))
    points = axis.measured(axis.points(q, target, warm), rng)
    if shift is not None:
        points[-count // 3 :] += shift
    rows = [
        [f"{q[i]:.7f}", *(f"{v:.4f}" for v in points[i]), rng.choice([-1, 1]), f"{20 + warm[i]:.4f}", time[i], "AB"[target[i]]]
        for i in range(count)
    ]
    heading = ["q1_deg", "x_mm", "y_mm", "z_mm", "dir1", "temperature_c", "time_s", "target"]
    path = write(folder, name, AXIS, POINTS, SIGMA, heading, rows)
    return path, q, target, warm, points


def driven(axis, nominal, table, rng):
    """RMS error of the reflectors without a table and with it, at the reference temperature."""
    q = rng.uniform(-165, 165, 400)
    target = rng.integers(0, 2, 400)
    still = np.zeros(400)
    wanted = nominal.points(q, target, still)
    with open(table) as file:
        rows = [r for r in csv.reader(line for line in file if not line.startswith("#")) if r]
    at = np.array([[float(v) for v in r[:2]] for r in rows[1:]])
    by = np.interp(q, at[:, 0], at[:, 1])
    return rms(axis.points(q, target, still) - wanted), rms(axis.points(q + by, target, still) - wanted)


def one(binary, folder, count, seed):
    nominal = Axis(np.random.default_rng(0), None)
    nominal.offset = nominal.length = 0.0
    for hidden in ["azimuth", "rounded", "hot", "bump", "nothing"]:
        worse = held_worse = own = off_own = made_worse = tables = 0
        ratio, left = 0.0, []
        for k in range(count):
            rng = np.random.default_rng([seed, k, ord(hidden[0])])
            axis = Axis(rng, hidden)
            path, *_ = axis_session(folder, f"{hidden}-{k}", axis, rng, 130)
            models = [folder / f"{n}.json" for n in ("model-i", "model-d")]
            run(binary, "identify", path, "--out", models[0], "--force")
            found = answer(binary, "diagnose", path, "--out", models[1], "--force")
            end = found["gap"]["end_mm"]
            # Over the same samples: all of them.
            errors = [answer(binary, "verify", model, path)["gap"]["model_mm"] for model in models]
            worse += errors[1] > errors[0] * (1 + 1e-3)
            ratio = max(ratio, errors[1] / errors[0])
            held = found["held_out"]
            held_worse += held["end_mm"] > held["identified_mm"] * (1 + 1e-9)
            verified = answer(binary, "verify", models[1], path)
            figure, within = figure_of(verified, found)
            own += 1
            off_own += abs(figure / end - 1) > within
            after = []
            for model in models:
                table = folder / "table.csv"
                code, _, err = run(binary, "export", model, "--to", "csv", "--out", table, "--step", 1, "--force")
                if code:
                    break
                before, with_table = driven(axis, nominal, table, np.random.default_rng(k))
                after.append(with_table)
            if len(after) == 2:
                tables += 1
                made_worse += after[1] > max(before, 1.1 * after[0])
                left.append(after[1])
        print(
            f"| {hidden} | {worse} of {count} (up to {ratio:.1f} times) | {held_worse} of {count} | {off_own} of {own} "
            f"| {made_worse} of {tables} | {np.median(left):.3f} |",
            flush=True,
        )


# Arms


def mistakes(arm):
    """Name, what it does to raw joint values (rad, mm) and to measured points."""
    n = arm.n
    turning = [j for j in range(n) if arm.joints[j][0] == R]

    def sign(j):
        return lambda q: q * np.where(np.arange(n) == j, -1, 1)

    def home(j, by):
        return lambda q: q + np.where(np.arange(n) == j, np.radians(by), 0)

    same = lambda q: q
    plain = lambda p: p
    found = [("none", same, plain), ("inches", same, lambda p: p / 25.4), ("metres", same, lambda p: p / 1000)]
    found.append(("x and y exchanged", same, lambda p: p[:, [1, 0, 2]]))
    for j in turning[1:]:
        found += [(f"sign {j + 1}", sign(j), plain), (f"home {j + 1}", home(j, 90), plain)]
    if n > 2 and len(turning) > 2:
        a, b = turning[1], turning[2]

        def couple(q, a=a, b=b):
            out = q.copy()
            out[:, b] += q[:, a]
            return out

        def exchange(q, a=a, b=b):
            out = q.copy()
            out[:, [a, b]] = q[:, [b, a]]
            return out

        found += [("coupled", couple, plain), ("exchanged", exchange, plain)]
    return found


def arm_robot(name, arm):
    joints = [
        {"name": f"j{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": [-400, 400]}
        for i, (k, a, p, _, _) in enumerate(arm.joints)
    ]
    return {"name": name, "joints": joints, "tool": {"position_mm": arm.tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]}}


KINDS = ["none", "inches", "metres", "x", "sign", "home", "coupled", "exchanged"]


def of_kind(kind, k):
    """The k-th session of a kind: its arm, and the mistake on the next of the joints that may have it."""
    able = [n for n in ARMS if any(m[0].split(" ")[0] == kind for m in mistakes(Arm(n)))]
    name = able[k % len(able)]
    own = [m for m in mistakes(Arm(name)) if m[0].split(" ")[0] == kind]
    return name, own[(k // len(able)) % len(own)]


def arms(binary, folder, count, seed, only=None):
    totals = {}
    for kind, k in [(kind, k) for kind in only or KINDS for k in range(count)]:
        rng = np.random.default_rng([seed, k, 7, KINDS.index(kind)])
        name, (what, to_raw, to_seen) = of_kind(kind, k)
        arm = Arm(name)
        x = np.zeros(arm.size)
        for i in range(arm.n):
            x[6 * i : 6 * i + 3] = rng.normal(0, 0.5e-3, 3)
            x[6 * i + 3 : 6 * i + 6] = rng.normal(0, 0.3, 3)
        x[6 * arm.n + 6 :] = np.tile(rng.normal(0, 2, 3), 3)
        aligned = k % 2 == 0
        frame = np.eye(4)
        if not aligned:
            turn = rng.normal(size=3)
            frame = exp(np.r_[turn * 2 / np.linalg.norm(turn), 0, 0, 0])[0]
            frame[:3, 3] = rng.normal(0, 2000, 3)
        low = np.array([j[3] for j in arm.joints], float)
        high = np.array([j[4] for j in arm.joints], float)
        inner = np.array([np.radians(1.0) if j[0] == R else 1.0 for j in arm.joints])
        q = rng.uniform(low, high, (120, arm.n)) * inner
        target = rng.integers(0, 3, 120)
        seen = to_seen(arm.points(x, frame, q, target) + rng.normal(0, 0.03, (120, 3)))
        raw = to_raw(q) / inner
        unit = ["deg" if j[0] == R else "mm" for j in arm.joints]
        heading = [f"q{i + 1}_{u}" for i, u in enumerate(unit)] + ["x_mm", "y_mm", "z_mm", "target"]
        rows = [[*(f"{v:.6f}" for v in raw[i]), *(f"{v:.6f}" for v in seen[i]), f"T{target[i] + 1}"] for i in range(120)]
        path = write(folder, f"arm-{k}", arm_robot(name, arm), TARGETS, 0.03, heading, rows)
        row = totals.setdefault(what.split(" ")[0], dict(n=0, wrong=0, gross=0, said=[], verified=[], targets=0, worse=0, before=[], after=[]))
        for command, key in (("identify", "after_mm"), ("diagnose", "end_mm")):
            model = folder / f"model-{command}.json"
            said = answer(binary, command, path, "--out", model, "--force")
            if "error" in said:
                continue
            verified = answer(binary, "verify", model, path)
            row["n"] += 1
            if "error" in verified:
                row["wrong"] += 1
                continue
            figure, within = figure_of(verified, said)
            row["wrong"] += abs(figure / said["gap"][key] - 1) > within
            # More than a hundredth of the error that the set-up error makes: it was not recognised.
            if command == "identify" and said["gap"][key] > 1:
                row["gross"] += 1
                print(f"not recognised: {name}, {what}, session {k}: {said['gap'][key]:.1f} mm", file=sys.stderr)
            row["said"].append(said["gap"][key])
            row["verified"].append(verified["gap"]["model_mm"])
        # Raw joint targets, through the robot that was measured, where its joints can correct a whole pose.
        if arm.n < 6:
            continue
        if not aligned and what == "none" or np.linalg.norm(to_seen(np.ones((1, 3))) - 1) > 0:
            continue
        wanted_q = rng.uniform(0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high, (20, arm.n)) * inner
        rows = [[f"{v:.6f}" for v in to_raw(wanted_q[i : i + 1])[0] / inner] for i in range(20)]
        programme = folder / "targets.csv"
        with open(programme, "w", newline="") as file:
            csv.writer(file).writerows([[f"q{i + 1}_{u}" for i, u in enumerate(unit)], *rows])
        out = folder / "corrected.csv"
        code, _, _ = run(binary, "compensate", folder / "model-identify.json", programme, "--out", out, "--force")
        if code == 2 or not out.exists():
            continue
        with open(out) as file:
            back = np.array([[float(v) for v in r] for r in list(csv.reader(file))[1:]]) * inner
        # The controller adds to the true joint values what was added to its own.
        told = solve_raw(to_raw, back, wanted_q)
        corrected = np.abs(told - wanted_q).max(1) > 1e-7
        if corrected.sum() < 6:
            continue
        wanted_q, told = wanted_q[corrected], told[corrected]
        still = np.eye(4)
        origin = lambda a, y, q: points_of_tool(a, y, still, q)
        nominal = origin(arm, np.zeros(arm.size), wanted_q)
        places = origin(arm, x, wanted_q), origin(arm, x, told)
        row["targets"] += 1
        # What joint 1 shares with the frame of the instrument is the frame's: the best rigid motion is taken out.
        before, after = (aligned_rms(nominal, p) for p in places)
        row["before"].append(before)
        row["after"].append(after)
        row["worse"] += after > before
        out.unlink()
    for what, row in totals.items():
        median = lambda v: f"{np.median(v):.3f}" if v else "-"
        print(
            f"| {what} | {row['wrong']} of {row['n']} | {row['gross']} | {median(row['said'])} | {median(row['verified'])} "
            f"| {row['worse']} of {row['targets']} | {median(row['before'])} → {median(row['after'])} |",
            flush=True,
        )


def solve_raw(to_raw, back, start):
    """The true joint values of raw ones, by Newton's method: every mistake is linear."""
    q = start.copy()
    n = q.shape[1]
    columns = np.stack([to_raw(q + np.eye(n)[k]) - to_raw(q) for k in range(n)], axis=-1)
    for i in range(len(q)):
        q[i] += np.linalg.solve(columns[i], back[i] - to_raw(q[i : i + 1])[0])
    return q


def points_of_tool(arm, x, frame, q):
    """The mean of the three targets of every pose, a row each target."""
    return np.concatenate([arm.points(x, frame, q, np.full(len(q), t)) for t in range(3)])


def aligned_rms(a, b):
    ca, cb = a.mean(0), b.mean(0)
    u, _, vt = np.linalg.svd((b - cb).T @ (a - ca))
    turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    return rms((b - cb) - (a - ca) @ turn.T)


# Checks


def checks(binary, folder, count, seed):
    off, found, said, true = 0, 0, [], []
    for k in range(count):
        rng = np.random.default_rng([seed, k, 11])
        axis = Axis(rng, None)
        path, *_ = axis_session(folder, f"fit-{k}", axis, rng, 60)
        model = folder / "model.json"
        fitted = answer(binary, "identify", path, "--out", model, "--force")
        turn = rng.normal(size=3)
        check, q, target, warm, points = axis_session(
            folder, f"check-{k}", axis, rng, 100, 0.5 * turn / np.linalg.norm(turn)
        )
        estimated = Axis(rng, None)
        values = {p["name"]: p["value"] for p in fitted["parameters"]}
        estimated.offset, estimated.length = np.radians(values["offset_deg"]), values["delta_mm"]
        truth = rms(points - estimated.points(q, target, 0 * warm))
        verified = answer(binary, "verify", model, check)
        figure = verified["gap"]["model_mm"]
        off += abs(figure / truth - 1) > 0.01
        found += bool(verified.get("data_problems"))
        said.append(figure)
        true.append(truth)
    print(f"| last third 0.5 mm off | {off} of {count} | {np.median(said):.3f} | {np.median(true):.3f} | {found} of {count} |")


HEADS = {
    "one": "| hidden | RMS error above identify's | held-out above | verify differs | table worse | left by the table, mm |",
    "arms": "| set-up error | verify differs | not recognised | said, mm | verified, mm | targets worse | before → after, mm |",
    "checks": "| check | headline wrong | said, mm | true, mm | a finding |",
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--rows", default="one,arms,checks")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="set-up errors of the row arms")
    wanted = parser.parse_args()
    for row in wanted.rows.split(","):
        head = HEADS[row]
        print(f"\n{head}\n|{' --- |' * (head.count('|') - 1)}", flush=True)
        with tempfile.TemporaryDirectory() as folder:
            given = wanted.binary, Path(folder), wanted.count, wanted.seed
            if row == "arms":
                arms(*given, wanted.only and wanted.only.split(","))
            else:
                {"one": one, "checks": checks}[row](*given)


if __name__ == "__main__":
    main()
