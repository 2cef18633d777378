"""Makes the small files here: one for each row of reports.md, which the test `public_reports` goes through.

A head that pans about z and tilts about -y through (0, 0, 400), its tool 250 mm in front, measured every 6 s from
2024-05-03 13:50:11 UTC on. Nothing is off and nothing is noise, so that what is read right leaves no error.
"""

import json
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
random.seed(11)
POSES = [(round(random.uniform(-100, 100), 3), round(random.uniform(-50, 60), 3)) for _ in range(12)]
EPOCH = 1714744211


def robot(name, *joints):
    axes = [([0, 0, 1], [0, 0, 0]), ([0, -1, 0], [0, 0, 400])]
    joints = [{"name": j, "kind": "revolute", "axis": a, "point_mm": p} for j, (a, p) in zip(joints, axes)]
    made = {"name": "head", "joints": joints, "tool": {"position_mm": [250, 0, 400], "quaternion_wxyz": [1, 0, 0, 0]}}
    (HERE / name).write_text(json.dumps(made, indent=1) + "\n")


def point(pan, tilt):
    p, t = math.radians(pan), math.radians(tilt)
    return [250 * math.cos(p) * math.cos(t), 250 * math.sin(p) * math.cos(t), 400 + 250 * math.sin(t)]


def wxyz(pan, tilt):
    """Rz(pan) Ry(-tilt)."""
    p, t = math.radians(pan) / 2, -math.radians(tilt) / 2
    return [math.cos(p) * math.cos(t), -math.sin(p) * math.sin(t), math.cos(p) * math.sin(t), math.sin(p) * math.cos(t)]


def matrix(pan, tilt):
    p, t = math.radians(pan), math.radians(tilt)
    (sp, cp), (st, ct) = (math.sin(p), math.cos(p)), (math.sin(t), math.cos(t))
    return [[cp * ct, -sp, -cp * st], [sp * ct, cp, -sp * st], [st, 0.0, ct]]


def rotvec(pan, tilt):
    w, *v = wxyz(pan, tilt)
    length = math.sqrt(sum(c * c for c in v))
    return [2 * math.atan2(length, w) * c / length for c in v]


def table(name, head, row, sep=",", comma=False, end="", digits=6, encoding="utf-8"):
    """A row from (index, pan, tilt, point), as a list of cells."""
    lines = [head] if head else []
    for i, (p, t) in enumerate(POSES):
        cells = [c if isinstance(c, str) else f"{c:.{digits}f}" for c in row(i, p, t, point(p, t))]
        lines.append(sep.join(c.replace(".", ",") if comma else c for c in cells) + end)
    (HERE / name).write_text("\n".join(lines) + "\n", encoding=encoding)


def rad(*values):
    return [math.radians(v) for v in values]


def m(x):
    return [v / 1000 for v in x]


robot("robot.json", "pan", "tilt")
robot("robot-numbered.json", "joint_1", "joint_2")
made = json.loads((HERE / "robot.json").read_text())
made["joints"][1]["axis"] = [0, 1, 0]
(HERE / "robot-sign.json").write_text(json.dumps(made, indent=1) + "\n")
robot("robot-named.json", "shoulder_pan_joint", "shoulder_lift_joint")
table("commands.csv", "name,q1_deg,q2_deg", lambda i, p, t, x: [f"P{i}", p, t])
XYZ = "x_mm,y_mm,z_mm"

# Names of joints.
table("fingers-first.csv", f"panda_finger_joint1,panda_joint1,panda_joint2,{XYZ}", lambda i, p, t, x: [0.04, *rad(p, t), *x])
table("out-of-order.csv", f"joint_2,joint_1,{XYZ}", lambda i, p, t, x: [*rad(t, p), *x])
table("arm-left.csv", f"arm_left_1_joint,arm_left_2_joint,{XYZ}", lambda i, p, t, x: [*rad(p, t), *x])
table("iiwa.csv", f"iiwa_joint_1,iiwa_joint_2,{XYZ}", lambda i, p, t, x: [*rad(p, t), *x])
table("kr10.csv", f"kr10_a1,kr10_a2,{XYZ}", lambda i, p, t, x: [*rad(p, t), *x])
table("two-arms.csv", f"left_shoulder_pan_joint,left_shoulder_lift_joint,right_shoulder_pan_joint,right_shoulder_lift_joint,{XYZ}", lambda i, p, t, x: [*rad(p, t, 3, 4), *x])
table("ur5e.csv", f"ur5e_shoulder_pan_joint,ur5e_shoulder_lift_joint,{XYZ}", lambda i, p, t, x: [*rad(p, t), *x])
table("lerobot.csv", f"shoulder_pan.pos,shoulder_lift.pos,gripper.pos,{XYZ}", lambda i, p, t, x: [p, t, 37.5, *x])
table("franka-log.csv", f"time,q[0],q[1],q_d[0],q_d[1],dq[0],dq[1],{XYZ}", lambda i, p, t, x: [f"{6 * i}", *rad(p, t), *rad(p, t), 0.0, 0.0, *x])
table("franka-twice.csv", f"q_d[0],q_d[1],q_d[0],q_d[1],{XYZ}", lambda i, p, t, x: [*rad(p, t), *rad(p, t), *x])
table("plotjuggler.csv", "__time,/joint_states/pan/position,/joint_states/tilt/position,/tool/pose/position/x,/tool/pose/position/y,/tool/pose/position/z",
      lambda i, p, t, x: [f"{EPOCH + 6 * i}.25", *rad(p, t), *m(x)], digits=9)
table("plotjuggler-index.csv", "__time,/joint_states/position[0],/joint_states/position[1],/tool/pose/position/x,/tool/pose/position/y,/tool/pose/position/z",
      lambda i, p, t, x: [f"{EPOCH + 6 * i}.25", *rad(p, t), *m(x)], digits=9)
table("rostopic.csv", "%time,field.pose.position.x,field.pose.position.y,field.pose.position.z,field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w",
      lambda i, p, t, x: [f"{(EPOCH + 6 * i) * 10**9}", *m(x), *wxyz(p, t)[1:], wxyz(p, t)[0]], digits=9)
table("tuples.csv", "time,name,position,x_mm,y_mm,z_mm", lambda i, p, t, x: [f"{6 * i}", '"(\'pan\', \'tilt\')"', '"({:.6f}, {:.6f})"'.format(*rad(p, t)), *x])
# Trajectories.
tum = lambda i, p, t, x: [f"{EPOCH + 6 * i}.0", *m(x), *wxyz(p, t)[1:], wxyz(p, t)[0]]
table("tum-spaces.txt", None, tum, sep="   ", end="  ", digits=9)
table("tum-without-z.txt", None, lambda i, p, t, x: [v for k, v in enumerate(tum(i, p, t, x)) if k != 3], sep=" ", digits=9)
table("tum-commas.txt", None, tum, digits=9)
table("tum-mocap0.csv", "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1]",
      lambda i, p, t, x: [f"{(EPOCH + 6 * i) * 10**9}", *m(x), *wxyz(p, t), 0.0, 0.0, 0.0], digits=9)
table("tum-rotation-first.csv", "#timestamp [ns], q_w [], q_x [], q_y [], q_z [], p_x [m], p_y [m], p_z [m]", lambda i, p, t, x: [f"{(EPOCH + 6 * i) * 10**9}", *wxyz(p, t), *m(x)], digits=9)
table("tum-numbered.csv", "num t x y z qx qy qz qw", lambda i, p, t, x: [f"{i}", *tum(i, p, t, x)], sep=" ", digits=9)
table("no-header.csv", None, lambda i, p, t, x: [f"{EPOCH * 10**9 + 6 * i}", *m(x), *wxyz(p, t)], digits=9)
table("kitti.txt", None, lambda i, p, t, x: [v for r, c in zip(matrix(p, t), m(x)) for v in [*r, c]], sep=" ", digits=9)
table("column-major.csv", ",".join(f"O_T_EE[{k}]" for k in range(16)), lambda i, p, t, x: [v for k in range(3) for v in [*(r[k] for r in matrix(p, t)), 0.0]] + [*m(x), 1.0], digits=9)
table("aria.csv", "tracking_timestamp_us,tx_world_device,ty_world_device,tz_world_device,qx_world_device,qy_world_device,qz_world_device,qw_world_device",
      lambda i, p, t, x: [f"{6000000 * i}", *m(x), *wxyz(p, t)[1:], wxyz(p, t)[0]], digits=9)
table("kalibr.csv", "timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z", lambda i, p, t, x: [f"{6 * i}", *m(x), *wxyz(p, t)[1:], wxyz(p, t)[0]], digits=9)
table("rotation-first.csv", "qw|qx|qy|qz|tx|ty|tz", lambda i, p, t, x: [*wxyz(p, t), *x], sep="|")
table("kawasaki.csv", "X,Y,Z,O,A,T", lambda i, p, t, x: [*x, p, -t, 0.0])
table("robotpose.dat", None, lambda i, p, t, x: [*rad(0.0, -t, p), *x], sep=" ")
table("ur-as-angles.csv", "x_mm,y_mm,z_mm,Rx,Ry,Rz", lambda i, p, t, x: [*x, *rotvec(p, t)])
table("angles.csv", "x_mm,y_mm,z_mm,rx,ry,rz", lambda i, p, t, x: [*x, 0.0, -t, p])
table("degrees.csv", f"q1,q2,{XYZ}", lambda i, p, t, x: [p, t, *x])
table("attitude.csv", "x_mm,y_mm,z_mm,roll,pitch,heading", lambda i, p, t, x: [*x, 0.0, -t, p])
# Tables.
table("semicolons.csv", f"pan;tilt;{XYZ.replace(',', ';')}", lambda i, p, t, x: [*rad(p, t), *x], sep=";", digits=9)
table("pipes.csv", f"q1_deg|q2_deg|{XYZ.replace(',', '|')}", lambda i, p, t, x: [p, t, *x], sep="|")
table("comma-in-heading.csv", f"q1_deg,q2_deg,Torque, Request,{XYZ}", lambda i, p, t, x: [p, t, 1.5, *x])
table("comma-in-heading-last.csv", f"q1_deg,q2_deg,{XYZ},Torque, Request", lambda i, p, t, x: [p, t, *x, 1.5])
table("pandas-index.csv", f",q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [f"{i}", p, t, *x])
table("pandas-unnamed.csv", f"Unnamed: 0,q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [f"{i}", p, t, *x])
table("pandas-no-index-name.csv", f"q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [f"{i}", p, t, *x])
table("separator-at-end.csv", f'"name";"x_mm";"y_mm";"z_mm"', lambda i, p, t, x: [f'"P{i}"', *x], sep=";", end=";")
table("separator-at-end-6.csv", f"q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [p, t, *x], end=",")
table("bom.csv", f'"q1_deg","q2_deg",{XYZ}', lambda i, p, t, x: [p, t, *x], encoding="utf-8-sig")
table("sep-line.csv", f"sep=;\nq1_deg;q2_deg;{XYZ.replace(',', ';')}", lambda i, p, t, x: [p, t, *x], sep=";", comma=True)
table("time-of-day.csv", f"clock,q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [f"17:{(6 * i) // 60:02d}:{(6 * i) % 60:02d}", p, t, *x])
table("numbers-with-units.csv", f"q1,q2,x,y,z", lambda i, p, t, x: [f"{p:.3f}°", f"{t:.3f}°", *[f"{v:.4f} mm" for v in x]])
table("frame-twice.csv", f"frame,q1_deg,q2_deg,frame,{XYZ}", lambda i, p, t, x: [f"{i}", p, t, f"{i}", *x])
table("cloud.txt", "// head\n// X Y Z", lambda i, p, t, x: x, sep=" ")
table("cloud-commas.txt", "//X Y Z", lambda i, p, t, x: x, sep=" ", comma=True)
table("indented.txt", f"  q1_deg   q2_deg  x_mm y_mm  z_mm", lambda i, p, t, x: ["", p, t, *x], sep="  ")
table("lost-zeros.csv", f"q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [p, t, *(x if i % 4 else [0.0, 0.0, 0.0])])
table("lost-nan.csv", f"q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [p, t, *(x if i % 4 else ["nan"] * 3)])
table("lost-minus.csv", f"q1_deg,q2_deg,{XYZ}", lambda i, p, t, x: [p, t, *(x if i % 4 else [-9999.0] * 3)])
table("lost-missing.csv", "Frame,Tool,State,Q0,Qx,Qy,Qz,Tx,Ty,Tz,Error", lambda i, p, t, x: [f"{i}", "1", *(["OK", *wxyz(p, t), *x, 0.05] if i % 4 else ["MISSING"] + [""] * 8)])
table("dms.csv", f"q1,q2,{XYZ}", lambda i, p, t, x: [*[f"{'-' if v < 0 else ''}{int(abs(v))}°{int(abs(v) * 60) % 60:02d}'{abs(v) * 3600 % 60:.1f}" for v in (p, t)], *x])
table("auto-id.txt", None, lambda i, p, t, x: [f"tag{i}", *x, 0.0, -t, p, p, t], sep="\t")
table("tdm.csv", "# group-id:  usi4863\n# name:  203\n# channel-id:  usi9706,  channel-id: usi9707\n# name:  q1_deg,  name: q2_deg,  name: x_mm,  name: y_mm,  name: z_mm", lambda i, p, t, x: [p, t, *x])
# Motion capture.
table("vicon.csv", "Trajectories\n100\n,,head:tool,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm", lambda i, p, t, x: [f"{i + 1}", "0", *x])
table("vicon-two.csv", "Trajectories\n100\n,,head:tool,,,head:base,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n,,mm,mm,mm,mm,mm,mm", lambda i, p, t, x: [f"{i + 1}", "0", *x, 0.0, 0.0, 0.0])
table("qtm.tsv", "NO_OF_FRAMES\t12\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nNO_OF_ANALOG\t0\nANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2024-05-03, 15:50:11\t1234.5\nDATA_INCLUDED\t3D\nMARKER_NAMES\ttool\ntool X\ttool Y\ttool Z",
      lambda i, p, t, x: x, sep="\t")
table("qtm-6dof.tsv", "NO_OF_FRAMES\t12\nNO_OF_BODIES\t1\nFREQUENCY\t100\nDATA_INCLUDED\t6D\nBODY_NAMES\ttool\ntool X\tY\tZ\tRoll\tPitch\tYaw\tResidual\tRot[0]\tRot[1]\tRot[2]\tRot[3]\tRot[4]\tRot[5]\tRot[6]\tRot[7]\tRot[8]",
      lambda i, p, t, x: [*x, 0.0, -t, p, 0.1, *[matrix(p, t)[r][c] for c in range(3) for r in range(3)]], sep="\t")
table("markers.trc", "PathFileType\t4\t(X/Y/Z)\ttool.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t12\t1\tmm\t100\t1\t12\nFrame#\tTime\ttool\t\t\n\t\tX1\tY1\tZ1\n",
      lambda i, p, t, x: [f"{i + 1}", f"{i / 100}", *x], sep="\t")
# What is no table.
(HERE / "handeye.yaml").write_text("-\n  effector_wrt_world:\n" + "".join(f"    - {v:.9f}\n" for v in [*matrix(*POSES[0])[0], 0.4, *matrix(*POSES[0])[1], 0.1, *matrix(*POSES[0])[2], 0.2, 0, 0, 0, 1]) + "  object_wrt_sensor:\n" + "".join(f"    - {v}\n" for v in [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]))
(HERE / "pose-state.yaml").write_text("%YAML:1.0\n---\nPoseState: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ 1., 0., 0., 569.5, 0., 1., 0., 317.7,\n       0., 0., 1., 570.0, 0., 0., 0., 1. ]\n")
(HERE / "easy-handeye.yaml").write_text("parameters:\n  eye_on_hand: false\n  robot_base_frame: link_base\ntransformation:\n  qw: 0.06\n  qx: -0.06\n  qy: -0.70\n  qz: 0.71\n  x: 0.29\n  y: 1.67\n  z: 0.97\n")
(HERE / "scenes.yaml").write_text("---\nreference_frame: base\nscenes:\n-\n  scene_id: 0\n  joint_values:\n    - 0.27\n    - 0.54\n  observations:\n  -\n    camera: sls_2\n    roi_x_min: 0\n    roi_x_max: 1280\n")
(HERE / "matrices-printed.txt").write_text("".join("[" + "\n ".join("[" + " ".join(f"{v: .8e}" for v in [*r, c]) + "]" for r, c in zip(matrix(p, t) + [[0, 0, 0]], point(p, t) + [1])) + "]\n" for p, t in POSES))
(HERE / "echo.txt").write_text("".join(f"header:\n  stamp:\n    sec: {EPOCH + 6 * i}\n    nanosec: 0\n  frame_id: base_link\nname:\n- pan\n- tilt\nposition:\n- {math.radians(p):.9f}\n- {math.radians(t):.9f}\nvelocity: []\neffort: []\n---\n" for i, (p, t) in enumerate(POSES)))
(HERE / "samples.json").write_text(json.dumps([{"joints": [p, t], "position": point(p, t)} for p, t in POSES]) + "\n")
(HERE / "old.bag").write_bytes(b"#ROSBAG V2.0\n\x45\x00\x00\x00\x0c\x00\x00\x00chunk_count=\x01\x00\x00\x00" + bytes(40))
(HERE / "bag.db3").write_bytes(b"SQLite format 3\x00\x10\x00\x01\x01\x00\x40\x20\x20" + bytes(80))
(HERE / "capture.c3d").write_bytes(b"\x02\x50\x01\x00\x00\x00\x01\x00\x0c\x00" + bytes(80))
(HERE / "samples.npy").write_bytes(b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (12, 5), }" + b" " * 20 + b"\n" + bytes(96))
(HERE / "samples.mat").write_bytes(b"MATLAB 5.0 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x01IM" + bytes(40))
(HERE / "samples.h5").write_bytes(b"\x89HDF\r\n\x1a\n\x00\x00\x00\x00\x00\x08\x08\x00" + bytes(40))
(HERE / "samples.parquet").write_bytes(b"PAR1\x15\x04\x15" + bytes(40) + b"PAR1")
(HERE / "samples.csv.gz").write_bytes(b"\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03" + bytes(20))
(HERE / "web.xls").write_text("<html><head></head><body><table><tr><td>q1_deg</td><td>x_mm</td></tr>\n" + "".join(f"<tr><td>{p}</td><td>{point(p, t)[0]:.4f}</td></tr>\n" for p, t in POSES) + "</table></body></html>\n")
(HERE / "station.gsi").write_text("".join(f"110001+0000000{i:X} 21.022+16641{i:03d} 22.022+09635{i:03d} 31..00+00006649 81..00+00003342 82..00-00005736 83..00+00000091\n" for i in range(12)))


# Descriptions of robots.
def urdf(name, first="<axis xyz=\"0 0 1\"/><limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/>", origin='xyz="0 0 0.4" rpy="0 0 0"', more="", head='<?xml version="1.0"?>\n', tool="tool", bom=False):
    text = (head + f'<robot name="head"><link name="base_link"/><link name="column"/><link name="head"/><link name="{tool}"/>\n'
            f'<joint name="pan" type="revolute"><parent link="base_link"/><child link="column"/>{first}</joint>\n'
            f'<joint name="tilt" type="revolute"><origin {origin}/><parent link="column"/><child link="head"/><axis xyz="0 -1 0"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>\n'
            f'<joint name="mount" type="fixed"><origin xyz="0.25 0 0"/><parent link="head"/><child link="{tool}"/></joint>{more}</robot>\n')
    (HERE / f"{name}.urdf").write_text(text, encoding="utf-8-sig" if bom else "utf-8")
    (HERE / f"{name}.json").write_text(json.dumps({"name": name, "urdf": {"file": f"{name}.urdf", "base": "base_link", "tip": tool}}) + "\n")


urdf("decimal-comma", origin='xyz="0 0 0,4" rpy="0 0 0"')
urdf("axis-with-rpy", first='<origin rpy="0 0 0" xyz="0 0 0"/><axis rpy="0 0 0" xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/><joint_properties damping="0.2" friction="0.2"/>')
urdf("origin-without-rpy", origin='xyz="0 0 0.4"')
urdf("limit-without-effort", first='<axis xyz="0 0 1"/><limit lower="-3" upper="3"/>')
urdf("limit-without-lower", first='<axis xyz="0 0 1"/><limit upper="3" effort="1" velocity="1"/>')
urdf("calibration-rising", first='<axis xyz="0 0 1"/><calibration rising="0.02"/><limit lower="-3" upper="3" effort="1" velocity="1"/>')
urdf("mimic", more='<link name="finger"/><joint name="finger_joint" type="prismatic"><parent link="head"/><child link="finger"/><axis xyz="0 1 0"/><mimic joint="pan" multiplier="2"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>')
urdf("space-in-link", tool="tool center point")
urdf("bom", bom=True)
urdf("two-roots", more='<link name="world"/><link name="table"/><joint name="t" type="fixed"><parent link="world"/><child link="table"/></joint>')
table("of-urdf.csv", f"pan,tilt,{XYZ}", lambda i, p, t, x: [*rad(p, t), *x], digits=9)

# An arm of three joints whose controller shows the third one against the floor, as it does with a parallelogram.
ARM = [([0, 0, 1], [0, 0, 0]), ([0, 1, 0], [0, 0, 400]), ([0, 1, 0], [0, 0, 900])]
arm = {"name": "arm", "joints": [{"name": f"J{k + 1}", "kind": "revolute", "axis": a, "point_mm": p} for k, (a, p) in enumerate(ARM)],
       "tool": {"position_mm": [450, 0, 950], "quaternion_wxyz": [1, 0, 0, 0]}}
(HERE / "arm.json").write_text(json.dumps(arm, indent=1) + "\n")


def arm_point(a, b, c):
    """Rz(a) (0, 0, 400) + Ry(b) ((0, 0, 500) + Ry(c) (450, 0, 50))."""
    a, b, c = rad(a, b, b + c)
    r = 500 * math.sin(b) + 450 * math.cos(c) + 50 * math.sin(c)
    return [r * math.cos(a), r * math.sin(a), 400 + 500 * math.cos(b) - 450 * math.sin(c) + 50 * math.cos(c)]


lines = ["J1 [deg],J2 [deg],J3 [deg],x_mm,y_mm,z_mm"]
for _ in range(30):
    a, b, c = (round(random.uniform(-60, 60), 3) for _ in range(3))
    lines.append(",".join(f"{v:.4f}" for v in [a, b, c - b, *arm_point(a, b, c)]))
(HERE / "teach-pendant.csv").write_text("\n".join(lines) + "\n")
