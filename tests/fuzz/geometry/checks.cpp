// SPDX-License-Identifier: BSD-3-Clause
// Checks of the mesh of any geometry.
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "geometry_fuzz.h"

namespace geometry_fuzz {
namespace {

/// Vertices and triangles, to be compared.
struct Arrays {
  std::vector<double> xyz;
  std::vector<std::int32_t> triangles;
};

std::string arrays_of(carreau_mesh* mesh, Arrays& arrays) {
  std::int64_t vertices = 0, triangles = 0;
  if (carreau_mesh_count(mesh, &vertices, &triangles, nullptr, nullptr) != CARREAU_OK) return "the mesh has no counts";
  arrays.xyz.resize(static_cast<std::size_t>(3 * vertices));
  arrays.triangles.resize(static_cast<std::size_t>(3 * triangles));
  if (carreau_mesh_vertices(mesh, vertices, arrays.xyz.data()) != CARREAU_OK) return "the mesh has no vertices";
  if (carreau_mesh_triangles(mesh, triangles, arrays.triangles.data()) != CARREAU_OK) return "the mesh has no triangles";
  return "";
}

std::string fault_of_faces(carreau_mesh* mesh, bool whole) {
  std::int64_t faces = 0;
  if (carreau_mesh_count(mesh, nullptr, nullptr, nullptr, &faces) != CARREAU_OK) return "the mesh has no count of faces";
  std::int64_t failed = 0;
  for (std::int64_t f = 0; f < faces; ++f) {
    carreau_face face{};
    face.struct_size = sizeof face;
    if (carreau_mesh_face(mesh, f, &face) != CARREAU_OK) return "a face has no status";
    if (face.status == CARREAU_FACE_NOT_MESHED) return "face " + std::to_string(face.ref) + " is not meshed";
    if (face.status == CARREAU_FACE_FAILED) ++failed;
    if (face.status != CARREAU_FACE_MESHED && *face.why == '\0')
      return "face " + std::to_string(face.ref) + " has status " + std::to_string(face.status) + " without a reason";
  }
  if (whole && failed > 0) return "the status is that of a whole mesh, and faces failed";
  if (!whole && failed == 0) return "the status is that of a partial mesh, and no face failed";
  return "";
}

/// The face that a sentence about a defect names; 0: none.
long face_in(const std::string& sentence) {
  const std::size_t at = sentence.find("face ");
  return at == std::string::npos ? 0 : std::strtol(sentence.c_str() + at + 5, nullptr, 10);
}

/// Faces whose status has a sentence about triangles without area, turned triangles or invalid elements.
std::set<long> mended_faces(carreau_mesh* mesh) {
  constexpr const char* reported[] = {"no area", "turned over", "upright", "Jacobian"};
  std::set<long> mended;
  carreau_face face{};
  face.struct_size = sizeof face;
  for (std::int64_t f = 0; carreau_mesh_face(mesh, f, &face) == CARREAU_OK; ++f)
    for (const char* what : reported)
      if (face.status == CARREAU_FACE_MENDED && std::strstr(face.why, what) != nullptr) mended.insert(face.ref);
  return mended;
}

/// The defects that no status of a face reports.
std::string fault_of_mesh(carreau_mesh* mesh, bool closed) {
  constexpr std::int64_t limit = 1000;
  constexpr int shown = 3;
  std::int64_t count = 0;
  const char* text = nullptr;
  if (carreau_mesh_defects(mesh, closed ? 1 : 0, limit, &count, &text) != CARREAU_OK)
    return std::string("carreau_mesh_defects: ") + carreau_mesh_last_error(mesh);
  if (count == 0) return "";
  std::istringstream sentences{std::string(text)};
  const std::set<long> mended = mended_faces(mesh);
  std::string all, sentence;
  for (int n = 0; n < shown && std::getline(sentences, sentence);)
    if (!mended.contains(face_in(sentence))) all += " " + sentence, ++n;
  return all.empty() ? "" : "defects:" + all;
}

}  // namespace

std::string fault_of(carreau_session* session, carreau_status status, const char* call) {
  const std::string sentence = carreau_last_error(session);
  if (status == CARREAU_ERR_INTERNAL || std::string(carreau_status_name(status)) == "CARREAU_UNKNOWN_STATUS")
    return std::string(call) + ": " + sentence;
  if (status != CARREAU_OK && sentence.empty()) return std::string(call) + ": a failure without a sentence";
  return "";
}

void set_parameters(carreau_session* session, double diagonal, Random& random) {
  const double size = diagonal * random.power(random.is_small() ? -0.6 : -1.1, 0.3);
  carreau_set_real(session, "hphydef", size);
  carreau_set_real(session, "hphymin", random.chance(0.5) ? size : 0.1 * size);
  carreau_set_real(session, "hphymax", 10 * size);
  carreau_set_integer(session, "max_triangles", random.is_small() ? 1000 : 4000);
  if (random.chance(0.3)) carreau_set_word(session, "failing_faces", "leave_out");
  if (random.chance(0.6)) return;
  if (random.chance(0.3)) carreau_set_integer(session, "hgeo_flag", 1), carreau_set_real(session, "hgeomin", 0.2 * size);
  if (random.chance(0.3)) carreau_set_real(session, "gradation", random.uniform(1.1, 2.5));
  if (random.chance(0.3)) carreau_set_word(session, "patches", "independent");
  if (random.chance(0.2)) carreau_set_integer(session, "crossing_rounds", 2);
  if (random.chance(0.2)) carreau_set_word(session, "narrow_faces", random.chance(0.5) ? "one_layer" : "collapse");
  constexpr const char* elements[] = {"p2", "q1.0", "q1.1", "q2.0", "q2.1"};
  if (random.chance(0.3)) carreau_set_word(session, "element", elements[random.below(5)]);
  if (random.chance(0.2)) carreau_set_integer(session, "proximity", 1 + random.below(2));
  if (random.chance(0.1)) carreau_set_integer(session, "measure", 1);
  if (random.chance(0.1)) carreau_set_real(session, "eps_collapse", 0.1 * size);
}

Outcome mesh_and_check(carreau_session* session, bool closed, Random& random) {
  Outcome outcome;
  const int threads = random.chance(0.5) ? 1 : 3;
  carreau_set_integer(session, "threads", threads);
  const carreau_status status = carreau_mesh_generate(session);
  outcome.fault = fault_of(session, status, "carreau_mesh_generate");
  if (!outcome.fault.empty() || (status != CARREAU_OK && status != CARREAU_ERR_PARTIAL)) return outcome;
  const bool whole = status == CARREAU_OK;
  outcome.result = whole ? Result::whole : Result::partial;
  carreau_mesh* mesh = nullptr;
  if (carreau_session_mesh(session, &mesh) != CARREAU_OK) return {outcome.result, "a session has no mesh after success"};
  outcome.fault = fault_of_faces(mesh, whole);
  if (outcome.fault.empty()) outcome.fault = fault_of_mesh(mesh, closed && whole);
  if (!outcome.fault.empty() || !random.chance(0.1)) return outcome;
  Arrays first, second;
  outcome.fault = arrays_of(mesh, first);
  carreau_set_integer(session, "threads", 4 - threads);
  if (carreau_mesh_generate(session) != status || carreau_session_mesh(session, &mesh) != CARREAU_OK)
    return {outcome.result, "another number of threads changes the status"};
  if (outcome.fault.empty()) outcome.fault = arrays_of(mesh, second);
  if (outcome.fault.empty() && (first.xyz != second.xyz || first.triangles != second.triangles))
    outcome.fault = "another number of threads changes the mesh";
  return outcome;
}

}  // namespace geometry_fuzz
