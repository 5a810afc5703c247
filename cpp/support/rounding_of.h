// SPDX-License-Identifier: BSD-3-Clause
// Differences that only rounding makes, for all rooms. Tests of every room rest on them.
#pragma once

namespace carreau::rounding_of {

/// Share of the largest coordinate: the last digits of a number after a few operations. [TriangleTreePlaces, CurvedTransfer, BadModels]
inline constexpr double digits = 1e-14;
/// Share of a length, or of a product of lengths: heights of flat triangles and determinants of parallel vectors, which are differences of
/// products. [FlatTriangles, DeviationBounds, SteepPlaces; any other value changes symmetric meshes by rounding: cocircular vertices]
inline constexpr double heights = 1e-12;
/// Share of an extent: places, barycentric coordinates and cosines after a short calculation. [MeshPlane.IsTheSameBitForBit; 1e-11: 2 of 42
/// meshes change by rounding]
inline constexpr double places = 1e-9;
/// Share of a size: sizes and metrics that hosts calculate, files in single precision (1e-7), angles from normals. [VertexSizes, Glue,
/// SizeRules, BoundSlopes, LocalSearch]
inline constexpr double sizes = 1e-6;

/// Steps of Newton's method from a good beginning. Quadratic convergence takes four to six. [SteepPlaces, FaceGap]
inline constexpr int newton_steps = 8;
/// Steps of a descent from any beginning, and halvings of an interval to 1e-9 of it. They bound work that ends earlier by itself.
/// [Projector.TorusFromItsAxis, BadModels.DerivativesThatVanishOnABorderAreNoJump]
inline constexpr int max_steps = 60, halvings = 30;

}  // namespace carreau::rounding_of
