// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_merge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "base/errors.h"
#include "base/median.h"
#include "base/parallel.h"
#include "models/kd_tree.h"
#include "problems/turntable/contradicted_points.h"
#include "problems/turntable/local_quadric_fit.h"

namespace frond {
namespace {

constexpr std::size_t kChunk = 256;
constexpr std::size_t kNeighbours = 64;  // KdTree's most
constexpr double kThinning = 0.6;        // spacings between merged points, at least
constexpr double kLeastShare = 0.02;     // of a view in a point, to be counted

double WeightOf(const ScanPoint& p) { return p.cosine * p.cosine / (p.sigma * p.sigma); }

std::vector<Eigen::Vector3d> PositionsOf(const std::vector<ScanPoint>& points) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const ScanPoint& p : points) positions.push_back(p.position);
  return positions;
}

// A place where the surface is sought.
struct Place {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

struct PlacedPoint {
  bool found = false;
  MergedPoint point;
  Eigen::Vector3d to_camera = Eigen::Vector3d::Zero();  // of its heaviest view
  double squares = 0;                                   // of the views' distances from it, along the normal
  std::vector<double> relative = {};                    // the same in their standard deviations
};

// One place for each cube and each side that the points of the cube face.
std::vector<Place> FindPlaces(const std::vector<ScanPoint>& points, double edge, double agreement) {
  using Cube = std::tuple<long, long, long>;
  std::vector<std::pair<Cube, std::size_t>> cubes;
  cubes.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d c = points[i].position / edge;
    cubes.emplace_back(Cube(std::lround(c.z()), std::lround(c.y()), std::lround(c.x())), i);
  }
  std::sort(cubes.begin(), cubes.end());
  std::vector<Place> places;
  std::vector<std::size_t> left;
  for (std::size_t begin = 0, end = 0; begin < cubes.size(); begin = end) {
    left.clear();
    for (end = begin; end < cubes.size() && cubes[end].first == cubes[begin].first; ++end) {
      left.push_back(cubes[end].second);
    }
    while (!left.empty()) {
      const std::size_t best = *std::max_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
        return WeightOf(points[a]) < WeightOf(points[b]);
      });
      Place place;
      double sum = 0;
      std::erase_if(left, [&](std::size_t i) {
        if (points[i].normal.dot(points[best].normal) < agreement) return false;
        const double weight = WeightOf(points[i]);
        sum += weight;
        place.position += weight * points[i].position;
        place.normal += weight * points[i].normal;
        return true;
      });
      place.position /= sum;
      place.normal.normalize();
      places.push_back(place);
    }
  }
  return places;
}

// Neighbours of a place, as heights over the plane through it.
struct Neighbourhood {
  std::vector<std::size_t> index;
  std::vector<HeightSample> samples;
};

class SurfaceAtPlaces {
 public:
  SurfaceAtPlaces(const std::vector<ScanPoint>& points, const MergeOptions& options, double spacing)
      : points_(points),
        options_(options),
        spacing_(spacing),
        positions_(PositionsOf(points)),
        tree_(positions_) {}

  PlacedPoint At(Place place) const {
    constexpr int kPasses = 2;  // the first finds the normal in which the second measures
    PlacedPoint placed;
    for (int pass = 0; pass < kPasses; ++pass) {
      const Eigen::Vector3d across = place.normal.unitOrthogonal(), along = place.normal.cross(across);
      const Neighbourhood near = NeighboursOf(place, across, along);
      if (near.samples.size() < options_.least_neighbours) return {};
      const HeightFit fit = FitHeight(near.samples, options_.outlier_sigmas);
      if (!fit.solved) return {};
      // Onto the surface, no farther than its points are.
      const double most = options_.reach * spacing_;
      place.position += std::clamp(fit.coefficients[0], -most, most) * place.normal;
      if (pass + 1 == kPasses) placed = Describe(place, near, fit);
      place.normal = (place.normal - fit.coefficients[1] * across - fit.coefficients[2] * along).normalized();
    }
    placed.point.normal = place.normal;
    return placed;
  }

 private:
  Neighbourhood NeighboursOf(const Place& place, const Eigen::Vector3d& across,
                             const Eigen::Vector3d& along) const {
    std::array<KdTree::Neighbour, kNeighbours> found;
    const double reach = options_.reach * spacing_;
    const std::size_t count = tree_.Nearest(place.position, found, reach);
    const double farthest = count == kNeighbours ? found[count - 1].squared_distance : reach * reach;
    Neighbourhood near;
    for (std::size_t k = 0; k < count; ++k) {
      const ScanPoint& p = points_[found[k].index];
      if (p.normal.dot(place.normal) < options_.normal_agreement) continue;
      const Eigen::Vector3d d = p.position - place.position;
      const double bell = 1 - found[k].squared_distance / (1.05 * farthest);
      near.index.push_back(found[k].index);
      near.samples.push_back({.x = d.dot(across),
                              .y = d.dot(along),
                              .height = d.dot(place.normal),
                              .sigma = p.NormalSigma(),
                              .weight = WeightOf(p) * bell * bell});
    }
    return near;
  }

  // A view's shares and what its points are off by.
  struct ViewShare {
    double share = 0, sigma = 0, off = 0;
  };

  PlacedPoint Describe(const Place& place, const Neighbourhood& near, const HeightFit& fit) const {
    PlacedPoint placed;
    placed.found = true;
    placed.point.position = place.position;
    std::map<int, ViewShare> views;
    Eigen::Vector3d colour = Eigen::Vector3d::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < near.index.size(); ++k) {
      const ScanPoint& p = points_[near.index[k]];
      const double share = std::abs(fit.share[k]);
      ViewShare& view = views[p.view];
      view.share += share;
      view.sigma += share * p.NormalSigma();
      view.off += fit.share[k] * fit.residual[k];
      sum += share;
      colour += share * Eigen::Vector3d(p.colour[0], p.colour[1], p.colour[2]);
      if (std::hypot(near.samples[k].x, near.samples[k].y) < spacing_) {
        placed.relative.push_back(std::abs(fit.residual[k]) / p.NormalSigma());
        placed.squares += fit.residual[k] * fit.residual[k];
      }
    }
    double variance = 0, scatter = 0;
    int count = 0, heaviest = 0;
    double most = 0;
    for (const auto& [number, view] : views) {
      variance += view.sigma * view.sigma;
      scatter += view.off * view.off;
      if (view.share >= kLeastShare * sum) ++count;
      if (view.share > most) {
        most = view.share;
        heaviest = number;
      }
    }
    placed.point.views = std::max(count, 1);
    if (count > 1) scatter *= static_cast<double>(count) / (count - 1);
    placed.point.sigma = std::sqrt(std::max(variance, scatter));
    for (int c = 0; c < 3; ++c) {
      placed.point.colour[static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(std::clamp(std::lround(colour[c] / sum), 0L, 255L));
    }
    for (const std::size_t i : near.index) {
      if (points_[i].view == heaviest) placed.to_camera = points_[i].to_camera;
    }
    return placed;
  }

  const std::vector<ScanPoint>& points_;
  const MergeOptions& options_;
  double spacing_;
  std::vector<Eigen::Vector3d> positions_;
  KdTree tree_;
};

// Of the points of a view to their nearest: the median over all views.
double SpacingOf(const std::vector<std::vector<ScanPoint>>& views) {
  std::vector<double> distances;
  for (const auto& view : views) {
    const std::vector<Eigen::Vector3d> positions = PositionsOf(view);
    if (positions.size() < 2) continue;
    const KdTree tree(positions);
    std::array<KdTree::Neighbour, 2> nearest;
    for (const Eigen::Vector3d& p : positions) {
      tree.Nearest(p, nearest);
      distances.push_back(std::sqrt(nearest[1].squared_distance));
    }
  }
  return Median(std::move(distances));
}

// Greedy, in the order given: 1 for points to be kept, none of one side nearer to another than `least`.
std::vector<std::uint8_t> ThinnedOut(const std::vector<PlacedPoint>& placed, double least, double agreement) {
  std::vector<Eigen::Vector3d> positions;
  for (const PlacedPoint& p : placed) positions.push_back(p.point.position);
  const KdTree tree(positions);
  std::vector<std::uint8_t> keep(placed.size(), 1);
  std::array<KdTree::Neighbour, kNeighbours> found;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::size_t count = tree.Nearest(positions[i], found, least);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t j = found[k].index;
      if (j < i && keep[j] && placed[i].point.normal.dot(placed[j].point.normal) > agreement) keep[i] = 0;
    }
  }
  return keep;
}

}  // namespace

std::vector<Eigen::Vector3d> MergedCloud::Positions() const {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const MergedPoint& p : points) positions.push_back(p.position);
  return positions;
}

MergedCloud MergeViews(const std::vector<std::vector<ScanPoint>>& views, const MergeOptions& options,
                       int threads) {
  std::vector<ScanPoint> points;
  for (const auto& view : views) points.insert(points.end(), view.begin(), view.end());
  if (points.empty()) throw InputError("no view of the turn has a point; there is no cloud to merge");
  MergedCloud cloud;
  cloud.points_in = points.size();
  cloud.spacing = options.spacing.value_or(SpacingOf(views));
  if (!(cloud.spacing > 0)) {
    throw InputError("the " + std::to_string(points.size()) +
                     " points of the turn tell no spacing; more windows have to be accepted");
  }
  const std::vector<Place> places = FindPlaces(points, cloud.spacing, options.normal_agreement);
  const SurfaceAtPlaces surface(points, options, cloud.spacing);
  std::vector<PlacedPoint> placed(places.size());
  ParallelFor(places.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) placed[i] = surface.At(places[i]);
  });
  cloud.isolated = std::erase_if(placed, [](const PlacedPoint& p) { return !p.found; });
  if (placed.empty())
    throw InputError("the points of the turn lie apart from each other; no surface is seen");

  std::vector<MergedPoint> merged;
  std::vector<Eigen::Vector3d> to_camera;
  for (const PlacedPoint& p : placed) {
    merged.push_back(p.point);
    to_camera.push_back(p.to_camera);
  }
  const std::vector<std::uint8_t> contradicted =
      ContradictedPoints(merged, to_camera, cloud.spacing, threads);
  std::size_t number = 0;
  cloud.contradicted = std::erase_if(placed, [&](const PlacedPoint&) { return contradicted[number++] != 0; });

  const std::vector<std::uint8_t> keep =
      ThinnedOut(placed, kThinning * cloud.spacing, options.normal_agreement);
  std::vector<double> relative;
  double squares = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!keep[i]) continue;
    cloud.points.push_back(placed[i].point);
    squares += placed[i].squares;
    relative.insert(relative.end(), placed[i].relative.begin(), placed[i].relative.end());
  }
  cloud.thickness = relative.empty() ? 0 : std::sqrt(squares / static_cast<double>(relative.size()));
  cloud.relative_thickness = 1.4826 * Median(std::move(relative));
  return cloud;
}

}  // namespace frond
