// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/nist_data.h"

#include <cmath>

namespace frond {

const std::vector<NistDataset>& NistDatasets() {
  static const std::vector<NistDataset> datasets = [] {
    std::vector<NistDataset> list = NistDatasetsAToG();
    for (NistDataset& dataset : NistDatasetsHToT()) list.push_back(std::move(dataset));
    return list;
  }();
  return datasets;
}

std::vector<double> NistResponses(const NistDataset& dataset) {
  std::vector<double> responses(dataset.y.begin(), dataset.y.end());
  if (dataset.log_response) {
    for (double& response : responses) response = std::log(response);
  }
  return responses;
}

}  // namespace frond
