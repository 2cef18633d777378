#!/usr/bin/env python3
"""Writes the foreign files of tests/core/imports.rs, as instruments would: a robot with one rotary axis
whose zero is off by -0.35 deg and whose arm is 248.6 mm long instead of 250, seen in the format,
the unit, the encoding and the frame of each instrument. No noise but the rounding of the file."""

import math
import pathlib

HERE = pathlib.Path(__file__).parent
OFFSET_DEG, RADIUS, HEIGHT = -0.35, 248.6, 300.0


def point(q_deg):
    theta = math.radians(q_deg + OFFSET_DEG)
    return (RADIUS * math.cos(theta), RADIUS * math.sin(theta), HEIGHT)


def comma(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


def table_utf16():
    lines = ["Messprotokoll;Säule 7", "Datum;2024-05-03 14:02", "Prüfer;Ö. Müller", "",
             "Punktname;Theta;X;Y;Z;Temperatur;Bemerkung", ";deg;mm;mm;mm;°C;"]
    for k, q in enumerate(range(-90, 91, 15)):
        x, y, z = point(q)
        remark = '"warm; neu ""gesetzt"""' if k == 3 else ""
        lines.append(f"P{k + 1};{comma(q, 1)};{comma(x, 4)};{comma(y, 4)};{comma(z, 4)};"
                     f"{comma(20 + 0.25 * k, 2)};{remark}")
    (HERE / "column-utf16.csv").write_bytes(b"\xff\xfe" + "\r\n".join(lines + [""]).encode("utf-16-le"))


def tracker():
    # The instrument stands at (1200, -500, 150) mm, turned by 130 deg about z; it writes inches.
    turn = math.radians(130)

    def seen(p):
        x, y, z = p[0] - 1200, p[1] + 500, p[2] - 150
        c, s = math.cos(-turn), math.sin(-turn)
        return [v / 25.4 for v in (c * x - s * y, s * x + c * y, z)]

    base = {"R1": (400, 400, 0), "R2": (-400, 380, 5), "R3": (-390, -420, 0), "R4": (410, -400, 10),
            "R5": (0, 0, 800)}
    lines = ["// SpatialAnalyzer ASCII export", "// Instrument A::0", ""]
    for name, p in base.items():
        x, y, z = seen(p)
        if name == "R3":
            x += 0.4  # the reflector was not seated
        lines.append(f"Base, {name}, {x:.6f}, {y:.6f}, {z:.6f}")
    lines.append("// arm")
    sweep = list(range(-60, 61, 20))
    for q in sweep + sweep[::-1]:
        x, y, z = seen(point(q))
        lines.append(f"Arm, A{q:+d}, {x:.6f}, {y:.6f}, {z:.6f}, 0.0012")
    lines.append("Arm, stray, 1.000000, 2.000000, 3.000000, 0.0012")
    lines = [line + ("" if line.startswith(("//", "Arm")) or not line else ",") for line in lines]
    (HERE / "sa.txt").write_bytes("\r\n".join(lines + [""]).encode())
    (HERE / "reference.txt").write_text(
        "# surveyed on the base plate\nname\tX [mm]\tY [mm]\tZ [mm]\n"
        + "".join(f"{n}\t{p[0]:.3f}\t{p[1]:.3f}\t{p[2]:.3f}\n" for n, p in base.items()))
    rows = [f"A{q:+d},{q},1" for q in sweep] + [f"A{q:+d},{q},-1" for q in sweep[::-1]]
    (HERE / "commands-by-name.csv").write_text(
        "name,q1_deg,dir1\n" + "\n".join(rows) + "\nA+80,80,1\n")


def iso230():
    targets = list(range(-90, 91, 30))

    def measured(q, run, up):
        return q + 0.01 * math.sin(math.radians(2 * q)) + (0.002 if up else -0.002) + 0.0001 * run

    head = ["Prüfung nach ISO 230-2;;;;;;;;;;", "Achse;C;;;;;;;;;",
            "Ziel" + "".join(f";Lauf {n};" for n in range(1, 6)), "[°]" + ";+;-" * 5]
    head[2] = head[2].replace("Ziel", "Soll")
    lines = head + [";".join([comma(q, 3)] + [comma(measured(q, n, up), 5)
                                              for n in range(1, 6) for up in (True, False)]) for q in targets]
    (HERE / "iso230-wide.csv").write_bytes("\r\n".join(lines + [""]).encode("windows-1252"))
    lines = ["Run\tDirection\tTarget (deg)\tDeviation (arcsec)"]
    for n in range(1, 6):
        for up in (True, False):
            for q in targets if up else targets[::-1]:
                lines.append(f"{n}\t{'forward' if up else 'reverse'}\t{q:.3f}\t{3600 * (measured(q, n, up) - q):.2f}")
    (HERE / "iso230-long.txt").write_text("\n".join(lines + [""]))


def controller(t):
    """Sends the arm to a new angle every 4 s; each move takes 1 s. Returns the angle and whether it stands."""
    stops = [0, 30, -20, 55, 10, -45, 70, -5, 40, -60]
    k, rest = divmod(t, 4.0)
    k = int(k)
    if k >= len(stops) - 1:
        return stops[-1]
    return stops[k] + (stops[k + 1] - stops[k]) * min(max(rest - 3.0, 0.0), 1.0)


def motive():
    # y upwards, metres; the clock of the cameras is 8.25 s behind that of the controller.
    names = [("Rigid Body", "Lamp", 8), ("Rigid Body Marker", "Lamp:Marker1", 4), ("Marker", "Unlabeled 7", 3)]
    parts = {8: ["Rotation"] * 4 + ["Position"] * 3 + ["Mean Marker Error"],
             4: ["Position"] * 3 + ["Marker Quality"], 3: ["Position"] * 3}
    axes = {8: ["X", "Y", "Z", "W", "X", "Y", "Z", ""], 4: ["X", "Y", "Z", ""], 3: ["X", "Y", "Z"]}
    lines = ["Format Version,1.23,Take Name,Take 2024-05-03 02.10.11 PM,Take Notes,,Capture Frame Rate,10.000000,"
             "Export Frame Rate,10.000000,Capture Start Time,2024-05-03 02.10.11.123 PM,Total Frames in Take,360,"
             "Total Exported Frames,360,Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global", ""]
    row = lambda label, cells: f",{label}," + ",".join(cells)
    lines.append(row("Type", [kind for kind, _, n in names for _ in range(n)]))
    lines.append(row("Name", [f'"{name}"' for _, name, n in names for _ in range(n)]))
    lines.append(row("ID", [f'"{i}A{n}"' for i, (_, _, n) in enumerate(names) for _ in range(n)]))
    lines.append(row("Parent", ["" for _, _, n in names for _ in range(n)]))
    lines.append(row("", [p for *_, n in names for p in parts[n]]))
    lines.append("Frame,Time (Seconds)," + ",".join(a for *_, n in names for a in axes[n]))
    for frame in range(360):
        t = frame / 10
        q = controller(t + 0.5)
        x, y, z = (v / 1000 for v in point(q))
        half = math.radians(q + OFFSET_DEG) / 2
        # (x, y, z) with z up is (x, z, -y) with y up; a turn about z is one about y.
        lamp = [0, math.sin(half), 0, math.cos(half), x, z, -y]
        hidden = 100 <= frame < 104
        cells = [f"{v:.6f}" for v in lamp] + ["0.000123"] if not hidden else [""] * 8
        lines.append(",".join([str(frame), f"{t:.6f}"] + cells + ["", "", "", ""] + ["0.5", "0.1", "0.2"]))
    (HERE / "motive.csv").write_bytes("\r\n".join(lines + [""]).encode())
    log = ["time_s,q1_deg,load_kg"]
    for k in range(0, 391):
        t = k / 10
        log.append(f"{t + 7.75:.3f},{controller(t):.4f},{3 if t < 20 else 5}")
    (HERE / "controller-log.csv").write_text("\n".join(log) + "\n")


def tum():
    lines = ["# ground truth trajectory", "# timestamp tx ty tz qx qy qz qw"]
    for k, q in enumerate(range(-30, 31, 10)):
        x, y, z = (v / 1000 for v in point(q))
        half = math.radians(q + OFFSET_DEG) / 2
        lines.append(f"{1714744211.1 + 5 * k:.4f} {x:.7f} {y:.7f} {z:.7f} 0 0 {math.sin(half):.7f} {math.cos(half):.7f}")
        if k == 2:
            lines.append("# tracking lost for a moment")
    (HERE / "trajectory.txt").write_text("\n".join(lines) + "\n")
    (HERE / "commands-in-order.csv").write_text("q1_deg\n" + "\n".join(str(q) for q in range(-30, 31, 10)) + "\n")


(HERE / "robot.json").write_text('{"name": "lamp column", "joints": [{"name": "pan", "kind": "revolute", '
                                 '"axis": [0, 0, 1], "point_mm": [0, 0, 0], "limits": [-90, 90]}],\n'
                                 ' "tool": {"position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0]}}\n')
table_utf16()
tracker()
iso230()
motive()
tum()
