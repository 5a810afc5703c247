// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/divided_model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "embedding/crossings.h"
#include "embedding/thresholds.h"
#include "model/geometries.h"
#include "support/infinity.h"

namespace carreau::embedding {

DividedModel::DividedModel(std::shared_ptr<Cad> cad, Model model, EmbeddedCurves curves, double diagonal)
    : cad_(std::move(cad)), model_(std::move(model)), curves_(std::move(curves)), diagonal_(diagonal), near_(thresholds::embedding::same_place * diagonal) {
  const LargestReferences largest = largest_references(model_);
  last_curve_ = largest.curve, last_point_ = largest.point;
}

void DividedModel::restore(Content content) {
  model_ = std::move(content.model), curves_ = std::move(content.curves);
  origins_ = std::move(content.origins), points_ = std::move(content.points);
}

int DividedModel::origin(int curve) const {
  const auto found = origins_.find(curve);
  return found == origins_.end() ? curve : found->second;
}

int DividedModel::new_point(const Vec3& x) {
  points_.emplace_back(x, ++last_point_);
  return last_point_;
}

// All faces have the curve in two parts. The first part in the first face keeps its reference.
void DividedModel::divide(int curve, const Vec3& x, int point) {
  const int second = ++last_curve_;
  origins_[second] = origin(curve);
  Vec3 direction;
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    Face& face = model_.faces[f];
    if (!face.left_out.empty() || face.discrete || face.is_wire()) continue;
    const std::size_t n = face.curves.size();
    for (std::size_t c = 0; c < n; ++c) {
      if (face.curves[c].ref != curve) continue;
      const CurveUses::Place place = uses().nearest({f, c}, x);
      const auto [a, b] = uses().interval({f, c});
      const double size = norm(direction);
      if (size == 0) direction = place.tangent;
      const bool turned = size > 0 && dot(direction, place.tangent) < 0;
      FaceCurve other = face.curves[c];
      FaceCurve& first = face.curves[c];
      const int shown = first.shown_as != 0 ? first.shown_as : first.ref;
      other.part_of = host_rank(face, c), other.part_a = place.t, other.part_b = b, other.end1 = point;
      first.part_of = other.part_of, first.part_a = a, first.part_b = place.t, first.end2 = point;
      (turned ? first : other).ref = second;
      (turned ? first : other).shown_as = shown;
      face.curves.push_back(std::move(other));
    }
  }
}

void DividedModel::rename_point(int from, int to) {
  for (Face& face : model_.faces) {
    for (FaceCurve& curve : face.curves)
      for (int* end : {&curve.end1, &curve.end2})
        if (*end == from) *end = to;
    for (FacePoint& point : face.points)
      if (point.ref == from) point.ref = to;
  }
}

// A part of the curve ends at the point, which may have another reference there.
void DividedModel::join_end(int curve, const Vec3& x, int point) {
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    if (!model_.faces[f].left_out.empty() || model_.faces[f].discrete) continue;
    for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) {
      const FaceCurve& use = model_.faces[f].curves[c];
      if (origin(use.ref) != curve) continue;
      const CurveUses::Place place = uses().nearest({f, c}, x);
      if (place.distance > near_) continue;
      const auto [a, b] = uses().interval({f, c});
      for (const bool at_end : {false, true})
        if (norm(uses().at({f, c}, at_end ? b : a).xyz - x) <= near_) {
          if (const int ref = at_end ? use.end2 : use.end1; ref != point) rename_point(ref, point);
          return;
        }
      return divide(use.ref, x, point);
    }
  }
}

const FaceCurve* DividedModel::part_between(int curve, int point, int other) const {
  for (const Face& face : model_.faces)
    for (const FaceCurve& use : face.curves)
      if (origin(use.ref) == curve && ((use.end1 == point && use.end2 == other) || (use.end1 == other && use.end2 == point))) return &use;
  return nullptr;
}

int DividedModel::point_at(const End& end, std::size_t face, Vec2& uv) {
  const Face& of = model_.faces[face];
  if (end.point != 0) {
    double least = infinity;
    Vec2 best = uv;
    const auto look = [&](const Vec2& at) {
      if (const double d = norm(at - uv); d < least) least = d, best = at;
    };
    for (std::size_t c = 0; c < of.curves.size(); ++c) {
      const auto [a, b] = uses().interval({face, c});
      if (of.curves[c].end1 == end.point) look(uses().at({face, c}, a).uv);
      if (of.curves[c].end2 == end.point) look(uses().at({face, c}, b).uv);
    }
    for (const FacePoint& point : of.points)
      if (point.ref == end.point) look(point.uv);
    if (least < infinity) uv = best;
    return end.point;
  }
  if (end.curve != 0) {
    std::optional<CurveUses::Use> use;
    CurveUses::Place best;
    for (std::size_t c = 0; c < of.curves.size(); ++c) {
      if (of.curves[c].ref != end.curve && origin(of.curves[c].ref) != end.curve) continue;
      const CurveUses::Place place = uses().nearest({face, c}, end.at);
      const bool tie = use && std::abs(place.distance - best.distance) <= near_;
      if (!use || (tie ? norm(place.uv - uv) < norm(best.uv - uv) : place.distance < best.distance)) use = CurveUses::Use{face, c}, best = place;
    }
    if (use && best.distance <= near_) {
      uv = best.uv;
      const FaceCurve curve = of.curves[use->curve];
      const auto [a, b] = uses().interval(*use);
      for (const bool at_end : {false, true})
        if (const CurveUses::Place tip = uses().at(*use, at_end ? b : a);
            norm(tip.xyz - best.xyz) <= near_ && std::abs(best.t - tip.t) <= 0.5 * (b - a)) {
          uv = tip.uv;
          return at_end ? curve.end2 : curve.end1;
        }
      const int point = new_point(best.xyz);
      divide(curve.ref, best.xyz, point);
      return point;
    }
  }
  for (const auto& [x, ref] : points_)
    if (norm(x - end.at) <= near_) return ref;
  return new_point(end.at);
}

// An end inside of a face may lie on a curve that was embedded before.
void DividedModel::touch(End& end, std::size_t face) const {
  if (end.curve != 0 || end.point != 0) return;
  const Face& of = model_.faces[face];
  for (std::size_t c = 0; c < of.curves.size(); ++c)
    if (of.curves[c].type == CurveType::internal && uses().nearest({face, c}, end.at).distance <= near_) {
      end.curve = of.curves[c].ref;
      return;
    }
}

int DividedModel::place(End end, int face, Vec2 uv) {
  const std::size_t f = uses().index_of(face);
  touch(end, f);
  const int point = point_at(end, f, uv);
  if (end.curve == 0) model_.faces[f].points.push_back({.ref = point, .uv = uv});
  return point;
}

void DividedModel::place(const Piece& piece, int& whole) {
  const std::size_t f = uses().index_of(piece.face);
  std::vector<Cut> cuts = cuts_of(piece, uses(), near_);
  cuts.insert(cuts.begin(), Cut{piece.curve.t.front(), piece.begin});
  cuts.push_back({piece.curve.t.back(), piece.end});
  for (Cut& cut : cuts) touch(cut.end, f);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    EmbeddedCurve curve = part_of_curve(piece.curve, cuts[i].t, cuts[i + 1].t);
    FaceCurve added{.type = CurveType::internal};
    added.end1 = point_at(cuts[i].end, f, curve.uv.front());
    added.end2 = point_at(cuts[i + 1].end, f, curve.uv.back());
    const FaceCurve* joined = nullptr;
    if (piece.along != 0) {
      join_end(piece.along, cuts[i].end.at, added.end1), join_end(piece.along, cuts[i + 1].end.at, added.end2);
      joined = part_between(piece.along, added.end1, added.end2);
    }
    added.ref = joined != nullptr ? joined->ref : ++last_curve_;
    if (joined != nullptr) whole = joined->shown_as != 0 ? joined->shown_as : joined->ref;
    if (whole == 0) whole = added.ref;
    if (whole != added.ref) added.shown_as = whole;
    Face& face = model_.faces[f];
    std::erase_if(face.points, [&](const FacePoint& point) { return point.ref == added.end1 || point.ref == added.end2; });
    face.curves.push_back(added);
    curves_[{face.ref, static_cast<int>(face.curves.size())}] = std::make_shared<const EmbeddedCurve>(std::move(curve));
  }
}

}  // namespace carreau::embedding
