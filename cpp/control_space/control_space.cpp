// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/control_space.h"

#include <algorithm>

#include "control_space/thresholds.h"
#include "control_space/writer.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"

namespace carreau {

namespace {

using namespace thresholds::control_space;

constexpr std::size_t reals_of_leaf = 3 + 9 * 3;

void put(PacketWriter& packet, const Metric2& m) { packet.put(m.a), packet.put(m.b), packet.put(m.c); }

Metric2 metric_of(PacketReader& packet) {
  const double a = packet.real(), b = packet.real(), c = packet.real();
  return {a, b, c};
}

}  // namespace

ControlSpace ControlSpace::build(const SampledDomain& domain, const MetricSampler& sampler,
                                 const ControlSpaceOptions& options, Monitor& monitor) {
  const SurfaceSampler metrics_only = [&](std::span<const Vec2> uv, std::span<Metric2> metric,
                                          std::span<SurfaceTangents>) { sampler(uv, metric); };
  detail::ControlSpaceSampling sampling(domain, metrics_only, false, options, monitor);
  sampling.run();
  return ControlSpaceWriter(sampling, monitor).run();
}

ControlSpace ControlSpace::build_graded(const SampledDomain& domain, const SurfaceSampler& sampler, double slope,
                                        bool directed, const ControlSpaceOptions& options, Monitor& monitor) {
  ControlSpaceOptions graded = options;
  graded.thorough = true;
  detail::ControlSpaceSampling sampling(domain, sampler, true, graded, monitor);
  sampling.run();
  sampling.bound_slopes(slope, directed);
  return ControlSpaceWriter(sampling, monitor).run();
}

MetricSlopes ControlSpace::slopes_in(const Leaf& leaf, double s, double t) const noexcept {
  double root[3], by_s[3], by_t[3];
  for (int k = 0; k < 3; ++k) {
    const auto c = [&](int i) { return leaf.c[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]; };
    const double p0 = (c(2) * s + c(1)) * s + c(0), p1 = (c(5) * s + c(4)) * s + c(3),
                 p2 = (c(8) * s + c(7)) * s + c(6);
    root[k] = (p2 * t + p1) * t + p0;
    by_t[k] = 2 * p2 * t + p1;
    by_s[k] = ((2 * c(8) * s + c(7)) * t + 2 * c(5) * s + c(4)) * t + 2 * c(2) * s + c(1);
  }
  // The symmetric part of the product of two symmetric matrices.
  const auto product = [&](const double* p, const double* q) {
    return Metric2{unit_.a * (p[0] * q[0] + p[1] * q[1]), 0.5 * unit_.b * (p[1] * (q[0] + q[2]) + q[1] * (p[0] + p[2])),
                   unit_.c * (p[1] * q[1] + p[2] * q[2])};
  };
  return {product(root, root), 2 * leaf.scale * scale_.x() * product(root, by_s),
          2 * leaf.scale * scale_.y() * product(root, by_t)};
}

MetricSlopes ControlSpace::slopes_at(const Vec2& uv) const noexcept {
  const Place at = place(uv);
  return slopes_in(*at.leaf, at.s, at.t);
}

bool ControlSpace::is_constant() const noexcept {
  constexpr std::array<double, 3> none{};
  return std::all_of(leaves_.begin(), leaves_.end(), [&](const Leaf& leaf) {
    return leaf.c[0] == leaves_[0].c[0] && std::all_of(leaf.c.begin() + 1, leaf.c.end(), [&](const auto& c) { return c == none; });
  });
}

double ControlSpace::largest_bend() const noexcept {
  double largest = 0;
  for (const Leaf& leaf : leaves_) largest = std::max(largest, bend_of_shapes(slopes_in(leaf, 0, 0)));
  return largest;
}

ControlSpace ControlSpace::constant(Metric2 metric) {
  ControlSpace space;
  // The root (0, 1; 1, 1) has the square (1, 1; 1, 2): at() returns exactly the metric.
  space.unit_ = {metric.a, metric.b, 0.5 * metric.c};
  space.leaves_[0].c[0] = {0, 1, 1};
  return space;
}

void ControlSpace::scale_lengths(double factor) noexcept {
  const double k = factor * factor;
  unit_ = k * unit_;
  measure_ *= k;
  for (double& measure : measures_) measure *= k;
}

/// Goes through the squares that hold leaves, from small squares to larger ones.
class ControlSpace::UndersampledSearch {
 public:
  explicit UndersampledSearch(const ControlSpace& space) : space_(space), held_(space.leaves_.size(), 0) {}

  void count(Vec2 uv) noexcept { ++held_[static_cast<std::size_t>(space_.place(uv).leaf - space_.leaves_.data())]; }

  [[nodiscard]] std::vector<std::vector<Vec2>> run() {
    int size = 1;
    while (size < columns() || size < rows()) size *= 2;
    look({0, 0, size});
    return std::move(found_);
  }

 private:
  /// In units of the table.
  struct Square {
    int i, j, size;
  };
  struct Content {
    double vertices = 0;                   ///< of a unit mesh
    double held = 0;                       ///< of the mesh
    bool has_undersampled_region = false;  ///< a part was found to be one
  };
  struct Place {
    double density;  ///< squared, of a unit mesh
    Vec2 centre;
  };

  [[nodiscard]] int columns() const noexcept { return static_cast<int>(space_.columns_); }
  [[nodiscard]] int rows() const noexcept { return static_cast<int>(space_.table_.size() / space_.columns_); }

  Content look(Square square) {
    if (square.i >= columns() || square.j >= rows()) return {};
    const std::int32_t entry = space_.table_[static_cast<std::size_t>(square.j * columns() + square.i)];
    if (square.size == 1 || (entry >= 0 && leaf_width(entry) >= square.size)) return look_below(entry);
    const std::size_t first = places_.size();
    const int half = square.size / 2;
    Content all;
    for (const int j : {0, half})
      for (const int i : {0, half}) add(all, look({square.i + i, square.j + j, half}));
    return judged(all, first);
  }
  Content look_below(std::int32_t cell) {
    const std::size_t first = places_.size();
    if (cell >= 0) return judged(visit(cell), first);
    Content all;
    for (const std::int32_t part : space_.children_[static_cast<std::size_t>(~cell)]) add(all, look_below(part));
    return judged(all, first);
  }

  [[nodiscard]] double leaf_width(std::int32_t leaf) const noexcept {
    return 2 / space_.leaves_[static_cast<std::size_t>(leaf)].scale;
  }
  Content visit(std::int32_t number) {
    const Leaf& leaf = space_.leaves_[static_cast<std::size_t>(number)];
    const Vec2 centre = space_.low_ + Vec2{leaf.x / space_.scale_.x(), leaf.y / space_.scale_.y()};
    places_.push_back({accurate_determinant(space_.at(centre)), centre});
    return {space_.measures_[static_cast<std::size_t>(number)] / 2,
            static_cast<double>(held_[static_cast<std::size_t>(number)]), false};
  }
  static void add(Content& all, const Content& part) noexcept {
    all.vertices += part.vertices;
    all.held += part.held;
    all.has_undersampled_region = all.has_undersampled_region || part.has_undersampled_region;
  }
  /// `first`: of its places.
  Content judged(Content content, std::size_t first) {
    if (content.has_undersampled_region || content.vertices < crowd || content.held >= min_share * content.vertices)
      return content;
    std::vector<Place> places(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& p, const Place& q) { return p.density > q.density; });
    found_.emplace_back();
    for (const Place& place : places) found_.back().push_back(place.centre);
    content.has_undersampled_region = true;
    return content;
  }

  const ControlSpace& space_;
  std::vector<std::int32_t> held_;  // vertices of the mesh in each leaf
  std::vector<Place> places_;       // of all leaves that were visited
  std::vector<std::vector<Vec2>> found_;
};

std::vector<std::vector<Vec2>> ControlSpace::undersampled_regions(
    std::size_t count, const std::function<Vec2(std::size_t)>& vertex) const {
  if (!(scale_.x() > 0) || !(scale_.y() > 0)) return {};  // constant()
  UndersampledSearch search(*this);
  for (std::size_t v = 0; v < count; ++v) search.count(vertex(v));
  return search.run();
}

void ControlSpace::put(PacketWriter& packet) const {
  packet.put(low_), packet.put(scale_), packet.put(last_);
  packet.put(static_cast<std::int64_t>(columns_));
  carreau::put(packet, unit_);
  packet.put(table_);
  packet.put(static_cast<std::int64_t>(children_.size()));
  for (const auto& four : children_)
    for (const std::int32_t child : four) packet.put(std::int64_t{child});
  packet.put(static_cast<std::int64_t>(leaves_.size()));
  for (const Leaf& leaf : leaves_) {
    packet.put(leaf.x), packet.put(leaf.y), packet.put(leaf.scale);
    for (const auto& root : leaf.c)
      for (const double value : root) packet.put(value);
  }
  packet.put(measures_);
  packet.put(measure_);
  packet.put(static_cast<std::int64_t>(samples_));
}

ControlSpace ControlSpace::from(PacketReader& packet) {
  ControlSpace space;
  space.low_ = packet.plane_point(), space.scale_ = packet.plane_point(), space.last_ = packet.plane_point();
  space.columns_ = static_cast<std::size_t>(packet.integer());
  space.unit_ = metric_of(packet);
  space.table_ = packet.integers();
  space.children_.resize(packet.count(4 * sizeof(std::int64_t)));
  for (auto& four : space.children_)
    for (std::int32_t& child : four) child = static_cast<std::int32_t>(packet.integer());
  space.leaves_.resize(packet.count(reals_of_leaf * sizeof(double)));
  for (Leaf& leaf : space.leaves_) {
    leaf.x = packet.real(), leaf.y = packet.real(), leaf.scale = packet.real();
    for (auto& root : leaf.c)
      for (double& value : root) value = packet.real();
  }
  space.measures_ = packet.reals();
  space.measure_ = packet.real();
  space.samples_ = static_cast<std::size_t>(packet.integer());
  return space;
}

}  // namespace carreau
