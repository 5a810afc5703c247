// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/embedder.h"

#include <algorithm>

#include "support/error.h"

namespace carreau {

namespace {

using embedding::DividedModel;
using embedding::End;
using embedding::Ground;
using embedding::Piece;

/// Curves of wires are no part of any surface.
Model without_wires(Model model) {
  for (Face& face : model.faces)
    if (face.is_wire()) face.curves.clear();
  return model;
}

}  // namespace

Embedder::Embedder(std::shared_ptr<Cad> cad, std::shared_ptr<const discrete::DiscreteCad> triangles, Model model, EmbeddedCurves curves, int threads,
                   Monitor& monitor)
    : cad_(std::move(cad)),
      monitor_(monitor),
      projector_(std::make_shared<EmbeddedCad>(cad_, curves), std::move(triangles), without_wires(model)),
      divided_(cad_, std::move(model), std::move(curves), projector_.diagonal(threads, monitor)) {
  for (const Face& face : divided_.model().faces) {
    if (!face.left_out.empty() || face.is_wire()) continue;
    has_curves_ = has_curves_ || !face.curves.empty();
    has_points_ = has_points_ || !face.curves.empty() || !face.points.empty();
  }
}

Ground Embedder::ground(double tolerance) {
  Ground ground;
  ground.closest = [this](int dimension, const Vec3& x, int ref) -> Ground::Place {
    ProjectedPoint found;
    projector_.project(dimension, ref, {&x, 1}, {&found, 1}, 1, monitor_);
    if (dimension == 2 && divided_.model().faces[divided_.uses().index_of(found.ref)].discrete)
      throw InvalidArgument(Where{.face = found.ref}, "it is given by triangles, in which no point or curve can be embedded");
    return {found.ref, found.parameters, found.xyz, found.distance};
  };
  ground.surface = [this](int face, unsigned want, const Vec2& uv) { return surface_at(*cad_, face, want, uv); };
  ground.border = [this](int face, int other, const Vec3& a, const Vec3& b, Vec3& y) { return divided_.uses().border(face, other, a, b, y); };
  ground.other_face = [this](int curve, std::span<const Vec3> points) {
    for (const Face& face : divided_.model().faces) {
      if (face.is_wire() || face.discrete || !face.left_out.empty()) continue;
      if (std::any_of(face.curves.begin(), face.curves.end(), [&](const FaceCurve& each) { return divided_.origin(each.ref) == curve; })) continue;
      const bool on = std::all_of(points.begin(), points.end(), [&](const Vec3& x) {
        ProjectedPoint found;
        projector_.project(2, face.ref, {&x, 1}, {&found, 1}, 1, monitor_);
        return found.distance <= divided_.near();
      });
      if (on) return face.ref;
    }
    return 0;
  };
  ground.has = [this](int face, int curve) {
    const std::vector<FaceCurve>& curves = divided_.model().faces[divided_.uses().index_of(face)].curves;
    return std::any_of(curves.begin(), curves.end(), [&](const FaceCurve& each) { return divided_.origin(each.ref) == curve; });
  };
  ground.has_curves = has_curves_, ground.has_points = has_points_;
  ground.diagonal = divided_.diagonal();
  ground.tolerance = tolerance;
  return ground;
}

int Embedder::embed_point(const Vec3& x, double tolerance) {
  const Ground on = ground(tolerance);
  if (!is_finite(x)) throw InvalidArgument("a coordinate of the point is not finite");
  const Ground::Place place = on.closest(2, x, 0);
  if (!(place.distance <= on.tolerance)) embedding::report_far("the point", x, place, on.tolerance);
  End end{place.xyz};
  if (has_points_)
    if (const Ground::Place near = on.closest(0, x, 0); near.distance <= on.tolerance) return near.ref;
  if (has_curves_)
    if (const Ground::Place near = on.closest(1, x, 0); near.distance <= on.tolerance) end = {near.xyz, near.ref};
  return divided_.place(end, place.ref, place.uv);
}

int Embedder::embed_polyline(std::span<const Vec3> points, double tolerance) {
  DividedModel::Content before = divided_.content();
  try {
    const Ground on = ground(tolerance);
    int whole = 0;
    for (const Piece& piece : embedding::trace(on, points)) divided_.place(piece, whole);
    return whole;
  } catch (...) {
    divided_.restore(std::move(before));
    throw;
  }
}

void Embedder::embed_wire(std::size_t wire, double tolerance) {
  const Face known = divided_.model().faces[wire];
  for (std::size_t c = 0; c < known.curves.size(); ++c) {
    const int ref = embed_polyline(divided_.uses().chords({wire, c}, divided_.diagonal()), tolerance);
    const auto name = divided_.model().names.curves.find(known.curves[c].ref);
    const std::string own = name != divided_.model().names.curves.end() ? name->second : known.name;
    if (!own.empty()) set_name(1, ref, own);
  }
}

int Embedder::embed_wires(double tolerance, std::vector<std::string>& remarks) {
  int count = 0;
  for (std::size_t f = 0; f < divided_.model().faces.size();) {
    if (!divided_.model().faces[f].is_wire() || !divided_.model().faces[f].left_out.empty()) {
      ++f;
      continue;
    }
    DividedModel::Content before = divided_.content();
    try {
      embed_wire(f, tolerance);
      divided_.remove_face(f);
      ++count;
    } catch (const InvalidArgument& error) {
      divided_.restore(std::move(before));
      remarks.push_back("wire " + std::to_string(divided_.model().faces[f].ref) + " is not embedded: " + error.what());
      ++f;
    }
  }
  return count;
}

}  // namespace carreau
