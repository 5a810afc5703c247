// SPDX-License-Identifier: BSD-3-Clause
#include "measured_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace adapters {
namespace {

struct FreeSession {
  void operator()(carreau_session* session) const noexcept { carreau_session_free(session); }
};

void count_edges(MeasuredMesh& m) {
  struct Side {
    std::int32_t low, high;
    bool forward;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * m.triangles.size());
  for (const auto& t : m.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      sides.push_back({low, high, t[i] == low});
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t from = 0, to = 0; from < sides.size(); from = to) {
    while (to < sides.size() && sides[to].low == sides[from].low && sides[to].high == sides[from].high) ++to;
    m.open_edges += to - from == 1 ? 1 : 0;
    m.crowded_edges += to - from > 2 ? 1 : 0;
    m.turned_edges += to - from == 2 && sides[from].forward == sides[from + 1].forward ? 1 : 0;
  }
}

// Triangles above this need no cause: no bound that the sweep knows is higher.
constexpr double flat_limit = 0.1;

void explain(carreau_mesh* mesh, std::int64_t n, std::int64_t k, double size, MeasuredMesh& m) {
  std::vector<std::array<std::int32_t, 2>> edges(static_cast<std::size_t>(k));
  std::vector<std::int32_t> refs(static_cast<std::size_t>(n));
  if (k > 0) carreau_mesh_edges(mesh, k, edges.front().data());
  carreau_mesh_vertex_refs(mesh, n, refs.data());
  for (auto& edge : edges) std::sort(edge.begin(), edge.end());
  std::sort(edges.begin(), edges.end());
  m.flat = explain_flat_triangles({m.vertices, m.triangles, refs, edges, size}, flat_limit);
  m.free_q2_min = m.flat.empty() ? m.quality.q2_min : flat_limit;
  for (const FlatTriangle& f : m.flat)
    if (f.cause == FlatCause::none) m.free_q2_min = std::min(m.free_q2_min, f.q2);
}

void measure_volume(MeasuredMesh& m) {
  for (const auto& t : m.triangles) {
    const auto& a = m.vertices[static_cast<std::size_t>(t[0])];
    const auto& b = m.vertices[static_cast<std::size_t>(t[1])];
    const auto& c = m.vertices[static_cast<std::size_t>(t[2])];
    m.volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

void fetch(carreau_session* session, double size, MeasuredMesh& m) {
  carreau_mesh* mesh = nullptr;
  if (carreau_session_mesh(session, &mesh) != CARREAU_OK) return;
  std::int64_t n = 0, t = 0, k = 0, f = 0, count = 0;
  carreau_mesh_count(mesh, &n, &t, &k, &f);
  m.vertices.resize(static_cast<std::size_t>(n));
  m.triangles.resize(static_cast<std::size_t>(t));
  m.refs.resize(static_cast<std::size_t>(t));
  carreau_mesh_vertices(mesh, n, m.vertices.front().data());
  carreau_mesh_triangles(mesh, t, m.triangles.front().data());
  carreau_mesh_triangle_refs(mesh, t, m.refs.data());
  m.edges.resize(static_cast<std::size_t>(k));
  m.edge_refs.resize(static_cast<std::size_t>(k));
  if (k > 0) carreau_mesh_edges(mesh, k, m.edges.front().data());
  carreau_mesh_edge_refs(mesh, k, m.edge_refs.data());
  m.faces = f;
  for (std::int64_t i = 0; i < f; ++i) {
    carreau_face face{};
    face.struct_size = sizeof face;
    carreau_mesh_face(mesh, i, &face);
    if (face.status == CARREAU_FACE_FAILED) m.failed.emplace_back(face.why);
  }
  m.quality.struct_size = sizeof m.quality;
  carreau_mesh_quality(mesh, &m.quality);
  const char* text = "";
  carreau_mesh_defects(mesh, 0, 20, &count, &text);
  m.defects = lines_of(text);
  count_edges(m);
  measure_volume(m);
  explain(mesh, n, k, size, m);
  carreau_report report{};
  report.struct_size = sizeof report;
  if (carreau_session_report(session, &report) != CARREAU_OK) return;
  m.seconds = report.seconds_total;
  m.report = report;
  std::int64_t interfaces = 0;
  carreau_session_interface_count(session, &interfaces);
  m.interfaces.resize(static_cast<std::size_t>(interfaces));
  for (std::int64_t i = 0; i < interfaces; ++i) {
    carreau_interface& each = m.interfaces[static_cast<std::size_t>(i)];
    each.struct_size = sizeof each;
    carreau_session_interface(session, i, &each);
  }
  m.surface_calls = report.surf0_calls + report.surf1_calls + report.surf2_calls;
}

}  // namespace

std::string MeasuredMesh::trouble(bool closed) const {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (!error.empty()) add(error);
  for (std::size_t i = 0; i < failed.size() && i < 3; ++i) add("failed: " + failed[i]);
  if (failed.size() > 3) add(std::to_string(failed.size()) + " faces failed");
  if (!defects.empty()) add(defects.front() + (defects.size() > 1 ? " (" + std::to_string(defects.size()) + ")" : ""));
  if (crowded_edges > 0) add(std::to_string(crowded_edges) + " edges of more than two triangles");
  if (closed && open_edges > 0) add(std::to_string(open_edges) + " open edges");
  if (closed && turned_edges > 0) add(std::to_string(turned_edges) + " edges whose triangles are turned differently");
  return text;
}

void use_command_parameters(carreau_session* session, double size, double diagonal) {
  carreau_set_real(session, "hphydef", size);
  carreau_set_real(session, "hphymin", std::min(size, diagonal) * 1e-6);
  carreau_set_real(session, "hphymax", std::max(size, diagonal));
  carreau_set_integer(session, "CheckCloseEdges", 20);
  carreau_set_real(session, "CoefRectangle", 0.06);
  carreau_set_real(session, "edge_gradation", 1.5);
  carreau_set_integer(session, "stagger_strips", 1);
  carreau_set_integer(session, "shape_trials", 1);
  carreau_set_text(session, "narrow_faces", "collapse");
  carreau_set_real(session, "narrow_ratio", 4e-4);
  carreau_set_integer(session, "CheckAdjacentEdges", 20);
}

MeasuredMesh mesh_and_measure(carreau_occ::BrepHost& host, double size,
                              const std::function<void(carreau_session*)>& prepare) {
  MeasuredMesh m;
  carreau_session* raw = nullptr;
  carreau_session_create(&raw);
  const std::unique_ptr<carreau_session, FreeSession> session(raw);
  use_command_parameters(raw, size, host.diagonal());
  if (const auto [of_all, of_each] = host.glue_tolerances(); of_all > 0) {
    carreau_set_integer(raw, "glue_open", 1);
    carreau_set_real(raw, "eps_glue", of_all);
    carreau_set_real(raw, "eps_glue_open", of_each);
  }
  carreau_set_real(raw, "eps_match", host.match_tolerance());
  if (prepare) prepare(raw);
  m.status = host.give_to(raw);
  if (m.status == CARREAU_OK) m.status = carreau_mesh_generate(raw);
  if (m.status != CARREAU_OK && m.status != CARREAU_ERR_PARTIAL)
    m.error = carreau_last_error(raw);
  else
    fetch(raw, size, m);
  return m;
}

}  // namespace adapters
