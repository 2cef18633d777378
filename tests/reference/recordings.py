#!/usr/bin/env python3
"""Writes the recordings, board poses and distance logs of tests/core/recordings.rs, with their truth, into
tests/data/imports. The kinematics are plain numpy (product of exponentials by Rodrigues' formula), the
recordings come from the `mcap` and `mcap-ros2-support` packages; only the big-endian messages are put
together here, because no writer makes them. With a folder and a seed: one more recording there, with
other noise and a robot that is not as drawn, to see whether the clock's interval holds."""

import json
import pathlib
import struct
import sys

import numpy as np
from mcap.writer import CompressionType, Writer
from mcap_ros2.writer import Writer as RosWriter

OUT = pathlib.Path(__file__).parent.parent / "data" / "imports"

JOINTS = [("shoulder", [0, 0, 1], [0, 0, 0]), ("upper", [0, 1, 0], [50, 0, 300]), ("elbow", [0, 1, 0], [50, 0, 700])]
TOOL = np.array([450.0, 60.0, 720.0])
ROBOT = {
    "name": "three-joint arm",
    "joints": [{"name": n, "kind": "revolute", "axis": a, "point_mm": p, "limits": [-150, 150]} for n, a, p in JOINTS],
    "tool": {"position_mm": TOOL.tolist(), "quaternion_wxyz": [1, 0, 0, 0]},
}

HEADER = "std_msgs/Header header\n"
TYPES = {
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation",
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
}
JOINT_STATE = HEADER + "string[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort"
POSE_STAMPED = HEADER + "geometry_msgs/Pose pose"
SEPARATOR = "\n" + "=" * 80 + "\n"


def definition(text):
    return SEPARATOR.join([text] + [f"MSG: {name}\n{body}" for name, body in TYPES.items()])


def rotation(axis, angle):
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def forward(q, zero=(0, 0, 0), tool=TOOL):
    """Position (mm) and rotation of the tool in the base frame."""
    turn, shift = np.eye(3), np.zeros(3)
    for (_, axis, point), angle, offset in zip(JOINTS, q, zero):
        r = rotation(axis, angle + offset)
        p = np.asarray(point, float)
        shift = shift + turn @ (p - r @ p)
        turn = turn @ r
    return shift + turn @ tool, turn


def quaternion(r):
    """x, y, z, w of a rotation, by the largest of its eigenvalues (Bar-Itzhack)."""
    m = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
        [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
        [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], 0],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]]) / 3
    return np.linalg.eigh(m)[1][:, -1]


def with_stops(rng, poses, move=0.7, stop=0.9):
    """Joint values over time: rest, smooth move, rest, …"""
    knots = rng.uniform([-1.2, -0.5, -0.9], [1.2, 0.6, 0.9], (poses, 3))

    def at(t):
        k, rest = divmod(t, move + stop)
        k = int(k)
        if k >= poses - 1 or rest < stop:
            return knots[min(k, poses - 1)]
        s = (rest - stop) / move
        s = s * s * (3 - 2 * s)
        return knots[k] + s * (knots[k + 1] - knots[k])

    return at, poses * (move + stop), knots


def stamp(t, start=1_700_000_000):
    ns = start * 10**9 + round(t * 1e9)
    return ns, {"sec": ns // 10**9, "nanosec": ns % 10**9}


FRAME_R = rotation([0.2, 0.1, 1.0], 2.1)
FRAME_T = np.array([1800.0, -700.0, 250.0])


def seen(p, rng, sigma):
    """A point of the base frame as the instrument sees it, m."""
    return (FRAME_R.T @ (p - FRAME_T) + rng.normal(0, sigma, 3)) * 1e-3


def ros2(path, seed, offset_s, zero=(0, 0, 0), poses=14, sigma=0.02):
    """Stops; joints in the alphabet's order with a gripper among them; poses by a tracker."""
    rng = np.random.default_rng(seed)
    at, length, knots = with_stops(rng, poses)
    with open(path, "wb") as stream:
        writer = RosWriter(stream, chunk_size=40_000, compression=CompressionType.ZSTD)
        joint_state = writer.register_msgdef("sensor_msgs/msg/JointState", definition(JOINT_STATE))
        pose = writer.register_msgdef("geometry_msgs/msg/PoseStamped", definition(POSE_STAMPED))
        text = writer.register_msgdef("std_msgs/msg/String", "string data")
        writer.write_message("/rosout", text, {"data": "hello"}, 0, 0)
        names = ["elbow", "gripper", "shoulder", "upper"]
        messages = []
        for k in range(int(length * 40)):
            t = k / 40
            q = at(t) + rng.normal(0, 5e-6, 3)
            ns, s = stamp(t)
            messages.append((ns, "/joint_states", joint_state, {
                "header": {"stamp": s, "frame_id": ""}, "name": names,
                "position": [q[2], 0.01, q[0], q[1]], "velocity": [], "effort": []}))
        for k in range(int(length * 15)):
            # The instrument's clock is behind by the offset: t_command = t_measured + offset.
            t = k / 15 + 0.011
            p, r = forward(at(t), zero)
            ns, s = stamp(t - offset_s)
            x, y, z, w = quaternion(FRAME_R.T @ r)
            px, py, pz = seen(p, rng, sigma)
            messages.append((ns, "/tracker/pose", pose, {
                "header": {"stamp": s, "frame_id": "tracker"},
                "pose": {"position": {"x": px, "y": py, "z": pz},
                         "orientation": {"x": x, "y": y, "z": z, "w": w}}}))
        for ns, topic, schema, message in sorted(messages, key=lambda message: message[0]):
            writer.write_message(topic, schema, message, ns, ns)
        writer.finish()
    return knots


def as_json(path, seed, offset_s):
    """Never at rest: points, as JSON, in chunks by lz4; no header stamps, so the recorder's clock counts."""
    rng = np.random.default_rng(seed)
    phase = rng.uniform(0, 6, 3)
    at = lambda t: np.array([0.9, 0.5, 0.7]) * np.sin(np.array([0.41, 0.53, 0.77]) * t + phase)
    with open(path, "wb") as stream:
        writer = Writer(stream, chunk_size=30_000, compression=CompressionType.LZ4)
        writer.start()
        schemas = {name: writer.register_schema(name, "jsonschema", b"{}")
                   for name in ("sensor_msgs/JointState", "geometry_msgs/PointStamped")}
        channel = lambda topic, name: writer.register_channel(topic, "json", schemas[name])
        joints = channel("/joints", "sensor_msgs/JointState")
        point = channel("/prism", "geometry_msgs/PointStamped")
        for k in range(500):
            ns, _ = stamp(k / 25)
            data = {"name": [n for n, _, _ in JOINTS], "position": (at(k / 25)).tolist()}
            writer.add_message(joints, ns, json.dumps(data).encode(), ns)
        for k in range(160):
            t = 0.5 + k / 8.5
            ns, _ = stamp(t - offset_s)
            p, _ = forward(at(t))
            x, y, z = seen(p, rng, 0.02)
            data = {"header": {"frame_id": "station"}, "point": {"x": x, "y": y, "z": z}}
            writer.add_message(point, ns, json.dumps(data).encode(), ns)
        writer.finish()


class BigEndian:
    """CDR with the most significant byte first, aligned from behind the four bytes of its head."""

    def __init__(self):
        self.body = b""

    def put(self, form, value):
        size = struct.calcsize(form)
        self.body += b"\0" * (-len(self.body) % size) + struct.pack(">" + form, value)
        return self

    def text(self, text):
        self.put("I", len(text.encode()) + 1)
        self.body += text.encode() + b"\0"
        return self

    def header(self, s, frame):
        return self.put("i", s["sec"]).put("I", s["nanosec"]).text(frame)

    def bytes(self):
        return b"\0\0\0\0" + self.body


def transforms(path, seed, offset_s):
    """Transforms of a camera system, big-endian, without compression; two rigid bodies."""
    rng = np.random.default_rng(seed)
    at, length, _ = with_stops(rng, 9)
    with open(path, "wb") as stream:
        writer = Writer(stream, use_chunking=False)
        writer.start()
        schema = lambda name: writer.register_schema(name, "ros2msg", b"")
        joints = writer.register_channel("/joint_states", "cdr", schema("sensor_msgs/msg/JointState"))
        tf = writer.register_channel("/tf", "cdr", schema("tf2_msgs/msg/TFMessage"))
        static = writer.register_channel("/tf_static", "cdr", schema("tf2_msgs/msg/TFMessage"))
        ns, s = stamp(0)
        message = BigEndian().put("I", 1).header(s, "world").text("base")
        for value in (0, 0, 0, 0, 0, 0, 1):
            message.put("d", value)
        writer.add_message(static, ns, message.bytes(), ns)
        for k in range(int(length * 25)):
            q = at(k / 25)
            ns, s = stamp(k / 25)
            message = BigEndian().header(s, "").put("I", 3)
            for name, _, _ in JOINTS:
                message.text(name)
            for values in (q, [], []):
                message.put("I", len(values))
                for value in values:
                    message.put("d", value)
            writer.add_message(joints, ns, message.bytes(), ns)
        for k in range(int(length * 12)):
            t = k / 12 + 0.02
            ns, s = stamp(t - offset_s)
            p, r = forward(at(t))
            bodies = {"tool": (seen(p, rng, 0.02), FRAME_R.T @ r), "table": (np.zeros(3), np.eye(3))}
            message = BigEndian().put("I", len(bodies))
            for name, (x, turn) in bodies.items():
                message.header(s, "mocap").text(name)
                for value in [*x, *quaternion(turn)]:
                    message.put("d", value)
            writer.add_message(tf, ns, message.bytes(), ns)
        writer.finish()


def tiny(path, compression):
    """A few messages of a robot with one joint, for tests that damage them."""
    with open(path, "wb") as stream:
        writer = Writer(stream, compression=compression, use_chunking=compression != CompressionType.NONE)
        writer.start()
        schema = lambda name: writer.register_schema(name, "ros2msg", b"")
        joints = writer.register_channel("/j", "cdr", schema("sensor_msgs/msg/JointState"))
        point = writer.register_channel("/p", "json", schema("geometry_msgs/msg/PointStamped"))
        for k in range(8):
            ns, s = stamp(k)
            q = 0.2 * k + 0.1 * (k % 3)
            message = BigEndian().header(s, "").put("I", 1).text("pan").put("I", 1).put("d", q)
            writer.add_message(joints, ns, message.put("I", 0).put("I", 0).bytes(), ns)
            data = {"header": {"stamp": s}, "point": {"x": 0.25 * np.cos(q), "y": 0.25 * np.sin(q), "z": 0.3}}
            writer.add_message(point, ns, json.dumps(data).encode(), ns)
        writer.finish()


def standing(path):
    """Nothing moves but the noise."""
    rng = np.random.default_rng(9)
    with open(path, "wb") as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start()
        schema = lambda name: writer.register_schema(name, "jsonschema", b"")
        joints = writer.register_channel("/joints", "json", schema("JointState"))
        point = writer.register_channel("/prism", "json", schema("PointStamped"))
        for k in range(100):
            ns, s = stamp(k / 10)
            q = [0.1, 0.2, 0.3] + rng.normal(0, 1e-6, 3)
            header = {"stamp": s}
            data = {"header": header, "name": [n for n, _, _ in JOINTS], "position": q.tolist()}
            writer.add_message(joints, ns, json.dumps(data).encode(), ns)
            x, y, z = seen(forward(q)[0], rng, 0.02)
            data = {"header": header, "point": {"x": x, "y": y, "z": z}}
            writer.add_message(point, ns, json.dumps(data).encode(), ns)
        writer.finish()


def rotation_vector(r):
    """Rodrigues' vector, as cv2.Rodrigues gives it."""
    x, y, z, w = quaternion(r)
    v = np.array([x, y, z]) * (1 if w >= 0 else -1)
    n = np.linalg.norm(v)
    return v * (2 * np.arctan2(n, abs(w)) / n) if n > 0 else 2 * v


def boards():
    """A camera sees a board: on the tool from a fixed camera, and from the tool on the table."""
    rng = np.random.default_rng(4)
    # OpenCV's camera looks along +z; this one stands before the robot and looks back at it.
    camera = rotation([0, 1, 0], -np.pi / 2) @ rotation([0, 0, 1], np.pi / 2), np.array([1500.0, 100.0, 600.0])
    table = rotation([0, 0, 1], 0.4), np.array([600.0, -200.0, 20.0])
    fixed, on_tool, commands = [], [], []
    for k in range(12):
        q = rng.uniform([-1.2, -0.5, -0.9], [1.2, 0.6, 0.9])
        p, r = forward(q)
        # p_camera = R p_board + t, with the board's frame in the tool's.
        turn, shift = camera[0].T @ r, camera[0].T @ (p - camera[1])
        fixed.append((f"img_{k:02}.png", *rotation_vector(turn), *(shift / 1000)))
        # The camera in the tool's frame, the board on the table.
        turn, shift = r.T @ table[0], r.T @ (table[1] - p)
        on_tool.append((f"img_{k:02}.png", *quaternion(turn)[[3, 0, 1, 2]], *shift))
        commands.append((f"img_{k:02}.png", *np.degrees(q)))
    rows = lambda list_: "".join(",".join(v if isinstance(v, str) else f"{v:.9f}" for v in row) + "\n" for row in list_)
    (OUT / "board-rvec.csv").write_text(
        "image,rvec_x,rvec_y,rvec_z,tvec_x [m],tvec_y [m],tvec_z [m]\n" + rows(fixed))
    (OUT / "board-quaternion.csv").write_bytes(("\ufeffimage;qw;qx;qy;qz;tx;ty;tz\r\n" + rows(on_tool).replace(
        ",", ";").replace(".png", "~").replace(".", ",").replace("~", ".png").replace("\n", "\r\n")).encode())
    (OUT / "board-commands.csv").write_text("name,q1_deg,q2_deg,q3_deg\n" + rows(commands[::-1]))
    return {"camera_in_base": {"rotation": camera[0].tolist(), "position_mm": camera[1].tolist()},
            "table_in_base": {"rotation": table[0].tolist(), "position_mm": table[1].tolist()}}


def ballbar():
    """A telescoping bar from a ball on the table to the tool, in three notations."""
    rng = np.random.default_rng(6)
    anchor = np.array([300.0, -450.0, 40.0])
    rows, commands = [], []
    for k in range(15):
        q = rng.uniform([-0.9, -0.3, -0.5], [0.9, 0.5, 0.6])
        p, _ = forward(q)
        rows.append((12.5 + 2 * k, np.linalg.norm(p - anchor)))
        commands.append(np.degrees(q))
    (OUT / "ballbar.csv").write_text(
        "Ballbar test,QC-like\nUnits: mm\n\ntime_s,distance_mm\n"
        + "".join(f"{t:.3f},{d:.5f}\n" for t, d in rows))
    (OUT / "drawwire-de.txt").write_bytes(
        ("Seilzug;WS10\r\nZeit [ms];Länge [m]\r\n"
         + "".join(f"{t * 1000:.1f};{d / 1000:.8f}\r\n".replace(".", ",") for t, d in rows)).encode("cp1252"))
    (OUT / "ballbar-commands.csv").write_text(
        "q1_deg,q2_deg,q3_deg,anchor\n" + "".join(",".join(f"{v:.9f}" for v in q) + ",table\n" for q in commands))
    return {"anchor_mm": anchor.tolist(), "distances_mm": [d for _, d in rows]}


def main():
    if len(sys.argv) > 2:
        seed = int(sys.argv[2])
        zero = np.random.default_rng(seed + 1000).normal(0, 0.004, 3)
        ros2(pathlib.Path(sys.argv[1]) / f"{seed}.mcap", seed, 0.237, zero, sigma=0.1)
        return
    (OUT / "arm.json").write_text(json.dumps(ROBOT) + "\n")
    knots = ros2(OUT / "arm-ros2.mcap", 1, 0.237)
    as_json(OUT / "arm-json.mcap", 2, -3.05)
    transforms(OUT / "arm-tf.mcap", 3, 0.5)
    standing(OUT / "arm-standing.mcap")
    tiny(OUT / "tiny.mcap", CompressionType.NONE)
    tiny(OUT / "tiny-zstd.mcap", CompressionType.ZSTD)
    truth = {"offset_s": {"arm-ros2": 0.237, "arm-json": -3.05, "arm-tf": 0.5},
             "instrument_in_base": {"rotation": FRAME_R.tolist(), "position_mm": FRAME_T.tolist()},
             "stops_rad": knots.tolist(), "board": boards(), "ballbar": ballbar()}
    (OUT / "recordings.json").write_text(json.dumps(truth) + "\n")


if __name__ == "__main__":
    main()
