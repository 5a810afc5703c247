// SPDX-License-Identifier: BSD-3-Clause
// Angles between directions, normals and lines that mean one thing in all rooms.
#pragma once

namespace carreau::angles {

/// Two normals or directions belong together: one smooth corner, one strip. [Gradation.ConeOnASphereOfTwoPatches,
/// Narrow.ThinPlateKeepsItsRim]
inline constexpr double cosine_of_26 = 0.9;
/// Two lines or planes agree: the six neighbours of a vertex of a good mesh leave at most 30 degrees between a front and the next edge.
/// [Gradation.ConeOnATriangulationOfVaryingSize, poles_test, narrow_faces_test]
inline constexpr double cosine_of_45 = 0.7;
/// A line goes on, or a triangle may lie on the surface: at a corner the surface may be turned so far on the way to the middle of a coarse
/// triangle. Around the apex of a narrow cone the best shapes lie in the cross-section. [agreement_test, smoothing_test]
inline constexpr double cosine_of_60 = 0.5;
/// Lengths in a plane of projection are a fifth of lengths on the surface: the limit of a height field. [tests/cpp/atlas, ProjectedMeshes]
inline constexpr double cosine_of_78 = 0.2;
/// A triangle stands upright on the surface, or cells turn over. [AgreementBesideChords.AreNotDividedForEver,
/// LayerRows.RowsOnCoarseFlanksDoNotTurnOver]
inline constexpr double cosine_of_85 = 0.08;
/// Sine or slope. Two surfaces, or two curves, touch rather than cross, or leave a corner as its tip. [FaceGap, Tongues.AreNotCutToTheirTips,
/// CurvedElements.AreValidAtACusp]
inline constexpr double touching = 0.1;

}  // namespace carreau::angles
