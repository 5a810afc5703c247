// SPDX-License-Identifier: BSD-3-Clause
#include "variable/transfer/piece_transfer.h"

#include "variable/transfer/slopes.h"

namespace carreau::variable {

namespace {

Vec3 in_space(const Vec2& p) noexcept { return {p.x(), p.y(), 0}; }

}  // namespace

const std::vector<PieceTransfer::Place>& PieceTransfer::places() {
  if (!places_.empty()) return places_;
  std::int32_t guess = 0;
  for (const Vec2& p : piece_->vertices) {
    const NearestOnMesh found = search_->nearest(in_space(p), guess);
    Place place{guess = found.triangle, found.weight};
    // Not clamped to the triangle: linear fields stay linear if the new boundary lies beside the old one.
    const auto& v = old_->triangles[static_cast<std::size_t>(guess)];
    const Vec2 a = old_->vertices[static_cast<std::size_t>(v[0])], b = old_->vertices[static_cast<std::size_t>(v[1])],
               c = old_->vertices[static_cast<std::size_t>(v[2])];
    const double area = cross(b - a, c - a);
    place.weight[1] = cross(p - a, c - a) / area;
    place.weight[2] = cross(b - a, p - a) / area;
    place.weight[0] = 1 - place.weight[1] - place.weight[2];
    places_.push_back(place);
  }
  return places_;
}

const Overlaps& PieceTransfer::overlaps() {
  if (overlaps_.start.empty()) overlaps_ = overlaps_of(*old_, *search_, *piece_);
  return overlaps_;
}

std::vector<double> PieceTransfer::nodal(std::span<const double> values, int components) {
  const auto n = static_cast<std::size_t>(components);
  std::vector<double> result;
  result.reserve(n * piece_->vertices.size());
  for (const Place& place : places()) {
    const auto& v = old_->triangles[static_cast<std::size_t>(place.triangle)];
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += place.weight[k] * values[n * static_cast<std::size_t>(v[k]) + c];
      result.push_back(sum);
    }
  }
  return result;
}

std::vector<double> PieceTransfer::means(std::span<const double> values, int components) {
  const auto n = static_cast<std::size_t>(components);
  const Overlaps& shared = overlaps();
  std::vector<double> result(n * piece_->triangles.size(), 0);
  for (std::size_t c = 0; c < n; ++c) {
    const std::vector<Vec2> slopes = limited_slopes(*old_, *adjacency_, values, n, c);
    for (std::size_t t = 0; t < piece_->triangles.size(); ++t) {
      double area = 0, sum = 0;
      for (std::size_t i = shared.start[t]; i < shared.start[t + 1]; ++i) {
        const Overlaps::Entry& part = shared.entries[i];
        const auto old = static_cast<std::size_t>(part.old);
        area += part.area;
        sum += part.area * (values[n * old + c] + dot(slopes[old], part.centre - centre_of(*old_, old)));
      }
      const auto nearest = [&] { return search_->nearest(in_space(centre_of(*piece_, t))).triangle; };
      result[n * t + c] = area > 0 ? sum / area : values[n * static_cast<std::size_t>(nearest()) + c];
    }
  }
  return result;
}

std::vector<double> PieceTransfer::conserved(std::span<const double> values, int components) {
  const auto n = static_cast<std::size_t>(components);
  const Overlaps& shared = overlaps();
  std::vector<double> covered(old_->triangles.size(), 0), result(n * piece_->triangles.size(), 0);
  std::vector<Vec2> moment(old_->triangles.size());  // moment of the covered part: slopes are taken about its centre
  for (const Overlaps::Entry& part : shared.entries) {
    const auto old = static_cast<std::size_t>(part.old);
    covered[old] += part.area, moment[old] += part.area * part.centre;
  }
  for (std::size_t c = 0; c < n; ++c) {
    const std::vector<Vec2> slopes = limited_slopes(*old_, *adjacency_, values, n, c);
    for (std::size_t t = 0; t < piece_->triangles.size(); ++t)
      for (std::size_t i = shared.start[t]; i < shared.start[t + 1]; ++i) {
        const Overlaps::Entry& part = shared.entries[i];
        const auto old = static_cast<std::size_t>(part.old);
        const double content = values[n * old + c] * old_->double_area(old) / 2 / covered[old] +
                               dot(slopes[old], part.centre - moment[old] / covered[old]);
        result[n * t + c] += part.area * content / (piece_->double_area(t) / 2);
      }
  }
  give_uncovered(values, n, covered, result);
  return result;
}

/// The content of old triangles that no new one meets goes to the nearest one.
void PieceTransfer::give_uncovered(std::span<const double> values, std::size_t components,
                                   std::span<const double> covered, std::vector<double>& result) const {
  TriangleSearch search;
  for (std::size_t old = 0; old < covered.size(); ++old) {
    if (covered[old] > 0) continue;
    if (search.empty()) search = TriangleSearch(variable::in_space(piece_->vertices), piece_->triangles);
    const auto t = static_cast<std::size_t>(search.nearest(in_space(centre_of(*old_, old))).triangle);
    for (std::size_t c = 0; c < components; ++c)
      result[components * t + c] += old_->double_area(old) / piece_->double_area(t) * values[components * old + c];
  }
}

}  // namespace carreau::variable
