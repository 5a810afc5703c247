#include "variable/piece_transfer.h"

namespace carreau::variable {

namespace {

Vec2 centre_of(const Piece& piece, std::size_t t) noexcept {
  const auto& v = piece.triangles[t];
  return (piece.vertices[static_cast<std::size_t>(v[0])] + piece.vertices[static_cast<std::size_t>(v[1])] +
          piece.vertices[static_cast<std::size_t>(v[2])]) /
         3;
}

Vec3 in_space(const Vec2& p) noexcept { return {p.x(), p.y(), 0}; }

}  // namespace

const std::vector<PieceTransfer::Place>& PieceTransfer::places() {
  if (!places_.empty()) return places_;
  std::int32_t guess = 0;
  for (const Vec2& p : piece_->vertices) {
    const NearestOnMesh found = search_->nearest(in_space(p), guess);
    Place place{guess = found.triangle, found.weight};
    // Not clamped to the triangle: linear fields stay so where the new boundary lies beside the old one.
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
  for (std::size_t t = 0; t < piece_->triangles.size(); ++t) {
    double area = 0;
    for (std::size_t i = shared.start[t]; i < shared.start[t + 1]; ++i) area += shared.entries[i].area;
    const bool alone = !(area > 0);
    const auto add = [&](std::int32_t old, double share) {
      for (std::size_t c = 0; c < n; ++c) result[n * t + c] += share * values[n * static_cast<std::size_t>(old) + c];
    };
    if (alone) add(search_->nearest(in_space(centre_of(*piece_, t))).triangle, 1);
    for (std::size_t i = shared.start[t]; !alone && i < shared.start[t + 1]; ++i)
      add(shared.entries[i].old, shared.entries[i].area / area);
  }
  return result;
}

std::vector<double> PieceTransfer::conserved(std::span<const double> values, int components) {
  const auto n = static_cast<std::size_t>(components);
  const Overlaps& shared = overlaps();
  std::vector<double> covered(old_->triangles.size(), 0), result(n * piece_->triangles.size(), 0);
  for (const Overlaps::Entry& entry : shared.entries) covered[static_cast<std::size_t>(entry.old)] += entry.area;
  const auto give = [&](std::size_t old, std::size_t t, double share) {
    for (std::size_t c = 0; c < n; ++c)
      result[n * t + c] += share * old_->double_area(old) / piece_->double_area(t) * values[n * old + c];
  };
  for (std::size_t t = 0; t < piece_->triangles.size(); ++t)
    for (std::size_t i = shared.start[t]; i < shared.start[t + 1]; ++i) {
      const auto old = static_cast<std::size_t>(shared.entries[i].old);
      give(old, t, shared.entries[i].area / covered[old]);
    }
  TriangleSearch search;
  for (std::size_t old = 0; old < covered.size(); ++old) {
    if (covered[old] > 0) continue;
    if (search.empty()) search = TriangleSearch(variable::in_space(piece_->vertices), piece_->triangles);
    give(old, static_cast<std::size_t>(search.nearest(in_space(centre_of(*old_, old))).triangle), 1);
  }
  return result;
}

}  // namespace carreau::variable
