// SPDX-License-Identifier: BSD-3-Clause
#include "vtu_pieces.h"

#include <cstring>
#include <sstream>
#include <string_view>
#include <utility>

namespace carreau_mpi {

namespace {

// vtkDataSetAttributes::DUPLICATECELL and DUPLICATEPOINT.
constexpr std::uint8_t duplicate = 1;
constexpr std::uint8_t vtk_triangle = 5;

std::uint8_t vtk_cell(std::int32_t kind) {
  switch (kind) {
    case CARREAU_CELL_TRIANGLE6:
      return 22;
    case CARREAU_CELL_QUAD4:
      return 9;
    case CARREAU_CELL_QUAD8:
      return 23;
    default:
      return vtk_triangle;
  }
}

constexpr const char* file_attributes =
    R"(version="1.0" byte_order="LittleEndian" header_type="UInt64")";

/// The arrays of a file: their declarations in the header, and their bytes behind.
class Arrays {
 public:
  /// `bytes`: that there will be.
  explicit Arrays(std::size_t bytes) { bytes_.reserve(bytes); }

  /// An element <DataArray> of `values`.
  template <typename T>
  void add(std::string_view type, std::string_view name, int components, const std::vector<T>& values) {
    text_ << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
          << "\" format=\"appended\" offset=\"" << bytes_.size() << "\"/>\n";
    append(std::uint64_t{values.size() * sizeof(T)});
    for (const T value : values) append(value);
  }
  void line(std::string_view text) { text_ << text << "\n"; }

  /// The whole file, one string behind the other.
  [[nodiscard]] std::vector<std::string> file() && {
    return {text_.str() + "<AppendedData encoding=\"raw\">\n_", std::move(bytes_), "\n</AppendedData>\n</VTKFile>\n"};
  }

 private:
  template <typename T>
  void append(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }

  std::ostringstream text_;
  std::string bytes_;
};

std::vector<std::uint8_t> ghosts(const std::vector<std::int32_t>& owners, int rank) {
  std::vector<std::uint8_t> types;
  for (const std::int32_t owner : owners) types.push_back(owner == rank ? 0 : duplicate);
  return types;
}

/// Cells of VTK and their data.
struct Cells {
  std::vector<std::int64_t> nodes, ends, number;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> owner, ref;

  void add(std::uint8_t type, const std::int32_t* first, std::size_t n, std::size_t triangle, const ListedPart& listed) {
    nodes.insert(nodes.end(), first, first + n);
    ends.push_back(static_cast<std::int64_t>(nodes.size()));
    types.push_back(type);
    number.push_back(listed.part.triangle[triangle]);
    owner.push_back(listed.part.triangle_owner[triangle]), ref.push_back(listed.refs[triangle]);
  }
};

Cells cells_of(const ListedPart& listed) {
  Cells cells;
  for (const ListedPart::Element& element : listed.elements)
    cells.add(vtk_cell(element.kind), element.nodes.data(), element.nodes.size(), element.triangle, listed);
  for (std::size_t t = 0; t < listed.part.corners.size() && listed.elements.empty(); ++t)
    cells.add(vtk_triangle, listed.part.corners[t].data(), 3, t, listed);
  return cells;
}

/// The arrays of all pieces, as the master file declares them.
constexpr const char* declared_arrays =
    "<PPointData GlobalIds=\"GlobalPointIds\">\n"
    "<PDataArray type=\"Int64\" Name=\"GlobalPointIds\"/>\n"
    "<PDataArray type=\"UInt8\" Name=\"vtkGhostType\"/>\n"
    "<PDataArray type=\"Int32\" Name=\"owner\"/>\n"
    "</PPointData>\n"
    "<PCellData GlobalIds=\"GlobalElementIds\">\n"
    "<PDataArray type=\"Int64\" Name=\"GlobalElementIds\"/>\n"
    "<PDataArray type=\"UInt8\" Name=\"vtkGhostType\"/>\n"
    "<PDataArray type=\"Int32\" Name=\"reference\"/>\n"
    "<PDataArray type=\"Int32\" Name=\"owner\"/>\n"
    "</PCellData>\n"
    "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n";

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return text;
}

}  // namespace

std::vector<std::string> vtu_of_part(const ListedPart& listed, int rank) {
  const carreau_part& part = listed.part;
  const Cells cells = cells_of(listed);
  constexpr std::size_t of_vertex = 8 + 1 + 4 + 24, of_triangle = 8 + 1 + 4 + 4 + 24 + 8 + 1, of_lengths = 11 * 8;
  Arrays arrays(of_vertex * part.vertex.size() + of_triangle * part.triangle.size() + of_lengths);
  arrays.line("<?xml version=\"1.0\"?>");
  arrays.line("<VTKFile type=\"UnstructuredGrid\" " + std::string(file_attributes) + ">");
  arrays.line("<UnstructuredGrid>");
  arrays.line("<Piece NumberOfPoints=\"" + std::to_string(part.vertex.size()) + "\" NumberOfCells=\"" +
              std::to_string(cells.types.size()) + "\">");
  arrays.line("<PointData GlobalIds=\"GlobalPointIds\">");
  arrays.add("Int64", "GlobalPointIds", 1, part.vertex);
  arrays.add("UInt8", "vtkGhostType", 1, ghosts(part.vertex_owner, rank));
  arrays.add("Int32", "owner", 1, part.vertex_owner);
  arrays.line("</PointData>");
  arrays.line("<CellData GlobalIds=\"GlobalElementIds\">");
  arrays.add("Int64", "GlobalElementIds", 1, cells.number);
  arrays.add("UInt8", "vtkGhostType", 1, ghosts(cells.owner, rank));
  arrays.add("Int32", "reference", 1, cells.ref);
  arrays.add("Int32", "owner", 1, cells.owner);
  arrays.line("</CellData>");
  arrays.line("<Points>");
  arrays.add("Float64", "Points", 3, listed.xyz);
  arrays.line("</Points>");
  arrays.line("<Cells>");
  arrays.add("Int64", "connectivity", 1, cells.nodes);
  arrays.add("Int64", "offsets", 1, cells.ends);
  arrays.add("UInt8", "types", 1, cells.types);
  arrays.line("</Cells>");
  arrays.line("</Piece>");
  arrays.line("</UnstructuredGrid>");
  return std::move(arrays).file();
}

std::string name_of_piece(const std::string& path, int rank) {
  return path.substr(0, path.find_last_of('.')) + "_" + std::to_string(rank) + ".vtu";
}

std::string pvtu_text(const std::string& path, int size) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" " + std::string(file_attributes) +
                     ">\n<PUnstructuredGrid GhostLevel=\"1\">\n" + declared_arrays;
  for (int r = 0; r < size; ++r) {
    const std::string piece = name_of_piece(path, r);
    text += "<Piece Source=\"" + escaped(piece.substr(piece.find_last_of('/') + 1)) + "\"/>\n";
  }
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace carreau_mpi
