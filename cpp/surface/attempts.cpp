// SPDX-License-Identifier: BSD-3-Clause
#include "surface/attempts.h"

#include <algorithm>
#include <utility>

#include "support/error.h"
#include "surface/thresholds.h"

namespace carreau {

namespace {

std::ptrdiff_t failed_faces(const CompositeResult& result) {
  return std::count_if(result.mesh.faces.begin(), result.mesh.faces.end(),
                       [](const FaceMesh& face) { return face.status == FaceStatus::failed; });
}

}  // namespace

Attempts::Attempts(CompositeRun& run, const std::function<void()>& mesh_again)
    : run_(run), mesh_again_(mesh_again), failed_(failed_faces(run.result)) {}

bool Attempts::again(const std::function<void()>& make_finer) {
  if (!best_) curves_ = run_.curves, cut_curves_ = run_.cut_curves, finer_ = run_.finer;
  make_finer();
  CompositeResult before = std::exchange(run_.result, {});
  run_.result.graded = before.graded, run_.result.report = before.report;
  spaces_ = std::move(before.spaces);
  if (!best_) {
    best_ = std::move(before);
    best_->spaces = std::move(spaces_);
    run_.known.rely_on(&best_->spaces);
  } else {
    run_.known.rely_on(&spaces_);
  }
  run_.trying = true;
  run_.begin += (1 - run_.begin) * (thresholds::patches::curves_share + thresholds::patches::patches_share);
  try {
    mesh_again_();
    return true;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return false;
  }
}

bool Attempts::keep_if(bool better) {
  const std::ptrdiff_t failed = failed_faces(run_.result);
  if (!better || failed > failed_) return false;
  failed_ = failed;
  best_.reset();
  return true;
}

void Attempts::finish() {
  if (best_) {
    run_.result = std::move(*best_);
    run_.curves = std::move(curves_), run_.cut_curves = std::move(cut_curves_), run_.finer = std::move(finer_);
  }
  run_.trying = false;
  for (const FaceMesh& face : run_.result.mesh.faces)
    if (face.status == FaceStatus::failed) run_.say(Level::error, face.why);
}

}  // namespace carreau
