// SPDX-License-Identifier: BSD-3-Clause
// Shapes from and to STEP and IGES. Open CASCADE's types: include this in io/cad_*.cc only.
#pragma once

#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string>

namespace frond {

// Open CASCADE for the length of a call: one at a time, silent, working in `unit`, so that coordinates are
// neither scaled on the way out nor in.
class CadSession {
 public:
  CadSession();
  void SetUnit(const std::string& unit) const;  // one of LengthUnitNames

 private:
  std::lock_guard<std::mutex> lock_;
};

// Runs `body`; Open CASCADE's exceptions become ours.
template <typename Error, typename Body>
auto Guarded(const std::string& what, const Body& body) {
  try {
    return body();
  } catch (const Standard_Failure& failure) {
    std::string text = failure.GetMessageString() == nullptr ? "" : failure.GetMessageString();
    std::replace(text.begin(), text.end(), '\n', ' ');
    throw Error(what + ": Open CASCADE fails: " + failure.DynamicType()->Name() + " " + text);
  }
}

// The file's bytes, in the session's unit. Solids become manifold B-reps in IGES (entity 186), other faces
// trimmed surfaces (144). Throw InputError where Open CASCADE cannot; `path` is for messages.
std::string StepText(const std::filesystem::path& path, const TopoDS_Shape& shape);
std::string IgesText(const std::filesystem::path& path, const TopoDS_Shape& shape, const std::string& unit);

// The shape of a .step, .stp, .igs or .iges file, not null, in the file's unit, which becomes the session's.
// Throws InputError.
TopoDS_Shape LoadShape(const std::filesystem::path& path, const CadSession& session, std::string* unit);

}  // namespace frond
