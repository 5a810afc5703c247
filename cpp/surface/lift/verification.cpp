// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/verification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "cad/fundamental_forms.h"
#include "predicates/polygon_locator.h"
#include "support/format.h"
#include "support/ranks/all_that_hold.h"
#include "support/ranks/shared_answers.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_sizes.h"
#include "surface/lift/excess_packet.h"
#include "surface/lift/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

using namespace thresholds::lift;

constexpr double no_size = -1;

class LiftCheck {
 public:
  LiftCheck(const PatchInput& input, const ControlSpace& space, Cad& cad, const SizeRules& rules, PatchMesh& mesh,
            Monitor& monitor)
      : input_(input), space_(space), cad_(cad), rules_(rules), mesh_(mesh), monitor_(monitor) {}

  std::vector<Vec2> run() {
    if (!input_.isotropic) {
      compare_lengths();
      compare_metrics();
      find_places(false);  // a mean size does not measure an edge that is short by its direction
      thin_out();
      return std::move(places_);
    }
    if (input_.constant_size) {
      mesh_.size.assign(mesh_.xyz.size(), *input_.constant_size);
      if (input_.is_plane) return {};  // edges are as long as the plane mesher has them
    } else {
      compare_lengths();
      ask_host();
    }
    find_places(true);
    thin_out();
    return std::move(places_);
  }

 private:
  void thin_out() {
    if (places_.size() <= max_places) return;
    std::vector<Vec2> some;
    for (std::size_t k = 0; k < max_places; ++k) some.push_back(places_[k * places_.size() / max_places]);
    places_.swap(some);
  }

  void compare_metrics() {
    FaceMetric prescribed = prescription_of(input_, rules_, monitor_);
    const std::size_t imposed = input_.domain->size.size();
    mesh_.normal.assign(mesh_.plane.vertices.size(), {});
    const std::span<const Vec2> uv = std::span<const Vec2>(mesh_.plane.vertices).subspan(imposed);
    if (!is_shared(input_.executor, uv.size())) {
      prescribed.sample(cad_, input_.ref, 0, uv, [&](std::size_t k, const SurfaceJet& jet, Metric2 m) {
        keep(imposed + k, compare_at(uv[k], jet, m));
      });
      return;
    }
    const auto ask = [&](std::span<const Vec2> some, double* out, Monitor&) {
      prescribed.sample(cad_, input_.ref, 0, some, [&](std::size_t k, const SurfaceJet& jet, Metric2 m) {
        const Compared c = compare_at(some[k], jet, m);
        std::ranges::copy(std::array{c.normal.x(), c.normal.y(), c.normal.z(), c.size, c.agrees ? 1. : 0.}, out + 5 * k);
      });
    };
    const std::vector<double> all = shared_answers(input_.executor, input_.ref, {"metrics at vertices", 5, 1, ask}, uv, monitor_);
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const double* c = all.data() + 5 * k;
      keep(imposed + k, {{c[0], c[1], c[2]}, c[3], c[4] != 0});
    }
  }
  /// Results of the metric at a vertex.
  struct Compared {
    Vec3 normal;
    double size = 0;
    bool agrees = true;  ///< with the control space
  };
  [[nodiscard]] Compared compare_at(Vec2 p, const SurfaceJet& jet, Metric2 metric) const {
    Compared c{unit_normal(jet).value_or(Vec3{}), geometric_mean_size(jet, metric)};
    if (c.size > 0) c.agrees = agree(length_ratios(metric, space_.at(p)), input_);
    return c;
  }
  void keep(std::size_t v, const Compared& c) {
    mesh_.normal[v] = c.normal;
    if (!(c.size > 0)) return;
    mesh_.size[v] = c.size;
    if (!c.agrees) places_.push_back(mesh_.plane.vertices[v]);
  }

  [[nodiscard]] std::size_t parts() const {
    return (mesh_.plane.triangles.size() + work_sizes::triangles - 1) / work_sizes::triangles;
  }
  /// Calls `use(a, b)` for each edge of a part of the triangles that is not on the border, once. Both sides of an internal
  /// edge count as one.
  template <typename Use>
  void for_edges(std::size_t part, const Use& use) const {
    const auto& triangles = mesh_.plane.triangles;
    const std::size_t end = std::min((part + 1) * work_sizes::triangles, triangles.size());
    for (std::size_t k = part * work_sizes::triangles; k < end; ++k)
      for (int i = 0; i < 3; ++i)
        if (const std::int32_t a = triangles[k][i], b = triangles[k][i == 2 ? 0 : i + 1]; a < b) use(a, b);
  }
  /// Returns the results of work(part) for all parts, by the threads and processes that make the patch.
  template <typename Result, typename Work, typename Put, typename Get>
  std::vector<Result> of_parts(std::string_view step, const Work& work, const Put& put, const Get& get) {
    return shared_work<Result>(input_.executor.shared_if(parts() >= 8), step, parts(), false, [&](std::size_t part, Monitor&) { return work(part); }, put, get, monitor_);
  }
  [[nodiscard]] double squared_promise(int a, int b) const {
    const Vec2 p = mesh_.plane.vertices[a], q = mesh_.plane.vertices[b];
    return squared_length(space_.at(0.5 * (p + q)), q - p);
  }
  [[nodiscard]] double in_space(int a, int b) const { return norm(mesh_.xyz[b] - mesh_.xyz[a]); }

  // The size that the control space prescribes at a vertex: length in space over metric length, averaged over its
  // edges. Spends no callback; exact where the sampled first fundamental form is.
  void compare_lengths() {
    promised_ = of_parts<std::vector<double>>(
        "promised lengths",
        [&](std::size_t part) {
          std::vector<double> promised;
          promised.reserve(3 * work_sizes::triangles / 2 + 1);
          for_edges(part, [&](int a, int b) { promised.push_back(std::sqrt(squared_promise(a, b))); });
          return promised;
        },
        [](PacketWriter& packet, const std::vector<double>& promised) { packet.put(promised); },
        [](PacketReader& packet) { return packet.reals(); });
    // One after the other: sums have one order.
    std::vector<double> of_space(mesh_.xyz.size(), 0), of_metric(mesh_.xyz.size(), 0);
    for (std::size_t part = 0; part < parts(); ++part) {
      monitor_.checkpoint();
      const double* promised = promised_[part].data();
      for_edges(part, [&](int a, int b) {
        const double l = in_space(a, b), m = *promised++;
        of_space[a] += l, of_space[b] += l;
        of_metric[a] += m, of_metric[b] += m;
      });
    }
    mesh_.size.resize(mesh_.xyz.size());
    for (std::size_t v = 0; v < mesh_.size.size(); ++v) {
      const bool known = v < input_.domain->size.size() && input_.domain->size[v] > 0;
      mesh_.size[v] = known ? at_edges(v, input_.domain->size[v]) : of_metric[v] > 0 ? of_space[v] / of_metric[v] : 0;
    }
  }

  // The prescribed size on a curve, which may be larger than its edges show.
  [[nodiscard]] double at_edges(std::size_t v, double h) const {
    return input_.limits.edges != nullptr ? input_.limits.edges->at(mesh_.xyz[v], h) : h;
  }

  // If sizes do not depend on curvature the host's answer is the size: one call a vertex inside.
  void ask_host() {
    if (rules_.uses_curvature()) return;
    const std::size_t imposed = input_.domain->size.size();
    const std::span<const Vec2> uv = std::span<const Vec2>(mesh_.plane.vertices).subspan(imposed);
    const auto ask = [&](std::span<const Vec2> some, double* out, Monitor& monitor) {
      for (std::size_t k = 0; k < some.size(); ++k) {
        out[k] = prescribed_at(some[k]);
        if (k % 512 == 0) monitor.checkpoint();
      }
    };
    const std::vector<double> sizes = shared_answers(input_.executor, input_.ref, {"sizes at vertices", 1, 1, ask}, uv, monitor_);
    for (std::size_t k = 0; k < uv.size(); ++k)
      if (const std::size_t v = imposed + k; sizes[k] != no_size)
        mesh_.size[v] = input_.limits.bounded(input_.face, uv[k], mesh_.xyz[v], sizes[k]);
  }
  /// no_size where the host does not answer.
  [[nodiscard]] double prescribed_at(const Vec2& p) const {
    bool answered = true;
    const auto no_answer = [&](Vec2) {
      answered = false;
      return 1.;
    };
    double h = no_size;
    rules_.on_surface(input_.face, {&p, 1}, {}, no_answer, std::span<double>(&h, 1));
    return answered ? h : no_size;
  }

  // Squares are compared, which saves three square roots an edge.
  void find_places(bool report) {
    constexpr double too_long2 = too_long * too_long, too_short2 = too_short * too_short, excess2 = excess * excess;
    mesh_.excesses.clear();
    const PlaneDomain& domain = input_.domain->plane;
    std::vector<char> at_apex;  // by imposed vertex; empty: without an apex
    for (const PlaneEdge& e : domain.edges) {
      if (e.kind != PlaneEdgeKind::degenerate) continue;
      at_apex.resize(domain.vertices.size(), 0);
      at_apex[e.a] = at_apex[e.b] = 1;
    }
    const auto misfits_of = [&](std::size_t part) {
      std::vector<EdgeExcess> misfits;  // edges that do not fit
      std::size_t rank = 0;
      for_edges(part, [&](int a, int b) {
        const double promised = promised_.empty() ? 0 : static_cast<float>(promised_[part][rank++]);
        // Between two imposed vertices the domain decides; at a degenerate side the metric is clamped.
        if (static_cast<std::size_t>(b) < domain.vertices.size()) return;
        if (static_cast<std::size_t>(a) < at_apex.size() && at_apex[a] != 0) return;
        const double m2 = promised_.empty() ? squared_promise(a, b) : promised * promised;
        const Vec3 e = mesh_.xyz[b] - mesh_.xyz[a];
        const double l2 = dot(e, e), expected2 = mesh_.size[a] * mesh_.size[b] * m2;
        if (!(expected2 > 0) || !(l2 > 0)) return;
        if (l2 <= too_long2 * expected2 && l2 >= too_short2 * expected2) return;
        const Vec2 p = mesh_.plane.vertices[a], q = mesh_.plane.vertices[b];
        misfits.push_back({l2 > excess2 * expected2 ? std::sqrt(l2 / expected2) : 0, p, q});
      });
      return misfits;
    };
    for (const std::vector<EdgeExcess>& some :
         of_parts<std::vector<EdgeExcess>>("edges that do not fit", misfits_of, put_excesses, excesses_of))
      for (const EdgeExcess& edge : some) {
        if (edge.ratio > 0) mesh_.excesses.push_back(edge);
        if (report) places_.push_back(0.5 * (edge.from + edge.to));
      }
  }

  const PatchInput& input_;
  const ControlSpace& space_;
  Cad& cad_;
  const SizeRules& rules_;
  PatchMesh& mesh_;
  Monitor& monitor_;
  std::vector<std::vector<double>> promised_;  // by part and edge, where sizes vary
  std::vector<Vec2> places_;
};

}  // namespace

bool agree(const LengthRatios& ratios, const PatchInput& input) noexcept {
  const bool graded = input.slope > 0 && !input.isotropic;
  return ratios.largest <= too_long && (graded || ratios.smallest >= too_short);
}

std::vector<Vec2> verify_lift(const PatchInput& input, const ControlSpace& space, Cad& cad, const SizeRules& rules,
                              PatchMesh& mesh, Monitor& monitor) {
  return LiftCheck(input, space, cad, rules, mesh, monitor).run();
}

bool differ_at(const std::vector<Vec2>& places, const ControlSpace& before, const ControlSpace& after) {
  return std::any_of(places.begin(), places.end(),
                     [&](Vec2 p) { return length_error(before.at(p), after.at(p)) > shares::notable; });
}

UndersampledRegions find_undersampled(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor) {
  const std::vector<Vec2>& vertices = mesh.plane.vertices;
  auto missed = space.undersampled_regions(vertices.size(), [&](std::size_t v) { return vertices[v]; });
  UndersampledRegions result;
  if (missed.empty()) return result;
  const SampledDomain domain = sampled_domain(input.domain->plane);
  const PolygonLocator locator(domain.vertices, domain.edges);
  for (std::vector<Vec2>& places : missed) std::erase_if(places, [&](Vec2 p) { return !locator.contains(p); });
  std::erase_if(missed, [](const std::vector<Vec2>& places) { return places.empty(); });
  if (missed.size() > max_places) missed.resize(max_places);
  std::vector<Vec2> uv;
  for (const std::vector<Vec2>& places : missed) uv.push_back(places.front());
  FaceMetric prescribed = prescription_of(input, rules, monitor);
  prescribed.sample(cad, input.ref, 0, uv, [&](std::size_t k, const SurfaceJet&, Metric2 metric) {
    if (agree(length_ratios(metric, space.at(uv[k])), input))
      result.confirmed.push_back(std::move(missed[k]));
    else
      result.mistaken.push_back(uv[k]);
  });
  return result;
}

std::string degenerate_inside(int ref, const FaceDomain& domain, const PatchMesh& mesh, int threads, Monitor& monitor) {
  const auto imposed = static_cast<std::int32_t>(domain.origin.size());
  // The first side of a triangle that is a point of space, although it has an end inside; 3: no such side.
  const auto point_side = [&](const std::array<std::int32_t, 3>& t) -> std::size_t {
    std::array<double, 3> in_space, in_domain;  // squared
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 edge = mesh.xyz[t[(i + 1) % 3]] - mesh.xyz[t[i]];
      in_space[i] = dot(edge, edge);
    }
    const double far = rounding_of::sizes * rounding_of::sizes * std::max({in_space[0], in_space[1], in_space[2]});
    if (std::min({in_space[0], in_space[1], in_space[2]}) > far) return 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 uv = mesh.plane.vertices[t[(i + 1) % 3]] - mesh.plane.vertices[t[i]];
      in_domain[i] = dot(uv, uv);
    }
    const double apart = rounding_of::sizes * rounding_of::sizes * *std::max_element(in_domain.begin(), in_domain.end());
    for (std::size_t i = 0; i < 3; ++i) {
      const bool inside = t[i] >= imposed || t[(i + 1) % 3] >= imposed;
      if (inside && !(in_space[i] > far) && in_domain[i] > apart) return i;
    }
    return 3;
  };
  const auto& triangles = mesh.plane.triangles;
  const std::vector<std::int32_t> found = all_that_hold(triangles.size(), {nullptr, threads}, "", monitor,
                                                        [&](std::size_t t) { return point_side(triangles[t]) < 3; });
  if (found.empty()) return {};
  const auto& t = triangles[static_cast<std::size_t>(found.front())];
  const std::size_t i = point_side(t);
  const Vec2 to = mesh.plane.vertices[t[(i + 1) % 3]];
  return Where{.face = ref, .uv = mesh.plane.vertices[t[i]]}.prefix() +
         "the surface is degenerate inside its domain: (u, v) = (" + format_number(to.x()) + ", " +
         format_number(to.y()) + ") is the same point of space";
}

}  // namespace carreau
