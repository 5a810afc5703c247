// Points inside the domain: rows marched from the boundary, points on long edges, circumcentres of what is left.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/plane_mesh.h"
#include "plane/kernel/frame.h"
#include "plane/kernel/shapes.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Places points until triangles are of unit size. Keeps distances, the limit and the pace of checkpoints.
class Filler {
 public:
  /// Caches the metric at the vertices. Vertices that end a degenerate edge keep no distance to new points (the
  /// edge does, as a whole).
  Filler(Triangulation& mesh, const Field& field, std::int64_t max_triangles, Monitor& monitor);

  /// Frontal: rows (README), then leftovers. May be called again, after settle().
  void march();
  /// Algebraic: points on edges longer than unity until there are none (RR-2928 sec. 2.2), then leftovers.
  void split_long_edges();
  /// Starts a mesh at a place of small sizes amid triangles whose vertices know nothing of it. False: it is outside,
  /// or not far from all vertices.
  bool settle(Vec2 place);
  /// Surrounds each degenerate edge of the domain by a fan of triangles of unit height (PlaneEdge::least_fan,
  /// wide_fan), imposed and frozen. Returns the number of vertices that must not move from now on: those imposed and
  /// those of the fans.
  int surround_degenerate_edges(const PlaneDomain& domain);

 private:
  struct FrontEdge {
    HalfEdge edge;           // of a triangle that is not done
    std::int32_t a, b;       // its ends; the triangle lies on the left
    std::int32_t next = -1;  // edge that starts at b
    bool chained = false, has_previous = false;
  };
  struct Candidate {
    Vec2 p;
    Metric2 metric;  // near p
    HalfEdge edge;   // the front edge it was placed on
    std::int32_t a;  // start of that edge
  };
  struct DegenerateEdge {
    std::int32_t a, b;
    int least_fan, wide_fan;  // triangles wanted around the point of space
    bool surrounded = false;
  };

  // filler.cpp
  void judge(int t);
  void judge_all();
  bool try_insert(Vec2 p, int start, double distance, double height);
  void insert_at(Vec2 p, Metric2 metric, Bend bend);
  [[nodiscard]] bool near_degenerate_edge(Vec2 p, Metric2 metric) const;
  [[nodiscard]] int start_of(const Candidate& candidate) const;
  void tick();
  void check_limit() const;

  // rows.cpp
  void find_front(bool first);
  void add_front_edge(HalfEdge he);
  void link_front();
  [[nodiscard]] std::int32_t next_around(const FrontEdge& edge) const;
  [[nodiscard]] Candidate apex(const FrontEdge& edge) const;
  [[nodiscard]] Candidate apex_in_charts(const FrontEdge& edge, Vec2 first) const;
  void chain_up();
  void insert_row();

  // respacing.cpp
  [[nodiscard]] double distance(const Candidate& p, const Candidate& q) const;
  void respace(bool closed);
  void merge_and_extend(bool closed);
  void go_round_corner(const Candidate& before, const Candidate& after);
  void share_strain();

  // leftovers.cpp
  [[nodiscard]] double distance_at_middle(Vec2 p, Vec2 q) const;
  [[nodiscard]] double graded_radius(double radius) const;
  void fill_leftovers(double radius, double distance);
  [[nodiscard]] Vec2 circumcentre(int t) const;
  bool shorten(int t);
  bool halve(int t);
  bool fill_at(Vec2 p, int t, double distance);

  // deserts.cpp
  [[nodiscard]] int triangle_at(Vec2 p) const;

  // degenerate.cpp
  struct Ring;
  void surround(DegenerateEdge& edge);
  [[nodiscard]] Ring sample_ring(const DegenerateEdge& edge) const;
  [[nodiscard]] std::vector<Vec2> walk(Vec2 from, Vec2 direction, int hint) const;
  [[nodiscard]] std::vector<Vec2> points_on(const Ring& ring, double height, const DegenerateEdge& edge,
                                            double& spacing) const;
  bool freeze_fan(const DegenerateEdge& edge, const std::vector<std::int32_t>& fan);

  Triangulation& mesh_;
  Shapes shapes_;
  const Field& field_;
  std::int64_t max_triangles_;
  Monitor& monitor_;
  std::vector<DegenerateEdge> degenerate_;
  std::vector<std::int32_t> degenerate_ends_;
  double strain_limit_;
  std::vector<FrontEdge> front_;
  std::vector<std::int32_t> leaving_;  // front edge by the vertex it leaves; -1 none, -2 several
  std::vector<std::int32_t> several_;  // front edges that leave such vertices
  std::vector<std::int32_t> touched_;  // triangles made by the last row
  std::vector<Candidate> chain_, spaced_, row_;
  std::vector<double> gaps_;
  std::vector<HalfEdge> long_edges_;
  long work_ = 0;
};

}  // namespace carreau::plane
