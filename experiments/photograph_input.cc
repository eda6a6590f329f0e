// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/photograph_input.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <variant>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/image_file.h"
#include "io/length_unit.h"
#include "io/mesh_file.h"
#include "io/ply_header.h"
#include "io/point_cloud_file.h"
#include "io/sha256.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

OptionSpec FileSpec(const std::string& name, const std::string& help) {
  return {.name = name, .type = OptionType::kText, .default_value = std::string(), .help = help};
}

OptionSpec UnitSpec() {
  return {.name = "unit",
          .type = OptionType::kChoice,
          .default_value = std::string("mm"),
          .help = "Unit of the board's squares and of calibrations that tell none",
          .words = LengthUnitNames()};
}

std::filesystem::path PathOrNone(const ConfigFile& config, const std::string& key) {
  return config.Has(key) ? config.ResolvePath(key) : std::filesystem::path();
}

// What both kinds have. `calibration` may be a list, which no option is.
PhotographSource ReadCommon(const ConfigFile& config, std::vector<OptionSpec> specs) {
  Options options(std::move(specs));
  config.ReadSection("input", &options, {"calibration"});
  PhotographSource source;
  if (config.Has("input.calibration")) source.calibration = config.ResolvePaths("input.calibration");
  source.truth = PathOrNone(config, "input.truth");
  if (config.Has("input.unit")) source.unit = options.Text("unit");
  return source;
}

// A unit that is asked for and another one in the file.
std::string UnitOf(const CalibrationRecord& record, const PhotographSource& source) {
  if (source.unit && *source.unit != record.unit) {
    throw InputError(source.calibration.front().string() + ": its unit is " + record.unit +
                     ", that of the input " + *source.unit + ": leave input.unit out");
  }
  return record.unit;
}

const char* KindOf(const Calibration& calibration) {
  constexpr const char* kKinds[] = {"a turntable", "a stereo pair", "one camera"};
  return kKinds[calibration.index()];
}

// Colour, and grey of it.
void ReadPhotograph(const std::filesystem::path& path, ColourImage* colour, Image* grey) {
  *grey = ReadImage(path);
  if (colour != nullptr) *colour = ReadColourImage(path);
}

template <typename First, typename Second>
void CheckSameSize(const First& first, const std::string& first_name, const Second& second,
                   const std::string& second_name, const std::string& way_out) {
  if (first.width == second.width && first.height == second.height) return;
  const auto size = [](const auto& raster) {
    return std::to_string(raster.width) + " x " + std::to_string(raster.height);
  };
  throw InputError(second_name + ": is " + size(second) + " pixels, but " + first_name + " is " +
                   size(first) + "; " + way_out);
}

Mask ReadMaskOf(const std::filesystem::path& path, const Image& image, const std::string& image_name) {
  if (path.empty()) return {};
  Mask mask = ReadMask(path);
  CheckSameSize(image, image_name, mask, path.string(), "a mask has its photograph's size");
  return mask;
}

bool HasFaces(const std::filesystem::path& path) {
  if (Extension(path) != "ply") return Extension(path) == "off" || Extension(path) == "stl";
  const PlyHeader header = ParsePlyHeader(path, ReadFileBytes(path));
  return std::any_of(header.elements.begin(), header.elements.end(),
                     [](const PlyElement& element) { return element.name == "face" && element.count > 0; });
}

// The rig, or a camera for it.
void ReadTurntableCalibration(const PhotographSource& source, TurntableInput* input) {
  ForeignCalibration foreign{.unit = input->unit};
  if (!input->views.empty()) foreign.width = input->views[0].image.width;
  if (!input->views.empty()) foreign.height = input->views[0].image.height;
  const Calibration calibration = ReadCalibration(source.calibration, foreign);
  if (const auto* const rig = std::get_if<TurntableCalibration>(&calibration); rig != nullptr) {
    if (input->board) {
      throw InputError(source.calibration.front().string() +
                       ": is a whole calibration: leave input.board out, or input.calibration");
    }
    input->unit = UnitOf(rig->record, source);
    input->calibration = *rig;
  } else if (const auto* const camera = std::get_if<CameraCalibration>(&calibration); camera != nullptr) {
    if (!input->board) {
      throw InputError(source.calibration.front().string() +
                       ": calibrates one camera, but not the axis; name views of a board too (input.board)");
    }
    input->camera = *camera;
  } else {
    throw InputError(source.calibration.front().string() + ": calibrates " + KindOf(calibration) +
                     ", not a turntable; calibrate it from views of a board (input.board)");
  }
}

}  // namespace

std::vector<OptionSpec> StereoInputSpecs() {
  return {FileSpec("left", "The left image: png, jpg, bmp, tiff, ..."),
          FileSpec("right", "The right one"),
          FileSpec("left_mask", "Image that is white where the left one shows the object"),
          FileSpec("right_mask", "The same of the right one"),
          FileSpec("calibration", "calibration.json, or OpenCV's YAML or XML; or a list of such files"),
          FileSpec("boards", "List of board views, CSV 'left,right': the pair is calibrated from them"),
          FileSpec("truth", "True disparities of the left image (see problem.truth_scale); 0: unknown"),
          UnitSpec()};
}

std::vector<OptionSpec> TurntableInputSpecs() {
  return {
      FileSpec("views", "List of views of the object, CSV 'image,angle[,mask]'"),
      FileSpec("board", "List of views of the board, CSV 'image,angle': the camera is calibrated from them"),
      FileSpec("calibration",
               "Instead, the calibration.json of an earlier run; or a camera alone, beside "
               "a board for the axis"),
      FileSpec("truth", "Clean points or a mesh of the object in the disk's frame: adds truth_rmse, ..."),
      UnitSpec()};
}

PhotographSource ReadStereoSource(const ConfigFile& config) {
  PhotographSource source = ReadCommon(config, StereoInputSpecs());
  source.left = PathOrNone(config, "input.left");
  source.right = PathOrNone(config, "input.right");
  source.left_mask = PathOrNone(config, "input.left_mask");
  source.right_mask = PathOrNone(config, "input.right_mask");
  source.boards = PathOrNone(config, "input.boards");
  if (source.left.empty() != source.right.empty()) {
    config.Fail("input", source.left.empty() ? "'right' is named without 'left': a pair has both"
                                             : "'left' is named without 'right': a pair has both");
  }
  if (source.none()) {
    config.Fail("input",
                "no input: name two images, --set=\"input.left=left.png; input.right=right.png\", "
                "or board views to calibrate from, input.boards");
  }
  if (source.left.empty()) {
    for (const char* key : {"left_mask", "right_mask", "truth"}) {
      if (config.Has(std::string("input.") + key)) {
        config.Fail(std::string("input.") + key,
                    std::string("there is no 'left' that '") + key + "' belongs to");
      }
    }
  }
  if (!source.boards.empty() && !source.calibration.empty()) {
    config.Fail("input.calibration", "name one of 'calibration' and 'boards', not both");
  }
  return source;
}

PhotographSource ReadTurntableSource(const ConfigFile& config) {
  PhotographSource source = ReadCommon(config, TurntableInputSpecs());
  source.views = PathOrNone(config, "input.views");
  source.board = PathOrNone(config, "input.board");
  if (source.none()) {
    config.Fail("input",
                "no input: name lists of photographs, --set=\"input.views=views.csv; "
                "input.board=board.csv\"");
  }
  if (source.board.empty() && source.calibration.empty()) {
    config.Fail("input",
                "the views need a calibration: name views of a board ('board'), or the "
                "calibration.json of an earlier run ('calibration')");
  }
  return source;
}

void AddPhotographs(const PhotographSource& source, ResolvedConfig* resolved) {
  const auto add = [&](const char* key, const std::filesystem::path& path) {
    if (!path.empty()) resolved->Add(std::string("input.") + key, path.string());
  };
  add("left", source.left);
  add("right", source.right);
  add("left_mask", source.left_mask);
  add("right_mask", source.right_mask);
  add("boards", source.boards);
  add("views", source.views);
  add("board", source.board);
  if (!source.calibration.empty()) {
    std::vector<std::string> files;
    for (const auto& path : source.calibration) files.push_back(path.string());
    resolved->Add("input.calibration", files);
  }
  add("truth", source.truth);
  if (source.unit) resolved->Add("input.unit", *source.unit);
}

StereoInput LoadStereo(const PhotographSource& source) {
  StereoInput input;
  input.unit = source.unit.value_or("mm");
  if (!source.left.empty()) {
    input.names = {source.left.string(), source.right.string()};
    ReadPhotograph(source.left, &input.left_colour, &input.left);
    ReadPhotograph(source.right, nullptr, &input.right);
    CheckSameSize(input.left, input.names[0], input.right, input.names[1], "a pair's images are of one size");
    input.left_mask = ReadMaskOf(source.left_mask, input.left, input.names[0]);
    input.right_mask = ReadMaskOf(source.right_mask, input.right, input.names[1]);
  }
  if (!source.truth.empty()) {
    input.truth = ReadRawImage(source.truth);
    CheckSameSize(input.left, input.names[0], input.truth, source.truth.string(),
                  "the truth has the left image's size");
  }
  if (!source.boards.empty()) input.boards = ReadImagePairs(source.boards);
  if (!source.calibration.empty()) {
    const Calibration calibration = ReadCalibration(
        source.calibration, {.unit = input.unit, .width = input.left.width, .height = input.left.height});
    const auto* const pair = std::get_if<StereoPairCalibration>(&calibration);
    if (pair == nullptr) {
      throw InputError(source.calibration.front().string() + ": calibrates " + KindOf(calibration) +
                       ", not a stereo pair; calibrate the pair from board views (input.boards)");
    }
    input.unit = UnitOf(pair->record, source);
    input.calibration = *pair;
  }
  return input;
}

TurntableInput LoadTurntable(const PhotographSource& source) {
  TurntableInput input;
  input.unit = source.unit.value_or("mm");
  if (!source.views.empty()) {
    const ViewList list = ReadViewList(source.views);
    for (std::size_t k = 0; k < list.views.size(); ++k) {
      const View& file = list.views[k];
      TurntableView view{.angle = *file.angle / kDegree, .name = file.image.string()};
      ReadPhotograph(file.image, &view.colour, &view.image);
      view.mask = ReadMaskOf(file.mask, view.image, view.name);
      if (k > 0) {
        CheckSameSize(input.views[0].image, input.views[0].name, view.image, view.name,
                      "all views are of one camera");
      }
      input.views.push_back(std::move(view));
    }
  }
  if (!source.board.empty()) input.board = ReadBoardViews(source.board);
  if (!source.truth.empty()) {
    input.truth = ReadPointCloud(source.truth).points;
    if (HasFaces(source.truth)) input.truth_mesh = ReadMesh(source.truth);
  }
  if (!source.calibration.empty()) ReadTurntableCalibration(source, &input);
  return input;
}

std::string PhotographDigest(const PhotographSource& source) {
  std::string digests;
  const auto add = [&](const std::filesystem::path& path) {
    if (!path.empty()) digests += Sha256(ReadFileBytes(path)) + "\n";
  };
  for (const auto& path : {source.left, source.right, source.left_mask, source.right_mask, source.truth}) {
    add(path);
  }
  for (const auto& path : source.calibration) add(path);
  if (!source.boards.empty()) {
    add(source.boards);
    for (const ImagePair& pair : ReadImagePairs(source.boards).pairs) {
      add(pair.left);
      add(pair.right);
    }
  }
  for (const auto& [list, read] :
       {std::pair(source.views, &ReadViewList), std::pair(source.board, &ReadBoardViews)}) {
    if (list.empty()) continue;
    add(list);
    for (const View& view : read(list).views) {
      add(view.image);
      add(view.mask);
    }
  }
  return Sha256(digests);
}

}  // namespace frond
