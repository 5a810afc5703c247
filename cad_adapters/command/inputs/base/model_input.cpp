// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/model_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/failure.h"

namespace command {

namespace {
constexpr int samples = 32;  // of each curve: a circle's box and length are then known within 0.5 %

struct Box {
  Place low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Place& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] bool empty() const { return low.x > high.x; }
  [[nodiscard]] double diagonal() const { return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z); }
  [[nodiscard]] bool holds(const Box& other, double margin) const {
    return low.x <= other.low.x - margin && low.y <= other.low.y - margin && low.z <= other.low.z - margin &&
           high.x >= other.high.x + margin && high.y >= other.high.y + margin && high.z >= other.high.z + margin;
  }
};

}

template <typename Visit, typename Failed>
void ModelInput::walk(std::int32_t face, std::int32_t ic, int step, Visit&& visit, Failed&& failed) const {
  for (int i = 0; i <= samples; i += step) {
    double u = 0, v = 0;
    Place p;
    if (on_curve(face, ic, static_cast<double>(i) / samples, u, v) && locate(face, u, v, p))
      visit(p);
    else
      failed();
  }
}

// A side stays within its length of the box of five of its points: most sides of large models are far inside the box of
// all, and need no more.
void ModelInput::measure(const std::string& path) {
  constexpr int step = samples / 4;
  Box all;
  std::vector<Box> of_sides;
  const auto sides = [&](auto&& each) {
    for (const FaceModel::Face& face : model_.faces)
      for (std::size_t c = 0; c < face.curves.size(); ++c) each(face.ref, static_cast<std::int32_t>(c + 1));
  };
  const auto failed = [] {};  // reported with the place when the mesh is made
  sides([&](std::int32_t face, std::int32_t ic) {
    Box& box = of_sides.emplace_back();
    walk(face, ic, step, [&](const Place& p) { box.add(p); }, failed);
    if (!box.empty()) all.add(box.low), all.add(box.high);
  });
  const Box coarse = all;
  std::size_t side = 0;
  sides([&](std::int32_t face, std::int32_t ic) {
    const Box& box = of_sides[side++];
    if (box.empty() || !coarse.holds(box, box.diagonal())) walk(face, ic, 1, [&](const Place& p) { all.add(p); }, failed);
  });
  diagonal_ = all.diagonal();
  if (all.empty() || !(diagonal_ > 0) || !std::isfinite(diagonal_))
    throw Failure("'" + path + "': its curves have no extent in space.");
}

ModelFigures ModelInput::look_at() const {
  constexpr double pole = 1e-9, tiny = 1e-3;  // shares of the diagonal; `tiny` as for CAD files
  ModelFigures figures;
  std::vector<ModelDanger> tiny_sides, failures;
  figures.faces = static_cast<int>(model_.faces.size());
  for (const FaceModel::Face& face : model_.faces) {
    figures.points += static_cast<int>(face.points.size());
    for (std::size_t c = 0; c < face.curves.size(); ++c) {
      ++figures.sides;
      const auto ic = static_cast<std::int32_t>(c + 1);
      double length = 0;
      bool first = true, failed = false;
      Place before;
      walk(
          face.ref, ic, 1,
          [&](const Place& p) {
            if (!first) length += std::hypot(p.x - before.x, p.y - before.y, p.z - before.z);
            first = false, before = p;
          },
          [&] { failed = true; });
      char text[64];
      std::snprintf(text, sizeof text, "%.6g long", length);
      if (failed) {
        failures.push_back({"the geometry fails", face.ref, ic, "no point in space at some of its places"});
      } else if (length <= pole * diagonal_) {
        ++figures.poles;
      } else {
        figures.shortest = figures.shortest > 0 ? std::min(figures.shortest, length) : length;
        if (length < tiny * diagonal_) tiny_sides.push_back({"tiny sides", face.ref, ic, text});
      }
    }
  }
  figures.dangers = std::move(tiny_sides);
  figures.dangers.insert(figures.dangers.end(), failures.begin(), failures.end());
  return figures;
}

namespace {

struct Inside {
  double u = 0, v = 0;
};

/// Uses the even-odd rule.
bool holds(const std::vector<std::pair<Inside, Inside>>& sides, Inside p) {
  bool inside = false;
  for (const auto& [a, b] : sides)
    if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
  return inside;
}

}  // namespace

// Computes the area by midpoints of a grid over the box of the domain, within about 1 %: enough to identify a face.
FaceLook ModelInput::look_at(const FaceModel::Face& face) const {
  constexpr int cells = 96;
  FaceLook look{.number = face.ref, .name = face_name(face.ref), .kind = kind(face.ref)};
  look.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, look.high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  const auto enclose = [&](const Place& p) {
    const Point x{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k)
      look.low[k] = std::min(look.low[k], x[k]), look.high[k] = std::max(look.high[k], x[k]);
  };
  std::vector<std::pair<Inside, Inside>> sides;
  Inside low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    if (face.curves[c].type != CARREAU_BOUNDARY) continue;
    Place before;
    Inside last;
    for (int i = 0; i <= samples; ++i) {
      Inside p;
      Place place;
      if (!on_curve(face.ref, static_cast<std::int32_t>(c + 1), static_cast<double>(i) / samples, p.u, p.v) ||
          !locate(face.ref, p.u, p.v, place))
        return look;
      enclose(place);
      low = {std::min(low.u, p.u), std::min(low.v, p.v)}, high = {std::max(high.u, p.u), std::max(high.v, p.v)};
      if (i > 0) {
        sides.emplace_back(last, p);
        look.perimeter += std::hypot(place.x - before.x, place.y - before.y, place.z - before.z);
      }
      last = p, before = place;
    }
  }
  const double du = (high.u - low.u) / cells, dv = (high.v - low.v) / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Inside p{low.u + (i + 0.5) * du, low.v + (j + 0.5) * dv};
      Place place, left, right, below, above;
      if (!holds(sides, p) || !locate(face.ref, p.u, p.v, place)) continue;
      enclose(place);
      if (!locate(face.ref, p.u - du / 2, p.v, left) || !locate(face.ref, p.u + du / 2, p.v, right) ||
          !locate(face.ref, p.u, p.v - dv / 2, below) || !locate(face.ref, p.u, p.v + dv / 2, above))
        continue;
      const Point a{right.x - left.x, right.y - left.y, right.z - left.z};
      const Point b{above.x - below.x, above.y - below.y, above.z - below.z};
      look.area += std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    }
  return look;
}

std::vector<FaceLook> ModelInput::faces() const {
  std::vector<FaceLook> list;
  for (const FaceModel::Face& face : model_.faces) list.push_back(look_at(face));
  return list;
}

std::vector<std::int32_t> ModelInput::face_numbers() const {
  std::vector<std::int32_t> numbers;
  for (const FaceModel::Face& face : model_.faces) numbers.push_back(face.ref);
  return numbers;
}

carreau_status ModelInput::give_to(carreau_session* session) {
  const carreau_status status = give_geometry(session);
  return status == CARREAU_OK ? give_model(model_, session) : status;
}

std::string ModelInput::summary() const {
  std::size_t curves = 0;
  for (const FaceModel::Face& face : model_.faces) curves += face.curves.size();
  return std::to_string(model_.faces.size()) + (model_.faces.size() == 1 ? " face, " : " faces, ") +
         std::to_string(curves) + (curves == 1 ? " side" : " sides");
}

bool ModelInput::set_face_size(const std::string& face, double size) {
  std::int32_t ref = 0;
  const auto [end, error] = std::from_chars(face.data(), face.data() + face.size(), ref);
  if (error != std::errc{} || end != face.data() + face.size()) return false;
  FaceModel::Face* const found = model_.find(ref);
  if (found == nullptr) return false;
  found->size = size;
  return true;
}

double ModelInput::face_size(std::int32_t face) const {
  const FaceModel::Face* const found = model_.find(face);
  return found == nullptr ? 0 : found->size;
}

std::vector<std::int32_t> ModelInput::curves(std::int32_t face) const {
  std::vector<std::int32_t> refs;
  if (const FaceModel::Face* const found = model_.find(face))
    for (const FaceModel::Curve& curve : found->curves) refs.push_back(curve.ref);
  return refs;
}

}  // namespace command
