// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/convergence_bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/comparison/quantile.h"

namespace frond {
namespace {

constexpr int kPlaces = 64;
constexpr double kLeastPlace = 1e-6;  // seconds below a microsecond are no time
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> Places(std::span<const JobResult* const> runs, double (*axis)(const TracePoint&)) {
  double first = kInfinity, last = 0;
  for (const JobResult* run : runs) {
    if (run->report.trace.empty()) continue;
    first = std::min(first, axis(run->report.trace.front()));
    last = std::max(last, axis(run->report.trace.back()));
  }
  if (!std::isfinite(first)) return {};
  first = std::max(first, kLeastPlace);
  last = std::max(last, first);
  std::vector<double> places;
  for (int k = 0; k < kPlaces; ++k) {
    const double place = first * std::pow(last / first, static_cast<double>(k) / (kPlaces - 1));
    if (places.empty() || place > places.back()) places.push_back(place);
  }
  places.back() = last;
  return places;
}

}  // namespace

ProblemSummary::Band ConvergenceBand(std::span<const JobResult* const> runs,
                                     double (*axis)(const TracePoint&)) {
  ProblemSummary::Band band;
  std::vector<std::size_t> next(runs.size(), 0);
  std::vector<double> best;
  for (const JobResult* run : runs)
    best.push_back(std::isfinite(run->start_objective) ? run->start_objective : kInfinity);
  for (const double place : Places(runs, axis)) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const std::vector<TracePoint>& trace = runs[r]->report.trace;
      for (; next[r] < trace.size() && axis(trace[next[r]]) <= place; ++next[r]) {
        best[r] = std::fmin(best[r], trace[next[r]].best_objective);
      }
    }
    const Quartiles quartiles = SampleQuartiles(best);
    for (auto [curve, value] :
         {std::pair{&band.lower, quartiles.lower}, std::pair{&band.median, quartiles.median},
          std::pair{&band.upper, quartiles.upper}}) {
      curve->x.push_back(place);
      curve->y.push_back(value);
    }
  }
  return band;
}

}  // namespace frond
