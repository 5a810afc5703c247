// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/side_by_side.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "geometry/discrete/refinement.h"
#include "support/error.h"

namespace carreau::discrete {

namespace {


class Joiner {
 public:
  explicit Joiner(std::span<const PlacedSurface> given) : given_(given) {}

  std::shared_ptr<const DiscreteSurface> run(std::vector<std::string>& sentences) {
    take_vertices();
    join();
    take_triangles();
    Triangulation mesh(flat_, false);
    const SharpOptions options{.corner_angle = half_turn, .marked_only = true, .references = false, .corners = corners()};
    SharpLines lines = find_sharp_lines(mesh, options);
    tell(mesh, sentences);
    add_findings(mesh.findings, lines);
    std::vector<std::int32_t> faces = mesh.refs;
    return std::make_shared<const DiscreteSurface>(std::move(mesh), std::move(lines), std::move(faces));
  }

 private:
  static constexpr double half_turn = 180;

  void take_vertices() {
    for (const PlacedSurface& each : given_) {
      const std::vector<Vec3>& vertices = each.surface->mesh().vertices;
      first_.push_back(static_cast<std::int32_t>(flat_.vertices.size()));
      if (vertices.size() + flat_.vertices.size() > std::size_t{std::numeric_limits<std::int32_t>::max()})
        throw LimitError("the surfaces of triangles have more vertices than can be numbered");
      flat_.vertices.insert(flat_.vertices.end(), vertices.begin(), vertices.end());
      const std::vector<std::int32_t>& refs = each.surface->mesh().vertex_refs;
      flat_.vertex_refs.insert(flat_.vertex_refs.end(), refs.begin(), refs.end());
    }
    first_.push_back(static_cast<std::int32_t>(flat_.vertices.size()));
  }

  [[nodiscard]] std::size_t surface_of(std::int32_t v) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(first_, v) - first_.begin()) - 1;
  }

  // One surface may have several vertices at a place: only the first one is joined to other surfaces.
  void join() {
    number_.resize(flat_.vertices.size());
    std::iota(number_.begin(), number_.end(), 0);
    const auto key = [&](std::int32_t v) {
      const Vec3& p = flat_.vertices[index(v)];
      return std::tuple(p.x(), p.y(), p.z());
    };
    std::vector<std::int32_t> order = number_;
    std::ranges::sort(order, [&](std::int32_t v, std::int32_t w) { return std::tuple(key(v), v) < std::tuple(key(w), w); });
    std::int32_t first = -1, before = -1;
    for (const std::int32_t v : order) {
      if (first < 0 || key(v) != key(first))
        first = v;
      else if (surface_of(v) != surface_of(before))
        number_[index(v)] = first, joined_ += surface_of(v) + 1 == given_.size() ? 1 : 0;
      before = v;
    }
    rank_.resize(number_.size());
    std::int32_t next = 0;
    for (std::size_t v = 0; v < rank_.size(); ++v)
      rank_[v] = number_[v] == static_cast<std::int32_t>(v) ? next++ : rank_[index(number_[v])];
  }

  void take_triangles() {
    for (std::size_t s = 0; s < given_.size(); ++s) {
      const DiscreteSurface& surface = *given_[s].surface;
      const auto moved = [&](std::int32_t v) { return number_[index(v + first_[s])]; };
      const std::vector<std::int32_t> refs = face_refs(surface);
      for (std::size_t t = 0; t < refs.size(); ++t) {
        const auto& [a, b, c] = surface.mesh().triangles[t];
        flat_.triangles.push_back({moved(a), moved(b), moved(c)});
        flat_.triangle_refs.push_back(refs[t] + given_[s].first_face - 1);
      }
      for (std::size_t e = 0; e < surface.mesh().edges.size(); ++e)
        if (surface.lines().sharp[e] != 0)
          flat_.edges.push_back({moved(surface.mesh().edges[e][0]), moved(surface.mesh().edges[e][1])});
    }
  }

  /// Corners of each surface by itself, as vertices of the whole.
  [[nodiscard]] std::vector<std::int32_t> corners() const {
    std::vector<std::int32_t> found;
    for (std::size_t s = 0; s < given_.size(); ++s)
      for (const std::int32_t v : given_[s].surface->lines().corners) found.push_back(rank_[index(v + first_[s])]);
    std::ranges::sort(found);
    return found;
  }

  template <typename Count>
  [[nodiscard]] std::int64_t sum(Count&& count) const {
    std::int64_t all = 0;
    for (const PlacedSurface& each : given_) all += count(*each.surface);
    return all;
  }

  void tell(const Triangulation& mesh, std::vector<std::string>& sentences) const {
    const auto say = [&](std::int64_t n, const std::string& what) {
      if (n > 0) sentences.push_back(std::to_string(n) + what);
    };
    say(joined_, " vertices belong to other surfaces of triangles, too: the meshes are joined there");
    const std::int32_t first = given_.back().first_face;
    say(static_cast<std::int64_t>(given_.back().surface->triangles()) -
            std::ranges::count_if(mesh.refs, [&](std::int32_t ref) { return ref >= first; }),
        " triangles belong to earlier surfaces: dropped");
    say(mesh.findings.turned_triangles, " triangles were oriented against other surfaces: turned");
    const std::int64_t alone = sum([](const DiscreteSurface& s) { return s.mesh().findings.manifold_breaks; });
    say(mesh.findings.manifold_breaks - alone, " edges have three triangles or more of several surfaces");
  }

  // Repairs of each surface are repairs of the whole.
  void add_findings(Findings& all, SharpLines& lines) const {
    for (const PlacedSurface& each : given_) {
      const Findings& own = each.surface->mesh().findings;
      all.repeated_triangles += own.repeated_triangles, all.flat_triangles += own.flat_triangles;
      all.turned_triangles += own.turned_triangles, all.joined_vertices += own.joined_vertices;
      lines.dropped += each.surface->lines().dropped, lines.prolonged += each.surface->lines().prolonged;
      lines.faded += each.surface->lines().faded;
    }
  }

  std::span<const PlacedSurface> given_;
  FlatMesh flat_;
  std::vector<std::int32_t> first_;   // of each surface in flat_, and the end
  std::vector<std::int32_t> number_;  // of a vertex, where it is joined
  std::vector<std::int32_t> rank_;    // the same in the triangulation
  std::int64_t joined_ = 0;  // vertices of the last surface
};

}  // namespace

std::shared_ptr<const DiscreteSurface> side_by_side(std::span<const PlacedSurface> given,
                                                    std::vector<std::string>& sentences) {
  if (given.size() == 1 && given.front().first_face == 1) return given.front().surface;
  return Joiner(given).run(sentences);
}

}  // namespace carreau::discrete
