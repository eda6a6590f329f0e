// SPDX-License-Identifier: BSD-3-Clause
// The lists of photographs that a turntable's and a stereo pair's configs name: CSV files with a header line,
// commas between, # before a comment. Paths of images are relative to the list's folder. Complaints are
// InputErrors that start with the list's file and line, "views.csv:7: ".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frond {

// One photograph of the turntable.
struct View {
  std::filesystem::path image;
  std::optional<double>
      angle;  // of the disk, radians; counter-clockwise seen from above (degrees in the file)
  std::filesystem::path mask;  // or empty
  std::size_t line = 0;        // in the list
};

struct ViewList {
  std::filesystem::path file;
  std::vector<View> views;  // in the list's order

  // "views.csv:7", the place of a view.
  std::string Place(std::size_t view) const;
};

// Views of the object, "image,angle" or "image,angle,mask". Every view has an angle, no angle comes twice
// (modulo a full turn) and every file is there. Throws InputError.
ViewList ReadViewList(const std::filesystem::path& path);

// Views of the calibration board, "image,angle". The angle may be empty: a view with the board held anywhere,
// for the camera's intrinsics alone. Throws InputError.
ViewList ReadBoardViews(const std::filesystem::path& path);

// Two photographs of the board by the cameras of a stereo pair, at once.
struct ImagePair {
  std::filesystem::path left;
  std::filesystem::path right;
  std::size_t line = 0;
};

struct ImagePairList {
  std::filesystem::path file;
  std::vector<ImagePair> pairs;

  std::string Place(std::size_t pair) const;
};

// "left,right". Throws InputError.
ImagePairList ReadImagePairs(const std::filesystem::path& path);

}  // namespace frond
