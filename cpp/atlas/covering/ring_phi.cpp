// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/ring_phi.h"

#include "atlas/covering/shared_triangle.h"

namespace carreau::atlas {
namespace {

class RingPhi {
 public:
  RingPhi(const Triangulation& surface, Ring& ring) : surface_(surface), ring_(ring) {}

  void set() {
    const std::size_t n = ring_.spokes.size(), count = ring_.triples.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t from = ring_.triples[k] + 1, to = ring_.triples[(k + 1) % count] + (k + 1 == count ? n : 0);
      double whole = 0;
      for (std::size_t s = from; s < to; ++s) whole += border_length(s);
      double at = 0;
      for (std::size_t s = from; s <= to; ++s) {
        // Spokes behind the last triple, at the start of the list, have a smaller phi than the first triple.
        const double turns = s >= n ? -static_cast<double>(count) : 0;
        ring_.spokes[s % n].phi = sixth_turn * turns + phi(k, at, whole);
        if (s < to) at += border_length(s);
      }
    }
  }

 private:
  [[nodiscard]] double length(std::int32_t a, std::int32_t b) const {
    return norm(surface_.vertices[static_cast<std::size_t>(a)] - surface_.vertices[static_cast<std::size_t>(b)]);
  }
  /// Length of the edge that the triangle behind a spoke has on a border.
  [[nodiscard]] double border_length(std::size_t s) const {
    const Spoke &a = ring_.spokes[s % ring_.spokes.size()], &b = ring_.spokes[(s + 1) % ring_.spokes.size()];
    return a.inner != b.inner ? length(a.inner, b.inner) : length(a.outer, b.outer);
  }
  /// Half of the length of a triple: equal for its three clusters.
  [[nodiscard]] double half_of_triple(std::size_t k) const {
    const std::size_t s = ring_.triples[k];
    const Spoke &a = ring_.spokes[s], &b = ring_.spokes[(s + 1) % ring_.spokes.size()];
    return (length(a.inner, a.outer) + length(a.outer, b.outer) + length(a.inner, b.outer)) / 6;
  }
  /// Behind triple k, at a part of the length of the double zone that follows.
  [[nodiscard]] double phi(std::size_t k, double at, double whole) const {
    const double cut = sixth_turn * static_cast<double>(k + 1), half = whole / 2;
    if (at <= half) {
      const double triple = half_of_triple(k);
      return cut - sixth_turn / 2 * (half - at) / (half + triple);
    }
    const double triple = half_of_triple((k + 1) % ring_.triples.size());
    return cut + sixth_turn / 2 * (at - half) / (half + triple);
  }

  const Triangulation& surface_;
  Ring& ring_;
};

}  // namespace

void set_phi(const Triangulation& surface, Ring& ring) { RingPhi(surface, ring).set(); }

std::vector<double> phi_of_border(const Ring& ring) {
  std::vector<double> phi;
  for (std::size_t b = 0; b < ring.first_spoke.size(); ++b) {
    const std::size_t last = b + 1 < ring.first_spoke.size() ? ring.first_spoke[b + 1] - 1 : ring.spokes.size() - 1;
    phi.push_back((ring.spokes[ring.first_spoke[b]].phi + ring.spokes[last].phi) / 2);
  }
  return phi;
}

}  // namespace carreau::atlas
