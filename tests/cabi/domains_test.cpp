// SPDX-License-Identifier: BSD-3-Clause
// Domains that cannot be meshed, alone and among others that can.
#include "abi_fixture.h"

namespace abi_tests {
namespace {

/// Planar faces: each a polygon of (u, v) corners, moved apart in space.
struct PolygonHost {
  std::vector<std::vector<std::array<double, 2>>> polygons;  // [face reference - 1]
  bool gap = false;                                          // curves end before their corner

  static std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* S, double* Su,
                              double* Sv, double* Suu, double* Suv, double* Svv, void*) {
    S[0] = u + 10 * face, S[1] = v, S[2] = 0;
    if (order >= 1) Su[0] = Sv[1] = 1, Su[1] = Su[2] = Sv[0] = Sv[2] = 0;
    if (order >= 2)
      for (int i = 0; i < 3; ++i) Suu[i] = Suv[i] = Svv[i] = 0;
    return 0;
  }
  static std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void* user) {
    *a = 0, *b = static_cast<PolygonHost*>(user)->gap ? 0.75 : 1;
    return 0;
  }
  static std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* C, double* Ct,
                            double* Ctt, void* user) {
    const auto& polygon = static_cast<PolygonHost*>(user)->polygons[std::size_t(face - 1)];
    const auto &p = polygon[std::size_t(ic - 1)], &q = polygon[std::size_t(ic) % polygon.size()];
    for (int i = 0; i < 2; ++i) {
      C[i] = p[i] + t * (q[i] - p[i]);
      if (order >= 1) Ct[i] = q[i] - p[i];
      if (order >= 2) Ctt[i] = 0;
    }
    return 0;
  }
};

class PolygonTest : public SessionTest {
 protected:
  const std::vector<std::array<double, 2>> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<std::array<double, 2>> bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};

  /// Registers host.polygons as faces of that orientation.
  void use_polygons(std::int32_t orientation = 1) {
    auto cad = sized<carreau_cad>();
    cad.user = &polygon_host;
    cad.surface_order = cad.curve_order = 2;
    cad.surface = PolygonHost::surface;
    cad.curve_interval = PolygonHost::interval;
    cad.curve = PolygonHost::curve;
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK) << error();
    for (std::int32_t face = 1; face <= std::int32_t(polygon_host.polygons.size()); ++face) {
      const auto n = std::int32_t(polygon_host.polygons[std::size_t(face - 1)].size());
      ASSERT_EQ(carreau_model_add_face(session, face, orientation), CARREAU_OK);
      for (std::int32_t ic = 0; ic < n; ++ic)
        ASSERT_EQ(carreau_model_add_curve(session, face, CARREAU_BOUNDARY, 100 * face + ic, 100 * face + ic,
                                          100 * face + (ic + 1) % n),
                  CARREAU_OK);
    }
    ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
    ASSERT_EQ(carreau_set_real(session, "hphymin", 0.01), CARREAU_OK);
  }

  PolygonHost polygon_host;
};

TEST_F(PolygonTest, AFaceThatFailsLeavesTheOthers) {
  polygon_host.polygons = {square, bow_tie, square};
  use_polygons();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_PARTIAL);
  EXPECT_EQ(error().find("1 of 3 faces could not be meshed; the first is 2: "), 0u) << error();
  std::int64_t m = 0, counted = 0;
  ASSERT_EQ(carreau_mesh_count(mesh(), nullptr, &m, nullptr, nullptr), CARREAU_OK);
  const std::array<std::int32_t, 3> status{CARREAU_FACE_MESHED, CARREAU_FACE_FAILED, CARREAU_FACE_MESHED};
  for (std::int64_t f = 0; f < 3; ++f) {
    auto face = sized<carreau_face>();
    ASSERT_EQ(carreau_mesh_face(mesh(), f, &face), CARREAU_OK);
    EXPECT_EQ(face.ref, f + 1);
    EXPECT_EQ(face.status, status[std::size_t(f)]);
    EXPECT_EQ(face.triangles > 0, face.status == CARREAU_FACE_MESHED);
    EXPECT_EQ(std::string(face.why).empty(), face.status == CARREAU_FACE_MESHED) << face.why;
    counted += face.triangles;
  }
  EXPECT_EQ(counted, m);
  EXPECT_EQ(defects_of(mesh()), "");
  auto quality = sized<carreau_quality>();
  ASSERT_EQ(carreau_mesh_quality(mesh(), &quality), CARREAU_OK);
  EXPECT_NEAR(quality.area, 2, 1e-12);

  // Its owner can look at its domain, and at the answers of the host in it.
  const std::string path = testing::TempDir() + "carreau_failed_domain.mesh";
  ASSERT_EQ(carreau_set_text(session, "option", "onesurf2d"), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "refs", 2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_write(mesh(), path.c_str()), CARREAU_OK) << error();
  carreau_mesh* domain = nullptr;
  ASSERT_EQ(carreau_mesh_create(&domain), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_read(domain, path.c_str()), CARREAU_OK) << carreau_mesh_last_error(domain);
  std::int64_t triangles = -1, edges = 0;
  ASSERT_EQ(carreau_mesh_count(domain, nullptr, &triangles, &edges, nullptr), CARREAU_OK);
  EXPECT_EQ(triangles, 0);
  ASSERT_GE(edges, 4);
  std::vector<std::int32_t> refs(static_cast<std::size_t>(edges));
  ASSERT_EQ(carreau_mesh_edge_refs(domain, edges, refs.data()), CARREAU_OK);
  EXPECT_EQ(refs.front(), 200);
  EXPECT_EQ(refs.back(), 203);
  carreau_mesh_free(domain);
  std::remove(path.c_str());
  auto options = sized<carreau_exr_options>();
  options.longest = 16;
  options.face = 2;
  const std::string image = testing::TempDir() + "carreau_failed_domain.exr";
  EXPECT_EQ(carreau_write_exr(session, image.c_str(), &options), CARREAU_OK) << error();
  EXPECT_EQ(std::remove(image.c_str()), 0);
}

TEST_F(PolygonTest, AModelThatBreaksARuleNamesTheFaceToLeaveOut) {
  polygon_host.polygons = {square};
  use_polygons();
  ASSERT_EQ(carreau_model_add_face(session, 2, 1), CARREAU_OK);
  ASSERT_EQ(carreau_model_add_curve(session, 2, CARREAU_BOUNDARY, 200, 200, 201), CARREAU_OK);  // does not close
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_EQ(error().find("face 2, "), 0u) << error();
  auto place = sized<carreau_error_place>();
  ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.face, 2);
}

TEST_F(PolygonTest, ADomainThatCrossesItselfIsRejected) {
  polygon_host.polygons = {bow_tie};
  use_polygons();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_DOMAIN);
  EXPECT_NE(error().find("face 1"), std::string::npos) << error();
  auto place = sized<carreau_error_place>();
  ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.face, 1);
  EXPECT_EQ(place.ic, 1);
  carreau_mesh* none = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &none), CARREAU_ERR_SEQUENCE);
}

TEST_F(PolygonTest, ADomainThatIsTurnedTheWrongWayIsRejected) {
  polygon_host.polygons = {square};
  use_polygons(-1);  // the domain would be the outside (HDR fig. 3.1)
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_DOMAIN);
  EXPECT_NE(error().find("face 1"), std::string::npos) << error();
}

TEST_F(PolygonTest, ADomainThatIsTurnedTheOtherWayWithItsOrientationIsMeshed) {
  polygon_host.polygons = {{square.rbegin(), square.rend()}};
  use_polygons(-1);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  auto quality = sized<carreau_quality>();
  ASSERT_EQ(carreau_mesh_quality(mesh(), &quality), CARREAU_OK);
  EXPECT_NEAR(quality.area, 1, 1e-12);
}

TEST_F(PolygonTest, ABoundaryThatDoesNotCloseIsRejected) {
  polygon_host.polygons = {square};
  polygon_host.gap = true;
  use_polygons();
  const carreau_status status = carreau_mesh_generate(session);
  EXPECT_TRUE(status == CARREAU_ERR_MODEL || status == CARREAU_ERR_DOMAIN) << carreau_status_name(status);
  EXPECT_NE(error().find("face 1"), std::string::npos) << error();
}

}  // namespace
}  // namespace abi_tests
