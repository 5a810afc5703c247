// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose edges are swapped, split and collapsed and whose vertices are moved; each edit can be undone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/plane_mesh.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// Triangles of a mesh in space whose corners are vertices of faces with their (u, v). Holds references to the host's
/// arrays, and updates the adjacency. Orientation is decided in (u, v), exactly. Edges of curves and imposed ones are
/// never swapped or split; vertices that are kept neither move nor go.
///
/// A vertex is an index in the list of positions. A vertex of a face (`Vertex`: face and local index) has one (u, v); a
/// vertex of space on a curve, a seam or at a pole is several vertices of faces.
class EditableMesh {
 public:
  using Triangle = std::array<std::int32_t, 3>;
  /// The part of the mesh in one face. Arrays outlive the EditableMesh, and only it changes their sizes.
  struct Face {
    std::vector<Vec2>* uv;                        ///< of local vertices
    std::vector<Triangle>* triangles;             ///< local vertices
    std::vector<std::int32_t>* vertex = nullptr;  ///< local vertex -> vertex; null: equal numbers
    /// By triangle. Null: edits stay inside the face. Else (several faces in one list, whose borders do not count)
    /// edges between triangles with different local vertices may be edited, too. Triangles whose corners have no common
    /// (u, v) afterwards are marked. They are compared in space: they must not turn over against the triangles that
    /// they replace.
    std::vector<char>* mixed = nullptr;
  };
  struct Place {
    std::int32_t face, triangle;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct Vertex {
    std::int32_t face, local;
    friend auto operator<=>(const Vertex&, const Vertex&) = default;
  };
  /// Two triangles of a face on the edge from a to b: t with c on its left, u with d on its right. Local vertices.
  struct Quad {
    std::int32_t face, t, u, a, b, c, d;
    bool mixed = false;  ///< u has other local vertices for a and b

    [[nodiscard]] std::array<Place, 2> places() const noexcept { return {Place{face, t}, Place{face, u}}; }
  };
  /// The part of a split triangle that keeps its number; the other one is the last of its face.
  enum class Split {
    at_a,     ///< of both triangles that with the corner a of the edge
    at_start  ///< that with the corner at which the edge starts in the triangle: a in one, b in the other
  };

  /// Knows the triangles around `centres` and around their neighbours, `rings` times, over all faces. Vertices of
  /// curves, imposed points, and corners of triangles that are flat in space (FaceMesh::flattened) are kept.
  EditableMesh(SurfaceMesh& mesh, std::span<const std::int32_t> centres, int rings);
  /// A patch in the plane, lifted to `xyz`. Vertices of the domain are kept, its edges imposed.
  EditableMesh(const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz);
  /// For some triangles: the mesh ends at them.
  EditableMesh(const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz,
               std::span<const std::int32_t> triangles);
  /// All triangles of `faces`. `imposed`: edges; their vertices are kept, except in collapses along them. Vertices at
  /// which more or fewer than two imposed edges meet are kept always, as are `corners`.
  EditableMesh(std::vector<Face> faces, std::vector<Vec3>& xyz, std::span<const std::array<std::int32_t, 2>> imposed,
               std::span<const std::int32_t> corners);

  [[nodiscard]] const Triangle& at(Place p) const { return (*faces_[p.face].triangles)[p.triangle]; }
  [[nodiscard]] std::int32_t global(std::int32_t face, std::int32_t local) const {
    const auto* vertex = faces_[face].vertex;
    return vertex == nullptr ? local : (*vertex)[local];
  }
  [[nodiscard]] std::int32_t global(Vertex v) const { return global(v.face, v.local); }
  [[nodiscard]] Vec2 uv(Vertex v) const { return (*faces_[v.face].uv)[v.local]; }
  [[nodiscard]] Vec3 position(std::int32_t face, std::int32_t local) const { return (*xyz_)[global(face, local)]; }

  /// True if all triangles around v are known.
  [[nodiscard]] bool is_known(std::int32_t v) const { return rank_[v] >= 0; }
  /// Triangles around v, in an order that depends on the edits alone.
  [[nodiscard]] const std::vector<Place>& fan(std::int32_t v) const { return stars_[rank_[v]].fan; }
  /// Vertices around v, each once, in increasing order.
  [[nodiscard]] std::vector<std::int32_t> ring(std::int32_t v) const;
  /// Like ring(), with v at the end.
  [[nodiscard]] std::vector<std::int32_t> with_ring(std::int32_t v) const;
  /// Rank of the vertex v among the corners of a triangle.
  [[nodiscard]] int rank_in(Place p, std::int32_t v) const;
  /// The vertex of a face that v is, if it is not kept and all around its neighbours is known.
  [[nodiscard]] std::optional<Vertex> inside(std::int32_t v) const;
  /// True if the edge is an edge of a curve, or imposed.
  [[nodiscard]] bool is_imposed(std::int32_t v, std::int32_t w) const;
  /// Other ends of imposed edges.
  [[nodiscard]] const std::vector<std::int32_t>& imposed_around(std::int32_t v) const { return star(v).imposed; }
  /// True if no edit removes or moves it.
  [[nodiscard]] bool is_corner(std::int32_t v) const { return kept_[v] == Kept::always; }
  /// On side `side` of a triangle, if that is not imposed, has two triangles in the face, and the four vertices are
  /// known.
  [[nodiscard]] std::optional<Quad> quad(Place p, int side) const;
  /// Like quad(), on the edge from a to the local vertex b of its face.
  [[nodiscard]] std::optional<Quad> quad_between(Vertex a, std::int32_t b) const;
  /// The vertices a, b, c, d.
  [[nodiscard]] std::array<std::int32_t, 4> corners(const Quad& q) const;

  /// Not of unit length.
  [[nodiscard]] Vec3 normal(Place p) const { return normal(p.face, at(p)); }
  [[nodiscard]] Vec3 normal(std::int32_t face, const Triangle& t) const;
  /// The unit normal, weighted by areas, or zero.
  [[nodiscard]] Vec3 mean_normal(std::span<const Place> places) const;
  /// Counterclockwise in (u, v), exactly.
  [[nodiscard]] bool is_positive(std::int32_t face, const Triangle& t) const;

  /// The two triangles of the other diagonal: {a, d, c}, which takes the number of t, and {d, b, c}, which takes the
  /// number of u.
  [[nodiscard]] static std::array<Triangle, 2> swapped(const Quad& q) noexcept {
    return {Triangle{q.a, q.d, q.c}, Triangle{q.d, q.b, q.c}};
  }
  /// Both would be counterclockwise, and the new edge exists nowhere.
  [[nodiscard]] bool can_swap(const Quad& q) const;
  /// Exchanges the diagonal. If it cannot, returns false and changes nothing.
  bool swap(const Quad& q);

  /// True if all four triangles would be counterclockwise with a new vertex there. Never if one is mixed.
  [[nodiscard]] bool can_split(const Quad& q, const Vec2& uv) const;
  /// A new vertex on the edge, which is the last one of its face and of all. Tests nothing; parts of mixed triangles are
  /// mixed.
  Vertex split(const Quad& q, const Vec2& uv, const Vec3& xyz, Split keeps = Split::at_a);

  /// True if all triangles around stay counterclockwise when a vertex moves there.
  [[nodiscard]] bool can_move(Vertex v, const Vec2& uv) const;
  /// Tests nothing.
  void move(Vertex v, const Vec2& uv, const Vec3& xyz);

  /// True if `gone` can merge with its neighbour `kept`. Topology must stay (the link condition: Dey, Edelsbrunner,
  /// Guha, Nekhayev 1999), and triangles must stay counterclockwise. The edge between the two is the only imposed edge
  /// that may vanish, if its line is straight at `gone`.
  [[nodiscard]] bool can_collapse(std::int32_t gone, std::int32_t kept) const;
  /// If it cannot, returns false and changes nothing. Triangles that go, and the vertex, keep their numbers (the
  /// corners of such triangles are -1) until compact().
  bool collapse(std::int32_t gone, std::int32_t kept);
  /// After the last edit: removes the rests of collapses. The result updates the host's lists by vertex: the new number
  /// of each vertex, -1 if it was removed. Order stays. Nothing can be undone or edited after it.
  std::vector<std::int32_t> compact();

  /// The number of edits so far that are not undone.
  [[nodiscard]] std::size_t edits() const noexcept { return edits_.size(); }
  /// Undoes edits until `edits` are left: the mesh is identical to the mesh after these.
  bool undo(std::size_t edits);

  // For Trial.
  using State = std::size_t;
  [[nodiscard]] State state() const noexcept { return edits(); }
  static void begin_trial() noexcept {}
  static void end_trial() noexcept {}

 private:
  struct Star {
    std::vector<Place> fan;
    std::vector<std::int32_t> imposed;  // other ends of imposed edges
  };
  enum class Kept : char { no, on_line, always };
  struct Before {
    Place place;
    Triangle triangle;
    char mixed;
  };
  struct LineChange {
    std::int32_t v, w;
    bool added;
  };
  struct Edit {
    std::size_t first_before, first_line_change;
    int new_triangles = 0;  // the last ones of the face of `vertex`
    bool new_vertex = false, moved = false;
    Vertex vertex{};
    std::int32_t gone = -1;  // collapsed
    Vec2 uv{0, 0};
    Vec3 xyz{0, 0, 0};  // as they were
  };
  /// For each local vertex of the removed vertex, the replacing local vertex.
  using Replacements = std::vector<std::pair<Vertex, std::int32_t>>;
  struct Replaced {
    Place place;
    Triangle triangle;
    bool mixed;
  };

  [[nodiscard]] Star& star(std::int32_t v) { return stars_[rank_[v]]; }
  [[nodiscard]] const Star& star(std::int32_t v) const { return stars_[rank_[v]]; }
  template <typename Use>
  void for_triangles(const Use& use) const;
  void mark_curves();
  void know_around(std::span<const std::int32_t> centres, int rings);
  void know_all();
  void impose(const PlaneDomain& domain);
  void impose(std::int32_t v, std::int32_t w);
  void release(std::int32_t v, std::int32_t w);
  [[nodiscard]] bool is_mixed(Place p) const;
  [[nodiscard]] bool is_sound(std::int32_t face, const Triangle& t, bool mixed, const Vec3& replaced) const;

  Edit& begin_edit();
  void put(Place p, const Triangle& t);
  void replace(Place p, const Triangle& t, bool mixed);
  void add(std::int32_t face, const Triangle& t, bool mixed);
  void change_line(std::int32_t v, std::int32_t w, bool added);
  void undo_last();

  [[nodiscard]] int triangles_on(std::int32_t v, std::int32_t w) const;
  [[nodiscard]] bool keeps_topology(std::int32_t gone, std::int32_t kept) const;
  [[nodiscard]] bool keeps_lines(std::int32_t gone, std::int32_t kept) const;
  [[nodiscard]] Replacements replacements(std::int32_t gone, std::int32_t kept) const;
  /// The triangles around after the collapse; none if one would be invalid.
  [[nodiscard]] std::optional<std::vector<Replaced>> collapsed(std::int32_t gone, std::int32_t kept) const;
  /// Like collapsed(); none if anything forbids the collapse.
  [[nodiscard]] std::optional<std::vector<Replaced>> what_collapses(std::int32_t gone, std::int32_t kept) const;
  void compact_face(std::int32_t face, const std::vector<std::int32_t>& number);

  SurfaceMesh* mesh_ = nullptr;  // if it is one
  std::vector<Face> faces_;
  std::vector<Vec3>* xyz_;
  std::vector<Kept> kept_;          // by vertex
  std::vector<std::int32_t> rank_;  // by vertex: index in stars_, -1: not known
  std::vector<Star> stars_;
  std::vector<Edit> edits_;
  std::vector<Before> before_;            // triangles changed by edits, as they were
  std::vector<LineChange> line_changes_;  // imposed edges changed by edits
};

}  // namespace carreau
