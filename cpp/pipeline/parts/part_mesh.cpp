// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/part_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "pipeline/parts/part_quality.h"
#include "pipeline/parts/shares.h"
#include "pipeline/parts/shown_triangles.h"

namespace carreau {

namespace {

constexpr std::int32_t not_here = -1;

/// True by vertex of curves if faces of two processes meet there.
std::vector<bool> vertices_between_parts(const SurfaceMesh& mesh, const MeshShares& shares) {
  std::vector<int> one(static_cast<std::size_t>(shares.on_curves), -1);
  std::vector<bool> between(one.size(), false);
  for (const CurveMesh& curve : mesh.curves)
    for (const CurveMeshUse& use : curve.uses) {
      const int rank = shares.of_face[static_cast<std::size_t>(use.face)].rank;
      if (rank < 0) continue;
      for (const std::int32_t v : curve.vertices) {
        int& known = one[static_cast<std::size_t>(v)];
        if (known >= 0 && known != rank) between[static_cast<std::size_t>(v)] = true;
        known = rank;
      }
    }
  return between;
}

/// Numbers of vertices, consecutive for each process; vertices on curves come first.
class Rows {
 public:
  Rows(const std::vector<int>& owner_on_curves, const MeshShares& shares) : of_curve_(owner_on_curves.size()), of_face_(shares.of_face.size()) {
    std::vector<std::int64_t> next(static_cast<std::size_t>(shares.processes) + 1, 0);
    for (const int owner : owner_on_curves) ++next[static_cast<std::size_t>(owner) + 1];
    for (const FaceShare& share : shares.of_face)
      if (share.rank >= 0) next[static_cast<std::size_t>(share.rank) + 1] += share.vertices;
    for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
    for (std::size_t v = 0; v < of_curve_.size(); ++v) of_curve_[v] = next[static_cast<std::size_t>(owner_on_curves[v])]++;
    for (std::size_t f = 0; f < of_face_.size(); ++f)
      if (const FaceShare& share = shares.of_face[f]; share.rank >= 0)
        of_face_[f] = std::exchange(next[static_cast<std::size_t>(share.rank)], next[static_cast<std::size_t>(share.rank)] + share.vertices);
  }
  [[nodiscard]] std::int64_t on_curve(std::size_t vertex) const { return of_curve_[vertex]; }
  /// Number of the first vertex inside a face.
  [[nodiscard]] std::int64_t of_face(std::size_t face) const { return of_face_[face]; }

 private:
  std::vector<std::int64_t> of_curve_, of_face_;
};

class PartMaker {
 public:
  PartMaker(Team& team, SurfaceMesh mesh, const MeshShares& shares)
      : team_(team), mesh_(std::move(mesh)), shares_(shares), owner_(owners_on_curves(mesh_, shares)), rows_(owner_, shares) {
    part_.rank = shares.rank, part_.processes = shares.processes;
    part_.vertices = shares.vertices, part_.triangles = shares.triangles;
    part_.curve_edges = static_cast<std::int64_t>(mesh_.edge_count());
    part_.loose_edges = static_cast<std::int64_t>(mesh_.loose_edge_count());
  }

  PartMesh make(bool all_edges) {
    count_faces();
    collect_edges(all_edges);
    const std::vector<ShownTriangle> ghosts = receive_ghosts();
    place_own_vertices();
    place_other_vertices(ghosts);
    add_own_triangles();
    for (const ShownTriangle& ghost : ghosts) add_ghost(ghost);
    add_edges();
    return std::move(part_);
  }

 private:
  void count_faces() {
    part_.faces = whole_faces(mesh_);
    std::map<int, std::int64_t> triangles;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) triangles[mesh_.faces[f].shown_ref()] += shares_.of_face[f].triangles;
    for (WholeFace& face : part_.faces) face.triangles = static_cast<std::size_t>(triangles[face.face.ref]);
  }

  void collect_edges(bool all_edges) {
    for (const CurveMesh& curve : mesh_.curves) {
      if (!all_edges && !curve.loose) continue;
      for (std::size_t i = 1; i < curve.vertices.size(); ++i, ++part_.file_edges) {
        if (shares_.rank != 0) continue;
        part_.file_edge_vertices.push_back({curve.vertices[i - 1], curve.vertices[i]});
        part_.file_edge_refs.push_back(curve.shown_ref());
      }
    }
  }

  [[nodiscard]] std::vector<TriangleOfFace> triangles_to_show() const {
    const std::vector<bool> between = vertices_between_parts(mesh_, shares_);
    std::vector<TriangleOfFace> shown;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const FaceMesh& face = mesh_.faces[f];
      for (std::size_t t = 0; t < face.triangles.size(); ++t)
        if (std::any_of(face.triangles[t].begin(), face.triangles[t].end(), [&](std::int32_t local) {
              const std::int32_t v = face.vertex[local];
              return v < shares_.on_curves && between[static_cast<std::size_t>(v)];
            }))
          shown.push_back({static_cast<std::int32_t>(f), static_cast<std::int32_t>(t)});
    }
    return shown;
  }

  /// Ascending.
  std::vector<ShownTriangle> receive_ghosts() {
    touched_.assign(static_cast<std::size_t>(shares_.on_curves), false);
    for (const FaceMesh& face : mesh_.faces)
      for (const auto& t : face.triangles)
        for (const std::int32_t local : t)
          if (face.vertex[local] < shares_.on_curves) touched_[static_cast<std::size_t>(face.vertex[local])] = true;
    std::vector<ShownTriangle> ghosts;
    team_.exchange_in_turn("ghosts", show_triangles(mesh_, shares_, triangles_to_show()), [&](int rank, const std::string& bytes) {
      if (rank == shares_.rank) return;
      for_shown_triangles(bytes, mesh_, shares_, [&](const ShownTriangle& shown) {
        const bool touches = std::any_of(shown.corners.begin(), shown.corners.end(), [&](const ShownTriangle::Corner& corner) {
          return corner.number < shares_.on_curves && touched_[static_cast<std::size_t>(corner.number)];
        });
        if (touches) ghosts.push_back(shown);
      });
    });
    std::sort(ghosts.begin(), ghosts.end(), [](const ShownTriangle& a, const ShownTriangle& b) { return a.which < b.which; });
    return ghosts;
  }

  std::int32_t add_vertex(std::int64_t number, const Vec3& xyz, std::int32_t ref, int owner, std::int64_t row) {
    part_.mesh.vertices.push_back(xyz), part_.mesh.vertex_refs.push_back(ref);
    part_.vertex_number.push_back(number), part_.vertex_owner.push_back(owner), part_.vertex_row.push_back(row);
    return static_cast<std::int32_t>(part_.mesh.vertices.size()) - 1;
  }

  void add_curve_vertex(std::size_t v) {
    here_[v] = add_vertex(static_cast<std::int64_t>(v), mesh_.vertices[v], mesh_.vertex_ref[v], owner_[v], rows_.on_curve(v));
  }

  void place_own_vertices() {
    here_.assign(mesh_.vertices.size(), not_here);
    reserve_vertices(mesh_.vertices.size());
    for (std::size_t v = 0; v < owner_.size(); ++v)
      if (owner_[v] == shares_.rank) add_curve_vertex(v);
    auto v = static_cast<std::size_t>(shares_.on_curves);
    for (std::size_t f = 0; f < shares_.of_face.size(); ++f) {
      const FaceShare& share = shares_.of_face[f];
      for (std::int64_t k = 0; share.rank == shares_.rank && k < share.vertices; ++k, ++v)
        here_[v] = add_vertex(share.first_vertex + k, mesh_.vertices[v], mesh_.vertex_ref[v], shares_.rank, rows_.of_face(f) + k);
    }
    part_.own_vertices = static_cast<std::int64_t>(part_.mesh.vertices.size());
  }

  void reserve_vertices(std::size_t n) {
    part_.mesh.vertices.reserve(n), part_.mesh.vertex_refs.reserve(n);
    part_.vertex_number.reserve(n), part_.vertex_owner.reserve(n), part_.vertex_row.reserve(n);
  }

  void place_other_vertices(const std::vector<ShownTriangle>& ghosts) {
    struct Inside {
      ShownTriangle::Corner corner;
      std::int32_t face;
    };
    std::map<std::int64_t, Inside> inside;
    for (const ShownTriangle& ghost : ghosts)
      for (const ShownTriangle::Corner& corner : ghost.corners)
        if (corner.number < shares_.on_curves)
          touched_[static_cast<std::size_t>(corner.number)] = true;
        else
          inside.try_emplace(corner.number, Inside{corner, ghost.which.face});
    if (shares_.rank == 0)
      for (const CurveMesh& curve : mesh_.curves)
        for (const std::int32_t v : curve.vertices)
          if (curve.loose) touched_[static_cast<std::size_t>(v)] = true;
    for (std::size_t v = 0; v < owner_.size(); ++v)
      if (touched_[v] && here_[v] == not_here) add_curve_vertex(v);
    for (const auto& [number, each] : inside) {
      const auto f = static_cast<std::size_t>(each.face);
      const FaceShare& share = shares_.of_face[f];
      inside_[number] = add_vertex(number, each.corner.xyz, each.corner.ref, share.rank, rows_.of_face(f) + (number - share.first_vertex));
    }
  }

  void add_triangle(const std::array<std::int32_t, 3>& corners, std::int32_t ref, std::int64_t number, int owner) {
    part_.mesh.triangles.push_back(corners), part_.mesh.triangle_refs.push_back(ref);
    part_.triangle_number.push_back(number), part_.triangle_owner.push_back(owner);
  }

  void add_own_triangles() {
    const std::size_t n = mesh_.triangle_count();
    part_.mesh.triangles.reserve(n), part_.mesh.triangle_refs.reserve(n);
    part_.triangle_number.reserve(n), part_.triangle_owner.reserve(n);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      FaceMesh& face = mesh_.faces[f];
      std::int64_t number = shares_.of_face[f].first_triangle;
      for (const auto& [a, b, c] : face.triangles)
        add_triangle({here_[face.vertex[a]], here_[face.vertex[b]], here_[face.vertex[c]]}, face.shown_ref(), number++, shares_.rank);
      std::vector<std::array<std::int32_t, 3>>().swap(face.triangles);
      std::vector<std::int32_t>().swap(face.vertex);
    }
    part_.own_triangles = static_cast<std::int64_t>(part_.mesh.triangles.size());
  }

  void add_ghost(const ShownTriangle& ghost) {
    const auto f = static_cast<std::size_t>(ghost.which.face);
    std::array<std::int32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t number = ghost.corners[k].number;
      corners[k] = number < shares_.on_curves ? here_[static_cast<std::size_t>(number)] : inside_.at(number);
    }
    add_triangle(corners, mesh_.faces[f].shown_ref(), shares_.of_face[f].first_triangle + ghost.which.local, shares_.of_face[f].rank);
  }

  // The least process that keeps a face of a curve has its edges; rank 0 has edges of no face.
  void add_edges() {
    for (const CurveMesh& curve : mesh_.curves) {
      int owner = shares_.processes;
      for (const CurveMeshUse& use : curve.uses)
        if (const int rank = shares_.of_face[static_cast<std::size_t>(use.face)].rank; rank >= 0) owner = std::min(owner, rank);
      if ((owner == shares_.processes ? 0 : owner) != shares_.rank) continue;
      for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
        part_.mesh.edges.push_back({here_[curve.vertices[i - 1]], here_[curve.vertices[i]]});
        part_.mesh.edge_refs.push_back(curve.shown_ref());
      }
    }
  }

  Team& team_;
  SurfaceMesh mesh_;
  const MeshShares& shares_;
  std::vector<int> owner_;  // of vertices on curves
  Rows rows_;
  PartMesh part_;
  std::vector<bool> touched_;                   // by vertex on curves: of a triangle in the part
  std::vector<std::int32_t> here_;              // by vertex of mesh_
  std::map<std::int64_t, std::int32_t> inside_;  // of vertices inside faces of others
};

}  // namespace

PartMesh make_part(Team& team, CompositeResult result, bool all_edges, int threads) {
  const MeshShares shares = *result.shares;
  for (FaceMesh& face : result.mesh.faces) std::vector<Vec2>().swap(face.uv);
  std::vector<double>().swap(result.vertex_size);
  const QualitySummary quality = summarise_parts(team, result.mesh, shares, threads);
  const std::int64_t crossings = result.report.crossings;
  PartMesh part = PartMaker(team, std::move(result.mesh), shares).make(all_edges);
  part.quality = quality;
  part.crossings = crossings;
  return part;
}

}  // namespace carreau
