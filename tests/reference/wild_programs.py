"""Programs as they are in the wild: foreign tools, stretched wrists, large files. Drives the release binary,
and a robot with hidden errors (numpy and scipy, tests/reference/programs.py) that shares nothing with src/.

    python tests/reference/wild_programs.py BINARY [--before OTHER] [--only tools|singular|times] [--count N]

- tools: N programs a language whose tool is not the model's. A controller (scipy: the nominal robot with the
  program's own tool) solves the corrected poses, and the real robot, with that tool on its flange, is driven there.
- singular: 1000 joint targets for each kind of arm, half of them within 3 degrees of a singular pose, and paths
  through it in steps of 0.05 degrees.
- times: an ordinary program repeated, processor time and peak memory.

Measured in November 2026:

"Before" is the state of the morning of the work on these rows, on the same machine and the same inputs. "Left": targets left as
they are and named; a miss is that of the real tool from where the nominal robot has it.

| language | programs | way | exit 0 / 1 / 2 | targets driven | left | RMS miss, mm | largest, mm | mrad |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
| rapid | 100 | before | 0 / 100 / 0 | 93 | 307 | 1.3328 | 2.8967 | 9.6804 |
| rapid | 100 | no option | 0 / 0 / 100 | 0 | 0 | - | - | - |
| rapid | 100 | --as-programmed | 100 / 0 / 0 | 400 | 0 | 0.0000 | 0.0001 | 0.0003 |
| rapid | 100 | --tool … | 100 / 0 / 0 | 400 | 0 | 0.0000 | 0.0001 | 0.0003 |
| rapid | 100 | --as-modelled | 0 / 100 / 0 | 94 | 306 | 1.3314 | 2.8967 | 15.6093 |
| krl | 100 | before | 3 / 97 / 0 | 117 | 283 | 1.4483 | 3.0963 | 12.0017 |
| krl | 100 | no option | 0 / 0 / 100 | 0 | 0 | - | - | - |
| krl | 100 | --as-programmed | 70 / 30 / 0 | 366 | 34 | 0.0000 | 0.0001 | 0.0003 |
| krl | 100 | --tool … | 70 / 30 / 0 | 366 | 34 | 0.0000 | 0.0001 | 0.0003 |
| krl | 100 | --as-modelled | 3 / 97 / 0 | 117 | 283 | 1.4483 | 3.0963 | 12.0017 |
| urscript | 100 | before | 19 / 81 / 0 | 251 | 149 | 1.6221 | 4.4895 | 19.5990 |
| urscript | 100 | no option | 0 / 0 / 100 | 0 | 0 | - | - | - |
| urscript | 100 | --as-programmed | 100 / 0 / 0 | 400 | 0 | 0.0000 | 0.0001 | 0.0003 |
| urscript | 100 | --tool … | 100 / 0 / 0 | 400 | 0 | 0.0000 | 0.0001 | 0.0003 |
| urscript | 100 | --as-modelled | 19 / 81 / 0 | 252 | 148 | 1.6206 | 4.4895 | 19.5990 |
| fanuc-ls | 100 | before | 22 / 78 / 0 | 271 | 129 | 1.7789 | 4.6995 | 19.5990 |
| fanuc-ls | 100 | no option | 22 / 78 / 0 | 273 | 127 | 1.7870 | 4.6995 | 19.5990 |
| fanuc-ls | 100 | --tool … | 100 / 0 / 0 | 400 | 0 | 0.0000 | 0.0001 | 0.0003 |
| fanuc-ls | 100 | --as-modelled | 22 / 78 / 0 | 273 | 127 | 1.7870 | 4.6995 | 19.5990 |

1000 targets of joint values *anywhere* within the limits of each arm of `tests/reference/arms.py`, the same with the
joint that makes the arm singular *within 3°* of that, and five *paths through it* in steps of 0.05°. Errors are what
is left of the positions once a rigid motion common to all is taken out (the session's frame), so that they are those
of the identification; *in part* counts targets of which more than 1 µrad of the orientation is left.

| arm | targets | binary | left | mm before, RMS | after, RMS | largest | mrad before, largest | after, 99 % | largest | in part | largest joint move, ° | largest change between steps, ° |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
| six | anywhere | before | 193 of 1000 | 1.577 | 0.0481 | 0.0510 | 6.55 | 0.56 | 0.56 | 0 | 3.80 | - |
| six | within 3° of singular | before | 981 of 1000 | 1.689 | 0.0455 | 0.0623 | 5.96 | 0.56 | 0.56 | 0 | 4.17 | - |
| six | paths through it | before | 1069 of 1205 | 2.051 | 0.0062 | 0.0102 | 6.05 | 0.56 | 0.56 | 0 | 4.52 | 0.057 |
| six | anywhere | now | 5 of 1000 | 1.561 | 0.0481 | 0.0525 | 6.58 | 12.77 | 20.11 | 82 | 22.63 | - |
| six | within 3° of singular | now | 3 of 1000 | 1.526 | 0.0476 | 0.0570 | 6.60 | 13.35 | 21.32 | 983 | 13.77 | - |
| six | paths through it | now | 0 of 1205 | 1.966 | 0.0304 | 0.0461 | 6.19 | 4.55 | 4.57 | 936 | 5.43 | 0.087 |
| parallel | anywhere | before | 114 of 1000 | 1.802 | 0.0166 | 0.0176 | 4.64 | 0.50 | 0.50 | 0 | 3.31 | - |
| parallel | within 3° of singular | before | 892 of 1000 | 1.757 | 0.0160 | 0.0240 | 2.36 | 0.50 | 0.50 | 0 | 1.81 | - |
| parallel | paths through it | before | 898 of 1205 | 2.017 | 0.0056 | 0.0086 | 2.19 | 0.50 | 0.50 | 0 | 0.98 | 0.010 |
| parallel | anywhere | now | 3 of 1000 | 1.784 | 0.0166 | 0.0173 | 4.64 | 4.02 | 22.95 | 49 | 9.49 | - |
| parallel | within 3° of singular | now | 10 of 1000 | 1.767 | 0.0165 | 0.0194 | 2.53 | 6.94 | 18.25 | 977 | 21.27 | - |
| parallel | paths through it | now | 0 of 1205 | 1.760 | 0.0085 | 0.0116 | 2.19 | 5.33 | 5.36 | 755 | 6.46 | 0.067 |
| seven | anywhere | before | 132 of 1000 | 2.381 | 0.1806 | 0.2052 | 10.29 | 0.14 | 0.14 | 0 | 2.52 | - |
| seven | within 3° of singular | before | 374 of 1000 | 2.509 | 0.1786 | 0.2180 | 9.03 | 0.14 | 0.14 | 0 | 2.95 | - |
| seven | paths through it | before | 332 of 1205 | 2.579 | 0.1617 | 0.2194 | 6.12 | 0.14 | 0.14 | 0 | 1.98 | 0.021 |
| seven | anywhere | now | 0 of 1000 | 2.320 | 0.1799 | 0.2108 | 10.29 | 11.82 | 17.47 | 43 | 9.67 | - |
| seven | within 3° of singular | now | 20 of 1000 | 2.339 | 0.1756 | 0.2304 | 9.03 | 3.61 | 19.75 | 216 | 16.28 | - |
| seven | paths through it | now | 0 of 1205 | 2.484 | 0.1660 | 0.2285 | 6.12 | 0.86 | 0.88 | 84 | 3.27 | 0.051 |
| scara | anywhere | before | 25 of 1000 | 1.489 | 0.0049 | 0.0053 | 1.63 | 1.86 | 1.87 | 975 | 4.27 | - |
| scara | within 3° of singular | before | 948 of 1000 | 1.431 | 0.0040 | 0.0067 | 0.30 | 0.98 | 0.98 | 52 | 4.58 | - |
| scara | paths through it | before | 677 of 1205 | 1.630 | 0.0014 | 0.0081 | 0.33 | 0.99 | 0.99 | 528 | 4.45 | 0.052 |
| scara | anywhere | now | 15 of 1000 | 1.487 | 0.0049 | 0.0053 | 1.63 | 1.86 | 1.87 | 985 | 5.20 | - |
| scara | within 3° of singular | now | 587 of 1000 | 1.362 | 0.0042 | 0.0069 | 0.30 | 0.98 | 0.98 | 413 | 5.87 | - |
| scara | paths through it | now | 377 of 1205 | 1.627 | 0.0018 | 0.0079 | 0.33 | 0.99 | 0.99 | 828 | 5.59 | 0.164 |

An ordinary program of 16 targets (half of them poses; 20 in URScript) repeated, with a model that has two compliant
joints; processor time on a machine that others used at the same time, peak memory of the whole process.

| file | repeats | targets | file, MB | s | peak, MB | before, s |
| --- | --- | --- | --- | --- | --- | --- |
| RAPID | 100 | 1600 | 0.29 | 0.21 | 17 | 4.8 |
| RAPID | 200 | 3200 | 0.59 | 0.41 | 23 | |
| RAPID | 400 | 6400 | 1.17 | 0.80 | 34 | |
| RAPID | 2000 | 32 000 | 5.85 | 4.1 | 127 | aborted at 5 GB |
| KRL | 100 | 1600 | 0.16 | 0.20 | 16 | 4.5 |
| KRL | 400 | 6400 | 0.65 | 0.81 | 31 | |
| KRL | 2000 | 32 000 | 3.24 | 4.2 | 105 | |
| URScript | 100 | 2000 | 0.22 | 0.24 | 17 | 4.7 |
| URScript | 400 | 8000 | 0.88 | 0.96 | 32 | |
| URScript | 2000 | 40 000 | 4.39 | 4.8 | 117 | |
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

sys.path.insert(0, str(Path(__file__).parent))
import arms as arm_kinds
import programs as p

DATA = Path(__file__).parent.parent / "data" / "programs"


def run(binary, *arguments):
    """Exit status, messages, processor seconds and peak memory in MB."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    child = subprocess.Popen([binary, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    said = child.stdout.read().decode(errors="replace")
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    del before
    return child.returncode, said, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def pose_of(at, rotation):
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = rotation, at
    return out


def apart(a, b):
    """mm and mrad between two poses."""
    turn = a[:3, :3].T @ b[:3, :3]
    skew = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return float(np.linalg.norm(a[:3, 3] - b[:3, 3])), 1e3 * float(np.arcsin(min(1, np.linalg.norm(skew))))


def solved(robot, tool, pose, near):
    """The controller: joint values near some others at which the nominal robot has its tool at a pose."""

    def missing(q):
        here = robot.pose(q) @ tool
        turn = sum(np.cross(here[:3, k], pose[:3, k]) for k in range(3)) / 2
        return np.r_[(pose[:3, 3] - here[:3, 3]) / 300, turn]

    return least_squares(missing, near, xtol=1e-15, ftol=1e-15, gtol=1e-15).x


# --- tools ---------------------------------------------------------------------------------------------


def good_poses(rng, nominal, count):
    """Joint values (degrees) away from singular poses, and whether the wrist is behind axis 1."""
    shown, behind = [], []
    low, high = np.array(p.LIMITS, float).T
    while len(shown) < count:
        q = np.round(rng.uniform(low, high), 3)
        q[5] = np.round(rng.uniform(-170, 170), 3)
        still = np.radians(np.r_[0, q[1:]])
        wrist = (p.motion(*nominal.joints[1], still[1]) @ p.motion(*nominal.joints[2], still[2]) @ [302, 0, 630, 1])[0]
        bent = np.arctan2(302, 70) + np.radians(q[2])
        inside = all(lo + 3 < v < hi - 3 for v, (lo, hi) in zip(q, p.LIMITS))
        if abs(q[4]) > 15 and abs(wrist) > 80 and 0.3 < bent < 2.6 and inside:
            shown.append(q)
            behind.append(wrist < 0)
    return np.array(shown), behind


def written(language, tool, poses, shown, behind):
    """A program with this tool that goes to these poses of it."""
    at, turn = tool[:3, 3], tool[:3, :3]
    f = lambda values, digits: ",".join(f"{v:.{digits}f}" for v in values)
    if language == "rapid":
        lines = ["MODULE m", f"PERS tooldata tT:=[TRUE,[[{f(at, 6)}],[{f(p.quaternion(turn), 10)}]],[-1,[0,0,0],[1,0,0,0],0,0,0]];"]
        for k, (pose, q) in enumerate(zip(poses, shown)):
            cf = f"[{p.quadrant(q[0])},{p.quadrant(q[3])},{p.quadrant(q[5])},{int(q[4] < 0) + 4 * int(behind[k])}]"
            body = f"[[{f(pose[:3, 3], 6)}],[{f(p.quaternion(pose[:3, :3]), 10)}],{cf},[9E9,9E9,9E9,9E9,9E9,9E9]]"
            lines.append(f"CONST robtarget p{k}:={body};")
        return "\n".join([*lines, "PROC main()", *(f"MoveJ p{k},v9,fine,tT;" for k in range(len(poses))), "ENDPROC", "ENDMODULE", ""])
    if language == "krl":
        frame = lambda m: ",".join(f"{n} {v:.8f}" for n, v in zip("XYZABC", [*m[:3, 3], *p.zyx(m[:3, :3])]))
        lines = ["DEF m()", f"$TOOL={{{frame(tool)}}}"]
        for k, (pose, q) in enumerate(zip(poses, shown)):
            t = sum(1 << i for i, v in enumerate(q) if v < 0)
            lines.append(f"PTP {{{frame(pose)},S {int(behind[k])},T {t}}}")
        return "\n".join([*lines, "END", ""])
    if language == "urscript":
        body = lambda m: ", ".join(f"{v:.9f}" for v in [*m[:3, 3] / 1000, *p.rotation_vector(m[:3, :3])])
        lines = ["def m():", f"  set_tcp(p[{body(tool)}])"]
        for pose, q in zip(poses, shown):
            near = ", ".join(f"{v:.6f}" for v in np.radians(q))
            lines.append(f"  movej(get_inverse_kin(p[{body(pose)}], qnear=[{near}]), a=1)")
        return "\n".join([*lines, "end", ""])
    moves, positions = [], []
    for k, (pose, q) in enumerate(zip(poses, shown)):
        moves.append(f"{k + 1}:J P[{k + 1}] 9% FINE ;")
        turns = ", ".join(str(int(np.round(q[i] / 360))) for i in (0, 3, 5))
        letters = f"{'N' if q[4] < 0 else 'F'} U {'B' if behind[k] else 'T'}"
        numbers = [f"{n} = {v:.6f} mm" for n, v in zip("XYZ", pose[:3, 3] - p.WORLD)]
        numbers += [f"{n} = {v:.8f} deg" for n, v in zip("WPR", p.zyx(pose[:3, :3])[::-1])]
        positions.append(f"P[{k + 1}]{{\n GP1:\n UF : 0, UT : 3, CONFIG : '{letters}, {turns}',\n {', '.join(numbers)}\n}};")
    return "\n".join(["/PROG M", "/MN", *moves, "/POS", *positions, "/END", ""])


def poses_in(language, text, count):
    """What a controller reads of such a program."""
    number = r"-?\d+\.?\d*(?:[eE][+-]?\d+)?"
    import re

    out = []
    if language == "rapid":
        for line in (l for l in text.splitlines() if "robtarget" in l):
            v = [float(x) for x in re.findall(number, line[line.index(":=") :])]
            w, x, y, z = np.array(v[3:7]) / np.linalg.norm(v[3:7])
            r = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                          [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                          [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
            out.append(pose_of(v[:3], r))
    elif language == "krl":
        for line in (l for l in text.splitlines() if l.startswith("PTP")):
            out.append(zyx_pose([float(x) for x in re.findall(rf"[XYZABC] ({number})", line)]))
    elif language == "urscript":
        for line in (l for l in text.splitlines() if "get_inverse_kin" in l):
            v = [float(x) for x in re.findall(number, line[line.index("p[") : line.index("]")])]
            out.append(pose_of(np.array(v[:3]) * 1000, p.rotation(v[3:6])))
    else:
        for block in text.split("P[")[-count:]:
            v = [float(x) for x in re.findall(rf"[XYZWPR] = ({number})", block)]
            out.append(zyx_pose([*(v[:3] + p.WORLD), *v[:2:-1]]))
    return out


def zyx_pose(v):
    a, b, c = np.radians(v[3:6])
    return pose_of(v[:3], p.rotation([0, 0, a]) @ p.rotation([0, b, 0]) @ p.rotation([c, 0, 0]))


def typed(language, tool):
    """--tool as a person of that language types it."""
    turn = {"urscript": p.rotation_vector, "krl": p.zyx, "fanuc-ls": lambda r: p.zyx(r)[::-1]}.get(language, p.quaternion)
    return ",".join(f"{v:.8f}" for v in [*tool[:3, 3], *turn(tool[:3, :3])])


ENDINGS = {"rapid": "mod", "krl": "src", "urscript": "script", "fanuc-ls": "ls"}


def tools(binary, before, count, folder):
    nominal, real = p.six()
    model = folder / "arm.model.json"
    effects = "joint-zero-offset,link-length,joint-compliance"
    assert run(binary, "identify", DATA / "arm.json", "--effects", effects, "--out", model)[0] == 0
    old = folder / "arm.before.json"
    if before:
        assert run(before, "identify", DATA / "arm.json", "--effects", effects, "--out", old)[0] == 0
    print("| language | programs | way | exit 0 / 1 / 2 | targets driven | left | RMS miss, mm | largest, mm | mrad |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for language, ending in ENDINGS.items():
        rng = np.random.default_rng(11)
        ways = [("no option", binary, model, [])]
        if language != "fanuc-ls":
            ways += [("--as-programmed", binary, model, ["--as-programmed"])]
        ways += [("--tool …", binary, model, None), ("--as-modelled", binary, model, ["--as-modelled"])]
        if before:
            ways.insert(0, ("before", before, old, []))
        found = {way[0]: ([0, 0, 0], [], [0]) for way in ways}
        for _ in range(count):
            tool = pose_of(rng.uniform(-150, 150, 3), p.rotation(rng.uniform(-0.6, 0.6, 3)))
            shown, behind = good_poses(rng, nominal, 4)
            wanted = [nominal.pose(np.radians(q)) @ tool for q in shown]
            source = folder / f"w.{ending}"
            source.write_text(written(language, tool, wanted, shown, behind))
            for way, which, by, options in ways:
                options = ["--tool", typed(language, tool)] if options is None else options
                out = folder / f"o.{ending}"
                out.unlink(missing_ok=True)
                status, said, *_ = run(which, "compensate", by, source, "--out", out, "--force", *options)
                found[way][0][min(status, 2)] += 1
                if not out.exists():
                    assert status == 2 and ("tool" in said), said
                    continue
                meta = json.loads(Path(f"{out}.meta.json").read_text())["targets"]
                for goal, pose, q, target in zip(wanted, poses_in(language, out.read_text(), 4), shown, meta):
                    if not target["corrected"]:
                        found[way][2][0] += 1
                        continue
                    u = solved(nominal, tool, pose, np.radians(q))
                    found[way][1].append(apart(real.pose(u) @ tool, goal))
        for way, (statuses, misses, left) in found.items():
            cells = ["-"] * 3
            if misses:
                mm, mrad = np.array(misses).T
                cells = [f"{np.sqrt(np.mean(mm**2)):.4f}", f"{mm.max():.4f}", f"{mrad.max():.4f}"]
            print(f"| {language} | {count} | {way} | {' / '.join(map(str, statuses))} | {len(misses)} | {left[0]} | {' | '.join(cells)} |", flush=True)


# --- singular ------------------------------------------------------------------------------------------


def kind(name):
    """A kind of arms.py with hidden errors, as a robot of programs.py; its limits."""
    rows, at = arm_kinds.ARMS[name]
    joints = [(k, a, q) for k, a, q, _, _ in rows]
    tool = pose_of(at, p.rotation([0.2, -0.3, 0.4]))
    nominal, real = p.Robot(joints, tool), p.Robot(joints, tool)
    rng = np.random.default_rng(5)
    for i in range(1, len(joints)):
        turn, shift = rng.normal(0, 0.6e-3, 3), rng.normal(0, 0.3, 3)
        # Along its axis a turn is the zero's; what the first axis shares with the frame is the frame's.
        a = np.asarray(joints[i][1], float)
        turn -= a * (a @ turn)
        if i == 1:
            turn[2] = shift[2] = 0
        real.links[i] = p.small(turn, shift, joints[i][2])
        if joints[i][0] == "revolute":
            real.zeros[i] = np.radians(rng.normal(0, 0.15))
    real.tool = tool @ pose_of([0.8, -0.5, 0.6], np.eye(3))
    return nominal, real, np.array([r[3:] for r in rows], float)


# Where an arm is singular: a joint and the value at which it is, degrees.
SINGULAR = {"six": (4, 0.0), "parallel": (4, 0.0), "seven": (5, 0.0), "scara": (1, 0.0)}


def inner(nominal, shown):
    return np.asarray(shown) * [1 if j[0] == "prismatic" else np.pi / 180 for j in nominal.joints]


def table(nominal, rows):
    units = ["mm" if j[0] == "prismatic" else "deg" for j in nominal.joints]
    lines = [",".join(f"q{i + 1}_{u}" for i, u in enumerate(units))]
    return "\n".join([*lines, *(",".join(f"{v:.5f}" for v in row) for row in rows)]) + "\n"


def driven(binary, model, folder, nominal, real, rows):
    """Statuses by target, errors before and after (mm, mrad), and the joint moves (rad or mm)."""
    source, out = folder / "s.csv", folder / "s.out.csv"
    source.write_text(table(nominal, rows))
    status, said, *_ = run(binary, "compensate", model, source, "--out", out, "--force", "--load", "0")
    assert status in (0, 1), said
    meta = json.loads((folder / "s.out.csv.meta.json").read_text())
    corrected = np.loadtxt(out, delimiter=",", skiprows=1, ndmin=2)
    good = np.array([t["corrected"] for t in meta["targets"]])
    reasons = sorted({f"{t['because']}: {t['says']}" for t in meta["targets"] if not t["corrected"]})
    before, after, moves = [], [], []
    for q, u in zip(inner(nominal, rows), inner(nominal, corrected)):
        goal = nominal.pose(q)
        before.append(apart(real.pose(q), goal))
        after.append(apart(real.pose(u), goal))
        moves.append(u - q)
    return good, np.array(before), np.array(after), np.array(moves), reasons, meta


def without_frame(now, goals):
    """What is left of positions once one rigid motion of all of them is taken out: the frame of the session, which
    a base of the robot has to be brought into anyway."""
    a, b = np.array([m[:3, 3] for m in now]), np.array([m[:3, 3] for m in goals])
    ca, cb = a.mean(0), b.mean(0)
    u, _, vt = np.linalg.svd((a - ca).T @ (b - cb))
    turn = vt.T @ np.diag([1, 1, np.linalg.det(vt.T @ u.T)]) @ u.T
    return np.linalg.norm((a - ca) @ turn.T + cb - b, axis=1)


def singular(binary, before, count, folder):
    print("| arm | targets | binary | left | mm before, RMS | after, RMS | largest | mrad before, largest | after, 99 % | largest | in part | largest joint move, ° | largest change between steps, ° |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, (joint, at) in SINGULAR.items():
        nominal, real, limits = kind(name)
        p.session(folder, name, nominal, real, limits, 150, [0.0], 9)
        rng = np.random.default_rng(77)
        anywhere = rng.uniform(limits[:, 0], limits[:, 1], (1000, len(limits)))
        near = anywhere.copy()
        near[:, joint] = at + rng.uniform(-3, 3, 1000)
        paths = []
        for _ in range(5):
            path = np.repeat(rng.uniform(limits[:, 0] + 30, limits[:, 1] - 30, (1, len(limits))), 241, axis=0)
            path[:, joint] = np.linspace(at - 6, at + 6, 241)
            paths.append(path)
        sets = [("anywhere", anywhere), ("within 3° of singular", near), ("paths through it", np.concatenate(paths))]
        for which in [before, binary] if before else [binary]:
            model = folder / f"{name}.model.json"
            status, said, *_ = run(which, "identify", folder / f"{name}.json", "--no-prior", "--out", model, "--force")
            assert status == 0, said
            turning = [k for k, j in enumerate(nominal.joints) if j[0] == "revolute"]
            for what, rows in sets:
                good, was, now, moves, reasons, meta = driven(which, model, folder, nominal, real, rows)
                u = inner(nominal, rows) + moves
                mm = without_frame([real.pose(x) for x in u[good]], [nominal.pose(x) for x in inner(nominal, rows)[good]])
                jump = "-"
                if what.startswith("paths"):
                    change = np.abs(np.diff(moves[:, turning], axis=0))
                    kept = good[1:] & good[:-1] & (np.arange(1, len(rows)) % 241 != 0)
                    jump = f"{np.degrees(change[kept].max()):.3f}" if kept.any() else "-"
                partly = sum(t["corrected"] and t["after_mrad"] > 1e-3 for t in meta["targets"])
                print(f"| {name} | {what} | {'before' if which == before else 'now'} | {(~good).sum()} of {len(rows)} | {np.sqrt(np.mean(was[good, 0] ** 2)):.3f} "
                      f"| {np.sqrt(np.mean(mm**2)):.4f} | {mm.max():.4f} | {was[good, 1].max():.2f} | {np.percentile(now[good, 1], 99):.2f} | {now[good, 1].max():.2f} | {partly} "
                      f"| {np.degrees(np.abs(moves[good][:, turning]).max()):.2f} | {jump} |", flush=True)
                for reason in reasons[:3]:
                    print(f"    {reason}", file=sys.stderr)


# --- times ---------------------------------------------------------------------------------------------


def times(binary, before, count, folder):
    model = folder / "arm.model.json"
    effects = "joint-zero-offset,link-length,joint-compliance"
    print("| file | repeats | targets | MB | binary | s | peak MB | times the file |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for which in [before, binary] if before else [binary]:
        assert run(which, "identify", DATA / "arm.json", "--effects", effects, "--out", model, "--force")[0] == 0
        base = run(which, "compensate", model, DATA / "cell.script", "--out", folder / "b.script", "--force", "--load", "0")
        cases = [(n, e) for e in ("mod", "src", "script", "ls") for n in (100, 200, 400, 2000)]
        rng = np.random.default_rng(3)
        rows = rng.uniform([-100, -60, -60, -100, 20, -100], [100, 60, 30, 100, 80, 100], (200_000, 6))
        (folder / "big.csv").write_text(table(p.six()[0], rows))
        distinct = folder / "big.src"
        nominal = p.six()[0]
        lines = ["DEF m()"]
        for k, q in enumerate(rows[:5000]):
            m = nominal.pose(np.radians(q))
            t = sum(1 << i for i, v in enumerate(q) if v < 0)
            body = ",".join(f"{n} {v:.4f}" for n, v in zip("XYZABC", [*m[:3, 3], *p.zyx(m[:3, :3])]))
            lines.append(f"LIN {{{body},S 0,T {t}}}")
        distinct.write_text("\n".join([*lines, "END", ""]))
        for repeats, ending in [*cases, (1, "big.csv"), (1, "big.src"), (10, "big.src"), (20, "big.src")]:
            if which == before and (repeats > 400 or ending in ("big.csv",) or (ending == "big.src" and repeats > 1)):
                continue
            large = ending.startswith("big")
            body = (folder / ending if large else DATA / f"cell.{ending}").read_bytes()
            if ending == "ls":
                body, repeats = positions(body.decode("latin-1"), repeats).encode("latin-1"), repeats
                source = folder / "r.ls"
                source.write_bytes(body)
            else:
                source = folder / f"r.{ending.split('.')[-1]}"
                source.write_bytes(body * repeats)
            size = source.stat().st_size / 1e6
            out = folder / f"t.{source.suffix[1:]}"
            status, said, seconds, peak = run(which, "compensate", model, source, "--out", out, "--force", "--load", "0")
            count = said.split(" targets corrected")[0].split()[-1] if " targets corrected" in said else f"status {status}"
            print(f"| {ending} | {repeats} | {count} | {size:.2f} | {'before' if which == before else 'now'} | {seconds:.2f} | {peak:.0f} "
                  f"| {(peak - base[3]) / size:.1f} |", flush=True)


def positions(text, repeats):
    """A listing with its positions again and again, each with a number of its own."""
    head, rest = text.split("/POS")
    blocks = ["P[" + b for b in rest.split("/END")[0].split("P[")[1:]]
    moves = [l for l in head.split("/MN")[1].splitlines() if ":J P[" in l]
    lines, all_blocks, number = [], [], 0
    for _ in range(repeats):
        for block in blocks:
            number += 1
            all_blocks.append(f"P[{number}]" + block[block.index("{") :])
            lines.append(f"{number}:J P[{number}] 100% FINE    ;")
    assert moves
    return "\n".join([head.split("/MN")[0] + "/MN", *lines, "/POS"]) + "\n" + "".join(all_blocks) + "/END\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--before")
    parser.add_argument("--only", choices=["tools", "singular", "times"])
    parser.add_argument("--count", type=int, default=100)
    options = parser.parse_args()
    for name, part in (("tools", tools), ("singular", singular), ("times", times)):
        if options.only in (None, name):
            print(f"\n## {name}\n")
            with tempfile.TemporaryDirectory() as folder:
                part(options.binary, options.before, options.count, Path(folder))


if __name__ == "__main__":
    main()
