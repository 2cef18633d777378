"""Sessions of one hidden effect each, for tests/core/effects_as_data.rs. Run with numpy:

    python3 tests/reference/effects_as_data.py

Written from the equations of the effects alone; shares no code with the program. Writes
tests/data/effects/NAME.json with the samples inline.
"""

import json
import pathlib

import numpy as np

OUT = pathlib.Path(__file__).resolve().parent.parent / "data" / "effects"
G = np.array([0.0, 0.0, -9.81])
SIGMA = 0.02


def turn(axis, angle):
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], float)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


# An upright arm of three joints, home stretched out: base about z, shoulder and elbow about y.
AXES = [
    ("revolute", (0, 0, 1), (0, 0, 0)),
    ("revolute", (0, 1, 0), (0, 0, 400)),
    ("revolute", (0, 1, 0), (450, 0, 400)),
]
TOOL = np.array([850.0, 0.0, 400.0])
TARGETS = {"A": (0.0, 0.0, 0.0), "B": (60.0, 80.0, -40.0), "C": (-50.0, 30.0, 90.0)}
# What hangs on the arm and stands in no file: mass in kg behind joint k, centre at home.
LINKS = [(30.0, (40, 0, 250)), (22.0, (230, 10, 410)), (14.0, (640, -15, 395))]


def moved(joints, theta, x, behind):
    """A point that is carried by so many joints."""
    for (kind, axis, point), q in reversed(list(zip(joints[:behind], theta[:behind]))):
        axis, point = np.array(axis, float), np.array(point, float)
        x = point + turn(axis, q) @ (x - point) if kind == "revolute" else x + axis * q
    return x


def torque(theta, joint, load, links):
    """Gravity's torque about a joint, N m."""
    kind, axis, point = AXES[joint]
    origin = moved(AXES, theta, np.array(point, float), joint)
    along = moved(AXES, theta, np.array(point, float) + axis, joint) - origin
    weights = [(load, moved(AXES, theta, TOOL, 3))]
    weights += [(m, moved(AXES, theta, np.array(c, float), k + 1)) for k, (m, c) in enumerate(links) if k >= joint]
    return sum(along @ np.cross((x - origin) * 1e-3, m * G) for m, x in weights)


def written(name, joints, columns, targets, truth, tool=TOOL):
    robot = {
        "name": name,
        "joints": [
            {"name": f"J{k + 1}", "kind": kind, "axis": list(axis), "point_mm": list(point)}
            for k, (kind, axis, point) in enumerate(joints)
        ],
        "tool": {"position_mm": list(tool), "quaternion_wxyz": [1, 0, 0, 0]},
        "gravity_m_s2": list(G),
    }
    rounded = {
        key: column if isinstance(column[0], str) else [float(f"{v:.5f}") for v in column]
        for key, column in columns.items()
    }
    session = {
        "format": "truepose-session/1",
        "name": name,
        "note": json.dumps(truth),
        "robot": robot,
        "targets": {k: list(v) for k, v in targets.items()},
        "instrument": {"name": "simulated", "sigma_mm": SIGMA},
        "samples": {"columns": rounded},
    }
    text = json.dumps(session, separators=(",", ":"))
    (OUT / f"{name}.json").write_text(text + "\n")


def arm(name, seed, truth, n=150, effect=None, tilt=None, extra=None, load=None):
    """One load where it is stated, else it changes. `effect(q, load, k)` gives the true angles, `tilt(theta, load)` a turn of the whole."""
    rng = np.random.default_rng(seed)
    low, high = np.radians([-150, -80, -110]), np.radians([150, 50, 110])
    q = np.round(np.degrees(rng.uniform(low, high, (n, 3))), 2)
    loads = rng.choice([0.0, 4.0, 9.0], n) if load is None else np.full(n, load)
    names = rng.choice(list(TARGETS), n)
    zeros = np.radians([0.03, -0.05, 0.04])
    points = np.zeros((n, 3))
    for k in range(n):
        command = np.radians(q[k])
        theta = (effect(command, loads[k], k) if effect else command) + zeros
        p = moved(AXES, theta, TOOL + np.array(TARGETS[names[k]]), 3)
        if tilt:
            p = tilt(command, loads[k]) @ p
        points[k] = p + rng.normal(0, SIGMA, 3)
    columns = {f"q{j + 1}_deg": q[:, j] for j in range(3)}
    columns |= {axis + "_mm": points[:, j] for j, axis in enumerate("xyz")}
    columns |= {"target": list(map(str, names)), "load_kg": loads}
    columns |= extra(rng, q, loads) if extra else {}
    written(name, AXES, columns, TARGETS, truth)


def screw():
    """A slide with a turntable on it; the screw has a lead of 16 mm."""
    rng = np.random.default_rng(11)
    joints = [("prismatic", (1, 0, 0), (0, 0, 0)), ("revolute", (0, 0, 1), (300, 0, 0))]
    tool = np.array([480.0, 60.0, 150.0])
    targets = {"A": (0.0, 0.0, 0.0), "B": (40.0, -90.0, 60.0)}
    n, lead, amplitude, phase = 160, 16.0, 0.035, np.radians(70.0)
    q = np.column_stack([rng.uniform(0, 700, n).round(2), rng.uniform(-170, 170, n).round(2)])
    names = rng.choice(list(targets), n)
    points = np.zeros((n, 3))
    for k in range(n):
        slide = q[k, 0] + amplitude * np.sin(2 * np.pi * q[k, 0] / lead + phase) + 0.3
        theta = [slide, np.radians(q[k, 1] + 0.02)]
        p = moved(joints, theta, tool + np.array(targets[names[k]]), 2)
        points[k] = p + rng.normal(0, SIGMA, 3)
    columns = {"q1_mm": q[:, 0], "q2_deg": q[:, 1]}
    columns |= {axis + "_mm": points[:, j] for j, axis in enumerate("xyz")}
    columns |= {"target": list(map(str, names))}
    truth = {"lead_mm": lead, "amplitude_mm": amplitude, "phase_deg": 70.0}
    written("screw-pitch", joints, columns, targets, truth, tool)


def foundation():
    about = np.array([4e-6, 2e-6])

    def tilt(theta, load):
        moment = np.cross(moved(AXES, theta, TOOL, 3) * 1e-3, load * G)
        omega = np.array([about[0] * moment[0], about[1] * moment[1], 0.0])
        angle = np.linalg.norm(omega)
        return turn(omega / angle, angle) if angle > 0 else np.eye(3)

    arm("foundation-compliance", 12, {"about_x_urad_per_nm": 4.0, "about_y_urad_per_nm": 2.0}, tilt=tilt)


def coupling():
    arm(
        "wrist-coupling",
        13,
        {"ratio": 0.0006, "from_joint": 1},
        effect=lambda q, load, k: q + np.array([0, 0, 0.0006 * q[0]]),
    )


def wound_up(q, load, k):
    """Joint 2 winds up by 1.5 µrad per N m under load and links."""
    theta = q.copy()
    for _ in range(20):
        theta[1] = q[1] + 1.5e-6 * torque(np.array([q[0], theta[1], q[2]]), 1, load, LINKS)
    return theta


def wind_up():
    """A sensor shows the torque of the joint that winds up, no file shows the masses."""

    def sensors(rng, q, load):
        shown = [
            [torque(np.radians(q[k]), j, load[k], LINKS) + rng.normal(0, 0.3) for k in range(len(q))]
            for j in range(3)
        ]
        return {f"torque{j + 1}_nm": shown[j] for j in range(3)}

    arm("measured-torque", 14, {"compliance_urad_per_nm": 1.5}, effect=wound_up, extra=sensors)


def sag():
    """The joint winds up under one load; no file shows a mass, no load changes."""
    arm("sag", 16, {"compliance_urad_per_nm": 1.5}, effect=wound_up, load=4.0)


def eccentric():
    """The ring of joint 2 sits off its axis; the axis of joint 1 is upright, so that gravity could do it."""
    amplitude, phase = 0.0006, np.radians(35.0)

    def effect(q, load, k):
        return q + np.array([0, amplitude * np.sin(q[1] + phase), 0])

    arm("eccentric", 17, {"amplitude_mrad": 0.6, "phase_deg": 35.0}, effect=effect, load=4.0)


def warm_joint():
    """Joint 2 has a motor that warms up by itself; the room stays as it is."""
    n, drift = 150, 0.0015
    own = 20 + 18 * (1 - np.exp(-np.arange(n) / 60.0)) * (1 + 0.2 * np.sin(np.arange(n) / 9.0))

    def effect(q, load, k):
        return q + np.radians([0, drift * (own[k] - 20), 0])

    def sensors(rng, q, load):
        room = 21 + 0.5 * np.sin(np.arange(n) / 30.0)
        return {"temperature_c": room, "temperature2_c": own, "time_s": np.arange(n) * 8.0}

    arm("warm-joint", 15, {"deg_per_degc": drift}, n=n, effect=effect, extra=sensors)


OUT.mkdir(parents=True, exist_ok=True)
screw()
foundation()
coupling()
wind_up()
warm_joint()
sag()
eccentric()
