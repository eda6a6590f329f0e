// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_exchange.h"

#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <STEPEdit.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <UnitsMethods.hxx>
#include <XSControl_WorkSession.hxx>
#include <array>
#include <sstream>
#include <string_view>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/length_unit.h"
#include "io/number_text.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

struct CadUnit {
  const char *ours, *theirs;
  int iges_flag;          // IGES 5.3, table 2
  const char* step_name;  // as STEPControl_Reader::FileUnits says it, lower case
};
constexpr std::array<CadUnit, 7> kUnits = {{{"um", "UM", 9, "micrometre"},
                                            {"mm", "MM", 2, "millimetre"},
                                            {"cm", "CM", 10, "centimetre"},
                                            {"m", "M", 6, "metre"},
                                            {"km", "KM", 7, "kilometre"},
                                            {"in", "INCH", 1, "inch"},
                                            {"ft", "FT", 4, "foot"}}};

const CadUnit& FindUnit(const std::string& unit) {
  MetresPerUnit(unit);  // throws where unknown
  return *std::find_if(kUnits.begin(), kUnits.end(), [&](const CadUnit& u) { return unit == u.ours; });
}

// 16 digits: as many as fit Open CASCADE's own buffers. Its default writes 6 to 12, and its suppression of
// zeros drops exponents of longer formats.
void SetFullPrecision(Interface_FloatWriter* writer) {
  writer->SetFormat("%.15E");
  writer->SetZeroSuppress(false);
}

[[noreturn]] void FailWrite(const fs::path& path, const char* format) {
  FailFile(path, std::string("cannot be written: Open CASCADE cannot make ") + format +
                     " of it; write another format, for example json");
}

// IGES models hold the internal unit themselves.
void SetUnit(const CadUnit& unit, const Handle(IGESData_IGESModel) & model) {
  IGESData_GlobalSection section = model->GlobalSection();
  section.SetCascadeUnit(1000 * MetresPerUnit(unit.ours));
  model->SetGlobalSection(section);
}

bool IsIges(const fs::path& path) { return Extension(path) == "igs" || Extension(path) == "iges"; }

const CadUnit& StepUnit(STEPControl_Reader* reader) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader->FileUnits(lengths, angles, solid_angles);
  if (!lengths.IsEmpty()) {
    TCollection_AsciiString name = lengths.First();
    name.LowerCase();
    for (const CadUnit& unit : kUnits) {
      if (name == unit.step_name) return unit;
    }
  }
  return FindUnit("mm");  // Open CASCADE converts any other
}

// Open CASCADE 7.6 reads on with entities that did not parse, and crashes on some of them.
void RefuseDamage(const fs::path& path, const Handle(XSControl_WorkSession) & session) {
  const Interface_CheckIterator checks = session->ModelCheckList(Standard_True);
  if (!checks.IsEmpty(Standard_True)) {
    FailFile(path, "is damaged: Open CASCADE cannot read all of its entities; export it again");
  }
}

TopoDS_Shape LoadStep(const fs::path& path, const CadSession& session, std::string* unit) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    FailFile(path, "is not a STEP file that can be read");
  RefuseDamage(path, reader.WS());
  const CadUnit& found = StepUnit(&reader);
  session.SetUnit(found.ours);
  *unit = found.ours;
  reader.TransferRoots();
  return reader.NbShapes() > 0 ? reader.OneShape() : TopoDS_Shape();
}

TopoDS_Shape LoadIges(const fs::path& path, const CadSession& session, std::string* unit) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    FailFile(path, "is not an IGES file that can be read");
  RefuseDamage(path, reader.WS());
  const int flag = reader.IGESModel()->GlobalSection().UnitFlag();
  const auto known =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const CadUnit& u) { return u.iges_flag == flag; });
  const CadUnit& found = known == kUnits.end() ? FindUnit("mm") : *known;
  session.SetUnit(found.ours);
  SetUnit(found, reader.IGESModel());
  *unit = found.ours;
  reader.TransferRoots();
  return reader.NbShapes() > 0 ? reader.OneShape() : TopoDS_Shape();
}

// IGES lines have 80 columns, the section's letter in the 73rd; the last one counts the lines of each
// section: "S      1G      4D     12P     30". Open CASCADE crashes on some files that were cut short.
void RefuseCutIges(const fs::path& path, const std::string& bytes) {
  constexpr std::size_t kLetter = 72;
  const std::string sections = "SGDP";
  std::array<std::size_t, 4> counts = {};
  std::istringstream lines(bytes);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.size() <= kLetter) continue;
    const std::size_t section = sections.find(line[kLetter]);
    if (section != std::string::npos) ++counts[section];
    last = line;
  }
  if (counts[0] == 0) FailFile(path, "is not an IGES file (no 'S' in column 73)");
  bool whole = last.size() > kLetter && last[kLetter] == 'T';
  for (std::size_t k = 0; k < sections.size() && whole; ++k) {
    double promised = 0;
    const std::string_view field = std::string_view(last).substr(8 * k + 1, 7);
    const std::size_t digits = field.find_first_not_of(' ');
    whole = last[8 * k] == sections[k] && digits != std::string_view::npos &&
            ParseNumber(field.substr(digits), &promised) > 0 && promised == static_cast<double>(counts[k]);
  }
  if (!whole) FailFile(path, "is truncated: its last line does not count its lines; copy or export it again");
}

std::mutex session_mutex;

}  // namespace

CadSession::CadSession() : lock_(session_mutex) {
  static const bool initialised = [] {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    STEPControl_Controller::Init();
    IGESControl_Controller::Init();
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetCVal("write.step.product.name", "frond surface");
    Interface_Static::SetIVal("read.iges.bspline.continuity", 0);  // as written, not smoothed
    return true;
  }();
  static_cast<void>(initialised);
}

void CadSession::SetUnit(const std::string& name) const {
  const CadUnit& unit = FindUnit(name);
  Interface_Static::SetCVal("xstep.cascade.unit", unit.theirs);
  Interface_Static::SetCVal("write.step.unit", unit.theirs);
  Interface_Static::SetCVal("write.iges.unit", unit.theirs);
  UnitsMethods::SetCasCadeLengthUnit(unit.iges_flag);
}

std::string StepText(const fs::path& path, const TopoDS_Shape& shape) {
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) FailWrite(path, "STEP");
  StepData_StepWriter out(writer.Model());
  SetFullPrecision(&out.FloatWriter());
  out.SendModel(Handle(StepData_Protocol)::DownCast(STEPEdit::Protocol()));
  std::ostringstream text;
  if (!out.Print(text)) FailWrite(path, "STEP");
  return text.str();
}

std::string IgesText(const fs::path& path, const TopoDS_Shape& shape, const std::string& name) {
  const CadUnit& unit = FindUnit(name);
  const bool solid = TopExp_Explorer(shape, TopAbs_SOLID).More();
  IGESControl_Writer writer(unit.theirs, /*modecr: 1 B-reps, 0 trimmed surfaces*/ solid ? 1 : 0);
  SetUnit(unit, writer.Model());
  if (!writer.AddShape(shape)) FailWrite(path, "IGES");
  writer.ComputeModel();
  IGESData_IGESWriter out(writer.Model());
  SetFullPrecision(&out.FloatWriter());
  out.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ostringstream text;
  if (!out.Print(text)) FailWrite(path, "IGES");
  return text.str();
}

// A look at the beginning spares Open CASCADE's scanners the worst.
TopoDS_Shape LoadShape(const fs::path& path, const CadSession& session, std::string* unit) {
  const std::string bytes = ReadFileBytes(path);
  if (bytes.empty()) FailFile(path, "is empty");
  if (bytes.find('\0') != std::string::npos) FailFile(path, "is a binary file, not STEP or IGES");
  if (IsIges(path)) {
    RefuseCutIges(path, bytes);
  } else if (bytes.find("ISO-10303-21") > 1000) {
    FailFile(path, "is not a STEP file (it does not begin with ISO-10303-21)");
  }
  TopoDS_Shape shape = IsIges(path) ? LoadIges(path, session, unit) : LoadStep(path, session, unit);
  if (shape.IsNull()) FailFile(path, "holds no shape");
  return shape;
}

}  // namespace frond
