// SPDX-License-Identifier: BSD-3-Clause
#include "io/solid_skin.h"

#include <algorithm>

namespace carreau {

namespace {

using LocalEdge = std::array<int, 2>;
using LocalFace = std::array<int, 4>;  // -1: a triangle

struct ShapeTable {
  std::vector<LocalFace> faces;
  std::vector<LocalEdge> edges;
};

const ShapeTable& shape_table(SolidShape shape) {
  static const std::array<ShapeTable, 4> tables{{
      {{{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}}, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
      {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
      {{{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
       {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
      {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
  }};
  return tables[static_cast<std::size_t>(shape)];
}

/// A face by its corners, whatever way it runs.
struct SolidFace {
  std::array<std::int32_t, 4> sorted{-1, -1, -1, -1};
  std::size_t solid = 0;
  int face = 0;
};

/// Local corners of a face without repetitions of the previous corner.
std::vector<int> corners_of(const LocalFace& face, std::span<const std::int32_t> nodes) {
  std::vector<int> corners;
  const auto node = [&](int k) { return nodes[static_cast<std::size_t>(k)]; };
  for (const int k : face)
    if (k >= 0 && std::ranges::none_of(corners, [&](int other) { return node(other) == node(k); })) corners.push_back(k);
  return corners;
}

/// Rank of the edge in the table.
std::size_t edge_rank(const std::vector<LocalEdge>& edges, int a, int b) {
  const auto found = std::ranges::find_if(edges, [&](const LocalEdge& e) {
    return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
  });
  return static_cast<std::size_t>(found - edges.begin());
}

Vec3 mean_of(std::span<const std::int32_t> nodes, const std::vector<Vec3>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : nodes) sum += vertices[static_cast<std::size_t>(v)];
  return sum / static_cast<double>(nodes.size());
}

/// The normal of a face points away from the centre of its solid, in whatever order a program lists corners.
bool is_inward(const std::vector<std::int32_t>& corners, const Vec3& centre, const std::vector<Vec3>& vertices) {
  const auto at = [&](std::size_t k) -> const Vec3& { return vertices[static_cast<std::size_t>(corners[k])]; };
  const Vec3 normal = corners.size() == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
  return dot(normal, mean_of(corners, vertices) - centre) < 0;
}

}  // namespace

void SolidSkin::add(SolidShape shape, std::span<const std::int32_t> nodes, std::int32_t ref) {
  const bool straight = nodes.size() < quadratic_count(shape);
  straight_ = straight_ || straight;
  solids_.push_back({shape, nodes_.size(), ref});
  const std::size_t kept = straight ? corner_count(shape) : quadratic_count(shape);
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(kept));
}

std::vector<SkinFace> SolidSkin::faces(const std::vector<Vec3>& vertices) const {
  const auto corners = [&](const Solid& solid) {
    return std::span(nodes_).subspan(solid.start, corner_count(solid.shape));
  };
  std::vector<SolidFace> known;
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const std::vector<LocalFace>& faces = shape_table(solids_[s].shape).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const std::vector<int> own = corners_of(faces[f], corners(solids_[s]));
      if (own.size() < 3) continue;
      SolidFace& each = known.emplace_back();
      each.solid = s, each.face = static_cast<int>(f);
      for (std::size_t k = 0; k < own.size(); ++k) each.sorted[k] = corners(solids_[s])[static_cast<std::size_t>(own[k])];
      std::ranges::sort(each.sorted);
    }
  }
  std::ranges::stable_sort(known, {}, &SolidFace::sorted);
  std::vector<SolidFace> outer;
  for (std::size_t k = 0, end = 0; k < known.size(); k = end) {
    while (end < known.size() && known[end].sorted == known[k].sorted) ++end;
    if (end == k + 1) outer.push_back(known[k]);
  }
  std::ranges::sort(outer, {}, [](const SolidFace& each) { return std::pair(each.solid, each.face); });
  std::vector<SkinFace> skin;
  for (const SolidFace& each : outer) {
    const Solid& solid = solids_[each.solid];
    const ShapeTable& shape = shape_table(solid.shape);
    std::vector<int> local = corners_of(shape.faces[static_cast<std::size_t>(each.face)], corners(solid));
    const auto node = [&](std::size_t k) { return nodes_[solid.start + k]; };
    std::vector<std::int32_t> own;
    for (const int k : local) own.push_back(node(static_cast<std::size_t>(k)));
    if (is_inward(own, mean_of(corners(solid), vertices), vertices))
      std::ranges::reverse(local), std::ranges::reverse(own);
    const std::size_t n = own.size();
    for (std::size_t k = 0; k < n && !straight_; ++k)
      own.push_back(node(corner_count(solid.shape) + edge_rank(shape.edges, local[k], local[(k + 1) % n])));
    SkinFace& face = skin.emplace_back();
    face.solid = each.solid, face.ref = solid.ref;
    face.cell.kind = n == 3 ? (straight_ ? CellKind::triangle3 : CellKind::triangle6)
                            : (straight_ ? CellKind::quad4 : CellKind::quad8);
    std::ranges::copy(own, face.cell.nodes.begin());
  }
  return skin;
}

void SolidSkin::give_to(ElementLists& lists, const std::vector<Vec3>& vertices) const {
  if (!lists.triangles.nodes.empty() || !lists.triangles6.nodes.empty() || !lists.quads.nodes.empty() ||
      !lists.quads8.nodes.empty())
    return;
  const auto append = [](const SkinFace& face, auto& list) {
    auto& own = list.nodes.emplace_back();
    std::copy_n(face.cell.nodes.begin(), own.size(), own.begin());
    list.refs.push_back(face.ref);
  };
  for (const SkinFace& face : faces(vertices)) {
    if (face.cell.kind == CellKind::triangle3) append(face, lists.triangles);
    if (face.cell.kind == CellKind::triangle6) append(face, lists.triangles6);
    if (face.cell.kind == CellKind::quad4) append(face, lists.quads);
    if (face.cell.kind == CellKind::quad8) append(face, lists.quads8);
  }
}

}  // namespace carreau
