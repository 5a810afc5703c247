// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

#include <cstddef>

namespace carreau::thresholds::patches {

// A face meshed again (face_job)
/// Times that a patch is meshed again because the lift disagrees.
/// [Verification.DipsOfTheSizesThatNoSampleHitsAreMeshed]
inline constexpr int max_corrections = 3;
/// Ratio of triangles. A mesh with a larger ratio has not missed a place: its sizes are wrong nearly everywhere.
/// [BadModels.SurfaceThatJumpsInManyPlaces]
inline constexpr double max_growth = 1000;
/// Tangent of the angle by which triangles may lean if long sizes are bounded for it: a ninth more area at worst.
/// [Leaning.TrianglesOfRatio100LieOnTheSurface]
inline constexpr double max_lean = 0.5;
/// Ratio by which sizes then grow from one edge to the next: at lines of zero curvature they would jump.
/// [Leaning.ShortEdgesAreNotBounded]
inline constexpr double gentle = 1.5;
/// Ratio of triangles of a mesh that follows the surface so. [Leaning.TrianglesOfRatio100LieOnTheSurface]
inline constexpr double max_growth_bounded = 64;

// Short edges (patch_step)
/// Share of the size prescribed at both ends. Sizes grow from edges that are shorter than this share. A curve cut into
/// one edge or into several has edges of at least 0.7 and 0.8 of the prescribed size.
/// [ShortEdges.WithoutThemNothingChanges]
inline constexpr double short_share = 0.7;

// Guarantees (curve_steps)
/// Halvings of an edge that leaves its curve: to a sixteenth of a unit edge. [CurveAccuracy.*]
inline constexpr int max_curve_halvings = 4;

}  // namespace carreau::thresholds::patches

namespace carreau::thresholds::crossings {

// Triangles that cross (crossing_inspector). [CloseWalls.*]

/// Triangles of the patches that are kept for the next round, some 60 bytes each; a larger model makes all of them
/// again.
inline constexpr std::size_t max_known = 2'000'000;
/// Pairs of triangles that are checked; a model whose parts share places has as many pairs as triangles there.
inline constexpr std::size_t max_pairs = 100'000;
/// Projections from one face to the other and back. The first one finds the distance of parallel faces.
/// [FaceGap.ConcentricCylindersHaveTheDifferenceOfTheirRadii]
inline constexpr int projections = 3;
/// Share of the gap that the larger sagitta may fill. [CloseWalls.ThatCrossByTheirChordsAreParted]
inline constexpr double sagitta_share = 0.5;
/// Shares of the longest edge of a triangle that crosses another triangle. If a gap needs less than the smaller one, no
/// mesh of the prescribed size shows it: the faces meet.
inline constexpr double min_share = 0.125, max_share = 0.6;
/// Share of an edge times the sine between both surfaces. Surfaces nearer to each other meet beside the triangles that
/// cross. [without it the teapot, whose spout crosses its body, is meshed again at .3]
inline constexpr double min_width = 0.05;
/// Triangles whose making costs as much as all that a face costs whatever its triangles are (sampling, borders).
inline constexpr double work_per_face = 300;
/// Ratio of a face's work in a round to its work before, for as many triangles: its sizes vary now, so that its metric is
/// sampled. [measured on assemblies of 180 and 1 300 faces: 2.3 to 4.4]
inline constexpr double work_of_varied_sizes = 3;
/// Work of all rounds, in triangles, if the first mesh took less: some 50 ms.
inline constexpr double min_budget = 24'000;
/// Share of the first mesh's work that a round beside rows costs whatever faces it meshes: assembly, nodes, crossings.
/// [measured on a bottle and a screw: .3 to .4]
inline constexpr double share_of_any_round = 0.35;

}  // namespace carreau::thresholds::crossings
