#!/usr/bin/env python3
"""How likely samples are with groups of columns beside a base, by scipy and without the formula of the program: the density
of what the base does not reach, K'y with K an orthonormal basis of the null space of J', as that of all groups and the
noise together. Coefficients and their standard deviations are those of the joint normal distribution. And what the kernels
of a curve make of distances, by scikit-learn.

    python tests/reference/groups_of_columns.py > tests/reference/groups_of_columns.json

40 rows; a base of three columns, three groups of two, one and three; columns and residual are sines, so that both sides
write them down. c ~ N(0, s^2 v) with the strength v of its group, noise N(0, s^2); s is profiled out, constants are left
out. `diagnosis::rest` compares its own with it.
"""
import json

import numpy as np
from scipy.linalg import null_space
from scipy.stats import multivariate_normal
from sklearn.gaussian_process.kernels import RBF, Matern

GROUP, STRENGTHS = [0, 0, 1, 2, 2, 2], [0.3, 0.05, 0.7]
DISTANCES = [0.0, 0.1, 0.5, 1.0, 3.0]
rows = np.arange(40.0)


def wild(j):
    return np.sin((rows + 3) * (2 * j + 5) * 0.37)


base = np.column_stack([wild(j) for j in range(3)])
own = np.column_stack([wild(j) for j in range(3, 9)])
y = wild(3) - 0.4 * wild(7) + 0.3 * base[:, 1] + 0.5 * np.sin(rows * 1.7)
k = null_space(base.T)
z, seen = k.T @ y, k.T @ own
prior = np.diag([STRENGTHS[g] for g in GROUP])
covariance = seen @ prior @ seen.T + np.eye(len(z))
freedom = len(z)
square = z @ np.linalg.solve(covariance, z)
density = multivariate_normal(np.zeros(freedom), covariance).logpdf(z)
ln_det = -2 * density - freedom * np.log(2 * np.pi) - square
gain = prior @ seen.T @ np.linalg.inv(covariance)
left = (prior - gain @ seen @ prior) * square / freedom
apart = lambda kernel: kernel(np.array(DISTANCES)[:, None], [[0.0]]).ravel().tolist()
print(
    json.dumps(
        {
            "group": GROUP,
            "strengths": STRENGTHS,
            "ln_evidence": -0.5 * (ln_det + freedom * np.log(square)),
            "coefficients": (gain @ z).tolist(),
            "deviations": np.sqrt(np.diag(left)).tolist(),
            "distances": DISTANCES,
            # The length of the program is in units of sqrt(2 nu).
            "correlations": [apart(Matern((2 * nu) ** 0.5, nu=nu)) for nu in (0.5, 1.5, 2.5)] + [apart(RBF(1.0))],
        }
    )
)
