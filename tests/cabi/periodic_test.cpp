// SPDX-License-Identifier: BSD-3-Clause
// Periodic faces of callbacks: two sheets of one shape whose parameters differ.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "abi_fixture.h"
#include "carreau_geometry.h"

namespace abi_tests {
namespace {

// Face 1: (x, y, .2 sin(2x + y)) with x = u, y = v. Face 2: the same one above it, x = (v + v^2) / 2, y = u: another parametrisation
// that turns the plane over. Face 3: face 1 bent up at a corner. Faces 4 and 5: unit squares at z = 0 and z = 1.
// Face 6: face 1 one unit above, with a bump inside.
std::int32_t sheet(std::int32_t face, double u, double v, std::int32_t, double* s, double* su, double* sv, double* suu, double* suv, double* svv,
                   void*) {
  if (face == 4 || face == 5) {
    const double flat[3] = {u, v, face - 4.};
    for (int k = 0; k < 3; ++k) s[k] = flat[k], su[k] = k == 0, sv[k] = k == 1, suu[k] = suv[k] = svv[k] = 0;
    return 0;
  }
  const bool other = face == 2;
  const double x = other ? (v + v * v) / 2 : u, y = other ? u : v;
  const double z = 0.2 * std::sin(2 * x + y), slope = 0.2 * std::cos(2 * x + y);
  const double p[3] = {x, y, z + (other ? 1 : 0) + (face == 3 ? 1 + 0.3 * u * v : 0)};
  const double px[3] = {1, 0, 2 * slope}, py[3] = {0, 1, slope};
  const double speed = other ? (1 + 2 * v) / 2 : 1;
  const double xx = -4 * z, xy = -2 * z, yy = -z;
  for (int k = 0; k < 3; ++k) {
    s[k] = p[k];
    su[k] = other ? py[k] : px[k];
    sv[k] = other ? speed * px[k] : py[k];
    suu[k] = suv[k] = svv[k] = 0;
  }
  if (face == 3) su[2] += 0.3 * v, sv[2] += 0.3 * u;
  suu[2] = other ? yy : xx, suv[2] = other ? speed * xy : xy + (face == 3 ? 0.3 : 0);
  svv[2] = other ? speed * speed * xx + px[2] : yy;
  if (other) svv[0] = 1;
  if (face == 6) {
    const double p1 = u * (1 - u), q1 = v * (1 - v), w = p1 * q1, wu = (1 - 2 * u) * q1, wv = p1 * (1 - 2 * v), c = 20;
    s[2] += 1 + c * w * w * w;
    su[2] += 3 * c * w * w * wu, sv[2] += 3 * c * w * w * wv;
    suu[2] += 6 * c * w * wu * wu - 6 * c * w * w * q1, svv[2] += 6 * c * w * wv * wv - 6 * c * w * w * p1;
    suv[2] += 6 * c * w * wu * wv + 3 * c * w * w * (1 - 2 * u) * (1 - 2 * v);
  }
  return 0;
}
std::int32_t unit_interval(std::int32_t, std::int32_t, double* a, double* b, void*) { return *a = 0, *b = 1, 0; }
std::int32_t side(std::int32_t, std::int32_t ic, double t, std::int32_t, double* c, double* ct, double* ctt, void*) {
  constexpr double at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int k = 0; k < 2; ++k) c[k] = (1 - t) * at[ic - 1][k] + t * at[ic][k], ct[k] = at[ic][k] - at[ic - 1][k], ctt[k] = 0;
  return 0;
}

constexpr std::array<double, 12> up{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1};

class PeriodicTest : public SessionTest {
 protected:
  void use_sheets(std::vector<int> faces = {1, 2}, double size = 0.1) {
    auto cad = sized<carreau_cad>();
    cad.surface_order = cad.curve_order = 2;
    cad.surface = sheet, cad.curve_interval = unit_interval, cad.curve = side;
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK) << error();
    for (const int face : faces) {
      ASSERT_EQ(carreau_model_add_face(session, face, 1), CARREAU_OK);
      for (int k = 0; k < 4; ++k) {
        const int first = 4 * (face - 1) + 1;
        ASSERT_EQ(carreau_model_add_curve(session, face, CARREAU_BOUNDARY, first + k, first + k, first + (k + 1) % 4), CARREAU_OK);
      }
    }
    ASSERT_EQ(carreau_set_real(session, "hphydef", size), CARREAU_OK);
  }

  // Checks images and triangles of the faces' pair; its number of nodes.
  std::size_t check_pairs() {
    const MeshData data = data_of(mesh());
    std::int64_t pairs = 0, nodes = 0;
    EXPECT_EQ(carreau_mesh_periodic_count(mesh(), &pairs, &nodes), CARREAU_OK);
    std::vector<std::int32_t> dimension(pairs), refs(2 * pairs), node(2 * nodes);
    std::vector<double> map(12 * pairs);
    std::vector<std::int64_t> count(pairs);
    EXPECT_EQ(carreau_mesh_periodic(mesh(), pairs, nodes, dimension.data(), refs.data(), map.data(), count.data(), node.data()), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_periodic(mesh(), pairs - 1, nodes, dimension.data(), nullptr, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
    EXPECT_EQ(std::count(dimension.begin(), dimension.end(), 2), 1);
    std::map<std::int32_t, std::int32_t> image;
    const std::int32_t* next = node.data();
    for (std::int64_t i = 0; i < pairs; ++i)
      for (std::int64_t k = 0; k < count[i]; ++k, next += 2) {
        const double *y = &data.xyz[3 * std::size_t(next[0])], *x = &data.xyz[3 * std::size_t(next[1])];
        for (int r = 0; r < 3; ++r) {
          const double* row = &map[std::size_t(12 * i + 4 * r)];
          EXPECT_NEAR(row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3], y[r], 2e-12);
        }
        if (dimension[i] == 2) image[next[1]] = next[0];
      }
    std::vector<std::array<std::int32_t, 3>> mine, others;
    for (std::size_t t = 0; t < data.triangle_count(); ++t) {
      std::array<std::int32_t, 3> corners{data.triangles[3 * t], data.triangles[3 * t + 1], data.triangles[3 * t + 2]};
      const bool slave = data.triangle_refs[t] == refs[std::size_t(2 * pairs - 2)];
      if (!slave)
        for (std::int32_t& v : corners) v = image.count(v) != 0 ? image[v] : -1;
      std::sort(corners.begin(), corners.end());
      (slave ? others : mine).push_back(corners);
    }
    std::sort(mine.begin(), mine.end()), std::sort(others.begin(), others.end());
    EXPECT_EQ(mine, others);
    EXPECT_EQ(defects_of(mesh()), "");
    return image.size();
  }
};

TEST_F(PeriodicTest, SheetsWhoseParametersDifferHaveEqualMeshes) {
  use_sheets();
  const std::int32_t slave = 2, master = 1;
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_GT(check_pairs(), 100U);
}

TEST_F(PeriodicTest, PairsAndMapsAreFound) {
  for (const int given : {0, 1, 2}) {
    ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
    use_sheets();
    const std::int32_t slave = 2, master = 1;
    const double direction[3] = {0, 0, 1};
    if (given == 0) {
      ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, nullptr), CARREAU_OK) << error();
    } else if (given == 1) {
      ASSERT_EQ(carreau_model_add_periodicity(session, nullptr, nullptr, 0, up.data()), CARREAU_OK) << error();
    } else {
      ASSERT_EQ(carreau_model_add_period(session, direction), CARREAU_OK) << error();
      EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);  // the sheets are bent: their extent is more than the period
      EXPECT_NE(error().find("carries no face onto another one"), std::string::npos) << error();
      continue;
    }
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    check_pairs();
  }
}

TEST_F(PeriodicTest, SizesOfEitherSideHoldOnBoth) {
  std::size_t nodes[2] = {};
  for (const int face : {1, 2}) {
    ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
    use_sheets();
    const std::int32_t slave = face == 1 ? 2 : 1, master = face == 1 ? 1 : 2;
    std::array<double, 12> map = up;
    if (face == 2) map[11] = -1;
    ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, map.data()), CARREAU_OK) << error();
    for (const int ic : {1, 2, 3, 4})  // edges of curves of face 2 alone
      ASSERT_EQ(carreau_model_divide_curve(session, 2, ic, 20, CARREAU_EQUAL, 1), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    nodes[face - 1] = check_pairs();
    std::int64_t edges = 0;
    ASSERT_EQ(carreau_mesh_count(mesh(), nullptr, nullptr, &edges, nullptr), CARREAU_OK);
    EXPECT_EQ(edges, 160);
  }
  EXPECT_GT(nodes[0], 100U);
}

TEST_F(PeriodicTest, PrescribedEdgesThatDifferAreReported) {
  use_sheets();
  const std::int32_t slave = 2, master = 1;
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  for (const int face : {1, 2})
    for (const int ic : {1, 2, 3, 4}) ASSERT_EQ(carreau_model_divide_curve(session, face, ic, 5 + face, CARREAU_EQUAL, 1), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("which are periodic: they differ, there are 7 and 6"), std::string::npos) << error();
  // As many edges at other places.
  for (const int ic : {1, 2, 3, 4}) {
    ASSERT_EQ(carreau_model_divide_curve(session, 1, ic, 8, CARREAU_EQUAL, 1), CARREAU_OK);
    ASSERT_EQ(carreau_model_divide_curve(session, 2, ic, 8, CARREAU_GEOMETRIC, 1.5), CARREAU_OK);
  }
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("which are periodic: they differ, by 0."), std::string::npos) << error();
  EXPECT_NE(error().find(" at ("), std::string::npos) << error();
}

TEST_F(PeriodicTest, FacesThatDoNotMatchAreReported) {
  use_sheets({1, 3});
  const std::int32_t slave = 3, master = 1;
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("do not match: their boundaries are 0.2"), std::string::npos) << error();  // .3 along z
  EXPECT_NE(error().find("apart at ("), std::string::npos) << error();
}

TEST_F(PeriodicTest, PartnersOfFacesThatFailAreReported) {
  use_sheets({1, 6, 4});
  const std::int32_t slave = 6, master = 1;
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_PARTIAL) << error();
  for (const auto& [index, words] : {std::pair(0, "face 1: its periodic partner, face 6, failed"), {1, "face 6: the image of the mesh of face 1 is"}, {2, ""}}) {
    auto face = sized<carreau_face>();
    ASSERT_EQ(carreau_mesh_face(mesh(), index, &face), CARREAU_OK) << error();
    EXPECT_NE(std::string(face.why).find(words), std::string::npos) << face.why;
    EXPECT_EQ(face.status, index == 2 ? CARREAU_FACE_MESHED : CARREAU_FACE_FAILED);
  }
}

TEST_F(PeriodicTest, BadPeriodicitiesAreRejected) {
  use_sheets();
  const std::int32_t slave = 2, master = 1, none = 9;
  std::array<double, 12> bad = up;
  bad[0] = 2;
  const double zero[3] = {0, 0, 0};
  EXPECT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, bad.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("changes lengths, or is not finite: R R^T differs from the identity by 3"), std::string::npos) << error();
  EXPECT_EQ(carreau_model_add_periodicity(session, &slave, &none, 1, up.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_periodicity(session, &slave, &slave, 1, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_periodicity(session, nullptr, &master, 1, up.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_periodicity(session, nullptr, nullptr, -1, up.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_periodicity(session, nullptr, nullptr, 0, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_period(session, zero), CARREAU_ERR_ARGUMENT);
}

TEST_F(PeriodicTest, AFaceMayBePeriodicWithItself) {
  use_sheets({4});
  const std::int32_t face = 4;
  std::array<double, 12> along{1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0}, across = along;
  across[3] = 0, across[7] = 1;
  EXPECT_EQ(carreau_model_add_periodicity(session, &face, &face, 1, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("its map must be given"), std::string::npos) << error();
  ASSERT_EQ(carreau_model_add_periodicity(session, &face, &face, 1, along.data()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_periodicity(session, &face, &face, 1, across.data()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::int64_t pairs = 0, nodes = 0;
  ASSERT_EQ(carreau_mesh_periodic_count(mesh(), &pairs, &nodes), CARREAU_OK);
  EXPECT_EQ(pairs, 5);  // three corners and two sides
  // Glued, the square is a torus: V - F / 2 = 0.
  std::vector<std::int32_t> dimension(pairs), node(2 * nodes);
  std::vector<std::int64_t> count(pairs);
  ASSERT_EQ(carreau_mesh_periodic(mesh(), pairs, nodes, dimension.data(), nullptr, nullptr, count.data(), node.data()), CARREAU_OK);
  const MeshData data = data_of(mesh());
  std::vector<std::size_t> root(data.xyz.size() / 3);
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::size_t v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  for (std::int64_t k = 0; k < nodes; ++k) root[find(std::size_t(node[2 * k]))] = find(std::size_t(node[2 * k + 1]));
  std::size_t glued = 0;
  for (std::size_t v = 0; v < root.size(); ++v) glued += root[v] == v ? 1 : 0;
  EXPECT_EQ(2 * glued, data.triangle_count());
}

TEST_F(PeriodicTest, RefinedMeshesStayPeriodic) {
  for (const char* element : {"p1", "p2"}) {
    ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
    use_sheets({1, 2}, 0.2);
    ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK) << error();
    const std::int32_t slave = 2, master = 1;
    ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    std::size_t before = check_pairs();
    // Elements of the slave, and of the master.
    const std::int32_t elements[4] = {0, 3, std::int32_t(data_of(mesh()).triangle_count()) - 1, std::int32_t(data_of(mesh()).triangle_count()) / 2 + 5};
    ASSERT_EQ(carreau_mesh_refine(session, CARREAU_MARK_ELEMENTS, 4, elements), CARREAU_OK) << error();
    std::size_t after = check_pairs();
    EXPECT_GT(after, before);
    for (int round = 0; round < 2; ++round) {
      const std::size_t triangles = data_of(mesh()).triangle_count();
      ASSERT_EQ(carreau_mesh_halve(session, 1), CARREAU_OK) << error();
      EXPECT_EQ(data_of(mesh()).triangle_count(), 4 * triangles);
      EXPECT_GT(check_pairs(), 2 * after);
      after = check_pairs();
    }
    std::vector<double> sizes(data_of(mesh()).xyz.size() / 3, 0.04);
    ASSERT_EQ(carreau_mesh_refine_sizes(session, std::int64_t(sizes.size()), sizes.data()), CARREAU_OK) << error();
    check_pairs();
  }
}

TEST_F(PeriodicTest, ChainsThatContradictOneAnotherAreReported) {
  use_sheets({4, 5});
  const std::int32_t slave = 5, master = 4;
  const std::array<double, 12> turned{0, -1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 1};  // a quarter turn besides
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, turned.data()), CARREAU_OK) << error();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("two chains of periodicities carry face 4 onto the face"), std::string::npos) << error();
  EXPECT_NE(error().find("apart at ("), std::string::npos) << error();
}

TEST_F(PeriodicTest, APairThatIsGivenTwiceIsOne) {
  use_sheets();
  const std::int32_t slave = 2, master = 1;
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_periodicity(session, &slave, &master, 1, up.data()), CARREAU_OK) << error();
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  check_pairs();
}

}  // namespace
}  // namespace abi_tests
