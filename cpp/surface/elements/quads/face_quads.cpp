// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/face_quads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cad/batches.h"
#include "periodic/thresholds.h"
#include "support/rounding_of.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/carry/carry_faces.h"
#include "surface/carry/image_vertices.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

using namespace thresholds::quads;

const CurveSide* FaceQuads::side_between(std::int32_t a, std::int32_t b) const noexcept {
  if (patch.fixed[a] == 0 || patch.fixed[b] == 0) return nullptr;  // ends of sides are fixed
  const std::int32_t low = std::min(a, b), high = std::max(a, b);
  const auto found = std::lower_bound(sides.begin(), sides.end(), CurveSide{low, high, 0, 0, 0});
  return found != sides.end() && found->a == low && found->b == high ? &*found : nullptr;
}

bool FaceQuads::is_imposed(std::int32_t a, std::int32_t b) const noexcept {
  return side_between(a, b) != nullptr || std::binary_search(tops.begin(), tops.end(), std::array{std::min(a, b), std::max(a, b)});
}

void set_rows_apart(FaceQuads& quads, std::vector<LayerCell>& layers) {
  std::size_t halves = 0;
  for (const LayerCell& cell : layers) halves += cell.is_triangle() ? 1 : 2;
  std::size_t t = quads.patch.cells.size() - std::min(halves, quads.patch.cells.size());
  const auto is_half = [&](const LayerCell& cell) {
    const MixedCell& half = quads.patch.cells[t++];
    return std::all_of(half.begin(), half.begin() + 3, [&](std::int32_t v) {
      return std::find(cell.corners.begin(), cell.corners.end(), v) != cell.corners.end();
    });
  };
  const bool known = halves <= quads.patch.cells.size() && std::all_of(layers.begin(), layers.end(), [&](const LayerCell& cell) {
                       return is_half(cell) && (cell.is_triangle() || is_half(cell));
                     });
  if (!known) layers.clear();  // shared chords have been divided
  if (!known) return;
  for (const LayerCell& cell : layers) {
    quads.rows.push_back(cell.corners);
    const auto n = static_cast<std::size_t>(corners_of(cell.corners));
    for (std::size_t k = 0; k < n; ++k) {
      const std::int32_t a = cell.corners[k], b = cell.corners[(k + 1) % n];
      quads.patch.fixed[static_cast<std::size_t>(a)] = 1;
      quads.tops.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  quads.patch.cells.resize(quads.patch.cells.size() - halves);
  std::sort(quads.tops.begin(), quads.tops.end());
  quads.tops.erase(std::unique(quads.tops.begin(), quads.tops.end()), quads.tops.end());
}

namespace {

/// An edge of a curve from vertex v to vertex a.
struct Spoke {
  std::int32_t v, a, curve, segment;
  friend auto operator<=>(const Spoke&, const Spoke&) = default;
};

// The tangent of the curve at v, by the parabola through v and its next two vertices.
Vec3 tangent_at(const SurfaceMesh& mesh, const FaceQuads& quads, const Spoke& s) {
  const std::vector<std::int32_t>& on_curve = mesh.curves[s.curve].vertices;
  const Vec3 p = quads.xyz[s.v], q = quads.xyz[s.a];
  const bool forward = on_curve[s.segment] == quads.vertex[s.v];
  const std::ptrdiff_t next = forward ? std::ptrdiff_t{s.segment} + 2 : std::ptrdiff_t{s.segment} - 1;
  const double l = norm(q - p);
  if (next < 0 || next >= std::ssize(on_curve) || !(l > 0)) return q - p;
  const Vec3 r = mesh.vertices[on_curve[next]];
  const double m = norm(r - q);
  if (!(m > 0)) return q - p;
  const Vec3 first = (1 / l) * (q - p), second = (1 / m) * (r - q);
  return first - l / (l + m) * (second - first);
}

// Inside a curve any turn results from its chords, unless it is a kink.
bool go_on_smoothly(const SurfaceMesh& mesh, const FaceQuads& quads, const Spoke& s, const Spoke& t) {
  const bool inside = s.curve == t.curve && std::abs(s.segment - t.segment) == 1;  // not where a closed curve begins
  const Vec3 d = inside ? Vec3(quads.xyz[s.a] - quads.xyz[s.v]) : tangent_at(mesh, quads, s),
             e = inside ? Vec3(quads.xyz[t.a] - quads.xyz[t.v]) : tangent_at(mesh, quads, t);
  const double least = inside ? min_angle_in_curve : min_angle_of_curves;
  return dot(d, e) < std::cos(least * std::numbers::pi / 180) * norm(d) * norm(e);
}

void find_flat_corners(const SurfaceMesh& mesh, FaceQuads& quads) {
  std::vector<Spoke> spokes;
  for (const CurveSide& side : quads.sides) {
    spokes.push_back({side.a, side.b, side.curve, side.segment});
    spokes.push_back({side.b, side.a, side.curve, side.segment});
  }
  std::sort(spokes.begin(), spokes.end());
  for (std::size_t i = 0; i < spokes.size(); ++i)
    for (std::size_t k = i + 1; k < spokes.size() && spokes[k].v == spokes[i].v; ++k) {
      if (!go_on_smoothly(mesh, quads, spokes[i], spokes[k])) continue;
      quads.patch.flat.push_back({spokes[i].v, spokes[i].a, spokes[k].a});
      quads.patch.flat.push_back({spokes[i].v, spokes[k].a, spokes[i].a});
    }
  std::sort(quads.patch.flat.begin(), quads.patch.flat.end());
}

}  // namespace

FaceQuads face_quads(const ElementWork& work, std::size_t face) {
  const SurfaceMesh& mesh = work.result.mesh;
  const FaceMesh& from = mesh.faces[face];
  FaceQuads quads;
  quads.face = face;
  quads.patch.uv = quads.lifted = from.uv;
  quads.patch.fixed.assign(from.uv.size(), 0);
  quads.vertex = from.vertex;
  quads.size.assign(from.uv.size(), -1);
  quads.flattened = from.flattened;
  quads.sides = curve_sides(work, face);
  for (const std::int32_t v : from.vertex) quads.xyz.push_back(mesh.vertices[v]);
  for (const auto& t : from.triangles) quads.patch.cells.push_back({t[0], t[1], t[2], -1});
  for (const CurveSide& side : quads.sides) quads.patch.fixed[side.a] = quads.patch.fixed[side.b] = 1;
  for (const auto& t : from.flattened)
    for (const std::int32_t v : t) quads.patch.fixed[v] = 1;
  for (std::size_t v = 0; v < from.vertex.size(); ++v)
    if (mesh.vertex_ref[from.vertex[v]] != 0) quads.patch.fixed[v] = 1;
  find_flat_corners(mesh, quads);
  return quads;
}

void lift(const ElementWork& work, const ControlSpace* metric, FaceQuads& quads, Monitor& monitor) {
  std::vector<std::int32_t> local;
  std::vector<Vec2> uv;
  const std::size_t known = quads.lifted.size();
  quads.xyz.resize(quads.patch.uv.size()), quads.size.resize(quads.patch.uv.size(), -1);
  for (std::size_t v = 0; v < quads.patch.uv.size(); ++v) {
    const bool is_new = v >= known;
    if (is_new && quads.vertex[v] >= 0) quads.xyz[v] = work.result.mesh.vertices[quads.vertex[v]];
    if (is_new ? quads.vertex[v] >= 0 : quads.lifted[v] == quads.patch.uv[v]) continue;
    local.push_back(static_cast<std::int32_t>(v));
    uv.push_back(quads.patch.uv[v]);
  }
  const auto use = [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
    for (std::size_t k = 0; k < here.size(); ++k) {
      quads.xyz[local[first + k]] = jets[k].s;
      quads.size[local[first + k]] = metric != nullptr ? geometric_mean_size(jets[k], metric->at(here[k])) : 0;
    }
  };
  const int ref = work.result.mesh.faces[quads.face].ref;
  for_batches(work.cad(), ref, want_position | (metric != nullptr ? want_first : 0U), uv, monitor, use);
  quads.lifted = quads.patch.uv;
}

namespace {

/// Drops unused local vertices.
void compact(FaceQuads& quads) {
  quads.patch.cells.insert(quads.patch.cells.end(), quads.rows.begin(), quads.rows.end());
  const std::size_t n = quads.patch.uv.size();
  std::vector<std::int32_t> now(n, -1);
  for (const MixedCell& cell : quads.patch.cells)
    for (int k = 0; k < corners_of(cell); ++k) now[cell[k]] = 0;
  std::int32_t count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (now[v] < 0 && quads.patch.fixed[v] == 0) continue;
    now[v] = count;
    quads.patch.uv[count] = quads.patch.uv[v], quads.vertex[count] = quads.vertex[v];
    quads.xyz[count] = quads.xyz[v], quads.size[count] = quads.size[v];
    ++count;
  }
  const auto size = static_cast<std::size_t>(count);
  quads.patch.uv.resize(size), quads.vertex.resize(size), quads.xyz.resize(size), quads.size.resize(size);
  for (MixedCell& cell : quads.patch.cells)
    for (int k = 0; k < corners_of(cell); ++k) cell[k] = now[cell[k]];
  for (auto& t : quads.flattened)
    for (std::int32_t& v : t) v = now[v];
  quads.now = std::move(now);
}

// Fills sizes where no metric is known, with the lengths of the edges there.
void find_missing_sizes(FaceQuads& quads) {
  if (std::find(quads.size.begin(), quads.size.end(), 0.) == quads.size.end()) return;
  std::vector<double> sum(quads.size.size(), 0), count(quads.size.size(), 0);
  for (const MixedCell& cell : quads.patch.cells)
    for (int k = 0, n = corners_of(cell); k < n; ++k)
      for (const std::int32_t v : {cell[k], cell[(k + 1) % n]})
        sum[v] += norm(quads.xyz[cell[(k + 1) % n]] - quads.xyz[cell[k]]), ++count[v];
  for (std::size_t v = 0; v < quads.size.size(); ++v)
    if (quads.size[v] == 0 && count[v] > 0) quads.size[v] = sum[v] / count[v];
}

void put_back(FaceQuads& quads, CompositeResult& result) {
  SurfaceMesh& mesh = result.mesh;
  FaceMesh& face = mesh.faces[quads.face];
  for (std::size_t v = 0; v < quads.vertex.size(); ++v) {
    std::int32_t& in_mesh = quads.vertex[v];
    if (in_mesh < 0) {
      in_mesh = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(quads.xyz[v]), mesh.vertex_ref.push_back(0);
      result.vertex_size.push_back(quads.size[v]);
      continue;
    }
    if (quads.size[v] >= 0) mesh.vertices[in_mesh] = quads.xyz[v], result.vertex_size[in_mesh] = quads.size[v];
  }
  face.uv = std::move(quads.patch.uv);
  face.vertex = std::move(quads.vertex);
  face.flattened = std::move(quads.flattened);
  std::vector<std::array<std::int32_t, 4>> four;
  std::vector<std::array<std::int32_t, 3>> three;
  for (const MixedCell& c : quads.patch.cells) {
    if (corners_of(c) == 4)
      four.push_back(c);
    else
      three.push_back({c[0], c[1], c[2]});
  }
  set_cells(face, four, three, mesh.vertices);
}

}  // namespace

void put_back(std::vector<FaceQuads>& faces, CompositeResult& result) {
  for (FaceQuads& quads : faces) {
    find_missing_sizes(quads);
    compact(quads);
    put_back(quads, result);
  }
  (void)drop_unused(result);
  part_equal_diagonals(result.mesh);
}

namespace {

std::int32_t image_of(SlaveQuads& quads, std::int32_t v) {
  if (static_cast<std::size_t>(v) >= quads.image.size()) quads.image.resize(quads.master->patch.uv.size(), -1);
  std::int32_t& image = quads.image[v];
  if (image >= 0) return image;
  FaceQuads& slave = *quads.slave;
  image = static_cast<std::int32_t>(slave.patch.uv.size());
  slave.patch.uv.push_back(slave.patch.uv.front());
  slave.patch.fixed.push_back(0);
  slave.vertex.push_back(-1);
  return image;
}

// The first corner stays the first one.
int corner_of(int k, int n, bool flipped) { return flipped ? (n - k) % n : k; }

}  // namespace

void copy_cells(SlaveQuads& quads) {
  std::vector<MixedCell> cells;
  for (const MixedCell& cell : quads.master->patch.cells) {
    MixedCell image{-1, -1, -1, -1};
    for (int k = 0, n = corners_of(cell); k < n; ++k) image[k] = image_of(quads, cell[corner_of(k, n, quads.pair->flipped)]);
    cells.push_back(image);
  }
  quads.slave->patch.cells = std::move(cells);
}

// A cell with corners c and middles m of the sides behind them is cut into (c[k], m[k], centre, m[k - 1]).
void match_halves(const std::vector<int>& corners, SlaveQuads& quads) {
  const bool flipped = quads.pair->flipped;
  quads.image.resize(quads.master->patch.uv.size(), -1);
  std::size_t first = 0;
  for (const int n : corners) {
    for (int k = 0; k < n; ++k) {
      const MixedCell& there = quads.slave->patch.cells[first + k];
      const MixedCell& here = quads.master->patch.cells[first + static_cast<std::size_t>(corner_of(k, n, flipped))];
      for (int i = 0; i < 4; ++i) quads.image[here[corner_of(i, 4, flipped)]] = there[i];
    }
    first += static_cast<std::size_t>(n);
  }
  for (std::size_t t = 0; t < quads.master->flattened.size() && t < quads.slave->flattened.size(); ++t)
    for (int i = 0; i < 3; ++i) quads.image[quads.master->flattened[t][corner_of(i, 3, flipped)]] = quads.slave->flattened[t][i];
}

void place_cells(const ElementWork& work, SlaveQuads& quads) {
  const FaceQuads& master = *quads.master;
  FaceQuads& slave = *quads.slave;
  const std::size_t n = slave.patch.uv.size(), known = slave.xyz.size();
  slave.xyz.resize(n), slave.size.resize(n, -1);
  for (std::size_t v = known; v < n; ++v)
    if (slave.vertex[v] >= 0) slave.xyz[v] = work.result.mesh.vertices[slave.vertex[v]];
  std::vector<std::int32_t> source(n, -1), rank(n, -1), of;
  for (std::size_t v = 0; v < quads.image.size(); ++v)
    if (quads.image[v] >= 0) source[quads.image[v]] = static_cast<std::int32_t>(v);
  ImageVertices vertices{.cad = work.cad(), .face = work.result.mesh.faces[slave.face].ref, .target = {}, .from_uv = {}, .known = {}};
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz;
  for (std::size_t w = 0; w < n; ++w) {
    const std::int32_t v = source[w];
    if (v < 0) continue;  // no cell has it
    const bool known_place = slave.patch.fixed[w] != 0 && slave.vertex[w] >= 0;  // middles beside poles are fixed, and not placed yet
    rank[w] = static_cast<std::int32_t>(of.size());
    of.push_back(static_cast<std::int32_t>(w));
    vertices.target.push_back(known_place ? slave.xyz[w] : quads.pair->map(master.xyz[v]));
    vertices.from_uv.push_back(master.patch.uv[v]), vertices.known.push_back(known_place ? 1 : 0);
    if (!known_place) slave.size[w] = master.size[v] >= 0 ? master.size[v] : work.result.vertex_size[master.vertex[v]];
    uv.push_back(slave.patch.uv[w]), xyz.push_back(slave.xyz[w]);
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const MixedCell& c : slave.patch.cells) {
    triangles.push_back({c[0], c[1], c[2]});
    if (corners_of(c) == 4) triangles.push_back({c[0], c[2], c[3]});
  }
  for (auto& t : triangles)
    for (std::int32_t& w : t) w = rank[w];
  place_images(vertices, triangles, rounding_of::places * work.periodic->gap, uv, xyz);
  for (std::size_t i = 0; i < of.size(); ++i) slave.patch.uv[of[i]] = uv[i], slave.xyz[of[i]] = xyz[i];
  slave.lifted = slave.patch.uv;
}

void carry_back(const SlaveQuads& quads, SurfaceMesh& mesh) {
  const FaceMesh& from = mesh.faces[quads.master->face];
  std::vector<std::int32_t> image(from.uv.size(), -1);
  for (std::size_t v = 0; v < quads.image.size() && v < quads.master->now.size(); ++v)
    if (quads.master->now[v] >= 0 && quads.image[v] >= 0) image[quads.master->now[v]] = quads.slave->now[quads.image[v]];
  carry_elements(from, image, quads.pair->flipped, mesh.faces[quads.slave->face]);
}

}  // namespace carreau
