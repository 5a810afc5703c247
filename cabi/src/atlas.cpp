// SPDX-License-Identifier: BSD-3-Clause
// Loops, annuli and atlases.
#include <bit>
#include <cmath>

#include "arguments.h"
#include "atlas/pseudo_skeleton.h"
#include "carreau_atlas.h"
#include "geometry/atlas/blended_surface.h"
#include "guard.h"
#include "io/exr.h"
#include "predicates/clamped_int.h"

using carreau::InvalidArgument;
using carreau::Vec2;
using carreau::Vec3;
using carreau::atlas::OuterBorder;
using carreau::atlas::Polygon;
using namespace carreau::abi;

namespace carreau::abi {

/// The common content of the three handles.
template <typename Content>
struct Handle {
  std::atomic<bool>& busy_flag() noexcept { return busy; }
  const Content& get() const {
    if (!content) throw StatusError(CARREAU_ERR_SEQUENCE, "nothing was built yet");
    return *content;
  }
  std::shared_ptr<const Content> content = {};
  ErrorSlot error = {};
  std::atomic<bool> busy{false};
};

}  // namespace carreau::abi

struct carreau_loop : Handle<carreau::atlas::Loop> {};
struct carreau_annulus : Handle<carreau::atlas::Annulus> {};
struct carreau_atlas : Handle<carreau::atlas::BlendedSurface> {};

namespace {

template <typename T>
carreau_status create(T** out) {
  if (out == nullptr) return CARREAU_ERR_ARGUMENT;
  return status_of([&] { *out = new T(); });
}

template <typename T>
const char* sentence_of(const T* handle) {
  return handle == nullptr || handle->busy.load(std::memory_order_acquire) ? "" : handle->error.sentence.c_str();
}

/// Throws unless n is a number of rows and the arrays are there.
std::size_t rows(std::int64_t n, std::initializer_list<std::pair<const void*, const char*>> arrays) {
  if (n < 0) throw InvalidArgument("the number of rows is " + std::to_string(n));
  if (n > 0)
    for (const auto& [array, name] : arrays) required(array, name);
  return static_cast<std::size_t>(n);
}

Polygon polygon_of(std::int64_t n, const double* xy, const char* name) {
  Polygon polygon;
  for (std::size_t k = 0; k < rows(n, {{xy, name}}); ++k) polygon.emplace_back(xy[2 * k], xy[2 * k + 1]);
  return polygon;
}

void put(const Vec2& p, double* out, std::size_t row) { out[2 * row] = p.x(), out[2 * row + 1] = p.y(); }

void put_all(const Polygon& points, std::int64_t capacity, double* out, std::int64_t* out_count) {
  *required(out_count, "out_count") = static_cast<std::int64_t>(points.size());
  if (out == nullptr || capacity == 0) return;
  check_capacity(capacity, points.size(), "points");
  for (std::size_t k = 0; k < points.size(); ++k) put(points[k], out, k);
}

bool begins_outside(std::int32_t border) { return border == CARREAU_BORDER_OUTER_SPLINE || border == CARREAU_BORDER_OUTER_CUBIC; }

OuterBorder border_of(std::int32_t given) {
  switch (given) {
    case CARREAU_BORDER_SPLINE:
    case CARREAU_BORDER_OUTER_SPLINE:
      return OuterBorder::spline;
    case CARREAU_BORDER_CUBIC:
    case CARREAU_BORDER_OUTER_CUBIC:
      return OuterBorder::cubic;
    case CARREAU_BORDER_POLYGON:
      return OuterBorder::polygon;
    default:
      throw InvalidArgument("the border of an annulus is " + std::to_string(given) + "; it must be from 0 to 4");
  }
}

void require_finite(double value, const char* name) {
  if (!std::isfinite(value)) throw InvalidArgument(std::string(name) + " is not finite");
}

void require_share(double tau) {
  if (!(tau >= 0 && tau <= 1)) throw InvalidArgument("tau of an annulus must lie between 0 and 1");
}

std::size_t chart_of(const carreau::atlas::BlendedSurface& surface, std::int64_t chart) {
  const std::size_t count = surface.covering().charts().size();
  if (chart < 0 || static_cast<std::size_t>(chart) >= count)
    throw InvalidArgument("the atlas has no chart " + std::to_string(chart) + "; it has " + std::to_string(count) +
                          ", from 0");
  return static_cast<std::size_t>(chart);
}

std::int32_t number_of(carreau::atlas::Zone zone) {
  return zone == carreau::atlas::Zone::outside
             ? CARREAU_ZONE_OUTSIDE
             : (zone == carreau::atlas::Zone::shared ? CARREAU_ZONE_ANNULUS : CARREAU_ZONE_INSIDE);
}

carreau::atlas::Triangulation triangulation_of(std::int64_t n, const double* xyz, std::int64_t m,
                                               const std::int32_t* triangles) {
  carreau::atlas::Triangulation surface;
  for (std::size_t k = 0; k < rows(n, {{xyz, "xyz"}}); ++k)
    surface.vertices.emplace_back(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]);
  for (std::size_t k = 0; k < rows(m, {{triangles, "triangles"}}); ++k)
    surface.triangles.push_back({triangles[3 * k], triangles[3 * k + 1], triangles[3 * k + 2]});
  return surface;
}

/// tau, phi and zone at the centres of pixels.
void write_image(const carreau::atlas::Annulus& annulus, const char* path, int width) {
  Vec2 low = annulus.outer()[0], high = low;
  for (const Vec2& p : annulus.outer()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double step = (high.x() - low.x()) / width;
  carreau::ExrPart part;
  part.name = "annulus", part.width = width;
  part.height = carreau::clamped_int(std::ceil((high.y() - low.y()) / step), 1, 16 * width);
  part.channels = {
      {"phi", carreau::ExrType::real}, {"tau", carreau::ExrType::real}, {"zone", carreau::ExrType::integer}};
  part.attributes = {{"low", low}, {"pixel", step}};
  carreau::ExrWriter writer(path, {&part, 1}, {});
  const auto bits = [](double value) { return std::bit_cast<std::uint32_t>(static_cast<float>(value)); };
  writer.write_part(0, [&](int first, int rows) -> carreau::ExrFill {
    return [=, &annulus, &part](std::span<carreau::ExrPlane> planes) {
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < width; ++c) {
          const Vec2 p(low.x() + (c + .5) * step, low.y() + (part.height - first - r - .5) * step);
          const auto found = annulus.find(carreau::atlas::pair_of(p));
          const auto at = static_cast<std::size_t>(r) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c);
          planes[0][at] = bits(found ? found->phi : NAN), planes[1][at] = bits(found ? found->tau : NAN);
          planes[2][at] = static_cast<std::uint32_t>(
              found ? CARREAU_ZONE_ANNULUS : (annulus.encloses(p) ? CARREAU_ZONE_INSIDE : CARREAU_ZONE_OUTSIDE));
        }
    };
  });
  writer.commit();
}

}  // namespace

carreau_status carreau_loop_create(carreau_loop** out_loop) { return create(out_loop); }
void carreau_loop_free(carreau_loop* loop) { delete loop; }
const char* carreau_loop_last_error(const carreau_loop* loop) { return sentence_of(loop); }

carreau_status carreau_loop_build(carreau_loop* loop, int64_t n, const double xy[], int32_t speed) {
  return guarded(loop, [&] {
    if (speed != CARREAU_LOOP_EVEN && speed != CARREAU_LOOP_SMOOTH)
      throw InvalidArgument("the speed of a loop is " + std::to_string(speed) + "; it must be 0 or 1");
    using carreau::atlas::LoopSpeed;
    loop->content = std::make_shared<carreau::atlas::Loop>(
        polygon_of(n, xy, "xy"), speed == CARREAU_LOOP_SMOOTH ? LoopSpeed::smooth : LoopSpeed::even);
  });
}

carreau_status carreau_loop_points(carreau_loop* loop, int64_t n, const double phi[], double out_xy[],
                                   double out_derivatives[]) {
  return guarded(loop, [&] {
    for (std::size_t k = 0; k < rows(n, {{phi, "phi"}, {out_xy, "out_xy"}}); ++k) {
      const auto place = loop->get().at(phi[k]);
      put(place.point, out_xy, k);
      if (out_derivatives != nullptr) put(place.derivative, out_derivatives, k);
    }
  });
}

carreau_status carreau_loop_invert(carreau_loop* loop, int64_t n, const double xy[], double tolerance,
                                   double out_phi[]) {
  return guarded(loop, [&] {
    for (std::size_t k = 0; k < rows(n, {{xy, "xy"}, {out_phi, "out_phi"}}); ++k)
      out_phi[k] = loop->get().phi_of({xy[2 * k], xy[2 * k + 1]}, tolerance);
  });
}

carreau_status carreau_loop_pivots(carreau_loop* loop, int64_t capacity, double out_xy[], int64_t* out_count) {
  return guarded(loop, [&] { put_all(loop->get().pivots().place, capacity, out_xy, out_count); });
}

carreau_status carreau_annulus_create(carreau_annulus** out_annulus) { return create(out_annulus); }
void carreau_annulus_free(carreau_annulus* annulus) { delete annulus; }
const char* carreau_annulus_last_error(const carreau_annulus* annulus) { return sentence_of(annulus); }

carreau_status carreau_annulus_build(carreau_annulus* annulus, int64_t n, const double inner_xy[], int64_t m,
                                     const double outer_xy[], int32_t border, int32_t star) {
  return guarded(annulus, [&] {
    annulus->content = std::make_shared<carreau::atlas::Annulus>(
        polygon_of(n, inner_xy, "inner_xy"), polygon_of(m, outer_xy, "outer_xy"),
        carreau::atlas::AnnulusOptions{.border = border_of(border), .outer_first = begins_outside(border), .star = star != 0, .phi = {}});
  });
}

carreau_status carreau_annulus_points(carreau_annulus* annulus, int64_t n, const double tau_phi[], double out_xy[],
                                      double out_derivatives[]) {
  return guarded(annulus, [&] {
    for (std::size_t k = 0; k < rows(n, {{tau_phi, "tau_phi"}, {out_xy, "out_xy"}}); ++k) {
      using carreau::atlas::Jet;
      require_share(tau_phi[2 * k]), require_finite(tau_phi[2 * k + 1], "phi");
      const auto p = annulus->get().at(Jet(tau_phi[2 * k], 1, 0), Jet(tau_phi[2 * k + 1], 0, 1));
      put(value_of(p), out_xy, k);
      if (out_derivatives != nullptr)
        put({p[0].u, p[1].u}, out_derivatives, 2 * k), put({p[0].v, p[1].v}, out_derivatives, 2 * k + 1);
    }
  });
}

carreau_status carreau_annulus_invert(carreau_annulus* annulus, int64_t n, const double xy[], double out_tau_phi[],
                                      int32_t out_zones[]) {
  return guarded(annulus, [&] {
    for (std::size_t k = 0; k < rows(n, {{xy, "xy"}}); ++k) {
      const Vec2 p(xy[2 * k], xy[2 * k + 1]);
      const auto found = annulus->get().find(carreau::atlas::pair_of(p));
      const double period = annulus->get().period();
      if (out_tau_phi != nullptr)
        put(found ? Vec2(found->tau, found->phi - period * std::floor(found->phi / period)) : Vec2(0, 0), out_tau_phi,
            k);
      if (out_zones != nullptr)
        out_zones[k] =
            found ? CARREAU_ZONE_ANNULUS : (annulus->get().encloses(p) ? CARREAU_ZONE_INSIDE : CARREAU_ZONE_OUTSIDE);
    }
  });
}

carreau_status carreau_annulus_pivots(carreau_annulus* annulus, int64_t capacity, double out_xy[], int64_t* out_count) {
  return guarded(annulus, [&] { put_all(annulus->get().pivots().place, capacity, out_xy, out_count); });
}

carreau_status carreau_annulus_outer_border(carreau_annulus* annulus, int64_t capacity, double out_xy[],
                                            int64_t* out_count) {
  return guarded(annulus, [&] { put_all(annulus->get().described_outer(), capacity, out_xy, out_count); });
}

carreau_status carreau_annulus_skeleton(carreau_annulus* annulus, int64_t capacity, double out_edges[],
                                        int64_t* out_count) {
  return guarded(annulus, [&] {
    const auto skeleton = carreau::atlas::pseudo_skeleton(annulus->get().inner());
    *required(out_count, "out_count") = static_cast<std::int64_t>(skeleton.edges.size());
    if (out_edges == nullptr || capacity == 0) return;
    check_capacity(capacity, skeleton.edges.size(), "edges");
    for (std::size_t k = 0; k < skeleton.edges.size(); ++k)
      put(skeleton.edges[k].first, out_edges, 2 * k), put(skeleton.edges[k].second, out_edges, 2 * k + 1);
  });
}

carreau_status carreau_annulus_write_exr(carreau_annulus* annulus, const char* path, int32_t width) {
  return guarded(annulus, [&] {
    constexpr std::int32_t widest = 65536;
    if (width < 2 || width > widest)
      throw InvalidArgument("the width of an image is " + std::to_string(width) + "; it must be from 2 to 65536");
    write_image(annulus->get(), required(path, "path"), width);
  });
}

carreau_status carreau_atlas_create(carreau_atlas** out_atlas) { return create(out_atlas); }
void carreau_atlas_free(carreau_atlas* atlas) { delete atlas; }
const char* carreau_atlas_last_error(const carreau_atlas* atlas) { return sentence_of(atlas); }

carreau_status carreau_atlas_build(carreau_atlas* atlas, const carreau_atlas_options* options, int64_t n,
                                   const double xyz[], int64_t m, const int32_t triangles[], const int32_t clusters[]) {
  return guarded(atlas, [&] {
    carreau::atlas::CoveringOptions known;
    if (options != nullptr) {
      const carreau_atlas_options given = read_struct(options, "carreau_atlas_options");
      known.border = border_of(given.border), known.outer_first = begins_outside(given.border);
      if (known.border == OuterBorder::polygon)
        throw InvalidArgument("the borders of an atlas must be smooth; CARREAU_BORDER_POLYGON is not");
      if (given.reach != 0) known.hops = given.reach;
    }
    const auto surface = triangulation_of(n, xyz, m, triangles);
    if (clusters == nullptr || (n > 0 && clusters[0] == -1)) {
      atlas->content = std::make_shared<carreau::atlas::BlendedSurface>(carreau::atlas::Covering(surface, known));
      return;
    }
    const carreau::atlas::Partition partition(clusters, clusters + n);
    atlas->content =
        std::make_shared<carreau::atlas::BlendedSurface>(carreau::atlas::Covering(surface, partition, known));
  });
}

carreau_status carreau_atlas_count(carreau_atlas* atlas, carreau_atlas_counts* out_counts) {
  return guarded(atlas, [&] {
    const auto& covering = atlas->get().covering();
    carreau_atlas_counts counts{};
    counts.vertices = static_cast<std::int64_t>(covering.surface().vertices.size());
    counts.triangles = static_cast<std::int64_t>(covering.surface().triangles.size());
    counts.charts = static_cast<std::int64_t>(covering.charts().size());
    counts.triples = static_cast<std::int64_t>(covering.triples().size());
    for (const auto& chart : covering.charts())
      counts.mended += chart.annulus.pivot_choice() == carreau::atlas::PivotChoice::near;
    write_struct(counts, out_counts, "out_counts");
  });
}

carreau_status carreau_atlas_chart_info(carreau_atlas* atlas, int64_t chart, carreau_atlas_chart* out_chart) {
  return guarded(atlas, [&] {
    const auto& known = atlas->get().covering().charts()[chart_of(atlas->get(), chart)];
    carreau_atlas_chart info{};
    for (int k = 0; k < 3; ++k)
      info.origin[k] = known.frame.origin[k], info.u[k] = known.frame.u[k], info.v[k] = known.frame.v[k],
      info.normal[k] = known.frame.normal[k];
    info.period = known.annulus.period(), info.vertices = static_cast<std::int64_t>(known.members.size());
    write_struct(info, out_chart, "out_chart");
  });
}

carreau_status carreau_atlas_annulus_points(carreau_atlas* atlas, int64_t chart, int64_t n, const double tau_phi[],
                                            double out_xy[]) {
  return guarded(atlas, [&] {
    const auto& annulus = atlas->get().covering().charts()[chart_of(atlas->get(), chart)].annulus;
    for (std::size_t k = 0; k < rows(n, {{tau_phi, "tau_phi"}, {out_xy, "out_xy"}}); ++k) {
      require_share(tau_phi[2 * k]), require_finite(tau_phi[2 * k + 1], "phi");
      put(carreau::atlas::value_of(annulus.at(tau_phi[2 * k], tau_phi[2 * k + 1])), out_xy, k);
    }
  });
}

carreau_status carreau_atlas_zones(carreau_atlas* atlas, int64_t chart, int64_t n, const double xy[],
                                   int32_t out_zones[], double out_weights[]) {
  return guarded(atlas, [&] {
    const auto& covering = atlas->get().covering();
    const std::size_t i = chart_of(atlas->get(), chart);
    for (std::size_t k = 0; k < rows(n, {{xy, "xy"}}); ++k) {
      const Vec2 p(xy[2 * k], xy[2 * k + 1]);
      if (out_zones != nullptr) out_zones[k] = number_of(covering.zone(i, p));
      if (out_weights != nullptr) out_weights[k] = covering.weight(i, p);
    }
  });
}

carreau_status carreau_atlas_transition(carreau_atlas* atlas, int64_t i, int64_t j, int64_t n, const double xy[],
                                        double out_xy[], int32_t out_found[]) {
  return guarded(atlas, [&] {
    const std::size_t from = chart_of(atlas->get(), i), to = chart_of(atlas->get(), j);
    for (std::size_t k = 0; k < rows(n, {{xy, "xy"}, {out_xy, "out_xy"}, {out_found, "out_found"}}); ++k) {
      const auto place = atlas->get().covering().transition(from, to, {xy[2 * k], xy[2 * k + 1]});
      out_found[k] = place ? 1 : 0;
      if (place) put(*place, out_xy, k);
    }
  });
}

carreau_status carreau_atlas_points(carreau_atlas* atlas, int64_t chart, int64_t n, const double xy[], double out_xyz[],
                                    double out_derivatives[]) {
  return guarded(atlas, [&] {
    const std::size_t i = chart_of(atlas->get(), chart);
    for (std::size_t k = 0; k < rows(n, {{xy, "xy"}, {out_xyz, "out_xyz"}}); ++k) {
      require_finite(xy[2 * k] + xy[2 * k + 1], "a place of a chart");
      const carreau::SurfaceJet jet = atlas->get().at(i, {xy[2 * k], xy[2 * k + 1]});
      for (std::size_t c = 0; c < 3; ++c) {
        out_xyz[3 * k + c] = jet.s[static_cast<int>(c)];
        if (out_derivatives != nullptr)
          out_derivatives[6 * k + c] = jet.su[static_cast<int>(c)],
                                  out_derivatives[6 * k + 3 + c] = jet.sv[static_cast<int>(c)];
      }
    }
  });
}

carreau_status carreau_add_atlas(carreau_session* session, const carreau_atlas* atlas) {
  return guarded(session, [&] {
    required(atlas, "atlas")->get();
    carreau::BuiltGeometry built = carreau::atlas::build_atlas(atlas->content);
    session->add_geometry(CARREAU_GEOMETRY_ATLAS, std::move(built.cad), std::move(built.model));
  });
}
