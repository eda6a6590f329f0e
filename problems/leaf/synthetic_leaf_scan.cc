// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/synthetic_leaf_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"

namespace frond {
namespace {

struct BladePoint {
  double a, b;
};

struct Disc {
  double a, b, radius;
};

void Require(bool holds, const char* rule) {
  if (!holds) throw ConfigError(std::string("synthetic leaf scan: ") + rule);
}

void CheckOptions(const LeafScanOptions& o) {
  Require(o.points >= 1 && o.points <= 100'000'000, "'points' must be in [1, 1e8]");
  Require(o.dense_points >= 0 && o.dense_points <= 100'000'000, "'dense_points' must be in [0, 1e8]");
  Require(o.noise >= 0 && o.noise <= 10, "'noise' must be in [0, 10] mm");
  Require(o.outlier_share >= 0 && o.outlier_share <= 0.9, "'outlier_share' must be in [0, 0.9]");
  Require(o.outlier_near >= 0 && o.outlier_far >= o.outlier_near && o.outlier_far < 1e6,
          "'outlier_near' and 'outlier_far' must be lengths in order");
  Require(o.holes >= 0 && o.holes <= 1000, "'holes' must be in [0, 1000]");
  Require(o.hole_radius >= 0 && o.hole_radius < 1e3, "'hole_radius' must be in [0, 1000] mm");
  Require(o.missing_tip >= 0 && o.missing_tip <= 0.9, "'missing_tip' must be in [0, 0.9]");
  Require(o.petiole_length >= 0 && o.petiole_length <= 1e3, "'petiole_length' must be in [0, 1000] mm");
  Require(o.unit_mm > 0 && o.unit_mm < 1e9, "'unit' must be positive");
}

Eigen::Vector3d RandomDirection(Random& random) {
  const double z = random.Uniform(-1, 1), angle = random.Uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Isometry3d RandomPose(std::uint64_t seed, double shift) {
  Random random = Random::ForKey(seed, "leaf pose");
  Eigen::Quaterniond q(random.Normal(), random.Normal(), random.Normal(), random.Normal());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << random.Uniform(-shift, shift), random.Uniform(-shift, shift),
      random.Uniform(-shift, shift);
  return pose;
}

// Draws places uniformly by area: uniformly on the blade's bounding rectangle, kept with a probability
// proportional to the area element.
class BladeSampler {
 public:
  explicit BladeSampler(const SyntheticLeaf& leaf) : leaf_(leaf) {
    constexpr int kGrid = 120;
    const double length = leaf.shape().length;
    for (int i = 0; i <= 4 * kGrid; ++i) {
      const double a = length * i / (4 * kGrid);
      half_width_ = std::max({half_width_, leaf.HalfWidth(a, 1), leaf.HalfWidth(a, -1)});
    }
    half_width_ += leaf.shape().tooth_depth;  // between the grid's lines
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; j <= 2 * kGrid; ++j) {
        const double b = half_width_ * (static_cast<double>(j) / kGrid - 1);
        element_ = std::max(element_, leaf.Evaluate(length * i / kGrid, b).area_element);
      }
    }
    element_ *= 1.05;
  }

  BladePoint Draw(Random& random) const {
    for (;;) {
      const double a = random.Uniform(0, leaf_.shape().length);
      const double b = random.Uniform(-half_width_, half_width_);
      if (std::abs(b) > leaf_.HalfWidth(a, b > 0 ? 1 : -1)) continue;
      if (random.Uniform() * element_ < leaf_.Evaluate(a, b).area_element) return {a, b};
    }
  }

 private:
  const SyntheticLeaf& leaf_;
  double half_width_ = 0, element_ = 0;
};

// What the scanner does not see: holes and the missing tip.
class Gaps {
 public:
  Gaps(const BladeSampler& sampler, const LeafShape& shape, const LeafScanOptions& options)
      : end_(shape.length * (1 - options.missing_tip)) {
    Random random = Random::ForKey(options.seed, "leaf holes");
    for (int i = 0; i < options.holes; ++i) {
      const BladePoint p = sampler.Draw(random);
      holes_.push_back({p.a, p.b, options.hole_radius});
    }
  }

  bool Sees(const BladePoint& p) const {
    return p.a <= end_ && std::none_of(holes_.begin(), holes_.end(), [&](const Disc& d) {
             return std::hypot(p.a - d.a, p.b - d.b) < d.radius;
           });
  }

 private:
  double end_;
  std::vector<Disc> holes_;
};

// Half a tube of the base edge's width that goes on from the base against the midrib's direction, open
// downwards.
class Petiole {
 public:
  Petiole(const SyntheticLeaf& leaf, double length)
      : length_(length), radius_(0.5 * leaf.shape().petiole_width) {
    const SyntheticLeaf::Sample base = leaf.Evaluate(0, 0);
    origin_ = base.position;
    back_ = (leaf.Position(0, 0) - leaf.Position(1e-3 * leaf.shape().length, 0)).normalized();
    up_ = base.normal;
    side_ = back_.cross(up_);
  }

  double Area() const { return std::numbers::pi * radius_ * length_; }

  SyntheticLeaf::Sample Draw(Random& random) const {
    const double along = random.Uniform(0, length_), angle = random.Uniform(0, std::numbers::pi);
    const Eigen::Vector3d normal = std::cos(angle) * side_ + std::sin(angle) * up_;
    const Eigen::Vector3d axis = origin_ + along * back_ - 0.004 * along * along * up_;
    return {axis + radius_ * (normal - up_ * std::max(0.0, 1 - along / (2 * radius_))), normal, 1};
  }

 private:
  double length_, radius_;
  Eigen::Vector3d origin_, back_, up_, side_;
};

Eigen::Vector3d Noise(const LeafScanOptions& o, const Eigen::Vector3d& normal, Random& random) {
  if (o.noise_direction == NoiseDirection::kNormal) return o.noise * random.Normal() * normal;
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return o.noise * Eigen::Vector3d(x, y, z);
}

void DrawScan(const SyntheticLeaf& leaf, const BladeSampler& sampler, const Gaps& gaps, double blade_area,
              const LeafScanOptions& o, LeafScan* scan) {
  Random random = Random::ForKey(o.seed, "leaf scan");
  const Petiole petiole(leaf, o.petiole_length);
  const double petiole_share = petiole.Area() / (petiole.Area() + blade_area);
  const int outliers = static_cast<int>(std::lround(o.outlier_share * o.points));
  for (int i = 0; i < o.points; ++i) {
    ScanPointKind kind = ScanPointKind::kBlade;
    SyntheticLeaf::Sample clean;
    if (o.petiole_length > 0 && random.Uniform() < petiole_share) {
      kind = ScanPointKind::kPetiole;
      clean = petiole.Draw(random);
    } else {
      BladePoint p = sampler.Draw(random);
      while (!gaps.Sees(p)) p = sampler.Draw(random);
      clean = leaf.Evaluate(p.a, p.b);
    }
    Eigen::Vector3d measured = clean.position + Noise(o, clean.normal, random);
    if (i < outliers) {
      kind = ScanPointKind::kOutlier;
      measured = clean.position + random.Uniform(o.outlier_near, o.outlier_far) * RandomDirection(random);
    }
    scan->points.push_back(measured);
    scan->clean_points.push_back(clean.position);
    scan->kinds.push_back(kind);
  }
  for (std::size_t i = scan->points.size(); i-- > 1;) {  // outliers anywhere in the file
    const std::size_t j = static_cast<std::size_t>(random.Below(i + 1));
    std::swap(scan->points[i], scan->points[j]);
    std::swap(scan->clean_points[i], scan->clean_points[j]);
    std::swap(scan->kinds[i], scan->kinds[j]);
  }
}

void DrawDense(const SyntheticLeaf& leaf, const BladeSampler& sampler, const Gaps& gaps,
               const LeafScanOptions& o, LeafScan* scan) {
  Random random = Random::ForKey(o.seed, "leaf dense");
  for (int i = 0; i < o.dense_points; ++i) {
    const BladePoint p = sampler.Draw(random);
    scan->dense_clean.push_back(leaf.Position(p.a, p.b));
    scan->dense_scanned.push_back(gaps.Sees(p) ? 1 : 0);
  }
}

LeafMeasures InUnit(const LeafMeasures& m, double unit) {
  return {m.area / (unit * unit), m.length / unit,    m.midrib_length / unit,
          m.width / unit,         m.perimeter / unit, m.perimeter_smooth / unit};
}

void CollectValues(const LeafShape& shape, const LeafScanOptions& o, LeafScan* scan) {
  for (const auto& [name, value] : ShapeValues(shape)) scan->values["shape." + name] = value;
  const auto add = [&](const char* name, double value) { scan->values[name] = value; };
  add("scan.seed", static_cast<double>(o.seed));
  add("scan.points", o.points);
  add("scan.noise", o.noise);
  add("scan.noise_along_normal", o.noise_direction == NoiseDirection::kNormal ? 1 : 0);
  add("scan.outlier_share", o.outlier_share);
  add("scan.outlier_near", o.outlier_near);
  add("scan.outlier_far", o.outlier_far);
  add("scan.holes", o.holes);
  add("scan.hole_radius", o.hole_radius);
  add("scan.missing_tip", o.missing_tip);
  add("scan.petiole_length", o.petiole_length);
  add("scan.unit_mm", o.unit_mm);
  add("measures.area", scan->measures.area);
  add("measures.length", scan->measures.length);
  add("measures.midrib_length", scan->measures.midrib_length);
  add("measures.width", scan->measures.width);
  add("measures.perimeter", scan->measures.perimeter);
  add("measures.perimeter_smooth", scan->measures.perimeter_smooth);
  add("measures.scanned_area", scan->scanned_area);
}

}  // namespace

LeafScan ScanLeaf(const LeafShape& shape, const LeafScanOptions& options) {
  CheckOptions(options);
  const SyntheticLeaf leaf(shape);
  const BladeSampler sampler(leaf);
  const Gaps gaps(sampler, shape, options);
  LeafScan scan;
  scan.pose =
      options.random_pose ? RandomPose(options.pose_seed, options.pose_shift) : Eigen::Isometry3d::Identity();
  const LeafMeasures measures = leaf.Measure();
  DrawScan(leaf, sampler, gaps, measures.area, options, &scan);
  DrawDense(leaf, sampler, gaps, options, &scan);
  for (auto* cloud : {&scan.points, &scan.clean_points, &scan.dense_clean}) {
    for (Eigen::Vector3d& p : *cloud) p = scan.pose * p / options.unit_mm;
  }
  scan.measures = InUnit(measures, options.unit_mm);
  const auto seen = std::count(scan.dense_scanned.begin(), scan.dense_scanned.end(), std::uint8_t{1});
  scan.scanned_area = scan.dense_scanned.empty() ? scan.measures.area
                                                 : scan.measures.area * static_cast<double>(seen) /
                                                       static_cast<double>(scan.dense_scanned.size());
  CollectValues(shape, options, &scan);
  return scan;
}

}  // namespace frond
