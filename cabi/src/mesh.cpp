// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <span>

#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "io/medit/part_files.h"
#include "io/high_order/curved_files.h"
#include "io/high_order/curved_reader.h"
#include "io/mesh_files.h"
#include "mesh_content.h"
#include "session/file_adaptation.h"
#include "session/options.h"

using carreau::FaceMesh;
using carreau::FlatMesh;
using carreau::InvalidArgument;
using carreau::SurfaceMesh;
using namespace carreau::abi;

static_assert(int(carreau::FaceStatus::not_meshed) == CARREAU_FACE_NOT_MESHED);
static_assert(int(carreau::FaceStatus::meshed) == CARREAU_FACE_MESHED);
static_assert(int(carreau::FaceStatus::mended) == CARREAU_FACE_MENDED);
static_assert(int(carreau::FaceStatus::failed) == CARREAU_FACE_FAILED);
static_assert(int(carreau::FaceStatus::collapsed) == CARREAU_FACE_COLLAPSED);

namespace {

/// body(v0, v1, v2, face, local corners) for each triangle of a session's mesh, in order.
template <typename Body>
void for_each_triangle(const SurfaceMesh& surface, Body&& body) {
  for (const FaceMesh& face : surface.faces)
    for (const auto& corners : face.triangles) body(face, corners);
}

/// body(end, other end, node between them) for the sides of each element of second order, by vertices of the mesh.
template <typename Body>
void for_each_side(const SurfaceMesh& surface, Body&& body) {
  const std::size_t corners = surface.vertices.size();
  for (const FaceMesh& face : surface.faces)
    for (std::size_t t = 0; t < face.mid.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::int32_t mid = face.mid[t][i]; mid >= 0)
          body(std::size_t(face.vertex[face.triangles[t][i]]), std::size_t(face.vertex[face.triangles[t][(i + 1) % 3]]),
               corners + std::size_t(face.mid_vertex[mid]));
}

void copy_refs(const std::vector<std::int32_t>& refs, std::size_t n, std::int32_t* out) {
  // A mesh may come without references: all are 0.
  for (std::size_t i = 0; i < n; ++i) out[i] = i < refs.size() ? refs[i] : 0;
}

std::string name_of_face(const carreau_mesh& mesh, std::int32_t ref) {
  if (mesh.session != nullptr) {
    for (const carreau::WholeFace& whole : mesh.session->session.whole_faces())
      if (whole.face.ref == ref) return whole.face.name;
  } else {
    for (const carreau_mesh::FaceOfFile& known : mesh.flat_faces)
      if (known.face.ref == ref) return known.face.name;
  }
  return "";
}

}  // namespace

const carreau::EntityNames& carreau::abi::entity_names_of(const carreau_mesh& mesh) {
  require_content(mesh);
  return mesh.session != nullptr ? mesh.session->session.names() : mesh.flat.names;
}

void carreau::abi::require_content(const carreau_mesh& mesh) {
  const bool filled = mesh.session != nullptr ? mesh.session->session.has_mesh() : mesh.filled;
  if (!filled)
    throw StatusError(CARREAU_ERR_SEQUENCE, mesh.session != nullptr
                                                ? "there is no mesh yet"
                                                : "the mesh is empty: call carreau_mesh_read or carreau_mesh_from_arrays first");
}

const SurfaceMesh& carreau::abi::session_only(const carreau_mesh& mesh, const char* what) {
  if (mesh.session == nullptr)
    throw StatusError(CARREAU_ERR_SEQUENCE, std::string("a mesh that was read from a file has no ") + what);
  return surface_of(mesh);
}

carreau::abi::Counts::Counts(const carreau_mesh& mesh) {
  require_content(mesh);
  if (mesh.session != nullptr) {
    const SurfaceMesh& surface = surface_of(mesh);
    vertices = surface.vertices.size() + surface.mid_vertices.size(), triangles = surface.triangle_count();
    edges = surface.edge_count(), faces = mesh.session->session.whole_faces().size();
  } else {
    vertices = mesh.flat.vertices.size(), triangles = mesh.flat.triangles.size();
    edges = mesh.flat.edges.size(), faces = mesh.flat_faces.size();
  }
}

std::vector<carreau_mesh::FaceOfFile> carreau::abi::faces_of(const FlatMesh& flat) {
  std::map<std::int32_t, carreau_mesh::FaceOfFile> by_ref;
  for (std::size_t i = 0; i < flat.triangles.size(); ++i)
    ++by_ref[i < flat.triangle_refs.size() ? flat.triangle_refs[i] : 0].triangles;
  for (auto& [ref, face] : by_ref) face.face = {.ref = ref, .status = carreau::FaceStatus::meshed};
  for (const carreau::FlatFace& face : flat.faces) by_ref[face.ref].face = face;
  std::vector<carreau_mesh::FaceOfFile> faces;
  for (auto& [ref, face] : by_ref) faces.push_back(std::move(face));
  return faces;
}

carreau_status carreau_session_mesh(carreau_session* session, carreau_mesh** out_mesh) {
  return guarded(session, [&] {
    required(out_mesh, "out_mesh");
    require_content(session->mesh);
    *out_mesh = &session->mesh;
  });
}

carreau_status carreau_mesh_create(carreau_mesh** out_mesh) {
  if (out_mesh == nullptr) return CARREAU_ERR_ARGUMENT;
  return status_of([&] { *out_mesh = new carreau_mesh(nullptr); });
}

void carreau_mesh_free(carreau_mesh* mesh) {
  if (mesh != nullptr && mesh->session == nullptr) delete mesh;
}

const char* carreau_mesh_last_error(const carreau_mesh* mesh) {
  if (mesh == nullptr) return "";
  const std::atomic<bool>& busy = mesh->session != nullptr ? mesh->session->busy : mesh->busy;
  return busy.load(std::memory_order_acquire) ? "" : mesh->error.sentence.c_str();
}

carreau_status carreau_mesh_read(carreau_mesh* mesh, const char* path) {
  return guarded(mesh, [&] {
    if (mesh->session != nullptr)
      throw InvalidArgument("the mesh of a session cannot be replaced by a file: use carreau_mesh_create");
    carreau::MeshOfFile file = carreau::read_mesh_of_any_order(required(path, "path"));
    mesh->flat_faces = faces_of(file.flat);
    mesh->flat = std::move(file.flat), mesh->curved = std::move(file.curved);
    mesh->filled = true;
    mesh->corner_uv.clear();
    mesh->remeshed.reset();
    mesh->part.reset();
  });
}

carreau_status carreau_mesh_write(carreau_mesh* mesh, const char* path) {
  return guarded(mesh, [&] {
    required(path, "path");
    require_content(*mesh);
    if (mesh->session != nullptr) {
      mesh->session->monitor.begin_run();
      mesh->session->session.write(path);
    } else if (mesh->curved) {
      carreau::write_curved(*mesh->curved, path);
    } else {
      carreau::write_mesh(mesh->flat, path, carreau::mesh_format_of(path));
    }
  });
}

carreau_status carreau_mesh_encode(carreau_mesh* mesh, const char* suffix, carreau_bytes_fn sink, void* user) {
  return guarded(mesh, [&] {
    required(suffix, "suffix");
    if (sink == nullptr) throw InvalidArgument("the argument sink is NULL");
    require_content(*mesh);
    const carreau::MeshFormat format = carreau::mesh_format_of(suffix);
    const auto give = [&](std::uint64_t position, std::string_view bytes) {
      if (const std::int32_t returned = sink(std::int64_t(position), std::int64_t(bytes.size()), bytes.data(), user); returned != 0)
        throw carreau::CallbackError("the sink of the bytes of a file has returned " + std::to_string(returned));
    };
    if (mesh->curved)
      throw InvalidArgument("elements of order " + std::to_string(mesh->curved->order) + " are written by carreau_mesh_write alone");
    if (mesh->part) return carreau::write_part(*mesh->part, mesh->flat, format, give);
    const std::string bytes =
        mesh->session != nullptr ? mesh->session->session.encoded(format) : carreau::mesh_bytes(mesh->flat, format);
    give(0, bytes);
  });
}

carreau_status carreau_mesh_count(carreau_mesh* mesh, int64_t* out_vertices, int64_t* out_triangles, int64_t* out_edges,
                                  int64_t* out_faces) {
  return guarded(mesh, [&] {
    const Counts counts(*mesh);
    if (out_vertices != nullptr) *out_vertices = std::int64_t(counts.vertices);
    if (out_triangles != nullptr) *out_triangles = std::int64_t(counts.triangles);
    if (out_edges != nullptr) *out_edges = std::int64_t(counts.edges);
    if (out_faces != nullptr) *out_faces = std::int64_t(counts.faces);
  });
}

carreau_status carreau_mesh_dimension(carreau_mesh* mesh, int32_t* out_dimension) {
  return guarded(mesh, [&] {
    require_content(*mesh);
    *required(out_dimension, "out_dimension") = mesh->session != nullptr ? 3 : mesh->flat.dimension;
  });
}

carreau_status carreau_mesh_order(carreau_mesh* mesh, int32_t* out_order) {
  return guarded(mesh, [&] {
    require_content(*mesh);
    const auto is_quadratic = [&] { return mesh->session != nullptr ? !surface_of(*mesh).mid_vertices.empty() : mesh->flat.is_quadratic(); };
    *required(out_order, "out_order") = mesh->curved ? mesh->curved->order : is_quadratic() ? 2 : 1;
  });
}

carreau_status carreau_mesh_vertices(carreau_mesh* mesh, int64_t capacity, double* out_xyz) {
  return guarded(mesh, [&] {
    required(out_xyz, "out_xyz");
    check_capacity(capacity, Counts(*mesh).vertices, "vertices");
    double* out = out_xyz;
    const auto add = [&](const std::vector<carreau::Vec3>& points) {
      for (const carreau::Vec3& p : points) *out++ = p.x(), *out++ = p.y(), *out++ = p.z();
    };
    add(mesh->session != nullptr ? surface_of(*mesh).vertices : mesh->flat.vertices);
    if (mesh->session != nullptr) add(surface_of(*mesh).mid_vertices);
  });
}

carreau_status carreau_mesh_vertex_refs(carreau_mesh* mesh, int64_t capacity, int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_refs, "out_refs");
    const std::size_t n = Counts(*mesh).vertices;
    check_capacity(capacity, n, "vertices");
    copy_refs(mesh->session != nullptr ? surface_of(*mesh).vertex_ref : mesh->flat.vertex_refs, n, out_refs);
    if (mesh->session == nullptr) return;
    const std::map<int, int>& shown = mesh->session->session.shown_points();
    for (std::size_t i = 0; i < n; ++i)
      if (const auto found = shown.find(out_refs[i]); found != shown.end()) out_refs[i] = found->second;
  });
}

carreau_status carreau_mesh_vertex_sizes(carreau_mesh* mesh, int64_t capacity, double* out_sizes) {
  return guarded(mesh, [&] {
    required(out_sizes, "out_sizes");
    check_capacity(capacity, Counts(*mesh).vertices, "vertices");
    session_only(*mesh, "prescribed sizes");
    const std::vector<double>& sizes = mesh->session->session.vertex_sizes();
    std::copy(sizes.begin(), sizes.end(), out_sizes);
    for_each_side(surface_of(*mesh), [&](std::size_t a, std::size_t b, std::size_t mid) {
      out_sizes[mid] = 0.5 * (sizes[a] + sizes[b]);
    });
  });
}

carreau_status carreau_mesh_read_metrics(carreau_mesh* mesh, const char* sol_path, int64_t capacity,
                                         double* out_metrics) {
  return guarded(mesh, [&] {
    required(out_metrics, "out_metrics");
    const auto n = Counts(*mesh).vertices;
    check_capacity(capacity, n, "vertices");
    double* out = out_metrics;
    for (const carreau::Metric3& m :
         carreau::read_metrics(required(sol_path, "sol_path"), static_cast<std::size_t>(n))) {
      const std::array<double, 6> row{m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
      out = std::copy(row.begin(), row.end(), out);
    }
  });
}

carreau_status carreau_mesh_triangles(carreau_mesh* mesh, int64_t capacity, int32_t* out_vertices) {
  return guarded(mesh, [&] {
    required(out_vertices, "out_vertices");
    check_capacity(capacity, Counts(*mesh).triangles, "triangles");
    std::int32_t* out = out_vertices;
    if (mesh->session != nullptr)
      for_each_triangle(surface_of(*mesh), [&](const FaceMesh& face, const auto& corners) {
        for (const std::int32_t local : corners) *out++ = face.vertex[std::size_t(local)];
      });
    else
      for (const auto& triangle : mesh->flat.triangles) out = std::copy(triangle.begin(), triangle.end(), out);
  });
}

carreau_status carreau_mesh_triangle_refs(carreau_mesh* mesh, int64_t capacity, int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_refs, "out_refs");
    const std::size_t m = Counts(*mesh).triangles;
    check_capacity(capacity, m, "triangles");
    std::int32_t* out = out_refs;
    if (mesh->session != nullptr)
      for_each_triangle(surface_of(*mesh), [&](const FaceMesh& face, const auto&) { *out++ = face.shown_ref(); });
    else
      copy_refs(mesh->flat.triangle_refs, m, out_refs);
  });
}

carreau_status carreau_mesh_corner_uv(carreau_mesh* mesh, int64_t capacity, double* out_uv) {
  return guarded(mesh, [&] {
    required(out_uv, "out_uv");
    check_capacity(capacity, Counts(*mesh).triangles, "triangles");
    if (!mesh->corner_uv.empty()) {
      std::copy(mesh->corner_uv.begin(), mesh->corner_uv.end(), out_uv);
      return;
    }
    double* out = out_uv;
    for_each_triangle(session_only(*mesh, "(u, v)"), [&](const FaceMesh& face, const auto& corners) {
      for (const std::int32_t local : corners) {
        const carreau::Vec2 uv = face.uv[std::size_t(local)];
        *out++ = uv.x(), *out++ = uv.y();
      }
    });
  });
}

carreau_status carreau_mesh_corner_faces(carreau_mesh* mesh, int64_t capacity, int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_refs, "out_refs");
    check_capacity(capacity, Counts(*mesh).triangles, "triangles");
    std::int32_t* out = out_refs;
    const carreau::SurfaceMesh& surface = session_only(*mesh, "(u, v)");
    for_each_triangle(surface, [&](const FaceMesh& face, const auto& corners) {
      for (const std::int32_t local : corners)
        *out++ = face.uv_face.empty() ? face.shown_ref() : surface.faces[face.uv_face[std::size_t(local)]].shown_ref();
    });
  });
}

carreau_status carreau_mesh_edges(carreau_mesh* mesh, int64_t capacity, int32_t* out_vertices) {
  return guarded(mesh, [&] {
    required(out_vertices, "out_vertices");
    check_capacity(capacity, Counts(*mesh).edges, "edges");
    std::int32_t* out = out_vertices;
    if (mesh->session != nullptr)
      for (const carreau::CurveMesh& curve : surface_of(*mesh).curves)
        for (std::size_t i = 1; i < curve.vertices.size(); ++i)
          *out++ = curve.vertices[i - 1], *out++ = curve.vertices[i];
    else
      for (const auto& edge : mesh->flat.edges) out = std::copy(edge.begin(), edge.end(), out);
  });
}

carreau_status carreau_mesh_edge_refs(carreau_mesh* mesh, int64_t capacity, int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_refs, "out_refs");
    const std::size_t k = Counts(*mesh).edges;
    check_capacity(capacity, k, "edges");
    std::int32_t* out = out_refs;
    if (mesh->session != nullptr)
      for (const carreau::CurveMesh& curve : surface_of(*mesh).curves)
        for (std::size_t i = 1; i < curve.vertices.size(); ++i) *out++ = curve.shown_ref();
    else
      copy_refs(mesh->flat.edge_refs, k, out_refs);
  });
}

carreau_status carreau_mesh_face(carreau_mesh* mesh, int64_t index, carreau_face* out_face) {
  return guarded(mesh, [&] {
    require_content(*mesh);
    const std::vector<carreau::WholeFace>* wholes = nullptr;
    if (mesh->session != nullptr) wholes = &mesh->session->session.whole_faces();
    const std::size_t n = wholes != nullptr ? wholes->size() : mesh->flat_faces.size();
    if (index < 0 || std::uint64_t(index) >= n)
      throw InvalidArgument("there is no face of index " + std::to_string(index) + ": the mesh has " +
                            std::to_string(n));
    const auto i = std::size_t(index);
    const carreau::FlatFace& face = wholes != nullptr ? (*wholes)[i].face : mesh->flat_faces[i].face;
    carreau_face result{};
    mesh->text = face.why + '\0' + face.name;
    result.ref = face.ref;
    result.status = std::int32_t(face.status);
    result.triangles = wholes != nullptr ? std::int64_t((*wholes)[i].triangles) : mesh->flat_faces[i].triangles;
    result.why = mesh->text.c_str();
    result.name = result.why + face.why.size() + 1;
    result.rgb = face.rgb;
    write_struct(result, out_face, "out_face");
  });
}

carreau_status carreau_mesh_face_sides(carreau_mesh* mesh, int32_t face_ref, int32_t out_solids[2]) {
  return guarded(mesh, [&] {
    const carreau::EntityNames& names = entity_names_of(*mesh);
    const auto found = names.face_solids.find(face_ref);
    for (const std::size_t side : {0U, 1U})
      required(out_solids, "out_solids")[side] = found != names.face_solids.end() ? found->second[side] : 0;
  });
}

const char* carreau_mesh_entity_name(carreau_mesh* mesh, int32_t dimension, int32_t ref) {
  if (mesh == nullptr) return nullptr;
  const carreau_status status = guarded(mesh, [&] {
    const carreau::EntityNames& names = entity_names_of(*mesh);
    mesh->text.clear();
    if (dimension == 2) {
      mesh->text = name_of_face(*mesh, ref);
      return;
    }
    const std::map<int, std::string>& of_dimension = dimension == 0 ? names.points : dimension == 1 ? names.curves : names.solids;
    if (const auto found = of_dimension.find(ref); found != of_dimension.end()) mesh->text = found->second;
  });
  return status == CARREAU_OK ? mesh->text.c_str() : "";
}
