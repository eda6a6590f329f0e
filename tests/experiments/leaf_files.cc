// SPDX-License-Identifier: BSD-3-Clause
#include "tests/experiments/leaf_files.h"

#include "io/point_cloud_file.h"
#include "problems/leaf/synthetic_leaf_scan.h"

namespace frond {

void WriteLeafFiles(const TempFolder& folder, int points, int truth_points) {
  LeafScanOptions options;
  options.seed = 1;
  options.points = points;
  options.dense_points = truth_points;
  options.random_pose = true;
  options.pose_seed = 1;
  const LeafScan scan = ScanLeaf(RandomLeaf(1), options);
  WritePointCloud(folder / "scan.ply", {scan.points});
  WritePointCloud(folder / "truth.ply", {scan.dense_clean});
}

std::filesystem::path Fit(const TempFolder& folder, const std::string& yaml, const std::string& name,
                          const RunFlags& flags) {
  return FitConfig(folder.Write("fit.yaml", yaml), flags, folder / name, false, false);
}

Experiment ReadText(const std::string& yaml, const RunFlags& flags) {
  return ReadExperiment(ConfigFile::Parse(yaml, "fit.yaml"), flags);
}

}  // namespace frond
