// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/divided_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plane/division/coarse_domain.h"
#include "plane/division/partition.h"
#include "plane/division/pieces.h"
#include "plane/division/undivided.h"
#include "plane/division/zone.h"
#include "plane/kernel/boundary.h"
#include "plane/kernel/thresholds.h"
#include "support/memory/free_memory.h"
#include "support/ranks/triangle_packet.h"
#include "support/stepped_tasks.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

// True if the zone would be most of the mesh and be improved twice: in narrow domains separators lie along the middle.
bool is_mostly_zone(const Pieces& pieces, double triangles) {
  return 4.0 * zone_layers * static_cast<double>(pieces.separators.size()) > max_of_zone * triangles;
}

// Units. In larger meshes separators may have longer straight parts: the coarse mesh, which one thread makes, has fewer
// triangles for each of the fine one.
double coarse_edge(double triangles) {
  return separator_length * std::sqrt(std::sqrt(std::max(triangles / (4 * triangles_a_piece), 1.0)));
}

// Empty if separators find no way.
std::optional<Pieces> cut(const ZoneContext& context, double a_piece) {
  // Pieces reach from the border to the meeting of the layers: more of them would become narrow.
  const double wanted = std::min(context.known.triangles / a_piece, 64.);
  const int parts = 2 * static_cast<int>(std::lround(0.5 * wanted));  // two threads finish together
  if (parts < 2) return {};
  const double edge = coarse_edge(context.known.triangles);
  ControlSpace wide = context.metric;
  wide.scale_lengths(1 / edge);
  const CoarseDomain coarse = make_coarse(context.domain, context.metric, edge);
  const PlaneMesherOptions options{.frontal = context.options.frontal, .max_triangles = context.options.max_triangles};
  const Field::Known known{.bends = context.known.bends, .triangles = context.known.triangles / (edge * edge)};
  const CoarseMesh mesh = make_coarse_mesh(coarse, wide, edge, known, options, context.monitor);
  context.monitor.checkpoint();
  const Partition partition = divide(mesh, coarse, parts, context.monitor);
  context.monitor.checkpoint();
  if (partition.parts < 2) return {};
  return make_pieces(context.domain, coarse, mesh, partition, context.metric, edge);
}

// True if a piece has edges of the domain. Around a pole, where layers come from the fan of another piece, it may lie
// between separators alone.
bool layers_can_start(const Piece& piece) {
  const auto rests = [&](int v) { return piece.on_separator[v] != 0; };
  return std::any_of(piece.domain.edges.begin(), piece.domain.edges.end(), [&](const PlaneEdge& edge) {
    return edge.kind == PlaneEdgeKind::degenerate || !(rests(edge.a) || rests(edge.b));
  });
}

void put_piece(PacketWriter& packet, const MeshedPiece& piece) {
  packet.put(piece.work.mesh.vertices);
  put_triangles(packet, piece.work.mesh.triangles);
  packet.put(std::int64_t{piece.work.fixed});
  for (const auto* numbers : {&piece.near.vertices, &piece.near.level, &piece.near.band, &piece.near.triangles})
    packet.put(*numbers);
}
MeshedPiece get_piece(PacketReader& packet) {
  MeshedPiece piece;
  piece.work.mesh.vertices = packet.plane_points();
  piece.work.mesh.triangles = triangles_of(packet);
  piece.work.fixed = static_cast<int>(packet.integer());
  for (auto* numbers : {&piece.near.vertices, &piece.near.level, &piece.near.band, &piece.near.triangles})
    *numbers = packet.integers();
  return piece;
}

std::vector<MeshedPiece> mesh_pieces(const Pieces& pieces, const ZoneContext& context) {
  const auto mesh_piece = [&](std::size_t p, Monitor& monitor) -> MeshedPiece {
    const Piece& piece = pieces.pieces[p];
    PlaneMesherOptions options = context.options;
    options.executor = {};
    if (layers_can_start(piece)) options.resting = piece.on_separator;
    const UndividedWork work =
        work_undivided(piece.domain, context.metric, {.bends = context.known.bends, .triangles = piece.triangles},
                       options, Improve::yes, monitor);
    PlaneMesh mesh = to_mesh(piece.domain, work.framed.mesh, work.framed.frame);
    NearSeparators near = near_separators(piece, pieces.separator, work.framed.mesh, mesh, monitor);
    return {{std::move(mesh), work.fixed}, std::move(near)};
  };
  return shared_work<MeshedPiece>(context.options.executor, "pieces", pieces.pieces.size(), false, mesh_piece, put_piece, get_piece,
                                  context.monitor);
}

// The system provides memory page by page, which takes longer than the writing: checks for a stop on the way.
template <class T>
void resize(std::vector<T>& values, std::size_t n, Monitor& monitor) {
  values.reserve(n);
  while (values.size() < n) {
    monitor.checkpoint();
    values.resize(std::min(n, values.size() + work_sizes::steps));
  }
}

/// Numbers the vertices of the whole mesh that are left, and puts them and the triangles together.
class Assembly {
 public:
  Assembly(const JoinedPieces& joined, const Zone& zone, const ZoneContext& context)
      : joined_(joined), zone_(zone), context_(context), count_(joined.pieces.pieces.size()) {}

  PlaneMesh run() {
    context_.monitor.checkpoint();
    find_removed();
    context_.monitor.checkpoint();
    number_vertices();
    count_triangles();
    run_each(
        count_, false, context_.options.executor.threads, [&](std::size_t p, Monitor&) { put_piece(p); }, context_.monitor);
    context_.monitor.checkpoint();
    put_zone();
    context_.monitor.checkpoint();
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::size_t domain_size() const { return context_.domain.vertices.size(); }

  void find_removed() {
    std::vector<char> used(zone_.vertices.size(), 0);
    for (const auto& t : zone_.triangles)
      for (const std::int32_t v : t) used[v] = 1;
    for (std::size_t v = 0; v < zone_.whole.size(); ++v)
      if (used[v] == 0) removed_.push_back(zone_.whole[v]);
    std::sort(removed_.begin(), removed_.end());
    for (std::size_t v = zone_.whole.size(); v < zone_.vertices.size(); ++v) added_.push_back(used[v] == 0 ? -1 : 0);
  }
  // Numbers of the whole mesh without removed vertices.
  [[nodiscard]] std::int32_t final_number(std::int32_t whole) const {
    if (removed_.empty() || whole < removed_.front()) return whole;
    return whole -
           static_cast<std::int32_t>(std::upper_bound(removed_.begin(), removed_.end(), whole) - removed_.begin());
  }

  void number_vertices() {
    const Pieces& pieces = joined_.pieces;
    const std::size_t last = count_ - 1;
    const auto all = static_cast<std::int32_t>(static_cast<std::size_t>(joined_.inside[last]) +
                                               joined_.mesh(last).vertices.size() - pieces.pieces[last].whole.size());
    auto next = all - static_cast<std::int32_t>(removed_.size());
    for (std::int32_t& number : added_)
      if (number == 0) number = next++;
    resize(mesh_.vertices, static_cast<std::size_t>(next), context_.monitor);
    std::copy(context_.domain.vertices.begin(), context_.domain.vertices.end(), mesh_.vertices.begin());
  }

  void count_triangles() {
    first_.assign(count_ + 1, 0);
    for (std::size_t p = 0; p < count_; ++p)
      first_[p + 1] = joined_.mesh(p).triangles.size() - joined_.meshes[p].near.triangles.size();
    for (std::size_t p = 0; p < count_; ++p) first_[p + 1] += first_[p];
    resize(mesh_.triangles, first_[count_] + zone_.triangles.size(), context_.monitor);
  }

  void put_piece(std::size_t p) {
    const PlaneMesh& mesh = joined_.mesh(p);
    std::vector<std::int32_t> number(mesh.vertices.size());
    const std::size_t shared = joined_.pieces.pieces[p].whole.size();
    // Inner vertices have consecutive numbers, without some removed ones.
    const std::int32_t inside = joined_.inside[p];
    auto gone = std::lower_bound(removed_.begin(), removed_.end(), inside);
    for (std::size_t v = 0; v < number.size(); ++v) {
      const std::int32_t whole = joined_.whole(p, static_cast<std::int32_t>(v));
      if (v < shared) {
        number[v] = final_number(whole);
        continue;
      }
      if (gone != removed_.end() && *gone == whole) {
        ++gone;
        continue;
      }
      number[v] = whole - static_cast<std::int32_t>(gone - removed_.begin());
      mesh_.vertices[number[v]] = mesh.vertices[v];
    }
    auto* to = mesh_.triangles.data() + first_[p];
    std::size_t t = 0;
    const auto put_until = [&](std::size_t end) {
      for (; t < end; ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        *to++ = {number[a], number[b], number[c]};
      }
    };
    for (const std::int32_t taken : joined_.meshes[p].near.triangles) {
      put_until(static_cast<std::size_t>(taken));
      ++t;
    }
    put_until(mesh.triangles.size());
  }

  // Vertices of the zone have moved; vertices of the domain have not.
  void put_zone() {
    std::vector<std::int32_t> number(zone_.vertices.size(), -1);
    for (std::size_t v = 0; v < zone_.vertices.size(); ++v)
      number[v] = v < zone_.whole.size() ? final_number(zone_.whole[v]) : added_[v - zone_.whole.size()];
    auto* to = mesh_.triangles.data() + first_[count_];
    for (const auto& t : zone_.triangles) {
      for (const std::int32_t v : t)
        if (static_cast<std::size_t>(number[v]) >= domain_size()) mesh_.vertices[number[v]] = zone_.vertices[v];
      *to++ = {number[t[0]], number[t[1]], number[t[2]]};
    }
  }

  const JoinedPieces& joined_;
  const Zone& zone_;
  const ZoneContext& context_;
  std::size_t count_;
  std::vector<std::int32_t> removed_;  // in numbers of the whole mesh, ascending
  std::vector<std::int32_t> added_;    // final numbers of the zone's new vertices; -1: removed again
  std::vector<std::size_t> first_;     // triangles, by piece
  PlaneMesh mesh_;
};

PlaneMesh assembled(const Pieces& pieces, const std::vector<MeshedPiece>& meshes, const ZoneContext& context) {
  const JoinedPieces joined = join(pieces, meshes);
  const Zone zone = improved_zone(joined, context);
  return Assembly(joined, zone, context).run();
}

// The meshes of its pieces have had 20 bytes a triangle, and the arrays of the next steps are too large for their places. [memory only]
constexpr double many_triangles = 5e6;

}  // namespace

bool is_worth_dividing(const Field::Known& known, const PlaneMesherOptions& options) noexcept {
  return known.triangles >= triangles_a_piece && !options.squares && options.undersampled.empty();
}

std::optional<PlaneMesh> mesh_divided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                                      const PlaneMesherOptions& options, Monitor& monitor, double a_piece) {
  (void)triangulate_boundary(domain, monitor);  // pieces cannot detect faults between them
  const InnerEdges inner(domain);
  const ZoneContext context{domain, inner, metric, known, options, monitor};
  try {
    const std::optional<Pieces> pieces = cut(context, a_piece);
    if (!pieces || is_mostly_zone(*pieces, known.triangles)) return {};
    PlaneMesh mesh = assembled(*pieces, mesh_pieces(*pieces, context), context);
    if (static_cast<double>(mesh.triangles.size()) > many_triangles) return_free_memory();
    if (static_cast<std::int64_t>(mesh.triangles.size()) > options.max_triangles)
      throw LimitError("the mesh of the plane domain has reached the limit of " +
                       std::to_string(options.max_triangles) + " triangles");
    return mesh;
  } catch (const DomainError&) {
    return {};
  }
}

}  // namespace carreau::plane
