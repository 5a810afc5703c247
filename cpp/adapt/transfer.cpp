// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "adapt/curved_elements.h"
#include "adapt/thresholds.h"
#include "mesh/triangle_search.h"
#include "size/thresholds.h"
#include "support/error.h"

namespace carreau {

namespace {

using namespace thresholds::adapt;

using thresholds::size::outside_share;  // as for background meshes

using Triangle = std::array<std::int32_t, 3>;

/// From a triangle to the nearest one in space, step by step through triangles that share a vertex of the mesh, seams
/// and poles included. What the steps do not reach, another sheet of the face, is not mixed up with it.
class Neighbourhood {
 public:
  /// Keeps references.
  Neighbourhood(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
  /// The point where steps from triangle `start` end: none of the triangles around is nearer to p.
  [[nodiscard]] NearestOnMesh nearest(const Vec3& p, std::int32_t start) const;

 private:
  struct Corner {
    std::int32_t vertex, triangle;
  };
  [[nodiscard]] NearestOnMesh on(std::int32_t triangle, const Vec3& p) const;
  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<Corner> corners_;                    // vertex by vertex: a face has few of those of a mesh
  std::vector<std::array<std::int32_t, 3>> fans_;  // of each corner of a triangle the first one at its vertex
};

Neighbourhood::Neighbourhood(std::span<const Vec3> vertices, std::span<const Triangle> triangles)
    : vertices_(vertices), triangles_(triangles), fans_(triangles.size()) {
  corners_.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::int32_t v : triangles[i]) corners_.push_back({v, static_cast<std::int32_t>(i)});
  std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.triangle < b.triangle;
  });
  std::size_t first = 0;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    if (corners_[c].vertex != corners_[first].vertex) first = c;
    const auto i = static_cast<std::size_t>(corners_[c].triangle);
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles[i][k] == corners_[c].vertex) fans_[i][k] = static_cast<std::int32_t>(first);
  }
}

NearestOnMesh Neighbourhood::on(std::int32_t triangle, const Vec3& p) const {
  const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
  const auto corner = [&](std::size_t k) { return vertices_[static_cast<std::size_t>(t[k])]; };
  NearestOnMesh result = nearest_on_triangle(p, {corner(0), corner(1), corner(2)});
  result.triangle = triangle;
  return result;
}

NearestOnMesh Neighbourhood::nearest(const Vec3& p, std::int32_t start) const {
  NearestOnMesh best = on(start, p);
  for (bool nearer = true; nearer && best.distance > 0;) {
    nearer = false;
    for (const std::int32_t fan : std::array(fans_[static_cast<std::size_t>(best.triangle)])) {
      const std::int32_t vertex = corners_[static_cast<std::size_t>(fan)].vertex;
      for (auto c = static_cast<std::size_t>(fan); c < corners_.size() && corners_[c].vertex == vertex; ++c) {
        const NearestOnMesh found = on(corners_[c].triangle, p);
        if (!(found.distance < best.distance)) continue;
        best = found;
        nearer = true;
      }
    }
  }
  return best;
}

/// Triangles to be looked up, with the vertices of the mesh that carry the values.
struct Piece {
  TriangleSearch tree;
  std::vector<Triangle> carriers;
  CurvedElements curved;  // none: linear interpolation
  std::int32_t last = 0;
};

Piece piece_of(const FaceMesh& face) {
  std::vector<Vec3> vertices;
  for (const Vec2& p : face.uv) vertices.push_back({p.x(), p.y(), 0});
  std::vector<Triangle> triangles = face.triangles;
  triangles.insert(triangles.end(), face.flattened.begin(), face.flattened.end());
  Piece piece;
  for (const auto& t : triangles) {
    const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
    piece.carriers.push_back({global(0), global(1), global(2)});
  }
  piece.tree = TriangleSearch(vertices, triangles);
  return piece;
}

Piece piece_of(const SurfaceMesh& mesh) {
  Piece piece;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
      piece.carriers.push_back({global(0), global(1), global(2)});
    }
  piece.tree = TriangleSearch(mesh.vertices, piece.carriers);
  return piece;
}

class Transfer {
 public:
  Transfer(const SurfaceMesh& from, const SurfaceMesh& to, std::span<const double> values, std::size_t components)
      : from_(from), to_(to), values_(values), components_(components) {
    at_nodes_ = values.size() == node_count(from) * components;
    const std::size_t rows = at_nodes_ ? node_count(to) : to.vertices.size();
    result_.values.assign(rows * components, 0);
    done_.assign(rows, 0);
    for (const Vec3& p : from.vertices)
      largest_coordinate_ = std::max({largest_coordinate_, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
  }

  TransferredField run() {
    std::map<int, const FaceMesh*> old_faces;
    for (const FaceMesh& face : from_.faces)
      if (!face.triangles.empty()) old_faces.emplace(face.ref, &face);
    // Triangles of independent meshes may be none of (u, v): their vertices are looked up in space.
    const bool by_faces = !from_.independent && !to_.independent;
    for (const FaceMesh& face : to_.faces) {
      const auto old = old_faces.find(face.ref);
      if (old == old_faces.end() || !by_faces) continue;
      Piece piece = piece_of(*old->second);
      if (at_nodes_) piece.curved = CurvedElements(from_, *old->second);
      const Neighbourhood space(from_.vertices, piece.carriers);
      for (std::size_t i = 0; i < face.vertex.size(); ++i)
        look_up(piece, {face.uv[i].x(), face.uv[i].y(), 0}, static_cast<std::size_t>(face.vertex[i]), &space);
      for (std::size_t i = 0; at_nodes_ && i < face.mid_uv.size(); ++i)
        look_up(piece, {face.mid_uv[i].x(), face.mid_uv[i].y(), 0},
                to_.vertices.size() + static_cast<std::size_t>(face.mid_vertex[i]), &space);
    }
    if (std::find(done_.begin(), done_.end(), 0) != done_.end()) {
      Piece whole = piece_of(from_);
      if (at_nodes_) whole.curved = CurvedElements(from_);
      for (std::size_t v = 0; v < done_.size(); ++v) look_up(whole, place_in_space(v), v, nullptr);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Vec3& place_in_space(std::size_t row) const {
    return row < to_.vertices.size() ? to_.vertices[row] : to_.mid_vertices[row - to_.vertices.size()];
  }

  /// `space` is null when p is a point of space.
  void look_up(Piece& piece, Vec3 p, std::size_t vertex, const Neighbourhood* space) {
    if (done_[vertex] != 0) return;
    done_[vertex] = 1;
    NearestOnMesh found = piece.tree.nearest(p, piece.last);
    piece.last = found.triangle;
    if (found.distance > outside_share * piece.tree.longest_edge(found.triangle)) {
      ++result_.outside;
      result_.farthest = std::max(result_.farthest, found.distance);
    }
    bool in_space = space == nullptr;
    if (space != nullptr) {
      const NearestOnMesh nearer = space->nearest(place_in_space(vertex), found.triangle);
      const double away = norm(place_of(piece, found) - place_in_space(vertex));
      if (away > as_near * nearer.distance + place_rounding * largest_coordinate_) found = nearer, in_space = true;
    }
    if (piece.curved.has(found.triangle)) {
      piece.curved.interpolate(found.triangle, in_space ? place_in_space(vertex) : p, in_space, values_, components_,
                               &result_.values[vertex * components_]);
      return;
    }
    const Triangle& carrier = piece.carriers[static_cast<std::size_t>(found.triangle)];
    for (std::size_t c = 0; c < components_; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += found.weight[k] * values_[static_cast<std::size_t>(carrier[k]) * components_ + c];
      result_.values[vertex * components_ + c] = sum;
    }
  }

  [[nodiscard]] Vec3 place_of(const Piece& piece, const NearestOnMesh& found) const {
    const Triangle& carrier = piece.carriers[static_cast<std::size_t>(found.triangle)];
    Vec3 place{};
    for (std::size_t k = 0; k < 3; ++k)
      place = place + found.weight[k] * from_.vertices[static_cast<std::size_t>(carrier[k])];
    return place;
  }

  const SurfaceMesh& from_;
  const SurfaceMesh& to_;
  std::span<const double> values_;
  std::size_t components_;
  bool at_nodes_ = false;  // not at vertices alone
  std::vector<char> done_;
  double largest_coordinate_ = 0;
  TransferredField result_;
};

}  // namespace

std::size_t node_count(const SurfaceMesh& mesh) noexcept { return mesh.vertices.size() + mesh.mid_vertices.size(); }

TransferredField transfer_field(const SurfaceMesh& from, const SurfaceMesh& to, std::span<const double> values,
                                std::size_t components) {
  if (components == 0) throw InvalidArgument("a field to be transferred has one component at least");
  if (values.size() != from.vertices.size() * components && values.size() != node_count(from) * components)
    throw InvalidArgument(
        "a field to be transferred has " + std::to_string(values.size()) + " values; the old mesh has " +
        std::to_string(from.vertices.size()) + " vertices" +
        (from.mid_vertices.empty() ? "" : " and " + std::to_string(from.mid_vertices.size()) + " nodes on edges") +
        ", with " + std::to_string(components) + " values each");
  if (from.triangle_count() == 0) throw InvalidArgument("a field cannot be transferred from a mesh without triangles");
  return Transfer(from, to, values, components).run();
}

InterpolationError interpolation_error(const ScalarField& field, const FieldFunction& exact) {
  check_field(field);
  // Three middles and the centre of each triangle.
  std::vector<Vec3> points;
  std::vector<double> linear;
  points.reserve(4 * field.triangles.size());
  linear.reserve(4 * field.triangles.size());
  for (const auto& t : field.triangles) {
    const auto p = [&](std::size_t k) { return field.vertices[static_cast<std::size_t>(t[k % 3])]; };
    const auto f = [&](std::size_t k) { return field.values[static_cast<std::size_t>(t[k % 3])]; };
    for (std::size_t k = 0; k < 3; ++k) {
      points.push_back(0.5 * (p(k) + p(k + 1)));
      linear.push_back(0.5 * (f(k) + f(k + 1)));
    }
    points.push_back((1.0 / 3) * (p(0) + p(1) + p(2)));
    linear.push_back((f(0) + f(1) + f(2)) / 3);
  }
  std::vector<double> values(points.size());
  exact(points, values);
  InterpolationError error;
  double area = 0, squares = 0;
  for (std::size_t i = 0; i < field.triangles.size(); ++i) {
    const auto& t = field.triangles[i];
    const Vec3 p = field.vertices[static_cast<std::size_t>(t[0])];
    const double a = 0.5 * norm(cross(field.vertices[static_cast<std::size_t>(t[1])] - p,
                                      field.vertices[static_cast<std::size_t>(t[2])] - p));
    area += a;
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = values[4 * i + k];
      check_value(value, "at a point");
      const double away = std::abs(value - linear[4 * i + k]);
      error.largest = std::max(error.largest, away);
      if (k < 3) squares += a / 3 * away * away;
    }
  }
  error.rms = area > 0 ? std::sqrt(squares / area) : 0;
  return error;
}

}  // namespace carreau
