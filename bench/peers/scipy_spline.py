#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Peer of bench_accuracy: SciPy's least-squares bivariate spline (FITPACK surfit) of a cloud as a height field.

usage: scipy_spline.py CLOUD NET < /dev/null > SPLINE

CLOUD holds raw little-endian doubles x, y, z a point, in the leaf frame; NET is the number of coefficients in each
direction, bicubic with uniform knots over the points' box. Prints the two whole knot vectors, a line each, then the
NET x NET coefficients in one line (x-major), then the seconds of the fit.
"""
import sys
import time
import warnings

import numpy as np
from scipy.interpolate import LSQBivariateSpline

DEGREE = 3


def main():
    x, y, z = np.fromfile(sys.argv[1], dtype="<f8").reshape(-1, 3).T
    inner = int(sys.argv[2]) - DEGREE - 1
    interior = [np.linspace(t.min(), t.max(), inner + 2)[1:-1] for t in (x, y)]
    begin = time.perf_counter()
    with warnings.catch_warnings():
        # Corners of the box without data make the system rank-deficient; FITPACK then takes the minimal norm.
        warnings.simplefilter("ignore")
        spline = LSQBivariateSpline(x, y, z, *interior, kx=DEGREE, ky=DEGREE)
    seconds = time.perf_counter() - begin
    for row in (*spline.get_knots(), spline.get_coeffs(), [seconds]):
        print(" ".join(repr(float(value)) for value in row))


if __name__ == "__main__":
    main()
