// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <string>

#include "support/error.h"
#include "support/short_number.h"
#include "variable/remesh.h"

namespace carreau::variable {

namespace {

std::string text(double x) { return short_number(x); }

[[noreturn]] void refuse(const std::string& sentence) { throw InvalidArgument(sentence); }

/// Elements that are removed may be turned over.
void check_mesh(const RemeshInput& in) {
  const Piece& piece = in.piece;
  const std::size_t n = piece.vertices.size();
  if (piece.triangles.empty()) refuse("the piece has no triangle");
  if (n > std::numeric_limits<std::int32_t>::max() / 8) refuse("the piece has too many vertices");
  for (std::size_t v = 0; v < n; ++v)
    if (!is_finite(piece.vertices[v])) refuse("a coordinate of vertex " + std::to_string(v) + " is not finite");
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    const auto& corners = piece.triangles[t];
    for (const std::int32_t v : corners)
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        refuse("triangle " + std::to_string(t) + " has vertex " + std::to_string(v) + "; there are " +
               std::to_string(n) + ", from 0");
    const bool goes = !in.damage.empty() && in.damage[t] >= in.damage_limit;
    if (!goes && !(piece.double_area(t) > 0))
      refuse("triangle " + std::to_string(t) + " of vertices " + std::to_string(corners[0]) + ", " +
             std::to_string(corners[1]) + " and " + std::to_string(corners[2]) +
             " is turned over or flat: the increment is too large, or triangles do not run counterclockwise");
  }
}

void check_bounds(const RemeshInput& in) {
  if (!(in.h_min > 0) || !(in.h_min <= in.h_max) || !std::isfinite(in.h_max))
    refuse("sizes must be 0 < h_min <= h_max, and they are " + text(in.h_min) + " and " + text(in.h_max));
  if (!(in.step >= 0)) refuse("the step of the tools is " + text(in.step) + "; it must not be negative");
  if (in.step > in.h_min)
    refuse("the step of the tools, " + text(in.step) + ", is larger than the smallest size, " + text(in.h_min) +
           ": use smaller increments");
  if (!(in.reach <= in.step)) refuse("the reach of the tools, " + text(in.reach) + ", is larger than their step");
  if (!(in.damage_limit > 0 && in.damage_limit <= 1))
    refuse("the damage of elements to be removed is " + text(in.damage_limit) + "; it must lie in ]0, 1]");
  if (!(in.gradation > 1) || !std::isfinite(in.gradation)) refuse("the gradation must be larger than 1");
  if (!(in.corner_angle > 0 && in.corner_angle <= 180)) refuse("the angle of corners must lie in ]0, 180] degrees");
  if (!(in.curvature_angle > 0 && in.curvature_angle <= 90))
    refuse("the angle between edges and tangents must lie in ]0, 90] degrees");
}

void check_displacement(const RemeshInput& in) {
  if (in.displacement.empty()) return;
  if (in.displacement.size() != in.piece.vertices.size())
    refuse("there are " + std::to_string(in.displacement.size()) + " displacements for " +
           std::to_string(in.piece.vertices.size()) + " vertices");
  for (std::size_t v = 0; v < in.displacement.size(); ++v) {
    const double length = norm(in.displacement[v]);
    if (!(length <= in.h_min))
      refuse("vertex " + std::to_string(v) + " was displaced by " + text(length) + ", more than the smallest size, " +
             text(in.h_min) + ": use smaller increments");
  }
}

void check_damage(const RemeshInput& in) {
  if (in.damage.empty()) return;
  if (in.damage.size() != in.piece.triangles.size())
    refuse("there are " + std::to_string(in.damage.size()) + " values of damage for " +
           std::to_string(in.piece.triangles.size()) + " triangles");
  for (std::size_t t = 0; t < in.damage.size(); ++t)
    if (!(in.damage[t] >= 0 && in.damage[t] <= 1))
      refuse("the damage of triangle " + std::to_string(t) + " is " + text(in.damage[t]) + "; it must lie in [0, 1]");
}

void check_kinds(const RemeshInput& in) {
  if (in.vertex_kinds.empty()) return;
  if (in.vertex_kinds.size() != in.piece.vertices.size())
    refuse("there are " + std::to_string(in.vertex_kinds.size()) + " kinds of " + std::to_string(in.piece.vertices.size()) + " vertices");
  for (std::size_t v = 0; v < in.vertex_kinds.size(); ++v)
    if (in.vertex_kinds[v] < Kind::inside)
      refuse("the kind of vertex " + std::to_string(v) + " is " + std::to_string(in.vertex_kinds[v]) + "; it must not be negative");
}

void check_fields(const RemeshInput& in) {
  for (const RemeshField& field : in.fields) {
    const bool nodal = field.kind == FieldKind::nodal;
    const std::size_t rows = nodal ? in.piece.vertices.size() : in.piece.triangles.size();
    if (field.components < 1 || field.values.size() != rows * static_cast<std::size_t>(field.components))
      refuse("the field '" + field.name + "' has " + std::to_string(field.values.size()) + " numbers; " +
             std::to_string(field.components) + " for each of " + std::to_string(rows) +
             (nodal ? " vertices" : " triangles") + " are needed");
    for (std::size_t i = 0; i < field.values.size(); ++i)
      if (!std::isfinite(field.values[i]))
        refuse("the field '" + field.name + "' is not finite at " + (nodal ? "vertex " : "triangle ") +
               std::to_string(i / static_cast<std::size_t>(field.components)));
  }
  if (in.error_field < 0) return;
  if (static_cast<std::size_t>(in.error_field) >= in.fields.size())
    refuse("the field of the error estimate is number " + std::to_string(in.error_field) + " (from 0) of " +
           std::to_string(in.fields.size()));
  const RemeshField& field = in.fields[static_cast<std::size_t>(in.error_field)];
  if (field.kind != FieldKind::nodal || field.components != 1)
    refuse("the field '" + field.name + "' of the error estimate must have one value at each vertex");
}

}  // namespace

void check_input(const RemeshInput& input) {
  check_bounds(input);
  check_displacement(input);
  check_damage(input);
  check_kinds(input);
  check_mesh(input);
  check_fields(input);
}

}  // namespace carreau::variable
