// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "adapt/curved_elements.h"
#include "adapt/thresholds.h"
#include "mesh/triangle_search.h"
#include "size/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"
#include "support/work_sizes.h"

namespace carreau {

namespace {

using namespace thresholds::adapt;

using thresholds::size::outside_share;  // as for background meshes

using Triangle = std::array<std::int32_t, 3>;

/// From a triangle to the nearest one in space, step by step through triangles that share a vertex of the mesh, seams
/// and poles included. The steps do not reach another sheet of the face, so sheets are not mixed up.
class Neighbourhood {
 public:
  /// Keeps references.
  Neighbourhood(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
  /// The point where steps from triangle `start` end: no triangle around is nearer to p.
  [[nodiscard]] NearestOnMesh nearest(const Vec3& p, std::int32_t start) const;

 private:
  struct Corner {
    std::int32_t vertex, triangle;
  };
  [[nodiscard]] NearestOnMesh on(std::int32_t triangle, const Vec3& p) const;
  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<Corner> corners_;                    // vertex by vertex: a face has few of the mesh's vertices
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
  CurvedElements curved;                // none: linear interpolation
  std::optional<Neighbourhood> around;  // in space; none: the tree is of space
};

std::unique_ptr<const Piece> piece_of(const SurfaceMesh& mesh, const FaceMesh& face, bool at_nodes) {
  std::vector<Vec3> vertices;
  for (const Vec2& p : face.uv) vertices.push_back({p.x(), p.y(), 0});
  std::vector<Triangle> triangles = face.triangles;
  triangles.insert(triangles.end(), face.flattened.begin(), face.flattened.end());
  auto piece = std::make_unique<Piece>();
  for (const auto& t : triangles) {
    const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
    piece->carriers.push_back({global(0), global(1), global(2)});
  }
  piece->tree = TriangleSearch(vertices, triangles);
  if (at_nodes) piece->curved = CurvedElements(mesh, face);
  piece->around.emplace(mesh.vertices, piece->carriers);
  return piece;
}

std::unique_ptr<const Piece> piece_of(const SurfaceMesh& mesh, bool at_nodes) {
  auto piece = std::make_unique<Piece>();
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
      piece->carriers.push_back({global(0), global(1), global(2)});
    }
  piece->tree = TriangleSearch(mesh.vertices, piece->carriers);
  if (at_nodes) piece->curved = CurvedElements(mesh);
  return piece;
}

/// Pieces that are being looked up in, made by the first thread that needs one.
class Pieces {
 public:
  /// Calls make(i) once when piece i is first needed, and again if the piece has been discarded. `kept` are the most that are at hand at a
  /// time.
  Pieces(std::function<std::unique_ptr<const Piece>(std::size_t)> make, std::size_t kept)
      : make_(std::move(make)), kept_(kept) {}

  std::shared_ptr<const Piece> at(std::size_t i) {
    std::shared_ptr<Slot> slot;
    {
      const std::scoped_lock lock(mutex_);
      auto& known = slots_[i];
      if (!known) known = std::make_shared<Slot>();
      slot = known;
      if (slots_.size() > kept_) slots_.erase(slots_.begin()->first == i ? std::next(slots_.begin()) : slots_.begin());
    }
    std::call_once(slot->made, [&] { slot->piece = make_(i); });
    return {slot, slot->piece.get()};
  }

 private:
  struct Slot {
    std::once_flag made;
    std::unique_ptr<const Piece> piece;
  };
  std::function<std::unique_ptr<const Piece>(std::size_t)> make_;
  std::size_t kept_;
  std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<Slot>> slots_;
};

/// A row of the new mesh, and the place at which it is looked up.
struct Wanted {
  std::size_t row;
  Vec3 p;  // of the parameter plane or of space
};

class Transfer {
 public:
  Transfer(const SurfaceMesh& from, const SurfaceMesh& to, std::span<const double> values, std::size_t components)
      : from_(from), to_(to), values_(values), components_(components) {
    at_nodes_ = values.size() == node_count(from) * components;
    for (const Vec3& p : from.vertices)
      largest_coordinate_ = std::max({largest_coordinate_, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    list_rows();
  }

  TransferredField run(const Executor& executor, Monitor& monitor) {
    Pieces pieces([&](std::size_t i) { return old_faces_[i] != nullptr ? piece_of(from_, *old_faces_[i], at_nodes_) : piece_of(from_, at_nodes_); },
                  static_cast<std::size_t>(std::max(executor.threads, 1)) + 1);
    const std::size_t width = components_ + 1;
    const auto look_up = [&](std::size_t first, std::size_t last, double* out, Monitor& of_task) {
      std::int32_t guess = 0;
      std::shared_ptr<const Piece> piece;
      for (std::size_t k = first, at = pieces_.size(); k < last; ++k, out += width) {
        if (k % work_sizes::evaluations == 0) of_task.checkpoint();
        if (const std::size_t now = piece_with(k); !piece || now != at) piece = pieces.at(at = now), guess = 0;
        look_up_in(*piece, rows_[k], guess, out);
      }
    };
    const std::vector<double> found = shared_rows(
        executor, "fields on the next mesh", {.count = rows_.size(), .width = width, .at_once = work_sizes::piece_of(rows_.size())}, look_up, monitor);
    return gathered(found, width);
  }

 private:
  // Looks each row up in the first face of both meshes that has it, or in space.
  void list_rows() {
    const std::size_t all = at_nodes_ ? node_count(to_) : to_.vertices.size();
    std::vector<char> listed(all, 0);
    const auto list = [&](std::size_t row, const Vec3& p) {
      if (listed[row] == 0) rows_.push_back({row, p});
      listed[row] = 1;
    };
    std::map<int, const FaceMesh*> old_faces;
    for (const FaceMesh& face : from_.faces)
      if (!face.triangles.empty()) old_faces.emplace(face.ref, &face);
    // Triangles of independent meshes may have no place in (u, v): their vertices are looked up in space.
    const bool by_faces = !from_.independent && !to_.independent;
    for (const FaceMesh& face : to_.faces) {
      const auto old = old_faces.find(face.ref);
      if (old == old_faces.end() || !by_faces) continue;
      pieces_.push_back(rows_.size()), old_faces_.push_back(old->second);
      for (std::size_t i = 0; i < face.vertex.size(); ++i)
        list(static_cast<std::size_t>(face.vertex[i]), {face.uv[i].x(), face.uv[i].y(), 0});
      for (std::size_t i = 0; at_nodes_ && i < face.mid_uv.size(); ++i)
        list(to_.vertices.size() + static_cast<std::size_t>(face.mid_vertex[i]), {face.mid_uv[i].x(), face.mid_uv[i].y(), 0});
    }
    pieces_.push_back(rows_.size()), old_faces_.push_back(nullptr);
    for (std::size_t row = 0; row < all; ++row) list(row, place_in_space(row));
  }

  [[nodiscard]] std::size_t piece_with(std::size_t row) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(pieces_, row) - pieces_.begin()) - 1;
  }

  [[nodiscard]] const Vec3& place_in_space(std::size_t row) const {
    return row < to_.vertices.size() ? to_.vertices[row] : to_.mid_vertices[row - to_.vertices.size()];
  }

  /// Writes values, then the distance if the vertex is outside, else 0.
  void look_up_in(const Piece& piece, const Wanted& wanted, std::int32_t& guess, double* out) const {
    NearestOnMesh found = piece.tree.nearest(wanted.p, guess);
    guess = found.triangle;
    out[components_] = found.distance > outside_share * piece.tree.longest_edge(found.triangle) ? found.distance : 0;
    bool in_space = !piece.around;
    if (piece.around) {
      const NearestOnMesh nearer = piece.around->nearest(place_in_space(wanted.row), found.triangle);
      const double away = norm(place_of(piece, found) - place_in_space(wanted.row));
      if (away > as_near * nearer.distance + rounding_of::digits * largest_coordinate_) found = nearer, in_space = true;
    }
    if (piece.curved.has(found.triangle)) {
      piece.curved.interpolate(found.triangle, in_space ? place_in_space(wanted.row) : wanted.p, in_space, values_, components_, out);
      return;
    }
    const Triangle& carrier = piece.carriers[static_cast<std::size_t>(found.triangle)];
    for (std::size_t c = 0; c < components_; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += found.weight[k] * values_[static_cast<std::size_t>(carrier[k]) * components_ + c];
      out[c] = sum;
    }
  }

  [[nodiscard]] TransferredField gathered(const std::vector<double>& found, std::size_t width) const {
    TransferredField result;
    result.values.resize(rows_.size() * components_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double* const row = found.data() + width * k;
      std::copy_n(row, components_, result.values.data() + rows_[k].row * components_);
      if (row[components_] > 0) ++result.outside;
      result.farthest = std::max(result.farthest, row[components_]);
    }
    return result;
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
  double largest_coordinate_ = 0;
  std::vector<Wanted> rows_;                // piece by piece
  std::vector<std::size_t> pieces_;         // their first rows
  std::vector<const FaceMesh*> old_faces_;  // of pieces; null: the whole mesh in space
};

}  // namespace

std::size_t node_count(const SurfaceMesh& mesh) noexcept { return mesh.vertices.size() + mesh.mid_vertices.size(); }

TransferredField transfer_field(const SurfaceMesh& from, const SurfaceMesh& to, std::span<const double> values,
                                std::size_t components, const Executor& executor, Monitor* monitor) {
  if (components == 0) throw InvalidArgument("a field to be transferred has one component at least");
  if (values.size() != from.vertices.size() * components && values.size() != node_count(from) * components)
    throw InvalidArgument(
        "a field to be transferred has " + std::to_string(values.size()) + " values; the old mesh has " +
        std::to_string(from.vertices.size()) + " vertices" +
        (from.mid_vertices.empty() ? "" : " and " + std::to_string(from.mid_vertices.size()) + " nodes on edges") +
        ", with " + std::to_string(components) + " values each");
  if (from.triangle_count() == 0) throw InvalidArgument("a field cannot be transferred from a mesh without triangles");
  Monitor silent;
  return Transfer(from, to, values, components).run(executor, monitor != nullptr ? *monitor : silent);
}

InterpolationError interpolation_error(const ScalarField& field, const FieldFunction& exact, double relative_floor) {
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
  const double floor = relative_floor * largest_value(field.values);
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
      if (away > 0) error.largest_share = std::max(error.largest_share, away / std::max(std::abs(value), floor));
      if (k < 3) squares += a / 3 * away * away;
    }
  }
  error.rms = area > 0 ? std::sqrt(squares / area) : 0;
  return error;
}

}  // namespace carreau
