"""An arm with hidden errors, measured without noise, and targets for it in five languages: numpy and
scipy, written from the equations that `truepose effects` prints and sharing nothing with src/.

    python tests/reference/programs.py tests/data/programs

writes the session of a six-joint arm with spherical wrist (geometry of every joint but the first, which
is the frame's; zero offsets; joints 2 and 3 that wind up under the load; a tool that sits elsewhere), the same for a positioner with two axes; targets as tables of joint values and of poses, as RAPID, KRL, URScript
and FANUC LS; and `hidden.json`: the robots by their matrices, the targets' joint values, and for the
positioner how near to each target its joints can bring the tool at all (scipy's least squares).
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

G = np.array([0, 0, -9.81])
LIMITS = [(-165, 165), (-110, 110), (-110, 70), (-160, 160), (-120, 120), (-400, 400)]
SIX = [
    ((0, 0, 1), (0, 0, 0)),
    ((0, 1, 0), (0, 0, 290)),
    ((0, 1, 0), (0, 0, 560)),
    ((1, 0, 0), (0, 0, 630)),
    ((0, 1, 0), (302, 0, 630)),
    ((1, 0, 0), (302, 0, 630)),
]
TOOL = np.array(
    [[0, 0, 1, 414.0], [0, 1, 0, 12.0], [-1, 0, 0, 655.0], [0, 0, 0, 1.0]]
)  # tool z along the arm
TARGETS = {"T1": (40.0, 0.0, 20.0), "T2": (-30.0, 50.0, -10.0), "T3": (-20.0, -45.0, 35.0)}
TABLE = [
    ("revolute", (0, 1, 0), (0, 0, 500), (-80, 80)),
    ("revolute", (0, 0, 1), (0, 0, 620), (-175, 175)),
]


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def rotation(vector):
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    k = skew(np.asarray(vector) / angle)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def motion(kind, axis, point, value):
    out = np.eye(4)
    if kind == "prismatic":
        out[:3, 3] = np.asarray(axis) * value
    else:
        out[:3, :3] = rotation(np.asarray(axis, float) * value)
        out[:3, 3] = np.asarray(point) - out[:3, :3] @ np.asarray(point)
    return out


def small(turn, shift, about):
    """A small rigid motion, the turn about a point."""
    out = np.eye(4)
    out[:3, :3] = rotation(turn)
    out[:3, 3] = np.asarray(about) - out[:3, :3] @ np.asarray(about) + shift
    return out


class Robot:
    """links[i] stands before joint i, zeros are added to the commands, tool is the pose at home."""

    def __init__(self, joints, tool):
        self.joints = joints
        self.links = [np.eye(4) for _ in joints]
        self.zeros = np.zeros(len(joints))
        self.compliance = np.zeros(len(joints))
        self.nominal_tool = tool.copy()
        self.tool = tool.copy()

    def torque(self, i, angle, q, load):
        """Gravity's torque of the load about joint i, which stands at `angle`, the others at q."""
        at = np.append(self.nominal_tool[:3, 3], 1)
        for k in reversed(range(i + 1, len(q))):
            at = motion(*self.joints[k], q[k]) @ at
        axis, point = np.asarray(self.joints[i][1], float), np.asarray(self.joints[i][2], float)
        gravity = G
        for k in range(i):
            if self.joints[k][0] == "revolute":
                gravity = rotation(np.asarray(self.joints[k][1]) * -q[k]) @ gravity
        arm = rotation(axis * angle) @ (at[:3] - point) * 1e-3
        return load * axis @ np.cross(arm, gravity)

    def angles(self, q, load):
        out = q + self.zeros
        for i in np.nonzero(self.compliance)[0]:
            angle = out[i]
            for _ in range(20):
                angle = out[i] + self.compliance[i] * self.torque(i, angle, q, load)
            out[i] = angle
        return out

    def pose(self, q, load=0.0):
        out = np.eye(4)
        for link, joint, value in zip(self.links, self.joints, self.angles(np.asarray(q), load)):
            out = out @ link @ motion(*joint, value)
        return out @ self.tool


def quaternion(r):
    w = np.sqrt(max(0, 1 + np.trace(r))) / 2
    if w > 0.1:
        v = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / (4 * w)
        return np.r_[w, v]
    k = int(np.argmax(np.diag(r)))
    i, j = (k + 1) % 3, (k + 2) % 3
    out = np.zeros(4)
    s = 2 * np.sqrt(1 + r[k, k] - r[i, i] - r[j, j])
    out[1 + k] = s / 4
    out[0] = (r[j, i] - r[i, j]) / s
    out[1 + i] = (r[i, k] + r[k, i]) / s
    out[1 + j] = (r[j, k] + r[k, j]) / s
    return out


def zyx(r):
    """a about z, b about y, c about x, degrees."""
    b = np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0]))
    return np.degrees([np.arctan2(r[1, 0], r[0, 0]), b, np.arctan2(r[2, 1], r[2, 2])])


def rotation_vector(r):
    q = quaternion(r)
    angle = 2 * np.arctan2(np.linalg.norm(q[1:]), q[0])
    return q[1:] / max(np.linalg.norm(q[1:]), 1e-300) * angle


def six():
    joints = [("revolute", a, p) for a, p in SIX]
    nominal, real = Robot(joints, TOOL), Robot(joints, TOOL)
    rng = np.random.default_rng(20)
    for i in range(1, 6):
        a = np.asarray(joints[i][1], float)
        turn, shift = rng.normal(0, 0.8e-3, 3), rng.normal(0, 0.4, 3)
        # Along the axis a turn is the zero's and a shift nobody's.
        turn -= a * (a @ turn)
        shift -= a * (a @ shift)
        if i == 1:
            # About and along the first axis an error is the frame's.
            turn[2] = shift[2] = 0
        real.links[i] = small(turn, shift, joints[i][2])
        # About the last axis it is the tool's.
        real.zeros[i] = np.radians(rng.normal(0, 0.15)) if i < 5 else 0
    real.compliance[1], real.compliance[2] = 9e-6, 14e-6
    tool = np.eye(4)
    tool[:3, 3] = [1.2, -0.8, 0.9]
    real.tool = TOOL @ tool
    return nominal, real


def positioner():
    joints = [j[:3] for j in TABLE]
    tool = np.eye(4)
    tool[:3, 3] = [180, 40, 640]
    nominal, real = Robot(joints, tool), Robot(joints, tool)
    # The second axis is skew and stands beside the first one's; the rest would be the frame's.
    real.links[1] = small([1.5e-3, 0, 0], [0.3, 0, 0], joints[1][2])
    real.tool[:3, 3] += [0.4, -0.2, 0.5]
    return nominal, real


def number(value, decimals):
    return f"{value:.{decimals}f}"


def session(folder, name, nominal, real, limits, count, loads, seed):
    rng = np.random.default_rng(seed)
    low, high = np.array(limits, float).T
    outer = [1 if j[0] == "prismatic" else np.pi / 180 for j in nominal.joints]
    units = ["mm" if j[0] == "prismatic" else "deg" for j in nominal.joints]
    heading = [f"q{i + 1}_{u}" for i, u in enumerate(units)] + ["load_kg", "target", "x_mm", "y_mm", "z_mm"]
    rows = [",".join(heading)]
    for k in range(count):
        shown = np.round(rng.uniform(low, high), 3)
        load = loads[k % len(loads)]
        pose = real.pose(shown * outer, load)
        target = list(TARGETS)[k % 3]
        at = (pose @ np.append(TARGETS[target], 1))[:3]
        rows.append(",".join([*(number(v, 3) for v in shown), str(load), target, *(number(v, 7) for v in at)]))
    (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")
    joints = [
        {"name": f"A{i + 1}", "kind": k, "axis": a, "point_mm": p, "limits": list(limits[i])}
        for i, (k, a, p) in enumerate(nominal.joints)
    ]
    tool = nominal.nominal_tool
    document = {
        "format": "truepose-session/1",
        "name": name,
        "note": "simulated by tests/reference/programs.py, without noise",
        "robot": {
            "name": name,
            "joints": joints,
            "tool": {"position_mm": tool[:3, 3].tolist(), "quaternion_wxyz": quaternion(tool[:3, :3]).tolist()},
            "gravity_m_s2": G.tolist(),
        },
        "targets": TARGETS,
        "instrument": {"name": "tracker", "sigma_mm": 0.001},
        "samples": {"file": f"{name}.csv"},
    }
    (folder / f"{name}.json").write_text(json.dumps(document) + "\n")


def quadrant(degrees):
    return int(np.floor(degrees / 90))


def rapid(poses, shown, behind):
    lines = ["MODULE Cell", "  ! robtarget in a comment: [[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"]
    nine = "[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]"
    for k, (pose, q) in enumerate(zip(poses, shown)):
        if k % 2:
            axes = ",".join(number(v, 3) for v in q)
            lines.append(f"  CONST jointtarget j{k}:=[[{axes}],{nine}];")
        else:
            at = ",".join(number(v, 3) for v in pose[:3, 3])
            turn = ",".join(number(v, 7) for v in quaternion(pose[:3, :3]))
            cfx = int(q[4] < 0) + 4 * int(behind[k])
            cf = f"[{quadrant(q[0])},{quadrant(q[3])},{quadrant(q[5])},{cfx}]"
            lines.append(f"  CONST robtarget p{k}:=[[{at}],[{turn}],{cf},{nine}];")
    lines.append("  PROC main()")
    for k in range(len(shown)):
        lines.append(f"    MoveAbsJ j{k}\\NoEOffs, v500, fine, tGun;" if k % 2 else f"    MoveJ p{k}, v500, fine, tGun;")
    lines += ["    MoveL Offs(p0,0,0,50), v100, fine, tGun;", "    TPWrite \"p0:=[[0,0,0],[1,0,0,0]]\";", "  ENDPROC", "ENDMODULE"]
    return "\r\n".join(lines) + "\r\n"


def krl(poses, shown, behind):
    lines = ["&ACCESS RVP", "DEF cell( )", ";FOLD PTP XP0 {X 1,Y 2}", "DECL E6POS XP0"]
    for k, (pose, q) in enumerate(zip(poses, shown)):
        axes = ",".join(f"A{i + 1} {number(v, 4)}" for i, v in enumerate(q))
        if k % 2:
            lines.append(f"PTP {{E6AXIS: {axes},E1 0.0}} C_PTP")
            continue
        at = dict(zip("XYZ", pose[:3, 3])) | dict(zip("ABC", zyx(pose[:3, :3])))
        turn = sum(1 << i for i, v in enumerate(q) if v < 0)
        body = ",".join(f"{key} {number(v, 4)}" for key, v in at.items())
        turn = f"'B{turn:06b}'" if k % 4 else str(turn)
        lines.append(f"XP{k}={{{body},S {int(behind[k])},T {turn}}}")
        lines.append(f"PTP XP{k}")
    lines += ["LIN_REL {X 10}", "PTP $AXIS_ACT", "END"]
    return "\n".join(lines) + "\n"


def urscript(poses, shown):
    lines = ["def cell():", "  # movej([0,0,0,0,0,0])"]
    for k, (pose, q) in enumerate(zip(poses, shown)):
        rad = ", ".join(number(v, 6) for v in np.radians(q))
        if k % 2:
            lines.append(f"  movej([{rad}], a=1.4, v=1.05)")
            continue
        body = ", ".join(number(v, 6) for v in np.r_[pose[:3, 3] / 1000, rotation_vector(pose[:3, :3])])
        if k % 4:
            lines.append(f"  movej(get_inverse_kin(p[{body}], qnear=[{rad}]), a=1.4)")
        else:
            lines += [f"  global q{k} = [{rad}]", f"  movej(q{k})", f"  movel(p[{body}], a=1.2, v=0.25)"]
    lines += ["  movel(pose_trans(get_actual_tcp_pose(), p[0,0,0.1,0,0,0]))", "end"]
    return "\n".join(lines) + "\n"


# The world of a FANUC begins on axis 1 at the height of axis 2.
WORLD = np.array([0.0, 0, 290])


def fanuc(poses, shown, behind):
    moves, positions = [], []
    for k, (pose, q) in enumerate(zip(poses, shown)):
        moves.append(f"{k + 1:4d}:J P[{k + 1}] 100% FINE    ;")
        if k % 2:
            cells = [f"J{i + 1}= {v:9.3f} deg" for i, v in enumerate(q)]
            body = "\tUF : 0, UT : 1,\t\n\t" + ",\t".join(cells[:3]) + ",\n\t" + ",\t".join(cells[3:])
        else:
            c, b, a = zyx(pose[:3, :3])[::-1]
            turns = ", ".join(str(int(np.round(q[i] / 360))) for i in (0, 3, 5))
            letters = f"{'N' if q[4] < 0 else 'F'} U {'B' if behind[k] else 'T'}"
            at = [f"{n} = {v:9.3f}  mm" for n, v in zip("XYZ", pose[:3, 3] - WORLD)]
            turn = [f"{n} = {v:9.4f} deg" for n, v in zip("WPR", (c, b, a))]
            body = f"\tUF : 0, UT : 1,\t\tCONFIG : '{letters}, {turns}',\n\t" + ",\t".join(at) + ",\n\t" + ",\t".join(turn)
        name = ':"home \xe9"' if k == 1 else ""
        positions.append(f"P[{k + 1}{name}]{{\n   GP1:\n{body}\n}};")
    head = ["/PROG  CELL", "/ATTR", "COMMENT\t\t= \"P[1]{\";", "DEFAULT_GROUP\t= 1,*,*,*,*;", "/MN"]
    moves.append(f"{len(moves) + 1:4d}:L PR[1] 100mm/sec FINE    ;")
    return "\n".join([*head, *moves, "/POS", *positions, "/END"]) + "\n"


def floors(nominal, real, targets):
    """How near the joints can bring the real tool to where the nominal one would be."""
    out = []
    for q in targets:
        wanted = nominal.pose(q)[:3, 3]
        best = least_squares(
            lambda u: real.pose(u)[:3, 3] - wanted, q, xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        out.append(float(np.linalg.norm(best.fun)))
    return out


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    nominal, real = six()
    session(folder, "arm", nominal, real, LIMITS, 150, [0, 2.5, 5], 3)
    rng = np.random.default_rng(7)
    shown, behind = [], []
    while len(shown) < 16:
        q = np.round(rng.uniform(*np.array(LIMITS, float).T), 3)
        q[5] = np.round(rng.uniform(-170, 170), 3)
        # Away from singular poses, from limits, and with the elbow as at home.
        still = np.radians(np.r_[0, q[1:]])
        wrist = (motion(*nominal.joints[1], still[1]) @ motion(*nominal.joints[2], still[2]) @ [302, 0, 630, 1])[0]
        bent = np.arctan2(302, 70) + np.radians(q[2])
        inside = all(lo + 3 < v < hi - 3 for v, (lo, hi) in zip(q, LIMITS))
        if abs(q[4]) > 15 and abs(wrist) > 80 and 0.3 < bent < 2.6 and inside:
            shown.append(q)
            behind.append(wrist < 0)
    shown = np.array(shown)
    poses = [nominal.pose(np.radians(q)) for q in shown]
    loads = [0.0, 2.5, 5.0, 1.25] * 4
    rows = ["name;q1_deg;q2_deg;q3_deg;q4_deg;q5_deg;q6_deg;load_kg;note"]
    for k, q in enumerate(shown):
        cells = [number(v, 3).replace(".", ",") for v in q]
        rows.append(";".join([f"P{k}", *cells, str(loads[k]).replace(".", ","), f'"a;{k}"']))
    (folder / "joints.csv").write_bytes(("\ufeff" + "\r\n".join(rows) + "\r\n").encode())
    rows = ["x_mm,y_mm,z_mm,qw,qx,qy,qz,load_kg,remark"]
    # A path: small steps, so that each pose says which joint values the next one means.
    path = [shown[0]]
    for _ in range(11):
        path.append(np.round(path[-1] + rng.uniform(-4, 4, 6), 3))
    for k, q in enumerate(path):
        pose = nominal.pose(np.radians(q))
        cells = [*(number(v, 6) for v in pose[:3, 3]), *(number(v, 9) for v in quaternion(pose[:3, :3]))]
        rows.append(",".join([*cells, str(loads[k]), ""]))
    (folder / "poses.csv").write_text("\n".join(rows) + "\n")
    (folder / "cell.mod").write_bytes(rapid(poses, shown, behind).encode("latin-1"))
    (folder / "cell.src").write_bytes(krl(poses, shown, behind).encode("latin-1"))
    (folder / "cell.script").write_bytes(urscript(poses, shown).encode("latin-1"))
    (folder / "cell.ls").write_bytes(fanuc(poses, shown, behind).encode("latin-1"))
    flat = lambda matrix: np.asarray(matrix).ravel().tolist()
    describe = lambda r, n: {
        "joints": [{"kind": k, "axis": list(a), "point": list(p)} for k, a, p in r.joints],
        "links": [flat(link) for link in r.links],
        "zeros": r.zeros.tolist(),
        "compliance": r.compliance.tolist(),
        "tool": flat(r.tool),
        "nominal_tool": flat(n.tool),
    }
    t_nominal, t_real = positioner()
    limits = [j[3] for j in TABLE]
    session(folder, "positioner", t_nominal, t_real, limits, 60, [0], 4)
    t_shown = np.round(rng.uniform([-70, -160], [70, 160], (12, 2)), 3)
    hidden = {
        "arm": describe(real, nominal) | {"q_deg": shown.tolist(), "path_deg": np.array(path).tolist(), "load_kg": loads},
        "positioner": describe(t_real, t_nominal)
        | {
            "q_deg": t_shown.tolist(),
            "floor_mm": floors(t_nominal, t_real, np.radians(t_shown)),
        },
    }
    (folder / "hidden.json").write_text(json.dumps(hidden) + "\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tests/data/programs")
