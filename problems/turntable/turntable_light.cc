// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turntable_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace frond {
namespace {

constexpr float kWhite = 255;
constexpr float kRoom = 9;  // grey levels
constexpr double kDiskAlbedo = 0.09;
constexpr double kDiskGrain = 1.5;                        // mm
constexpr double kUpShare = 0.2;                          // of the ambient light, from above alone
constexpr double kFootShade = 0.5;                        // of the ambient light, lost at the foot …
constexpr double kFootReach = 0.06;                       // … and over this share of the height
constexpr double kStalkShade = 0.5, kStalkRadius = 0.02;  // dark spot at the stalk end
constexpr double kBlotch = 0.09;                          // grain of the blotches of colour over the height
constexpr int kMargin = 3;                                // pixels around boxes

using Colour = std::array<double, 3>;

// Of luminance 1 each: a ripe pear's green-yellow and its blush.
Colour Tint(double blush) {
  constexpr Colour kSkin = {1.08, 1.08, 0.38}, kBlush = {1.62, 0.78, 0.51};
  Colour tint{};
  for (std::size_t c = 0; c < 3; ++c) tint[c] = kSkin[c] + blush * (kBlush[c] - kSkin[c]);
  const double luminance = 0.299 * tint[0] + 0.587 * tint[1] + 0.114 * tint[2];
  for (double& c : tint) c /= luminance;
  return tint;
}

}  // namespace

PixelBox BoxAround(const PinholeCamera& camera, std::span<const Eigen::Vector3d> points, int margin) {
  double x0 = camera.width, y0 = camera.height, x1 = 0, y1 = 0;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d pixel = camera.Project(p);
    x0 = std::min(x0, pixel.x());
    x1 = std::max(x1, pixel.x());
    y0 = std::min(y0, pixel.y());
    y1 = std::max(y1, pixel.y());
  }
  return {.x0 = std::max(static_cast<int>(std::floor(x0)) - margin, 0),
          .y0 = std::max(static_cast<int>(std::floor(y0)) - margin, 0),
          .x1 = std::min(static_cast<int>(std::ceil(x1)) + margin + 1, camera.width),
          .y1 = std::min(static_cast<int>(std::ceil(y1)) + margin + 1, camera.height)};
}

TurntableLight::TurntableLight(const TurntableScene& scene, double angle, bool with_pear, bool colour)
    : scene_(scene),
      with_pear_(with_pear),
      colour_(colour),
      camera_from_disk_(scene.rig.CameraFromDisk(angle)),
      disk_from_camera_(camera_from_disk_.inverse()),
      eye_(disk_from_camera_.translation()),
      to_lamp_(disk_from_camera_.linear() * scene.lighting.ToLamp()) {}

Eigen::Vector3d TurntableLight::Direction(double u, double v) const {
  return disk_from_camera_.linear() * scene_.rig.camera.Ray({u, v});
}

std::optional<Eigen::Vector3d> TurntableLight::OnDisk(const Eigen::Vector3d& direction) const {
  const double t = (scene_.pear_origin.z() - eye_.z()) / direction.z();
  if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
  const Eigen::Vector3d point = eye_ + t * direction;
  if (point.head<2>().norm() > scene_.disk_radius) return std::nullopt;
  return point;
}

std::array<float, 3> TurntableLight::Room() const { return {kRoom, kRoom, kRoom}; }

std::array<float, 3> TurntableLight::Seen(double u, double v) const {
  const Eigen::Vector3d direction = Direction(u, v);
  if (with_pear_) {
    if (const auto point = CastRay(scene_, eye_, direction)) return OfPear(*point, direction);
  }
  if (const auto point = OnDisk(direction)) return OfDisk(*point);
  return Room();
}

bool TurntableLight::SeesPear(double u, double v) const {
  return with_pear_ && CastRay(scene_, eye_, Direction(u, v)).has_value();
}

std::array<float, 3> TurntableLight::OfPear(const Eigen::Vector3d& point,
                                            const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d p = point - scene_.pear_origin;
  const Eigen::Vector3d normal = scene_.pear.Normal(p);
  const double height = scene_.pear.shape().height, towards = normal.dot(to_lamp_);
  const double foot = 1 - kFootShade * std::exp(-p.z() / (kFootReach * height));
  const double ambient = scene_.lighting.ambient * (1 - kUpShare + kUpShare * normal.z()) * foot;
  const double stalk =
      (scene_.pear.Position(0, 0) - p).squaredNorm() / (kStalkRadius * kStalkRadius * height * height);
  const double albedo = scene_.albedo * (1 + scene_.contrast * scene_.speckle.Value(p)) *
                        (1 - kStalkShade * std::exp(-stalk / 2));
  const double diffuse = std::max(albedo, 0.0) * (ambient + scene_.lighting.diffuse * std::max(towards, 0.0));
  double specular = 0;
  if (towards > 0) {
    const Eigen::Vector3d mirrored = 2 * towards * normal - to_lamp_;
    const double glance = std::max(-mirrored.dot(direction) / direction.norm(), 0.0);
    specular = scene_.lighting.specular * std::pow(glance, scene_.lighting.shininess);
  }
  if (!colour_) {
    const float grey = kWhite * static_cast<float>(diffuse + specular);
    return {grey, grey, grey};
  }
  const SolidTexture blotches(7, kBlotch * height);
  const Colour tint = Tint(1 / (1 + std::exp(-2.5 * (p.x() / (0.3 * height) + 0.7 * blotches.Value(p)))));
  std::array<float, 3> light{};
  for (std::size_t c = 0; c < 3; ++c) light[c] = kWhite * static_cast<float>(diffuse * tint[c] + specular);
  return light;
}

std::array<float, 3> TurntableLight::OfDisk(const Eigen::Vector3d& point) const {
  const bool shaded = with_pear_ && CastRay(scene_, point, to_lamp_).has_value();
  const SolidTexture speckle(8, kDiskGrain);
  const double light = scene_.lighting.ambient + (shaded ? 0 : scene_.lighting.diffuse * to_lamp_.z());
  const float grey =
      kWhite * static_cast<float>(kDiskAlbedo * (1 + 0.3 * speckle.Value(point)) * std::max(light, 0.0));
  return {grey, grey, grey};
}

PixelBox TurntableLight::PearBox() const {
  if (!with_pear_) return {};
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : scene_.pear.Mesh(40, 40).vertices) {
    points.push_back(camera_from_disk_ * (scene_.pear_origin + p));
  }
  return BoxAround(scene_.rig.camera, points, kMargin);
}

PixelBox TurntableLight::DiskBox() const {
  constexpr int kAround = 180;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAround;
    points.push_back(camera_from_disk_ * Eigen::Vector3d(scene_.disk_radius * std::cos(angle),
                                                         scene_.disk_radius * std::sin(angle),
                                                         scene_.pear_origin.z()));
  }
  return BoxAround(scene_.rig.camera, points, kMargin);
}

}  // namespace frond
