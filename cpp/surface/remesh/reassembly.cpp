// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/reassembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "support/error.h"
#include "support/stepped_tasks.h"
#include "surface/remesh/cells/cell_placer.h"
#include "surface/remesh/cells/sheets.h"

namespace carreau {

namespace {

/// Cells that one thread places, and parts of cells between two distributions of cells to faces [time and memory only].
constexpr std::size_t cells_of_part = 4096, parts_placed_at_once = 64;

/// Distributes cells to faces, and edges of lines to curves.
class Reassembler {
 public:
  Reassembler(const SurfaceMesh& before, const CellsInSpace& cells, const RemeshingWorkers& workers, Monitor& monitor)
      : before_(before), free_(cells.vertices), in_space_(cells), workers_(workers), monitor_(monitor) {
    result_.mesh.independent = true;
  }

  SizedMesh run(const std::vector<SharpLine>& lines, std::span<const WorkedLine> worked,
                const std::vector<std::int32_t>& corners) {
    number_vertices(corners);
    on_line_.assign(free_.vertices(), 0);
    for (const SharpLine& line : lines)
      for (const std::int32_t v : line.vertices) on_line_[v] = 1;
    place_cells();
    result_.feet.resize(before_.faces.size());
    result_.mid_feet.resize(before_.faces.size());
    result_.mesh.faces.resize(before_.faces.size());
    locals_.resize(before_.faces.size());
    const auto each_face = [&](const auto& work) {
      run_each(before_.faces.size(), false, workers_.threads, [&](std::size_t f, Monitor&) { work(f); }, monitor_);
    };
    each_face([&](std::size_t f) { add_face(f); });
    part_equal_diagonals(result_.mesh);
    if (!in_space_.nodes.empty()) each_face([&](std::size_t f) { add_nodes(f); });
    add_curves(lines);
    place_on_curves(worked);
    return std::move(result_);
  }

 private:
  void number_vertices(const std::vector<std::int32_t>& corners) {
    number_.assign(free_.vertices(), -1);
    node_number_.assign(in_space_.nodes.empty() ? 0 : free_.vertices(), -1);
    for (const SpaceCell& cell : in_space_.cells)
      for (const std::int32_t v : cell)
        if (v >= 0) number_[v] = 0;
    std::vector<char> of_wire(number_.size(), 0);
    for (const CurveMesh& curve : before_.curves)
      for (std::size_t k = 0; curve.loose && k < curve.vertices.size(); ++k)
        number_[curve.vertices[k]] = 0, of_wire[curve.vertices[k]] = 1;
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] < 0) continue;
      const auto old = static_cast<std::int32_t>(v);
      number_[v] = static_cast<std::int32_t>(result_.mesh.vertices.size());
      result_.mesh.vertices.push_back(free_.position(old));
      const bool keeps_ref = of_wire[v] != 0 || std::ranges::binary_search(corners, old);
      result_.mesh.vertex_ref.push_back(keeps_ref ? before_.vertex_ref[v] : 0);
      result_.vertex_size.push_back(free_.size(old));
      old_vertex_.push_back(old);
    }
    for (const SpaceCell& nodes : in_space_.nodes)
      for (const std::int32_t v : nodes)
        if (v >= 0) node_number_[v] = 0;
    for (std::size_t v = 0; v < node_number_.size(); ++v) {
      if (node_number_[v] < 0) continue;
      node_number_[v] = static_cast<std::int32_t>(result_.mesh.mid_vertices.size());
      result_.mesh.mid_vertices.push_back(free_.position(static_cast<std::int32_t>(v)));
    }
  }

  [[nodiscard]] SpaceCell nodes_of(std::size_t cell) const {
    return in_space_.nodes.empty() ? SpaceCell{-1, -1, -1, -1} : in_space_.nodes[cell];
  }

  void place_cells() {
    of_face_.resize(before_.faces.size());
    const std::size_t n = in_space_.cells.size(), at_once = parts_placed_at_once * cells_of_part;
    std::vector<PlacedCell> placed(std::min(n, at_once));
    for (std::size_t first = 0; first < n; first += at_once) {
      const std::size_t end = std::min(n, first + at_once);
      const auto place_part = [&](std::size_t part, Monitor& own) {
        CellPlacer place(free_, in_space_.charts, in_space_.cad);
        for (std::size_t c = first + part * cells_of_part; c < std::min(end, first + (part + 1) * cells_of_part); ++c) {
          if (c % 256 == 0) own.checkpoint();
          placed[c - first] = place(in_space_.cells[c], nodes_of(c));
        }
      };
      run_each((end - first + cells_of_part - 1) / cells_of_part, !workers_.hosts_threads, workers_.threads, place_part, monitor_);
      for (std::size_t c = first; c < end; ++c) deal_out(c, placed[c - first]);
    }
  }

  // Edges inside of faces that stay have kept vertices too, but are no edges of lines.
  [[nodiscard]] bool may_end_edges_of_lines(std::int32_t v) const { return on_line_[v] != 0 && !free_.is_free(v); }

  void deal_out(std::size_t c, const PlacedCell& placed) {
    const SpaceCell& cell = in_space_.cells[c];
    for (int i = 0; i < placed.count; ++i) {
      const std::int32_t v = cell[i], w = cell[(i + 1) % placed.count];
      if (!may_end_edges_of_lines(v) || !may_end_edges_of_lines(w)) continue;
      Beside& beside = beside_[mesh_edge(v, w)];
      beside.faces.push_back(placed.face);
      beside.node = nodes_of(c)[i];
    }
    of_face_[placed.face].push_back(placed);
  }

  void add_face(std::size_t f) {
    const FaceMesh& old = before_.faces[f];
    FaceMesh& face = result_.mesh.faces[f];
    face.ref = old.ref, face.name = old.name, face.rgb = old.rgb, face.part_of = old.part_of;
    face.status = old.status, face.why = old.why;
    if (of_face_[f].empty()) {
      if (old.triangles.empty()) return;
      face.status = FaceStatus::collapsed;
      face.why = Where{.face = old.ref}.prefix() +
                 "no triangle is left of the face: its neighbours' cover it within the tolerances";
      return;
    }
    std::vector<std::int32_t>& feet = result_.feet[f];
    part_sheets(of_face_[f], [&](std::int32_t v) { return may_end_edges_of_lines(v); });
    std::vector<PlacedCorner>& locals = locals_[f];
    for (const PlacedCell& c : of_face_[f]) locals.insert(locals.end(), c.corners.begin(), c.corners.begin() + c.count);
    sort_uniquely(locals);
    for (const PlacedCorner& c : locals) {
      const SurfacePlace& p = free_.places(c.vertex)[c.place];
      face.uv.push_back(p.foot.uv);
      face.vertex.push_back(number_[c.vertex]);
      face.uv_face.push_back(in_space_.charts.face(p.foot));
      feet.push_back(p.foot.triangle);
    }
    add_cells(of_face_[f], locals, face);
  }

  template <typename T>
  static void sort_uniquely(std::vector<T>& all) {
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  static std::int32_t rank_of(const PlacedCorner& c, const std::vector<PlacedCorner>& all) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(all, c) - all.begin());
  }

  void add_cells(const std::vector<PlacedCell>& cells, const std::vector<PlacedCorner>& locals, FaceMesh& face) const {
    std::vector<std::array<std::int32_t, 4>> four;
    std::vector<std::array<std::int32_t, 3>> three;
    std::vector<char> spread;  // of triangles
    for (const PlacedCell& c : cells) {
      std::array<std::int32_t, 4> corners{};
      for (int i = 0; i < c.count; ++i) corners[i] = rank_of(c.corners[i], locals);
      if (c.count == 4)
        four.push_back(corners), face.spread.insert(face.spread.end(), 2, static_cast<char>(c.spread));
      else
        three.push_back({corners[0], corners[1], corners[2]}), spread.push_back(static_cast<char>(c.spread));
    }
    set_cells(face, four, three, result_.mesh.vertices);
    face.spread.insert(face.spread.end(), spread.begin(), spread.end());
  }

  // An edge of a face has the same node from both of its sides.
  void add_nodes(std::size_t f) {
    const std::vector<PlacedCell>& cells = of_face_[f];
    const std::vector<PlacedCorner>& locals = locals_[f];
    FaceMesh& face = result_.mesh.faces[f];
    std::vector<std::int32_t>& feet = result_.mid_feet[f];
    std::vector<PlacedCorner> nodes;
    std::map<std::array<std::int32_t, 2>, PlacedCorner> on_edge;  // by local corners, as the cell runs
    for (const PlacedCell& c : cells)
      for (int i = 0; i < c.count; ++i) {
        nodes.push_back(c.nodes[i]);
        on_edge[{rank_of(c.corners[i], locals), rank_of(c.corners[(i + 1) % c.count], locals)}] = c.nodes[i];
      }
    sort_uniquely(nodes);
    for (const PlacedCorner& n : nodes) {
      const SurfacePlace& p = free_.places(n.vertex)[n.place];
      face.mid_uv.push_back(p.foot.uv);
      face.mid_vertex.push_back(node_number_[n.vertex]);
      feet.push_back(p.foot.triangle);
    }
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      std::array<std::int32_t, 3>& mid = face.mid.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto found = on_edge.find({face.triangles[t][i], face.triangles[t][(i + 1) % 3]});
        const bool diagonal = t < 2 * static_cast<std::size_t>(face.quads) && i == (t % 2 == 0 ? 2U : 0U);
        mid[i] = diagonal || found == on_edge.end() ? -1 : rank_of(found->second, nodes);
      }
    }
  }

  /// Remaining edges of a line, with their curve and the faces beside.
  struct Run {
    std::int32_t curve = -1;
    std::vector<std::int32_t> faces;
    std::vector<std::int32_t> vertices;
    std::vector<std::int32_t> nodes;  // of its edges
  };

  void add_curves(const std::vector<SharpLine>& lines) {
    std::vector<Run> runs;
    for (const SharpLine& line : lines) add_runs(line, runs);
    SurfaceMesh& mesh = result_.mesh;
    for (const CurveMesh& old : before_.curves) {
      CurveMesh& curve = mesh.curves.emplace_back(old);
      curve.vertices.clear(), curve.mid.clear();
      for (std::size_t k = 0; old.loose && k < old.vertices.size(); ++k) curve.vertices.push_back(number_[old.vertices[k]]);
    }
    for (std::size_t c = 0; c < mesh.curves.size(); ++c) old_curve_.push_back(static_cast<std::int32_t>(c));
    for (Run& run : runs) {
      CurveMesh curve = mesh.curves[run.curve];
      curve.uses = uses_of(run);
      curve.vertices.clear(), curve.mid.clear();
      for (const std::int32_t v : run.vertices) curve.vertices.push_back(number_[v]);
      for (const std::int32_t v : run.nodes)
        if (v >= 0) curve.mid.push_back(node_number_[v]);
      if (mesh.curves[run.curve].vertices.empty())
        mesh.curves[run.curve] = std::move(curve);
      else
        more_.push_back(std::move(curve)), old_curve_.push_back(run.curve);
    }
    for (CurveMesh& curve : more_) mesh.curves.push_back(std::move(curve));
    for (const CurveMesh& curve : mesh.curves) result_.curve_size.push_back(sizes_along(curve.vertices));
  }

  // If sizes differ by direction: the mean of the sizes along the edges before and behind.
  [[nodiscard]] std::vector<double> sizes_along(const std::vector<std::int32_t>& chain) const {
    std::vector<double> sizes;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (!free_.by_direction() || chain.size() < 2) {
        sizes.push_back(result_.vertex_size[chain[k]]);
        continue;
      }
      const std::int32_t v = old_vertex_[chain[k]];
      double sum = 0;
      int count = 0;
      if (k > 0) sum += free_.size_along(v, old_vertex_[chain[k - 1]]), ++count;
      if (k + 1 < chain.size()) sum += free_.size_along(v, old_vertex_[chain[k + 1]]), ++count;
      sizes.push_back(sum / count);
    }
    return sizes;
  }

  // A vertex where a closed curve begins is at both of its ends.
  void place_on_curves(std::span<const WorkedLine> worked) {
    std::multimap<std::pair<std::int32_t, std::int32_t>, OnCurve> known;  // by curve of the previous mesh and vertex
    for (const WorkedLine& line : worked)
      for (const LineNode& node : line.left)
        for (const OnCurve& place : line.places->on_curves(node.arc))
          if (number_[node.vertex] >= 0) known.emplace(std::pair{place.curve, number_[node.vertex]}, place);
    for (std::size_t c = 0; c < result_.mesh.curves.size(); ++c) {
      CurveParameters& on = result_.curve_parameters.emplace_back();
      const std::vector<std::int32_t>& chain = result_.mesh.curves[c].vertices;
      if (chain.size() < 2) continue;
      on.t.assign(chain.size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t k = 0; k < chain.size(); ++k)
        if (const auto place = known.find({old_curve_[c], chain[k]}); place != known.end())
          on.face = place->second.face, on.ic = place->second.ic, on.t[k] = place->second.t;
      for (const auto& [end, beside] : {std::pair{std::size_t{0}, std::size_t{1}}, {chain.size() - 1, chain.size() - 2}}) {
        const auto [first, last] = known.equal_range({old_curve_[c], chain[end]});
        for (auto each = first; each != last; ++each)
          if (const double t = each->second.t; std::abs(t - on.t[beside]) < std::abs(on.t[end] - on.t[beside]))
            on.t[end] = t;
      }
    }
  }

  void add_runs(const SharpLine& whole, std::vector<Run>& runs) {
    const auto [left, curve] = what_is_left(whole, [&](std::int32_t v) { return number_[v] >= 0; });
    bool fresh = true;
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const Beside& beside = beside_[mesh_edge(left[k], left[k + 1])];
      std::vector<std::int32_t> faces = beside.faces;
      std::ranges::sort(faces);
      if (fresh || runs.back().curve != curve[k] || runs.back().faces != faces)
        runs.push_back({curve[k], std::move(faces), {left[k]}, {}});
      runs.back().vertices.push_back(left[k + 1]);
      runs.back().nodes.push_back(beside.node);
      fresh = false;
    }
  }

  // A curve inside one face stays inside.
  [[nodiscard]] std::vector<CurveMeshUse> uses_of(const Run& run) const {
    const auto& old = before_.curves[run.curve].uses;
    const bool internal = std::ranges::any_of(old, [](const CurveMeshUse& u) { return u.internal; });
    if (internal && run.faces.size() == 2 && run.faces[0] == run.faces[1]) return {{run.faces[0], true}};
    std::vector<CurveMeshUse> uses;
    for (const std::int32_t f : run.faces) uses.push_back({f, false});
    return uses;
  }

  /// For an edge between kept vertices: faces of the cells on it, and its node.
  struct Beside {
    std::vector<std::int32_t> faces;
    std::int32_t node = -1;
  };

  const SurfaceMesh& before_;
  const PlacedVertices& free_;
  const CellsInSpace& in_space_;
  const RemeshingWorkers& workers_;
  Monitor& monitor_;
  SizedMesh result_;
  std::vector<std::int32_t> number_, old_vertex_;  // of vertices that are there, one way and the other
  std::vector<std::int32_t> node_number_;          // for vertices that are nodes on edges
  std::vector<char> on_line_;                      // by vertex of the cells
  std::vector<std::vector<PlacedCell>> of_face_;
  std::vector<std::vector<PlacedCorner>> locals_;  // by face, ascending
  std::map<MeshEdge, Beside> beside_;
  std::vector<CurveMesh> more_;
  std::vector<std::int32_t> old_curve_;  // by curve: the curve of the previous mesh
};

}  // namespace

SharpLine what_is_left(const SharpLine& line, const std::function<bool(std::int32_t)>& is_there) {
  SharpLine left;
  std::size_t first = 0;
  while (first < line.vertices.size() && !is_there(line.vertices[first])) ++first;
  const std::size_t n = line.curve.size();
  if (first > n) return left;
  left.vertices.push_back(line.vertices[first]);
  std::size_t from = first;
  for (std::size_t k = first + 1; k <= (line.closed() ? first + n : n); ++k) {
    const std::int32_t v = line.vertices[k <= n ? k : k - n];
    if (!is_there(v)) continue;
    left.vertices.push_back(v);
    left.curve.push_back(line.curve[((from + k - 1) / 2) % n]);
    from = k;
  }
  return left;
}

SizedMesh reassemble(const SurfaceMesh& before, const CellsInSpace& cells, const std::vector<SharpLine>& lines,
                     std::span<const WorkedLine> worked, const std::vector<std::int32_t>& corners, const RemeshingWorkers& workers,
                     Monitor& monitor) {
  return Reassembler(before, cells, workers, monitor).run(lines, worked, corners);
}

}  // namespace carreau
