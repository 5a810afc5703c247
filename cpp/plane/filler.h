// Points inside the domain: rows marched from the boundary, or points on long edges.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/triangulation.h"
#include "size/control_space.h"
#include "support/monitor.h"

namespace carreau::plane {

/// What all ways of filling share: insertion at unit distances, the limit, the pace of checkpoints.
class Filler {
 public:
  Filler(Triangulation& mesh, const ControlSpace& space, std::int64_t max_triangles, Monitor& monitor);

  /// Frontal: rows (README "Rows"), then circumcentres where triangles are still too large.
  void march();
  /// Algebraic: points on edges longer than unity until there are none (RR-2928 sec. 2.2).
  void split_long_edges();

 private:
  struct FrontEdge {
    HalfEdge edge;           // of a triangle that is not done
    std::int32_t a, b;       // its ends; the triangle lies on the left
    std::int32_t next = -1;  // edge that starts at b
    bool chained = false;
  };
  struct Candidate {
    Vec2 uv;
    HalfEdge edge;
    std::int32_t a;
  };

  void judge(int t);
  void find_front(bool first);
  void add_front_edge(HalfEdge he);
  Vec2 apex(const FrontEdge& edge) const;
  void chain_up();
  void respace();
  void merge_and_extend();
  void insert_row();
  void fill_leftovers(double radius, double distance);
  bool try_insert(Vec2 uv, Metric2 metric, int start, double distance, double height);
  int start_of(const Candidate& candidate) const;
  double distance(const Candidate& p, const Candidate& q) const;
  void check_limit();

  Triangulation& mesh_;
  const ControlSpace& space_;
  std::int64_t max_triangles_;
  Monitor& monitor_;
  double strain_limit_;
  std::vector<FrontEdge> front_;
  std::vector<std::int32_t> leaving_, arriving_;  // front edge by vertex
  std::vector<std::int32_t> touched_;
  std::vector<Candidate> chain_, spaced_, row_;
  std::vector<double> gaps_;
  long work_ = 0;
};

}  // namespace carreau::plane
