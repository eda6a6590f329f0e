// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/synth_turntable.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/option_specs.h"
#include "base/parallel.h"
#include "io/calibration_file.h"
#include "io/file_bytes.h"
#include "io/image_file.h"
#include "io/mesh_file.h"
#include "io/number_text.h"
#include "problems/turntable/synthetic_turntable.h"

namespace frond {
namespace {

constexpr char kMasks[] = "masks";
constexpr char kUnit[] = "mm";

// "007".
std::string Number(std::size_t index) {
  const std::string digits = std::to_string(index);
  return std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

// body(index) for each, on several threads.
template <typename Body>
void ForEach(std::size_t count, int threads, const Body& body) {
  ParallelFor(count, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) body(k);
  });
}

void WriteViews(const SyntheticTurntable& session, bool masks, int threads, const RunDirectory& run) {
  std::filesystem::create_directory(run.File("views"));
  const auto& views = session.views();
  const auto name = [](std::size_t k, const char* what) { return "views/" + Number(k) + what; };
  ForEach(views.size(), threads, [&](std::size_t k) {
    const SyntheticView view = session.View(k);
    if (view.colour.empty()) {
      WriteImage(run.File(name(k, ".png")), view.image);
    } else {
      WriteColourImage(run.File(name(k, ".png")), view.colour);
    }
    if (masks) WriteMask(run.File(name(k, "_mask.png")), view.mask);
  });
  std::string list = masks ? "image,angle,mask\n" : "image,angle\n";
  for (std::size_t k = 0; k < views.size(); ++k) {
    list += name(k, ".png") + "," + FormatNumber(views[k].angle);
    if (masks) list += "," + name(k, "_mask.png");
    list += "\n";
  }
  WriteFileBytes(run.File("views.csv"), list);
}

void WriteBoards(const SyntheticTurntable& session, int threads, const RunDirectory& run) {
  std::filesystem::create_directory(run.File("board"));
  const auto& boards = session.boards();
  const auto name = [](std::size_t k) { return "board/" + Number(k) + ".png"; };
  ForEach(boards.size(), threads,
          [&](std::size_t k) { WriteImage(run.File(name(k)), session.BoardView(k).image); });
  std::string list = "image,angle\n";
  for (std::size_t k = 0; k < boards.size(); ++k) {
    list += name(k) + "," + (boards[k].angle ? FormatNumber(*boards[k].angle) : "") + "\n";
  }
  WriteFileBytes(run.File("board.csv"), list);
}

}  // namespace

std::vector<OptionSpec> SynthTurntableSpecs() {
  std::vector<OptionSpec> specs = SyntheticTurntableSpecs();
  specs.push_back(FlagSpec(kMasks, false, "Write the true silhouettes too, and name them in views.csv"));
  return specs;
}

void WriteSynthTurntable(const Options& options, std::uint64_t seed, int threads, const RunDirectory& run) {
  const SyntheticTurntable session(SyntheticTurntableOptionsFrom(options, seed));
  WriteViews(session, options.Flag(kMasks), threads, run);
  WriteBoards(session, threads, run);
  CalibrationRecord exact;
  exact.unit = kUnit;
  WriteCalibration(run.File("calibration.json"), TurntableCalibration{session.rig(), exact});
  WriteMesh(run.File("truth.ply"), session.TruthMesh(), kUnit);
  nlohmann::ordered_json truth;
  truth["schema"] = "frond.turntable_truth/1";
  truth["seed"] = seed;
  truth["unit"] = kUnit;
  for (const auto& [key, value] : session.TruthValues()) truth["values"][key] = value;
  WriteFileBytes(run.File("truth.json"), truth.dump(2) + "\n");
}

}  // namespace frond
