"""Reference numbers for tests/core/standards.rs, from the text of the standards alone.

    python3 standards.py > standards.json

Plain Python; shares no code and no formulas with the program beyond the standards' definitions
(ISO 230-2:2014, clause 3; ISO 9283:1998, clauses 7.2.1, 7.2.3, 7.3.1). The axis of the invented
session is oblique, its error is large (so that a linearised angle would show), and the reflector is
also displaced along the radius and along the axis, which is no positioning error of the axis.
"""

import json
import math
import random
import statistics

AXIS = [0.2, -0.3, 1.0]
POINT = [10.0, -5.0, 30.0]
HOME = [260.0, 20.0, 100.0]
POSITIONS = [-120.0 + 30.0 * k for k in range(9)]
RUNS = 5


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


DIRECTION = unit(AXIS)
# A basis across the axis: angles are measured in it, by atan2 of two coordinates.
U = unit(cross(DIRECTION, [1.0, 0.0, 0.0]))
V = cross(DIRECTION, U)


def polar(point):
    lever = [p - o for p, o in zip(point, POINT)]
    return dot(lever, U), dot(lever, V), dot(lever, DIRECTION)


def angle_deg(point):
    u, v, _ = polar(point)
    return math.degrees(math.atan2(v, u))


def at(radius, angle, height):
    u, v = radius * math.cos(angle), radius * math.sin(angle)
    return [o + u * a + v * b + height * d for o, a, b, d in zip(POINT, U, V, DIRECTION)]


def nominal(q_deg):
    u, v, w = polar(HOME)
    return at(math.hypot(u, v), math.atan2(v, u) + math.radians(q_deg), w)


def measured(q_deg, side, noise):
    u, v, w = polar(HOME)
    real = q_deg + 1.5 + 0.05 * math.sin(math.radians(q_deg - 40.0)) - side * 0.02 + noise[0]
    return at(0.99 * math.hypot(u, v) + noise[1], math.atan2(v, u) + math.radians(real), w + 0.3 + noise[2])


def wrapped(deg):
    return (deg + 180.0) % 360.0 - 180.0


def positioning(ups, downs):
    """The figures of an axis from lists of deviations per position."""
    mu = [statistics.fmean(x) for x in ups]
    md = [statistics.fmean(x) for x in downs]
    su = [statistics.stdev(x) for x in ups]
    sd = [statistics.stdev(x) for x in downs]
    b = [x - y for x, y in zip(mu, md)]
    r = [max(2 * s + 2 * t + abs(c), 4 * s, 4 * t) for s, t, c in zip(su, sd, b)]
    mean = [(x + y) / 2 for x, y in zip(mu, md)]
    high_u = [m + 2 * s for m, s in zip(mu, su)]
    low_u = [m - 2 * s for m, s in zip(mu, su)]
    high_d = [m + 2 * s for m, s in zip(md, sd)]
    low_d = [m - 2 * s for m, s in zip(md, sd)]
    return {
        "B": max(abs(x) for x in b),
        "B_mean": statistics.fmean(b),
        "R_up": max(4 * s for s in su),
        "R_down": max(4 * s for s in sd),
        "R": max(r),
        "E_up": max(mu) - min(mu),
        "E_down": max(md) - min(md),
        "E": max(mu + md) - min(mu + md),
        "M": max(mean) - min(mean),
        "A_up": max(high_u) - min(low_u),
        "A_down": max(high_d) - min(low_d),
        "A": max(high_u + high_d) - min(low_u + low_d),
    }


def pose(points, commanded):
    centre = [statistics.fmean(p[k] for p in points) for k in range(3)]
    off = [c - w for c, w in zip(centre, commanded)]
    lengths = [math.dist(p, centre) for p in points]
    return centre, {
        "AP_p_mm": math.sqrt(dot(off, off)),
        "AP_x_mm": off[0],
        "AP_y_mm": off[1],
        "AP_z_mm": off[2],
        "RP_l_mm": statistics.fmean(lengths) + 3 * statistics.stdev(lengths),
    }


def invented():
    chance = random.Random(2302)
    samples, points = [], {}
    for _ in range(RUNS):
        for side, order in ((1, POSITIONS), (-1, POSITIONS[::-1])):
            for q in order:
                noise = [chance.gauss(0.0, s) for s in (0.002, 0.02, 0.02)]
                point = [round(x, 6) for x in measured(q, side, noise)]
                samples.append({"q": q, "dir": side, "point": point})
                points.setdefault((q, side), []).append(point)
    deviations = {
        key: [3600.0 * wrapped(angle_deg(p) - angle_deg(nominal(key[0]))) for p in at_pose]
        for key, at_pose in points.items()
    }
    axis = positioning([deviations[q, 1] for q in POSITIONS], [deviations[q, -1] for q in POSITIONS])
    poses, variations = [], []
    for q in POSITIONS:
        centres = []
        for side in (1, -1):
            centre, figures = pose(points[q, side], nominal(q))
            centres.append(centre)
            poses.append({"q": q, "dir": side, **figures})
        variations.append({"q": q, "vAP_p_mm": math.dist(*centres)})
    return {
        "axis": AXIS,
        "point": POINT,
        "home": HOME,
        "samples": samples,
        "iso_230_2": axis,
        "poses": poses,
        "variations": variations,
    }


# Deviations of the published example that tests/core/standards.rs names, micrometres × 10.
UP = [
    [139, 1634, 1634, 4988, 4665],
    [-655, 1164, 1891, 5810, 6659],
    [-2782, -802, -1005, 1986, 3440],
    [-2526, -384, 181, 3495, 4909],
    [316, 397, 963, 3024, 5165],
]
DOWN = [
    [-10205, -1598, 139, 746, 3857],
    [-11969, -2392, -251, 32, 3830],
    [-13005, -2904, -1489, -1126, 1622],
    [-5233, -2809, -1152, 949, 2323],
    [-5017, -1946, -1462, 1731, 3024],
]


def published():
    scale = lambda rows: [[x * 1e-5 for x in row] for row in rows]
    return positioning(scale(UP), scale(DOWN))


print(json.dumps({"invented": invented(), "published": published()}, indent=1))
