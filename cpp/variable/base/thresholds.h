// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::variable {

// Tools
/// Degrees. Arcs of tools have a node at least so often: a piece may touch them between its own nodes.
/// [Contact.ToolNodesBetweenNodesOfThePieceAreInserted]
inline constexpr double arc_node_angle = 15;

// Contact
/// Ratio of the tool's path between two bound nodes to their distance, beyond which the edge does not follow the tool.
/// It bridges a notch, or its ends are on two sides of a thin tool. [Contact.EdgesFollowTheTool]
inline constexpr double longest_path = 3;
/// Share of h_min. Bound nodes as near as this become one: they fell together on a corner.
/// [Contact.EdgesFollowTheTool]
inline constexpr double crowded = 0.05;
/// Share of h_min. A tool's node that is as near to a node of the piece moves it; one that is farther becomes a
/// separate node. [Contact.ToolNodesBetweenNodesOfThePieceAreInserted]
inline constexpr double takes_along = 0.3;
/// The ratio up to which an edge follows the tool although it does not cut into it, for example in a hollow: 1.1 is an
/// arc of 85 degrees. [Contact.EdgesFollowTheTool]
inline constexpr double straight_path = 1.1;

// Boundary
/// Share of h_min. Ends of runs that are nearer than this become one: shorter edges would stay for ever.
/// [BoundaryRuns.EndsThatAreTooCloseBecomeOne]
inline constexpr double closest_ends = 0.4;
/// Degrees. A triangle with such an angle between equal sides has a Q2 of .43; boundary edges beside sharper tips leave
/// worse ones. [BoundaryRuns.TipsAreCut]
inline constexpr double sharpest_tip = 15;
/// Share of the chord. A spline that leaves its chord by more was misled by its nodes: the run stays a polygon. An arc
/// that turns by 45 degrees leaves its chord by 0.1. [RunCurve.WildSplinesArePolygons]
inline constexpr double largest_bulge = 0.15;

/// Times that crossing runs of new edges get their old nodes back, before all runs do.
/// [Remesh.RunsThatCrossKeepTheirNodes]
inline constexpr std::size_t max_rough_places = 12;

// Sizes
/// Share of the prescribed size. Steps in which the size along the boundary is sampled. [BoundaryCut.HasUnitEdges]
inline constexpr double size_step = 0.5;
/// Share of the prescribed size. Shorter boundary edges prescribe smaller triangles beside them.
/// [Remesh.ShortEdgesAreGradedInwards]
inline constexpr double short_edge = 0.8;

}  // namespace carreau::thresholds::variable
