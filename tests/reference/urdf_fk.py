#!/usr/bin/env python3
"""Where independent readers of URDF (yourdfpy and pinocchio, from PyPI) put the tool of a robot.

    python3 urdf_fk.py ROBOT.urdf TIP JOINT,JOINT,… < POSES

reads a pose a line, joint values in rad or m, and prints `reader x y z` in m for each pose and each
reader that is installed, with every digit.
"""

import sys

import numpy

path, tip, names = sys.argv[1], sys.argv[2], sys.argv[3].split(",")
poses = [[float(value) for value in line.split()] for line in sys.stdin if line.strip()]


def by_yourdfpy():
    import yourdfpy

    robot = yourdfpy.URDF.load(path, load_meshes=False, build_collision_scene_graph=False)
    for pose in poses:
        robot.update_cfg(dict(zip(names, pose)))
        yield robot.get_transform(tip, robot.base_link)[:3, 3]


def by_pinocchio():
    import pinocchio

    model = pinocchio.buildModelFromUrdf(path)
    data, frame = model.createData(), model.getFrameId(tip)
    for pose in poses:
        q = pinocchio.neutral(model)
        for name, value in zip(names, pose):
            joint = model.joints[model.getJointId(name)]
            # A joint without ends is held as a point on the circle.
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                [value] if joint.nq == 1 else [numpy.cos(value), numpy.sin(value)]
            )
        pinocchio.framesForwardKinematics(model, data, q)
        yield data.oMf[frame].translation


for name, reader in (("yourdfpy", by_yourdfpy), ("pinocchio", by_pinocchio)):
    try:
        for position in reader():
            print(name, *(repr(float(value)) for value in position))
    except ImportError as missing:
        print(f"{name} is not installed: {missing}", file=sys.stderr)
