// SPDX-License-Identifier: BSD-3-Clause
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Message_ProgressScope.hxx>
#include <OSD_Path.hxx>
#include <STEPConstruct_ExternRefs.hxx>
#include <STEPControl_Reader.hxx>
#include <StepBasic_DocumentFile.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "entity_check.h"
#include "known_curves.h"
#include "plain_step.h"
#include "quick_healing.h"
#include "step_entities.h"
#include "step_parts.h"
#include "translator.h"
#include "changes/units.h"
#include "zero_edges.h"

namespace carreau_occ {

int StepParts::item_of(const Handle(Standard_Transient) & entity) const {
  const Handle(Transfer_Binder) binder = process->Find(entity);
  if (binder.IsNull() || !binder->HasResult()) return Document::none;
  const TopoDS_Shape shape = TransferBRep::ShapeResult(process, binder);
  if (shape.IsNull()) return Document::none;
  int item = Document::none;
  return items.Find(shape, item) ? item : document.find_component_or_part(shape);
}

namespace {

/// True if all bytes of a file above 127 are parts of characters of UTF-8.
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

TopoDS_Shape at_origin(const TopoDS_Shape& shape) { return shape.Located(TopLoc_Location()); }

/// Maps a shape and, for compounds, the shapes in it, without places.
void map_compounds(const TopoDS_Shape& shape, TopTools_MapOfShape& map) {
  map.Add(at_origin(shape));
  if (shape.ShapeType() != TopAbs_COMPOUND) return;
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) map_compounds(it.Value(), map);
}

void transfer_roots(STEPControl_Reader& reader, int roots, const Message_ProgressRange& progress) {
  Message_ProgressScope scope(progress, nullptr, std::max(roots, 1));
  for (int i = 1; i <= roots && scope.More(); ++i) reader.TransferOneRoot(i, scope.Next());
}

bool are_one_word(const TCollection_AsciiString& a, const TCollection_AsciiString& b) {
  return TCollection_AsciiString::IsSameString(a, b, Standard_False);
}

/// Documents of an assembly may be drawings and texts, too. Writers name the format, or nothing but the file.
bool is_step(const std::string& name, const TCollection_AsciiString& format) {
  constexpr const char* suffixes[] = {".stp", ".step", ".p21"};
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::any_of(std::begin(suffixes), std::end(suffixes), [&](const char* s) { return lower.ends_with(s); }))
    return true;
  return are_one_word(format, "STEP AP203") || are_one_word(format, "STEP AP214") || are_one_word(format, "STEP AP242");
}

/// Translates a file, and the files that it refers to, into a document.
class StepReader {
 public:
  explicit StepReader(Document& document) : document_(document) {}

  /// Translates roots of a file and all that they refer to. False: no roots, or it was stopped.
  bool translate(STEPControl_Reader& reader, const Message_ProgressRange& progress, int* first_item = nullptr);

  /// Losses of the files to which the first file refers.
  [[nodiscard]] const std::vector<std::string>& losses() const { return losses_; }
  [[nodiscard]] const std::vector<std::pair<TopoDS_Shape, std::string>>& doubtful() const { return doubtful_; }

 private:
  void find_products(STEPControl_Reader& reader, StepParts& parts);
  void read_other_files(StepParts& parts, const Message_ProgressRange& progress);
  int read_other_file(const std::string& name, const TCollection_AsciiString& path,
                      const Message_ProgressRange& progress);
  int add(const TopoDS_Shape& shape, const StepParts& parts);
  int add_compound(const TopoDS_Shape& shape, const StepParts& parts);

  Document& document_;
  TopTools_DataMapOfShapeInteger items_;
  TopTools_MapOfShape whole_;         // shapes of products and of representations
  std::map<std::string, int> files_;  // the first item of each other file
  std::vector<std::string> losses_;
  std::vector<std::pair<TopoDS_Shape, std::string>> doubtful_;
};

bool StepReader::translate(STEPControl_Reader& reader, const Message_ProgressRange& progress, int* first_item) {
  reader.ClearShapes();
  const int roots = reader.NbRootsForTransfer();
  Message_ProgressScope scope(progress, nullptr, 2);
  transfer_roots(reader, roots, scope.Next());
  if (scope.UserBreak() || reader.NbShapes() <= 0) return false;
  StepParts parts{reader.WS(), reader.WS()->TransferReader()->TransientProcess(), document_, items_};
  const TopTools_MapOfShape outer = whole_;
  whole_.Clear();
  find_products(reader, parts);
  const TopTools_MapOfShape own = whole_;
  read_other_files(parts, scope.Next());
  whole_ = own;
  for (int i = 1; i <= reader.NbShapes(); ++i) {
    const int item = add(reader.Shape(i), parts);
    if (i == 1 && first_item != nullptr) *first_item = item;
  }
  whole_ = outer;
  read_step_colours(parts);
  read_step_names(parts);
  read_step_names_inside(parts);
  read_step_layers(parts);
  return true;
}

/// Compounds that stand for products are assemblies where other such shapes are in them; others are parts as they are.
void StepReader::find_products(STEPControl_Reader& reader, StepParts& parts) {
  TopTools_MapOfShape made;
  for (int i = 1; i <= reader.NbShapes(); ++i) map_compounds(reader.Shape(i), made);
  const Handle(Interface_InterfaceModel) model = reader.Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    const auto product = as<StepBasic_ProductDefinition>(entity);
    if (product.IsNull() && !is<StepShape_ShapeRepresentation>(entity)) continue;
    const int index = parts.process->MapIndex(entity);
    if (index <= 0) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(parts.process->MapItem(index));
    if (shape.IsNull() || !made.Contains(shape)) continue;
    whole_.Add(shape);
    if (product.IsNull()) continue;
    parts.numbers.emplace(product.get(), parts.products.size());
    parts.products.push_back({shape, product});
  }
}

/// Products whose shapes are in files of their own.
void StepReader::read_other_files(StepParts& parts, const Message_ProgressRange& progress) {
  STEPConstruct_ExternRefs references(parts.session);
  references.LoadExternRefs();
  if (references.NbExternRefs() == 0) return;
  OSD_Path place(parts.session->LoadedFile());
  const TCollection_AsciiString own = place.Name() + place.Extension();
  place.SetName("");
  place.SetExtension("");
  TCollection_AsciiString folder;
  place.SystemName(folder);
  Message_ProgressScope scope(progress, nullptr, references.NbExternRefs());
  for (int i = 1; i <= references.NbExternRefs() && scope.More(); ++i) {
    const Message_ProgressRange range = scope.Next();
    const char* const name = references.FileName(i);
    if (name == nullptr || name[0] == '\0') continue;
    const Handle(TCollection_HAsciiString) format = references.Format(i);
    if (!is_step(name, format.IsNull() ? TCollection_AsciiString() : format->String())) continue;
    TCollection_AsciiString path = OSD_Path::AbsolutePath(folder, name);
    if (path.IsEmpty()) path = name;
    if (are_one_word(path, OSD_Path::AbsolutePath(folder, own))) continue;
    const Handle(StepBasic_ProductDefinition) definition = references.ProdDef(i);
    if (const auto found = parts.numbers.find(definition.get()); found != parts.numbers.end())
      parts.products[found->second].elsewhere = read_other_file(name, path, range);
    else
      losses_.push_back("file '" + std::string(name) + "', to which the file refers, has no place in it");
  }
}

int StepReader::read_other_file(const std::string& name, const TCollection_AsciiString& path,
                                const Message_ProgressRange& progress) {
  const auto [found, fresh] = files_.try_emplace(name, Document::none);
  if (!fresh) return found->second;
  const Handle(XSControl_WorkSession) session = new XSControl_WorkSession;
  session->SelectNorm("STEP");
  session->SetLibrary(new PlainStepLibrary);
  STEPControl_Reader reader(session, Standard_False);
  int item = Document::none;
  const bool read = std::filesystem::exists(path.ToCString()) && reader.ReadFile(path.ToCString()) == IFSelect_RetDone;
  if (read) {
    take_out_zero_edges(session->Model());
    const StepEntities kinds;
    const EntityCheck check(session, kinds);
    translate(reader, progress, &item);
    for (const std::string& loss : check.losses()) losses_.push_back(name + ": " + loss);
    for (auto& doubt : check.doubtful()) doubtful_.push_back(std::move(doubt));
  }
  if (item == Document::none)
    losses_.push_back("file '" + name + "', to which the file refers, " +
                      (read ? "holds no shape that can be translated" : "cannot be read"));
  return files_[name] = item;
}

int StepReader::add(const TopoDS_Shape& shape, const StepParts& parts) {
  if (int found = Document::none; items_.Find(shape, found)) return found;
  int item = Document::none;
  if (!shape.Location().IsIdentity()) {
    add(at_origin(shape), parts);
    item = document_.add(shape);
  } else {
    item = shape.ShapeType() == TopAbs_COMPOUND ? add_compound(shape, parts) : document_.add(shape);
  }
  items_.Bind(shape, item);
  return item;
}

int StepReader::add_compound(const TopoDS_Shape& shape, const StepParts& parts) {
  bool assembly = false;
  for (TopoDS_Iterator it(shape); it.More() && !assembly; it.Next()) assembly = whole_.Contains(at_origin(it.Value()));
  if (shape.NbChildren() == 0)
    for (const StepParts::Product& product : parts.products)
      if (product.elsewhere != Document::none && product.shape.IsSame(shape)) return product.elsewhere;
  if (!assembly) return document_.add(shape);
  const int item = document_.add_assembly();
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) {
    const int part = add(at_origin(it.Value()), parts);
    if (part == Document::none) continue;
    const int component = document_.add_component(item, part, it.Value().Location());
    if (!items_.IsBound(it.Value())) items_.Bind(it.Value(), component);
  }
  return item;
}

/// Texts of STEP are ASCII, with escapes for other characters (ISO 10303-21). Other characters that writers put there
/// are UTF-8, or in the code of their machine, most often the code of Western Europe.
void choose_encoding(const std::string& path) {
  Interface_Static::SetCVal("read.step.codepage", is_utf8(path) ? "UTF8" : "CP1252");
}

/// While one lives, translation does not look for smooth edges: no mesh depends on the marks that it would leave.
class WithoutSmoothEdges {
 public:
  WithoutSmoothEdges() : before_(Interface_Static::RVal(angle)) { Interface_Static::SetRVal(angle, 0); }
  ~WithoutSmoothEdges() { Interface_Static::SetRVal(angle, before_); }
  WithoutSmoothEdges(const WithoutSmoothEdges&) = delete;
  WithoutSmoothEdges& operator=(const WithoutSmoothEdges&) = delete;

 private:
  static constexpr const char* angle = "read.encoderegularity.angle";
  double before_;
};

}  // namespace
}  // namespace carreau_occ

using namespace carreau_occ;

void carreau_translate_step(const std::string& path, const Message_ProgressRange& progress, ShapeFile& file) {
  STEPControl_Reader reader;  // settings are known once there is one
  choose_encoding(path);
  const WithoutSmoothEdges plain;
  const Handle(PlainStepLibrary) library = new PlainStepLibrary;
  reader.WS()->SetLibrary(library);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) refuse(path, "is not a readable STEP file");
  if (const std::string note = library->note(); !note.empty()) file.notes.push_back(note);
  take_out_zero_edges(reader.WS()->Model());
  const StepEntities kinds;
  const EntityCheck check(reader.WS(), kinds);
  const KnownCurves known;
  const QuickHealing quick;
  Document document;
  StepReader translation(document);
  const bool translated = translation.translate(reader, progress);
  file.losses = check.losses();
  file.losses.insert(file.losses.end(), translation.losses().begin(), translation.losses().end());
  if (const std::string note = check.passed_over(); !note.empty()) file.notes.push_back(note);
  if (!translated) {
    refuse_tessellated(path);
    refuse_untranslated(path, "STEP", file);
  }
  file.doubtful = check.doubtful();
  file.doubtful.insert(file.doubtful.end(), translation.doubtful().begin(), translation.doubtful().end());
  document.write(file);
  file.unit = "mm";
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  if (!lengths.IsEmpty()) file.file_unit = unit_sign(lengths.First().ToCString());
}
