// SPDX-License-Identifier: BSD-3-Clause
// Judgement of edits: the triangles that an edit replaces, and the triangles that it would make.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "surface/remesh/base/cross_patch_mesh.h"

namespace carreau {

[[nodiscard]] inline bool has_corner(const EditableMesh::Triangle& t, std::int32_t v) noexcept {
  return t[0] == v || t[1] == v || t[2] == v;
}

/// Member of CrossPatchMesh that judges triangles: judge, judge_shape or judge_agreement.
using Judge = void (CrossPatchMesh::*)(std::int32_t, std::int32_t, std::int32_t, TriangleShapes&) const;

/// Adds the two triangles of a quadrilateral.
void judge_pair(const CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q, Judge judge, TriangleShapes& shapes);
/// Adds the triangles before and after a swap of the diagonal.
void judge_swap(const CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q, Judge judge, Change& change);
/// The four triangles of a split edge.
[[nodiscard]] inline std::array<EditableMesh::Triangle, 4> split_parts(const CrossPatchMesh::Quad& q, std::int32_t m) noexcept {
  return {{{q.a, m, q.c}, {m, q.b, q.c}, {m, q.a, q.d}, {q.b, m, q.d}}};
}
/// Judges a split of the edge at vertex `m` (CrossPatchMesh::try_vertex).
Change judge_split(const CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q, std::int32_t m);
/// Adds the triangles around `gone` that stay, before and after its collapse into `kept`.
void judge_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, Judge judge, Change& change);

/// Place of the surface at the middle of an edge.
std::optional<SurfacePlace> middle_of(CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q);

/// Place in the tangent plane at a regular place: direction `k` of `directions`, at a distance.
[[nodiscard]] Vec3 beside(const SurfacePlace& from, double distance, int k, int directions);

/// Edges at v whose lengths are out of range.
[[nodiscard]] int out_of_range(const CrossPatchMesh& mesh, std::int32_t v);

/// Loss of shapes by a collapse, if the lengths that come into range justify it and the budget has as much left; otherwise nothing.
/// The two triangles that go count as triangles of the mean shape.
[[nodiscard]] std::optional<double> cost_of_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, const Change& change);

}  // namespace carreau
