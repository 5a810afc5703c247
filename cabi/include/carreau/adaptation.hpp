// SPDX-License-Identifier: BSD-3-Clause
/// From a field to a mesh that carries it: see carreau.hpp.
#ifndef CARREAU_ADAPTATION_HPP
#define CARREAU_ADAPTATION_HPP

#include <limits>

#include "session.hpp"

namespace carreau {

/// Sizes at the vertices of a mesh, and metrics unless only sizes were requested.
struct Estimate {
  std::vector<double> sizes; ///< the smallest of each metric
  std::vector<Tensor3> metrics;
};

/// A field on the latest mesh.
struct Transferred {
  std::vector<double> values;  ///< vertices x components
  std::int64_t outside = 0;    ///< vertices beside the old mesh; they have the nearest value
};

/// A loop of adaptation: carreau_adaptation.
struct Adaptation {
  carreau_estimator estimator{}; ///< struct_size need not be set
  /// Fills a value for each point of space. An exception ends the loop.
  std::function<void(std::span<const Point3> points, std::span<double> values)> field{};
  int iterations = 0;       ///< at most; 0: 5
  bool differences = false; ///< derivatives of the field itself (plane z = 0 only)
  double convergence = 0;   ///< ends when the number of triangles changes by a smaller share
};

/// The result of a loop of adaptation.
struct Adapted {
  Outcome outcome = Outcome::complete;
  carreau_adaptation_report report{};
};

/// Sizes or metrics from values at the vertices of the session's mesh; struct_size of the estimator need not be set.
inline Estimate estimate(Session& session, const carreau_estimator& estimator, std::span<const double> values) {
  const carreau_estimator in = detail::sized(estimator);
  Estimate out{std::vector<double>(values.size()), std::vector<Tensor3>(values.size())};
  session.done(carreau_estimate(session.get(), &in, detail::count_of(values.size()), detail::data_or_null(values), out.sizes.data(),
                                detail::flat(out.metrics)));
  return out;
}

/// Interpolates a field of `components` values a vertex from the mesh before to the mesh now. Elements of second order
/// have them at all nodes, corners first; values at corners alone are carried to corners, and rows of other nodes are NaN.
inline Transferred transfer(Session& session, std::span<const double> values, int components = 1) {
  const auto width = static_cast<std::size_t>(std::max(components, 1));
  const std::int64_t capacity = session.mesh().vertex_count();
  Transferred out{std::vector<double>(static_cast<std::size_t>(capacity) * width, std::numeric_limits<double>::quiet_NaN()), 0};
  if (values.size() % width != 0) detail::fail(CARREAU_ERR_ARGUMENT, "The values of a field do not fill whole rows.");
  session.done(carreau_transfer(session.get(), components, detail::count_of(values.size() / width), detail::data_or_null(values),
                                capacity, out.values.data(), &out.outside));
  return out;
}

/// The loop by files: fields on the last mesh make the sizes of the next one,
inline void set_background_fields(Session& session, const std::string& mesh_path, const std::string& sol_path) {
  session.done(carreau_set_background_fields(session.get(), mesh_path.c_str(), sol_path.c_str()));
}
/// and go over to it. Returns the number of vertices beside the old mesh.
inline std::int64_t transfer_files(Session& session, const std::string& mesh_path, const std::string& sol_path,
                                   const std::string& out_path) {
  std::int64_t outside = 0;
  session.done(carreau_transfer_files(session.get(), mesh_path.c_str(), sol_path.c_str(), out_path.c_str(), &outside));
  return outside;
}

/// Adapts the mesh in a loop: it estimates, sets new sizes on the mesh, and meshes again.
inline Adapted adapt(Session& session, const Adaptation& adaptation) {
  struct Held {
    const Adaptation& adaptation;
    detail::Faults& faults;
  } held{adaptation, session.faults()};
  const carreau_estimator estimator = detail::sized(adaptation.estimator);
  auto in = detail::sized<carreau_adaptation>();
  in.estimator = &estimator;
  in.user = &held;
  in.iterations = adaptation.iterations;
  in.differences = adaptation.differences ? 1 : 0;
  in.convergence = adaptation.convergence;
  if (adaptation.field)
    in.field = [](std::int64_t n, const double* xyz, double* values, void* user) -> std::int32_t {
      const auto& state = *static_cast<Held*>(user);
      const auto size = static_cast<std::size_t>(n);
      return state.faults.guarded(
          [&] { state.adaptation.field({reinterpret_cast<const Point3*>(xyz), size}, {values, size}); });
    };
  Adapted out;
  out.report.struct_size = sizeof out.report;
  out.outcome = session.outcome(carreau_adapt(session.get(), &in, &out.report));
  return out;
}

} // namespace carreau

#endif
