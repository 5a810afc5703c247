// Swaps and moves that make triangles equilateral in the metric, and degrees six.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "control_space/sampled_normals.h"
#include "plane/kernel/frame.h"
#include "plane/kernel/shapes.h"
#include "plane/kernel/triangulation.h"
#include "plane/optimise/memo.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Never moves or removes the first `fixed` vertices, never touches imposed edges, never turns a triangle over. Leaves
/// removed triangles without vertices (-1) and removed vertices without a triangle.
class Optimiser {
 public:
  Optimiser(Triangulation& mesh, int fixed, const Field& field, Monitor& monitor);
  void run();
  /// At bad triangles, worst first, changes of the mesh around are tried, and the best is kept. Not where fields bend.
  /// On surfaces that are no planes, whose `normals` are given, none adds an edge between two fixed vertices, nor edges
  /// along which the surface turns more than along those that were there: flat spots.
  void improve_worst(const SampledNormals* normals);

 private:
  // swaps.cpp
  [[nodiscard]] bool has_long_edge(const Triangle& t) const;
  void collect_edges(std::int32_t first, std::int32_t end);
  void prefetch_beyond(std::size_t k) const;
  void swap_to_delaunay();
  void shorten_long_edges();
  [[nodiscard]] bool wants_swap(int t, int i) const;
  [[nodiscard]] bool wants_bent_swap(int a, int b, int c, int d) const;
  [[nodiscard]] double squared_length_along(int u, int v) const;
  void swap_to_degree_six();
  void count_degrees();

  // glides.cpp
  [[nodiscard]] int excess(int v) const { return static_cast<int>(degree_[v]) - static_cast<int>(wanted_degree_[v]); }
  [[nodiscard]] int swap_gain(int t, int i) const;
  [[nodiscard]] bool can_glide(int t, int i) const;
  void swap_counted(int t, int i);
  bool swap_around(int v);
  bool glide(int seven, int five, bool left, int reach);
  void cancel_pairs(int reach);
  void thin_out();
  void drop_removed();

  // sweeps.cpp
  /// Sweeps that damp waves of the mesh evenly: all those of whose lack they return `slowest` or more.
  struct Relaxation {
    int sweeps;
    double slowest;
  };
  /// What moves are after.
  struct Aim {
    double pull;   ///< 0: equilateral triangles; 1: unit lengths
    bool by_size;  ///< triangles count by the inverse of the size wanted
  };
  struct Sweep {
    double relaxation;  ///< share of the way to the mean of the proposals
    double momentum;    ///< share of the last move
  };
  void sweep_all(std::span<const double> relaxations, Aim aim);
  void relax(Relaxation relaxation, Aim aim);
  void sweep_all(std::span<const Sweep> sweeps, Aim aim);
  // `bends`: whether the field may bend, so that each triangle must be asked.
  template <bool by_size, bool bends>
  void sweep(Sweep how, double pull, bool first);
  void update_metrics();
  void prepare(bool by_size);
  template <bool by_size, bool bends>
  void propose(double pull);
  void propose_in_chart(const Triangle& T, double weight);
  template <bool bends>
  void find_spoiled();
  template <bool bends>
  void undo_spoiling_moves();
  bool undo(int v);
  template <bool bends>
  [[nodiscard]] bool sound(std::size_t t) const;

  // rescue.cpp
  /// Triangles that are helped: with an edge much too short, by removal of one of its ends; bad ones, too, by all
  /// means.
  enum class Needy : std::uint8_t { crowded, bad };
  void rescue_worst();
  void rescue_all(Needy needy);
  bool thin_out_at(int t);
  bool rescue(int t);
  bool rescue_by_swap(int t);
  bool rescue_by_move(int v);
  bool rescue_by_removal(int v, bool crowded);
  [[nodiscard]] bool is_crowded(int t) const;
  [[nodiscard]] bool is_good(const Triangle& T) const;
  bool rescue_by_insertion(int t);
  bool rescue_by_halving(int t);
  bool insert_to_improve(Vec2 p, int t, bool spaced);
  bool move_to_best(int v);
  void collapse(int v, int k);
  bool collect_star(int v);
  /// Of the star collected around v; `place`: the key of a vertex's place.
  template <typename Place>
  [[nodiscard]] PlaceKey key_of_star(int v, const Place& place) const {
    PlaceKey sum = 5 * place(v), last = place(ring_.back());
    for (const std::int32_t u : ring_) {
      const PlaceKey key = place(u);
      sum += key_of_side(last, key);
      last = key;
    }
    return sum;
  }
  [[nodiscard]] bool has_imposed_spoke(int v) const;
  /// What `of` says of the shapes of the star collected around v. Once the sum is `enough` the rest does not matter.
  template <typename Of>
  double star_sum(int v, double enough, const Of& of) {
    double sum = 0;
    std::size_t k = 0;
    for (; k < ring_.size() && sum < enough; ++k)
      sum += of(shape(v, ring_[k], ring_[k + 1 < ring_.size() ? k + 1 : 0]));
    shapes_asked_ += static_cast<std::int64_t>(k);
    return sum;
  }
  double star_penalty(int v, double enough);
  [[nodiscard]] double shape(int p, int q, int r) const;
  [[nodiscard]] Lengths integrated_lengths(int p, int q, int r) const;

  // trials.cpp
  struct Trial {
    enum class Kind : std::uint8_t { settle, swap, collapse, split } kind;
    std::int32_t a, b;   // swap, split: triangle and its edge; collapse: vertex
    double promise = 0;  // cost that is left after a quick try
  };
  /// Two rings of triangles around one, which a trial changes, and how they were.
  struct Zone {
    std::array<std::int32_t, 3> centre{};                         // corners of that triangle
    std::vector<std::int32_t> triangles, vertices, movable;       // inner vertices that are not fixed
    std::vector<std::pair<std::int32_t, Triangle>> as_they_were;  // these, and those around
    std::vector<std::pair<std::int32_t, Vertex>> old_vertices;
    std::vector<char> seen;                                                       // by vertex; scratch, 0 between uses
    std::size_t mesh_triangles = 0, mesh_vertices = 0, own = 0, own_movable = 0;  // numbers without what trials add
  };
  struct ZoneCost {
    double mean = 0, worst = 1, sum = 0;  // of triangles
    double shortest2 = 1, longest2 = 1;   // squared lengths of edges that are not imposed, and 1
    int across = 0;                       // halves of edges that are not imposed, between two fixed vertices
    // Of the surface along these edges, as chords of unit normals, from a floor on: largest square, sum of 4th powers.
    double turn2 = 0, turns4 = 0;
  };
  template <typename Use>
  void for_star(int v, const Use& use) const;
  void collect_zone(int t);
  void restore_zone();
  ZoneCost cost_of_zone(double enough);
  double known_shape(int p, int q, int r);
  Vec3 known_normal(int v);
  double star_cost(int v, double enough);
  void place(int v, Vec2 p);
  Vec2 best_place(int v, bool quick, bool settled);
  void move_in_zone(int v, bool quick);
  void swap_in_zone();
  void settle_zone(bool quick);
  void split_edge(int t, int i);
  bool collapse_in_zone(int v);
  bool apply(const Trial& trial);
  void list_trials(int t);
  bool improve_around(int t);

  // flat.cpp
  [[nodiscard]] double height(int p, int q, int r) const;
  [[nodiscard]] bool is_flat(int t) const;
  bool raise_by_swap(int t);
  bool raise_by_removal(int t);
  void raise_flat();

  Triangulation& mesh_;
  Shapes shapes_;
  int fixed_;
  const Field& field_;
  Monitor& monitor_;
  /// Of a triangle: the mean of its corners' metrics, scaled so that it turns a base into the height of the equilateral
  /// triangle on it; the weight of proposals, whose square is the root of the determinant of the sum of those metrics.
  /// In single precision, as vertices have them: sweeps read all of it time and again.
  struct Steady {
    float a, b, c, weight;
  };
  std::vector<Steady> steady_;                  // over the sweeps at hand, where triangles count by size
  std::vector<Vec2> proposals_;                 // by vertex, weighed and summed up
  std::vector<double> weights_;                 // their sums: exact, or places would shift by a share of the box
  std::vector<Vec2> before_;                    // places before the last sweep
  std::vector<std::int32_t> spoiled_, undone_;  // triangles spoiled by moves; vertices whose moves were taken back
  std::vector<HalfEdge> edges_;
  std::vector<std::int32_t> work_, next_;
  std::vector<std::int32_t> doubtful_;     // triangles that the rescue has looked at
  std::vector<std::int32_t> star_, ring_;  // triangles and vertices round the vertex at hand, counterclockwise
  std::int64_t shapes_asked_ = 0;          // of stars, by the rescue
  Zone zone_;
  std::vector<Trial> trials_;
  const SampledNormals* normals_ = nullptr;  // of a curved surface, during trials
  Findings<bool> failed_moves_;              // of stars, by the rescue
  Findings<bool> failed_points_;             // of new points and their cavities, by the rescue
  std::vector<PlaceKey> places_;             // by vertex, during trials
  Findings<double> known_shapes_;            // of triangles
  Findings<Vec2> known_moves_;               // of stars: where the vertex goes
  Findings<bool> known_swaps_;               // of diagonals: whether they are swapped
  Findings<Vec3> known_normals_;             // of places
  std::vector<std::uint8_t> degree_, wanted_degree_;
  std::vector<std::pair<std::int32_t, std::int32_t>> glided_;  // diagonals of the swaps of a glide
};

}  // namespace carreau::plane
