// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches.
#include "arguments.h"
#include "carreau_geometry.h"
#include "geometry/bezier/bezier_cad.h"
#include "geometry/bezier/bezier_geometry.h"
#include "guard.h"
#include "io/model/bezier_reader.h"

using carreau::BezierPatch;
using carreau::BezierPatches;
using carreau::InvalidArgument;
using namespace carreau::abi;

static_assert(carreau::largest_bezier_degree == CARREAU_BEZIER_DEGREE);

namespace {

BezierPatch patch_of(const carreau_bezier& given, std::int64_t k, const double*& next) {
  BezierPatch patch{.m = given.degrees[2 * k], .n = given.degrees[2 * k + 1], .control = {}};
  for (const int degree : {patch.m, patch.n})  // checked before they determine how far the points reach
    if (degree < 1 || degree > CARREAU_BEZIER_DEGREE)
      throw InvalidArgument("a degree of Bezier patch " + std::to_string(k) + " is " + std::to_string(degree) +
                            "; it must be from 1 to " + std::to_string(CARREAU_BEZIER_DEGREE));
  for (int i = 0; i < (patch.m + 1) * (patch.n + 1); ++i, next += 3)
    patch.control.emplace_back(next[0], next[1], next[2]);
  return patch;
}

void add(carreau_session& session, BezierPatches patches) {
  carreau::BuiltGeometry built = carreau::build_bezier(std::move(patches));
  session.add_geometry(CARREAU_GEOMETRY_BEZIER, std::move(built.cad), std::move(built.model));
}

}  // namespace

carreau_status carreau_add_bezier(carreau_session* session, const carreau_bezier* bezier) {
  return guarded(session, [&] {
    const carreau_bezier known = read_struct(bezier, "carreau_bezier");
    if (known.patch_count < 1)
      throw InvalidArgument("there is no Bezier patch: patch_count is " + std::to_string(known.patch_count));
    required(known.degrees, "bezier->degrees"), required(known.controls, "bezier->controls");
    BezierPatches patches;
    const double* next = known.controls;
    for (std::int64_t k = 0; k < known.patch_count; ++k) {
      patches.patches.push_back(patch_of(known, k, next));
      const std::int32_t* const refs = known.side_refs != nullptr ? known.side_refs + 4 * k : nullptr;
      if (refs != nullptr) patches.side_refs.push_back({refs[0], refs[1], refs[2], refs[3]});
    }
    add(*session, std::move(patches));
  });
}

carreau_status carreau_load_bezier(carreau_session* session, const char* path) {
  return guarded(session, [&] {
    session->refuse_begun();
    add(*session, {.patches = carreau::read_bezier(required(path, "path")), .side_refs = {}});
  });
}

carreau_status carreau_bezier_degrees(carreau_session* session, int32_t face_ref, int32_t out_degrees[2]) {
  return guarded(session, [&] {
    required(out_degrees, "out_degrees");
    for (const AddedGeometry& geometry : session->added) {
      if (geometry.kind != CARREAU_GEOMETRY_BEZIER || face_ref < geometry.range.first_face ||
          face_ref > geometry.range.last_face)
        continue;
      const auto& cad = static_cast<const carreau::BezierCad&>(*geometry.cad);
      const BezierPatch& patch = cad.patch(face_ref - geometry.range.first_face + 1);
      out_degrees[0] = patch.m, out_degrees[1] = patch.n;
      return;
    }
    throw InvalidArgument("face " + std::to_string(face_ref) + " is not a Bezier patch");
  });
}
