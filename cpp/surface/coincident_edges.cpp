#include "surface/coincident_edges.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "predicates/predicates.h"

namespace carreau {
namespace {

// Each round halves the way round a vertex; a loop needs two.
constexpr int most_rounds = 8;

using Pair = std::array<int, 2>;
Pair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class Divider {
 public:
  Divider(const FaceDomain& domain, PlaneMesh& mesh) : mesh_(mesh) {
    identify(domain);
    for (const PlaneEdge& edge : domain.plane.edges) {
      imposed_.push_back(ordered(edge.a, edge.b));
      if (edge.kind == PlaneEdgeKind::degenerate) degenerate_.push_back(imposed_.back());
    }
    std::sort(imposed_.begin(), imposed_.end());
    std::sort(degenerate_.begin(), degenerate_.end());
  }

  int run() {
    const std::size_t before = mesh_.vertices.size();
    if (has_images_)
      for (int round = 0; round < most_rounds; ++round)
        if (!divide(find())) break;
    return static_cast<int>(mesh_.vertices.size() - before);
  }

 private:
  /// A side of a triangle.
  struct Side {
    Pair in_space, in_plane;
    int triangle;
    bool flat;  // the triangle has no area in space
    friend bool operator<(const Side& p, const Side& q) {
      return std::tie(p.in_space, p.in_plane, p.triangle) < std::tie(q.in_space, q.in_plane, q.triangle);
    }
  };
  using Sides = std::vector<Side>::const_iterator;

  // Vertices of the domain that are one in space get one number: the first of them.
  void identify(const FaceDomain& domain) {
    std::vector<std::pair<std::array<int, 3>, int>> places;
    image_of_.resize(domain.origin.size());
    several_.assign(domain.origin.size(), 0);
    curve_of_.assign(domain.origin.size(), -1);
    for (int v = 0; v < static_cast<int>(domain.origin.size()); ++v) {
      const DomainVertexOrigin& o = domain.origin[v];
      image_of_[v] = v;
      if (o.curve < 0) continue;
      if (o.corner < 0) curve_of_[v] = o.curve;
      const std::array<int, 3> key =
          o.corner >= 0 ? std::array<int, 3>{0, o.corner, 0} : std::array<int, 3>{1, o.curve, o.node};
      places.emplace_back(key, v);
    }
    std::sort(places.begin(), places.end());
    std::size_t first = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (places[i].first != places[first].first) {
        first = i;
        continue;
      }
      image_of_[places[i].second] = places[first].second;
      several_[places[i].second] = several_[places[first].second] = 1;
      has_images_ = true;
    }
  }
  [[nodiscard]] bool has_several(int v) const { return v < static_cast<int>(several_.size()) && several_[v] != 0; }
  // From one side of a seam to the other: all the way round.
  [[nodiscard]] bool goes_round(Pair edge) const {
    const auto [a, b] = edge;
    return has_several(a) && has_several(b) && curve_of_[a] >= 0 && curve_of_[a] == curve_of_[b] &&
           (image(a) == a) != (image(b) == b);
  }
  [[nodiscard]] int image(int v) const { return v < static_cast<int>(image_of_.size()) ? image_of_[v] : v; }
  [[nodiscard]] bool is_imposed(Pair edge) const { return std::binary_search(imposed_.begin(), imposed_.end(), edge); }

  // Inner edges to divide, each with its two triangles.
  std::vector<std::pair<Sides, Sides>> find() {
    collect();
    std::vector<std::pair<Sides, Sides>> found;
    for (Sides first = sides_.cbegin(); first != sides_.cend();) {
      const Sides last =
          std::find_if(first, sides_.cend(), [&](const Side& s) { return s.in_space != first->in_space; });
      const bool loop = first->in_space[0] == first->in_space[1];
      const bool on_curve = std::any_of(first, last, [&](const Side& s) { return is_imposed(s.in_plane); });
      const auto real = std::count_if(first, last, [](const Side& s) { return !s.flat; });
      for (Sides s = first; s != last && s + 1 != last; ++s)
        if (s->in_plane == (s + 1)->in_plane && !is_imposed(s->in_plane) &&
            (loop || goes_round(s->in_plane) || ((on_curve || real > 2) && !s->flat && !(s + 1)->flat)))
          found.emplace_back(s, s + 1);
      first = last;
    }
    return found;
  }

  void collect() {
    sides_.clear();
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      const auto& c = mesh_.triangles[t];
      if (!has_several(c[0]) && !has_several(c[1]) && !has_several(c[2])) continue;
      bool flat = false;
      for (int i = 0; i < 3; ++i) flat |= image(c[i]) == image(c[(i + 1) % 3]);
      for (int i = 0; i < 3; ++i) {
        const int a = c[i], b = c[(i + 1) % 3];
        if (!has_several(a) && !has_several(b)) continue;
        const Pair edge = ordered(a, b);
        if (image(a) == image(b) && std::binary_search(degenerate_.begin(), degenerate_.end(), edge)) continue;
        sides_.push_back({ordered(image(a), image(b)), edge, t, flat});
      }
    }
    std::sort(sides_.begin(), sides_.end());
  }

  // A triangle is cut once a round.
  bool divide(const std::vector<std::pair<Sides, Sides>>& edges) {
    std::vector<int> cut;
    bool any = false;
    for (const auto& [one, other] : edges) {
      const auto is_cut = [&](int t) { return std::find(cut.begin(), cut.end(), t) != cut.end(); };
      if (is_cut(one->triangle) || is_cut(other->triangle)) continue;
      if (!divide_edge(one->in_plane, one->triangle, other->triangle)) continue;
      cut.insert(cut.end(), {one->triangle, other->triangle});
      any = true;
    }
    return any;
  }

  bool divide_edge(Pair edge, int t, int u) {
    const Vec2 middle = 0.5 * (mesh_.vertices[edge[0]] + mesh_.vertices[edge[1]]);
    const auto m = static_cast<std::int32_t>(mesh_.vertices.size());
    std::array<std::array<std::int32_t, 3>, 4> pieces;
    for (int k = 0; k < 2; ++k) {
      const auto& c = mesh_.triangles[k == 0 ? t : u];
      pieces[2 * k] = pieces[2 * k + 1] = c;
      for (int i = 0; i < 3; ++i) {
        if (ordered(c[i], c[(i + 1) % 3]) != edge) continue;
        pieces[2 * k][(i + 1) % 3] = m;
        pieces[2 * k + 1][i] = m;
      }
    }
    const auto place = [&](std::int32_t v) { return v == m ? middle : mesh_.vertices[v]; };
    for (const auto& p : pieces)
      if (orientation(place(p[0]), place(p[1]), place(p[2])) <= 0) return false;
    mesh_.vertices.push_back(middle);
    mesh_.triangles[t] = pieces[0];
    mesh_.triangles[u] = pieces[2];
    mesh_.triangles.push_back(pieces[1]);
    mesh_.triangles.push_back(pieces[3]);
    return true;
  }

  PlaneMesh& mesh_;
  std::vector<int> image_of_, curve_of_;  // of the domain's vertices; -1: a corner
  std::vector<char> several_;             // of the domain's vertices: there are other images of it
  bool has_images_ = false;
  std::vector<Pair> imposed_, degenerate_;
  std::vector<Side> sides_;
};

}  // namespace

int divide_coincident_edges(const FaceDomain& domain, PlaneMesh& mesh) { return Divider(domain, mesh).run(); }

}  // namespace carreau
