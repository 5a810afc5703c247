// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "arguments.h"
#include "guard.h"
#include "measure/mesh_evaluation.h"

using carreau::Delivery;
using carreau::EvaluatedMeasure;
using carreau::EvaluationEntity;
using carreau::EvaluationKind;
using carreau::InvalidArgument;
using carreau::MeshEvaluation;
using namespace carreau::abi;

static_assert(int(EvaluationKind::length) == CARREAU_MEASURE_LENGTH);
static_assert(int(EvaluationKind::edge_angle) == CARREAU_MEASURE_EDGE_ANGLE);
static_assert(int(EvaluationKind::gradation) == CARREAU_MEASURE_GRADATION);
static_assert(int(EvaluationKind::length_ratio) == CARREAU_MEASURE_LENGTH_RATIO);
static_assert(int(EvaluationKind::q1) == CARREAU_MEASURE_Q1);
static_assert(int(EvaluationKind::q2) == CARREAU_MEASURE_Q2);
static_assert(int(EvaluationKind::metric_quality) == CARREAU_MEASURE_METRIC_QUALITY);
static_assert(int(EvaluationKind::deviation) == CARREAU_MEASURE_A0);
static_assert(int(EvaluationKind::angle) == CARREAU_MEASURE_A1);
static_assert(int(EvaluationKind::curve_deviation) == CARREAU_MEASURE_CURVE_A0);
static_assert(int(EvaluationKind::curve_angle) == CARREAU_MEASURE_CURVE_A1);
static_assert(int(EvaluationKind::vertex_angle) == CARREAU_MEASURE_VERTEX_ANGLE);
static_assert(int(EvaluationKind::deviation_bound) == CARREAU_MEASURE_A0_BOUND);
static_assert(int(EvaluationKind::angle_bound) == CARREAU_MEASURE_A1_BOUND);
static_assert(int(EvaluationKind::bound_share) == CARREAU_MEASURE_BOUND_SHARE);
static_assert(int(EvaluationKind::input_bound) == CARREAU_MEASURE_INPUT_BOUND);
static_assert(int(EvaluationEntity::edge) == CARREAU_OF_EDGES);
static_assert(int(EvaluationEntity::vertex) == CARREAU_OF_VERTICES);
static_assert(int(EvaluationEntity::triangle) == CARREAU_OF_TRIANGLES);

namespace {

const MeshEvaluation& evaluation_of(carreau_session& handle) {
  if (!handle.session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
  handle.monitor.begin_run();
  return handle.session.delivered();
}

const EvaluatedMeasure& row_of(std::int32_t kind) {
  const auto table = carreau::delivered_measures();
  if (kind < 1 || std::size_t(kind) > table.size())
    throw InvalidArgument("there is no measure " + std::to_string(kind) + ": they are 1 to " +
                          std::to_string(table.size()));
  return table[std::size_t(kind) - 1];
}

const Delivery& delivery_of(carreau_session& handle, std::int32_t kind) {
  const EvaluatedMeasure& row = row_of(kind);  // a wrong kind must not cost a measure
  return evaluation_of(handle)[row.kind];
}

}  // namespace

carreau_status carreau_session_delivered(carreau_session* session, carreau_delivered* out_delivered) {
  return guarded(session, [&] {
    required(out_delivered, "out_delivered");
    const MeshEvaluation& delivered = evaluation_of(*session);
    const carreau::DeliveredText text = carreau::describe(delivered);
    session->text.clear();
    for (const auto& lines : {text.summary, text.not_met})
      for (const std::string& line : lines) session->text += (session->text.empty() ? "" : "\n") + line;
    carreau_delivered result{};
    result.vertices = std::int64_t(session->session.mesh().vertices.size());
    result.edges = std::int64_t(delivered.edges.vertices.size());
    result.triangles = std::int64_t(delivered.edges.of_triangle.size());
    result.short_edges = delivered.short_edges;
    result.long_edges = delivered.long_edges;
    result.folded_triangles = delivered.folded_triangles;
    result.in_range = delivered.share_in_range();
    result.not_met = std::int64_t(text.not_met.size());
    result.text = session->text.c_str();
    result.surf0_calls = delivered.calls.surf0;
    result.surf1_calls = delivered.calls.surf1;
    result.surf2_calls = delivered.calls.surf2;
    result.size_calls = delivered.calls.sizes;
    result.seconds = delivered.seconds;
    result.input_distance = delivered.input.distance, result.input_bound = delivered.input.bound;
    result.input_back_distance = delivered.input.back_distance;
    result.input_back_bound = delivered.input.back_bound;
    write_struct(result, out_delivered, "out_delivered");
  });
}

carreau_status carreau_delivered_measure(carreau_session* session, int32_t kind, carreau_measure* out_measure) {
  return guarded(session, [&] {
    required(out_measure, "out_measure");
    const EvaluatedMeasure& row = row_of(kind);
    const Delivery& one = delivery_of(*session, kind);
    carreau_measure result{};
    result.name = row.name;
    result.title = row.title;
    result.entity = std::int32_t(row.entity);
    result.classes = std::int32_t(one.spread.histogram.count.size());
    result.values = std::int64_t(one.values.size());
    result.count = one.spread.count;
    result.mean = one.spread.mean, result.min = one.spread.min, result.p1 = one.spread.p1;
    result.p99 = one.spread.p99, result.max = one.spread.max;
    result.limit = one.limit;
    result.beyond = one.beyond;
    result.forced = one.forced;
    write_struct(result, out_measure, "out_measure");
  });
}

carreau_status carreau_delivered_histogram(carreau_session* session, int32_t kind, int64_t capacity, double* out_bounds,
                                           int64_t* out_counts) {
  return guarded(session, [&] {
    required(out_bounds, "out_bounds");
    required(out_counts, "out_counts");
    const carreau::Histogram& histogram = delivery_of(*session, kind).spread.histogram;
    check_capacity(capacity, histogram.count.size(), "classes");
    std::copy(histogram.count.begin(), histogram.count.end(), out_counts);
    std::copy(histogram.bound.begin(), histogram.bound.end() - 1, out_bounds);
  });
}

carreau_status carreau_delivered_values(carreau_session* session, int32_t kind, int64_t capacity, double* out_values) {
  return guarded(session, [&] {
    required(out_values, "out_values");
    const std::vector<double>& values = delivery_of(*session, kind).values;
    check_capacity(capacity, values.size(), "values");
    std::copy(values.begin(), values.end(), out_values);
  });
}

carreau_status carreau_delivered_edges(carreau_session* session, int64_t capacity, int32_t* out_vertices,
                                       int32_t* out_curves) {
  return guarded(session, [&] {
    const carreau::MeshEdges& edges = evaluation_of(*session).edges;
    check_capacity(capacity, edges.vertices.size(), "edges");
    const carreau::SurfaceMesh& mesh = session->session.mesh();
    for (std::size_t e = 0; e < edges.vertices.size(); ++e) {
      if (out_vertices != nullptr) std::copy(edges.vertices[e].begin(), edges.vertices[e].end(), out_vertices + 2 * e);
      if (out_curves == nullptr) continue;
      const std::int32_t segment = edges.segment[e];
      out_curves[e] = segment < 0 ? 0 : mesh.curves[std::size_t(edges.segments[std::size_t(segment)].curve)].ref;
    }
  });
}

carreau_status carreau_delivered_triangle_edges(carreau_session* session, int64_t capacity, int32_t* out_edges) {
  return guarded(session, [&] {
    required(out_edges, "out_edges");
    const carreau::MeshEdges& edges = evaluation_of(*session).edges;
    check_capacity(capacity, edges.of_triangle.size(), "triangles");
    std::int32_t* out = out_edges;
    for (const auto& sides : edges.of_triangle) out = std::copy(sides.begin(), sides.end(), out);
  });
}

carreau_status carreau_delivered_write(carreau_session* session, const char* path) {
  return guarded(session, [&] {
    required(path, "path");
    evaluation_of(*session);
    session->session.write_delivered(path);
  });
}
