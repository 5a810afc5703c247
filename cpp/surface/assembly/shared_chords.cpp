// SPDX-License-Identifier: BSD-3-Clause
#include "surface/assembly/shared_chords.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "mesh/editable_mesh.h"
#include "support/ranks/exchanges.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Halvings of the interval that holds the middle of a chord in space: down to a 64th. [tests/cpp/surface:
// Coarse.TwoSheetsOverOneSquareEncloseAVolume, as below]
constexpr int middle_steps = 6;
// Passes. Each one divides the remaining chords, and a division may create a new chord.
constexpr int chord_passes = 10;

using Key = std::array<std::int64_t, 2>;

// Keys of vertices of space: vertices inside faces begin here.
constexpr std::int64_t first_inside = std::int64_t{1} << 62;

using Local = std::array<std::int32_t, 2>;  // vertices of a patch, ascending
Local local_edge(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

Key ordered(std::int64_t a, std::int64_t b) { return a < b ? Key{a, b} : Key{b, a}; }

struct Chord {
  Key key;
  int face;
  Local local;
  friend auto operator<=>(const Chord&, const Chord&) = default;
};

/// A triangle by its vertices of space.
struct Corners {
  std::array<std::int64_t, 3> key;
  int face;
  std::size_t triangle;
};

void put(PacketWriter& packet, const Chord& chord) {
  for (const std::int64_t value : chord.key) packet.put(value);
  packet.put(std::int64_t{chord.face});
  for (const std::int32_t v : chord.local) packet.put(std::int64_t{v});
}
void get(PacketReader& packet, Chord& chord) {
  for (std::int64_t& value : chord.key) value = packet.integer();
  chord.face = static_cast<int>(packet.integer());
  for (std::int32_t& v : chord.local) v = static_cast<std::int32_t>(packet.integer());
}
void put(PacketWriter& packet, const Corners& corners) {
  for (const std::int64_t value : corners.key) packet.put(value);
  packet.put(std::int64_t{corners.face});
  packet.put(static_cast<std::int64_t>(corners.triangle));
}
void get(PacketReader& packet, Corners& corners) {
  for (std::int64_t& value : corners.key) value = packet.integer();
  corners.face = static_cast<int>(packet.integer());
  corners.triangle = static_cast<std::size_t>(packet.integer());
}

class Separator {
 public:
  Separator(const Model& model, const Topology& topology, const RefinedDomains& domains,
            const std::vector<DiscreteCurve>& curves, Cad& cad, std::vector<std::optional<PatchMesh>>& patches,
            const Executor& executor, Monitor& monitor)
      : model_(model),
        topology_(topology),
        domains_(domains),
        curves_(curves),
        cad_(cad),
        patches_(patches),
        executor_(executor),
        monitor_(monitor) {
    auto next = static_cast<std::int64_t>(topology.points.size());
    for (const DiscreteCurve& curve : curves) {
      first_.push_back(next);
      next += static_cast<std::int64_t>(curve.xyz.size());
    }
    number_vertices();
    collect_curve_edges();
  }

  std::int64_t run() {
    // A new vertex may see both sides of a seam: the next pass finds that.
    for (int pass = 0; pass < chord_passes; ++pass) {
      chords_.clear();
      std::vector<std::vector<Chord>> of_face(patches_.size());
      each_patch([&](int f) {
        if (pass == 0 || changed_[f]) of_face[f] = chords_of(f);
      });
      for (const std::vector<Chord>& some : of_face) chords_.insert(chords_.end(), some.begin(), some.end());
      // A chord with an end inside a face has no other face.
      const auto on_curves = [this](const Chord& chord) { return chord.local[1] < on_curves_[chord.face]; };
      add_of_others(executor_, "chords", on_curves, chords_);
      std::sort(chords_.begin(), chords_.end());
      changed_.assign(patches_.size(), false);
      if (count_added([this] { split_chords(); }) == 0) break;
    }
    editable_.clear();
    std::vector<Corners> triangles = triangles_on_curves();
    const auto all_on_curves = [](const Corners& corners) { return corners.key[2] < first_inside; };
    add_of_others(executor_, "triangles on curves", all_on_curves, triangles);
    count_added([&] { split_equal_triangles(triangles); });
    return added_everywhere_;
  }

 private:
  /// New vertices of all processes in a step that adds some.
  template <typename Step>
  std::int64_t count_added(const Step& step) {
    const std::int64_t new_ones = sum_of_all(executor_, "divided chords", [&] {
      const std::int64_t before = added_;
      step();
      return added_ - before;
    });
    added_everywhere_ += new_ones;
    return new_ones;
  }

  void split_chords() {
    for (std::size_t from = 0, to = 0; from < chords_.size(); from = to) {
      while (to < chords_.size() && chords_[to].key == chords_[from].key) ++to;
      const Key key = chords_[from].key;
      const bool all =
          to - from > 1 || key[0] == key[1] || std::binary_search(curve_edges_.begin(), curve_edges_.end(), key);
      for (std::size_t i = from; i < to; ++i)
        if (patches_[chords_[i].face] && (all || goes_round(chords_[i]))) split_chord(chords_[i]);
    }
  }

  /// Calls work(f) for each face that has a patch, from several threads.
  template <typename Work>
  void each_patch(const Work& work) {
    const auto look = [&](std::size_t f, Monitor&) {
      if (patches_[f]) work(static_cast<int>(f));
    };
    run_each(patches_.size(), false, executor_.threads, look, monitor_);
  }

  // Vertices inside faces have numbers beyond all others.
  [[nodiscard]] std::int64_t identity(int f, std::int32_t v) const {
    constexpr int face_bit = 31;
    if (v < on_curves_[f]) return identity_[f][v];
    return first_inside + (static_cast<std::int64_t>(f) << face_bit) + v;
  }

  // Collects vertices of space before the mesh numbers them: corners first, then vertices of curves.
  void number_vertices() {
    identity_.resize(patches_.size());
    several_.resize(patches_.size());
    on_curves_.resize(patches_.size(), 0);
    each_patch([this](int f) {
      std::vector<std::int64_t>& identity = identity_[f];
      for (const DomainVertexOrigin& origin : domains_.domain[f]->origin) {
        if (origin.curve < 0) break;  // imposed points come last
        identity.push_back(origin.corner >= 0 ? origin.corner : first_[origin.curve] + origin.node);
      }
      on_curves_[f] = static_cast<std::int32_t>(identity.size());
      std::vector<std::int64_t> sorted = identity;
      std::sort(sorted.begin(), sorted.end());
      for (const std::int64_t id : identity) {
        const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), id);
        several_[f].push_back(high - low > 1);
      }
    });
  }

  // From one side of a seam to the other.
  [[nodiscard]] bool goes_round(const Chord& chord) const {
    const auto [a, b] = chord.local;
    const std::vector<DomainVertexOrigin>& origin = domains_.domain[chord.face]->origin;
    if (b >= on_curves_[chord.face] || !several_[chord.face][a] || !several_[chord.face][b]) return false;
    if (origin[a].corner >= 0 || origin[b].corner >= 0 || origin[a].curve != origin[b].curve) return false;
    const std::vector<std::int64_t>& identity = identity_[chord.face];
    const auto is_first = [&](std::int32_t v) {
      return std::find(identity.begin(), identity.end(), identity[v]) - identity.begin() == v;
    };
    return is_first(a) != is_first(b);
  }

  void collect_curve_edges() {
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const Curve& shape = topology_.curves[c];
      if (shape.degenerate) continue;
      const int n = curves_[c].segments();
      const auto node = [&](int i) -> std::int64_t {
        return i == 0 ? shape.end1 : i == n ? shape.end2 : first_[c] + i;
      };
      for (int i = 0; i < n; ++i) curve_edges_.push_back(ordered(node(i), node(i + 1)));
    }
    std::sort(curve_edges_.begin(), curve_edges_.end());
  }

  // Edges that are not chords: imposed edges, and the two long sides of a triangle on a degenerate edge. These two
  // sides coincide when that triangle is flattened.
  [[nodiscard]] std::vector<Local> edges_to_keep(int f) const {
    std::vector<Local> imposed, flat;
    for (const PlaneEdge& edge : domains_.domain[f]->plane.edges) {
      imposed.push_back(local_edge(edge.a, edge.b));
      if (edge.kind == PlaneEdgeKind::degenerate) flat.push_back(imposed.back());
    }
    std::sort(flat.begin(), flat.end());
    const auto given = static_cast<std::int32_t>(domains_.domain[f]->plane.vertices.size());
    if (!flat.empty())
      for (const auto& t : patches_[f]->plane.triangles) {
        if ((t[0] < given) + (t[1] < given) + (t[2] < given) < 2) continue;
        for (int i = 0; i < 3; ++i) {
          if (!std::binary_search(flat.begin(), flat.end(), local_edge(t[i], t[(i + 1) % 3]))) continue;
          imposed.push_back(local_edge(t[(i + 1) % 3], t[(i + 2) % 3]));
          imposed.push_back(local_edge(t[(i + 2) % 3], t[i]));
        }
      }
    std::sort(imposed.begin(), imposed.end());
    return imposed;
  }

  [[nodiscard]] std::vector<Chord> chords_of(int f) const {
    std::vector<Chord> chords;
    const std::int32_t count = on_curves_[f];
    const std::vector<Local> keep = edges_to_keep(f);
    for (const auto& t : patches_[f]->plane.triangles) {
      if (std::min({t[0], t[1], t[2]}) >= count) continue;
      for (int i = 0; i < 3; ++i) {
        const auto [a, b] = local_edge(t[i], t[(i + 1) % 3]);
        // Each inner edge is met twice, once in each direction.
        if (a >= count || a != t[i]) continue;
        if (b >= count && !several_[f][a]) continue;
        if (std::binary_search(keep.begin(), keep.end(), Local{a, b})) continue;
        chords.push_back({ordered(identity(f, a), identity(f, b)), f, {a, b}});
      }
    }
    return chords;
  }

  Vec3 lift(int f, const Vec2& uv) { return surface_at(cad_, model_.faces[f].ref, want_position, uv).s; }

  // The point of the chord in (u, v) that is as far from one end as from the other in space.
  void split_chord(const Chord& chord) {
    const int f = chord.face;
    PatchMesh& patch = *patches_[f];
    const auto [a, b] = chord.local;
    const Vec2 p = patch.plane.vertices[a], q = patch.plane.vertices[b];
    const Vec3 start = patch.xyz[a], end = patch.xyz[b];
    double low = 0.1, high = 0.9, at = 0.5;
    Vec3 xyz = lift(f, lerp(p, q, at));
    for (int i = 0; i < middle_steps; ++i) {
      const double left = norm(xyz - start), right = norm(xyz - end);
      if (std::abs(left - right) <= 0.1 * (left + right)) break;
      (left < right ? low : high) = at;
      at = (low + high) / 2;
      xyz = lift(f, lerp(p, q, at));
    }
    EditableMesh& mesh = editable(f);
    const auto quad = mesh.quad_between({0, a}, b);
    if (!quad) return;
    mesh.split(*quad, lerp(p, q, at), xyz, EditableMesh::Split::at_start);
    count_vertex(f, (patch.size[a] + patch.size[b]) / 2);
  }

  void count_vertex(int f, double size) {
    patches_[f]->size.push_back(size);
    changed_[f] = true;
    ++added_;
  }

  // Made when the first chord of the patch is split.
  EditableMesh& editable(int f) {
    PatchMesh& patch = *patches_[f];
    return editable_.try_emplace(f, domains_.domain[f]->plane, patch.plane, patch.xyz).first->second;
  }

  // Faces of three edges each, back to back.
  [[nodiscard]] std::vector<Corners> triangles_on_curves() {
    std::vector<std::vector<Corners>> of_face(patches_.size());
    each_patch([&](int f) {
      const std::int32_t count = on_curves_[f];
      const auto& triangles = patches_[f]->plane.triangles;
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        // Two vertices on curves may belong to a seam; the third is then alone.
        if ((a >= count) + (b >= count) + (c >= count) > 1) continue;
        std::array<std::int64_t, 3> key{identity(f, a), identity(f, b), identity(f, c)};
        std::sort(key.begin(), key.end());
        if (key[0] != key[1] && key[1] != key[2]) of_face[f].push_back({key, f, t});
      }
    });
    std::vector<Corners> all;
    for (const std::vector<Corners>& some : of_face) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  void split_equal_triangles(std::vector<Corners>& all) {
    std::stable_sort(all.begin(), all.end(), [](const Corners& p, const Corners& q) { return p.key < q.key; });
    for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
      while (to < all.size() && all[to].key == all[from].key) ++to;
      for (std::size_t i = from; to - from > 1 && i < to; ++i)
        if (patches_[all[i].face]) split_triangle(all[i].face, all[i].triangle);
    }
  }

  void split_triangle(int f, std::size_t t) {
    PatchMesh& patch = *patches_[f];
    const auto [a, b, c] = patch.plane.triangles[t];
    const Vec2 uv = (1.0 / 3) * (patch.plane.vertices[a] + patch.plane.vertices[b] + patch.plane.vertices[c]);
    const double size = (patch.size[a] + patch.size[b] + patch.size[c]) / 3;
    const auto middle = static_cast<std::int32_t>(patch.xyz.size());
    patch.plane.vertices.push_back(uv);
    patch.xyz.push_back(lift(f, uv));
    count_vertex(f, size);
    patch.plane.triangles[t] = {a, b, middle};
    patch.plane.triangles.push_back({b, c, middle});
    patch.plane.triangles.push_back({c, a, middle});
  }

  const Model& model_;
  const Topology& topology_;
  const RefinedDomains& domains_;
  const std::vector<DiscreteCurve>& curves_;
  Cad& cad_;
  std::vector<std::optional<PatchMesh>>& patches_;
  Executor executor_;
  Monitor& monitor_;
  std::vector<std::int64_t> first_;                  // [curve]: number of its vertex 0
  std::vector<std::vector<std::int64_t>> identity_;  // [face][local vertex on a curve]
  std::vector<std::vector<bool>> several_;           // [face][local vertex on a curve]: there twice in this face
  std::vector<std::int32_t> on_curves_;              // [face]: its local vertices on curves, the first ones
  std::map<int, EditableMesh> editable_;             // [face]
  std::vector<Key> curve_edges_;
  std::vector<Chord> chords_;
  std::vector<bool> changed_;  // [face]: in this pass
  std::int64_t added_ = 0, added_everywhere_ = 0;
};

}  // namespace

std::int64_t separate_chords(const Model& model, const Topology& topology, const RefinedDomains& domains,
                             const std::vector<DiscreteCurve>& curves, Cad& cad,
                             std::vector<std::optional<PatchMesh>>& patches, const Executor& executor, Monitor& monitor) {
  return Separator(model, topology, domains, curves, cad, patches, executor, monitor).run();
}

}  // namespace carreau
