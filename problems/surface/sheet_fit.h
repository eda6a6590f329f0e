// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "base/stage_clock.h"
#include "models/nurbs_surface.h"
#include "problems/surface/control_net.h"
#include "problems/surface/distance_fit.h"
#include "problems/surface/surface_quality.h"
#include "solvers/solver.h"

namespace frond {

// How the surface ends where the cloud does (MATH.md §1, "A margin"). kTrim: the fit is a rectangle, cut by
// the boundary loop of the feet. kConforming: its four edges are drawn to the cloud's boundary. kNone: a
// rectangle.
enum class MarginMode { kTrim, kConforming, kNone };

struct SheetFitOptions {
  std::array<int, 2> degree{3, 3};            // u, v
  std::array<int, 2> control_points{20, 20};  // u, v; {0, 0}: chosen by held-out error
  SurfaceUnknowns unknowns = SurfaceUnknowns::kControlPoints;
  std::optional<MarginMode> margin;  // default: conforming up to 7 × 7 control points, else trim
  DistanceDerivatives derivatives = DistanceDerivatives::kStructured;
  std::optional<double> fairness;  // final λ; default by the scan's noise and number of points
  double hinge = 1;                // μ; 0: none
  double hinge_limit = 0.3;        // δ
  std::string loss = "none";       // of RobustLossNames()
  double peak_emphasis = 0;        // β: large distances count more; 0: least squares
  double loss_scale = 3;           // in robust standard deviations of the start's distances
  double outlier_threshold = 6;    // in robust standard deviations of the local noise; 0: keep all points
  double margin_weight = 0.1;
  double domain_margin = 0.02;    // share of the domain left free around the data (trim, none)
  int subset = 10000;             // points of the first stages
  bool tie_tip = false;           // conforming: the edge at v's end is one point, drawn to the ring's end
  bool given_start_only = false;  // no start from the cloud itself beside a given one
};

// The options of a sheet fit in a config, with the sections `surface` and `fit`, and their reading.
std::vector<OptionSpec> SheetFitSpecs();
SheetFitOptions SheetFitOptionsFrom(const Options& options);

// Checks what single options cannot tell (degree against control points); throws ConfigError.
void CheckSheetOptions(const Options& options);

// What `options.margin` comes to for a net.
MarginMode MarginFor(const SheetFitOptions& options, std::array<int, 2> control_points);

// Solver options that suit the staged fit with these options, to be used as defaults: name and value.
std::vector<std::pair<std::string, OptionValue>> SheetFitSolverDefaults(const std::string& solver,
                                                                        const SheetFitOptions& options);

struct SheetFit {
  TrimmedSurface surface;
  std::array<int, 2> control_points;
  MarginMode margin;
  std::vector<std::uint8_t> outlier;  // by input point
  PointDistances distances;           // by input point
  SurfaceQuality quality;
  SolverReport report;  // of all stages together; the objective is the last one's
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;
};

// Fits an open sheet given in a frame whose x is its long direction (v of the surface), y across (u), z up:
//
//   spatial order → start (given, or a rectangle over x and y) → stages of the distance fit on
//   a subset, fairness falling → outliers by the first fit → the same on all points → global distances →
//   trim.
//
// `stray`: 1 for points that are not of the sheet (StrayPoints), by point, or empty: they are outliers from
// the start, unless outlier_threshold is 0. `start`: a surface in the same frame, of any net; another net's
// feet give the parameters. The first stage runs from it and from the cloud's own start, and the better goes
// on, unless given_start_only. `solver` does the work of each stage within the shared budget. Throws
// InputError if there are fewer points than control points or the points have no extent in x or y; FitError
// if a stage fails.
SheetFit FitSheet(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                  const std::optional<NurbsSurface>& start, const SheetFitOptions& options,
                  const Solver& solver, const Budget& budget, const SolveContext& context);

// Throws InputError where there are fewer points than control points, naming the largest net that they hold.
void CheckPointCount(std::size_t points, std::array<int, 2> control_points);

// A surface that was not fitted by FitSheet, judged as FitSheet judges its own; points (in a frame, with
// their strays) as there. Distances by input point.
struct SheetJudgement {
  SurfaceQuality quality;
  PointDistances distances;
};
SheetJudgement JudgeSheet(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                          const TrimmedSurface& surface, int threads);

}  // namespace frond
