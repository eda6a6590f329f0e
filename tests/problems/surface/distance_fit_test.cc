// SPDX-License-Identifier: BSD-3-Clause
// The rows of the distance fit: structured against auto-diff, compressed against a block per point.
#include "problems/surface/distance_fit.h"

#include <ceres/crs_matrix.h>
#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>

#include "base/random.h"
#include "models/foot_point_search.h"
#include "problems/surface/distance_residual.h"
#include "tests/models/closed_surfaces.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

struct Evaluation {
  double cost = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd matrix;  // JᵀJ
};

Evaluation Evaluate(ceres::Problem* problem) {
  ceres::Problem::EvaluateOptions options;
  problem->GetParameterBlocks(&options.parameter_blocks);
  Evaluation result;
  std::vector<double> gradient;
  ceres::CRSMatrix crs;
  if (!problem->Evaluate(options, &result.cost, nullptr, &gradient, &crs)) {
    ADD_FAILURE() << "the problem could not be evaluated";
    return result;
  }
  result.gradient = Eigen::Map<Eigen::VectorXd>(gradient.data(), static_cast<Eigen::Index>(gradient.size()));
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (std::size_t r = 0; r < static_cast<std::size_t>(crs.num_rows); ++r) {
    for (int k = crs.rows[r]; k < crs.rows[r + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      jacobian(static_cast<Eigen::Index>(r), crs.cols[entry]) = crs.values[entry];
    }
  }
  result.matrix = jacobian.transpose() * jacobian;
  return result;
}

Evaluation EvaluateFit(const SurfaceDistanceFit& fit) {
  LeastSquares least_squares(fit, 1);
  return Evaluate(&least_squares.problem());
}

void ExpectEqual(const Evaluation& a, const Evaluation& b, double tolerance, double matrix_tolerance) {
  EXPECT_GT(a.cost, 0);
  ASSERT_EQ(a.gradient.size(), b.gradient.size());
  EXPECT_NEAR(a.cost, b.cost, tolerance * a.cost);
  EXPECT_LE((a.gradient - b.gradient).norm(), tolerance * a.gradient.norm());
  EXPECT_LE((a.matrix - b.matrix).norm(), matrix_tolerance * a.matrix.norm());
}

struct Case {
  const char* name;
  WavySheet sheet = {};
  SurfaceUnknowns unknowns = SurfaceUnknowns::kControlPoints;
  bool tied = false, margin = false;
  RobustLoss loss = {};
  bool closed = false;  // an egg instead of the sheet
  PoleEnds poles = {};
};

NurbsSurface StartOf(const Case& c) { return c.closed ? Egg(c.poles) : MakeSurface(c.sheet); }

std::vector<Case> Cases() {
  const WavySheet bicubic{.uneven_knots = true};
  const WavySheet mixed{.degree_u = 2, .degree_v = 4, .uneven_knots = true};
  const WavySheet rational{.uneven_knots = true, .rational = true};
  using enum SurfaceUnknowns;
  return {{"bicubic", bicubic},
          {"mixed_degrees", mixed},
          {"bilinear", {.degree_u = 1, .degree_v = 1}},
          {"rational_start", rational},
          {"weights", rational, kWeights},
          {"both", rational, kBoth},
          {"both_mixed_degrees", mixed, kBoth},
          {"tied_row", bicubic, kControlPoints, true},
          {"tied_row_both", rational, kBoth, true},
          {"margin", bicubic, kControlPoints, false, true},
          {"margin_both_tied", rational, kBoth, true, true},
          {"huber", bicubic, kControlPoints, false, false, {RobustLossType::kHuber, 0.3}},
          {"cauchy", rational, kBoth, false, false, {RobustLossType::kCauchy, 0.3}},
          {"tukey", bicubic, kControlPoints, false, false, {RobustLossType::kTukey, 2}},
          {.name = "tube", .closed = true},
          {.name = "tube_both", .unknowns = kBoth, .closed = true},
          {.name = "cup", .closed = true, .poles = {.begin = true}},
          {.name = "cup_with_pole_at_its_end", .closed = true, .poles = {.end = true}},
          {.name = "cup_margin", .margin = true, .closed = true, .poles = {.begin = true}},
          {.name = "sphere", .closed = true, .poles = {.begin = true, .end = true}},
          {.name = "sphere_cauchy",
           .loss = {RobustLossType::kCauchy, 0.3},
           .closed = true,
           .poles = {.begin = true, .end = true}}};
}

DistanceFitOptions OptionsFor(const Case& c, const NurbsSurface& surface) {
  DistanceFitOptions options;
  options.unknowns = c.unknowns;
  options.fairness = 1e-6;
  options.hinge = 0.5;
  options.hinge_limit = 1.02;
  options.loss = c.loss;
  options.poles = c.poles;
  if (c.tied) {
    options.tied.emplace_back();
    for (int i = 0; i < surface.count_u(); ++i) options.tied[0].push_back((i + 1) * surface.count_v() - 1);
  }
  if (c.margin) {
    std::vector<Eigen::Vector3d> ring;
    for (int k = 0; k < 200; ++k) {
      const double a = 2 * M_PI * k / 200;
      ring.emplace_back(25 + 26 * std::cos(a), 10 + 11 * std::sin(a), std::sin(3 * a));
    }
    options.margin = MarginOptions{.rings = {ring}};
  }
  return options;
}

class DistanceFitCases : public testing::TestWithParam<Case> {};

TEST_P(DistanceFitCases, StructuredRows_EqualAutoDiffRows) {
  const Case& c = GetParam();
  const NurbsSurface start = StartOf(c);
  const auto points = PointsAround(start, 600, 0.4, 60, 5);
  DistanceFitOptions options = OptionsFor(c, start);
  const SurfaceDistanceFit structured(points, start, start, options, 1);
  options.derivatives = DistanceDerivatives::kAutodiff;
  const SurfaceDistanceFit autodiff(points, start, start, options, 1);
  ExpectEqual(EvaluateFit(structured), EvaluateFit(autodiff), 1e-9, 1e-9);
}

TEST_P(DistanceFitCases, CostWithoutJacobians_EqualsCostWithThem) {
  const Case& c = GetParam();
  const NurbsSurface start = StartOf(c);
  const auto points = PointsAround(start, 600, 0.4, 60, 5);
  const SurfaceDistanceFit fit(points, start, start, OptionsFor(c, start), 1);
  const double cost = EvaluateFit(fit).cost;
  EXPECT_NEAR(fit.Objective(fit.StartVector()), cost, 1e-10 * cost);
}

INSTANTIATE_TEST_SUITE_P(DistanceFit, DistanceFitCases, testing::ValuesIn(Cases()),
                         [](const auto& info) { return std::string(info.param.name); });

// The rows by their description in MATH.md §1: along the normal inside, square to the tangent on an edge, all
// three in a corner.
Eigen::Matrix<double, Eigen::Dynamic, 3> RowDirections(const SurfaceCells& cells, const FootPoint& foot) {
  const SurfaceCells::Jet1 jet = cells.Evaluate1(foot.u, foot.v);
  if (foot.at_edge_u && foot.at_edge_v) return Eigen::Matrix3d::Identity();
  if (!foot.at_edge_u && !foot.at_edge_v) return jet.du.cross(jet.dv).normalized().transpose();
  const Eigen::Vector3d tangent = (foot.at_edge_u ? jet.dv : jet.du).normalized();
  Eigen::Matrix<double, 2, 3> directions;
  directions.row(0) = tangent.unitOrthogonal();
  directions.row(1) = tangent.cross(directions.row(0).transpose());
  return directions;
}

// One auto-diff residual block a point, at the feet that the fit finds from `feet`; no fairness, no hinge.
class PlainProblem {
 public:
  PlainProblem(const std::vector<Eigen::Vector3d>& points, const NurbsSurface& start, const ControlNet& net,
               const RobustLoss& loss, const std::vector<Eigen::Vector2d>& feet)
      : cells_(start), layout_(BlocksOfCells(cells_, net)), bases_(points.size()) {
    const auto size = static_cast<std::size_t>(net.block_size());
    const std::vector<ParameterBlock> blocks = net.ParameterBlocks();
    for (const auto& block : blocks) values_.insert(values_.end(), block.start.begin(), block.start.end());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      problem_.AddParameterBlock(&values_[b * size], net.block_size());
      if (blocks[b].constant) problem_.SetParameterBlockConstant(&values_[b * size]);
      if (blocks[b].manifold) problem_.SetManifold(&values_[b * size], new ceres::SubsetManifold(4, {3}));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const FootPoint foot =
          RefineFootPoint(cells_, points[i], feet[i][0], feet[i][1], {.step_tolerance = 1e-6 * start.Size()});
      feet_on_edges += foot.at_edge_u != foot.at_edge_v;
      feet_in_corners += foot.at_edge_u && foot.at_edge_v;
      AddPoint(points[i], foot, net, loss, &bases_[i]);
    }
  }

  ceres::Problem& problem() { return problem_; }
  int feet_on_edges = 0, feet_in_corners = 0;

 private:
  void AddPoint(const Eigen::Vector3d& point, const FootPoint& foot, const ControlNet& net,
                const RobustLoss& loss, std::vector<double>* basis) {
    std::array<double, 2 * (kMaxDegree + 1)> nu, nv;
    cells_.u().Evaluate(cells_.u().SpanOf(foot.u), foot.u, 0, nu.data());
    cells_.v().Evaluate(cells_.v().SpanOf(foot.v), foot.v, 0, nv.data());
    for (int a = 0; a <= cells_.u().degree(); ++a) {
      for (int b = 0; b <= cells_.v().degree(); ++b) {
        basis->push_back(nu[static_cast<std::size_t>(a)] * nv[static_cast<std::size_t>(b)]);
      }
    }
    const CellBlocks& cell = layout_[static_cast<std::size_t>(cells_.CellOf(foot.u, foot.v))];
    const auto directions = RowDirections(cells_, foot);
    auto* cost = new ceres::DynamicAutoDiffCostFunction<DistanceResidual>(
        new DistanceResidual{*basis, &cell, &net, point, directions});
    std::vector<double*> pointers;
    for (const int block : cell.blocks) {
      cost->AddParameterBlock(net.block_size());
      pointers.push_back(&values_[static_cast<std::size_t>(block * net.block_size())]);
    }
    cost->SetNumResiduals(static_cast<int>(directions.rows()));
    problem_.AddResidualBlock(cost, MakeCeresLoss(loss).release(), pointers);
  }

  SurfaceCells cells_;
  std::vector<CellBlocks> layout_;
  std::vector<double> values_;
  std::vector<std::vector<double>> bases_;
  ceres::Problem problem_;
};

// Feet to the last bit that the distance can tell.
std::vector<Eigen::Vector2d> ExactFeet(const std::vector<Eigen::Vector3d>& points,
                                       const NurbsSurface& surface) {
  const SurfaceCells cells(surface);
  const FootPointSearch search(cells);
  std::vector<Eigen::Vector2d> feet;
  for (const auto& point : points) {
    const FootPoint near = search.Find(point);
    const FootPoint foot = RefineFootPoint(cells, point, near.u, near.v, {.step_tolerance = 1e-15});
    feet.emplace_back(foot.u, foot.v);
  }
  return feet;
}

void ExpectCompressedEqualsPlain(const WavySheet& sheet, SurfaceUnknowns unknowns, const RobustLoss& loss) {
  const NurbsSurface start = MakeSurface(sheet);
  const auto points = PointsAround(start, 800, 0.2, 100, 6);
  DistanceFitOptions options;
  options.unknowns = unknowns;
  options.fairness = options.hinge = options.weight_ridge = 0;
  options.loss = loss;
  const std::vector<Eigen::Vector2d> feet = ExactFeet(points, start);
  const Evaluation compressed = EvaluateFit(SurfaceDistanceFit(points, start, start, options, 1, feet));
  const ControlNet net(start, unknowns);
  PlainProblem plain(points, start, net, loss, feet);
  EXPECT_GT(plain.feet_on_edges, 20);
  EXPECT_GT(plain.feet_in_corners, 5);
  ExpectEqual(compressed, Evaluate(&plain.problem()), 1e-10, 1e-9);
}

TEST(DistanceFit, CompressedProblem_EqualsABlockPerPoint) {
  using enum SurfaceUnknowns;
  ExpectCompressedEqualsPlain({.uneven_knots = true}, kControlPoints, {});
  ExpectCompressedEqualsPlain({.degree_u = 2, .uneven_knots = true, .rational = true}, kWeights, {});
  ExpectCompressedEqualsPlain({.degree_v = 4, .uneven_knots = true, .rational = true}, kBoth, {});
}

TEST(DistanceFit, CompressedProblemWithRobustLoss_EqualsABlockPerPoint) {
  ExpectCompressedEqualsPlain({}, SurfaceUnknowns::kControlPoints, {RobustLossType::kHuber, 0.2});
  ExpectCompressedEqualsPlain({}, SurfaceUnknowns::kControlPoints, {RobustLossType::kCauchy, 0.2});
  ExpectCompressedEqualsPlain({}, SurfaceUnknowns::kBoth, {RobustLossType::kTukey, 1.5});
}

TEST(DistanceFit, CompressedProblemWithPoles_EqualsABlockPerPoint) {
  for (const PoleEnds poles : {PoleEnds{true, false}, PoleEnds{true, true}}) {
    const NurbsSurface start = Egg(poles);
    const auto points = PointsAround(start, 800, 0.2, 100, 6);
    DistanceFitOptions options;
    options.poles = poles;
    options.fairness = options.hinge = 0;
    const std::vector<Eigen::Vector2d> feet = ExactFeet(points, start);
    const Evaluation compressed = EvaluateFit(SurfaceDistanceFit(points, start, start, options, 1, feet));
    const ControlNet net(start, SurfaceUnknowns::kControlPoints, {}, poles);
    PlainProblem plain(points, start, net, {}, feet);
    EXPECT_EQ(plain.feet_on_edges > 0, !poles.end);  // a pole is no edge
    EXPECT_EQ(plain.feet_in_corners, 0);
    ExpectEqual(compressed, Evaluate(&plain.problem()), 1e-10, 1e-9);
  }
}

TEST(DistanceFit, SurfaceAtWithPoles_StaysC1) {
  const PoleEnds poles{.begin = true, .end = true};
  const NurbsSurface start = Egg(poles);
  const auto points = PointsAround(start, 300, 0.2, 0, 6);
  DistanceFitOptions options;
  options.poles = poles;
  const SurfaceDistanceFit fit(points, start, start, options, 1);
  std::vector<double> x = fit.StartVector();
  Random random(9);
  for (double& value : x) value += 0.1 * random.Normal();
  const NurbsSurface surface = fit.SurfaceAt(x);
  EXPECT_TRUE(SurfaceCells(surface).poles().begin && SurfaceCells(surface).poles().end);
  const Eigen::Vector3d normal = surface.EvaluateWithDerivatives(0, 1e-7).Normal();
  for (int k = 1; k < 9; ++k) {
    EXPECT_LT((surface.EvaluateWithDerivatives(k / 9.0, 1e-7).Normal() - normal).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace frond
