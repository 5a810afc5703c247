// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/vtk_output.h"

#include <limits>

#include "io/element_words.h"
#include "io/mesh_writers.h"

namespace carreau {

namespace {

std::uint8_t vtk_type(CellKind kind) noexcept { return by_kind<std::uint8_t>(kind, 5, 22, 9, 23); }

}  // namespace

VtkOutput::VtkOutput(const FlatMesh& mesh) : mesh_(mesh) {
  std::int32_t t = 0;
  for (const Cell& cell : mesh.cells) {
    first_.push_back(t);
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
  if (mesh.cells.empty())
    for (; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) first_.push_back(t);
}

std::uint8_t VtkOutput::type(std::size_t cell) const noexcept {
  constexpr std::uint8_t line = 3, quadratic_edge = 21;
  if (cell >= elements()) return mesh_.edge_mids.empty() ? line : quadratic_edge;
  return vtk_type(mesh_.cells.empty() ? CellKind::triangle3 : mesh_.cells[cell].kind);
}

std::int32_t VtkOutput::ref(std::size_t cell) const noexcept {
  return cell >= elements() ? ref_of(mesh_.edge_refs, cell - elements())
                            : ref_of(mesh_.triangle_refs, static_cast<std::size_t>(first_[cell]));
}

void VtkOutput::append_nodes(std::size_t cell, std::vector<std::int32_t>& nodes) const {
  if (cell >= elements()) {
    const std::size_t e = cell - elements();
    nodes.insert(nodes.end(), mesh_.edges[e].begin(), mesh_.edges[e].end());
    if (!mesh_.edge_mids.empty()) nodes.push_back(mesh_.edge_mids[e]);
  } else if (mesh_.cells.empty()) {
    nodes.insert(nodes.end(), mesh_.triangles[cell].begin(), mesh_.triangles[cell].end());
  } else {
    const Cell& element = mesh_.cells[cell];
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.begin() + node_count(element.kind));
  }
}

std::vector<double> VtkOutput::values(const MeshField& field) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto components = static_cast<std::size_t>(field.components);
  std::vector<double> result;
  result.reserve(size() * components);
  for (std::size_t c = 0; c < elements() && !field.values.empty(); ++c) {
    const bool halves = !mesh_.cells.empty() && corner_count(mesh_.cells[c].kind) == 4;
    for (std::size_t k = 0; k < components; ++k) {
      const std::size_t at = static_cast<std::size_t>(first_[c]) * components + k;
      result.push_back(halves ? 0.5 * (field.values[at] + field.values[at + components]) : field.values[at]);
    }
  }
  result.resize(elements() * components, none);
  result.insert(result.end(), field.edge_values.begin(), field.edge_values.end());
  result.resize(size() * components, none);
  return result;
}

}  // namespace carreau
