// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turntable_renderer.h"

#include <utility>

#include "problems/turntable/turntable_light.h"

namespace frond {

SyntheticView RenderView(const TurntableScene& scene, const Sensor& sensor, const Exposure& exposure,
                         double angle, Random& random, int threads) {
  const PinholeCamera& camera = scene.rig.camera;
  const TurntableLight light(scene, angle, true, sensor.colour);
  const auto seen = [&](double u, double v) { return light.Seen(u, v); };
  Light film(camera.width, camera.height, light.Room());
  const PixelBox box = light.PearBox();
  Collect(box, {}, sensor.supersampling, threads, seen, &film);
  Collect(light.DiskBox(), box, sensor.supersampling, threads, seen, &film);

  SyntheticView view{.angle = angle, .mask = Mask(camera.width, camera.height, 0)};
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) view.mask(x, y) = light.SeesPear(x, y) ? 1 : 0;
  }
  Photograph photograph = Develop(std::move(film), sensor, exposure, random);
  view.image = std::move(photograph.image);
  view.colour = std::move(photograph.colour);
  return view;
}

}  // namespace frond
