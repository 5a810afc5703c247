// SPDX-License-Identifier: BSD-3-Clause
#include "surface/assembly/narrow_collapse.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mesh/quality.h"
#include "model/union_find.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"
#include "surface/assembly/whole_mesh.h"

namespace carreau {

namespace {

constexpr std::int32_t unknown = -1;

/// The parts of the result that change when faces vanish.
struct Outcome {
  SurfaceMesh mesh;
  std::vector<double> vertex_size;
  std::vector<std::vector<double>> curve_size;
};

using Edge = std::array<std::int32_t, 2>;
Edge edge_of(std::int32_t a, std::int32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

class Collapser {
 public:
  Collapser(const SurfaceMesh& mesh, const std::vector<double>& vertex_size,
            const std::vector<std::vector<double>>& curve_size)
      : old_(mesh), old_size_(vertex_size), old_curve_size_(curve_size), sets_(mesh.vertices.size()) {}

  /// Returns nothing if a triangle would be turned over or lose its area.
  std::optional<Outcome> run(std::span<const FaceCollapse* const> faces) {
    vanishing_.assign(old_.faces.size(), 0);
    for (const FaceCollapse* face : faces) {
      vanishing_[face->face] = 1;
      const std::vector<std::int32_t>& vertex = old_.faces[face->face].vertex;
      for (const auto& one : face->one)
        for (const std::int32_t v : one) sets_.merge(vertex[one.front()], vertex[v]);
      for (const int c : face->curves)
        for (const std::int32_t v : old_.curves[c].vertices) sets_.merge(old_.curves[c].vertices.front(), v);
    }
    new_.mesh.faces = old_.faces;
    for (std::size_t f = 0; f < new_.mesh.faces.size(); ++f)
      if (!shrink(f)) return {};
    merge_curves();
    renumber();
    return std::move(new_);
  }

 private:
  std::int32_t merged(std::int32_t v) { return static_cast<std::int32_t>(sets_.find(v)); }

  // Renumbers the triangles of a face whose vertices have moved. Triangles with two vertices that become one are
  // flattened.
  bool shrink(std::size_t f) {
    FaceMesh& face = new_.mesh.faces[f];
    if (vanishing_[f] != 0) {
      face.uv.clear(), face.vertex.clear(), face.triangles.clear(), face.flattened.clear();
      face.status = FaceStatus::collapsed;
      return true;
    }
    const std::vector<std::int32_t> before = face.vertex;
    for (std::int32_t& v : face.vertex) v = merged(v);
    bool sound = true;
    std::erase_if(face.triangles, [&](const std::array<std::int32_t, 3>& t) {
      std::array<Vec3, 3> p, q;
      bool flat = false, moved = false;
      for (int i = 0; i < 3; ++i) {
        flat = flat || face.vertex[t[i]] == face.vertex[t[(i + 1) % 3]];
        moved = moved || face.vertex[t[i]] != before[t[i]];
        p[i] = old_.vertices[before[t[i]]], q[i] = old_.vertices[face.vertex[t[i]]];
      }
      if (flat)
        face.flattened.push_back(t);
      else if (moved)
        sound = sound && quality_q2(q[0], q[1], q[2]) > flat_quality &&
                dot(cross(p[1] - p[0], p[2] - p[0]), cross(q[1] - q[0], q[2] - q[0])) > 0;
      return flat;
    });
    return sound;
  }

  // Each curve in runs of edges that the same curves share; a run belongs to the first of them.
  void merge_curves() {
    std::map<Edge, std::vector<int>> shared;
    std::vector<std::vector<std::int32_t>> chains;
    std::vector<std::vector<double>> sizes;
    for (int c = 0; c < static_cast<int>(old_.curves.size()); ++c) {
      auto& chain = chains.emplace_back();
      auto& size = sizes.emplace_back();
      for (std::size_t i = 0; i < old_.curves[c].vertices.size(); ++i) {
        const std::int32_t v = merged(old_.curves[c].vertices[i]);
        if (!chain.empty() && chain.back() == v) continue;
        chain.push_back(v);
        if (!old_curve_size_[c].empty()) size.push_back(old_curve_size_[c][i]);
      }
      if (chain.size() < 2) size.clear();
      if (!touches_vanishing(c)) continue;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) shared[edge_of(chain[i], chain[i + 1])].push_back(c);
    }
    std::vector<CurveMesh> more;
    std::vector<std::vector<double>> more_sizes;
    for (int c = 0; c < static_cast<int>(old_.curves.size()); ++c) {
      CurveMesh curve{old_.curves[c].ref, {}, uses_of({c})};
      std::vector<double> size;
      if (!touches_vanishing(c) || chains[c].size() < 2) {
        curve.vertices = chains[c];
        size = sizes[c];
      } else {
        bool first = true;
        for (std::size_t from = 0, to = 0; from + 1 < chains[c].size(); from = to) {
          const std::vector<int>& owners = shared[edge_of(chains[c][from], chains[c][from + 1])];
          for (to = from + 1; to + 1 < chains[c].size(); ++to)
            if (shared[edge_of(chains[c][to], chains[c][to + 1])] != owners) break;
          if (owners.front() != c) continue;
          CurveMesh run{old_.curves[c].ref,
                        {chains[c].begin() + static_cast<std::ptrdiff_t>(from),
                         chains[c].begin() + static_cast<std::ptrdiff_t>(to) + 1},
                        uses_of(owners)};
          std::vector<double> run_size;
          if (!sizes[c].empty())
            run_size.assign(sizes[c].begin() + static_cast<std::ptrdiff_t>(from),
                            sizes[c].begin() + static_cast<std::ptrdiff_t>(to) + 1);
          if (std::exchange(first, false)) {
            curve = std::move(run);
            size = std::move(run_size);
          } else {
            more.push_back(std::move(run));
            more_sizes.push_back(std::move(run_size));
          }
        }
      }
      new_.mesh.curves.push_back(std::move(curve));
      new_.curve_size.push_back(std::move(size));
    }
    for (std::size_t i = 0; i < more.size(); ++i) {
      new_.mesh.curves.push_back(std::move(more[i]));
      new_.curve_size.push_back(std::move(more_sizes[i]));
    }
  }
  [[nodiscard]] bool touches_vanishing(int c) const {
    return std::any_of(old_.curves[c].uses.begin(), old_.curves[c].uses.end(),
                       [this](const CurveMeshUse& use) { return vanishing_[use.face] != 0; });
  }
  [[nodiscard]] std::vector<CurveMeshUse> uses_of(const std::vector<int>& curves) const {
    std::vector<CurveMeshUse> uses;
    for (const int c : curves)
      for (const CurveMeshUse& use : old_.curves[c].uses)
        if (vanishing_[use.face] == 0) uses.push_back(use);
    return uses;
  }

  // Removes vertices without a face or a curve.
  void renumber() {
    std::vector<std::int32_t> number(old_.vertices.size(), unknown);
    const auto use = [&](std::int32_t v) { number[v] = 0; };
    for (const FaceMesh& face : new_.mesh.faces)
      for (const std::int32_t v : face.vertex) use(v);
    for (const CurveMesh& curve : new_.mesh.curves)
      if (!curve.uses.empty())
        for (const std::int32_t v : curve.vertices) use(v);
    std::vector<double> smallest(old_.vertices.size(), infinity);
    for (std::size_t v = 0; v < old_.vertices.size(); ++v) {
      double& size = smallest[merged(static_cast<std::int32_t>(v))];
      size = std::min(size, old_size_[v]);
    }
    for (std::size_t v = 0; v < old_.vertices.size(); ++v) {
      if (number[v] == unknown) continue;
      number[v] = static_cast<std::int32_t>(new_.mesh.vertices.size());
      new_.mesh.vertices.push_back(old_.vertices[v]);
      new_.mesh.vertex_ref.push_back(old_.vertex_ref[v]);
      new_.vertex_size.push_back(smallest[v]);
    }
    for (FaceMesh& face : new_.mesh.faces)
      for (std::int32_t& v : face.vertex) v = number[v];
    for (CurveMesh& curve : new_.mesh.curves) {
      if (curve.uses.empty()) curve.vertices.clear();
      for (std::int32_t& v : curve.vertices) v = number[v];
    }
  }

  const SurfaceMesh& old_;
  const std::vector<double>& old_size_;
  const std::vector<std::vector<double>>& old_curve_size_;
  UnionFind sets_;
  std::vector<char> vanishing_;  // by face
  Outcome new_;
};

std::string sentence_of(const FaceCollapse& face, int ref) {
  return Where{.face = ref}.prefix() + "the face is narrow (" + format_number(face.width) + " where the size is " +
         format_number(face.size) + ")";
}

std::size_t count_defects(const SurfaceMesh& mesh) {
  return find_defects(mesh, {.closed = false, .limit = std::numeric_limits<std::size_t>::max()}).size();
}

/// Returns whether an edge away from curves has triangles of several faces, so that two patches touch by it.
bool has_shared_chords(const SurfaceMesh& mesh) {
  std::set<Edge> on_curves;
  for (const CurveMesh& curve : mesh.curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      on_curves.insert(edge_of(curve.vertices[i - 1], curve.vertices[i]));
  std::vector<Edge> inside;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i)
        if (const Edge edge = edge_of(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]); !on_curves.contains(edge))
          inside.push_back(edge);
  std::sort(inside.begin(), inside.end());
  for (std::size_t i = 2; i < inside.size(); ++i)
    if (inside[i] == inside[i - 2]) return true;
  return false;
}

std::optional<Outcome> outcome_of(std::span<const FaceCollapse* const> faces, const CompositeResult& result) {
  return Collapser(result.mesh, result.vertex_size, result.curve_size).run(faces);
}

void take(Outcome&& outcome, CompositeResult& result) {
  result.mesh = std::move(outcome.mesh);
  result.vertex_size = std::move(outcome.vertex_size);
  result.curve_size = std::move(outcome.curve_size);
}

void tell(std::span<const FaceCollapse> faces, CompositeResult& result) {
  for (const FaceCollapse& face : faces) {
    FaceMesh& mesh = result.mesh.faces[face.face];
    const std::string what = sentence_of(face, mesh.ref);
    if (mesh.status == FaceStatus::collapsed) {
      mesh.why = what + " and has vanished: its two sides have become one";
    } else if (mesh.status == FaceStatus::meshed || mesh.status == FaceStatus::mended) {
      mesh.status = FaceStatus::mended;
      mesh.why = what + " but stays: without it the mesh would not be sound";
    }
  }
}

std::vector<const FaceCollapse*> pointers_to(std::span<const FaceCollapse> faces) {
  std::vector<const FaceCollapse*> all;
  for (const FaceCollapse& face : faces) all.push_back(&face);
  return all;
}

}  // namespace

bool collapse_together(std::span<const FaceCollapse> faces, CompositeResult& result) {
  auto outcome = outcome_of(pointers_to(faces), result);
  if (!outcome || outcome->mesh.triangle_count() == 0 || count_defects(outcome->mesh) > 0 ||
      has_shared_chords(outcome->mesh))
    return false;
  take(std::move(*outcome), result);
  tell(faces, result);
  return true;
}

void collapse_one_by_one(std::span<const FaceCollapse> faces, CompositeResult& result, Monitor& monitor) {
  const std::size_t defects = count_defects(result.mesh);
  const std::int64_t characteristic = euler_number(result.mesh);
  std::vector<const FaceCollapse*> order = pointers_to(faces), done;
  std::stable_sort(order.begin(), order.end(),
                   [](const FaceCollapse* p, const FaceCollapse* q) { return p->width < q->width; });
  std::optional<Outcome> best;
  for (const FaceCollapse* face : order) {
    monitor.checkpoint();
    done.push_back(face);
    auto outcome = outcome_of(done, result);
    if (outcome && outcome->mesh.triangle_count() > 0 && euler_number(outcome->mesh) == characteristic &&
        count_defects(outcome->mesh) <= defects)
      best = std::move(outcome);
    else
      done.pop_back();
  }
  if (best) take(std::move(*best), result);
  tell(faces, result);
}

}  // namespace carreau
