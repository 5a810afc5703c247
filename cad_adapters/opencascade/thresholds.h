// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the adapter: meaning, unit, reason and evidence.
#pragma once

namespace carreau_occ::thresholds {

// Gaps in loops (loop_gaps). In brackets: the tests that rest on it, of tests/adapters/loops_test.cpp.

/// Share of the diagonal. A wider gap between two curves of a loop gets an edge: the engine takes ends that are nearer
/// as one point. [LoopGaps.*]
inline constexpr double wide_gap = 1.0 / 100;
/// Share of the shorter curve beside a gap, and of the diagonal. A gap above both gets an edge, too: the engine joins
/// ends within a quarter of the shortest curve. [LoopGaps.*]
inline constexpr double gap_beside_curve = 0.2, narrow_gap = 1.0 / 400;
/// Share of the gap between a curve in space and its image on the surface. An image is wrong where the curve in space
/// lies so much nearer to the surface than to its image. [LoopGaps.WrongImagesAreMadeAnew]
inline constexpr double wrong_image = 0.1;

// Tolerance of references (brep_host)

/// Share of the diagonal. Uses of one edge, and ends of one vertex, may be so far apart. Gmsh meshes a shape of
/// OpenCASCADE's own data with gaps of 5.6 per cent. [LoopGaps.FacesThatMissTheirEdgesAreMeshed]
inline constexpr double match_share = 0.06;

// Parts that share faces (imprint)

/// Share of the volume of a solid. OpenCASCADE integrates divided curved faces with errors near a millionth; a fuse that
/// loses a piece changes more. [Imprint.VolumesStay]
inline constexpr double imprint_volume = 1e-4;

// Mirror planes (mirror)

/// Share of the diagonal. Files give places with six digits at least; a face that reaches less far beyond the plane ends on it.
/// [CommandMirror.*]
inline constexpr double in_mirror = 1e-6;
/// Share of the diagonal by which the other half may miss the image of the half that stays: tolerances of usual files. [CommandMirror.*]
inline constexpr double symmetric = 1e-5;

}  // namespace carreau_occ::thresholds
