#include "problems/stereo/dense_disparity.h"
#include <limits>
namespace frond {
void FillDisparities(const WindowGrid&, const Image& left, const Mask&, const Mask&, const StartMap&, const StereoMatchOptions&, int, StereoMatches& m) {
  m.disparity = Image(left.width, left.height, std::numeric_limits<float>::quiet_NaN()); m.sigma = m.disparity;
  for (auto& w : m.windows) if (w.status == WindowStatus::kAccepted) { m.disparity(w.x, w.y) = static_cast<float>(w.match.warp[0]); m.sigma(w.x, w.y) = static_cast<float>(w.match.sigma); }
}
}
