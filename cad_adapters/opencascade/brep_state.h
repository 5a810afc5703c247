// SPDX-License-Identifier: BSD-3-Clause
// The data of a BrepHost about its shape, and the callbacks of a session. Private to BrepHost.
#pragma once

#include <Standard_Failure.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <atomic>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "brep_host.h"
#include "evaluators.h"
#include "loose_edges.h"
#include "solids.h"
#include "wire_periods.h"

namespace carreau_occ {

struct HostCurve {
  double first = 0, last = 1;
  int edge = 0;            // number of the edge
  int end1 = 0, end2 = 0;  // numbers of the vertices at first and last
  bool forward = true;     // the domain lies on the left of the curve, as OpenCASCADE counts (u, v)
  bool internal = false;
};

struct HostFace {
  int whole = 0;         // number of the face of the shape that it is, or is a part of
  bool swapped = false;  // u and v exchanged
  std::vector<HostCurve> curves;
  std::string name, layer;
  int32_t rgb = -1;    // 0xRRGGBB, -1: no colour
  double size = 0;     // 0: not set
  std::string broken;  // why it cannot be meshed; "": it can
  bool known = false;  // the evaluators have it
};

inline std::string sentence_of(const Standard_Failure& failure) {
  return std::string("OpenCASCADE: ") + failure.DynamicType()->Name() + ": " + failure.GetMessageString();
}

struct BrepHost::State : std::enable_shared_from_this<State> {
  std::shared_ptr<void> companion;  // goes last
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces, edges, vertices;
  std::vector<HostFace> host_faces;  // face number - 1; behind all faces the parts of faces that were cut
  std::vector<LooseEdge> wires;      // edges of no face: their references are behind the references of all faces and parts
  LooseCurves wire_curves;
  std::vector<int> uses;                             // of each edge, by its number - 1; behind all edges the pieces of cut edges
  int file_edges = 0, file_vertices = 0;             // without edges and vertices that repairs added
  Solids solids;
  std::map<int, std::string> edge_names, vertex_names;  // by number
  std::vector<std::string> notes;                    // repairs
  std::map<std::pair<int, bool>, int> missing_ends;  // vertices of edges that do not name them, by edge and last end
  int vertex_total = 0;                              // vertices of the shape and of cuts
  std::map<int, int> whole_edge;                     // of the numbers behind all edges that are pieces of one
  double shortest_free_piece = std::numeric_limits<double>::infinity();  // of edges of one face that were cut
  double free_gap = 0;                         // largest distance between such edges and their cuts
  std::vector<int> bent;                       // faces that bend inside and could not be cut, ascending
  std::optional<double> diagonal;              // once computed
  std::vector<double> edge_size, vertex_size;  // smallest of the faces beside, by number - 1; 0: none
  std::map<int, double> own_edge_sizes, own_vertex_sizes;  // by number
  Evaluators evaluators;
  std::mutex mutex;                     // of the next members: callbacks come from several threads
  std::map<int, std::string> failures;  // by face
  int sessions = 0;                     // sessions that use the callbacks
  std::shared_ptr<State> self;          // while there are some
  // Indexed by number - 1: faces whose surface, or curves, failed. They are not evaluated again, since a fault may have
  // left locks behind.
  std::unique_ptr<std::atomic<bool>[]> surface_failed, curves_failed;

  void collect();
  /// Own name and colour of each face, or the name and colour of the smallest part that holds it and has some.
  void collect_names(const ShapeFile& file);
  void collect_doubts(const ShapeFile& file);
  void collect_face(int number);
  [[nodiscard]] std::string endless(int number) const;
  /// The number of the vertex where the curve of an edge begins, or ends; 0: it has no end there.
  int end_of(const EdgeImage& image, bool last);
  /// Faces become parts that do not bend inside, where that can be done.
  void cut_kinks();
  void collect_wires(bool beside_faces);
  /// Boxes of known faces.
  void let_evaluate();
  /// The edge of a reference that belongs to a wire; nullptr: the reference belongs to a face.
  [[nodiscard]] const LooseEdge* wire(int reference) const noexcept;

  static int32_t surface_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                               double* Sv, double* Suu, double* Suv, double* Svv, void* user) noexcept;
  int32_t wire_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su, double* Sv,
                     double* Suu, double* Suv, double* Svv) noexcept;
  static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) noexcept;
  static int32_t curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                       void* user) noexcept;
  static int32_t surface_size(int32_t face, double u, double v, double* value, void* user) noexcept;
  static int32_t curve_size(int32_t face, int32_t ic, double t, double* value, void* user) noexcept;
  static int32_t point_size(int32_t point, double* value, void* user) noexcept;
  void collect_sizes();
  [[nodiscard]] GlueTolerances glue_tolerances() const;
  /// Runs it; an exception fails the face, and sets `failed`.
  template <typename Evaluate>
  int32_t answer_guarded(int32_t face, std::atomic<bool>& failed, const Evaluate& evaluate) noexcept;
  static const char* failure(int32_t face, void* user) noexcept;
  /// For the callbacks of a session: the state lives as long as they do.
  void* hold();
  static void release(void* user) noexcept;
  int32_t fail(int32_t face, const Standard_Failure& why) noexcept;
};

}  // namespace carreau_occ
