// SPDX-License-Identifier: BSD-3-Clause
// Plane meshes as domains, polygons as splines, files by suffix.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>

#include "io/files.h"
#include "io/mesh_files.h"
#include "io/plane/plane_files.h"
#include "support/error.h"

namespace carreau {

namespace {

std::pair<int, int> ordered(int a, int b) { return std::minmax(a, b); }

/// Sides of triangles by the edge, from its smaller vertex to its larger one.
struct Beside {
  int left = -1, right = -1;  ///< triangles
};

std::map<std::pair<int, int>, Beside> triangles_beside(const FlatMesh& mesh, const std::string& name) {
  std::map<std::pair<int, int>, Beside> beside;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Vec3 &p = mesh.vertices[corners[0]], &q = mesh.vertices[corners[1]], &r = mesh.vertices[corners[2]];
    const bool direct = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()) > 0;
    for (int i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      Beside& here = beside[ordered(a, b)];
      int& side = (a < b) == direct ? here.left : here.right;
      if (side >= 0)
        throw FileError({.file = name}, "triangles " + std::to_string(side + 1) + " and " + std::to_string(t + 1) +
                                            " lie on one side of an edge");
      side = static_cast<int>(t);
    }
  }
  return beside;
}

class MeshDomain {
 public:
  MeshDomain(const FlatMesh& mesh, const std::string& name)
      : mesh_(mesh), name_(name), beside_(triangles_beside(mesh, name)) {
    input_.source = name;
  }

  PlaneDomainInput read() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      input_.points.push_back(
          {.xy = {mesh_.vertices[v].x(), mesh_.vertices[v].y()}, .ref = ref_of(mesh_.vertex_refs, v)});
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      add_edge(mesh_.edges[e][0], mesh_.edges[e][1], ref_of(mesh_.edge_refs, e));
    for (const auto& [edge, sides] : beside_)
      if (triangle_ref(sides.left) != triangle_ref(sides.right) && !known_.contains(edge))
        add_edge(edge.first, edge.second, 0);
    if (input_.curves.empty())
      throw FileError({.file = name_}, "the mesh has neither edges nor triangles: it bounds no domain");
    input_.rest = mesh_.triangles.empty() ? PlaneRest::parity : PlaneRest::outside;
    input_.is_mesh = !mesh_.triangles.empty();
    if (!input_.is_mesh)
      for (PlanePoint& point : input_.points) point.imposed = point.may_drop = true;
    return std::move(input_);
  }

 private:
  static int ref_of(const std::vector<std::int32_t>& refs, std::size_t i) { return refs.empty() ? 0 : refs[i]; }
  /// -1: no triangle. Negative references count as none.
  [[nodiscard]] int triangle_ref(int t) const {
    return t < 0 ? -1 : std::max(0, ref_of(mesh_.triangle_refs, static_cast<std::size_t>(t)));
  }

  void add_edge(int a, int b, int ref) {
    if (a == b || !known_.insert({ordered(a, b), 0}).second) return;
    const int curve = static_cast<int>(input_.curves.size());
    PlaneCurve& added = input_.curves.emplace_back();
    added.points = {a, b}, added.ref = ref;
    const auto found = beside_.find(ordered(a, b));
    if (found == beside_.end()) return;
    const auto [left, right] = found->second;
    for (const auto& [triangle, is_left] : {std::pair{left, true}, std::pair{right, false}})
      if (triangle >= 0)
        input_.sides.push_back({.curve = curve, .left = is_left == (a < b), .ref = triangle_ref(triangle)});
  }

  const FlatMesh& mesh_;
  const std::string& name_;
  std::map<std::pair<int, int>, Beside> beside_;
  std::map<std::pair<int, int>, int> known_;
  PlaneDomainInput input_;
};

/// Returns true if a chain continues at a point (its index) from an edge `d` to an edge `e`.
using GoesOn = std::function<bool(int point, const Vec2& d, const Vec2& e)>;

/// Joins the segments of a domain that run on into chains: splines, or straight curves from end to end.
class Chains {
 public:
  Chains(PlaneDomainInput& input, GoesOn goes_on, bool smooth)
      : input_(input), goes_on_(std::move(goes_on)), smooth_(smooth), at_(input.points.size()) {
    for (std::size_t c = 0; c < input_.curves.size(); ++c)
      for (const int p : {input_.curves[c].points.front(), input_.curves[c].points.back()})
        at_[p].push_back(static_cast<int>(c));
  }

  void join() {
    std::vector<PlaneCurve> joined;
    std::vector<int> new_of(input_.curves.size(), -1);
    std::vector<char> reversed(input_.curves.size(), 0);
    for (const bool closed : {false, true})
      for (std::size_t c = 0; c < input_.curves.size(); ++c) {
        if (new_of[c] >= 0 ||
            (!closed && runs_on(input_.curves[c].points.front()) && runs_on(input_.curves[c].points.back())))
          continue;
        const bool from_end = runs_on(input_.curves[c].points.front()) && !runs_on(input_.curves[c].points.back());
        joined.push_back(chain_from(static_cast<int>(c), from_end, static_cast<int>(joined.size()), new_of, reversed));
      }
    for (PlaneSide& side : input_.sides) {
      if (reversed[side.curve] != 0) side.left = !side.left;
      side.curve = new_of[side.curve];
    }
    input_.curves = std::move(joined);
  }

 private:
  [[nodiscard]] bool runs_on(int p) const {
    if (at_[p].size() != 2 || at_[p][0] == at_[p][1]) return false;
    const PlaneCurve &a = input_.curves[at_[p][0]], &b = input_.curves[at_[p][1]];
    if (a.ref != b.ref || a.smooth || b.smooth || a.arcs || b.arcs) return false;
    const Vec2 d =
        input_.points[p].xy - input_.points[a.points.front() == p ? a.points[1] : a.points[a.points.size() - 2]].xy;
    const Vec2 e =
        input_.points[b.points.front() == p ? b.points[1] : b.points[b.points.size() - 2]].xy - input_.points[p].xy;
    return goes_on_(p, d, e);
  }

  PlaneCurve chain_from(int c, bool backwards, int rank, std::vector<int>& new_of, std::vector<char>& reversed) {
    PlaneCurve chain = input_.curves[c];
    chain.points.clear();
    for (bool first = true;; first = false) {
      std::vector<int> points = input_.curves[c].points;
      if (backwards) std::reverse(points.begin(), points.end());
      chain.points.insert(chain.points.end(), points.begin() + (first ? 0 : 1), points.end());
      new_of[c] = rank, reversed[c] = backwards ? 1 : 0;
      const int end = points.back();
      if (!runs_on(end)) break;
      const int next = at_[end][0] == c ? at_[end][1] : at_[end][0];
      if (new_of[next] >= 0) break;  // closed
      c = next, backwards = input_.curves[c].points.front() != end;
    }
    if (chain.points.size() > 2 && !smooth_) {
      chain.points = {chain.points.front(), chain.points.back()};
    } else if (chain.points.size() > 2) {
      chain.smooth = true;
      const bool closed = chain.points.front() == chain.points.back();
      for (std::size_t i = 1; i + 1 < chain.points.size(); ++i) input_.points[chain.points[i]].imposed = false;
      if (closed) input_.points[chain.points.front()].imposed = false;
    }
    return chain;
  }

  PlaneDomainInput& input_;
  GoesOn goes_on_;
  bool smooth_;
  std::vector<std::vector<int>> at_;  // curves that end at each point
};

}  // namespace

PlaneDomainInput plane_domain_of(const FlatMesh& mesh, const std::string& name) {
  if (mesh.dimension != 2) throw FileError({.file = name}, "the mesh has dimension 3; a plane domain has dimension 2");
  return MeshDomain(mesh, name).read();
}

void smooth_polygons(PlaneDomainInput& input, double corner_angle) {
  const double min_cosine = std::cos(corner_angle * std::numbers::pi / 180);
  const auto goes_on = [=](int, const Vec2& d, const Vec2& e) { return dot(d, e) >= min_cosine * norm(d) * norm(e); };
  Chains(input, goes_on, true).join();
}

void join_straight_edges(PlaneDomainInput& input) {
  constexpr double rounding = 1e-9;  // of the sine of a turn: coordinates of a file may have ten digits
  const auto goes_on = [&](int p, const Vec2& d, const Vec2& e) {
    return input.points[p].ref == 0 && dot(d, e) > 0 && std::abs(cross(d, e)) <= rounding * norm(d) * norm(e);
  };
  Chains(input, goes_on, false).join();
}

PlaneDomainInput read_plane_domain(const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".poly") {
    const std::string nodes = std::filesystem::path(path).replace_extension(".node").string();
    return read_poly_text(read_file(path), path, std::filesystem::exists(nodes) ? read_file(nodes) : "", nodes);
  }
  if (suffix == ".node") return read_node_text(read_file(path), path);
  if (suffix == ".dat") return read_airfoil_text(read_file(path), path);
  if (suffix == ".data") return read_bl2d_data_text(read_file(path), path);
  if (suffix == ".mesh" || suffix == ".meshb" || suffix == ".bl2d") return plane_domain_of(read_mesh(path), path);
  if (suffix != ".g")
    throw InvalidArgument("'" + path +
                          "' does not have a suffix of plane domains: .poly, .node, .dat, .mesh, .meshb, .bl2d, .data, .g");
  PlaneDomainInput input = read_bl2d_g_text(read_file(path), path);
  const std::string sizes = std::filesystem::path(path).replace_extension(".hg").string();
  if (std::filesystem::exists(sizes)) set_point_sizes(input, read_bl2d_sizes_text(read_file(sizes), sizes), sizes);
  return input;
}

}  // namespace carreau
