#!/usr/bin/python3
"""What LinuxCNC itself makes of a compensation file.

    /usr/bin/python3 linuxcnc_comp.py TABLE.comp ANGULAR|LINEAR POSITION...

starts LinuxCNC (package linuxcnc-uspace, which brings the modules `linuxcnc` and the program
`halcmd`) without a display, with one joint whose feedback is its own command, and drives the joint
to every position from below and from above. Each line of the answer is

    position correction_from_below correction_from_above

where a correction is what the controller sends to the motor beyond the commanded position, in the
joint's unit. Nothing is installed, and everything is written to a temporary folder.
"""

import os
import subprocess
import sys
import tempfile
import time

INI = """[EMC]
VERSION = 1.1
MACHINE = one joint
DEBUG = 0

[DISPLAY]
DISPLAY = {script}

[TASK]
TASK = milltask
CYCLE_TIME = 0.001

[RS274NGC]
PARAMETER_FILE = numbers.var

[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
BASE_PERIOD = 0
SERVO_PERIOD = 1000000

[HAL]
HALFILE = joint.hal

[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tool.tbl

[TRAJ]
COORDINATES = {axis}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 1000
MAX_LINEAR_VELOCITY = 1000
DEFAULT_ANGULAR_VELOCITY = 1000
MAX_ANGULAR_VELOCITY = 1000

[KINS]
KINEMATICS = trivkins coordinates={axis}
JOINTS = 1

[AXIS_{axis}]
MIN_LIMIT = -100000
MAX_LIMIT = 100000
MAX_VELOCITY = 1000
MAX_ACCELERATION = 20000

[JOINT_0]
TYPE = {kind}
HOME = 0
MIN_LIMIT = -100000
MAX_LIMIT = 100000
MAX_VELOCITY = 1000
MAX_ACCELERATION = 20000
STEPGEN_MAXACCEL = 40000
FERROR = 1000
MIN_FERROR = 1000
HOME_OFFSET = 0
HOME_SEARCH_VEL = 0
HOME_LATCH_VEL = 0
HOME_SEQUENCE = 0
BACKLASH = 7
COMP_FILE = {table}
COMP_FILE_TYPE = 1
"""

HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net position joint.0.motor-pos-cmd => joint.0.motor-pos-fb
net enable iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
"""


def start(table, kind, positions):
    """Writes the configuration and runs LinuxCNC with this script as its display."""
    with tempfile.TemporaryDirectory() as folder:
        here = os.path.join(folder, "display.py")
        with open(here, "w", encoding="utf-8") as copy, open(__file__, encoding="utf-8") as own:
            copy.write(own.read())
        os.chmod(here, 0o755)
        axis = "A" if kind == "ANGULAR" else "X"
        ini = INI.format(script=here, axis=axis, kind=kind, table=os.path.abspath(table))
        for name, text in (("one.ini", ini), ("joint.hal", HAL), ("tool.tbl", "")):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        answer = os.path.join(folder, "answer")
        wanted = dict(os.environ, COMP_AXIS=axis, COMP_POSITIONS=" ".join(positions), COMP_ANSWER=answer)
        wanted["HOME"] = folder  # it leaves its protocols there
        if os.geteuid() == 0:  # its realtime part insists on another user
            os.chmod(folder, 0o777)
            wanted.setdefault("RTAPI_UID", "65534")
        run = subprocess.run(
            ["linuxcnc", "-r", os.path.join(folder, "one.ini")],
            env=wanted, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=240,
        )
        if not os.path.exists(answer):
            sys.exit(run.stdout.decode(errors="replace"))
        with open(answer, encoding="utf-8") as file:
            print(file.read(), end="")


def drive():
    """The display: drives the joint and notes what the motor is told beyond the command."""
    import linuxcnc

    command, state = linuxcnc.command(), linuxcnc.stat()

    def until(reached):
        end = time.time() + 20
        while time.time() < end:
            state.poll()
            if reached():
                return
            time.sleep(0.005)
        sys.exit("LinuxCNC did not do what it was told")

    def pin(name):
        return float(subprocess.check_output(["halcmd", "getp", name]))

    command.state(linuxcnc.STATE_ESTOP_RESET)
    command.wait_complete()
    command.state(linuxcnc.STATE_ON)
    until(lambda: state.task_state == linuxcnc.STATE_ON)
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.home(-1)
    until(lambda: state.homed[0] == 1)
    command.teleop_enable(1)
    command.wait_complete()
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()

    def go(position):
        command.mdi(f"G0 {os.environ['COMP_AXIS']}{position:.6f}")
        if command.wait_complete(20) != linuxcnc.RCS_DONE:
            sys.exit("LinuxCNC refused to move")
        until(lambda: state.inpos and abs(state.joint[0]["output"] - position) < 100)
        time.sleep(0.1)  # the correction is brought in along an S-curve
        correction = pin("joint.0.backlash-filt")
        sent = pin("joint.0.motor-pos-cmd") - pin("joint.0.motor-offset")
        if abs(sent - pin("joint.0.pos-cmd") - correction) > 2e-4 + 2e-6 * abs(position):
            sys.exit(f"at {position} the motor is not sent the command plus {correction}")
        return correction

    lines = []
    for text in os.environ["COMP_POSITIONS"].split():
        position = float(text)
        go(position - 3.0)
        below = go(position)
        go(position + 3.0)
        above = go(position)
        lines.append(f"{text} {below:.9f} {above:.9f}\n")
    with open(os.environ["COMP_ANSWER"], "w", encoding="utf-8") as answer:
        answer.writelines(lines)


if "COMP_ANSWER" in os.environ:
    drive()
else:
    start(sys.argv[1], sys.argv[2], sys.argv[3:])
