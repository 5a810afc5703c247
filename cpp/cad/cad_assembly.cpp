// SPDX-License-Identifier: BSD-3-Clause
#include "cad/cad_assembly.h"

#include <algorithm>

#include "support/error.h"

namespace carreau {
namespace {

/// An error of a part, with the references of the assembly.
[[noreturn]] void rethrow(const CallbackError& error, int face_offset, int point_offset) {
  Where where = error.where();
  const std::string sentence = std::string(error.what()).substr(where.prefix().size());
  if (where.face != 0) where.face += face_offset;
  if (where.point != 0) where.point += point_offset;
  throw CallbackError(where, sentence);
}

template <typename Ask>
auto asked(const CadAssembly::Part& part, Ask&& ask) {
  try {
    return ask();
  } catch (const CallbackError& error) {
    rethrow(error, part.first_face - 1, part.first_point - 1);
  }
}

}  // namespace

const CadAssembly::Part* CadAssembly::part_of_face(int face) const noexcept {
  const auto behind = std::upper_bound(parts_.begin(), parts_.end(), face,
                                       [](int f, const Part& part) { return f < part.first_face; });
  if (behind == parts_.begin() || face > std::prev(behind)->last_face) return nullptr;
  return &*std::prev(behind);
}

Cad& CadAssembly::host_of(int face) const {
  if (!host_)
    throw InvalidArgument(Where{.face = face}, "no geometry has this face: register callbacks for it, by "
                                               "carreau_set_cad or carreau_set_cad_m");
  return *host_;
}

template <typename Ask>
auto CadAssembly::of_face(int face, int ic, Ask&& ask) {
  const Part* const part = part_of_face(face);
  if (part == nullptr || (!part->curves.empty() && ic > part->curves[static_cast<std::size_t>(face - part->first_face)])) return ask(host_of(face), face);
  return asked(*part, [&] { return ask(*part->cad, face - part->first_face + 1); });
}

template <typename Visit>
void CadAssembly::each(Visit&& visit) const {
  if (host_) visit(*host_);
  for (const Part& part : parts_) visit(*part.cad);
}

void CadAssembly::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  of_face(face, 0, [&](Cad& cad, int own) { cad.surface(own, want, uv, out); });
}
Interval CadAssembly::curve_interval(int face, int ic) {
  return of_face(face, ic, [&](Cad& cad, int own) { return cad.curve_interval(own, ic); });
}
CurveJet CadAssembly::curve(int face, int ic, unsigned want, double t) {
  return of_face(face, ic, [&](Cad& cad, int own) { return cad.curve(own, ic, want, t); });
}
std::optional<double> CadAssembly::surface_size(int face, Vec2 uv) {
  return of_face(face, 0, [&](Cad& cad, int own) { return cad.surface_size(own, uv); });
}
std::optional<double> CadAssembly::curve_size(int face, int ic, double t) {
  return of_face(face, ic, [&](Cad& cad, int own) { return cad.curve_size(own, ic, t); });
}
std::optional<double> CadAssembly::surface_radius(int face, Vec2 uv) {
  return of_face(face, 0, [&](Cad& cad, int own) { return cad.surface_radius(own, uv); });
}
std::optional<double> CadAssembly::curve_radius(int face, int ic, double t) {
  return of_face(face, ic, [&](Cad& cad, int own) { return cad.curve_radius(own, ic, t); });
}

std::optional<double> CadAssembly::point_size(int point) {
  for (const Part& part : parts_)
    if (point >= part.first_point && point <= part.last_point)
      return asked(part, [&] { return part.cad->point_size(point - part.first_point + 1); });
  return host_ ? host_->point_size(point) : std::nullopt;
}

bool CadAssembly::reentrant() const noexcept {
  bool all = true;
  each([&](const Cad& cad) { all = all && cad.reentrant(); });
  return all;
}

CallCounts CadAssembly::counts() const noexcept {
  CallCounts sum;
  each([&](const Cad& cad) {
    const CallCounts of_part = cad.counts();
    sum.surf0 += of_part.surf0, sum.surf1 += of_part.surf1, sum.surf2 += of_part.surf2;
    sum.curv0 += of_part.curv0, sum.curv1 += of_part.curv1, sum.curv2 += of_part.curv2;
    sum.sizes += of_part.sizes;
  });
  return sum;
}

unsigned CadAssembly::surface_gives() const noexcept {
  unsigned all = want_position | want_first | want_second;
  each([&](const Cad& cad) { all &= cad.surface_gives(); });
  return all;
}

unsigned CadAssembly::curve_gives() const noexcept {
  unsigned all = want_position | want_first | want_second;
  each([&](const Cad& cad) { all &= cad.curve_gives(); });
  return all;
}

bool CadAssembly::is_continued(int face) const noexcept {
  const Part* const part = part_of_face(face);
  if (part != nullptr) return carreau::is_continued(*part->cad, face - part->first_face + 1);
  return host_ && carreau::is_continued(*host_, face);
}

void CadAssembly::set_parameter_box(int face, Vec2 low, Vec2 high) {
  of_face(face, 0, [&](Cad& cad, int own) { cad.set_parameter_box(own, low, high); });
}

void CadAssembly::set_boundary(int face, std::vector<BoundaryCurve> boundary) {
  of_face(face, 0, [&](Cad& cad, int own) { cad.set_boundary(own, std::move(boundary)); });
}

}  // namespace carreau
