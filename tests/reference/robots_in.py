"""Where other programs put the tool of a robot that MJCF or URDF describes: `mujoco`, `yourdfpy` and
`pinocchio` (PyPI), on models made here that use every way the formats have to say a thing.

    python tests/reference/robots_in.py tests/data/robots/in.json

writes the models as text with base, tip, joints, and poses of the tip in the base at random joint
values: position in mm and rotation as a matrix. Models are random but seeded; `include.xml` and what
it includes lie beside the answer as files.
"""

import json
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import yourdfpy

rng = np.random.default_rng(20261122)
POSES = 8


def numbers(values):
    return " ".join(repr(float(v)) for v in values)


def orientation(degrees):
    """One of the ways to say an orientation."""
    angle = (lambda: rng.uniform(-170, 170)) if degrees else (lambda: rng.uniform(-3, 3))
    kind = rng.integers(0, 6)
    vector = lambda: rng.normal(size=3)
    return [
        "",
        f' quat="{numbers(rng.normal(size=4))}"',
        f' axisangle="{numbers([*vector(), angle()])}"',
        f' euler="{numbers([angle(), angle(), angle()])}"',
        f' xyaxes="{numbers([*vector(), *vector()])}"',
        f' zaxis="{numbers(vector())}"',
    ][kind]


def place(degrees):
    return f'pos="{numbers(rng.uniform(-0.4, 0.4, 3))}"{orientation(degrees)}'


def joint(name, degrees, classes):
    kind = rng.choice(["hinge", "slide", "class", "plain"])
    reach = 120.0 if degrees else 2.0
    ref = f' ref="{rng.uniform(-0.3, 0.3) * (40 if degrees else 1):.3f}"' if rng.random() < 0.5 else ""
    pos = f' pos="{numbers(rng.uniform(-0.1, 0.1, 3))}"' if rng.random() < 0.6 else ""
    axis = f' axis="{numbers(rng.normal(size=3))}"'
    if kind == "class":
        return f'<joint name="{name}" class="{rng.choice(classes)}"{pos}/>'
    if kind == "plain":
        return f'<joint name="{name}"{pos}/>'
    if kind == "slide":
        return f'<joint name="{name}" type="slide"{axis} range="-0.2 0.3"{pos}{ref.replace("ref", "ref") if not degrees else ""}/>'
    return f'<joint name="{name}" type="hinge"{axis} range="{-reach} {reach}"{pos}{ref}/>'


def random_mjcf(number):
    degrees = bool(number % 2)
    sequences = ["xyz", "zyx", "XYZ", "ZYX", "zxz", "XyZ", "yzy"]
    compiler = f'<compiler eulerseq="{sequences[number % len(sequences)]}"'
    compiler += ' boundmass="1e-3" boundinertia="1e-3"'
    compiler += "/>" if degrees else ' angle="radian"/>'
    reach = 90 if degrees else 1.5
    defaults = f"""<default><joint axis="{numbers(rng.normal(size=3))}"/><site pos="0.01 0.02 0.03"/>
    <default class="one"><joint range="{-reach} {reach}" pos="0.02 0 0.01"/>
      <default class="two"><joint type="slide" axis="{numbers(rng.normal(size=3))}" range="-0.1 0.4"/>
        <site {place(degrees)}/></default></default></default>"""
    count = 0
    lines, close = [], []
    for depth in range(int(rng.integers(3, 6))):
        childclass = ' childclass="one"' if rng.random() < 0.4 else ""
        if rng.random() < 0.4:
            lines.append(f"<frame {place(degrees)}>")
            close.append("</frame>")
        lines.append(f'<body name="b{depth}" {place(degrees)}{childclass}>')
        close.append("</body>")
        for _ in range(int(rng.integers(0, 3)) if depth else 1):
            count += 1
            in_frame = rng.random() < 0.25
            if in_frame:
                lines.append(f"<frame {place(degrees)}>")
            lines.append(joint(f"j{count}", degrees, ["one", "two"]))
            if in_frame:
                lines.append("</frame>")
        lines.append(f'<body name="side{depth}"><joint name="s{depth}"/></body>')
    site_class = ' class="two"' if rng.random() < 0.5 else ""
    own = place(degrees) if rng.random() < 0.7 else ""
    lines.append(f'<site name="tip"{site_class} {own}/>')
    text = f'<mujoco model="random {number}">{compiler}{defaults}<worldbody>\n'
    text += "\n".join(lines) + "\n" + "".join(reversed(close)) + "</worldbody></mujoco>"
    return text, "world" if number % 3 else "b0", "tip"


def mujoco_case(text, base, tip, folder=None):
    if folder:
        model = mujoco.MjModel.from_xml_path(str(folder))
    else:
        model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, tip)
    if site >= 0:
        body = model.site_bodyid[site]
        at_tip = lambda: (data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy())
    else:
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, tip)
        at_tip = lambda: (data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy())
    base_id = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, base)
    bodies, at = [], body
    while at != base_id:
        bodies.insert(0, at)
        at = model.body_parentid[at]
    joints = [j for b in bodies for j in range(model.body_jntadr[b], model.body_jntadr[b] + model.body_jntnum[b])]
    case = {"joints": [], "poses": []}
    for j in joints:
        hinge = model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE
        outer = (lambda v: float(np.degrees(v))) if hinge else (lambda v: float(v * 1e3))
        limits = [outer(v) for v in model.jnt_range[j]] if model.jnt_limited[j] else None
        case["joints"].append(
            {"name": model.joint(j).name, "kind": "revolute" if hinge else "prismatic", "limits": limits}
        )
    for _ in range(POSES):
        data.qpos[:] = rng.uniform(-2, 2, model.nq)
        q = []
        for j in joints:
            slide = model.jnt_type[j] == mujoco.mjtJoint.mjJNT_SLIDE
            value = rng.uniform(-0.3, 0.3) if slide else rng.uniform(-3, 3)
            data.qpos[model.jnt_qposadr[j]] = value
            q.append(float(value * 1e3) if slide else float(value))
        mujoco.mj_kinematics(model, data)
        p, r = at_tip()
        bp, br = data.xpos[base_id], data.xmat[base_id].reshape(3, 3)
        case["poses"].append(
            {"q": q, "position_mm": (br.T @ (p - bp) * 1e3).tolist(), "rotation": (br.T @ r).tolist()}
        )
    return case


def random_urdf(number):
    links, joints = ["torso"], []
    for side in ("left", "right"):
        parent = "torso"
        for k in range(int(rng.integers(3, 7))):
            child = f"{side}_{k}"
            kind = rng.choice(["revolute", "continuous", "prismatic", "fixed"], p=[0.5, 0.2, 0.2, 0.1])
            if k == 0:
                kind = "revolute"
            origin = f'<origin xyz="{numbers(rng.uniform(-0.4, 0.4, 3))}" rpy="{numbers(rng.uniform(-3, 3, 3))}"/>'
            axis = "" if rng.random() < 0.2 else f'<axis xyz="{numbers(unit(rng.normal(size=3)))}"/>'
            limit = '<limit lower="-1.5" upper="2" effort="1" velocity="1"/>' if kind in ("revolute", "prismatic") else ""
            joints.append(
                f'<joint name="{side} {k}" type="{kind}">{origin}<parent link="{parent}"/><child link="{child}"/>{axis}{limit}</joint>'
            )
            links.append(child)
            parent = child
    text = f'<robot name="two arms {number}">\n' + "".join(f'<link name="{l}"/>' for l in links)
    return text + "\n" + "\n".join(joints) + "</robot>", "torso", links[-1] if number % 2 else f"left_{sum(l.startswith('left') for l in links) - 1}"


def unit(v):
    return v / np.linalg.norm(v)


def urdf_case(text, base, tip):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "r.urdf"
        path.write_text(text)
        robot = yourdfpy.URDF.load(str(path), load_meshes=False, build_collision_scene_graph=False)
        model = pinocchio.buildModelFromUrdf(str(path))
    data, frame = model.createData(), model.getFrameId(tip)
    side = tip.split("_")[0]
    chain = [j for j in robot.robot.joints if j.name.startswith(side) and j.type != "fixed"]
    case = {"joints": [], "poses": []}
    for j in chain:
        slide = j.type == "prismatic"
        outer = (lambda v: v * 1e3) if slide else np.degrees
        limits = None if j.type == "continuous" else [float(outer(j.limit.lower)), float(outer(j.limit.upper))]
        case["joints"].append({"name": j.name, "kind": "prismatic" if slide else "revolute", "limits": limits})
    for _ in range(POSES):
        q = [float(rng.uniform(-2, 2)) for _ in chain]
        robot.update_cfg({j.name: v for j, v in zip(chain, q)})
        t = robot.get_transform(tip, base)
        full = pinocchio.neutral(model)
        for j, v in zip(chain, q):
            part = model.joints[model.getJointId(j.name)]
            full[part.idx_q : part.idx_q + part.nq] = [v] if part.nq == 1 else [np.cos(v), np.sin(v)]
        pinocchio.framesForwardKinematics(model, data, full)
        other = data.oMf[frame].homogeneous
        assert np.abs(other - t).max() < 1e-9, (other, t)
        inner = [v * 1e3 if j.type == "prismatic" else v for j, v in zip(chain, q)]
        case["poses"].append({"q": inner, "position_mm": (t[:3, 3] * 1e3).tolist(), "rotation": t[:3, :3].tolist()})
    return case


INCLUDING = """<mujoco model="including">
  <include file="parts/settings.xml"/>
  <worldbody>
    <body name="column" pos="0 0 0.4">
      <joint name="pan" range="-90 90"/>
      <include file="parts/arm.xml"/>
    </body>
  </worldbody>
</mujoco>
"""
SETTINGS = """<mujocoinclude>
  <compiler eulerseq="zyx" boundmass="1e-3" boundinertia="1e-3"/>
  <default><joint axis="0 0.6 0.8"/></default>
</mujocoinclude>
"""
ARM = """<mujocoinclude>
  <body name="arm" pos="0.2 0 0.1" euler="30 -20 10">
    <joint name="lift" ref="15"/>
    <site name="tip" pos="0.3 0.1 0" zaxis="1 1 1"/>
  </body>
</mujocoinclude>
"""


def main(path):
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    cases = []
    for number in range(24):
        text, base, tip = random_mjcf(number)
        cases.append({"format": "mjcf", "text": text, "base": base, "tip": tip, **mujoco_case(text, base, tip)})
    for number in range(8):
        text, base, tip = random_urdf(number)
        cases.append({"format": "urdf", "text": text, "base": base, "tip": tip, **urdf_case(text, base, tip)})
    folder = path.parent
    (folder / "parts").mkdir(exist_ok=True)
    (folder / "including.xml").write_text(INCLUDING)
    (folder / "parts/settings.xml").write_text(SETTINGS)
    (folder / "parts/arm.xml").write_text(ARM)
    including = folder / "including.xml"
    cases.append({"format": "mjcf", "file": including.name, "base": "world", "tip": "tip", **mujoco_case("", "world", "tip", including)})
    path.write_text("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n")
    print(len(cases), "models;", "mujoco", mujoco.__version__, "yourdfpy and pinocchio", pinocchio.__version__)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tests/data/robots/in.json")
