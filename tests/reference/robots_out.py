"""Corrected robots: models of arms whose errors are known, where the real tool then is (numpy, from
the equations of the effects, sharing nothing with src/), and what `mujoco`, `yourdfpy` and
`pinocchio` make of the files that the program exported.

    python tests/reference/robots_out.py tests/data/robots [TRUEPOSE]

writes NAME.model.json and out.json (joint values, true positions and orientations of the tool). With
a program to run it exports each model to every description, reads the files back by those packages
and by readers of its own, and writes the largest distance to the truth of each to verdict.json.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

rng = np.random.default_rng(11)
POSES = 100
HALF = np.pi / 2


def turn(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def pose(r=np.eye(3), p=(0, 0, 0)):
    t = np.eye(4)
    t[:3, :3], t[:3, 3] = r, p
    return t


def about_x(a, x):
    return pose(turn([1, 0, 0], a)) @ pose(p=(x, 0, 0))


def about_z(t, d):
    return pose(turn([0, 0, 1], t)) @ pose(p=(0, 0, d))


def row(convention, a, alpha, d, theta, turns, q):
    link = about_x(alpha, a)
    joint = about_z(theta + (q if turns else 0), d + (0 if turns else q))
    return joint @ link if convention == "standard" else link @ joint


def screw_exp(w, v):
    """exp of a screw: rotation and translation."""
    n = np.linalg.norm(w)
    if n == 0:
        return pose(p=v)
    k = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    left = np.eye(3) + (1 - np.cos(n)) / n**2 * k + (n - np.sin(n)) / n**3 * k @ k
    return pose(turn(w, n), left @ v)


def across(axis):
    least = 0
    for k in (1, 2):
        if abs(axis[k]) < abs(axis[least]) - 1e-6:
            least = k
    x = np.eye(3)[least]
    x = x - axis * (x @ axis)
    x /= np.linalg.norm(x)
    return x, np.cross(axis, x)


class Arm:
    """Axes at home, the tool, and the errors."""

    def __init__(self, rows, convention, tool_p, tool_r, errors=1.0):
        self.rows, self.convention = rows, convention
        frame, self.axes = np.eye(4), []
        for a, alpha, d, theta, turns in rows:
            at = frame if convention == "standard" else frame @ about_x(alpha, a)
            self.axes.append((at[:3, 2].copy(), at[:3, 3].copy(), turns))
            frame = frame @ row(convention, a, alpha, d, theta, turns, 0)
        self.home = frame @ pose(tool_r, tool_p)
        n = len(rows)
        self.zeros = np.where([r[4] for r in rows], rng.normal(0, 0.006, n), rng.normal(0, 0.5, n)) * errors
        self.links = rng.normal(0, 1, (n, 4)) * [0.4, 0.4, 0.8e-3, 0.8e-3] * errors
        self.shift = rng.normal(0, 3, 3) * errors
        self.base = rng.normal(0, 0.5, 3) * errors

    def tool(self, q):
        t = np.eye(4)
        for (axis, point, turns), zero, link, value in zip(self.axes, self.zeros, self.links, q):
            x, y = across(axis)
            v = link[0] * x + link[1] * y if turns else np.zeros(3)
            w = link[2] * x + link[3] * y
            to, back = pose(p=point), pose(p=-point)
            t = t @ to @ screw_exp(w, v) @ back
            by = value + zero
            t = t @ (to @ pose(turn(axis, by)) @ back if turns else pose(p=axis * by))
        home = self.home.copy()
        home[:3, 3] += home[:3, :3] @ self.shift
        return pose(p=self.base) @ t @ home

    def model(self, name, names):
        quaternion = quaternion_of(self.home[:3, :3])
        effects = []
        for k, (zero, link) in enumerate(zip(self.zeros, self.links)):
            turns = self.axes[k][2]
            given = {"offset_deg": float(np.degrees(zero))} if turns else {"offset_mm": float(zero)}
            effects.append({"effect": "joint-zero-offset", "joint": k + 1, "parameters": given})
            angles = {"about_x_mrad": link[2] * 1e3, "about_y_mrad": link[3] * 1e3}
            lengths = {"x_mm": link[0], "y_mm": link[1]} if turns else {"x_mm": 0, "y_mm": 0}
            effects.append({"effect": "link-geometry", "joint": k + 1, "parameters": {**lengths, **angles}})
        xyz = lambda v: dict(zip(("x_mm", "y_mm", "z_mm"), map(float, v)))
        effects.append({"effect": "tool-position", "parameters": xyz(self.shift)})
        effects.append({"effect": "base-offset", "parameters": xyz(self.base)})
        joints = [
            {"name": n, "kind": "revolute" if turns else "prismatic", "axis": axis.tolist(), "point_mm": point.tolist(),
             "limits": [-150, 150] if turns else [0, 180]}
            for n, (axis, point, turns) in zip(names, self.axes)
        ]
        source = [
            {"a_mm": a, "alpha_deg": float(np.degrees(alpha)), "d_mm": d, "theta_deg": float(np.degrees(theta)),
             "convention": self.convention, "kind": "revolute" if turns else "prismatic"}
            for a, alpha, d, theta, turns in self.rows
        ]
        wide = [[-2.6, 2.6] if turns else [0, 180] for *_, turns in self.rows]
        return {
            "format": "truepose-model/1", "program_version": "0.1.0", "session": name, "samples_hash": "0" * 64,
            "robot": {"name": name, "joints": joints, "source": {"dh": source},
                      "tool": {"position_mm": self.home[:3, 3].tolist(), "quaternion_wxyz": quaternion}},
            "effects": effects, "covariance": None, "regions": [],
            "measured": [{"from_inner": a, "to_inner": b} for a, b in wide],
            "history": [],
        }


def quaternion_of(r):
    w, v = np.linalg.eigh(np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
        [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
        [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)],
    ]) / 3)
    x, y, z, w = v[:, -1]
    return [float(w), float(x), float(y), float(z)]


R, P = True, False
UR = [(0, HALF, 162.5, 0, R), (-425, 0, 0, 0, R), (-392.2, 0, 0, 0, R), (0, HALF, 133.3, 0, R), (0, -HALF, 99.7, 0, R), (0, 0, 99.6, 0, R)]
WRIST = [(0, 0, 330, 0, R), (50, -HALF, 0, -HALF, R), (330, 0, 0, 0, R), (35, -HALF, 335, 0, R), (0, HALF, 0, 0, R), (0, -HALF, 80, np.pi, R)]
SKEW = [(60, 1.2, 200, 0.3, R), (90, -0.9, 40, -0.4, R), (-70, 1.5, 150, 0.2, P), (40, -1.1, 30, 0.9, R), (20, 0.8, 60, 0, R)]
SO101 = [(30, HALF, 55, 0, R), (110, 0, 0, HALF, R), (135, 0, 0, -HALF, R), (0, HALF, 0, HALF, R), (0, 0, 60, 0, R)]
SO_NAMES = ["shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll"]
tool_r = turn([1, 2, 0.5], 0.7)
ARMS = {
    "ur": (Arm(UR, "standard", (10, 20, 120), tool_r), ["pan", "lift", "elbow", "w1", "w2", "w3"]),
    "wrist": (Arm(WRIST, "modified", (5, 0, 150), np.eye(3)), [f"j{k}" for k in range(1, 7)]),
    "skew": (Arm(SKEW, "standard", (15, -5, 90), tool_r), [f"j{k}" for k in range(1, 6)]),
    "so101": (Arm(SO101, "standard", (0, 0, 40), np.eye(3)), SO_NAMES),
}


def by_mujoco(path, names, q):
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    for name, (value, turns) in zip(names, q):
        data.qpos[model.jnt_qposadr[mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)]] = value if turns else value / 1e3
    mujoco.mj_kinematics(model, data)
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, "tool0")
    return data.site_xpos[site] * 1e3


def by_yourdfpy(path, names, q):
    import yourdfpy

    robot = yourdfpy.URDF.load(str(path), load_meshes=False, build_collision_scene_graph=False)
    robot.update_cfg({n: v if turns else v / 1e3 for n, (v, turns) in zip(names, q)})
    return robot.get_transform("tool0", "base_link")[:3, 3] * 1e3


def by_pinocchio(path, names, q):
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(path))
    data, full = model.createData(), pinocchio.neutral(model)
    for n, (v, turns) in zip(names, q):
        full[model.joints[model.getJointId(n)].idx_q] = v if turns else v / 1e3
    pinocchio.framesForwardKinematics(model, data, full)
    return data.oMf[model.getFrameId("tool0")].translation * 1e3


def by_rows(path, names, q):
    robot = json.loads(path.read_text())
    unit = lambda f: pose(rotation_of(f["quaternion_wxyz"]), f["position_mm"])
    chain = lambda values: unit(robot["base"]) @ np.linalg.multi_dot([np.eye(4), np.eye(4)] + [
        row(r["convention"], r["a_mm"], np.radians(r["alpha_deg"]), r["d_mm"], np.radians(r["theta_deg"]), r["kind"] == "revolute", v)
        for r, v in zip(robot["dh"], values)
    ])
    behind = np.linalg.inv(chain(np.zeros(len(q)))) @ unit(robot["tool"])
    return (chain([v for v, _ in q]) @ behind)[:3, 3]


def rotation_of(q):
    w, x, y, z = np.asarray(q) / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def by_yaml(path, names, q):
    import yaml

    steps = yaml.safe_load(path.read_text())["kinematics"]
    tool = json.loads(Path(str(path) + ".meta.json").read_text())["frames"]["tool"]
    t = np.eye(4)
    for name, (v, _) in zip(("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"), q):
        s = steps[name]
        r = turn([0, 0, 1], s["yaw"]) @ turn([0, 1, 0], s["pitch"]) @ turn([1, 0, 0], s["roll"])
        t = t @ pose(r, np.array([s["x"], s["y"], s["z"]]) * 1e3) @ pose(turn([0, 0, 1], v))
    return (t @ pose(rotation_of(tool["quaternion_wxyz"]), tool["position_mm"]))[:3, 3]


READERS = [
    ("urdf", "urdf", "yourdfpy", by_yourdfpy),
    ("urdf", "urdf", "pinocchio", by_pinocchio),
    ("mjcf", "xml", "mujoco", by_mujoco),
    ("dh", "json", "numpy", by_rows),
    ("ur-kinematics", "yaml", "numpy", by_yaml),
]


def main(folder, program=None):
    folder = Path(folder)
    out, verdict = {}, {}
    for name, (arm, names) in ARMS.items():
        (folder / f"{name}.model.json").write_text(json.dumps(arm.model(name, names), indent=1) + "\n")
        q = np.array([[rng.uniform(-2.6, 2.6) if turns else rng.uniform(0, 180) for *_, turns in arm.rows] for _ in range(POSES)])
        tools = [arm.tool(v) for v in q]
        out[name] = {"q": q.tolist(), "position_mm": [t[:3, 3].tolist() for t in tools], "z": [t[:3, 2].tolist() for t in tools]}
        for to, ending, reader, read in READERS if program else []:
            if to == "ur-kinematics" and name not in ("ur", "wrist"):
                continue
            with tempfile.TemporaryDirectory() as there:
                path = Path(there) / f"out.{ending}"
                command = [program, "export", str(folder / f"{name}.model.json"), "--to", to, "--out", str(path)]
                subprocess.run(command, check=True, capture_output=True)
                turns = [r[4] for r in arm.rows]
                off = [np.linalg.norm(read(path, names, list(zip(v, turns))) - t[:3, 3]) for v, t in zip(q, tools)]
            verdict[f"{name} {to} {reader}"] = {"largest_mm": float(max(off)), "poses": POSES}
    lines = ",\n".join(f'"{k}": {json.dumps(v)}' for k, v in out.items())
    (folder / "out.json").write_text("{" + lines + "}\n")
    if program:
        (folder / "verdict.json").write_text(json.dumps(verdict, indent=1) + "\n")
        for key, value in verdict.items():
            print(f"{key:32} {value['largest_mm']:.3g} mm")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tests/data/robots", *sys.argv[2:3])
