// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/errors.h"
#include "base/parallel.h"
#include "models/cubic_image.h"

namespace frond {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Value>
void CheckSize(const Raster<Value>& raster, const TurntableView& view, const PinholeCamera& camera,
               const char* what) {
  if (raster.width == camera.width && raster.height == camera.height) return;
  throw InputError(view.name + ": " + what + " of " + std::to_string(raster.width) + " x " +
                   std::to_string(raster.height) + " pixels, but the camera was calibrated for " +
                   std::to_string(camera.width) + " x " + std::to_string(camera.height));
}

// A ray of the camera in the disk's frame, where the disk's turn does not matter: heights and distances from
// the axis.
struct AxisRay {
  Eigen::Vector3d origin, direction;

  double ClosestParameter() const {
    return -origin.head<2>().dot(direction.head<2>()) / direction.head<2>().squaredNorm();
  }
  double ClosestDistance() const { return (origin + ClosestParameter() * direction).head<2>().norm(); }
};

AxisRay RayOf(const TurntableRig& rig, int x, int y) {
  const Eigen::Isometry3d disk_from_camera = rig.camera_from_disk.inverse();
  return {.origin = disk_from_camera.translation(),
          .direction = disk_from_camera.linear() * rig.camera.Ray({x, y})};
}

// The silhouette's pixels that can be its outermost: the ends of each row and column.
template <typename Visit>
void VisitOutline(const Mask& mask, const Visit& visit) {
  for (int y = 0; y < mask.height; ++y) {
    const auto row = mask.values.begin() + static_cast<std::ptrdiff_t>(mask.Index(0, y));
    const auto end = row + mask.width;
    const auto first = std::find(row, end, 1);
    if (first == end) continue;
    visit(static_cast<int>(first - row), y);
    visit(
        mask.width - 1 -
            static_cast<int>(std::find(std::make_reverse_iterator(end), std::make_reverse_iterator(row), 1) -
                             std::make_reverse_iterator(end)),
        y);
  }
  for (int x = 0; x < mask.width; ++x) {
    int first = 0, last = mask.height - 1;
    while (first < mask.height && mask(x, first) == 0) ++first;
    if (first == mask.height) continue;
    while (mask(x, last) == 0) --last;
    visit(x, first);
    visit(x, last);
  }
}

// Points of the cylinder's two rims and its middle.
std::vector<Eigen::Vector3d> PointsOf(const BoundingCylinder& cylinder) {
  constexpr int kAround = 72;
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < kAround; ++k) {
    const double u = 2 * std::numbers::pi * k / kAround,
                 r = cylinder.radius / std::cos(std::numbers::pi / kAround);
    for (const double z : {cylinder.bottom, cylinder.top}) {
      points.emplace_back(r * std::cos(u), r * std::sin(u), z);
    }
  }
  return points;
}

// The four pixels about (x, y), for linear interpolation; false outside.
struct LinearCell {
  int x = 0, y = 0;
  double a = 0, b = 0;

  template <typename Value>
  bool Set(const Eigen::Vector2d& pixel, const Raster<Value>& raster) {
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= raster.width - 1 &&
          pixel.y() <= raster.height - 1)) {
      return false;
    }
    x = std::min(static_cast<int>(pixel.x()), raster.width - 2);
    y = std::min(static_cast<int>(pixel.y()), raster.height - 2);
    a = pixel.x() - x;
    b = pixel.y() - y;
    return true;
  }
  template <typename Get>
  double Value(const Get& get) const {
    return (1 - b) * ((1 - a) * get(x, y) + a * get(x + 1, y)) +
           b * ((1 - a) * get(x, y + 1) + a * get(x + 1, y + 1));
  }
};

struct Resampled {
  Image image;
  Mask mask;
  ColourImage colour;
};

Resampled Resample(const TurntableView& view, const PinholeCamera& camera, const Rectification& normal,
                   std::size_t side, bool with_colour, int threads) {
  const CubicImage grey(view.image);
  Resampled out{.image = Image(normal.width, normal.height, 0),
                .mask = Mask(normal.width, normal.height, 0),
                .colour = with_colour ? ColourImage(normal.width, normal.height) : ColourImage()};
  const Eigen::Matrix3d to_camera = normal.rotation[side].transpose();
  ParallelFor(static_cast<std::size_t>(normal.height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < normal.width; ++x) {
        const Eigen::Vector3d direction =
            to_camera * Eigen::Vector3d((x - normal.cx[side]) / normal.f, (y - normal.cy) / normal.f, 1);
        LinearCell cell;
        if (!(direction.z() > 0) || !cell.Set(camera.Project(direction), view.image)) continue;
        out.image(x, y) = static_cast<float>(grey.ValueAt(cell.x + cell.a, cell.y + cell.b));
        const double inside =
            view.mask.empty() ? 1 : cell.Value([&](int i, int k) { return double(view.mask(i, k)); });
        out.mask(x, y) = inside >= 0.5 ? 1 : 0;
        if (!with_colour) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          out.colour(x, y)[c] = static_cast<std::uint8_t>(
              std::lround(cell.Value([&](int i, int k) { return double(view.colour(i, k)[c]); })));
        }
      }
    }
  });
  return out;
}

}  // namespace

BoundingCylinder CylinderOfSilhouettes(std::span<const TurntableView> views, const TurntableRig& rig,
                                       double margin) {
  BoundingCylinder cylinder{.radius = 0, .bottom = kInfinity, .top = -kInfinity};
  for (const TurntableView& view : views) {
    CheckSize(view.mask, view, rig.camera, "a mask");
    double radius = -1;
    VisitOutline(view.mask,
                 [&](int x, int y) { radius = std::max(radius, RayOf(rig, x, y).ClosestDistance()); });
    if (radius < 0) throw InputError(view.name + ": the mask is empty; no pixel is of the object");
    cylinder.radius = std::max(cylinder.radius, radius);
  }
  for (const TurntableView& view : views) {
    VisitOutline(view.mask, [&](int x, int y) {
      const AxisRay ray = RayOf(rig, x, y);
      const double closest = ray.ClosestParameter(), distance = ray.ClosestDistance();
      const double half = std::sqrt(std::max(0.0, cylinder.radius * cylinder.radius - distance * distance)) /
                          ray.direction.head<2>().norm();
      for (const double t : {closest - half, closest + half}) {
        cylinder.bottom = std::min(cylinder.bottom, ray.origin.z() + t * ray.direction.z());
        cylinder.top = std::max(cylinder.top, ray.origin.z() + t * ray.direction.z());
      }
    });
  }
  const double more = margin * std::max(cylinder.radius, cylinder.Height() / 2);
  return {.radius = cylinder.radius + more, .bottom = cylinder.bottom - more, .top = cylinder.top + more};
}

Rectification CropToCylinder(const TurntableRig& rig, double left_angle, double right_angle,
                             const BoundingCylinder& cylinder, std::array<double, 2>* disparities) {
  constexpr double kBorder = 8;  // pixels, half a window
  const Eigen::Isometry3d camera_from_disk = rig.CameraFromDisk(left_angle * kRadians);
  const Eigen::Vector3d middle(0, 0, (cylinder.bottom + cylinder.top) / 2);
  Rectification normal =
      Rectify(rig.Pair(left_angle * kRadians, right_angle * kRadians), camera_from_disk * middle);
  Eigen::Array3d least = Eigen::Array3d::Constant(kInfinity), most = -least;
  for (const Eigen::Vector3d& point : PointsOf(cylinder)) {
    const Eigen::Vector3d seen = camera_from_disk * point;
    if (!((normal.rotation[0] * seen).z() > 0)) {
      throw InputError("the object's cylinder of radius " + std::to_string(cylinder.radius) +
                       " reaches behind the camera; check the masks and the calibration's unit");
    }
    const Eigen::Array3d projected = normal.Project(seen).array();
    least = least.min(projected);
    most = most.max(projected);
    // In the right image a point is its disparity further to the left.
    least.x() = std::min(least.x(), projected.x() - projected.z());
    most.x() = std::max(most.x(), projected.x() - projected.z());
  }
  *disparities = {least.z(), most.z()};
  const double first_x = std::floor(least.x() - kBorder), first_y = std::floor(least.y() - kBorder);
  normal.width = static_cast<int>(std::ceil(most.x() + kBorder) - first_x) + 1;
  normal.height = static_cast<int>(std::ceil(most.y() + kBorder) - first_y) + 1;
  if (normal.width > 4 * rig.camera.width || normal.height > 4 * rig.camera.height) {
    throw InputError("the object's cylinder of radius " + std::to_string(cylinder.radius) +
                     " is far larger than the image; check the masks and the calibration");
  }
  for (double& cx : normal.cx) cx -= first_x;
  normal.cy -= first_y;
  return normal;
}

NormalPair RectifyViews(const TurntableView& left, const TurntableView& right, const TurntableRig& rig,
                        const BoundingCylinder& cylinder, int threads) {
  for (const TurntableView* view : {&left, &right}) {
    CheckSize(view->image, *view, rig.camera, "an image");
    if (!view->mask.empty()) CheckSize(view->mask, *view, rig.camera, "a mask");
    if (!view->colour.empty()) CheckSize(view->colour, *view, rig.camera, "an image");
  }
  std::array<double, 2> disparities{};
  NormalPair pair;
  pair.normal = CropToCylinder(rig, left.angle, right.angle, cylinder, &disparities);
  pair.min_disparity = disparities[0];
  pair.max_disparity = disparities[1];
  Resampled first = Resample(left, rig.camera, pair.normal, 0, !left.colour.empty(), threads);
  Resampled second = Resample(right, rig.camera, pair.normal, 1, false, threads);
  pair.left = std::move(first.image);
  pair.left_mask = std::move(first.mask);
  pair.left_colour = std::move(first.colour);
  pair.right = std::move(second.image);
  pair.right_mask = std::move(second.mask);
  return pair;
}

}  // namespace frond
