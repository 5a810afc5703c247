// SPDX-License-Identifier: BSD-3-Clause
// Faces and curves that are parts of others.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

// Face f is the square from x = f - 1 to f in the plane; its curves are its sides, from the lower one on.
std::int32_t square(std::int32_t, double u, double v, std::int32_t, double* S, double*, double*, double*, double*,
                    double*, void*) {
  return S[0] = u, S[1] = v, S[2] = 0, 0;
}
std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void*) { return *a = 0, *b = 1, 0; }
std::int32_t side(std::int32_t face, std::int32_t ic, double t, std::int32_t, double* C, double*, double*, void*) {
  constexpr double x[] = {0, 1, 1, 0, 0}, y[] = {0, 0, 1, 1, 0};
  C[0] = face - 1 + (1 - t) * x[ic - 1] + t * x[ic];
  C[1] = (1 - t) * y[ic - 1] + t * y[ic];
  return 0;
}

class PartsTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    auto cad = sized<carreau_cad>();
    cad.surface = square, cad.curve_interval = interval, cad.curve = side;
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
    // Three squares in a row: points 1 to 4 below, 5 to 8 above; uprights 1 to 4, lower sides 11 to 13, upper 21 to 23.
    for (std::int32_t f = 1; f <= 3; ++f) {
      ASSERT_EQ(carreau_model_add_face(session, f, 1), CARREAU_OK);
      ASSERT_EQ(carreau_model_add_curve(session, f, CARREAU_BOUNDARY, 10 + f, f, f + 1), CARREAU_OK);
      ASSERT_EQ(carreau_model_add_curve(session, f, CARREAU_BOUNDARY, f + 1, f + 1, f + 5), CARREAU_OK);
      ASSERT_EQ(carreau_model_add_curve(session, f, CARREAU_BOUNDARY, 20 + f, f + 5, f + 4), CARREAU_OK);
      ASSERT_EQ(carreau_model_add_curve(session, f, CARREAU_BOUNDARY, f, f + 4, f), CARREAU_OK);
    }
    ASSERT_EQ(carreau_model_name_face(session, 2, "long"), CARREAU_OK);
    ASSERT_EQ(carreau_model_part_of_face(session, 3, 2), CARREAU_OK) << error();
    ASSERT_EQ(carreau_model_part_of_curve(session, 13, 12), CARREAU_OK) << error();
  }
  carreau_face face(std::int64_t index) {
    auto result = sized<carreau_face>();
    EXPECT_EQ(carreau_mesh_face(mesh(), index, &result), CARREAU_OK);
    return result;
  }
};

TEST_F(PartsTest, AreOneFaceInTheMesh) {
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::int64_t faces = 0;
  ASSERT_EQ(carreau_mesh_count(mesh(), nullptr, nullptr, nullptr, &faces), CARREAU_OK);
  EXPECT_EQ(faces, 2);
  auto beyond = sized<carreau_face>();
  EXPECT_EQ(carreau_mesh_face(mesh(), 2, &beyond), CARREAU_ERR_ARGUMENT);
  const MeshData data = data_of(mesh());
  const auto of_long = std::count(data.triangle_refs.begin(), data.triangle_refs.end(), 2);
  EXPECT_EQ(face(0).ref, 1);
  EXPECT_EQ(face(1).ref, 2);
  EXPECT_EQ(face(1).triangles, of_long);
  EXPECT_STREQ(face(1).name, "long");
  EXPECT_EQ(face(0).triangles + face(1).triangles, std::int64_t(data.triangle_count()));
  EXPECT_EQ(std::count(data.triangle_refs.begin(), data.triangle_refs.end(), 3), 0);
  std::vector<std::int32_t> corner_faces(3 * data.triangle_count());  // parts by their own references
  ASSERT_EQ(carreau_mesh_corner_faces(mesh(), std::int64_t(data.triangle_count()), corner_faces.data()), CARREAU_OK);
  for (std::size_t c = 0; c < corner_faces.size(); ++c)
    EXPECT_TRUE(corner_faces[c] == data.triangle_refs[c / 3] ||
                (corner_faces[c] == 3 && data.triangle_refs[c / 3] == 2));
  std::map<int, double> lengths;
  for (std::size_t e = 0; e < data.edge_count(); ++e) {
    const double* p = &data.xyz[3 * std::size_t(data.edges[2 * e])];
    const double* q = &data.xyz[3 * std::size_t(data.edges[2 * e + 1])];
    lengths[data.edge_refs[e]] += std::hypot(q[0] - p[0], q[1] - p[1]);
  }
  EXPECT_EQ(lengths.count(13), 0U);
  EXPECT_NEAR(lengths[12], 2, 1e-12);
  EXPECT_NEAR(lengths[23], 1, 1e-12);
  EXPECT_EQ(defects_of(mesh()), "");
}

TEST_F(PartsTest, AreOneFaceInFiles) {
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  carreau_mesh* read = nullptr;
  ASSERT_EQ(carreau_mesh_create(&read), CARREAU_OK);
  for (const char* option : {"allsurf3d", "allsurf2d", "onesurf3d", "onesurf2d"})
    for (const char* suffix : {".mesh", ".vtu", ".msh"}) {
      SCOPED_TRACE(std::string(option) + suffix);
      const std::string path = testing::TempDir() + "parts" + suffix;
      ASSERT_EQ(carreau_set_text(session, "option", option), CARREAU_OK);
      ASSERT_EQ(carreau_set_integer(session, "refs", 2), CARREAU_OK);
      ASSERT_EQ(carreau_mesh_write(mesh(), path.c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh());
      ASSERT_EQ(carreau_mesh_read(read, path.c_str()), CARREAU_OK) << carreau_mesh_last_error(read);
      const bool one = std::string(option).starts_with("one");
      const MeshData found = data_of(read, false);
      const std::set<std::int32_t> refs(found.triangle_refs.begin(), found.triangle_refs.end());
      EXPECT_EQ(refs, one ? std::set<std::int32_t>{2} : (std::set<std::int32_t>{1, 2}));
      auto quality = sized<carreau_quality>();
      ASSERT_EQ(carreau_mesh_quality(read, &quality), CARREAU_OK);
      EXPECT_NEAR(quality.area, one ? 2 : 3, 1e-9);
      // In space shared vertices and edges of parts are there once.
      std::set<std::pair<double, double>> places;
      for (std::size_t v = 0; v < found.vertex_count(); ++v) places.emplace(found.xyz[3 * v], found.xyz[3 * v + 1]);
      if (std::string(option).ends_with("3d")) {
        EXPECT_EQ(places.size(), found.vertex_count());
      }
    }
  ASSERT_EQ(carreau_set_integer(session, "refs", 3), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_write(mesh(), (testing::TempDir() + "parts.mesh").c_str()), CARREAU_ERR_ARGUMENT);
  carreau_mesh_free(read);
}

TEST_F(PartsTest, AFaceHasFailedWhenAPartHas) {
  ASSERT_EQ(carreau_model_leave_out_face(session, 3, "face 3: lost"), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_ERR_PARTIAL) << error();
  EXPECT_EQ(face(0).status, CARREAU_FACE_MESHED);
  EXPECT_EQ(face(1).status, CARREAU_FACE_FAILED);
  EXPECT_STREQ(face(1).why, "face 3: lost");
  EXPECT_GT(face(1).triangles, 0);
}

TEST_F(PartsTest, StandBehindTheFirstOne) {
  EXPECT_EQ(carreau_model_part_of_face(session, 3, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(),
            "face 3: it cannot be a part of face 1: parts are added right behind the first one, whose reference they "
            "all have");
  EXPECT_EQ(carreau_model_part_of_face(session, 1, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_part_of_face(session, 4, 2), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_part_of_curve(session, 99, 1), CARREAU_ERR_ARGUMENT);
  // All three.
  ASSERT_EQ(carreau_model_part_of_face(session, 2, 1), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_part_of_face(session, 3, 1), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(face(0).triangles, std::int64_t(data_of(mesh()).triangle_count()));
}

}  // namespace
}  // namespace abi_tests
