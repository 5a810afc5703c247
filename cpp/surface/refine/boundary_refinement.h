// SPDX-License-Identifier: BSD-3-Clause
// Refinement of discretised curves until every parameter domain can be meshed (HDR sec. 3.3.1-3.3.3).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "periodic/periodic_model.h"
#include "surface/domain/domain_builder.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/options.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// The domains of all faces after refinement. A face that cannot be repaired keeps no domain; `failure` gives the
/// reason.
struct RefinedDomains {
  std::vector<std::optional<FaceDomain>> domain;  ///< by face index
  std::vector<std::string> failure;               ///< by face index; empty when there is a domain
  std::vector<char> mended;                       ///< by face index: a curve was refined for it
  std::set<int> kept;  ///< curves whose prescribed edges should have been split, and were not
  /// Strips whose sides have no common places any more (SidesMatched::unmatched): they get no domain.
  std::vector<int> unmatched;
};

/// Splits segments of `curves` (in every face that holds them) until no discretised boundary crosses itself. Then
/// splits them where boundaries come close or lengths of neighbours differ (CheckCloseEdges, CheckAdjacentEdges,
/// CheckWellDefined). The options prescribe the number of rounds. `limits`: limits of the sizes in which lengths are
/// compared. Strips in `narrow`, and points whose curves vanish, are passed over and get no domain. The two sides of
/// strips keep vertices at the same places. Periodic curves keep corresponding vertices. Neighbours may differ in faces that
/// `uneven` marks.
RefinedDomains refine_domains(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options,
                              const SizeLimits& limits, const NarrowModel& narrow, std::vector<DiscreteCurve>& curves,
                              Monitor& monitor, const PeriodicModel* periodic = nullptr, const std::vector<char>& uneven = {});

/// Curves whose edges would coincide in space (same ends, one edge each) get a vertex more. Throws InvalidModel if two
/// such curves are prescribed to have one edge.
void separate_coincident_curves(const CurveModel& model, std::vector<DiscreteCurve>& curves);

}  // namespace carreau
