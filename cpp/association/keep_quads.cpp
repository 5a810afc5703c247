// SPDX-License-Identifier: BSD-3-Clause
#include "association/keep_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "association/harmonic_map.h"
#include "mesh/quality.h"
#include "support/error.h"
#include "support/incidence.h"
#include "support/infinity.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/thresholds.h"
#include "surface/elements/quads/worst_quads.h"

namespace carreau::refining {

namespace {

using Quad = std::array<std::int32_t, 4>;

std::vector<MixedCell> cells_of_face(const FaceMesh& face) {
  std::vector<MixedCell> cells;
  const auto quads = static_cast<std::size_t>(face.quads);
  cells.reserve(face.triangles.size() - quads);
  for (std::size_t k = 0; k < quads; ++k) cells.push_back(face.quad(k));
  for (std::size_t t = 2 * quads; t < face.triangles.size(); ++t) cells.push_back({face.triangles[t][0], face.triangles[t][1], face.triangles[t][2], -1});
  return cells;
}

/// The elements of a divided face on its surface, for WorstQuads. The values of elements are shapes above the kept ones.
class DividedQuads {
 public:
  struct Place {
    Vec2 uv;
    Vec3 xyz;
  };
  /// The steps in (u, v) that are a mean edge long in space, and normal to each other.
  struct Frame {
    Vec2 e1{0, 0}, e2{0, 0};
  };
  static constexpr bool on_surface = false;

  DividedQuads(FaceMesh& face, std::vector<Vec3>& vertices, Cad& cad, bool isotropic, std::vector<char> fixed, std::span<const double> kept)
      : cad_(cad), ref_(face.ref), in_mesh_(face.vertex), vertices_(vertices), isotropic_(isotropic), kept_(kept) {
    patch_.uv = face.uv, patch_.fixed = std::move(fixed), patch_.cells = cells_of_face(face);
    quads_ = static_cast<std::size_t>(face.quads);
  }

  [[nodiscard]] const std::vector<Vec2>& uv() const noexcept { return patch_.uv; }
  [[nodiscard]] const std::vector<MixedCell>& cells() const noexcept { return patch_.cells; }
  [[nodiscard]] std::size_t vertices() const noexcept { return patch_.uv.size(); }
  [[nodiscard]] bool is_fixed(std::size_t v) const noexcept { return patch_.fixed[v] != 0 || in_mesh_[v] < first_free_; }
  /// Lets vertices move whose number in the mesh is no less than `first`.
  void release(std::int32_t first) noexcept { first_free_ = first; }

  [[nodiscard]] static Frame about(const MixedCell& /*cell*/) noexcept { return {}; }
  [[nodiscard]] Frame about(std::int32_t v) {
    if (!around_) around_.emplace(vertices(), closed(patch_.cells));
    double sum = 0, count = 0;
    for (const std::int32_t c : around_->of(v)) {
      const MixedCell& cell = patch_.cells[c];
      for (int k = 0, n = corners_of(cell); k < n; ++k)
        if (cell[k] == v) sum += norm(at(cell[(k + 1) % n]) - at(v)), ++count;
    }
    const SurfaceJet jet = surface_at(cad_, ref_, want_position | want_first, patch_.uv[v]);
    const double mean = sum / count, a = norm(jet.su), b = dot(jet.su, jet.sv) / a, c = norm(jet.sv - (b / a) * jet.su);
    if (!(a > 0) || !(c > 0)) return {};
    return {{mean / a, 0}, {-mean * b / (a * c), mean / c}};
  }
  static Vec2 way(const Frame& frame, const Vec2& y) noexcept { return y.x() * frame.e1 + y.y() * frame.e2; }

  [[nodiscard]] double untangling_quality(const Frame& /*frame*/, const MixedCell& cell) const noexcept {
    if (is_outside_) return -infinity;
    const auto c = static_cast<std::size_t>(&cell - patch_.cells.data());
    const double kept = kept_[c < quads_ ? 2 * c : c + quads_];
    return is_convex(patch_, cell) ? shape(cell) - kept : std::min(turned(cell), 0.0) - 2;
  }

  [[nodiscard]] Place place(std::size_t v) const { return {patch_.uv[v], at(static_cast<std::int32_t>(v))}; }
  void put(std::size_t v, const Place& place) {
    patch_.uv[v] = place.uv, vertices_[in_mesh_[v]] = place.xyz;
    is_outside_ = false;
  }
  void try_at(std::size_t v, const Place& from, const Vec2& way) {
    const Vec2 uv = from.uv + way;
    try {
      put(v, {uv, surface_at(cad_, ref_, want_position, uv).s});
    } catch (const CallbackError&) {
      is_outside_ = true;  // of the domain of the host
    }
  }
  static bool settle(std::size_t /*v*/, const Place& /*from*/) noexcept { return true; }

 private:
  // Triangles name their first corner twice.
  static std::vector<MixedCell> closed(std::vector<MixedCell> cells) {
    for (MixedCell& cell : cells)
      if (cell[3] < 0) cell[3] = cell[0];
    return cells;
  }
  [[nodiscard]] const Vec3& at(std::int32_t v) const { return vertices_[in_mesh_[v]]; }

  [[nodiscard]] double shape(const MixedCell& c) const {
    if (corners_of(c) == 3) return isotropic_ ? quality_q2(at(c[0]), at(c[1]), at(c[2])) : 1;
    const std::array<Vec3, 4> p{at(c[0]), at(c[1]), at(c[2]), at(c[3])};
    return isotropic_ ? min_shape(p) : scaled_jacobian(p);
  }

  // The least sine of the corners' angles in space, with the signs of (u, v).
  [[nodiscard]] double turned(const MixedCell& cell) const {
    double least = 1;
    for (int k = 0, n = corners_of(cell); k < n; ++k) {
      const std::int32_t a = cell[k], b = cell[(k + 1) % n], c = cell[(k + n - 1) % n];
      const Vec3 to = at(b) - at(a), from = at(c) - at(a);
      const double sides = norm(to) * norm(from), sine = sides > 0 ? norm(cross(to, from)) / sides : 0;
      least = std::min(least, orientation(patch_.uv[a], patch_.uv[b], patch_.uv[c]) > 0 ? sine : -sine);
    }
    return least;
  }

  Cad& cad_;
  int ref_;
  const std::vector<std::int32_t>& in_mesh_;
  std::vector<Vec3>& vertices_;
  bool isotropic_;
  std::span<const double> kept_;
  QuadPatch patch_;
  std::size_t quads_ = 0;
  std::int32_t first_free_ = 0;
  std::optional<Incidence> around_;
  bool is_outside_ = false;
};

// Moves vertices in (u, v) until the four corners of each quadrilateral are counterclockwise.
void untangle_cells(DividedQuads& quads) {
  std::vector<std::array<std::int32_t, 3>> corners;
  std::vector<char> fixed(quads.vertices());
  for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = quads.is_fixed(v) ? 1 : 0;
  for (const MixedCell& c : quads.cells())
    for (int k = 0, n = corners_of(c); k < (n == 3 ? 1 : n); ++k) corners.push_back({c[(k + n - 1) % n], c[k], c[(k + 1) % n]});
  if (std::none_of(corners.begin(), corners.end(), [&](const auto& t) { return orientation(quads.uv()[t[0]], quads.uv()[t[1]], quads.uv()[t[2]]) <= 0; })) return;
  std::vector<Vec2> uv = quads.uv();
  (void)untangle(corners, fixed, uv);
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (const Vec2 way = uv[v] - quads.uv()[v]; way != Vec2{0, 0}) quads.try_at(v, quads.place(v), way);
}

}  // namespace

void restore_quads(FaceMesh& face, std::vector<Vec3>& vertices, Cad& cad, bool isotropic, std::vector<char> fixed, std::span<const double> kept,
                   std::int32_t first_new, Monitor& monitor) {
  DividedQuads quads(face, vertices, cad, isotropic, std::move(fixed), kept);
  for (const bool old : {false, true}) {  // vertices of the mesh before move only where new ones do not suffice
    quads.release(old ? 0 : first_new);
    untangle_cells(quads);
    WorstQuads<DividedQuads>(quads, 0, monitor).run();
  }
  if (quads.uv() == face.uv) return;
  face.uv = quads.uv();
  std::vector<Quad> four;
  for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) four.push_back(face.quad(k));
  const std::vector<std::array<std::int32_t, 3>> three(face.triangles.begin() + 2 * static_cast<std::ptrdiff_t>(face.quads), face.triangles.end());
  set_cells(face, four, three, vertices);  // other diagonals may be better
}

TurnedElements find_turned(const FaceMesh& face, const std::vector<Vec3>& vertices) {
  TurnedElements turned;
  const QuadPatch patch{face.uv, {}, cells_of_face(face)};
  for (const MixedCell& c : patch.cells) {
    const auto at = [&](int k) -> const Vec3& { return vertices[face.vertex[c[k]]]; };
    if (!is_convex(patch, c) || (corners_of(c) == 4 && is_turned_over({at(0), at(1), at(2), at(3)})))
      if (++turned.count == 1) turned.first = face.vertex[c[0]];
  }
  return turned;
}

}  // namespace carreau::refining
