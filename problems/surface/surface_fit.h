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
#include "problems/surface/closed_start.h"
#include "problems/surface/control_net.h"
#include "problems/surface/distance_fit.h"
#include "problems/surface/surface_errors.h"
#include "problems/surface/surface_quality.h"
#include "problems/surface/surface_topology.h"
#include "problems/surface/uncertainty.h"
#include "solvers/solver.h"

namespace frond {

// How the surface ends where the cloud does (MATH.md §1, "A margin"). kTrim: the fit is a rectangle, cut by
// the boundary loop of the feet. kConforming: its four edges are drawn to the cloud's boundary. kNone: a
// rectangle.
enum class MarginMode { kTrim, kConforming, kNone };

// kDistance: least orthogonal distances by a solver. The others are linear, at fixed parameters, with the
// base surface repeated (parametric_fit.h): kParametric with all weights 1, kMa with weights by Ma's two
// steps.
enum class SurfaceMethod { kDistance, kParametric, kMa };

// The base surface whose parameters the first fit takes (acquisition paper, 3.2.1): of a sheet a plane; of a
// tube a cylinder or the line through its middle, however that bends; of a cup the line; of a sphere a sphere
// or the line. kAuto: the line, but a sphere where the cloud is star-shaped.
enum class BaseSurface { kAuto, kPlane, kCylinder, kSphere, kCentreLine };

struct SurfaceFitOptions {
  SurfaceTopology topology = SurfaceTopology::kSheet;
  BaseSurface base = BaseSurface::kAuto;
  std::array<int, 2> degree{3, 3};            // u, v
  std::array<int, 2> control_points{20, 20};  // u, v; {0, 0}: chosen by held-out error
  SurfaceMethod method = SurfaceMethod::kDistance;
  int repetitions = 5;         // of the base surface, at most (parametric, ma)
  bool start_from_ma = false;  // the cloud's own start has weights by Ma's two steps
  SurfaceUnknowns unknowns = SurfaceUnknowns::kControlPoints;
  std::optional<MarginMode> margin;  // default: conforming up to 7 × 7 control points, else trim
  DistanceDerivatives derivatives = DistanceDerivatives::kStructured;
  std::optional<double> fairness;          // final λ; default by the scan's noise and number of points
  bool noise_free = false;                 // whatever the scan looks like: a mesh's vertices
  double hinge = 1;                        // μ; 0: none
  std::optional<double> hinge_limit = {};  // δ; default .3, where u is closed .1
  std::string loss = "none";               // of RobustLossNames()
  double peak_emphasis = 0;                // β: large distances count more; 0: least squares
  double loss_scale = 3;                   // in robust standard deviations of the start's distances
  double outlier_threshold = 6;  // in robust standard deviations of the local noise; 0: keep all points
  double margin_weight = 0.1;
  double domain_margin = 0.02;    // share of the domain left free around the data (trim, none)
  int subset = 10000;             // points of the first stages
  bool tie_tip = false;           // conforming: the edge at v's end is one point, drawn to the ring's end
  bool given_start_only = false;  // no start from the cloud itself beside a given one
  // Of a tube or cup, where a mesh tells them: v = 0's before v = 1's, in the points' frame. Else found.
  std::vector<Ring> rims = {};
  bool uncertainty = false;  // estimate it (distance)
};

// The options of a sheet fit in a config, with the sections `surface` and `fit`, and their reading.
std::vector<OptionSpec> SurfaceFitSpecs();
SurfaceFitOptions SurfaceFitOptionsFrom(const Options& options);

// Checks what single options cannot tell (degree against control points); throws ConfigError.
void CheckSurfaceFitOptions(const Options& options);

// Throws ConfigError where options do not suit the topology: the base surface, a margin to be trimmed, free
// weights at poles, too small a net.
void CheckTopologyOptions(const SurfaceFitOptions& options);

// What `options.margin` comes to for a net.
MarginMode MarginFor(const SurfaceFitOptions& options, std::array<int, 2> control_points);

// Solver options that suit the staged fit with these options, to be used as defaults: name and value.
std::vector<std::pair<std::string, OptionValue>> SurfaceFitSolverDefaults(const std::string& solver,
                                                                          const SurfaceFitOptions& options);

// A mesh of the surface inside its trim, and the estimate at its vertices.
struct FitUncertainty {
  SurfaceMesh mesh;
  SurfaceUncertainty estimate;
};

struct SurfaceFit {
  TrimmedSurface surface;
  std::array<int, 2> control_points;
  MarginMode margin;
  std::vector<std::uint8_t> outlier;  // by input point
  PointDistances distances;           // by input point
  SurfaceQuality quality;
  SurfaceErrors errors;
  std::optional<FitUncertainty> uncertainty;
  SolverReport report;  // of all stages together; the objective is the last one's
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;
};

// Fits a surface of options.topology to points in a frame: of an open sheet x is its long direction (v of the
// surface), y across (u), z up; of a tube or cup x runs along it, of a sphere through its poles, the origin
// being inside.
//
//   spatial order → start (given, or at the base surface's parameters) → stages of the distance fit on
//   a subset, fairness falling → outliers by the first fit → the same on all points → global distances →
//   trim.
//
// From a sheet's scan without noise it first tries for the shape itself (sheet_exact_stage.cc).
//
// `stray`: 1 for points that are not of the sheet (StrayPoints), by point, or empty: they are outliers from
// the start, unless outlier_threshold is 0. `start`: a surface in the same frame, of any net; another net's
// feet give the parameters. The first stage runs from it and from the cloud's own start, and the better goes
// on, unless given_start_only. `solver` does the work of each stage within the shared budget. Throws
// ConfigError as CheckTopologyOptions, InputError if there are fewer points than control points or the points
// have no extent in x or y; FitError if a stage fails.
SurfaceFit FitSurface(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                      const std::optional<NurbsSurface>& start, const SurfaceFitOptions& options,
                      const Solver& solver, const Budget& budget, const SolveContext& context);

// Throws InputError where there are fewer points than control points, naming the largest net that they hold.
void CheckPointCount(std::size_t points, std::array<int, 2> control_points);

// A surface that was not fitted by FitSurface, judged as FitSurface judges its own; points (in a frame, with
// their strays) as there. Distances by input point.
struct FitJudgement {
  SurfaceQuality quality;
  SurfaceErrors errors;  // without the parametric ones
  PointDistances distances;
};
FitJudgement JudgeFit(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& stray,
                      const TrimmedSurface& surface, int threads);

}  // namespace frond
