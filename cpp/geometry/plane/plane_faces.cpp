// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_faces.h"

#include <algorithm>
#include <map>

#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

class Subdomains {
 public:
  Subdomains(const PlaneDomainInput& input, std::span<const PlaneArc> arcs, const PlaneGraph& graph)
      : input_(input), arcs_(arcs), graph_(graph), claims_(graph.faces().size()) {}

  std::vector<Subdomain> run() {
    for (std::size_t i = 0; i < input_.sides.size(); ++i) claim_side(static_cast<int>(i));
    for (std::size_t i = 0; i < input_.seeds.size(); ++i) claim_seed(static_cast<int>(i));
    for (std::size_t f = 0; f < claims_.size(); ++f) claim_rest(static_cast<int>(f));
    if (order_.empty()) refuse_nothing();
    return grouped();
  }

 private:
  struct Claim {
    bool taken = false, hole = false;
    int ref = 0;
    std::string by = {};  ///< "the side of curve 2"; empty: no claim
  };

  [[nodiscard]] Where where(int line) const {
    Where place;
    place.file = input_.source, place.line = line;
    return place;
  }

  void claim(int face, int ref, int line, const std::string& by) {
    if (ref < 0)
      throw InvalidModel(where(line), "the reference " + std::to_string(ref) + " of a subdomain is negative");
    Claim& old = claims_[face];
    if (!old.by.empty() && !old.hole && old.ref != ref)
      throw InvalidModel(where(line), by + " and " + old.by + " name one subdomain, but give it the references " +
                                          std::to_string(ref) + " and " + std::to_string(old.ref));
    if (!old.taken) order_.push_back(face);
    old = {.taken = true, .hole = false, .ref = ref, .by = by};
  }

  /// A point where one curve ends alone; -1 if all ends are joined.
  [[nodiscard]] int open_end(int curve) const {
    std::map<int, int> ends;
    for (const PlaneArc& arc : arcs_) ++ends[arc.from], ++ends[arc.to];
    for (const PlaneArc& arc : arcs_)
      if (curve < 0 || arc.curve == curve)
        for (const int p : {arc.from, arc.to})
          if (ends[p] == 1) return p;
    return -1;
  }

  void claim_side(int rank) {
    const PlaneSide& side = input_.sides[rank];
    if (side.curve < 0 || side.curve >= static_cast<int>(input_.curves.size()))
      throw InvalidModel(where(side.line),
                         "a side names the curve " + std::to_string(side.curve + 1) + ", which does not exist");
    const std::string curve = name_of_curve(input_, side.curve), which = side.left ? "left" : "right";
    // Arcs are in the order of their curves.
    auto a = static_cast<std::size_t>(std::lower_bound(arcs_.begin(), arcs_.end(), side.curve,
                                                       [](const PlaneArc& arc, int c) { return arc.curve < c; }) -
                                      arcs_.begin());
    for (; a < arcs_.size() && arcs_[a].curve == side.curve; ++a) {
      const int half_edge = 2 * static_cast<int>(a) + (side.left ? 0 : 1);
      const int face = graph_.face_of(half_edge);
      if (face == PlaneGraph::unbounded || face == graph_.face_of(half_edge ^ 1)) {
        int end = open_end(side.curve);
        if (end < 0 && face == graph_.face_of(half_edge ^ 1)) end = open_end(-1);
        if (end >= 0)
          throw InvalidModel(where(side.line), "the domain lies on the " + which + " of " + curve +
                                                   ", but its boundary is open: only one curve ends at " +
                                                   name_of_point(input_, end));
      }
      if (face == PlaneGraph::unbounded)
        throw InvalidModel(where(side.line), "the domain lies on the " + which + " of " + curve +
                                                 ", which is its outer side: it would be unbounded");
      claim(face, side.ref, side.line, "the side of " + curve);
    }
  }

  void claim_seed(int rank) {
    const PlaneSeed& seed = input_.seeds[rank];
    const std::string by = std::string(seed.hole ? "hole" : "region") + " (" + format_number(seed.at.x()) + ", " +
                           format_number(seed.at.y()) + ")";
    if (!is_finite(seed.at)) throw InvalidModel(where(seed.line), "the place of a " + by + " is not finite");
    const int face = graph_.face_at(seed.at);
    if (face == PlaneGraph::on_an_arc) throw InvalidModel(where(seed.line), "the " + by + " lies on a curve");
    if (face == PlaneGraph::unbounded) {
      if (seed.hole) return;  // it takes nothing away
      throw InvalidModel(where(seed.line), "the " + by + " lies outside of all curves");
    }
    if (!seed.hole)
      claim(face, seed.ref, seed.line, "the " + by);
    else if (!claims_[face].taken)
      claims_[face].hole = true;
  }

  void claim_rest(int face) {
    Claim& claim = claims_[face];
    if (claim.taken || claim.hole || input_.rest == PlaneRest::outside) return;
    if (input_.rest == PlaneRest::parity && graph_.faces()[face].depth % 2 != 0) return;
    claim.taken = true;
    order_.push_back(face);
  }

  [[noreturn]] void refuse_nothing() const {
    const std::string nothing = "the plane domain is empty: ";
    if (input_.curves.empty()) throw InvalidModel(where(0), nothing + "it has no curve");
    if (const int end = open_end(-1); graph_.faces().empty() && end >= 0)
      throw InvalidModel(where(input_.points[end].line),
                         nothing + "its boundary is open, since only one curve ends at " + name_of_point(input_, end));
    throw InvalidModel(where(0), nothing + "no side or region names a part inside its curves, or holes remove all of it");
  }

  [[nodiscard]] std::vector<Subdomain> grouped() const {
    std::map<int, std::size_t> first;  // of each reference
    std::vector<std::pair<std::size_t, Subdomain>> all;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const int ref = claims_[order_[i]].ref;
      all.push_back({ref == 0 ? i : first.try_emplace(ref, i).first->second, {order_[i], ref}});
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    std::vector<Subdomain> result;
    for (const auto& each : all) result.push_back(each.second);
    return result;
  }

  const PlaneDomainInput& input_;
  std::span<const PlaneArc> arcs_;
  const PlaneGraph& graph_;
  std::vector<Claim> claims_;
  std::vector<int> order_;  // of subdomains
};

}  // namespace

std::vector<Subdomain> find_subdomains(const PlaneDomainInput& input, std::span<const PlaneArc> arcs,
                                       const PlaneGraph& graph) {
  return Subdomains(input, arcs, graph).run();
}

}  // namespace carreau
