// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/robust_loss.h"

#include "base/errors.h"
#include "base/options.h"

namespace frond {

const std::vector<std::string>& RobustLossNames() {
  static const std::vector<std::string> names = {"none", "huber", "cauchy", "tukey"};
  return names;
}

RobustLoss MakeRobustLoss(const std::string& name, double scale) {
  const std::vector<std::string>& names = RobustLossNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    const std::string nearest = NearestWord(name, names);
    throw ConfigError(
        "unknown robust loss '" + name + "'" +
        (nearest.empty() ? ", expected none, huber, cauchy or tukey" : " (did you mean '" + nearest + "'?)"));
  }
  if (!(scale > 0) || !std::isfinite(scale)) {
    throw ConfigError("the scale of robust loss '" + name + "' is " + FormatValue(scale) +
                      ", expected a number > 0");
  }
  return {static_cast<RobustLossType>(found - names.begin()), scale};
}

std::unique_ptr<ceres::LossFunction> MakeCeresLoss(const RobustLoss& loss) {
  switch (loss.type) {
    case RobustLossType::kNone:
      break;
    case RobustLossType::kHuber:
      return std::make_unique<ceres::HuberLoss>(loss.scale);
    case RobustLossType::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(loss.scale);
    case RobustLossType::kTukey:
      return std::make_unique<ceres::TukeyLoss>(loss.scale);
  }
  return nullptr;
}

}  // namespace frond
