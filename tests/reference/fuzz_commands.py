#!/usr/bin/env python3
"""Mutates the repository's own files and runs whole commands of the program on them.

    fuzz_commands.py PROGRAM SECONDS [SEED [KEEP]]

Every command reads a sound set of files in which one or two files were damaged: bytes, numbers, cells,
lines, keys and whole values, cut, doubled, exchanged, repeated a thousand times, or replaced by what
another format holds. Each run has 2 GiB of address space and 60 s of processor time. It fails

- with an exit status that is none of 0, 1, 2, or by a signal;
- with "panicked" or "internal error" among its messages, which are longer than a megabyte;
- when it runs into a limit;
- when it ends with 2 and has written something, or leaves an unfinished file behind;
- when it ends with 0 and --json and its output is not one JSON document.

What failed is kept in KEEP (default: fuzz-commands in the folder for temporary files), with its command. The
exit status is 1 where anything failed. One line a command is printed at the end, as a table.
"""

import glob
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MEMORY = 2 << 30
SECONDS = 60
SPEND = 20  # of processor time, beyond which a run is listed as slow

TOKENS = [b'"', b"{", b"}", b"[", b"]", b",", b"\n", b"\r", b"\0", b"-", b"1e400", b"-1e400", b"nan", b"inf", b"1e-320", b"\\u",
          b"\\ud800", b"9999999999999999999", b".", b";", b"\t", b"\xff\xfe", b"\xef\xbb\xbf", "é".encode(), "中".encode(),
          b"null", b"true", b"<", b">", b"&a;", b"<!--", b"0x10", b"/*", b"#", b"!", b"'", b"::", b"e", b"%s", b"../x", b"/dev/zero"]
NUMBERS = ["0", "-0", "1", "-1", "1e9", "-1e9", "1e7", "9.99e6", "1e-9", "1e300", "1e-300", "360", "720", "90", "-90", "180", "0.5",
           "2147483648", "18446744073709551616", "0.1e-5", "1.7976931348623157e308", "3", "7", "100", "101", "1e6", "5e-324"]


def path(*parts):
    return os.path.join(ROOT, *parts)


def read(name):
    with open(name, "rb") as file:
        return file.read()


# --- what is damaged ------------------------------------------------------------------------------

def change_value(random_, value):
    """Another value in place of one of JSON."""
    kind = random_.randrange(12)
    if kind == 0:
        return None
    if kind == 1:
        return []
    if kind == 2:
        return {}
    if kind == 3:
        return random_.choice(["", "x", "fit", "T1", "a" * 5000, "\u202e\x07", "../up", "/dev/zero", "1"])
    if kind == 4 and isinstance(value, list):
        return value + value
    if kind == 5 and isinstance(value, list):
        return value[: len(value) // 2]
    if kind == 6 and isinstance(value, list) and value:
        return value * random_.choice([3, 50, 400])
    if kind == 7 and isinstance(value, (int, float)) and not isinstance(value, bool):
        return value * random_.choice([-1, 0, 1e3, 1e-3, 1e12, 57.3, 1.5])
    if kind == 8:
        return [value]
    if kind == 9:
        return random_.choice([True, False])
    return float(random_.choice(NUMBERS)) if abs(float(random_.choice(NUMBERS))) < 1e308 else 0


def places(value, parent=None, key=None, into=None):
    into = [] if into is None else into
    if parent is not None:
        into.append((parent, key))
    if isinstance(value, dict):
        for name in value:
            places(value[name], value, name, into)
    elif isinstance(value, list):
        for k in range(min(len(value), 60)):
            places(value[k], value, k, into)
    return into


def damage_json(random_, data):
    document = json.loads(data)
    for _ in range(random_.choice([1, 1, 1, 2, 3])):
        where = places(document)
        if not where:
            break
        parent, key = random_.choice(where)
        kind = random_.randrange(6)
        if kind == 0:
            del parent[key]
        elif kind == 1 and isinstance(parent, dict):
            parent[random_.choice(["", "x", "effect", "joint", "name", key + "x"])] = parent[key]
        elif kind == 2:
            other, at = random_.choice(where)
            try:
                parent[key] = json.loads(json.dumps(other[at]))
            except (KeyError, IndexError):
                pass
        else:
            parent[key] = change_value(random_, parent[key])
    return json.dumps(document).encode()


def damage_lines(random_, data):
    lines = data.split(b"\n")
    at, other = random_.randrange(len(lines)), random_.randrange(len(lines))
    kind = random_.randrange(6)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(other, lines[at])
    elif kind == 2:
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 3:
        lines[at:at] = [lines[at]] * random_.choice([10, 300])
    elif kind == 4:
        lines = lines[: at + 1]
    else:
        lines = lines[:1] + lines[1:][::-1]
    return b"\n".join(lines)


def damage_cells(random_, data):
    sign = max([b",", b";", b"\t", b" "], key=data.count)
    lines = data.split(b"\n")
    column = random_.randrange(max(1, lines[0].count(sign) + 1))
    rows = range(len(lines)) if random_.randrange(3) == 0 else [random_.randrange(len(lines))]
    kind = random_.randrange(5)
    other = random_.randrange(max(1, lines[0].count(sign) + 1))
    number = random_.choice(NUMBERS).encode()
    for row in rows:
        cells = lines[row].split(sign)
        if column >= len(cells):
            continue
        if kind == 0:
            del cells[column]
        elif kind == 1:
            cells[column] = number
        elif kind == 2:
            cells[column] = b""
        elif kind == 3 and other < len(cells):
            cells[column], cells[other] = cells[other], cells[column]
        else:
            cells[column] = cells[column] + number
        lines[row] = sign.join(cells)
    return b"\n".join(lines)


def damage_numbers(random_, data):
    at = [k for k in range(len(data)) if data[k:k + 1].isdigit() and not data[k - 1:k].isdigit()]
    if not at:
        return data
    start = random_.choice(at)
    end = start
    while end < len(data) and data[end:end + 1] in b"0123456789.eE+-":
        end += 1
    return data[:start] + random_.choice(NUMBERS).encode() + data[end:]


def damage_bytes(random_, data):
    data = bytearray(data)
    for _ in range(random_.choice([1, 1, 2, 5, 20])):
        if not data:
            break
        at, size = random_.randrange(len(data)), random_.choice([1, 2, 8, 40, 400])
        kind = random_.randrange(7)
        if kind == 0:
            data[at] ^= 1 << random_.randrange(8)
        elif kind == 1:
            data[at] = random_.randrange(256)
        elif kind == 2:
            data[at:at] = random_.choice(TOKENS)
        elif kind == 3:
            del data[at:at + size]
        elif kind == 4:
            other = random_.randrange(len(data))
            data[other:other] = data[at:at + size]
        elif kind == 5:
            data[at:at + size] = data[at:at + size] * random_.choice([2, 10, 1000])
        elif random_.randrange(4) == 0:
            del data[at:]
        if len(data) > 4 << 20:
            del data[4 << 20:]
    return bytes(data)


def damaged(random_, name, data, others):
    ways = [damage_bytes]
    if name.endswith(".json"):
        ways += [damage_json] * 4 + [damage_numbers]
    elif not name.endswith((".mcap", ".stl")):
        ways += [damage_lines, damage_cells, damage_cells, damage_numbers, damage_numbers]
    if random_.randrange(60) == 0:
        return random_.choice(others)
    for _ in range(random_.choice([1, 1, 1, 2, 3])):
        try:
            data = random_.choice(ways)(random_, data)
        except (ValueError, RecursionError):
            data = damage_bytes(random_, data)
    return data


# --- what is run ----------------------------------------------------------------------------------

class Case:
    """A command, the files that it reads (name in its folder: content), and the ones that are damaged."""

    def __init__(self, name, arguments, files, damage=None, weight=1.0):
        self.name, self.arguments, self.files = name, arguments, files
        self.damage = damage or list(files)
        self.weight = weight


def session(*parts):
    """A session's document and its samples."""
    files = {parts[-1] + ".json": read(path(*parts) + ".json")}
    own = json.loads(files[parts[-1] + ".json"])
    own["samples"].pop("sha256", None)
    files[parts[-1] + ".json"] = json.dumps(own).encode()
    if os.path.exists(path(*parts) + ".csv"):
        files[parts[-1] + ".csv"] = read(path(*parts) + ".csv")
    return files


def in_folder(program, files, arguments):
    """What a command writes in a folder with these files, for the sound inputs of others."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        ran = subprocess.run([program, *arguments], cwd=folder, capture_output=True)
        if ran.returncode not in (0, 1):
            sys.exit(f"{arguments}: {ran.stderr.decode()[:500]}")
        return {name: read(os.path.join(folder, name)) for name in os.listdir(folder)}


URDF = b"""<robot name="r"><link name="base"/><link name="a"><inertial><origin xyz="0 0 .1"/><mass value="2"/></inertial></link>
<link name="b"/><link name="tip"/>
<joint name="j1" type="revolute"><origin xyz="0 0 .3" rpy="0 0 .2"/><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="j2" type="continuous"><origin xyz=".3 0 .1" rpy="1.5 0 0"/><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
<joint name="f" type="fixed"><origin xyz=".2 0 0"/><parent link="b"/><child link="tip"/></joint></robot>"""
MJCF = b"""<mujoco model="m"><compiler angle="radian" eulerseq="ZyX" autolimits="true"/>
<default><joint axis="0 1 0"/><default class="c"><joint type="slide" range="-1 1"/></default></default>
<worldbody><body name="base"><body name="a" pos="0 0 .4" xyaxes="1 0 0 0 1 0" childclass="c"><inertial pos="0 0 0" mass="1"/>
<joint name="j" ref="0.1" pos="0 0 .1"/><body name="tip" pos=".1 0 .2" axisangle="0 0 1 2"><joint name="k" class="main"/>
</body></body></body></worldbody></mujoco>"""


def cases(program):
    all_ = []
    for name, weight in [("paper-30", 3.0), ("paper-run", 2.0), ("lamp-commissioning", 2.0)]:
        files = session("sessions", name)
        all_.append(Case("identify", ["identify", name + ".json", "--json"], files, weight=weight))
        all_.append(Case("identify", ["identify", name + ".json", "--method", "regional", "--out", "out.json"], files))
        all_.append(Case("diagnose", ["diagnose", name + ".json", "--json"], files, weight=weight))
        all_.append(Case("plan", ["plan", name + ".json", "--json", "--out", "out.csv"], files))
        all_.append(Case("report", ["report", name + ".json", "--out", "out.pdf"], files))
    for at in sorted(glob.glob(path("tests/data/observations/*.csv"))) + sorted(glob.glob(path("tests/data/arms/*-60.csv"))):
        folder, name = os.path.split(at[:-4])
        files = session(folder, name)
        all_.append(Case("identify", ["identify", name + ".json", "--json"], files, weight=0.5))
        all_.append(Case("diagnose", ["diagnose", name + ".json", "--json"], files, weight=0.15))
        all_.append(Case("plan", ["plan", name + ".json", "--poses", "5"], files, weight=0.05))
    for name in ("poses", "paths"):
        files = session("tests/data/standards", name)
        all_.append(Case("standards", ["standards", name + ".json", "--json"], files))

    paper, arm = session("sessions", "paper-run"), session("tests/data/arms", "six-60")
    one = in_folder(program, paper, ["diagnose", "paper-run.json", "--out", "m.json"])
    six = in_folder(program, arm, ["identify", "six-60.json", "--out", "m.json"])
    urdf_session = json.loads(session("sessions", "paper-30")["paper-30.json"])
    for files, model, own in [(paper, one, "paper-run"), (arm, six, "six-60")]:
        files = dict(files, **{"m.json": model["m.json"]})
        all_.append(Case("verify", ["verify", "m.json", own + ".json", "--json"], files, ["m.json"], 2.0))
        all_.append(Case("verify", ["verify", "m.json", own + ".json", "--json"], files, weight=0.5))
        alone = {"m.json": model["m.json"]}
        for kind in "linuxcnc urdf mjcf dh ur-kinematics lerobot twincat-nc twincat-cnc sinumerik csv c-header".split():
            out = "out." + {"urdf": "urdf", "mjcf": "xml"}.get(kind, "csv")
            all_.append(Case("export", ["export", "m.json", "--to", kind, "--out", out, "--json"], alone, weight=0.4))
        all_.append(Case("report", ["report", "m.json", "--out", "out.html", "--json"], alone))
        all_.append(Case("report", ["report", "m.json", "--out", "out.pdf"], alone))
        all_.append(Case("plan", ["plan", "m.json", "--json"], alone, weight=0.3))
        all_.append(Case("history", ["history", ".", "--json"], files))
    details = {"m.json": one["m.json"], "d.json": json.dumps({
        "format": "truepose-details/1", "customer": "A", "serial_number": "1", "tolerance_mm": 0.2, "date": "2026-01-01"}).encode()}
    all_.append(Case("report", ["report", "m.json", "--details", "d.json", "--out", "out.html"], details, ["d.json"]))

    targets = {"m.json": one["m.json"], "t.csv": b"q1_deg\n10\n20.5\n-30\n"}
    all_.append(Case("compensate", ["compensate", "m.json", "t.csv", "--out", "out.csv", "--json"], targets))
    programs = session("tests/data/programs", "arm")
    model = in_folder(program, programs, ["identify", "arm.json", "--out", "m.json"])["m.json"]
    for name, kind in [("cell.ls", "fanuc-ls"), ("cell.mod", "rapid"), ("cell.script", "urscript"), ("cell.src", "krl"),
                       ("joints.csv", "csv"), ("poses.csv", "csv")]:
        files = {"m.json": model, name: read(path("tests/data/programs", name))}
        arguments = ["compensate", "m.json", name, "--as", kind, "--as-modelled", "--out", "out" + os.path.splitext(name)[1]]
        all_.append(Case("compensate", arguments, files, [name], 1.5))
        all_.append(Case("compensate", arguments, files, ["m.json"], 0.3))

    robot = read(path("tests/data/imports/robot.json"))
    arm_robot = read(path("tests/data/imports/arm.json"))
    for name, kind, of, more in [
            ("sa.txt", "tracker", robot, ["--unit", "in", "--commands", "c.csv", "--match", "name"]),
            ("controller-log.csv", "csv", robot, ["--confirm"]), ("column-utf16.csv", "csv", robot, []),
            ("drawwire-de.txt", "csv", robot, []), ("iso230-long.txt", "iso230", robot, []),
            ("iso230-wide.csv", "iso230", robot, []), ("motive.csv", "optitrack", robot, ["--commands", "c.csv"]),
            ("trajectory.txt", "tum", robot, ["--commands", "c.csv"]), ("ballbar.csv", "ballbar", robot, ["--commands", "c.csv"]),
            ("board-rvec.csv", "board", arm_robot, ["--commands", "c.csv"]),
            ("board-quaternion.csv", "board", arm_robot, ["--commands", "c.csv"]), ("tiny.mcap", "mcap", robot, []),
            ("tiny-zstd.mcap", "mcap", robot, []), ("arm-standing.mcap", "mcap", arm_robot, []),
            ("arm-json.mcap", "mcap", arm_robot, []), ("arm-ros2.mcap", "mcap", arm_robot, [])]:
        commands = {"sa.txt": "commands-by-name.csv", "ballbar.csv": "ballbar-commands.csv"}.get(name, "commands-in-order.csv")
        commands = "board-commands.csv" if name.startswith("board") else commands
        files = {name: read(path("tests/data/imports", name)), "robot.json": of, "c.csv": read(path("tests/data/imports", commands))}
        arguments = ["import", name, "--as", kind, "--robot", "robot.json", "--out", "out.json", *more]
        all_.append(Case("import", arguments, files, [name], 0.8))
        all_.append(Case("import", arguments, files, weight=0.1))

    for at in sorted(glob.glob(path("sessions/*.scenario.json"))):
        files = {"s.json": read(at)}
        all_.append(Case("simulate", ["simulate", "s.json", "--out", "out.json"], files))
    for kind, text, name in [("urdf", URDF, "r.urdf"), ("mjcf", MJCF, "r.xml")]:
        own = dict(urdf_session, robot={"name": "r", kind: {"file": name, "base": "base", "tip": "tip"}})
        files = {"r.json": json.dumps(own["robot"]).encode(), name: text}
        all_.append(Case("plan", ["plan", "r.json", "--poses", "4", "--json"], files, [name], 1.0))
    return all_


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_FSIZE, (256 << 20, 256 << 20))


def judged(case, code, out, err, folder, before, spent):
    """What is wrong with a run; None: nothing."""
    said = err.decode(errors="replace")
    if spent >= SECONDS or code in (-24, -9):
        return f"ran into the limit of {SECONDS} s"
    if code not in (0, 1, 2):
        return f"ended with {code}"
    if "panicked" in said or "internal error" in said:
        return "panicked"
    if len(err) > 1 << 20:
        return f"{len(err)} bytes of messages"
    now = sorted(os.listdir(folder))
    if any(name.startswith(".truepose-") for name in now):
        return "an unfinished file is left"
    if code == 2 and now != before:
        return "ended with 2 and wrote " + ", ".join(set(now) - set(before))
    if code == 0 and "--json" in case.arguments:
        try:
            json.loads(out)
        except (ValueError, RecursionError):
            return "its output is not one JSON document"
    if code == 1 and case.name != "compensate" and "memory" not in said:
        return "ended with 1"
    return None


def main():
    program, seconds = os.path.abspath(sys.argv[1]), float(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    keep = sys.argv[4] if len(sys.argv) > 4 else os.path.join(tempfile.gettempdir(), "fuzz-commands")
    random_ = random.Random(seed)
    all_ = cases(program)
    others = [data for case in all_ for data in case.files.values()]
    counts, failures, began = {}, 0, time.monotonic()
    while time.monotonic() - began < seconds:
        case = random_.choices(all_, [case.weight for case in all_])[0]
        files = dict(case.files)
        for name in {random_.choice(case.damage) for _ in range(random_.choice([1, 1, 1, 2]))}:
            files[name] = damaged(random_, name, files[name], others)
        folder = tempfile.mkdtemp()
        for name, data in files.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        before, used = sorted(os.listdir(folder)), resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(os.path.join(tempfile.gettempdir(), f"fuzz-out-{os.getpid()}"), "w+b") as out_file, \
                open(os.path.join(tempfile.gettempdir(), f"fuzz-err-{os.getpid()}"), "w+b") as err_file:
            code = subprocess.run([program, *case.arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=out_file, stderr=err_file,
                                  preexec_fn=limits).returncode
            out_file.seek(0)
            err_file.seek(0)
            out, err = out_file.read(), err_file.read()
        now = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime
        row = counts.setdefault(case.name, {"runs": 0, "0": 0, "1": 0, "2": 0, "slowest": 0.0, "cpu": 0.0, "failed": 0})
        row["runs"] += 1
        row[str(code)] = row.get(str(code), 0) + 1
        row["slowest"] = max(row["slowest"], spent)
        row["cpu"] += spent
        wrong = judged(case, code, out, err, folder, before, spent)
        if wrong or spent > SPEND:
            failures += bool(wrong)
            row["failed"] += bool(wrong)
            at = os.path.join(keep, f"{case.name}-{seed}-{sum(r['runs'] for r in counts.values())}")
            shutil.copytree(folder, at, dirs_exist_ok=True)
            with open(os.path.join(at, "COMMAND"), "w") as file:
                file.write(" ".join(case.arguments) + f"\n{wrong}, exit {code}, {spent:.1f} s\n" + err.decode(errors="replace")[:2000])
            print(f"{case.name}: {wrong or 'slow'} ({spent:.1f} s): {at}", flush=True)
        shutil.rmtree(folder, ignore_errors=True)
    print("| command | inputs | exit 0 | exit 2 | exit 1 | slowest, s | failed |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for name in sorted(counts):
        row = counts[name]
        print(f"| `{name}` | {row['runs']} | {row['0']} | {row['2']} | {row['1']} | {row['slowest']:.1f} | {row['failed']} |")
    print(f"{sum(r['runs'] for r in counts.values())} inputs, {failures} failed, {sum(r['cpu'] for r in counts.values()):.0f} s of "
          f"processor time, at most {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024} MB")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
