// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/option_specs.h"
#include "problems/turntable/synthetic_turntable.h"

namespace frond {

std::vector<OptionSpec> SyntheticTurntableSpecs() {
  const SyntheticTurntableOptions d;
  const OptionSpec distortion = {
      .name = "camera.distortion",
      .type = OptionType::kNumbers,
      .default_value = std::vector<double>(d.distortion.begin(), d.distortion.end()),
      .help = "k1, k2, p1, p2, k3 of Brown's model, as OpenCV has it",
      .minimum = -2,
      .maximum = 2,
      .min_size = 5,
      .max_size = 5};
  return {
      NumberSpec("pear.height", d.pear.height, 1, 1000, "Of the pear, mm"),
      NumberSpec("pear.bend", d.pear.bend, -0.3, 0.3, "Sideways shift of the stalk end over the height"),
      NumberSpec("pear.flattening", d.pear.flattening, -0.3, 0.3, "Of its sections from round"),
      NumberSpec("pear.lobes", d.pear.lobes, 0, 0.1, "Relative height of three lobes round the belly"),
      NumberSpec("pear.offset", d.offset, -50, 50, "Of its foot from the axis of turning, mm"),
      NumberSpec("texture.grain", d.grain, 0.05, 50, "Lattice step of the speckle, mm"),
      NumberSpec("texture.contrast", d.contrast, 0, 1, "Standard deviation of the albedo over its mean"),
      NumberSpec("texture.albedo", d.albedo, 0.01, 1, "Mean of the pear's albedo"),
      NumberSpec("light.lamp_left", d.lighting.lamp_left, -180, 180,
                 "Direction to the lamp from the camera's, seen from the object, degrees to the left"),
      NumberSpec("light.lamp_up", d.lighting.lamp_up, -90, 90, "The same upwards"),
      NumberSpec("light.ambient", d.lighting.ambient, 0, 2, "Light from everywhere"),
      NumberSpec("light.diffuse", d.lighting.diffuse, 0, 2, "The lamp's light, by Lambert's law"),
      NumberSpec("light.specular", d.lighting.specular, 0, 2, "Brightness of the highlight (Phong)"),
      NumberSpec("light.shininess", d.lighting.shininess, 1, 1000, "Exponent of the highlight"),
      NumberSpec("disk_radius", d.disk_radius, 1, 1e4, "Of the turning disk, mm"),
      NumberSpec("camera.distance", d.distance, 1, 1e5, "Of the camera's centre from the axis, mm"),
      NumberSpec("camera.focal", d.focal, 1, 1e6, "Focal length, pixels"),
      IntegerSpec("camera.width", d.width, 16, 20000, "Of the images, pixels"),
      IntegerSpec("camera.height", d.height, 16, 20000, "Of the images, pixels"),
      NumberSpec("camera.tilt", d.tilt, -60, 60, "By which the camera looks down at the disk, degrees"),
      NumberSpec("camera.roll", d.roll, -45, 45, "Of the camera about its viewing direction, degrees"),
      distortion,
      IntegerSpec("sensor.supersampling", d.sensor.supersampling, 1, 16, "Rays a pixel and direction"),
      NumberSpec("sensor.blur", d.sensor.blur, 0, 20, "Standard deviation of the lens's blur, pixels"),
      NumberSpec("sensor.noise", d.sensor.noise, 0, 100, "Standard deviation of a grey level"),
      FlagSpec("sensor.colour", d.sensor.colour, "Colour photographs"),
      IntegerSpec("pairs", d.pairs, 1, 3600, "Pairs of views round a full turn"),
      NumberSpec("phi", d.phi, 0.01, 45, "Angle of the disk between the views of a pair, degrees"),
      NumberSpec("angle_error", d.angle_error, 0, 10,
                 "Standard deviation of the disk's angles about those written down, degrees"),
      NumberSpec("exposure.gain", d.second_exposure.gain, 0, 10, "Of the right view of each pair"),
      NumberSpec("exposure.offset", d.second_exposure.offset, -255, 255, "The same, grey levels"),
      IntegerSpec("board.columns", d.board.columns, 2, 100, "Inner corners of the chessboard in a row"),
      IntegerSpec("board.rows", d.board.rows, 2, 100, "Rows of inner corners"),
      NumberSpec("board.square", d.board.square, 0.1, 1000, "Side of a square, mm"),
      NumberSpec("board.lean", d.board_lean, -60, 60, "Of the board on the disk, back from upright, degrees"),
      NumberSpec("board.first", d.board_first, -180, 180, "First angle of the disk with the board, degrees"),
      NumberSpec("board.last", d.board_last, -180, 180, "Last one"),
      NumberSpec("board.step", d.board_step, 0.1, 180, "From one to the next"),
      IntegerSpec("board.free", d.free_boards, 0, 1000,
                  "Views of the board held before the camera, for the intrinsics"),
  };
}

SyntheticTurntableOptions SyntheticTurntableOptionsFrom(const Options& options, std::uint64_t seed) {
  SyntheticTurntableOptions o;
  o.seed = seed;
  o.pear = {.height = options.Number("pear.height"),
            .bend = options.Number("pear.bend"),
            .flattening = options.Number("pear.flattening"),
            .lobes = options.Number("pear.lobes")};
  o.offset = options.Number("pear.offset");
  o.grain = options.Number("texture.grain");
  o.contrast = options.Number("texture.contrast");
  o.albedo = options.Number("texture.albedo");
  o.disk_radius = options.Number("disk_radius");
  o.lighting = {.lamp_left = options.Number("light.lamp_left"),
                .lamp_up = options.Number("light.lamp_up"),
                .ambient = options.Number("light.ambient"),
                .diffuse = options.Number("light.diffuse"),
                .specular = options.Number("light.specular"),
                .shininess = options.Number("light.shininess")};
  o.distance = options.Number("camera.distance");
  o.focal = options.Number("camera.focal");
  o.width = options.Integer("camera.width");
  o.height = options.Integer("camera.height");
  o.tilt = options.Number("camera.tilt");
  o.roll = options.Number("camera.roll");
  std::copy_n(options.Numbers("camera.distortion").begin(), o.distortion.size(), o.distortion.begin());
  o.sensor = {.supersampling = options.Integer("sensor.supersampling"),
              .blur = options.Number("sensor.blur"),
              .noise = options.Number("sensor.noise"),
              .colour = options.Flag("sensor.colour")};
  o.pairs = options.Integer("pairs");
  o.phi = options.Number("phi");
  o.angle_error = options.Number("angle_error");
  o.second_exposure = {.gain = options.Number("exposure.gain"), .offset = options.Number("exposure.offset")};
  o.board.columns = options.Integer("board.columns");
  o.board.rows = options.Integer("board.rows");
  o.board.square = options.Number("board.square");
  o.board_lean = options.Number("board.lean");
  o.board_first = options.Number("board.first");
  o.board_last = options.Number("board.last");
  o.board_step = options.Number("board.step");
  o.free_boards = options.Integer("board.free");
  return o;
}

}  // namespace frond
