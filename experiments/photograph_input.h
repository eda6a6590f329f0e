// SPDX-License-Identifier: BSD-3-Clause
// Photographs as a run's input: what the section `input` of a stereo pair's or a turntable's config names,
// and what is read of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "io/calibration_file.h"
#include "io/config_file.h"
#include "io/view_list.h"
#include "models/raster.h"
#include "models/tessellation.h"
#include "problems/turntable/turntable_view.h"

namespace frond {

// What the config names, before anything is read. Empty: not named.
struct PhotographSource {
  std::filesystem::path left, right;            // of a stereo pair
  std::filesystem::path left_mask, right_mask;  // likewise
  std::filesystem::path boards;                 // list of pairs of board views
  std::filesystem::path views;                  // of a turntable: list of views
  std::filesystem::path board;                  // of a turntable: list of board views
  std::vector<std::filesystem::path> calibration;
  std::filesystem::path truth;      // of a stereo pair a disparity image, of a turntable points or a mesh
  std::optional<std::string> unit;  // as the config has it

  bool none() const { return left.empty() && boards.empty() && views.empty() && board.empty(); }
};

// The keys of `input` that name photographs.
std::vector<OptionSpec> StereoInputSpecs();
std::vector<OptionSpec> TurntableInputSpecs();

// Throw ConfigError where what is needed is missing or too much is named.
PhotographSource ReadStereoSource(const ConfigFile& config);
PhotographSource ReadTurntableSource(const ConfigFile& config);
void AddPhotographs(const PhotographSource& source, ResolvedConfig* resolved);

// A stereo pair as read. Without `left` only boards are there.
struct StereoInput {
  std::string unit = "mm";
  std::array<std::string, 2> names;  // the images' files, left and right
  Image left, right;
  ColourImage left_colour;
  Mask left_mask, right_mask;  // or empty
  std::optional<ImagePairList> boards;
  std::optional<StereoPairCalibration> calibration;
  Image truth;  // levels as the file has them, or empty
};

// A turn as read. Without views only the board is there.
struct TurntableInput {
  std::string unit = "mm";
  std::vector<TurntableView> views;  // in the list's order
  std::optional<ViewList> board;
  std::optional<TurntableCalibration> calibration;
  std::optional<CameraCalibration> camera;  // without its axis, which the board is to tell
  std::vector<Eigen::Vector3d> truth;       // points in the disk's frame, or empty
  std::optional<SurfaceMesh> truth_mesh;    // whose vertices they are, if it has faces
};

// Read all images that are named (those of boards as they are needed). The unit is the calibration's or,
// where that tells none, the config's. Throw InputError.
StereoInput LoadStereo(const PhotographSource& source);
TurntableInput LoadTurntable(const PhotographSource& source);

// One digest of all files that the source names, lists' images too: of their own digests in order.
std::string PhotographDigest(const PhotographSource& source);

}  // namespace frond
