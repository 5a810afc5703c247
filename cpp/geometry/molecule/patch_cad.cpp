// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/patch_cad.h"

#include "support/error.h"

namespace carreau::molecule {

void PatchCad::add(int ref, std::unique_ptr<const Patch> patch) { patches_.emplace(ref, std::move(patch)); }

const Patch& PatchCad::patch(int face) const {
  const auto found = patches_.find(face);
  if (found == patches_.end()) throw InvalidArgument(Where{.face = face}, "the molecule has no such face");
  return *found->second;
}

std::size_t PatchCad::rank(int face, int ic) const {
  if (ic < 1 || static_cast<std::size_t>(ic) > patch(face).curve_count())
    throw InvalidArgument(Where{.face = face, .curve_index = ic}, "the face has no such curve");
  return static_cast<std::size_t>(ic - 1);
}

void PatchCad::surface(int face, unsigned, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const Patch& p = patch(face);
  for (std::size_t i = 0; i < uv.size(); ++i) out[i] = p.surface(uv[i]);
}

Interval PatchCad::curve_interval(int face, int ic) { return patch(face).interval(rank(face, ic)); }

CurveJet PatchCad::curve(int face, int ic, unsigned, double t) { return patch(face).curve(rank(face, ic), t); }

std::optional<double> PatchCad::surface_radius(int face, Vec2 uv) { return patch(face).radius(uv); }

std::optional<double> PatchCad::curve_radius(int face, int ic, double) {
  return patch(face).curve_radius(rank(face, ic));
}

}  // namespace carreau::molecule
