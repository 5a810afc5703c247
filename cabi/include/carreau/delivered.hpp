// SPDX-License-Identifier: BSD-3-Clause
/// Measures of a mesh against the prescribed sizes: see carreau.hpp.
#ifndef CARREAU_DELIVERED_HPP
#define CARREAU_DELIVERED_HPP

#include "session.hpp"

namespace carreau {

/// Measures the latest mesh of a session on the surface. `kind` is CARREAU_MEASURE_... It refers to the session.
class Delivered {
 public:
  explicit Delivered(const Session& session) : session_(session), figures_(session.filled(carreau_session_delivered)) {
    text_ = figures_.text == nullptr ? "" : figures_.text;
    figures_.text = nullptr; // it would not outlive the next call
  }

  /// Counts and shares; its member text is NULL: see text().
  [[nodiscard]] const carreau_delivered& figures() const { return figures_; }
  /// A line for each kind, then a sentence for each prescription that is not met.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] carreau_measure measure(int kind) const {
    auto out = detail::sized<carreau_measure>();
    session_.done(carreau_delivered_measure(session_.get(), kind, &out));
    return out;
  }
  /// Rows of a lower bound, -infinity at first, and the number of values from there up to the next.
  [[nodiscard]] std::vector<std::pair<double, std::int64_t>> histogram(int kind) const {
    const auto n = static_cast<std::size_t>(measure(kind).classes);
    std::vector<double> bounds(n);
    std::vector<std::int64_t> counts(n);
    session_.done(carreau_delivered_histogram(session_.get(), kind, detail::count_of(n), bounds.data(), counts.data()));
    std::vector<std::pair<double, std::int64_t>> out;
    for (std::size_t i = 0; i < n; ++i) out.emplace_back(bounds[i], counts[i]);
    return out;
  }
  /// One value for each edge, vertex or triangle; NaN where it has no meaning.
  [[nodiscard]] std::vector<double> values(int kind) const {
    std::vector<double> out(static_cast<std::size_t>(measure(kind).values));
    session_.done(carreau_delivered_values(session_.get(), kind, detail::count_of(out.size()), out.data()));
    return out;
  }
  /// Edges of all triangles, each once, the smaller vertex first.
  [[nodiscard]] std::vector<Edge> edges() const {
    std::vector<Edge> out(static_cast<std::size_t>(figures_.edges));
    session_.done(carreau_delivered_edges(session_.get(), figures_.edges, detail::flat(out), nullptr));
    return out;
  }
  /// References of the curves of these edges; 0 inside faces.
  [[nodiscard]] std::vector<std::int32_t> edge_curves() const {
    std::vector<std::int32_t> out(static_cast<std::size_t>(figures_.edges));
    session_.done(carreau_delivered_edges(session_.get(), figures_.edges, nullptr, out.data()));
    return out;
  }
  /// The edge that leaves each corner of a triangle.
  [[nodiscard]] std::vector<Triangle> triangle_edges() const {
    std::vector<Triangle> out(static_cast<std::size_t>(figures_.triangles));
    session_.done(carreau_delivered_triangle_edges(session_.get(), figures_.triangles, detail::flat(out)));
    return out;
  }
  /// As JSON.
  void write(const std::string& path) const { session_.done(carreau_delivered_write(session_.get(), path.c_str())); }

 private:
  const Session& session_;
  carreau_delivered figures_;
  std::string text_;
};

} // namespace carreau

#endif
