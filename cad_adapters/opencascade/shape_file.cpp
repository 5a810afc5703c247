// SPDX-License-Identifier: BSD-3-Clause
#include "shape_file.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "entity_check.h"
#include "faults.h"
#include "natural_bounds.h"
#include "zero_edges.h"

namespace carreau_occ {

namespace {

enum class Format { unknown, step, iges, brep };

Format format_by_suffix(const std::string& path) {
  const std::size_t dot = path.find_last_of('.');
  if (dot == std::string::npos) return Format::unknown;
  std::string suffix = path.substr(dot + 1);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == "step" || suffix == "stp") return Format::step;
  if (suffix == "iges" || suffix == "igs") return Format::iges;
  if (suffix == "brep" || suffix == "brp") return Format::brep;
  return Format::unknown;
}

Format format_by_content(std::ifstream& file) {
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  if (head.find("ISO-10303-21") != std::string::npos) return Format::step;
  if (head.find("DBRep_DrawableShape") != std::string::npos || head.find("CASCADE Topology") != std::string::npos)
    return Format::brep;
  // Column 73 of the first line says S (start section).
  if (head.size() > 73 && head[72] == 'S') return Format::iges;
  return Format::unknown;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

/// OpenCASCADE writes to std::cout what it meets, through its messengers and, where it reads BREP files, by itself;
/// nobody asked for that.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()), buffer_(std::cout.rdbuf(nullptr)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~Silence() {
    Message::DefaultMessenger()->ChangePrinters() = printers_;
    std::cout.rdbuf(buffer_);  // clears what went wrong without one
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* buffer_;
};

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  return TCollection_AsciiString(name->Get()).ToCString() /* UTF-8 */;
}

void collect_labels(const Handle(XCAFDoc_ShapeTool) & shapes, const Handle(XCAFDoc_ColorTool) & colours,
                    const TDF_Label& label, const TopLoc_Location& place, ShapeFile& file) {
  TopoDS_Shape part;
  if (XCAFDoc_ShapeTool::GetShape(label, part) && !part.IsNull()) {
    ShapeFile::Label entry{.part = part.Moved(place), .name = name_of(label)};
    Quantity_Color colour;
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
      if (entry.has_colour || !colours->GetColor(label, type, colour)) continue;
      entry.has_colour = true;
      colour.Values(entry.red, entry.green, entry.blue, Quantity_TOC_sRGB);
    }
    if (!entry.name.empty() || entry.has_colour) file.labels.push_back(entry);
  }
  if (XCAFDoc_ShapeTool::IsReference(label)) {
    TDF_Label referred;
    if (XCAFDoc_ShapeTool::GetReferredShape(label, referred))
      collect_labels(shapes, colours, referred, place * XCAFDoc_ShapeTool::GetLocation(label), file);
    return;
  }
  for (TDF_ChildIterator child(label); child.More(); child.Next())
    collect_labels(shapes, colours, child.Value(), place, file);
}

/// Hands on how far a translation is.
class Indicator final : public Message_ProgressIndicator {
 public:
  explicit Indicator(const ReadingProgress& progress) : progress_(progress) {}
  Standard_Boolean UserBreak() override { return stopped_; }
  void Show(const Message_ProgressScope&, Standard_Boolean) override {
    if (progress_ && !stopped_ && !progress_(GetPosition())) stopped_ = true;
  }
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }

 private:
  const ReadingProgress& progress_;
  std::atomic<bool> stopped_{false};
};

Handle(XSControl_WorkSession) session_of(STEPCAFControl_Reader& reader) { return reader.ChangeReader().WS(); }
Handle(XSControl_WorkSession) session_of(IGESCAFControl_Reader& reader) { return reader.WS(); }

/// Whether all bytes of a file above 127 are parts of characters of UTF-8.
bool is_utf8(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> block(1 << 16);
  int missing = 0;  // bytes of the character
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    for (std::streamsize i = 0; i < stream.gcount(); ++i) {
      const auto byte = static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      const bool continues = byte >= 0x80 && byte < 0xC0;
      if (continues != (missing > 0) || byte == 0xC0 || byte == 0xC1 || byte > 0xF4) return false;
      missing = continues ? missing - 1 : byte < 0xC0 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
    }
  }
  return missing == 0;
}

/// Texts of STEP are ASCII, with escapes for other characters (ISO 10303-21); what writers put there beside is UTF-8,
/// or the code of their machine, of which that of Western Europe is the most common.
void choose_encoding(STEPCAFControl_Reader&, const std::string& path) {
  Interface_Static::SetCVal("read.step.codepage", is_utf8(path) ? "UTF8" : "CP1252");
}
void choose_encoding(IGESCAFControl_Reader&, const std::string&) {}

void mend_resolution(STEPCAFControl_Reader&) {}

/// What is smaller than the resolution that an IGES file claims OpenCASCADE takes for a point: holes vanish without a
/// word. Some writers claim absurd ones (that of OpenCASCADE 7.6 when it is given several shapes, 1e43 for instance).
void mend_resolution(IGESCAFControl_Reader& reader) {
  constexpr double largest = 1e-3, usual = 1e-5;  // shares of the largest coordinate; the latter is HDR's eps1
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  if (model.IsNull()) return;
  IGESData_GlobalSection header = model->GlobalSection();
  const double extent = header.HasMaxCoord() ? header.MaxCoord() : 0;
  if (!(extent > 0) || header.Resolution() <= largest * extent) return;
  header.SetResolution(usual * extent);
  model->SetGlobalSection(header);
}

template <typename Reader>
void read_document(const std::string& path, const char* kind, const Handle(Indicator) & indicator, ShapeFile& file) {
  // Names of faces are kept, and no names are invented.
  XCAFDoc_ShapeTool::SetAutoNaming(Standard_False);
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  Reader reader;
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);  // known once there is a reader
  choose_encoding(reader, path);
  reader.SetNameMode(Standard_True);
  reader.SetColorMode(Standard_True);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    refuse(path, std::string("is not a readable ") + kind + " file");
  mend_resolution(reader);
  take_out_zero_edges(session_of(reader)->Model());
  const EntityCheck check(session_of(reader));
  const bool translated = reader.Transfer(document, indicator->Start());
  file.losses = check.losses();
  if (!translated)
    refuse(path, std::string("the ") + kind + " file holds no shape that can be translated" +
                     (file.losses.empty() ? "" : " (" + file.losses.front() + ")"));
  file.doubtful = check.doubtful();
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  TDF_LabelSequence roots;
  shapes->GetFreeShapes(roots);
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (int i = 1; i <= roots.Length(); ++i) {
    TopoDS_Shape part;
    if (!XCAFDoc_ShapeTool::GetShape(roots.Value(i), part) || part.IsNull()) continue;
    builder.Add(all, part);
    collect_labels(shapes, colours, roots.Value(i), {}, file);
  }
  file.shape = all;
  file.unit = "mm";
}

// OpenCASCADE's reader of BREP files looks for words without end when there is nothing left to read; and it goes on
// with what it had when a number is none.
void read_brep(const std::string& path, const Handle(Indicator) & indicator, ShapeFile& file) {
  std::ifstream stream(path, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  const BRep_Builder builder;
  try {
    BRepTools::Read(file.shape, stream, builder, indicator->Start());
  } catch (const std::ios_base::failure&) {
    refuse(path, "is not a readable BREP file: it is cut off, or a number in it is none");
  }
  // Here only: other formats say the bounds of each face, and one whose bounds could not be read is not the whole.
  if (!file.shape.IsNull()) add_natural_bounds(file.shape);
}

void read_as(Format format, const std::string& path, const Handle(Indicator) & indicator, ShapeFile& file) {
  if (format == Format::step)
    read_document<STEPCAFControl_Reader>(path, "STEP", indicator, file);
  else if (format == Format::iges)
    read_document<IGESCAFControl_Reader>(path, "IGES", indicator, file);
  else
    read_brep(path, indicator, file);
}

}  // namespace

ShapeFile read_shape(const std::string& path, const ReadingProgress& progress) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "cannot be opened");
  if (std::filesystem::is_directory(path)) refuse(path, "is a folder");
  const Format content = format_by_content(stream);
  stream.close();
  Format format = format_by_suffix(path);
  if (format == Format::unknown) format = content;
  if (format == Format::unknown) refuse(path, "is no STEP, IGES or BREP file");
  if (content != format) {
    const char* expected = format == Format::step ? "a STEP" : format == Format::iges ? "an IGES" : "a BREP";
    refuse(path, std::string("is not what its suffix says: it does not begin like ") + expected + " file");
  }
  const Silence silence;
  ShapeFile file;
  const Handle(Indicator) indicator = new Indicator(progress);
  try {
    guarded([&] { read_as(format, path, indicator, file); });
  } catch (const Standard_Failure& failure) {
    refuse(path, std::string("OpenCASCADE cannot read it: ") + failure.GetMessageString());
  }
  if (indicator->stopped()) refuse(path, "was not read to its end: it was asked to stop");
  if (file.shape.IsNull() || !TopExp_Explorer(file.shape, TopAbs_EDGE).More())
    refuse(path, std::string("holds no face and no edge") +
                     (file.losses.empty() ? "" : " that can be read (" + file.losses.front() + ")"));
  return file;
}

}  // namespace carreau_occ
