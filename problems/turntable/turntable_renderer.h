// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/random.h"
#include "models/raster.h"
#include "models/turntable_rig.h"
#include "problems/turntable/board.h"
#include "problems/turntable/solid_texture.h"
#include "problems/turntable/synthetic_pear.h"

namespace frond {

// Light and surface. Grey levels 0 … 255 before exposure.
struct Lighting {
  // To the lamp, in the camera's frame: it stands in the laboratory while the object turns.
  Eigen::Vector3d lamp{-0.5, -0.6, -0.62};
  double ambient = 0.3;   // share of the light that comes from everywhere
  double diffuse = 0.7;   // Lambert's share from the lamp
  double specular = 0.1;  // Phong's share, white
  double shininess = 30;
};

struct Sensor {
  int supersampling = 3;  // rays per pixel and direction
  double blur = 0.6;      // standard deviation of the lens's blur, pixels
  double noise = 1.5;     // standard deviation, grey levels; after exposure
  bool colour = false;
};

struct Exposure {
  double gain = 1, offset = 0;  // grey level = gain · light + offset, then noise, then rounding to 8 bits
};

// One photograph.
struct SyntheticView {
  double angle = 0;    // of the disk, radians
  Image image;         // whole grey levels 0 … 255; of a colour view its luminance
  ColourImage colour;  // of a colour view
  Mask mask;           // 1 where the pixel's centre sees the object
};

// A pear on a turning disk before a camera. Lengths in mm.
struct TurntableScene {
  TurntableRig rig;
  SyntheticPear pear{PearShape()};
  Eigen::Vector3d pear_origin{0, 0, 0};  // of the pear's frame (its foot) in the disk's
  double disk_radius = 80;               // its top is at the height of pear_origin
  SolidTexture speckle{1, 1};            // in the pear's frame
  double contrast = 0.3;                 // standard deviation of the albedo over its mean
  double albedo = 0.6;                   // mean, of the pear
  Lighting lighting;
  Sensor sensor;
};

// The photograph with the disk at `angle` (radians). `random` draws the noise.
SyntheticView RenderView(const TurntableScene& scene, double angle, const Exposure& exposure, Random& random,
                         int threads = 1);

// A photograph of the board (chessboards only), with its pose in the camera's frame (board points: x along
// its columns, y along its rows, z = 0, the origin at the first inner corner); the disk beneath it is
// visible where `angle` says how it stands.
struct SyntheticBoardView {
  std::optional<double> angle;  // of the disk, radians; none for a free view
  Image image;
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector2d> corners;  // true pixels of the inner corners, row by row
};
SyntheticBoardView RenderBoard(const TurntableScene& scene, const Board& board,
                               const Eigen::Isometry3d& camera_from_board, std::optional<double> angle,
                               Random& random, int threads = 1);

// --- the truth ---

// Where a ray of the disk's frame (at 0 degrees, turning with the disk) first meets the pear.
std::optional<Eigen::Vector3d> CastRay(const TurntableScene& scene, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction);
// Signed distance of a point of the disk's frame to the pear.
double DistanceToPear(const TurntableScene& scene, const Eigen::Vector3d& point);

struct TrueMatch {
  Eigen::Vector3d point, normal;             // disk's frame
  double disparity = 0;                      // exact
  bool seen = false;                         // by the right camera too, and inside its image
  double left_cosine = 0, right_cosine = 0;  // of the angle between normal and the direction to each camera
};
// What pixel (x, y) of the left normal image of the pair (left_angle, right_angle) sees; none where it is not
// the pear.
std::optional<TrueMatch> FindTrueMatch(const TurntableScene& scene, const Rectification& normal,
                                       double left_angle, double right_angle, double x, double y);

}  // namespace frond
