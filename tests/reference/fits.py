#!/usr/bin/env python3
"""Two fits of one axis by scipy, and what they say of each other: values, 95 % intervals and the difference of their
Bayesian information criteria (Schwarz 1978), from the density of the residuals and without a formula of the program.

    python tests/reference/fits.py > tests/reference/fits.json

An axis along z through the origin, a reflector 400 mm from it and 300 mm up, 48 positions from both sides; 0.02 mm of
noise along each coordinate. In the axis: a zero offset, a longer link, an eccentric encoder of 0.02°. The first fit knows
zero offset and link length, the second the eccentricity besides: theta = q + dz + asin(a sin q - b cos q).
`diagnosis::search::prepare` compares values and intervals of the second, and the criteria.
"""
import json

import numpy as np
from scipy.optimize import curve_fit
from scipy.stats import norm, t

RADIUS, HEIGHT, SIGMA = 400.0, 300.0, 0.02
up = np.linspace(-150, 141, 24)
q_deg = np.concatenate([up, up[::-1] + 3])
q = np.radians(q_deg)


def point(q, zero, longer, a=0.0, b=0.0):
    theta = q + zero + np.arcsin(a * np.sin(q) - b * np.cos(q))
    r = RADIUS + longer
    return np.concatenate([r * np.cos(theta), r * np.sin(theta), np.full(len(q), HEIGHT)])


truth = [np.radians(0.03), 0.15, np.radians(0.02) * np.cos(0.7), np.radians(0.02) * np.sin(0.7)]
noise = np.random.default_rng(5).normal(0, SIGMA, 3 * len(q))
measured = np.round(point(q, *truth) + noise, 6)


def fitted(count):
    values, covariance = curve_fit(point, q, measured, p0=[0.0] * count, xtol=1e-14, ftol=1e-14)
    left = measured - point(q, *values)
    m = len(measured)
    half = t.ppf(0.975, m - count) * np.sqrt(np.diag(covariance))
    # The variance of the largest likelihood, not the one without bias.
    density = norm.logpdf(left, scale=np.sqrt(np.mean(left**2))).sum()
    return values, half, count * np.log(m) - 2 * density


(_, _, first), (values, half, second) = fitted(2), fitted(4)
x, y, z = measured.reshape(3, -1)
columns = {"q1_deg": q_deg.round(9), "dir1": np.repeat([1, -1], len(up)), "x_mm": x, "y_mm": y, "z_mm": z}
print(json.dumps({
    "columns": {name: [float(v) for v in column] for name, column in columns.items()},
    "zero_deg": float(np.degrees(values[0])),
    "zero_half_deg": float(np.degrees(half[0])),
    "length_mm": float(values[1]),
    "length_half_mm": float(half[1]),
    "bic_falls_by": float(first - second),
}))
