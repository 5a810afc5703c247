// SPDX-License-Identifier: BSD-3-Clause
#include "surface/assembly/assembly.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace carreau {

namespace {

constexpr std::int32_t unknown = -1;

class Assembler {
 public:
  Assembler(const Model& model, const Topology& topology, const RefinedDomains& domains,
            const std::vector<DiscreteCurve>& curves, const std::vector<char>& has_patch, CompositeResult& result)
      : model_(model),
        topology_(topology),
        domains_(domains),
        curves_(curves),
        has_patch_(has_patch),
        mesh_(result.mesh),
        sizes_(result.vertex_size) {}

  std::vector<std::vector<std::int32_t>> run(std::vector<std::optional<PatchMesh>>& patches) {
    flattened_.resize(patches.size());
    corner_vertex_.assign(topology_.points.size(), unknown);
    add_curves();
    is_only_ = std::count_if(patches.begin(), patches.end(), [](const auto& patch) { return patch.has_value(); }) == 1;
    if (!is_only_) reserve(patches);
    for (std::size_t f = 0; f < patches.size(); ++f) {
      add_face(f, patches[f]);
      patches[f].reset();
    }
    return std::move(flattened_);
  }

 private:
  // Reserves room for the vertices within faces: arrays that grow by doubling would be the largest of the whole run.
  void reserve(const std::vector<std::optional<PatchMesh>>& patches) {
    std::size_t n = mesh_.vertices.size();
    for (std::size_t f = 0; f < patches.size(); ++f)
      if (patches[f]) n += patches[f]->plane.vertices.size() - domains_.domain[f]->origin.size();
    mesh_.vertices.reserve(n);
    mesh_.vertex_ref.reserve(n);
    sizes_.reserve(n);
  }

  std::int32_t add_vertex(Vec3 position, int ref, double size) {
    mesh_.vertices.push_back(position);
    mesh_.vertex_ref.push_back(ref);
    sizes_.push_back(size);
    return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
  }

  std::int32_t corner(int point, double size) {
    std::int32_t& vertex = corner_vertex_[point];
    if (vertex == unknown) vertex = add_vertex(topology_.points[point].position, topology_.points[point].ref, size);
    sizes_[vertex] = std::min(sizes_[vertex], size);
    return vertex;
  }

  // Corners come first, in the order of the model. A point becomes a vertex only if a meshed face or a wire holds it.
  void add_curves() {
    const auto is_of_wire = [&](const CurveUse& use) {
      return model_.faces[use.face].is_wire() && model_.faces[use.face].left_out.empty();
    };
    const auto is_used = [&](const Curve& curve) {
      return std::any_of(curve.uses.begin(), curve.uses.end(),
                         [&](const CurveUse& use) { return has_patch_[use.face] != 0 || is_of_wire(use); });
    };
    for (std::size_t c = 0; c < topology_.curves.size(); ++c) {
      const Curve& shape = topology_.curves[c];
      if (!is_used(shape)) continue;
      corner(shape.end1, curves_[c].size.front());
      corner(shape.end2, curves_[c].size.back());
    }
    for (std::size_t c = 0; c < topology_.curves.size(); ++c) {
      const Curve& shape = topology_.curves[c];
      CurveMesh curve{.ref = shape.ref, .vertices = {}, .uses = {}};
      if (!shape.uses.empty())
        curve.part_of = model_.faces[shape.uses.front().face].curves[shape.uses.front().curve].shown_as;
      for (const CurveUse& use : shape.uses)
        curve.uses.push_back({use.face, model_.faces[use.face].curves[use.curve].type == CurveType::internal});
      curve.loose = is_used(shape) && std::none_of(shape.uses.begin(), shape.uses.end(),
                                                   [&](const CurveUse& use) { return has_patch_[use.face] != 0; });
      if (is_used(shape)) {
        curve.vertices.push_back(corner_vertex_[shape.end1]);
        if (!shape.degenerate) {
          for (std::size_t i = 1; i + 1 < curves_[c].xyz.size(); ++i)
            curve.vertices.push_back(add_vertex(curves_[c].xyz[i], 0, curves_[c].size[i]));
          curve.vertices.push_back(corner_vertex_[shape.end2]);
        }
      }
      mesh_.curves.push_back(std::move(curve));
    }
  }

  std::int32_t imposed_vertex(std::size_t f, const FaceDomain& domain, const PatchMesh& patch, std::size_t local) {
    const DomainVertexOrigin& origin = domain.origin[local];
    if (origin.corner >= 0) return corner_vertex_[origin.corner];
    if (origin.curve >= 0) return mesh_.curves[origin.curve].vertices[origin.node];
    return add_vertex(patch.xyz[local], model_.faces[f].points[origin.point].ref, patch.size[local]);
  }

  void add_face(std::size_t f, std::optional<PatchMesh>& patch) {
    FaceMesh& face = mesh_.faces[f];
    if (has_patch_[f] == 0) return;
    face.status = FaceStatus::meshed;  // refined curves are normal work
    if (!patch) return;
    const FaceDomain& domain = *domains_.domain[f];
    add_vertices(f, domain, *patch, face.vertex);
    face.uv = std::move(patch->plane.vertices);
    face.triangles = std::move(patch->plane.triangles);
    leave_out_flat(face, flattened_[f]);
  }

  // Vertices inside the face have consecutive numbers.
  void add_vertices(std::size_t f, const FaceDomain& domain, PatchMesh& patch, std::vector<std::int32_t>& vertex) {
    const std::size_t given = domain.origin.size();
    vertex.resize(patch.xyz.size());
    for (std::size_t v = 0; v < given; ++v) vertex[v] = imposed_vertex(f, domain, patch, v);
    std::iota(vertex.begin() + static_cast<std::ptrdiff_t>(given), vertex.end(), static_cast<std::int32_t>(mesh_.vertices.size()));
    put_after(mesh_.vertices, given, patch.xyz);
    put_after(sizes_, given, patch.size);
    mesh_.vertex_ref.resize(mesh_.vertices.size(), 0);
  }

  // Appends the values from `given` on. The array of the only patch becomes the array of the mesh, without a copy of most values.
  template <typename T>
  void put_after(std::vector<T>& all, std::size_t given, std::vector<T>& of_patch) const {
    if (!is_only_ || all.size() > given) {
      all.insert(all.end(), of_patch.begin() + static_cast<std::ptrdiff_t>(given), of_patch.end());
      return;
    }
    const auto spare = static_cast<std::ptrdiff_t>(given - all.size());
    std::copy(all.begin(), all.end(), of_patch.begin() + spare);
    of_patch.erase(of_patch.begin(), of_patch.begin() + spare);
    all = std::move(of_patch);
  }

  static void leave_out_flat(FaceMesh& face, std::vector<std::int32_t>& numbers) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < face.triangles.size(); ++k) {
      const std::array<std::int32_t, 3> t = face.triangles[k];
      const std::int32_t a = face.vertex[t[0]], b = face.vertex[t[1]], c = face.vertex[t[2]];
      if (a == b || b == c || c == a) {
        face.flattened.push_back(t);
        numbers.push_back(static_cast<std::int32_t>(k));
      } else {
        if (kept != k) face.triangles[kept] = t;
        ++kept;
      }
    }
    face.triangles.resize(kept);
  }

  const Model& model_;
  const Topology& topology_;
  const RefinedDomains& domains_;
  const std::vector<DiscreteCurve>& curves_;
  const std::vector<char>& has_patch_;
  SurfaceMesh& mesh_;
  std::vector<double>& sizes_;
  std::vector<std::int32_t> corner_vertex_;
  bool is_only_ = false;  // there is one patch
  std::vector<std::vector<std::int32_t>> flattened_;  // by face: numbers in the patch
};

}  // namespace

std::vector<std::vector<std::int32_t>> assemble(const Model& model, const Topology& topology, const RefinedDomains& domains,
                                                const std::vector<DiscreteCurve>& curves, const std::vector<char>& has_patch,
                                                std::vector<std::optional<PatchMesh>>& patches, CompositeResult& result) {
  return Assembler(model, topology, domains, curves, has_patch, result).run(patches);
}

}  // namespace carreau
