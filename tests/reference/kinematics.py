"""Reference numbers for truepose's kinematics, from implementations that share no code with it.

Robots from screws go through Modern Robotics (Lynch & Park's own package), the URDF ones through
pinocchio, Denavit-Hartenberg tables through the printed matrices in numpy, with Jacobians from
the cross products of the frames' axes. Lengths in mm, angles in rad, except inside pinocchio (m).

    pip install modern_robotics pin numpy
    python tests/reference/kinematics.py

writes tests/reference/kinematics.json. Made with modern-robotics 1.1.1, pin 4.1.0, numpy 2.4.6.
"""

import json
from pathlib import Path

import modern_robotics as mr
import numpy as np
import pinocchio as pin

rng = np.random.default_rng(20240611)
HERE = Path(__file__).parent


def poses(kinds, count=6):
    """Joint values: home, then random ones, and one far outside a turn."""
    scale = np.array([1.0 if kind == "revolute" else 150.0 for kind in kinds])
    values = [np.zeros(len(kinds))]
    values += [rng.uniform(-np.pi, np.pi, len(kinds)) * scale for _ in range(count)]
    values += [rng.uniform(-20, 20, len(kinds)) * scale]
    return values


def case(q, pose, space, body):
    return {
        "q": [float(x) for x in q],
        "base_from_tool": np.asarray(pose).tolist(),
        "space_jacobian": np.asarray(space).tolist(),
        "body_jacobian": np.asarray(body).tolist(),
    }


def from_screws(name, joints, home):
    """Modern Robotics: twists (omega, v) at home in the base frame."""
    columns = []
    for kind, axis, point in joints:
        axis = np.array(axis, float) / np.linalg.norm(axis)
        if kind == "revolute":
            columns.append(np.r_[axis, np.cross(point, axis)])
        else:
            columns.append(np.r_[np.zeros(3), axis])
    screws = np.array(columns).T
    home = np.array(home, float)
    cases = []
    for q in poses([kind for kind, _, _ in joints]):
        pose = mr.FKinSpace(home, screws, q)
        space = mr.JacobianSpace(screws, q)
        body_screws = mr.Adjoint(mr.TransInv(home)) @ screws
        cases.append(case(q, pose, space, mr.JacobianBody(body_screws, q)))
    return {
        "name": name,
        "by": "modern_robotics",
        "joints": [{"kind": k, "axis": list(map(float, a)), "point_mm": list(map(float, p))} for k, a, p in joints],
        "home": home.tolist(),
        "cases": cases,
    }


def dh_matrix(row, q):
    a, alpha, d, theta, convention = row
    c, s = np.cos(theta + q), np.sin(theta + q)
    ca, sa = np.cos(alpha), np.sin(alpha)
    if convention == "standard":
        return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])
    return np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]])


def from_dh(name, rows):
    cases = []
    for q in poses(["revolute"] * len(rows)):
        frame = np.eye(4)
        axes = []
        for row, value in zip(rows, q):
            before = frame
            frame = frame @ dh_matrix(row, value)
            # Standard: z of the frame before the row; modified: z of the frame after it.
            axis_frame = before if row[4] == "standard" else frame
            axes.append((axis_frame[:3, 2], axis_frame[:3, 3]))
        space = np.array([np.r_[z, np.cross(p, z)] for z, p in axes]).T
        rotation, tool = frame[:3, :3], frame[:3, 3]
        body = np.array([np.r_[rotation.T @ z, rotation.T @ np.cross(z, tool - p)] for z, p in axes]).T
        cases.append(case(q, frame, space, body))
    keys = ["a_mm", "alpha_rad", "d_mm", "theta_rad", "convention"]
    return {"name": name, "by": "numpy", "dh": [dict(zip(keys, row)) for row in rows], "cases": cases}


def from_urdf(name, text, base, tip):
    model = pin.buildModelFromXML(text)
    data = model.createData()
    kinds = []
    for joint in model.joints[1:]:
        kinds.append("prismatic" if joint.shortname().startswith("JointModelP") else "revolute")
    metres = np.array([1.0 if kind == "revolute" else 1e-3 for kind in kinds])
    frame = model.getFrameId(tip)
    gravity = np.array([1.0, -2.0, -9.0])
    model.gravity.linear = gravity
    cases = []
    for q in poses(kinds):
        value = q * metres
        configuration = pin.neutral(model)
        for joint, number in zip(model.joints[1:], value):
            # Pinocchio keeps a continuous joint as (cos, sin).
            if joint.nq == 2:
                configuration[joint.idx_q : joint.idx_q + 2] = np.cos(number), np.sin(number)
            else:
                configuration[joint.idx_q] = number
        pin.computeJointJacobians(model, data, configuration)
        pin.updateFramePlacements(model, data)
        pose = data.oMf[frame].homogeneous.copy()
        jacobians = []
        for reference in (pin.WORLD, pin.LOCAL):
            linear_first = pin.getFrameJacobian(model, data, frame, reference)
            linear, angular = linear_first[:3] * 1e3, linear_first[3:]
            jacobians.append(np.vstack([angular, linear]) * metres)
        pose[:3, 3] *= 1e3
        one = case(q, pose, *jacobians)
        # Pinocchio's is the torque that holds the robot; ours is gravity's own.
        one["gravity_torque"] = (-pin.computeGeneralizedGravity(model, data, configuration)).tolist()
        cases.append(one)
    return {
        "name": name,
        "by": "pinocchio",
        "urdf": text,
        "base": base,
        "tip": tip,
        "gravity_m_s2": gravity.tolist(),
        "cases": cases,
    }


def pose_matrix(rotation_vector, position):
    pose = np.eye(4)
    pose[:3, :3] = mr.MatrixExp3(mr.VecToso3(np.array(rotation_vector, float)))
    pose[:3, 3] = position
    return pose


URDF = """<robot name="bench arm">
  <link name="world"/>
  <link name="base"/>
  <link name="l1"><inertial><origin xyz="0.02 -0.01 0.1"/><mass value="7.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="l2"><inertial><origin xyz="0.2 0.03 0" rpy="0.3 0 1"/><mass value="5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="l3"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="l4"><inertial><origin xyz="0 0 0.05"/><mass value="1.25"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="sensor"><inertial><origin xyz="0.01 0 0"/><mass value="0.4"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="tool"/>
  <joint name="stand" type="fixed"><origin xyz="0.3 -0.1 0.75" rpy="0.1 -0.2 2.3"/><parent link="world"/><child link="base"/></joint>
  <joint name="turn" type="continuous"><origin xyz="0 0 0.2" rpy="0 0 0.4"/><parent link="base"/><child link="l1"/><axis xyz="0 0 1"/></joint>
  <joint name="lift" type="revolute"><origin xyz="0.05 0.02 0.3" rpy="1.2 0.3 -0.7"/><parent link="l1"/><child link="l2"/><axis xyz="0 0.6 -0.8"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="reach" type="prismatic"><origin xyz="0.4 0 0.01" rpy="-0.5 1.4 0"/><parent link="l2"/><child link="l3"/><axis xyz="0.6 0 0.8"/><limit lower="-0.1" upper="0.4" effort="1" velocity="1"/></joint>
  <joint name="roll" type="revolute"><origin xyz="0 0 0.1" rpy="3.0 0 0"/><parent link="l3"/><child link="l4"/><axis xyz="1 0 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="bolt" type="fixed"><origin xyz="0.02 0.03 0.04" rpy="0 0.8 0"/><parent link="l4"/><child link="sensor"/></joint>
  <joint name="flange" type="fixed"><origin xyz="0 0.01 0.12" rpy="0 0 1.5"/><parent link="sensor"/><child link="tool"/></joint>
</robot>"""

half = np.pi / 2
robots = [
    # A UR5-like arm (Lynch & Park, example 4.5, lengths in mm).
    from_screws(
        "six joints from screws",
        [
            ("revolute", [0, 0, 1], [0, 0, 0]),
            ("revolute", [0, 1, 0], [0, 0, 89.159]),
            ("revolute", [0, 1, 0], [425, 0, 89.159]),
            ("revolute", [0, 1, 0], [817.25, 0, 89.159]),
            ("revolute", [0, 0, -1], [817.25, 109.15, 0]),
            ("revolute", [0, 1, 0], [817.25, 0, -5.491]),
        ],
        [[-1, 0, 0, 817.25], [0, 0, 1, 191.45], [0, 1, 0, -5.491], [0, 0, 0, 1]],
    ),
    from_screws(
        "skew axes and two slides",
        [
            ("prismatic", [1, 2, -0.5], [10, 20, 30]),
            ("revolute", [0.3, -0.4, 3.0], [100, -50, 20]),
            ("revolute", [-1, 0.2, 0.7], [-300, 80, 400]),
            ("prismatic", [0, 0.5, 0.5], [0, 0, 0]),
            ("revolute", [0.1, 0.9, -0.6], [250, 300, 700]),
        ],
        pose_matrix([0.4, -1.1, 2.0], [500, 420, 830]),
    ),
    # PUMA 560 (Corke's numbers for the standard table, Craig's for the modified one), in mm.
    from_dh(
        "PUMA 560, standard",
        [
            (0.0, half, 0.0, 0.0, "standard"),
            (431.8, 0.0, 0.0, 0.3, "standard"),
            (20.3, -half, 150.05, 0.0, "standard"),
            (0.0, half, 431.8, -0.2, "standard"),
            (0.0, -half, 0.0, 0.0, "standard"),
            (0.0, 0.0, 56.25, 0.0, "standard"),
        ],
    ),
    from_dh(
        "PUMA 560, modified",
        [
            (0.0, 0.0, 660.4, 0.0, "modified"),
            (0.0, -half, 149.09, 0.0, "modified"),
            (431.8, 0.0, 0.0, -half, "modified"),
            (-20.3, -half, 433.07, 0.0, "modified"),
            (0.0, half, 0.0, 0.25, "modified"),
            (0.0, -half, 56.25, 0.0, "modified"),
        ],
    ),
    from_dh(
        "both conventions in one chain",
        [
            (120.0, 0.7, 300.0, 0.1, "standard"),
            (-40.0, 1.9, 15.0, -0.6, "modified"),
            (350.0, -0.4, -60.0, 2.0, "standard"),
        ],
    ),
    from_urdf("URDF with fixed links, a slide and gravity", URDF, "world", "tool"),
]

def lines(robot):
    """A robot as JSON with one case a line, so that a change shows as one."""
    head = json.dumps({key: value for key, value in robot.items() if key != "cases"})
    cases = ",\n  ".join(json.dumps(one) for one in robot["cases"])
    return f'{head[:-1]}, "cases": [\n  {cases}\n]}}'


text = "[" + ",\n".join(lines(robot) for robot in robots) + "]\n"
assert json.loads(text) == robots
(HERE / "kinematics.json").write_text(text)
