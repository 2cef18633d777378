"""A hobby arm calibrated without a tracker: numpy only, sharing nothing with src/.

    python tests/reference/hobby_arm.py make FOLDER [--seed N] [--poses N] [--distances N] [--images N]
    python tests/reference/hobby_arm.py check FOLDER

`make` writes what docs/hobby-arm.md starts from: the nominal arm (five turning joints, about the sizes of
an SO-101), the motor calibration that was active, a session of a ball in cups on the table, a table of
board poses as a camera sees them with the joint values that belong to it, and `hidden.json`, the arm that
was built. `check` drives that arm to poses nobody measured and compares the tool with the URDFs and motor
calibrations that truepose wrote into the folder.

Hidden, one standard deviation each: 1 mm and 5 mrad before every joint, homing of the motors 2.5 degrees,
ball and board 3 mm. Measured: joint values in whole ticks (4096 a turn); the ball sits in its cup to 0.3 mm;
the camera sees the board to 0.2 mm across, 0.6 mm along its view, and 3 mrad.
"""

import argparse
import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

NAMES = ["shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll"]
# Axis, a point on it in mm, limits in degrees; base frame, home: upper arm up, forearm forward.
JOINTS = [
    ((0, 0, 1), (38.8, 0, 62.4), -100, 100),
    ((0, 1, 0), (69.2, 0, 116.6), -90, 90),
    ((0, 1, 0), (97.2, 0, 229.2), -90, 90),
    ((0, 1, 0), (232.1, 0, 234.4), -95, 95),
    ((1, 0, 0), (293.2, 0, 234.4), -150, 150),
]
LOW, HIGH = (np.array([j[k] for j in JOINTS], float) for k in (2, 3))
# Ball and board are off the axis of the last joint: on it they would not show its turn.
TOOL = {"sockets": np.array([391.0, 0, 204.4]), "board": np.array([361.0, 0, 264.4])}
CUPS = {"A": (170, -130, 12), "B": (170, 130, 12), "C": (270, -60, 112), "D": (230, 90, 212)}
CALLIPERS = [("A", "B"), ("C", "D"), ("A", "C"), ("A", "D"), ("B", "C"), ("B", "D")]
SEAT, CALLIPER, CAMERA, CAMERA_TURN = 0.3, 0.05, np.array([0.2, 0.2, 0.6]), 3e-3
TICK = 2 * np.pi / 4096


def turn(axis, angle):
    a = np.asarray(axis, float)
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


def small(v):
    angle = np.linalg.norm(v)
    return np.eye(3) if angle == 0 else turn(np.asarray(v) / angle, angle)


def rotation_vector(m):
    """OpenCV's rvec, any angle below half a turn."""
    w = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / 2
    s, c = np.linalg.norm(w), (np.trace(m) - 1) / 2
    if s > 1e-3 or c > 0:
        return w * (np.arctan2(s, c) / s if s > 1e-12 else 1.0)
    axis = np.sqrt(np.maximum((np.diag(m) - c) / (1 - c), 0))
    k = int(np.argmax(axis))
    axis = (m[k] + m[:, k]) / 2 - c * np.eye(3)[k]
    axis = axis / np.linalg.norm(axis)
    return axis * np.arctan2(axis @ w, c)


class Arm:
    """The arm that was built, or the nominal one where the errors are nothing."""

    def __init__(self, tool, shift=None, tilt=None, tool_shift=np.zeros(3), tool_tilt=np.zeros(3)):
        self.shift = np.zeros((5, 3)) if shift is None else np.asarray(shift)
        self.tilt = np.zeros((5, 3)) if tilt is None else np.asarray(tilt)
        points = np.array([j[1] for j in JOINTS] + [tool], float)
        self.steps = np.diff(np.vstack([[0, 0, 0], points]), axis=0)
        self.tool_shift, self.tool_tilt = np.asarray(tool_shift), small(tool_tilt)

    def pose(self, angles):
        """Place and attitude of the tool, and the places of all joints."""
        at, r, places = np.zeros(3), np.eye(3), []
        for i, (axis, *_) in enumerate(JOINTS):
            at = at + r @ (self.steps[i] + self.shift[i])
            r = r @ small(self.tilt[i]) @ turn(axis, angles[i])
            places.append(at)
        return at + r @ (self.steps[5] + self.tool_shift), r @ self.tool_tilt, np.array(places)

    def points(self, many):
        return np.array([self.pose(q)[0] for q in many])


def reading(calibration, raw):
    """Degrees as LeRobot shows them, from the ticks of the magnets in the servos."""
    out = []
    for name, ticks in zip(NAMES, raw):
        motor = calibration[name]
        present = (round(ticks) - motor["homing_offset"]) % 4096
        middle = (motor["range_min"] + motor["range_max"]) / 2
        out.append((present - middle) * 360 / 4095)
    return np.array(out)


def is_clear(arm, angles):
    """Nothing but the tool near the table, and no joint at its stop."""
    degrees = np.degrees(angles)
    if np.any(degrees < LOW + 5) or np.any(degrees > HIGH - 5):
        return False
    tool, _, places = arm.pose(angles)
    return places[2:, 2].min() > 35 and tool[2] > 5 and np.hypot(*tool[:2]) > 110


def in_range(arm, rng):
    while True:
        angles = np.radians(LOW + (HIGH - LOW) * rng.random(5))
        if is_clear(arm, angles):
            return angles


def reach(arm, rng, goal):
    """A pose with the ball at this place, the hand above it."""
    while True:
        angles = in_range(arm, rng)
        for _ in range(40):
            left = arm.pose(angles)[0] - goal
            if np.abs(left).max() < 1e-9:
                break
            slope = np.array([arm.pose(angles + 1e-6 * e)[0] - goal - left for e in np.eye(5)]).T / 1e-6
            move = -np.linalg.pinv(slope) @ left
            angles = angles + move * min(1.0, 0.3 / np.abs(move).max())
        if np.abs(left).max() < 1e-9 and is_clear(arm, angles):
            return angles


def visible(arm, rng, camera):
    """A pose in which the camera sees the board within 55 degrees of square."""
    at, attitude = camera
    while True:
        angles = in_range(arm, rng)
        place, r, _ = arm.pose(angles)
        seen = attitude.T @ (place - at)
        normal = attitude.T @ r[:, 2]
        if seen[2] > 150 and np.hypot(*seen[:2]) < 0.6 * seen[2] and -normal[2] > np.cos(np.radians(55)):
            return angles


def robot(tool):
    joints = [
        {"name": n, "kind": "revolute", "axis": list(a), "point_mm": list(p), "limits": [lo, hi]}
        for n, (a, p, lo, hi) in zip(NAMES, JOINTS)
    ]
    at_home = {"position_mm": tool.tolist(), "quaternion_wxyz": [1, 0, 0, 0]}
    return {"name": "hobby arm", "joints": joints, "tool": at_home}


def table(path, header, rows):
    text = [",".join(header)]
    text += [",".join(v if isinstance(v, str) else f"{v:.5f}" for v in row) for row in rows]
    path.write_text("\n".join(text) + "\n")


def make(folder, seed, poses, distances, images):
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    hidden = {
        "shift": rng.normal(0, 1.0, (5, 3)),
        "tilt": rng.normal(0, 5e-3, (5, 3)),
        "ball": rng.normal(0, 3.0, 3),
        "board": rng.normal(0, 3.0, 3),
        "board_tilt": rng.normal(0, 0.02, 3),
        # Ticks of each servo's magnet where the joint's real angle is nothing.
        "raw_at_zero": rng.integers(600, 3400, 5) + rng.random(5),
    }
    # Whoever set the middles by eye was off by a few degrees.
    by_eye = rng.normal(0, np.radians(2.5), 5)
    calibration = {}
    for i, name in enumerate(NAMES):
        lo, hi = (int(round(2047 + np.radians(v) / TICK)) for v in (LOW[i], HIGH[i]))
        present_at_zero = (lo + hi) / 2
        offset = int(round(hidden["raw_at_zero"][i] + by_eye[i] / TICK - present_at_zero))
        calibration[name] = {
            "id": i + 1, "drive_mode": 0, "homing_offset": offset, "range_min": lo, "range_max": hi
        }
    calibration["gripper"] = {
        "id": 6, "drive_mode": 0, "homing_offset": -412, "range_min": 2031, "range_max": 3476
    }
    (folder / "calibration.json").write_text(json.dumps(calibration, indent=4) + "\n")
    read = lambda angles: reading(calibration, hidden["raw_at_zero"] + angles / TICK)
    joints = [f"q{i + 1}_deg" for i in range(5)]

    arm = Arm(TOOL["sockets"], hidden["shift"], hidden["tilt"], hidden["ball"])
    rows = []
    for k in range(poses):
        name = list(CUPS)[k % len(CUPS)]
        angles = reach(arm, rng, np.array(CUPS[name]) + rng.normal(0, SEAT, 3))
        rows.append([*read(angles), name])
    table(folder / "sockets.csv", joints + ["socket"], rows)
    far = lambda a, b: float(np.linalg.norm(np.subtract(CUPS[a], CUPS[b])))
    session = {
        "format": "truepose-session/1",
        "name": "hobby arm, ball in cups",
        "robot": robot(TOOL["sockets"]),
        "instrument": {"name": "ball in printed cups", "sigma_mm": SEAT},
        "sockets": {name: {"position_mm": None} for name in CUPS},
        "socket_distances_mm": [
            [a, b, round(far(a, b) + rng.normal(0, CALLIPER), 2)] for a, b in CALLIPERS[:distances]
        ],
        "samples": {"file": "sockets.csv"},
    }
    (folder / "sockets.json").write_text(json.dumps(session, indent=1) + "\n")

    arm = Arm(TOOL["board"], hidden["shift"], hidden["tilt"], hidden["board"], hidden["board_tilt"])
    (folder / "arm-with-board.json").write_text(json.dumps(robot(TOOL["board"]), indent=1) + "\n")
    # A camera on a stand, above the table and looking down at it.
    z = np.array([-0.15, -0.1, -1.0])
    z /= np.linalg.norm(z)
    x = np.cross([0, 1.0, 0], z)
    x /= np.linalg.norm(x)
    camera = np.array([290.0, 40, 800]), np.stack([x, np.cross(z, x), z], 1)
    commands, seen = [], []
    for k in range(images):
        angles = visible(arm, rng, camera)
        place, r, _ = arm.pose(angles)
        tvec = camera[1].T @ (place - camera[0]) + rng.normal(0, 1, 3) * CAMERA
        rvec = rotation_vector(small(rng.normal(0, CAMERA_TURN, 3)) @ camera[1].T @ r)
        image = f"{k + 1:03}.png"
        commands.append([image, *read(angles)])
        seen.append([image, *rvec, *tvec])
    table(folder / "joints.csv", ["name", *joints], commands)
    header = [f"{k}vec_{c}" for k in "rt" for c in "xyz"]
    table(folder / "camera.csv", ["image", *[h + ("_mm" if h[0] == "t" else "") for h in header]], seen)
    keep = {k: np.asarray(v).tolist() for k, v in hidden.items()}
    (folder / "hidden.json").write_text(json.dumps(keep | {"seed": seed}, indent=1) + "\n")


class Urdf:
    """Forward kinematics of a URDF, from its base to the end of its chain, in mm."""

    def __init__(self, path):
        root = ET.parse(path).getroot()
        after = {j.find("parent").get("link"): j for j in root.iter("joint")}
        children = {j.find("child").get("link") for j in root.iter("joint")}
        link = next(name for name in after if name not in children)
        self.chain = []
        while link in after:
            j = after[link]
            origin = j.find("origin")
            get = lambda key: [float(v) for v in (origin.get(key) or "0 0 0").split()]
            xyz, (a, b, c) = (get("xyz"), get("rpy")) if origin is not None else ([0] * 3, [0] * 3)
            r = turn((0, 0, 1), c) @ turn((0, 1, 0), b) @ turn((1, 0, 0), a)
            axis = [float(v) for v in j.find("axis").get("xyz").split()] if j.get("type") != "fixed" else None
            self.chain.append((j.get("name"), np.array(xyz) * 1000, r, axis))
            link = j.find("child").get("link")

    def point(self, degrees):
        at, r = np.zeros(3), np.eye(3)
        for name, xyz, own, axis in self.chain:
            at, r = at + r @ xyz, r @ own
            if axis is not None:
                r = r @ turn(axis, np.radians(degrees[NAMES.index(name)]))
        return at


def laid_upon(a, b):
    """a after the rigid motion that brings it closest to b: where the base stands nobody measured."""
    ca, cb = a.mean(0), b.mean(0)
    u, _, vt = np.linalg.svd((b - cb).T @ (a - ca))
    return (a - ca) @ (u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt).T + cb


def says(title, points, true):
    e = np.linalg.norm(laid_upon(points, true) - true, axis=1)
    print(f"{title:46} {np.sqrt((e**2).mean()):7.2f} {np.percentile(e, 95):7.2f} {e.max():7.2f}")


def check(folder):
    hidden = json.loads((folder / "hidden.json").read_text())
    before = json.loads((folder / "calibration.json").read_text())
    rng = np.random.default_rng(hidden["seed"] + 10_000)
    raw = np.array(hidden["raw_at_zero"])
    print(f"{'position error of the tool, mm, 500 new poses':46} {'RMS':>7} {'95 %':>7} {'largest':>7}")
    for kind, tool in TOOL.items():
        place = hidden["ball" if kind == "sockets" else "board"]
        arm = Arm(tool, hidden["shift"], hidden["tilt"], place)
        poses = [in_range(arm, rng) for _ in range(500)]
        true = arm.points(poses)
        ticks = [raw + q / TICK for q in poses]
        shown = [reading(before, t) for t in ticks]
        says(f"{kind}: nominal robot, old calibration", Arm(tool).points(np.radians(shown)), true)
        found = {}
        for title, urdf, motors in [
            ("new URDF, old calibration", f"{kind}.urdf", "calibration.json"),
            ("new calibration and its URDF", f"{kind}-motors.json.urdf", f"{kind}-motors.json"),
            ("new calibration, wrong URDF", f"{kind}.urdf", f"{kind}-motors.json"),
        ]:
            if not ((folder / urdf).exists() and (folder / motors).exists()):
                continue
            calibration = json.loads((folder / motors).read_text())
            chain = Urdf(folder / urdf)
            found[title] = np.array([chain.point(reading(calibration, t)) for t in ticks])
            says(f"{kind}: {title}", found[title], true)
        pairs = list(found.values())
        if len(pairs) == 3:
            low = true[:, 2] < 200
            says(f"{kind}: the second pair, tool below 200 mm ({low.sum()})", pairs[1][low], true[low])
            apart = np.linalg.norm(pairs[0] - pairs[1], axis=1).max()
            print(f"{kind}: the two pairs differ by at most {apart:.3f} mm")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["make", "check"])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--poses", type=int, default=60, help="poses of the ball in cups")
    parser.add_argument("--distances", type=int, default=6, help="distances between cups that are known")
    parser.add_argument("--images", type=int, default=40, help="images of the board")
    given = parser.parse_args()
    if given.what == "make":
        make(given.folder, given.seed, given.poses, given.distances, given.images)
    else:
        check(given.folder)


if __name__ == "__main__":
    main()
