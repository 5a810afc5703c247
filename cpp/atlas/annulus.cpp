// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/annulus.h"

#include <cmath>

#include "atlas/thresholds.h"
#include "predicates/predicates.h"
#include "support/error.h"
#include "support/rounding_of.h"

namespace carreau::atlas {
namespace {

void require_phi(const std::vector<double>& phi, std::size_t vertices, double period) {
  if (!(period > 0) || !std::isfinite(period))
    throw InvalidArgument("the period of an annulus must be positive and finite");
  if (phi.size() != vertices)
    throw InvalidArgument("there are " + std::to_string(phi.size()) + " values of phi for " + std::to_string(vertices) +
                          " vertices of the inner border");
  for (std::size_t v = 0; v < vertices; ++v)
    if (!(phi[v] < (v + 1 < vertices ? phi[v + 1] : phi[0] + period)) || !std::isfinite(phi[v]))
      throw InvalidArgument("phi does not increase behind vertex " + std::to_string(v + 1) + " of the inner border");
}

}  // namespace

Annulus::Annulus(Polygon inner, Polygon outer, AnnulusOptions options)
    : inner_(std::move(inner)), outer_(std::move(outer)), period_(options.period) {
  require_simple(inner_, "the inner border"), require_simple(outer_, "the outer border");
  require_annulus(inner_, outer_);
  if (options.phi.empty()) options.phi = phi_by_length(inner_, period_);
  require_phi(options.phi, inner_.size(), period_);
  chosen_ = choose_pivots(inner_, &outer_, options.star);
  parts_ = make_parts(inner_, chosen_.pivots, options.phi, period_);
  std::vector<OuterPieces> pieces = outer_pieces(inner_, outer_, parts_);
  const bool outer_first = options.outer_first && options.border != OuterBorder::polygon;
  described_ = outer_first ? begin_outside(parts_, pieces) : polygon_of(parts_, pieces);
  smooth_borders(parts_, std::move(pieces), options.border);
  if (options.border != OuterBorder::polygon) make_smooth(parts_);
  for (const Part& part : parts_) chain_.push_back(part.pivot);
}

std::size_t Annulus::part_around(const Vec2& p) const {
  std::size_t best = parts_.size();
  double least = rounding_of::places;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const Part& part = parts_[n];
    const Pair<double> polar = part.polar(pair_of(p));
    const double off = std::max({0.0, -polar[0], polar[0] - part.total()});
    if (off >= least) continue;
    const double tau = part.stratum(polar[1], polar[0]);
    const double outside = std::max({off, -tau, tau - 1});
    if (outside < least) least = outside, best = n;
    if (least <= 0) break;
  }
  return best;
}

bool Annulus::encloses(const Vec2& p) const {
  const bool in_chain = chain_.size() > 2 && is_inside(chain_, p);
  for (const Part& part : parts_) {
    if ((part.side > 0) == in_chain) continue;
    const Pair<double> polar = part.polar(pair_of(p));
    if (polar[0] >= 0 && polar[0] <= part.total() && polar[1] < part.radius(0.0, polar[0])) return part.side > 0;
  }
  return in_chain;
}

}  // namespace carreau::atlas
