// SPDX-License-Identifier: BSD-3-Clause
/// Loops and annuli of the plane, C1 atlases of triangulated surfaces: carreau_atlas.h, see carreau.hpp.
#ifndef CARREAU_ATLAS_HPP
#define CARREAU_ATLAS_HPP

#include "../carreau_atlas.h"
#include "session.hpp"

namespace carreau {

namespace detail {

/// A handle of the C interface with functions that create and free it and return its last error.
template <typename Handle, auto Create, auto Free, auto LastError>
class Owned {
 public:
  Owned() {
    Handle* made = nullptr;
    if (const carreau_status status = Create(&made); status != CARREAU_OK) fail(status, "");
    handle_.reset(made);
  }
  [[nodiscard]] Handle* get() const { return handle_.get(); }
  void done(carreau_status status) const {
    if (status != CARREAU_OK) fail(status, LastError(get()));
  }
  /// Rows of numbers whose count the same function returns.
  template <std::size_t N, typename Copy>
  [[nodiscard]] std::vector<std::array<double, N>> counted(Copy&& copy) const {
    std::int64_t n = 0;
    done(copy(get(), 0, nullptr, &n));
    std::vector<std::array<double, N>> out(static_cast<std::size_t>(n));
    if (n > 0) done(copy(get(), n, flat(out), &n));
    return out;
  }

 private:
  struct Freed {
    void operator()(Handle* handle) const { Free(handle); }
  };
  std::unique_ptr<Handle, Freed> handle_;
};

} // namespace detail

/// A place and its derivatives by one parameter.
struct LoopPoints {
  std::vector<Point2> xy, derivatives;
};

/// A simple polygon with an angle phi as parameter, of period 2 pi.
class Loop {
 public:
  /// speed: CARREAU_LOOP_...; xy counterclockwise, the first vertex not repeated
  explicit Loop(std::span<const Point2> xy, int speed = CARREAU_LOOP_EVEN) { build(xy, speed); }
  void build(std::span<const Point2> xy, int speed) {
    handle_.done(carreau_loop_build(handle_.get(), detail::count_of(xy.size()), detail::flat(xy), speed));
  }
  [[nodiscard]] LoopPoints points(std::span<const double> phi) const {
    LoopPoints out{std::vector<Point2>(phi.size()), std::vector<Point2>(phi.size())};
    handle_.done(carreau_loop_points(handle_.get(), detail::count_of(phi.size()), detail::data_or_null(phi), detail::flat(out.xy),
                                     detail::flat(out.derivatives)));
    return out;
  }
  [[nodiscard]] std::vector<double> invert(std::span<const Point2> xy, double tolerance) const {
    std::vector<double> out(xy.size());
    handle_.done(carreau_loop_invert(handle_.get(), detail::count_of(xy.size()), detail::flat(xy), tolerance, out.data()));
    return out;
  }
  [[nodiscard]] std::vector<Point2> pivots() const { return handle_.counted<2>(carreau_loop_pivots); }
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_loop* get() const { return handle_.get(); }

 private:
  detail::Owned<carreau_loop, carreau_loop_create, carreau_loop_free, carreau_loop_last_error> handle_;
};

/// Places of an annulus: zones are CARREAU_ZONE_...
struct AnnulusPlaces {
  std::vector<Point2> tau_phi;
  std::vector<std::int32_t> zones;
};
/// Points of an annulus, and x, y by tau, then by phi.
struct AnnulusPoints {
  std::vector<Point2> xy;
  std::vector<std::array<double, 4>> derivatives;
};

/// The annulus between two polygons, both counterclockwise, with parameters tau in [0, 1] and phi of period 2 pi.
class Annulus {
 public:
  /// border: CARREAU_BORDER_...
  Annulus(std::span<const Point2> inner, std::span<const Point2> outer, int border = CARREAU_BORDER_SPLINE, bool star = false) {
    build(inner, outer, border, star);
  }
  void build(std::span<const Point2> inner, std::span<const Point2> outer, int border, bool star) {
    handle_.done(carreau_annulus_build(handle_.get(), detail::count_of(inner.size()), detail::flat(inner), detail::count_of(outer.size()),
                                       detail::flat(outer), border, star ? 1 : 0));
  }
  [[nodiscard]] AnnulusPoints points(std::span<const Point2> tau_phi) const {
    AnnulusPoints out{std::vector<Point2>(tau_phi.size()), std::vector<std::array<double, 4>>(tau_phi.size())};
    handle_.done(carreau_annulus_points(handle_.get(), detail::count_of(tau_phi.size()), detail::flat(tau_phi), detail::flat(out.xy),
                                        detail::flat(out.derivatives)));
    return out;
  }
  [[nodiscard]] AnnulusPlaces invert(std::span<const Point2> xy) const {
    AnnulusPlaces out{std::vector<Point2>(xy.size()), std::vector<std::int32_t>(xy.size())};
    handle_.done(carreau_annulus_invert(handle_.get(), detail::count_of(xy.size()), detail::flat(xy), detail::flat(out.tau_phi),
                                        out.zones.data()));
    return out;
  }
  [[nodiscard]] std::vector<Point2> pivots() const { return handle_.counted<2>(carreau_annulus_pivots); }
  [[nodiscard]] std::vector<Point2> outer_border() const { return handle_.counted<2>(carreau_annulus_outer_border); }
  /// Edges x y x y.
  [[nodiscard]] std::vector<std::array<double, 4>> skeleton() const { return handle_.counted<4>(carreau_annulus_skeleton); }
  void write_exr(const std::string& path, int width) const {
    handle_.done(carreau_annulus_write_exr(handle_.get(), path.c_str(), width));
  }
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_annulus* get() const { return handle_.get(); }

 private:
  detail::Owned<carreau_annulus, carreau_annulus_create, carreau_annulus_free, carreau_annulus_last_error> handle_;
};

/// Places in another chart; found: 1 where both charts have the place.
struct Transition {
  std::vector<Point2> xy;
  std::vector<std::int32_t> found;
};
/// Zones (CARREAU_ZONE_...) and weights of a chart.
struct ChartZones {
  std::vector<std::int32_t> zones;
  std::vector<double> weights;
};
/// Points of the blended surface; derivatives by x, then by y.
struct AtlasPoints {
  std::vector<Point3> xyz;
  std::vector<std::array<double, 6>> derivatives;
};

/// Charts of a closed triangulated surface and the C1 surface that they blend to. Charts count from 0.
class Atlas {
 public:
  /// clusters: of each vertex, or empty: the library makes them. struct_size of the options need not be set.
  Atlas(std::span<const Point3> xyz, std::span<const Triangle> triangles, std::span<const std::int32_t> clusters = {},
        const carreau_atlas_options& options = {}) {
    build(xyz, triangles, clusters, options);
  }
  void build(std::span<const Point3> xyz, std::span<const Triangle> triangles, std::span<const std::int32_t> clusters,
             const carreau_atlas_options& options) {
    if (!clusters.empty() && clusters.size() != xyz.size())
      detail::fail(CARREAU_ERR_ARGUMENT, "There are not as many clusters as vertices.");
    const carreau_atlas_options in = detail::sized(options);
    handle_.done(carreau_atlas_build(handle_.get(), &in, detail::count_of(xyz.size()), detail::flat(xyz),
                                     detail::count_of(triangles.size()), detail::flat(triangles), detail::data_or_null(clusters)));
  }
  [[nodiscard]] carreau_atlas_counts count() const {
    auto out = detail::sized<carreau_atlas_counts>();
    handle_.done(carreau_atlas_count(handle_.get(), &out));
    return out;
  }
  [[nodiscard]] carreau_atlas_chart chart(std::int64_t chart) const {
    auto out = detail::sized<carreau_atlas_chart>();
    handle_.done(carreau_atlas_chart_info(handle_.get(), chart, &out));
    return out;
  }
  [[nodiscard]] std::vector<Point2> annulus_points(std::int64_t chart, std::span<const Point2> tau_phi) const {
    std::vector<Point2> out(tau_phi.size());
    handle_.done(carreau_atlas_annulus_points(handle_.get(), chart, detail::count_of(out.size()), detail::flat(tau_phi), detail::flat(out)));
    return out;
  }
  [[nodiscard]] ChartZones zones(std::int64_t chart, std::span<const Point2> xy) const {
    ChartZones out{std::vector<std::int32_t>(xy.size()), std::vector<double>(xy.size())};
    handle_.done(
        carreau_atlas_zones(handle_.get(), chart, detail::count_of(xy.size()), detail::flat(xy), out.zones.data(), out.weights.data()));
    return out;
  }
  /// From chart i to chart j.
  [[nodiscard]] Transition transition(std::int64_t i, std::int64_t j, std::span<const Point2> xy) const {
    Transition out{std::vector<Point2>(xy.size()), std::vector<std::int32_t>(xy.size())};
    handle_.done(carreau_atlas_transition(handle_.get(), i, j, detail::count_of(xy.size()), detail::flat(xy), detail::flat(out.xy),
                                          out.found.data()));
    return out;
  }
  [[nodiscard]] AtlasPoints points(std::int64_t chart, std::span<const Point2> xy) const {
    AtlasPoints out{std::vector<Point3>(xy.size()), std::vector<std::array<double, 6>>(xy.size())};
    handle_.done(carreau_atlas_points(handle_.get(), chart, detail::count_of(xy.size()), detail::flat(xy), detail::flat(out.xyz),
                                      detail::flat(out.derivatives)));
    return out;
  }
  /// Adds the blended surface to a session, which does not need this object afterwards.
  void add_to(Session& session) const { session.done(carreau_add_atlas(session.get(), handle_.get())); }
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_atlas* get() const { return handle_.get(); }

 private:
  detail::Owned<carreau_atlas, carreau_atlas_create, carreau_atlas_free, carreau_atlas_last_error> handle_;
};

} // namespace carreau

#endif
