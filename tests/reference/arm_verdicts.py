"""Sessions of a six-joint arm on which a diagnosis has to be right: numpy, by arm_rates.py, sharing
nothing with src/.

    python tests/reference/arm_verdicts.py tests/data/arm_verdicts

`never-aligned` has no `setup` column and a frame that nobody aligned; in `joint-4-reversed` the
samples count joint 4 the other way round; `twenty-poses` and `one-side` show little; in `dh-row` the
robot is given as Denavit-Hartenberg rows of which a_2 is 10 mm too long; `two-cycle` hides an encoder
error of joint 3.
"""

import json
import sys
from pathlib import Path

import numpy as np
from arm_rates import SIGMA_MM, Session

# The arm of arms.py as standard rows: a, alpha, d, theta. a_2 is 310 mm.
ROWS = [(0, -90, 330, 0), (320, 0, 0, -90), (70, -90, 0, 0), (0, 90, 340, 0), (0, -90, 0, 0), (0, 0, 80, 0)]


def reversed_joint_4(_, q):
    q[:, 3] *= -1
    return q


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    made = lambda seed, poses, side=None: Session("six", poses, np.random.default_rng(seed), side)
    made(11, 60).write(folder, "never-aligned", [], setup=False)
    made(12, 60).write(folder, "joint-4-reversed", [], reversed_joint_4)
    made(13, 20).write(folder, "twenty-poses", [])
    made(14, 60, side=0.3).write(folder, "one-side", [])
    made(15, 60).write(folder, "dh-row", [])
    path = folder / "dh-row.json"
    document = json.loads(path.read_text())
    robot = document["robot"]
    limits = [joint["limits"] for joint in robot.pop("joints")]
    robot.pop("tool")
    robot["dh"] = [
        {"a_mm": a, "alpha_deg": alpha, "d_mm": d, "theta_deg": theta, "convention": "standard"}
        for a, alpha, d, theta in ROWS
    ]
    robot["limits"] = limits
    # The last row's frame at home: x up, y to the right, z forward.
    tool = np.array([[0, 0, 1], [0, -1, 0], [1, 0, 0]]).T
    document["targets"] = {
        name: (tool.T @ np.array(place)).tolist() for name, place in document["targets"].items()
    }
    path.write_text(json.dumps(document) + "\n")
    session = made(16, 60)
    effect = {"effect": "encoder-two-cycle", "joint": 3, "size": 1e-4, "phase_deg": 40.0}
    j = session.arm.jacobian(session.x, session.frame, session.q, session.target)
    u, s, _ = np.linalg.svd(j / np.maximum(np.linalg.norm(j, axis=0), 1e-9), full_matrices=False)
    u = u[:, s > 1e-6]
    d = (session.points([effect]) - session.points([])).ravel()
    effect["size"] *= 20 * SIGMA_MM / np.linalg.norm(d - u @ (u.T @ d))
    session.write(folder, "two-cycle", [effect])
    print("two-cycle", np.degrees(effect["size"]))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "tests/data/arm_verdicts")
