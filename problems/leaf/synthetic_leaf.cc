// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/synthetic_leaf.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;
using Jet2 = ceres::Jet<double, 2>;

struct CharacterName {
  LeafCharacter character;
  const char* name;
};
constexpr std::array<CharacterName, 4> kCharacters = {{{LeafCharacter::kHill, "hill"},
                                                       {LeafCharacter::kSmooth, "smooth"},
                                                       {LeafCharacter::kWrinkled, "wrinkled"},
                                                       {LeafCharacter::kFlat, "flat"}}};

// 8-point Gauss–Legendre rule on [−1, 1]; nodes are ±, weights shared.
constexpr std::array<double, 4> kGaussNode = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                              0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                0.1012285362903763};

template <typename F>
double Integrate(double begin, double end, int panels, const F& f) {
  double sum = 0;
  const double half = (end - begin) / (2 * panels);
  for (int i = 0; i < panels; ++i) {
    const double middle = begin + half * (2 * i + 1);
    for (std::size_t k = 0; k < kGaussNode.size(); ++k) {
      sum += kGaussWeight[k] * (f(middle - half * kGaussNode[k]) + f(middle + half * kGaussNode[k]));
    }
  }
  return sum * half;
}

// sin(x)/x and (1 − cos x)/x, smooth through 0.
template <typename T>
std::pair<T, T> ArcFactors(const T& x) {
  using std::cos, std::sin;
  const T x2 = x * x;
  if (x2 < 4e-3) {
    return {1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0)),
            x / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0)))};
  }
  return {sin(x) / x, (1.0 - cos(x)) / x};
}

// Every number of a shape, with the range it may have.
struct ShapeNumber {
  const char* name;
  double LeafShape::*member;
  double lower, upper;
};
constexpr ShapeNumber kShapeNumbers[] = {{"length", &LeafShape::length, 5, 1000},
                                         {"width", &LeafShape::width, 1, 1000},
                                         {"widest_at", &LeafShape::widest_at, 0.2, 0.7},
                                         {"tip_sharpness", &LeafShape::tip_sharpness, 0.5, 3},
                                         {"petiole_width", &LeafShape::petiole_width, 0.01, 500},
                                         {"tooth_depth", &LeafShape::tooth_depth, 0, 100},
                                         {"tooth_spacing", &LeafShape::tooth_spacing, 0.5, 1000},
                                         {"fold_slope", &LeafShape::fold_slope, -1.5, 1.5},
                                         {"crease_width", &LeafShape::crease_width, 0.05, 20},
                                         {"rib_height", &LeafShape::rib_height, 0, 2},
                                         {"rib_width", &LeafShape::rib_width, 0.2, 10},
                                         {"sag", &LeafShape::sag, -0.4, 0.4},
                                         {"tip_droop", &LeafShape::tip_droop, -0.3, 0.3},
                                         {"sideways", &LeafShape::sideways, -0.2, 0.2},
                                         {"curl_angle", &LeafShape::curl_angle, -120, 120},
                                         {"curl_change", &LeafShape::curl_change, -1, 1},
                                         {"twist", &LeafShape::twist, -180, 180},
                                         {"wrinkle_height", &LeafShape::wrinkle_height, 0, 3},
                                         {"wrinkle_length", &LeafShape::wrinkle_length, 3, 1000},
                                         {"ruffle_height", &LeafShape::ruffle_height, 0, 5},
                                         {"ruffle_length", &LeafShape::ruffle_length, 3, 1000},
                                         {"vein_depth", &LeafShape::vein_depth, 0, 1},
                                         {"vein_spacing", &LeafShape::vein_spacing, 1, 1000}};

void RequireRange(const char* name, double value, double lower, double upper) {
  if (value >= lower && value <= upper) return;
  throw ConfigError("synthetic leaf: '" + std::string(name) + "' is " + std::to_string(value) +
                    ", must be in [" + std::to_string(lower) + ", " + std::to_string(upper) + "]");
}

void CheckShape(const LeafShape& s) {
  for (const ShapeNumber& n : kShapeNumbers) RequireRange(n.name, s.*n.member, n.lower, n.upper);
  RequireRange("width", s.width, 0.05 * s.length, 1.5 * s.length);
  RequireRange("petiole_width", s.petiole_width, 0, 0.5 * s.width);
  RequireRange("tooth_depth", s.tooth_depth, 0, 0.1 * s.width);
}

}  // namespace

const char* LeafCharacterName(LeafCharacter character) {
  for (const CharacterName& c : kCharacters) {
    if (c.character == character) return c.name;
  }
  return "";
}

LeafCharacter FindLeafCharacter(std::string_view name) {
  for (const CharacterName& c : kCharacters) {
    if (name == c.name) return c.character;
  }
  throw ConfigError("unknown leaf character '" + std::string(name) +
                    "' (known: hill, smooth, wrinkled, flat)");
}

LeafShape RandomLeaf(std::uint64_t seed) {
  return RandomLeaf(seed, kCharacters[static_cast<std::size_t>((seed + 3) % 4)].character);
}

LeafShape RandomLeaf(std::uint64_t seed, LeafCharacter character) {
  Random random = Random::ForKey(seed, "leaf shape");
  LeafShape s;
  s.character = character;
  s.seed = seed;
  s.length = random.Uniform(45, 85);
  s.width = s.length * random.Uniform(0.38, 0.46);
  s.widest_at = random.Uniform(0.40, 0.48);
  s.tip_sharpness = random.Uniform(0.9, 1.15);
  s.tooth_depth = random.Uniform(0.3, 0.5);
  s.tooth_spacing = random.Uniform(2.0, 3.0);
  s.crease_width = random.Uniform(0.9, 1.3);
  s.rib_width = random.Uniform(1.1, 1.5);
  s.vein_depth = random.Uniform(0.02, 0.04);
  s.vein_spacing = random.Uniform(6, 9);
  s.sag = random.Uniform(0.03, 0.09) * (random.Uniform() < 0.7 ? 1 : -1);
  s.tip_droop = random.Uniform(-0.02, 0.04);
  s.sideways = random.Uniform(-0.02, 0.02);
  s.curl_change = random.Uniform(-0.4, 0.4);
  s.ruffle_length = s.length * random.Uniform(0.3, 0.45);
  s.wrinkle_length = random.Uniform(14, 20);
  switch (character) {
    case LeafCharacter::kHill:
      s.fold_slope = random.Uniform(0.30, 0.50);
      s.rib_height = random.Uniform(0.25, 0.40);
      s.curl_angle = random.Uniform(-8, 12);
      s.twist = random.Uniform(-8, 8);
      s.ruffle_height = random.Uniform(0.0, 0.3);
      break;
    case LeafCharacter::kSmooth:
      s.fold_slope = random.Uniform(0.06, 0.14);
      s.rib_height = random.Uniform(0.30, 0.45);
      s.curl_angle = random.Uniform(22, 38);
      s.twist = random.Uniform(-8, 8);
      s.ruffle_height = random.Uniform(0.0, 0.3);
      break;
    case LeafCharacter::kWrinkled:
      s.fold_slope = random.Uniform(-0.10, 0.02);
      s.rib_height = random.Uniform(0.30, 0.45);
      s.curl_angle = random.Uniform(-35, -20);
      s.twist = random.Uniform(8, 16) * (random.Uniform() < 0.5 ? -1 : 1);
      s.wrinkle_height = random.Uniform(0.15, 0.22);
      s.ruffle_height = random.Uniform(0.5, 0.9);
      break;
    case LeafCharacter::kFlat:
      s.fold_slope = random.Uniform(-0.06, 0.0);
      s.rib_height = random.Uniform(0.25, 0.40);
      s.curl_angle = random.Uniform(-10, 2);
      s.sag *= 0.4;
      s.tip_droop *= 0.4;
      s.twist = random.Uniform(-5, 5);
      s.wrinkle_height = random.Uniform(0.06, 0.12);
      s.wrinkle_length *= 2;
      s.ruffle_height = random.Uniform(0.4, 0.8);
      s.ruffle_length *= 2;
      break;
  }
  return s;
}

std::map<std::string, double> ShapeValues(const LeafShape& shape) {
  std::map<std::string, double> values = {{"seed", static_cast<double>(shape.seed)}};
  for (const ShapeNumber& number : kShapeNumbers) values[number.name] = shape.*number.member;
  return values;
}

void SetShapeValue(LeafShape* shape, std::string_view name, double value) {
  for (const ShapeNumber& number : kShapeNumbers) {
    if (name != number.name) continue;
    shape->*number.member = value;
    return;
  }
  throw ConfigError("a synthetic leaf has no number '" + std::string(name) + "'");
}

SyntheticLeaf::SyntheticLeaf(const LeafShape& shape) : shape_(shape) {
  CheckShape(shape);
  // s^α (1 − s)^β is largest at α / (α + β).
  const double beta = shape.tip_sharpness;
  outline_base_exponent_ = beta * shape.widest_at / (1 - shape.widest_at);
  outline_scale_ =
      1 / (std::pow(shape.widest_at, outline_base_exponent_) * std::pow(1 - shape.widest_at, beta));
  Random random = Random::ForKey(shape.seed, "leaf phases");
  for (int k = 0; k < 3; ++k) {
    const double number = 2 * kPi / (shape.wrinkle_length * random.Uniform(0.8, 1.25));
    const double direction = (k + random.Uniform(0.1, 0.9)) * kPi / 3;
    wrinkles_.push_back(
        {number * std::cos(direction), number * std::sin(direction), random.Uniform(0, 2 * kPi)});
  }
  for (int side = 0; side < 2; ++side) {
    ruffle_phase_[side] = random.Uniform(0, 2 * kPi);
    tooth_phase_[side] = random.Uniform(0, 2 * kPi);
  }
}

double SyntheticLeaf::HalfWidth(double a, int side, bool teeth) const {
  const double s = std::clamp(a / shape_.length, 0.0, 1.0);
  const double blade =
      outline_scale_ * std::pow(s, outline_base_exponent_) * std::pow(1 - s, shape_.tip_sharpness);
  const double smooth = 0.5 * (shape_.width * blade + shape_.petiole_width * std::pow(1 - s, 3));
  if (!teeth || shape_.tooth_depth == 0) return smooth;
  // Skewed waves that rise slowly and fall steeply towards the tip, of slightly changing length; none near
  // the base, none at the very tip.
  const double phase =
      2 * kPi * a / shape_.tooth_spacing + 0.9 * std::sin(2 * kPi * a / 17) + tooth_phase_[side > 0 ? 1 : 0];
  const double tooth = std::sin(phase - 0.6 * std::sin(phase));
  const auto ramp = [](double t) { return t <= 0 ? 0.0 : t >= 1 ? 1.0 : t * t * (3 - 2 * t); };
  const double strength = ramp((s - 0.08) / 0.12) * ramp((0.985 - s) / 0.06);
  return smooth + 0.5 * shape_.tooth_depth * strength * tooth;
}

// Height of the blade above the curled sheet: fold, midrib, wrinkles, ruffles, secondary veins.
template <typename T>
T SyntheticLeaf::Relief(const T& a, const T& b) const {
  using std::exp, std::sin, std::sqrt;
  const LeafShape& p = shape_;
  const double crease = 0.5 * p.crease_width;
  const T s = a / p.length;
  T z = -p.fold_slope * (sqrt(b * b + crease * crease) - crease);
  const T r = b / (0.5 * p.rib_width);
  z += p.rib_height * (1.0 - 0.9 * s) * exp(-r * r);
  if (p.wrinkle_height != 0) {
    for (const Wave& w : wrinkles_) z += p.wrinkle_height * sin(w.a * a + w.b * b + w.phase);
  }
  if (p.ruffle_height != 0) {
    // The halves have phases of their own; the cube keeps the midrib twice differentiable.
    const int side = b > 0.0 ? 1 : 0;
    const T across = (side == 1 ? b : -b) / (0.5 * p.width);
    const double phase = ruffle_phase_[side];
    z += p.ruffle_height * across * across * across * sin(2 * kPi / p.ruffle_length * a + phase);
  }
  if (p.vein_depth != 0) {
    // Pairs of veins at 50° from the midrib, bending to the tip; they fade in away from the midrib.
    const T away = sqrt(b * b + 1.0);
    const T groove = sin(kPi / p.vein_spacing * (a - 0.8 * away - 0.02 * away * away));
    z -= p.vein_depth * (1.0 - 1.0 / away) * exp(-30.0 * groove * groove);
  }
  return z;
}

template <typename T>
Eigen::Matrix<T, 3, 1> SyntheticLeaf::PositionOf(const T& a, const T& b) const {
  using std::cos, std::sin, std::sqrt;
  using Vector = Eigen::Matrix<T, 3, 1>;
  const LeafShape& p = shape_;
  const T s = a / p.length;
  // Midrib: a parabola for the bow, a cubic for the tip, a sideways bow; with its tangent.
  const T bow = 4.0 * s * (1.0 - s), bow_slope = 4.0 - 8.0 * s;
  const Vector midrib(a, p.sideways * p.length * bow, p.length * (p.sag * bow - p.tip_droop * s * s * s));
  const Vector along(T(1.0), p.sideways * bow_slope, p.sag * bow_slope - 3.0 * p.tip_droop * s * s);
  const Vector tangent = along / sqrt(along.dot(along));
  Vector left = Vector(T(0.0), T(1.0), T(0.0)) - tangent * tangent.y();
  left = left / sqrt(left.dot(left));
  const Vector up = tangent.cross(left);
  const T twist = p.twist * kPi / 180 * (s - 0.5);
  const Vector left_t = left * cos(twist) + up * sin(twist);
  const Vector up_t = up * cos(twist) - left * sin(twist);
  // The cross-section is an arc with its margins down for a positive curl; the relief stands on it.
  const T curvature = p.curl_angle * kPi / 180 / (0.5 * p.width) * (1.0 + p.curl_change * (s - 0.5));
  const T angle = curvature * b;
  const auto [sine, versine] = ArcFactors(angle);
  const T relief = Relief(a, b);
  return midrib + left_t * (b * sine + relief * sin(angle)) + up_t * (relief * cos(angle) - b * versine);
}

Eigen::Vector3d SyntheticLeaf::Position(double a, double b) const { return PositionOf(a, b); }

SyntheticLeaf::Sample SyntheticLeaf::Evaluate(double a, double b) const {
  const Eigen::Matrix<Jet2, 3, 1> x = PositionOf(Jet2(a, 0), Jet2(b, 1));
  const Eigen::Vector3d da(x[0].v[0], x[1].v[0], x[2].v[0]), db(x[0].v[1], x[1].v[1], x[2].v[1]);
  const Eigen::Vector3d cross = da.cross(db);
  const double size = cross.norm();
  return {{x[0].a, x[1].a, x[2].a}, cross / size, size};
}

double SyntheticLeaf::Area() const {
  const int panels_along = std::max(60, static_cast<int>(4 * shape_.length / shape_.tooth_spacing));
  return Integrate(0, shape_.length, panels_along, [&](double a) {
    const auto element = [&](double b) { return Evaluate(a, b).area_element; };
    // Finer near the midrib, where the crease and the rib are.
    double strip = 0;
    for (const int side : {-1, 1}) {
      const double half = HalfWidth(a, side), near = std::min(half, 2.0);
      strip += Integrate(0, near, 3, [&](double b) { return element(side * b); });
      if (half > near) strip += Integrate(near, half, 3, [&](double b) { return element(side * b); });
    }
    return strip;
  });
}

double SyntheticLeaf::Perimeter(bool teeth) const {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (const int side : {-1, 1}) {
    Eigen::Vector3d last = Position(0, 0);
    for (int i = 0; i <= kSteps; ++i) {
      const double a = shape_.length * i / kSteps;
      const Eigen::Vector3d next = Position(a, side * HalfWidth(a, side, teeth));
      sum += (next - last).norm();
      last = next;
    }
  }
  return sum;
}

LeafMeasures SyntheticLeaf::Measure() const {
  LeafMeasures m;
  m.area = Area();
  m.length = (Position(shape_.length, 0) - Position(0, 0)).norm();
  m.perimeter = Perimeter(true);
  m.perimeter_smooth = Perimeter(false);
  constexpr int kSteps = 4000;
  Eigen::Vector3d last = Position(0, 0);
  for (int i = 1; i <= kSteps; ++i) {
    const double a = shape_.length * i / kSteps, half = HalfWidth(a, 1, false);
    const Eigen::Vector3d next = Position(a, 0);
    m.midrib_length += (next - last).norm();
    last = next;
    m.width = std::max(m.width, (Position(a, half) - Position(a, -half)).norm());
  }
  return m;
}

}  // namespace frond
