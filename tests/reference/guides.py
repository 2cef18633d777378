"""Guides that are not straight: a gantry of three slides, an arm of six joints on a rail, and a single slide or table
that carries three reflectors, of exact geometry. Each guide moves its carriage across its travel and turns it (ISO 230-1:
straightness, roll, pitch, yaw) by sines that are drawn; the table is tilted by them and its centre moved (ISO 230-7).

    python tests/reference/guides.py BINARY --count 20 --seed 1

prints, by robot and by what is hidden: how many sessions have a name that is not there, a set-up error that is not
there, something that predicts without a name; and the RMS error over 300 poses that no fit has seen, as a multiple of the
noise, median and largest, of `diagnose` and of `identify`.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy as np

NOISE_MM = 0.015
RAIL_MM = 3000.0
# What the centre of a table moves, as a share of what a guide bends: 15 to 45 µm.
BEARING = 0.15
ARM = [
    ([0, 0, 1], [0, 0, 0], 170), ([0, 1, 0], [0, 0, 450], 75), ([0, 1, 0], [0, 0, 1150], 90),
    ([1, 0, 0], [0, 0, 1230], 170), ([0, 1, 0], [730, 0, 1230], 110), ([1, 0, 0], [730, 0, 1230], 170),
]
TOOL = {"rail": [930.0, 0.0, 1180.0], "gantry": [180.0, -40.0, 400.0]}
TRAVELS = {"rail": [[0, RAIL_MM]], "gantry": [[0, 1500], [0, 800], [-300, 0]]}
SLIDES = np.eye(3)
REFLECTORS = {"T1": [180.0, -40.0, 400.0], "T2": [-200.0, 150.0, 120.0], "T3": [60.0, -260.0, -90.0]}


def rotation(vector):
    angle = np.linalg.norm(vector)
    if angle < 1e-15:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def motion(turn, move):
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = turn, move
    return whole


class Guide:
    """What one guide does over its travel, from 0 to 1."""

    def __init__(self, random, hidden):
        self.scale = random.uniform(40e-6, 120e-6) * random.choice([-1, 1]) if "scale" in hidden else 0.0
        bend, turn = (0.1, 0.3), (3e-5, 2e-4)
        self.size = np.array([
            random.uniform(*bend, 3) * ("bow" in hidden), random.uniform(*turn, 3) * ("turns" in hidden)])
        self.cycles = random.uniform(0.3, 1.5, (2, 3))
        self.phase = random.uniform(0, 2 * np.pi, (2, 3))

    def carriage(self, travel, along, axis):
        at = (along - travel[0]) / (travel[1] - travel[0])
        moved, turned = self.size * np.sin(2 * np.pi * self.cycles * at + self.phase)
        across = moved - axis * (moved @ axis)
        return motion(rotation(turned), axis * along * (1 + self.scale) + across)


def session(robot, hidden, seed, count, shown):
    """`shown` is what the poses are drawn with; the robot is that of the seed."""
    random = np.random.default_rng(seed)
    guides = [Guide(random, hidden if k == 0 else hidden - {"scale"}) for k in range(len(TRAVELS[robot]))]
    links = [
        motion(rotation(random.normal(size=3) * 4e-4), random.normal(size=3) * 0.25) if robot == "rail" else np.eye(4)
        for _ in ARM
    ]
    station = motion(rotation(random.normal(size=3) * [1e-3, 1e-3, 1.0]), random.uniform(-4000, 4000, 3))
    poses = np.random.default_rng(shown)
    rows = []
    while len(rows) < count:
        q = [poses.uniform(*travel) for travel in TRAVELS[robot]]
        pose = np.eye(4)
        for along, travel, axis, guide in zip(q, TRAVELS[robot], SLIDES, guides):
            pose = pose @ guide.carriage(travel, along, axis)
        if robot == "rail":
            for (axis, point, most), link in zip(ARM, links):
                q.append(poses.uniform(-most, most))
                turn = rotation(np.radians(q[-1]) * np.array(axis))
                pose = pose @ link @ motion(turn, point - turn @ np.array(point, float))
        point = pose @ np.array([*TOOL[robot], 1.0])
        if robot == "gantry" or point[2] > 100:
            rows.append([*q, *((station @ point)[:3] + NOISE_MM * poses.normal(size=3))])
    slides = [
        {"name": f"slide {k + 1}", "kind": "prismatic", "axis": SLIDES[k].tolist(), "point_mm": [0, 0, 0],
         "limits": travel} for k, travel in enumerate(TRAVELS[robot])]
    turning = [
        {"name": f"joint {k + 1}", "kind": "revolute", "axis": axis, "point_mm": point, "limits": [-most, most]}
        for k, (axis, point, most) in enumerate(ARM)] if robot == "rail" else []
    names = [f"q{k + 1}_mm" for k in range(len(slides))]
    names += [f"q{len(slides) + k + 1}_deg" for k in range(len(turning))] + ["x_mm", "y_mm", "z_mm"]
    return {
        "format": "truepose-session/1", "name": f"{robot} {seed}",
        "robot": {"name": robot, "joints": slides + turning,
                  "tool": {"position_mm": TOOL[robot], "quaternion_wxyz": [1, 0, 0, 0]}},
        "instrument": {"name": "tracker", "sigma_mm": NOISE_MM},
        "samples": {"columns": dict(zip(names, np.transpose(rows).tolist()))},
    }


def single(robot, hidden, seed, count, shown):
    """One joint with three reflectors in two sweeps of so many places; 300 unseen poses anywhere."""
    random = np.random.default_rng(seed)
    slides = robot == "slide"
    guide = Guide(random, hidden)
    travel = [0.0, 1500.0] if slides else [-170.0, 170.0]
    poses = np.random.default_rng(shown)
    swept = np.tile(np.linspace(*travel, count), 2)
    rows, targets = [], []
    for q in swept if count < 100 else poses.uniform(*travel, count):
        if slides:
            pose = guide.carriage(travel, q, SLIDES[0])
        else:
            tilt = guide.size[1] * np.sin(np.array([1, 2, 0]) * np.radians(q) + guide.phase[1]) * [1, 1, 0]
            centre = BEARING * guide.size[0] * np.sin(np.array([2, 3, 2]) * np.radians(q) + guide.phase[0])
            pose = motion(rotation(tilt), centre) @ motion(rotation([0, 0, np.radians(q)]), np.zeros(3))
        for name, at in REFLECTORS.items():
            rows.append([q, *((pose @ np.array([*at, 1.0]))[:3] + NOISE_MM * poses.normal(size=3))])
            targets.append(name)
    joint = {"name": "joint", "kind": "prismatic" if slides else "revolute", "axis": SLIDES[0 if slides else 2].tolist(),
             "point_mm": [0, 0, 0], "limits": travel}
    names = ["q1_mm" if slides else "q1_deg", "x_mm", "y_mm", "z_mm"]
    return {
        "format": "truepose-session/1", "name": f"{robot} {seed}",
        "robot": {"name": robot, "joints": [joint],
                  "tool": {"position_mm": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0]}},
        "targets": REFLECTORS, "instrument": {"name": "tracker", "sigma_mm": NOISE_MM},
        "samples": {"columns": {**dict(zip(names, np.transpose(rows).tolist())), "target": targets}},
    }


def run(*command):
    ran = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    return json.loads(ran.stdout) if ran.stdout.startswith("{") else None


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("binary", type=pathlib.Path)
    arguments.add_argument("--count", type=int, default=20)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--robots", default="gantry,rail,slide,table")
    given = arguments.parse_args()
    binary = given.binary.resolve()
    print("robot, poses, hidden: false names / set-up errors / unnamed; unseen over noise: diagnose, identify")
    for robot, count in [("gantry", 60), ("gantry", 200), ("rail", 60), ("rail", 150), ("slide", 31), ("table", 31)]:
        if robot not in given.robots.split(","):
            continue
        every = [set(), {"scale"}, {"bow"}, {"bow", "turns"}, {"scale", "bow", "turns"}]
        make = session if robot in TRAVELS else single
        for hidden in [set(), {"turns"}, {"bow"}, {"bow", "turns"}] if robot == "table" else every:
            false, set_up, unnamed, ratios = 0, 0, 0, []
            for seed in range(given.seed * 1000, given.seed * 1000 + given.count):
                with tempfile.TemporaryDirectory() as folder:
                    path = pathlib.Path(folder)
                    for name, samples, shown in [("session", count, seed + 1), ("unseen", 300, seed + 500)]:
                        text = json.dumps(make(robot, hidden, seed, samples, shown))
                        (path / f"{name}.json").write_text(text)
                    found = run(binary, "diagnose", path / "session.json", "--json", "--out", path / "d.json")
                    run(binary, "identify", path / "session.json", "--json", "--out", path / "i.json")
                    names = [(effect["effect"], effect.get("joint")) for effect in found["found"]]
                    false += any(name != ("joint-scale", 1) or "scale" not in hidden for name in names)
                    problems = [problem["what"] for problem in found["data_problems"]]
                    # The station of every session is unknown.
                    set_up += any("never aligned" not in p and p != "equal steps" for p in problems)
                    unnamed += found["unnamed"] is not None
                    unseen = [run(binary, "verify", path / model, path / "unseen.json", "--json") for model in ["d.json", "i.json"]]
                    ratios.append([
                        one["gap"]["model_mm"] / (np.sqrt(3) * NOISE_MM) if one else np.inf for one in unseen])
            middle, most = np.median(ratios, axis=0), np.max(ratios, axis=0)
            print(
                f"{robot}, {count}, {'+'.join(sorted(hidden)) or 'nothing'}: {false} / {set_up} / {unnamed} of {given.count}; "
                f"{middle[0]:.2f} ({most[0]:.2f}), {middle[1]:.2f} ({most[1]:.2f})", flush=True)


if __name__ == "__main__":
    main()
