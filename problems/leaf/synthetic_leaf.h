// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace frond {

// The looks of tea leaves from below (Wu et al. 2021, section 3): a distinct midrib ridge; a smooth convex
// sheet; a wrinkled one; a flat one. In the last three the midrib hardly stands out.
enum class LeafCharacter { kHill, kSmooth, kWrinkled, kFlat };
const char* LeafCharacterName(LeafCharacter character);  // "hill", "smooth", …
LeafCharacter FindLeafCharacter(std::string_view name);  // throws ConfigError, naming the known ones

// All that fixes a synthetic leaf. Lengths in mm, angles in degrees. In its own coordinates the leaf's base
// is at the origin, the midrib runs to +x, the underside (the hill's ridge) looks to +z.
struct LeafShape {
  LeafCharacter character = LeafCharacter::kSmooth;
  double length = 65;          // base to tip along x; 45 … 85
  double width = 28;           // of the outline without teeth, measured on the flattened blade
  double widest_at = 0.45;     // share of the length from the base where it is widest; 0.35 … 0.55
  double tip_sharpness = 1.2;  // half-width ~ (distance to the tip)^this; 1 a wedge, above 1 drawn out
  double petiole_width = 2;    // width of the base edge
  double tooth_depth = 0.45;   // valley to peak; 0 … 0.6
  double tooth_spacing = 2.4;
  double fold_slope = 0.3;  // of the blade's two halves away from the midrib (tangent)
  double crease_width = 1;  // over which the fold is rounded
  double rib_height = 0.1;  // of the midrib above the blade near the base, tapering to nothing at the tip
  double rib_width = 1.2;
  double sag = 0.08;           // bend along the length: depth of the midrib's bow over its length
  double tip_droop = 0.03;     // extra fall of the tip over the length (cubic)
  double sideways = 0.01;      // sideways bow of the midrib over its length
  double curl_angle = 20;      // angle between the middle's and the margin's tangent plane, across
  double curl_change = 0;      // relative change of the curl from base to tip; −1 … 1
  double twist = 0;            // of the tip's cross-section against the base's
  double wrinkle_height = 0;   // amplitude of each of three waves over the blade
  double wrinkle_length = 15;  // their mean wave length
  double ruffle_height = 0;    // amplitude of the margin's waves (they die out towards the midrib)
  double ruffle_length = 22;
  double vein_depth = 0;  // of the secondary veins, as grooves from the midrib to the margin
  double vein_spacing = 7;
  std::uint64_t seed = 0;  // of phases and directions of wrinkles, ruffles, teeth and veins
};

// A realistic leaf; the character goes round with the seed (1 hill, 2 smooth, 3 wrinkled, 4 flat, 5 hill, …).
LeafShape RandomLeaf(std::uint64_t seed);
LeafShape RandomLeaf(std::uint64_t seed, LeafCharacter character);

// The shape's numbers by name, for a truth file; and setting one of them (throws ConfigError on other names).
std::map<std::string, double> ShapeValues(const LeafShape& shape);
void SetShapeValue(LeafShape* shape, std::string_view name, double value);

// Exact measures of the clean leaf, by numerical integration (relative error of the area < 1e-5). mm, mm².
struct LeafMeasures {
  double area = 0;
  double length = 0;            // straight, base edge's middle to tip
  double midrib_length = 0;     // along the midrib
  double width = 0;             // largest straight distance of opposite margin points, without teeth
  double perimeter = 0;         // base edge and toothed margin
  double perimeter_smooth = 0;  // the same without teeth
};

// The leaf as a smooth surface over blade coordinates: a in [0, length] along the midrib, b across in mm on
// the flattened blade, −HalfWidth(a, −1) ≤ b ≤ HalfWidth(a, +1).
class SyntheticLeaf {
 public:
  explicit SyntheticLeaf(const LeafShape& shape);  // throws ConfigError on a value out of its range

  const LeafShape& shape() const { return shape_; }
  // Distance on the blade from the midrib to the margin of one side (+1 left, b > 0; −1 right).
  double HalfWidth(double a, int side, bool teeth = true) const;
  Eigen::Vector3d Position(double a, double b) const;

  struct Sample {
    Eigen::Vector3d position, normal;  // unit normal, upwards (+z for a flat leaf)
    double area_element;               // mm² of surface per mm² of flattened blade
  };
  Sample Evaluate(double a, double b) const;

  LeafMeasures Measure() const;

 private:
  struct Wave {
    double a, b, phase;  // wave numbers in rad/mm
  };
  template <typename T>
  Eigen::Matrix<T, 3, 1> PositionOf(const T& a, const T& b) const;
  template <typename T>
  T Relief(const T& a, const T& b) const;
  double Perimeter(bool teeth) const;
  double Area() const;

  LeafShape shape_;
  std::vector<Wave> wrinkles_;
  double outline_base_exponent_ = 1, outline_scale_ = 1, ruffle_phase_[2] = {0, 0}, tooth_phase_[2] = {0, 0};
};

}  // namespace frond
