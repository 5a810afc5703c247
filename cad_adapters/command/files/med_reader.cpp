// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "base/failure.h"
#include "files/med_file.h"
#include "files/med_library.h"

namespace command {
namespace {

/// An element of the format, and the element of Gmsh that takes its first nodes.
struct Kind {
  med_geometry_type med;
  const char* name;
  int nodes, gmsh, dimension;
  std::array<std::int8_t, 9> order;  ///< rank in MED's list of each node of Gmsh's
};

// MED turns its solids inside out. Solids of order 2 have their corners alone.
constexpr Kind kinds[] = {{MED_SEG2, "SEG2", 2, 1, 1, {0, 1}},
                          {MED_SEG3, "SEG3", 3, 8, 1, {0, 1, 2}},
                          {MED_TRIA3, "TRIA3", 3, 2, 2, {0, 1, 2}},
                          {MED_TRIA6, "TRIA6", 6, 9, 2, {0, 1, 2, 3, 4, 5}},
                          {MED_QUAD4, "QUAD4", 4, 3, 2, {0, 1, 2, 3}},
                          {MED_QUAD8, "QUAD8", 8, 16, 2, {0, 1, 2, 3, 4, 5, 6, 7}},
                          {MED_QUAD9, "QUAD9", 9, 10, 2, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
                          {MED_TETRA4, "TETRA4", 4, 4, 3, {0, 2, 1, 3}},
                          {MED_TETRA10, "TETRA10", 10, 4, 3, {0, 2, 1, 3}},
                          {MED_HEXA8, "HEXA8", 8, 5, 3, {0, 3, 2, 1, 4, 7, 6, 5}},
                          {MED_HEXA20, "HEXA20", 20, 5, 3, {0, 3, 2, 1, 4, 7, 6, 5}},
                          {MED_HEXA27, "HEXA27", 27, 5, 3, {0, 3, 2, 1, 4, 7, 6, 5}},
                          {MED_PENTA6, "PENTA6", 6, 6, 3, {0, 2, 1, 3, 5, 4}},
                          {MED_PENTA15, "PENTA15", 15, 6, 3, {0, 2, 1, 3, 5, 4}},
                          {MED_PENTA18, "PENTA18", 18, 6, 3, {0, 2, 1, 3, 5, 4}},
                          {MED_PYRA5, "PYRA5", 5, 7, 3, {0, 3, 2, 1, 4}},
                          {MED_PYRA13, "PYRA13", 13, 7, 3, {0, 3, 2, 1, 4}}};
constexpr Kind unread[] = {
    {MED_TRIA7, "TRIA7", 7, 0, 2, {}}, {MED_POLYGON, "POLYGON", 1, 0, 2, {}}, {MED_POLYGON2, "POLYGON2", 1, 0, 2, {}}};

std::size_t gmsh_nodes(int type) {
  constexpr std::array<std::size_t, 17> nodes{0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 0, 0, 0, 0, 0, 8};
  return nodes[static_cast<std::size_t>(type)];
}

template <typename T>
void append(std::string& text, T number) {
  char buffer[32];
  const char* const end = std::to_chars(std::begin(buffer), std::end(buffer), number).ptr;
  text += std::string_view(buffer, static_cast<std::size_t>(end - buffer));
  text += ' ';
}

/// Returns 7 for "face_7" and -7 for "face_m7" where `before` is "face_"; false: it is another name.
bool reference_in(std::string_view name, std::string_view before, std::int32_t& ref) {
  if (!name.starts_with(before)) return false;
  name.remove_prefix(before.size());
  const bool minus = name.starts_with('m');
  if (minus) name.remove_prefix(1);
  if (name.empty() || name.front() == '-') return false;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), ref);
  if (minus) ref = -ref;
  return error == std::errc() && end == name.data() + name.size();
}

class MedReader {
 public:
  explicit MedReader(const std::string& path) : path_(path), med_(med_library()) { open(); }
  ~MedReader() {
    if (file_ >= 0) med_.fileClose(file_);
  }
  MedReader(const MedReader&) = delete;
  MedReader& operator=(const MedReader&) = delete;

  std::string run();

 private:
  struct Elements {
    const Kind* kind;
    std::vector<med_int> nodes, families;
  };
  struct Family {
    std::int32_t ref = 0;
    std::string name;
  };

  [[noreturn]] void fail(const std::string& why) const {
    throw Failure("'" + path_ + "' cannot be read: " + why + ".");
  }
  void check(med_int status, const char* what) const {
    if (status < 0) fail(std::string("the MED library cannot read its ") + what);
  }
  void open();
  void choose_mesh();
  [[nodiscard]] std::size_t count(med_entity_type entity, med_geometry_type type, med_data_type data) const;
  void read_nodes();
  void read_elements();
  void read_groups();
  void number_families(int dimension, std::string_view before);

  std::string path_;
  const MedLibrary& med_;
  med_idt file_ = -1;
  char mesh_[MED_NAME_SIZE + 1] = {};
  med_int step_ = MED_NO_DT, iteration_ = MED_NO_IT;
  std::size_t space_ = 3;
  std::vector<double> coordinates_;
  std::vector<Elements> elements_;
  std::map<med_int, std::vector<std::string>> groups_;
  std::map<std::pair<int, med_int>, Family> families_;  ///< by dimension and number
};

void MedReader::open() {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error)) fail(error ? error.message() : "it is not an ordinary file");
  med_bool is_hdf = MED_FALSE, is_med = MED_FALSE;
  if (med_.fileCompatibility(path_.c_str(), &is_hdf, &is_med) < 0 || is_hdf != MED_TRUE) fail("it is not an HDF5 file");
  if (is_med != MED_TRUE) fail("its version of the format is not known to the MED library");
  file_ = med_.fileOpen(path_.c_str(), MED_ACC_RDONLY);
  if (file_ < 0) fail("the MED library cannot open it");
}

void MedReader::choose_mesh() {
  const med_int meshes = med_.nMesh(file_);
  if (meshes < 1) fail("it has no mesh");
  std::string names;
  for (int i = 1; i <= meshes; ++i) {
    const med_int axes = med_.meshnAxis(file_, i);
    check(axes, "meshes");
    med_int space = 0, dimension = 0, steps = 0;
    med_mesh_type type = MED_UNDEF_MESH_TYPE;
    med_sorting_type sorting = MED_SORT_UNDEF;
    med_axis_type axis = MED_UNDEF_AXIS_TYPE;
    char description[MED_COMMENT_SIZE + 1] = {}, unit[MED_SNAME_SIZE + 1] = {};
    std::string axis_names(static_cast<std::size_t>(axes) * MED_SNAME_SIZE + 1, '\0'), units = axis_names;
    check(med_.meshInfo(file_, i, mesh_, &space, &dimension, &type, description, unit, &sorting, &steps, &axis,
                        axis_names.data(), units.data()),
          "meshes");
    names += std::string(i > 1 ? ", '" : "'") + mesh_ + "'";
    if (type != MED_UNSTRUCTURED_MESH || axis != MED_CARTESIAN || space < 2 || space > 3)
      fail("the mesh '" + std::string(mesh_) + "' is not a mesh of elements in Cartesian coordinates");
    space_ = static_cast<std::size_t>(space);
    med_float time = 0;
    if (steps > 0) check(med_.meshComputationStepInfo(file_, mesh_, 1, &step_, &iteration_, &time), "steps");
  }
  if (meshes > 1) fail("it has several meshes (" + names + ")");
}

std::size_t MedReader::count(med_entity_type entity, med_geometry_type type, med_data_type data) const {
  med_bool changed = MED_FALSE, transformed = MED_FALSE;
  const med_connectivity_mode mode = data == MED_COORDINATE ? MED_NO_CMODE : MED_NODAL;
  const med_int n = med_.meshnEntity(file_, mesh_, step_, iteration_, entity, type, data, mode, &changed, &transformed);
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

void MedReader::read_nodes() {
  const std::size_t n = count(MED_NODE, MED_NONE, MED_COORDINATE);
  if (n == 0) fail("the mesh '" + std::string(mesh_) + "' has no nodes");
  coordinates_.resize(n * space_);
  check(med_.meshNodeCoordinateRd(file_, mesh_, step_, iteration_, MED_FULL_INTERLACE, coordinates_.data()), "nodes");
}

void MedReader::read_elements() {
  for (const Kind& kind : unread)
    if (count(MED_CELL, kind.med, MED_CONNECTIVITY) > 0)
      fail(std::string("elements ") + kind.name + " are not supported");
  const auto nodes = static_cast<med_int>(coordinates_.size() / space_);
  for (const Kind& kind : kinds) {
    const std::size_t n = count(MED_CELL, kind.med, MED_CONNECTIVITY);
    if (n == 0) continue;
    Elements read{&kind, std::vector<med_int>(n * static_cast<std::size_t>(kind.nodes)), std::vector<med_int>(n)};
    check(med_.meshElementConnectivityRd(file_, mesh_, step_, iteration_, MED_CELL, kind.med, MED_NODAL,
                                         MED_FULL_INTERLACE, read.nodes.data()),
          "elements");
    for (std::size_t i = 0; i < read.nodes.size(); ++i)
      if (read.nodes[i] < 1 || read.nodes[i] > nodes)
        fail("element " + std::to_string(i / static_cast<std::size_t>(kind.nodes) + 1) + " of kind " + kind.name +
             " names node " + std::to_string(read.nodes[i]) + " of " + std::to_string(nodes));
    const std::size_t numbered = count(MED_CELL, kind.med, MED_FAMILY_NUMBER);
    if (numbered > 0 && numbered != n) fail(std::string("elements ") + kind.name + " have another number of families");
    if (numbered == n)
      check(med_.meshEntityFamilyNumberRd(file_, mesh_, step_, iteration_, MED_CELL, kind.med, read.families.data()),
            "families");
    elements_.push_back(std::move(read));
  }
}

void MedReader::read_groups() {
  const med_int families = med_.nFamily(file_, mesh_);
  check(families, "families");
  for (int i = 1; i <= families; ++i) {
    const med_int n = med_.nFamilyGroup(file_, mesh_, i);
    check(n, "groups");
    std::string text(static_cast<std::size_t>(n) * MED_LNAME_SIZE + 1, '\0');
    char name[MED_NAME_SIZE + 1] = {};
    med_int number = 0;
    check(med_.familyInfo(file_, mesh_, i, name, &number, text.data()), "groups");
    for (med_int k = 0; k < n; ++k) {
      std::string group = text.substr(static_cast<std::size_t>(k) * MED_LNAME_SIZE, MED_LNAME_SIZE);
      group.resize(std::min(group.find('\0'), group.size()));
      group.resize(group.find_last_not_of(' ') + 1);
      std::replace_if(
          group.begin(), group.end(), [](unsigned char c) { return c < ' '; }, '_');
      groups_[number].push_back(group);
    }
  }
}

void MedReader::number_families(int dimension, std::string_view before) {
  std::set<med_int> used;
  for (const Elements& each : elements_)
    if (each.kind->dimension == dimension) used.insert(each.families.begin(), each.families.end());
  std::int32_t last = 0;
  std::vector<med_int> others;
  for (auto number = used.rbegin(); number != used.rend(); ++number) {  // from 0 downward, as programs count them
    if (*number == 0) continue;
    Family& family = families_[{dimension, *number}];
    bool numbered = false;
    for (const std::string& group : groups_[*number])
      if (!numbered && reference_in(group, before, family.ref))
        numbered = true, last = std::max(last, family.ref);
      else
        family.name.append(family.name.empty() ? "" : "+").append(group);
    if (!numbered) others.push_back(*number);
  }
  for (const med_int number : others) families_[{dimension, number}].ref = ++last;
}

std::string MedReader::run() {
  choose_mesh();
  read_nodes();
  read_elements();
  read_groups();
  for (const auto& [dimension, before] : {std::pair{1, "curve_"}, {2, "face_"}, {3, "solid_"}})
    number_families(dimension, before);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", names;
  std::size_t named = 0, elements = 0;
  for (const auto& [key, family] : families_)
    if (!family.name.empty())
      ++named, names += std::to_string(key.first) + " " + std::to_string(family.ref) + " \"" + family.name + "\"\n";
  text += "$PhysicalNames\n" + std::to_string(named) + "\n" + names + "$EndPhysicalNames\n$Nodes\n" +
          std::to_string(coordinates_.size() / space_) + "\n";
  for (std::size_t i = 0; i < coordinates_.size() / space_; ++i) {
    append(text, i + 1);
    for (std::size_t k = 0; k < 3; ++k) append(text, k < space_ ? coordinates_[i * space_ + k] : 0.);
    text.back() = '\n';
  }
  for (const Elements& each : elements_) elements += each.families.size();
  text += "$EndNodes\n$Elements\n" + std::to_string(elements) + "\n";
  std::size_t number = 0;
  for (const Elements& each : elements_)
    for (std::size_t i = 0; i < each.families.size(); ++i) {
      const auto family = families_.find({each.kind->dimension, each.families[i]});
      const std::int32_t ref = family == families_.end() ? 0 : family->second.ref;
      append(text, ++number), append(text, each.kind->gmsh), append(text, 2), append(text, ref), append(text, ref);
      for (std::size_t k = 0; k < gmsh_nodes(each.kind->gmsh); ++k)
        append(
            text,
            each.nodes[i * static_cast<std::size_t>(each.kind->nodes) + static_cast<std::size_t>(each.kind->order[k])]);
      text.back() = '\n';
    }
  return text + "$EndElements\n";
}

}  // namespace

std::string med_as_gmsh(const std::string& path) { return MedReader(path).run(); }

}  // namespace command
