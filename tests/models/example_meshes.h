// SPDX-License-Identifier: BSD-3-Clause
// Meshes with known topology: grids of around × along cells that are glued at their ends.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <numbers>

#include "models/tessellation.h"

namespace frond {

// Vertices place(i, j) for i < columns, j < rows, vertex i + j · columns; cells from each to the next, the
// last to the first where that direction is closed. Faces run counter-clockwise in (i, j).
inline SurfaceMesh GridMesh(int columns, int rows, bool closed_i, bool closed_j,
                            const std::function<Eigen::Vector3d(int, int)>& place) {
  SurfaceMesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) mesh.vertices.push_back(place(i, j));
  }
  const auto at = [&](int i, int j) { return i % columns + (j % rows) * columns; };
  for (int j = 0; j < rows - (closed_j ? 0 : 1); ++j) {
    for (int i = 0; i < columns - (closed_i ? 0 : 1); ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

inline SurfaceMesh SheetMesh(int columns, int rows) {
  return GridMesh(columns, rows, false, false, [](int i, int j) { return Eigen::Vector3d(i, j, 0); });
}

// About z, from 0 to height; faces look outwards.
inline SurfaceMesh TubeMesh(int around, int along, double radius, double height) {
  return GridMesh(around, along, true, false, [=](int i, int j) {
    const double angle = 2 * std::numbers::pi * i / around;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height * j / (along - 1));
  });
}

inline SurfaceMesh TorusMesh(int around, int along, double major, double minor) {
  return GridMesh(around, along, true, true, [=](int i, int j) {
    const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
    const double r = major + minor * std::cos(v);
    return Eigen::Vector3d(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
  });
}

// The part of the sphere about the origin below the polar angle `open` (π: all of it), from the south pole.
inline SurfaceMesh SphereMesh(int around, int along, double radius, double open = std::numbers::pi) {
  const bool whole = open >= std::numbers::pi;
  const int rows = whole ? along - 2 : along - 1;  // without the poles
  SurfaceMesh mesh = GridMesh(around, rows, true, false, [=](int i, int j) {
    const double u = 2 * std::numbers::pi * i / around, v = open * (j + 1) / (along - 1);
    return Eigen::Vector3d(radius * std::sin(v) * std::cos(u), radius * std::sin(v) * std::sin(u),
                           -radius * std::cos(v));
  });
  const int south = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, -radius);
  for (int i = 0; i < around; ++i) mesh.triangles.push_back({south, (i + 1) % around, i});
  if (whole) {
    mesh.vertices.emplace_back(0, 0, radius);
    const int row = (rows - 1) * around;
    for (int i = 0; i < around; ++i) mesh.triangles.push_back({row + i, row + (i + 1) % around, south + 1});
  }
  return mesh;
}

// Both meshes side by side.
inline SurfaceMesh Together(SurfaceMesh first, const SurfaceMesh& second) {
  const int shift = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles) first.triangles.push_back({a + shift, b + shift, c + shift});
  return first;
}

}  // namespace frond
