// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/fold_hinge.h"

#include <Eigen/Geometry>
#include <array>

namespace frond {

FoldHinge::FoldHinge(const SurfaceCells& reference, double limit) : limit_(limit) {
  const SpanPolynomials &su = reference.u(), &sv = reference.v();
  double mean = 0;
  for (int ku = 0; ku < su.count(); ++ku) {
    for (int kv = 0; kv < sv.count(); ++kv) {
      for (int i = 0; i < kSamples; ++i) {
        for (int j = 0; j < kSamples; ++j) {
          const double u = su.begin(ku) + su.length(ku) * (i + 0.5) / kSamples;
          const double v = sv.begin(kv) + sv.length(kv) * (j + 0.5) / kSamples;
          const SurfaceCells::Jet1 jet = reference.Evaluate1(u, v);
          samples_.push_back({u, v, jet.du.cross(jet.dv)});
          mean += samples_.back().normal.norm();
        }
      }
    }
  }
  mean /= static_cast<double>(samples_.size());
  for (Sample& sample : samples_) {
    const double density = sample.normal.squaredNorm();
    if (density > 1e-12 * mean * mean) {
      sample.normal /= density;  // n₀ / J₀ = (S_u × S_v) / J₀²
    } else {
      sample.normal.setZero();
    }
  }
}

double FoldHinge::SquaredResiduals(const SurfaceCells& cells, int cell, double scale) const {
  double sum = 0;
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const Sample& sample = samples_[static_cast<std::size_t>(cell * kSamples * kSamples + k)];
    if (sample.normal.isZero()) continue;
    const SurfaceCells::Jet1 jet = cells.Evaluate1(sample.u, sample.v);
    const double short_of = limit_ - jet.du.cross(jet.dv).dot(sample.normal);
    if (short_of > 0) sum += scale * scale * short_of * short_of;
  }
  return sum;
}

double FoldHinge::AddRows(const SurfaceCells& cells, int cell, double scale, const ControlNet& net,
                          const CellBlocks& layout, const std::vector<Eigen::Vector3d>& control_points,
                          const std::vector<double>& weights, Eigen::MatrixXd* h, Eigen::VectorXd* g) const {
  const SpanPolynomials &su = cells.u(), &sv = cells.v();
  const int ku = cell / sv.count(), kv = cell % sv.count(), p = su.degree(), q = sv.degree();
  const int d = net.block_size();
  std::array<double, 2 * (kMaxDegree + 1)> nu, nv;
  double sum = 0;
  Eigen::VectorXd row(g->size());
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const Sample& sample = samples_[static_cast<std::size_t>(cell * kSamples * kSamples + k)];
    if (sample.normal.isZero()) continue;
    const SurfaceCells::Jet1 jet = cells.Evaluate1(sample.u, sample.v);
    const double kept = jet.du.cross(jet.dv).dot(sample.normal);
    if (kept >= limit_) continue;
    su.Evaluate(ku, sample.u, 1, nu.data());
    sv.Evaluate(kv, sample.v, 1, nv.data());
    double w = 0, wu = 0, wv = 0;  // the denominator and its derivatives
    for (int a = 0, m = 0; a <= p; ++a) {
      for (int b = 0; b <= q; ++b, ++m) {
        const double weight = weights[layout.control_points[static_cast<std::size_t>(m)]];
        const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
        w += nu[ia] * nv[ib] * weight;
        wu += nu[ia + static_cast<std::size_t>(p) + 1] * nv[ib] * weight;
        wv += nu[ia] * nv[ib + static_cast<std::size_t>(q) + 1] * weight;
      }
    }
    const Eigen::Vector3d by_du = jet.dv.cross(sample.normal), by_dv = sample.normal.cross(jet.du);
    row.setZero();
    for (int a = 0, m = 0; a <= p; ++a) {
      for (int b = 0; b <= q; ++b, ++m) {
        const auto im = static_cast<std::size_t>(m), ia = static_cast<std::size_t>(a),
                   ib = static_cast<std::size_t>(b);
        const double weight = weights[layout.control_points[im]];
        const double r = nu[ia] * nv[ib] * weight / w;
        const double ru = (nu[ia + static_cast<std::size_t>(p) + 1] * nv[ib] * weight - wu * r) / w;
        const double rv = (nu[ia] * nv[ib + static_cast<std::size_t>(q) + 1] * weight - wv * r) / w;
        const Eigen::Vector3d by_point = ru * by_du + rv * by_dv;
        if (net.unknowns() != SurfaceUnknowns::kWeights) {
          for (const BlockTerm& term : layout.terms[im]) {
            row.segment<3>(term.block * d) -= scale * term.factor * by_point;
          }
        }
        if (net.unknowns() != SurfaceUnknowns::kControlPoints) {  // ∂S_u/∂ω = R_u (P − S) − R S_u
          row[layout.terms[im][0].block * d + d - 1] -=
              scale * (by_point.dot(control_points[layout.control_points[im]] - jet.position) - 2 * r * kept);
        }
      }
    }
    const double residual = scale * (limit_ - kept);
    h->selfadjointView<Eigen::Upper>().rankUpdate(row);
    *g += residual * row;
    sum += residual * residual;
  }
  return sum;
}

}  // namespace frond
