// SPDX-License-Identifier: BSD-3-Clause
// What Gmsh leaves out of a mesh of shells.
#pragma once

#include <string>
#include <vector>

namespace frond {

// The text of an .inp file whose triangles are shells, S3 and S6 (CalculiX; Abaqus calls S6 STRI65), instead
// of Gmsh's plane-stress elements, which a curved surface cannot have.
std::string WithShellElements(const std::string& inp);

// inp, bdf: the formats with sections.
const std::vector<std::string>& ShellSectionFormats();

// With one section for all shells, of this thickness in the mesh's unit. inp: *SHELL SECTION of the set
// `surface`, material `material`; bdf: PSHELL 1, material 1. The material itself is for the user to add.
std::string WithShellSection(const std::string& text, const std::string& format, double thickness);

}  // namespace frond
