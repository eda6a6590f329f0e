// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_pairs.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <numeric>
#include <sstream>

#include "base/errors.h"

namespace frond {
namespace {

constexpr double kSameAngle = 1e-6;  // degrees

std::string Text(double degrees) {
  std::ostringstream text;
  text << std::setprecision(6) << degrees;
  return text.str();
}

std::string NameOf(std::size_t view, std::span<const double> degrees, std::span<const std::string> names) {
  const std::string angle = " (" + Text(degrees[view]) + " degrees)";
  return (view < names.size() && !names[view].empty() ? names[view] : "view " + std::to_string(view + 1)) +
         angle;
}

// Whether the camera of the disk at `first` stands to the left of that at `second`, as the camera sees it.
bool StandsLeft(const TurntableRig& rig, double first, double second) {
  constexpr double kRadians = std::numbers::pi / 180;
  const StereoPair pair = rig.Pair(first * kRadians, second * kRadians);
  return pair.right_from_left.inverse().translation().x() > 0;
}

// The views in the order of their angle, and the gap from each to the next in the turn.
struct Turn {
  std::vector<std::size_t> order;
  std::vector<double> angle;  // by place in the order
  std::vector<double> gap;    // to the next, by place in the order
};

Turn SortTurn(std::span<const double> degrees, std::span<const std::string> names) {
  Turn turn;
  turn.order.resize(degrees.size());
  std::iota(turn.order.begin(), turn.order.end(), std::size_t{0});
  std::stable_sort(turn.order.begin(), turn.order.end(), [&](std::size_t a, std::size_t b) {
    return NormalAngle(degrees[a]) < NormalAngle(degrees[b]);
  });
  for (const std::size_t view : turn.order) turn.angle.push_back(NormalAngle(degrees[view]));
  const std::size_t n = degrees.size();
  for (std::size_t k = 0; k < n; ++k) {
    turn.gap.push_back(k + 1 < n ? turn.angle[k + 1] - turn.angle[k] : turn.angle[0] + 360 - turn.angle[k]);
    if (turn.gap[k] > kSameAngle && turn.gap[k] < 360 - kSameAngle) continue;
    throw InputError(NameOf(turn.order[k], degrees, names) + " and " +
                     NameOf(turn.order[(k + 1) % n], degrees, names) +
                     " stand at the same angle; take one of them out of the list of views");
  }
  return turn;
}

// The place of the view `phi` further round than place k, nearest to that; n where there is none.
std::size_t PartnerOf(const Turn& turn, std::size_t k, double phi, double within) {
  const std::size_t n = turn.angle.size();
  std::size_t partner = n;
  double least = within, sum = 0;
  for (std::size_t step = 0; step + 1 < n; ++step) {
    sum += turn.gap[(k + step) % n];
    if (sum > phi + within) break;
    if (std::abs(sum - phi) <= least) {
      least = std::abs(sum - phi);
      partner = (k + step + 1) % n;
    }
  }
  return partner;
}

}  // namespace

double NormalAngle(double degrees) {
  const double angle = degrees - 360 * std::floor(degrees / 360);
  return angle < 360 ? angle : 0;
}

std::vector<ViewPair> FindViewPairs(std::span<const double> degrees, std::span<const std::string> names,
                                    const TurntableRig& rig, const ViewPairOptions& options) {
  const std::size_t n = degrees.size();
  if (n < 2) {
    throw InputError("a stereo pair takes two views of the object, " + std::to_string(n) +
                     " given; add views at small steps of the disk");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(degrees[i])) throw InputError(NameOf(i, degrees, names) + " has no angle");
  }
  const Turn turn = SortTurn(degrees, names);
  const double phi = options.phi.value_or(*std::min_element(turn.gap.begin(), turn.gap.end()));
  const double within = std::max(options.tolerance * phi, kSameAngle);

  std::vector<ViewPair> pairs;
  std::vector<std::uint8_t> paired(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t partner = PartnerOf(turn, k, phi, within);
    if (partner == n) continue;
    paired[k] = paired[partner] = 1;
    const bool left = StandsLeft(rig, turn.angle[k], turn.angle[partner]);
    pairs.push_back(left ? ViewPair{turn.order[k], turn.order[partner]}
                         : ViewPair{turn.order[partner], turn.order[k]});
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (paired[k]) continue;
    throw InputError(NameOf(turn.order[k], degrees, names) + " has no partner " + Text(phi) +
                     " degrees before or after it: a view is missing, or the pairs' angle differs");
  }
  std::stable_sort(pairs.begin(), pairs.end(), [&](const ViewPair& a, const ViewPair& b) {
    return NormalAngle(degrees[a.left]) < NormalAngle(degrees[b.left]);
  });
  return pairs;
}

}  // namespace frond
