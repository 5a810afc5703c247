// SPDX-License-Identifier: BSD-3-Clause
// Regions where a mesh has far fewer vertices than the field prescribes.
#include <algorithm>

#include "control_space/control_space.h"
#include "control_space/thresholds.h"
#include "metric/metric2_algebra.h"

namespace carreau {

namespace {

using namespace thresholds::control_space;

}  // namespace

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

}  // namespace carreau
