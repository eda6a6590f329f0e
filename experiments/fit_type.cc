// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/fit_type.h"

#include "base/errors.h"
#include "experiments/curve_experiment.h"
#include "experiments/leaf_experiment.h"
#include "experiments/skin_experiment.h"
#include "experiments/standard_experiment.h"
#include "experiments/stereo_experiment.h"
#include "experiments/surface_experiment.h"
#include "experiments/turntable_experiment.h"

namespace frond {

const std::vector<FitType>& FitTypes() {
  static const std::vector<FitType> types = {
      CurveFitType(),  LeafFitType(),    SkinFitType(),      StandardFitType(),
      StereoFitType(), SurfaceFitType(), TurntableFitType(),
  };
  return types;
}

const std::vector<std::string>& SurfaceFormats() {
  static const std::vector<std::string> formats = {"json", "step", "iges", "ply", "obj", "stl", "glb"};
  return formats;
}

const std::vector<std::string>& CurveFormats() {
  static const std::vector<std::string> formats = {"json", "step", "iges", "ply", "obj"};
  return formats;
}

const FitType& FindFitType(const std::string& name) {
  std::vector<std::string> names;
  for (const FitType& type : FitTypes()) {
    if (type.name == name) return type;
    names.push_back(type.name);
  }
  const std::string nearest = NearestWord(name, names);
  throw ConfigError("unknown problem type '" + name + "'" +
                    (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") +
                    "; `frond list fits` names them all");
}

}  // namespace frond
