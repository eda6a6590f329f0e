// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/fit_type.h"

#include "base/errors.h"
#include "experiments/leaf_experiment.h"
#include "experiments/standard_experiment.h"
#include "experiments/surface_experiment.h"

namespace frond {

const std::vector<FitType>& FitTypes() {
  static const std::vector<FitType> types = {
      LeafFitType(),
      StandardFitType(),
      SurfaceFitType(),
  };
  return types;
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
