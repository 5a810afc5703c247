#include "shape_file.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
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
#include <cctype>
#include <fstream>
#include <stdexcept>

#include "faults.h"

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

/// OpenCASCADE writes to std::cout what it meets; nobody asked for that.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~Silence() { Message::DefaultMessenger()->ChangePrinters() = printers_; }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
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

template <typename Reader>
void read_document(const std::string& path, const char* kind, ShapeFile& file) {
  // Names of faces are kept, and no names are invented.
  XCAFDoc_ShapeTool::SetAutoNaming(Standard_False);
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  Reader reader;
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);  // known once there is a reader
  reader.SetNameMode(Standard_True);
  reader.SetColorMode(Standard_True);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    refuse(path, std::string("is not a readable ") + kind + " file");
  if (!reader.Transfer(document))
    refuse(path, std::string("the ") + kind + " file holds no shape that can be translated");
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

void read_as(Format format, const std::string& path, ShapeFile& file) {
  switch (format) {
    case Format::step:
      read_document<STEPCAFControl_Reader>(path, "STEP", file);
      break;
    case Format::iges:
      read_document<IGESCAFControl_Reader>(path, "IGES", file);
      break;
    default: {
      BRep_Builder builder;
      if (!BRepTools::Read(file.shape, path.c_str(), builder)) refuse(path, "is not a readable BREP file");
    }
  }
}

}  // namespace

ShapeFile read_shape(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "cannot be opened");
  const Format content = format_by_content(stream);
  stream.close();
  Format format = format_by_suffix(path);
  if (format == Format::unknown) format = content;
  if (format == Format::unknown) refuse(path, "is no STEP, IGES or BREP file");
  if (content != format) {
    const char* expected = format == Format::step ? "STEP" : format == Format::iges ? "IGES" : "BREP";
    refuse(path, std::string("is not what its suffix says: it does not begin like a ") + expected + " file");
  }
  const Silence silence;
  ShapeFile file;
  try {
    guarded([&] { read_as(format, path, file); });
  } catch (const Standard_Failure& failure) {
    refuse(path, std::string("OpenCASCADE cannot read it: ") + failure.GetMessageString());
  }
  if (file.shape.IsNull() || !TopExp_Explorer(file.shape, TopAbs_FACE).More()) refuse(path, "holds no face");
  return file;
}

}  // namespace carreau_occ
