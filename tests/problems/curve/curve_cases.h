// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "problems/curve/curve_fit.h"

namespace frond {

using Points = std::vector<Eigen::Vector3d>;

// `count` points of an ellipse about (3, −2, 0), from angle `begin` over `turn` (2π: closed, the first not
// repeated), at even steps of the angle.
Points EllipsePoints(int count, double a, double b, double begin, double turn);

// A closed wavy outline in the plane, polar radius 10 + 2 cos 3φ + sin 5φ, or (`height` ≠ 0) in space.
Points OutlinePoints(int count, double height = 0);

// An open curve in space: a helix of radius 5 over `turns` turns, 10 high.
Points HelixPoints(int count, double turns = 1.5);

Points WithNoise(Points points, double deviation, std::uint64_t seed, bool plane);
Points Shuffled(Points points, std::uint64_t seed);

// FitCurve by the registered lm with the fit's own defaults.
CurveFit Fitted(const Points& points, const CurveFitOptions& options, int threads = 1,
                const Budget& budget = {});

double Largest(const std::vector<double>& values);
double RootMeanSquare(const std::vector<double>& values);

}  // namespace frond
