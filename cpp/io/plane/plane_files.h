// SPDX-License-Identifier: BSD-3-Clause
// Files of plane domains: Triangle's .poly, plane meshes whose edges are the boundary, BL2D's .data and .g.
#pragma once

#include <string>
#include <string_view>

#include "geometry/plane/plane_domain.h"
#include "io/medit/sol_files.h"
#include "mesh/flat_mesh.h"

namespace carreau {

/// The angle in degrees up to which polygons of a file become splines: at an end of exactly two edges of one reference
/// that turn by no more.
inline constexpr double usual_corner_angle = 50;

/// Reads by suffix: .poly (with the points of a .node beside it when it has none), .node, .dat (airfoils), .mesh or
/// .meshb, .bl2d, .data. Also .g, with the sizes of a .hg beside it if there is one. Throws InvalidArgument for another
/// suffix, FileError with file and line.
PlaneDomainInput read_plane_domain(const std::string& path);

/// Triangle's format with its points in the same file, or in `nodes`. Segments may cross (PlaneDomainInput::arrange). Markers are
/// references. Markers of regions are their attributes if all are positive whole numbers, else their numbers. The domain lies inside
/// all edges, without holes.
PlaneDomainInput read_poly_text(std::string_view text, const std::string& name);
PlaneDomainInput read_poly_text(std::string_view text, const std::string& name, std::string_view nodes,
                                const std::string& nodes_name);
/// Triangle's points: the domain is their convex hull, and they are vertices.
PlaneDomainInput read_node_text(std::string_view text, const std::string& name);

/// Airfoils in the layouts of Selig and of Lednicer, with or without a first line. The domain is inside; a blunt trailing
/// edge is closed by a segment. References: 1 of the surface, 2 of that segment.
PlaneDomainInput read_airfoil_text(std::string_view text, const std::string& name);

/// The edges of a mesh, and the sides of triangles that have no neighbour or a neighbour of a different reference.
/// Triangles define the domain; without triangles edges enclose it by parity, and vertices inside are imposed. `name`
/// is for messages. Throws FileError for a mesh of dimension 3 or without edges and triangles.
PlaneDomainInput plane_domain_of(const FlatMesh& mesh, const std::string& name);

/// BL2D: the form that users write, and the compiled form.
PlaneDomainInput read_bl2d_data_text(std::string_view text, const std::string& name);
PlaneDomainInput read_bl2d_g_text(std::string_view text, const std::string& name);

/// BL2D's .hg, .hc and .h: `n 1` and sizes, or `n 3` and metrics m11 m12 m22. Throws FileError for values that are not
/// positive (definite) as well.
Solution read_bl2d_sizes_text(std::string_view text, const std::string& name);
/// Sizes or metrics at the points of a domain. Throws FileError when the numbers differ.
void set_point_sizes(PlaneDomainInput& input, const Solution& sizes, const std::string& name);

/// Makes splines of the segments of a domain: see usual_corner_angle. Points inside of one are no vertices any more.
void smooth_polygons(PlaneDomainInput& input, double corner_angle);

/// Joins the segments of a mesh that are parts of one straight side: of one reference, in line to rounding, at points
/// without a reference. The side's vertices may then be fewer in the next mesh.
void join_straight_edges(PlaneDomainInput& input);

}  // namespace carreau
