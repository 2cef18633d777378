"""Makes the small files here: one for each way in which files of others were read wrong or refused for a wrong reason.

A head that pans about z and tilts about -y through (0, 0, 400), its tool 250 mm in front, measured every 6 s from
2024-05-03 13:50:11 UTC on. Nothing is off and nothing is noise, so that what is read right leaves no error.
"""

import json
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
random.seed(7)
POSES = [(round(random.uniform(-100, 100), 3), round(random.uniform(-50, 60), 3)) for _ in range(12)]
EPOCH_MS = 1714744211000
ROBOT = {
    "name": "head",
    "joints": [
        {"name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0]},
        {"name": "tilt", "kind": "revolute", "axis": [0, -1, 0], "point_mm": [0, 0, 400]},
    ],
    "tool": {"position_mm": [250, 0, 400], "quaternion_wxyz": [1, 0, 0, 0]},
}


def point(pan, tilt):
    p, t = math.radians(pan), math.radians(tilt)
    return [250 * math.cos(p) * math.cos(t), 250 * math.sin(p) * math.cos(t), 400 + 250 * math.sin(t)]


def wxyz(pan, tilt):
    """Rz(pan) Ry(-tilt)."""
    p, t = math.radians(pan) / 2, -math.radians(tilt) / 2
    return [math.cos(p) * math.cos(t), -math.sin(p) * math.sin(t), math.cos(p) * math.sin(t), math.sin(p) * math.cos(t)]


def table(name, head, row, sep=",", comma=False):
    """A row from (index, pan, tilt, point), as a list of cells."""
    lines = [head] if head else []
    for i, (p, t) in enumerate(POSES):
        cells = [c if isinstance(c, str) else f"{c:.6f}" for c in row(i, p, t, point(p, t))]
        lines.append(sep.join(c.replace(".", ",") if comma else c for c in cells))
    (HERE / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def timed(name, heading, time, **how):
    sep = how.get("sep", ",")
    table(name, sep.join([heading, "q1_deg", "q2_deg", "x_mm", "y_mm", "z_mm"]), lambda i, p, t, x: [time(i), p, t, *x], **how)


(HERE / "robot.json").write_text(json.dumps(ROBOT, indent=1) + "\n")
table("commands.csv", "name,q1_deg,q2_deg", lambda i, p, t, x: [f"P{i}", p, t])
# Time.
timed("time-epoch-ms.csv", "Timestamp", lambda i: f"{EPOCH_MS + 6000 * i}")
timed("time-epoch-ns.csv", "Time", lambda i: f"{(EPOCH_MS + 6000 * i) * 10**6}")
timed("time-days.csv", "Time", lambda i: f"{45415.5765 + i * 6 / 86400:.10f}")
timed("time-hours.csv", "Zeit [h]", lambda i: f"{i * 6 / 3600:.10f}")
timed("time-unknown.csv", "Uhrzeit (Labor)", lambda i: f"0 h {i} min")
timed("time-zone.csv", "time", lambda i: f"2024-05-03T15:{50 + (11 + 6 * i) // 60}:{(11 + 6 * i) % 60:02d}.500+02:00")
timed("time-pm.csv", "time", lambda i: f"5/13/2024 {12 if i < 6 else 1}:{59 if i < 6 else 0:02d}:{(24 + 6 * i) % 60:02d} PM")
timed("time-comma.csv", "Zeit", lambda i: f"14:00:{6 * i % 60:02d},5" if i < 10 else f"14:01:{6 * i % 60:02d},5", sep=";", comma=True)
timed("time-two-parts.csv", "time", lambda i: f"{6 * i // 60}:{6 * i % 60:02d}")
timed("time-no-day.csv", "time", lambda i: f"2024-02-31 14:00:{i:02d}")
timed("time-short.csv", "time_s", lambda i: f"{0.006 * i:.4f}")
timed("time-long.csv", "time_s", lambda i: f"{(EPOCH_MS + 6000 * i) * 10**6}")
# Headings and comments.
pose = lambda i, p, t, x: [v / 1000 for v in x]
table("tum-real-first.txt", "# timestamp Tx Ty Tz Qw Qx Qy Qz", lambda i, p, t, x: [f"{EPOCH_MS / 1000 + 6 * i:.3f}", *pose(i, p, t, x), *wxyz(p, t)], sep=" ")
table("tum-euroc.txt", "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []",
      lambda i, p, t, x: [f"{(EPOCH_MS + 6000 * i) * 10**6}", *pose(i, p, t, x), *wxyz(p, t)])
table("tum-other.txt", "# time vx vy vz x y z yaw", lambda i, p, t, x: [f"{6 * i}", 0.0, 0.0, 0.0, *pose(i, p, t, x), 0.0], sep=" ")
table("spherical.txt", "// R, Theta, Phi", lambda i, p, t, x: [f"P{i}", 250.0, p, t], sep=", ")
table("comment-order.txt", "# name y x z", lambda i, p, t, x: [f"P{i}", x[1], x[0], x[2]], sep=" ")
table("comment-units.csv", "# Units: inches\nname,x,y,z", lambda i, p, t, x: [f"P{i}", *[v / 25.4 for v in x]])
table("comment-unit-row.csv", "name,x,y,z\n# -,m,m,m", lambda i, p, t, x: [f"P{i}", *pose(i, p, t, x)])
table("ros1.csv", "%time,field.header.seq,field.pose.position.x,field.pose.position.y,field.pose.position.z,"
      "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w",
      lambda i, p, t, x: [f"{(EPOCH_MS + 6000 * i) * 10**6}", f"{i}", *pose(i, p, t, x), *wxyz(p, t)[1:], wxyz(p, t)[0]])
# Numbers in headings.
table("joints-from-zero.csv", "joint_0 [deg],joint_1 [deg],joint_2 [deg],x_mm,y_mm,z_mm", lambda i, p, t, x: [p, t, 0.5, *x])
table("joints-q0.csv", "q0_deg,q1_deg,x_mm,y_mm,z_mm", lambda i, p, t, x: [p, t, *x])
table("quaternion-q0.csv", "name,X,Y,Z,q0,q1,q2,q3", lambda i, p, t, x: [f"P{i}", *x, *wxyz(p, t)])
table("quaternion-q1.csv", "name,X,Y,Z,Q1,Q2,Q3,Q4", lambda i, p, t, x: [f"P{i}", *x, *wxyz(p, t)])
table("gon.csv", "q1 [gon],q2 [rev],x_mm,y_mm,z_mm", lambda i, p, t, x: [p / 0.9, f"{t / 360:.9f}", *x])
# What is looked at first.
table("grouped.csv", "q1_deg;q2_deg;x_um;y_um;z_um", lambda i, p, t, x: [p, t, *[f"{1000 * v:_.3f}".replace("_", "\u00a0") for v in x]], sep=";", comma=True)
table("grouped-apostrophe.csv", "q1_deg;q2_deg;x_um;y_um;z_um", lambda i, p, t, x: [p, t, *[f"{1000 * v:_.3f}".replace("_", "'") for v in x]], sep=";", comma=True)
table("invisible.csv", "q1_deg;q2_deg;x_mm;y_mm;z_mm", lambda i, p, t, x: [p, t, f"{x[0]:.3f}\u200b5", x[1], x[2]], sep=";", comma=True)
table("commas-twice.csv", "q1_deg,q2_deg,x_mm,y_mm,z_mm", lambda i, p, t, x: [p, t, *x], comma=True)
(HERE / "workbook.xlsx").write_bytes(b"PK\x03\x04\x14\x00\x06\x00\x08\x00")


def matrix(p, t):
    p, t = math.radians(p), math.radians(t)
    (sp, cp), (st, ct) = (math.sin(p), math.cos(p)), (math.sin(t), math.cos(t))
    return [[cp * ct, -sp, -cp * st], [sp * ct, cp, -sp * st], [st, 0.0, ct]]


table("matrices.txt", None, lambda i, p, t, x: [v for r, m in enumerate(matrix(p, t)) for v in [*m, x[r]]] + [0.0, 0.0, 0.0, 1.0], sep=" ")
table("three-points.csv", "q1_deg,q2_deg,A_x,A_y,A_z,B_x,B_y,B_z,C_x,C_y,C_z", lambda i, p, t, x: [p, t, *x, *x, *x])
# A Motive export that a spreadsheet has saved again.
head = [["Format Version", "1.23", "Length Units", "Meters", "Rotation Type", "Quaternion", "Coordinate Space", "Global"], [],
        ["", "Type"] + ["Rigid Body"] * 7, ["", "Name"] + ["tool"] * 7, ["", "ID"] + ["1"] * 7,
        ["", ""] + ["Rotation"] * 4 + ["Position"] * 3, ["Frame", "Time (Seconds)", "X", "Y", "Z", "W", "X", "Y", "Z"]]
table("motive-semicolons.csv", "\n".join(";".join(line) for line in head).replace("1.23", "1,23"),
      lambda i, p, t, x: [f"{i}", 6.0 * i, *wxyz(p, t)[1:], wxyz(p, t)[0], *pose(i, p, t, x)], sep=";", comma=True)
(HERE / "latin.urdf").write_bytes('<?xml version="1.0" encoding="ISO-8859-1"?>\n<robot name="tür"><link name="a"/></robot>\n'.encode("latin1"))
(HERE / "xacro.urdf").write_text(
    '<?xml version="1.0"?>\n<robot name="t"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>'
    '<child link="b"/><origin xyz="0 0 ${L}"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>\n')
for name in ("latin", "xacro"):
    (HERE / f"robot-{name}.json").write_text(json.dumps({"name": "t", "urdf": {"file": f"{name}.urdf", "base": "a", "tip": "b"}}) + "\n")
# Orientations in another convention than they are said to be in.
table("quaternion-misheaded.csv", "name,x_mm,y_mm,z_mm,qx,qy,qz,qw", lambda i, p, t, x: [f"P{i}", *x, *wxyz(p, t)])


def rotation_vector(p, t):
    w, *v = wxyz(p, t)
    length = math.sqrt(sum(c * c for c in v))
    return [2 * math.atan2(length, w) * c / length for c in v]


table("rotation-vector.csv", "name,x_mm,y_mm,z_mm,rx_rad,ry_rad,rz_rad", lambda i, p, t, x: [f"P{i}", *x, *rotation_vector(p, t)])
table("moving-axes.csv", "name,x_mm,y_mm,z_mm,rx_deg,ry_deg,rz_deg", lambda i, p, t, x: [f"P{i}", *x, 0.0, -t, p])
