#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>

#include "model/topology.h"
#include "model/traces.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Sets of numbers; the representative is the smallest.
class Merger {
 public:
  explicit Merger(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(std::size_t i, std::size_t j) {
    i = find(i), j = find(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

// Points by cells of the size of the tolerance: only neighbours can be near.
void merge_near_points(const std::vector<Vec3>& points, double eps, Merger& merger) {
  using Cell = std::array<std::int64_t, 3>;
  std::map<Cell, std::vector<std::size_t>> grid;
  const auto cell_of = [&](Vec3 p) {
    const auto index = [&](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x / eps), -9e15, 9e15));
    };
    return Cell{index(p.x), index(p.y), index(p.z)};
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cell c = cell_of(points[i]);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const auto it = grid.find({c[0] + dx, c[1] + dy, c[2] + dz});
          if (it == grid.end()) continue;
          for (const std::size_t j : it->second)
            if (norm(points[i] - points[j]) < eps) merger.merge(i, j);
        }
    grid[c].push_back(i);
  }
}

struct Entry {
  std::size_t face, curve;
  std::span<const Vec3> trace;
};

}  // namespace

bool needs_gluing(const Model& model) {
  return !model.faces.empty() && !model.faces.front().curves.empty() && model.faces.front().curves.front().ref == 0;
}

Model glue(const Model& model, const CurveTraces& traces, double eps_glue, std::vector<std::string>* remarks) {
  if (!(eps_glue > 0)) throw InvalidArgument("eps_glue must be positive to glue curves");
  std::vector<Entry> entries;
  std::vector<Vec3> ends;
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (std::size_t c = 0; c < model.faces[f].curves.size(); ++c) {
      entries.push_back({f, c, traces[f][c]});
      ends.push_back(traces[f][c].front());
      ends.push_back(traces[f][c].back());
    }
  Merger points(ends.size());
  merge_near_points(ends, eps_glue, points);

  Merger curves(entries.size());
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_ends;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Entry& entry = entries[k];
    if (trace_extent(entry.trace) < eps_glue) {
      // One point of space, a curve of its own (HDR sec. 4.5.4).
      points.merge(2 * k, 2 * k + 1);
      const double length = trace_length(entry.trace);
      if (remarks != nullptr && length > 1e-6 * eps_glue)
        remarks->push_back(
            Where{.face = model.faces[entry.face].ref, .curve_index = static_cast<int>(entry.curve) + 1}.prefix() +
            "the curve is shorter (" + format_number(length) + ") than eps_glue and becomes one point");
      continue;
    }
    const std::size_t p = points.find(2 * k), q = points.find(2 * k + 1);
    auto& same_ends = by_ends[{std::min(p, q), std::max(p, q)}];
    for (const std::size_t other : same_ends)
      if (hausdorff_distance(entry.trace, entries[other].trace, eps_glue) < eps_glue) {
        curves.merge(k, other);
        break;
      }
    same_ends.push_back(k);
  }
  Model glued = model;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    FaceCurve& curve = glued.faces[entries[k].face].curves[entries[k].curve];
    curve.ref = static_cast<int>(curves.find(k)) + 1;
    curve.end1 = static_cast<int>(points.find(2 * k)) + 1;
    curve.end2 = static_cast<int>(points.find(2 * k + 1)) + 1;
  }
  return glued;
}

Model collapse_tiny_curves(const Model& model, const CurveTraces& traces, double eps_collapse,
                           std::vector<std::string>* remarks) {
  Model result = model;
  std::map<int, double> length;  // of the first curve of each reference, which stands for all
  std::map<int, int> renamed;    // point reference -> the one that replaces it
  const auto name_of = [&](int ref) {
    for (auto it = renamed.find(ref); it != renamed.end(); it = renamed.find(ref)) ref = it->second;
    return ref;
  };
  for (std::size_t f = 0; f < result.faces.size(); ++f)
    for (std::size_t c = 0; c < result.faces[f].curves.size(); ++c) {
      FaceCurve& curve = result.faces[f].curves[c];
      const auto [it, first] = length.try_emplace(curve.ref, trace_length(traces[f][c]));
      if (it->second >= eps_collapse) continue;
      curve.collapsed = true;
      const int p = name_of(curve.end1), q = name_of(curve.end2);
      if (p != q) renamed[std::max(p, q)] = std::min(p, q);
      if (first && remarks != nullptr)
        remarks->push_back(
            Where{.face = result.faces[f].ref, .curve_index = static_cast<int>(c) + 1, .curve = curve.ref}.prefix() +
            "the curve is eliminated: its length " + format_number(it->second) + " is below eps_collapse");
    }
  for (Face& face : result.faces)
    for (FaceCurve& curve : face.curves) {
      curve.end1 = name_of(curve.end1);
      curve.end2 = name_of(curve.end2);
    }
  return result;
}

}  // namespace carreau
