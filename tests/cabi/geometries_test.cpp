// SPDX-License-Identifier: BSD-3-Clause
// Several geometries in one session: Bezier patches, molecules and callbacks side by side.
#include <carreau_geometry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

struct Session {
  Session() { carreau_session_create(&handle); }
  ~Session() { carreau_session_free(handle); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  operator carreau_session*() const { return handle; }  // NOLINT: as the C interface takes it
  carreau_session* handle = nullptr;
};

#define EXPECT_OK(session, call) EXPECT_EQ(call, CARREAU_OK) << carreau_last_error(session)

/// Points of triangles of the faces first .. last, in the order of the mesh.
std::vector<double> triangles_of(carreau_session* session, std::int32_t first, std::int32_t last) {
  carreau_mesh* mesh = nullptr;
  EXPECT_OK(session, carreau_session_mesh(session, &mesh));
  std::int64_t n = 0, m = 0;
  EXPECT_EQ(carreau_mesh_count(mesh, &n, &m, nullptr, nullptr), CARREAU_OK);
  std::vector<double> xyz(3 * n), points;
  std::vector<std::int32_t> vertices(3 * m), refs(m);
  EXPECT_EQ(carreau_mesh_vertices(mesh, n, xyz.data()), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_triangles(mesh, m, vertices.data()), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_triangle_refs(mesh, m, refs.data()), CARREAU_OK);
  for (std::int64_t t = 0; t < m; ++t)
    if (refs[t] >= first && refs[t] <= last)
      for (int k = 0; k < 3; ++k)
        for (int x = 0; x < 3; ++x) points.push_back(xyz[3 * vertices[3 * t + k] + x]);
  return points;
}

std::int64_t open_edges(carreau_session* session) {
  carreau_mesh* mesh = nullptr;
  carreau_session_mesh(session, &mesh);
  carreau_quality quality{};
  quality.struct_size = sizeof quality;
  EXPECT_EQ(carreau_mesh_quality(mesh, &quality), CARREAU_OK);
  return quality.open_edges;
}

carreau_geometry geometry(carreau_session* session, std::int64_t index) {
  carreau_geometry place{};
  place.struct_size = sizeof place;
  EXPECT_OK(session, carreau_geometry_info(session, index, &place));
  return place;
}

// ---- A hyperbolic paraboloid z = x y over a square of side 2, as a patch of degree m x n ----


/// z = x y + x^2 at (x, y) = (2 u - 1, 2 v - 1) + shift, for m >= 2: control values by the blossom of the polynomial.
std::vector<double> saddle(int m, int n, double shift) {
  std::vector<double> controls;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) {
      const double u = double(i) / m, v = double(j) / n;
      const double u2 = m > 1 ? double(i) * (i - 1) / (double(m) * (m - 1)) : 0;  // blossom of u^2
      const double x2 = 4 * u2 - 4 * u + 1;
      controls.insert(controls.end(), {2 * u - 1 + shift, 2 * v - 1, (2 * u - 1) * (2 * v - 1) + x2});
    }
  return controls;
}

void add_saddle(carreau_session* session, int m, int n, double shift) {
  const std::array<std::int32_t, 2> degrees{m, n};
  const std::vector<double> controls = saddle(m, n, shift);
  carreau_bezier bezier{};
  bezier.struct_size = sizeof bezier;
  bezier.patch_count = 1;
  bezier.degrees = degrees.data(), bezier.controls = controls.data();
  EXPECT_OK(session, carreau_add_bezier(session, &bezier));
}

void add_molecule(carreau_session* session, double shift) {
  carreau_molecule_options options{};
  options.struct_size = sizeof options;
  options.surface = CARREAU_VWS;
  const std::array<double, 6> centers{shift, 0, 0, shift + 1.5, 0, 0};
  const std::array<double, 2> radii{1.7, 1.7};
  EXPECT_OK(session, carreau_add_molecule(session, &options, 2, centers.data(), radii.data()));
}

/// A square of side 2 in the plane z = 0, at x from `user`; counts releases.
struct Plate {
  double shift = 0;
  int released = 0;
  std::int32_t largest_face = 0, fails = 0;
};
std::int32_t plate(std::int32_t face, double u, double v, std::int32_t, double* S, double* Su, double* Sv, double* Suu,
                   double* Suv, double* Svv, void* user) {
  auto& p = *static_cast<Plate*>(user);
  p.largest_face = std::max(p.largest_face, face);
  if (p.fails != 0) return p.fails;
  S[0] = p.shift + u, S[1] = v, S[2] = 0;
  const double zero[3] = {0, 0, 0};
  for (double* d : {Su, Sv, Suu, Suv, Svv}) std::memcpy(d, zero, sizeof zero);
  Su[0] = Sv[1] = 1;
  return 0;
}
std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void*) { return *a = 0, *b = 1, 0; }
std::int32_t side(std::int32_t, std::int32_t ic, double t, std::int32_t, double* C, double* Ct, double* Ctt, void*) {
  constexpr double at[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (int i = 0; i < 2; ++i)
    C[i] = (1 - t) * at[ic - 1][i] + t * at[ic][i], Ct[i] = at[ic][i] - at[ic - 1][i], Ctt[i] = 0;
  return 0;
}
void release(void* user) { ++static_cast<Plate*>(user)->released; }

carreau_cad callbacks_of(Plate& plate_of) {
  carreau_cad cad{};
  cad.struct_size = sizeof cad;
  cad.user = &plate_of;
  cad.surface_order = cad.curve_order = 2;
  cad.surface = plate, cad.curve_interval = interval, cad.curve = side;
  cad.release = release;
  return cad;
}

void add_face(carreau_session* session, std::int32_t ref, std::int32_t curve = 1) {
  EXPECT_OK(session, carreau_model_add_face(session, ref, 1));
  for (std::int32_t k = 0; k < 4; ++k)
    EXPECT_OK(session, carreau_model_add_curve(session, ref, CARREAU_BOUNDARY, curve + k, curve + k, curve + (k + 1) % 4));
}

void add_plate(carreau_session* session, Plate& plate_of) {
  const carreau_cad cad = callbacks_of(plate_of);
  EXPECT_OK(session, carreau_geometry_begin(session, &cad));
  add_face(session, 1);
  EXPECT_OK(session, carreau_geometry_end(session));
}

void mesh(carreau_session* session, int threads = 1) {
  EXPECT_OK(session, carreau_set_real(session, "hphydef", 0.25));
  EXPECT_OK(session, carreau_set_real(session, "hphymin", 1e-3));
  EXPECT_OK(session, carreau_set_real(session, "hphymax", 1));
  EXPECT_OK(session, carreau_set_integer(session, "threads", threads));
  EXPECT_OK(session, carreau_mesh_generate(session));
}

TEST(Bezier, DegreeDoesNotChangeTheSurface) {
  Session low, high;
  add_saddle(low, 2, 1, 0);
  add_saddle(high, 15, 7, 0);
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j) {
      const std::array<double, 2> uv{i / 6.0, j / 6.0};
      std::array<double, 3> p{}, q{};
      EXPECT_OK(low, carreau_geometry_points(low, 1, 1, uv.data(), p.data()));
      EXPECT_OK(high, carreau_geometry_points(high, 1, 1, uv.data(), q.data()));
      const double x = 2 * uv[0] - 1, y = 2 * uv[1] - 1;
      EXPECT_NEAR(p[2], x * y + x * x, 1e-14);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(p[k], q[k], 1e-13);
    }
  std::array<std::int32_t, 2> degrees{};
  EXPECT_OK(high, carreau_bezier_degrees(high, 1, degrees.data()));
  EXPECT_EQ(degrees, (std::array<std::int32_t, 2>{15, 7}));
}

TEST(Bezier, SidesOfOneReferenceAreOneCurve) {
  // Two halves of a plane, the second turned by a quarter: its side v = 0 is the first one's side u = 1.
  const std::vector<double> controls{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0,   // (u, v) = (x, y)
                                     1, 0, 0, 2, 0, 0, 1, 1, 0, 2, 1, 0};  // u = y, v = x - 1
  const std::vector<std::int32_t> degrees{1, 1, 1, 1}, sides{1, 2, 3, 4, 2, 5, 6, 7};
  Session by_refs, by_space;
  carreau_bezier bezier{};
  bezier.struct_size = sizeof bezier;
  bezier.patch_count = 2;
  bezier.degrees = degrees.data(), bezier.controls = controls.data();
  EXPECT_OK(by_space, carreau_add_bezier(by_space, &bezier));
  bezier.side_refs = sides.data();
  EXPECT_OK(by_refs, carreau_add_bezier(by_refs, &bezier));
  mesh(by_refs), mesh(by_space);
  EXPECT_EQ(triangles_of(by_refs, 1, 2), triangles_of(by_space, 1, 2));
  std::int64_t curves = 0;
  EXPECT_OK(by_refs, carreau_session_interface_count(by_refs, &curves));
  EXPECT_EQ(curves, 7);
}

TEST(Bezier, RejectsInvalidPatches) {
  Session session;
  carreau_bezier bezier{};
  bezier.struct_size = sizeof bezier;
  EXPECT_EQ(carreau_add_bezier(session, &bezier), CARREAU_ERR_ARGUMENT);
  bezier.patch_count = 1;
  EXPECT_EQ(carreau_add_bezier(session, &bezier), CARREAU_ERR_ARGUMENT);
  std::vector<double> controls(3 * 4, 0.0);
  for (const std::array<std::int32_t, 2> degrees : {std::array{0, 1}, std::array{1, 16}, std::array{-3, 2}}) {
    bezier.degrees = degrees.data(), bezier.controls = controls.data();
    EXPECT_EQ(carreau_add_bezier(session, &bezier), CARREAU_ERR_ARGUMENT);
    EXPECT_NE(std::string(carreau_last_error(session)).find("from 1 to 15"), std::string::npos);
  }
  const std::array<std::int32_t, 2> degrees{1, 1};
  bezier.degrees = degrees.data();
  controls[7] = NAN;
  EXPECT_EQ(carreau_add_bezier(session, &bezier), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(std::string(carreau_last_error(session)).find("control point 3"), std::string::npos);
  controls[7] = 0;
  const std::array<std::int32_t, 4> refs{1, 2, 0, 4};
  bezier.side_refs = refs.data();
  EXPECT_EQ(carreau_add_bezier(session, &bezier), CARREAU_ERR_ARGUMENT);
  std::int64_t count = -1;
  EXPECT_OK(session, carreau_geometry_count(session, &count));
  EXPECT_EQ(count, 0);
}

TEST(Geometries, HaveTheirMeshesSideBySide) {
  Session molecule, bezier, callbacks;
  Plate alone{.shift = 30};
  add_molecule(molecule, 0), mesh(molecule);
  add_saddle(bezier, 3, 2, 10), mesh(bezier);
  add_plate(callbacks, alone), mesh(callbacks);
  std::vector<std::vector<double>> wanted{triangles_of(molecule, 1, 2), triangles_of(bezier, 1, 1),
                                          triangles_of(callbacks, 1, 1)};
  EXPECT_EQ(geometry(callbacks, 0).kind, CARREAU_GEOMETRY_CALLBACKS);
  for (const int threads : {1, 2, 5}) {
    Session all;
    Plate beside{.shift = 30};
    add_molecule(all, 0), add_saddle(all, 3, 2, 10), add_plate(all, beside);
    mesh(all, threads);
    for (std::int64_t k = 0; k < 3; ++k) {
      const carreau_geometry place = geometry(all, k);
      EXPECT_EQ(place.last_face - place.first_face + 1, k == 0 ? 2 : 1);
      EXPECT_EQ(triangles_of(all, place.first_face, place.last_face), wanted[k]) << "geometry " << k;
      EXPECT_FALSE(wanted[k].empty());
    }
    EXPECT_EQ(beside.largest_face, 1);  // its own number
  }
}

TEST(Geometries, StandBesideTheHostsOwnFaces) {
  Session session;
  Plate own{.shift = -20}, other{.shift = 20};
  const carreau_cad cad = callbacks_of(own);
  EXPECT_OK(session, carreau_set_cad(session, &cad));
  add_face(session, 7, 11);
  add_saddle(session, 2, 2, 0), add_plate(session, other);
  EXPECT_EQ(geometry(session, 0).first_face, 8);
  EXPECT_EQ(geometry(session, 0).first_curve, 15);
  EXPECT_EQ(geometry(session, 0).last_curve, 18);  // room for the interfaces that gluing will find
  EXPECT_EQ(geometry(session, 1).first_face, 9);
  EXPECT_EQ(geometry(session, 1).first_curve, 19);
  mesh(session);
  EXPECT_EQ(own.largest_face, 7);
  EXPECT_EQ(other.largest_face, 1);
  const std::vector<double> left = triangles_of(session, 7, 7), right = triangles_of(session, 9, 9);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_NEAR(left[i] + (i % 3 == 0 ? 40 : 0), right[i], 1e-12);
  // Curves that gluing has found are in the room that was kept.
  std::int64_t n = 0;
  EXPECT_OK(session, carreau_model_count(session, nullptr, &n, nullptr));
  std::vector<std::int32_t> faces(n), refs(n);
  EXPECT_OK(session, carreau_model_curves(session, n, faces.data(), nullptr, refs.data(), nullptr));
  for (std::int64_t i = 0; i < n; ++i)
    if (faces[i] == 8) {
      EXPECT_GE(refs[i], 15);
      EXPECT_LE(refs[i], 18);
    }
}

TEST(Geometries, AreJoinedWhereTheyMeetOnRequest) {
  for (const bool joined : {false, true}) {
    Session session;
    Plate left{.shift = -1}, right{.shift = 1};
    add_plate(session, left), add_plate(session, right);
    EXPECT_OK(session, carreau_set_integer(session, "glue_open", joined ? 1 : 0));
    mesh(session);
    EXPECT_EQ(open_edges(session), joined ? 6 * 8 : 8 * 8);
  }
}

TEST(Geometries, ThatAreCancelledLeaveTheSessionAsItWas) {
  Session session;
  Plate plate_of;
  const carreau_cad cad = callbacks_of(plate_of);
  add_saddle(session, 2, 2, 0);
  EXPECT_OK(session, carreau_geometry_begin(session, &cad));
  add_face(session, 1);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_geometry_begin(session, &cad), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_load_bezier(session, "x.bpt"), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_model_add_curve(session, 9, CARREAU_BOUNDARY, 1, 1, 1), CARREAU_ERR_ARGUMENT);
  const std::string kept = carreau_last_error(session);
  EXPECT_OK(session, carreau_geometry_cancel(session));
  EXPECT_EQ(carreau_last_error(session), kept);
  EXPECT_EQ(carreau_geometry_cancel(session), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_geometry_end(session), CARREAU_ERR_SEQUENCE);
  std::int64_t faces = 0;
  EXPECT_OK(session, carreau_model_count(session, &faces, nullptr, nullptr));
  EXPECT_EQ(faces, 1);
  // A geometry without a face, and one with a reference that no model may have.
  EXPECT_OK(session, carreau_geometry_begin(session, &cad));
  EXPECT_EQ(carreau_geometry_end(session), CARREAU_ERR_MODEL);
  EXPECT_OK(session, carreau_geometry_begin(session, &cad));
  add_face(session, 1, -5);
  EXPECT_EQ(carreau_geometry_end(session), CARREAU_ERR_MODEL);
  EXPECT_OK(session, carreau_geometry_begin(session, &cad));
  add_face(session, INT32_MAX);
  EXPECT_EQ(carreau_geometry_end(session), CARREAU_ERR_MODEL);
  EXPECT_EQ(plate_of.released, 4);
  mesh(session);
  EXPECT_FALSE(triangles_of(session, 1, 1).empty());
}

TEST(Geometries, AreReleasedWhenNothingUsesThem) {
  Plate plate_of;
  {
    Session session;
    add_plate(session, plate_of);
    mesh(session);
    EXPECT_OK(session, carreau_model_clear(session));
    EXPECT_EQ(plate_of.released, 0);  // the mesh is measured with them
    carreau_delivered delivered{};
    delivered.struct_size = sizeof delivered;
    EXPECT_OK(session, carreau_session_delivered(session, &delivered));
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_SEQUENCE);
  }
  EXPECT_EQ(plate_of.released, 1);
}

TEST(Geometries, FailWithTheReferencesOfTheSession) {
  Session session;
  Plate good, bad{.shift = 5};
  add_plate(session, good), add_plate(session, bad);
  bad.fails = 42;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK);
  carreau_error_place place{};
  place.struct_size = sizeof place;
  EXPECT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.face, 2);
  const std::string sentence = carreau_last_error(session);
  EXPECT_NE(sentence.find("face 2"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find("face 1"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("42"), std::string::npos) << sentence;
}

TEST(Errors, LibrariesOnTopSetErrorsOfTheSession) {
  Session session;
  EXPECT_EQ(carreau_set_error(session, CARREAU_ERR_FILE, "no such part"), CARREAU_ERR_FILE);
  EXPECT_STREQ(carreau_last_error(session), "no such part");
  EXPECT_EQ(carreau_set_error(session, CARREAU_OK, "fine"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_error(session, 12345, "?"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_error(nullptr, CARREAU_ERR_FILE, "?"), CARREAU_ERR_ARGUMENT);
}

// ---- Curves of callbacks on faces of other geometries ----

std::int32_t unit_interval(std::int32_t, std::int32_t, double* a, double* b, void*) {
  *a = 0, *b = 1;
  return 0;
}
/// The line v = 1/2 of face 1, its curve 5.
std::int32_t line_of_a_patch(std::int32_t face, std::int32_t ic, double t, std::int32_t, double* C, double* Ct, double* Ctt, void* user) {
  auto& calls = *static_cast<int*>(user);
  ++calls;
  if (face != 1 || ic != 5) return 7;
  C[0] = 0.1 + 0.8 * t, C[1] = 0.5;
  if (Ct != nullptr) Ct[0] = 0.8, Ct[1] = 0;
  if (Ctt != nullptr) Ctt[0] = Ctt[1] = 0;
  return 0;
}

TEST(Geometries, CallbacksEvaluateMoreCurvesOfABezierPatch) {
  Session session;
  add_saddle(session, 2, 1, 0);
  EXPECT_EQ(carreau_model_add_curve(session, 1, CARREAU_INTERNAL, 0, 0, 0), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(std::string(carreau_last_error(session)).find("carreau_model_embed_polyline"), std::string::npos);
  int calls = 0;
  carreau_cad cad{};
  cad.struct_size = sizeof cad;
  cad.user = &calls;
  cad.surface_order = cad.curve_order = 2;
  cad.surface = plate, cad.curve_interval = unit_interval, cad.curve = line_of_a_patch;
  EXPECT_OK(session, carreau_set_cad(session, &cad));
  EXPECT_OK(session, carreau_model_add_curve(session, 1, CARREAU_INTERNAL, 0, 0, 0));
  EXPECT_OK(session, carreau_set_real(session, "hphydef", 0.2));
  EXPECT_OK(session, carreau_mesh_generate(session));
  EXPECT_GT(calls, 0);
  carreau_mesh* mesh = nullptr;
  EXPECT_OK(session, carreau_session_mesh(session, &mesh));
  std::int64_t n = 0, k = 0;
  EXPECT_OK(session, carreau_mesh_count(mesh, &n, nullptr, &k, nullptr));
  std::vector<double> xyz(3 * n);
  std::vector<std::int32_t> edges(2 * k);
  EXPECT_OK(session, carreau_mesh_vertices(mesh, n, xyz.data()));
  EXPECT_OK(session, carreau_mesh_edges(mesh, k, edges.data()));
  int on_line = 0;  // y = 0
  for (const std::int32_t v : edges) on_line += std::abs(xyz[3 * std::size_t(v) + 1]) < 1e-12 && std::abs(xyz[3 * std::size_t(v)]) < 0.9;
  EXPECT_GE(on_line, 16);
}

}  // namespace
