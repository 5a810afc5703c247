// SPDX-License-Identifier: BSD-3-Clause
// Edges prescribed on curves, and wires, through the C interface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

class DividedCurves : public SessionTest {
 protected:
  /// Edges of a curve of the mesh that is made now.
  std::int64_t edges_of(std::int32_t curve) {
    EXPECT_EQ(carreau_set_integer(session, "flag", 1), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_EQ(defects_of(mesh()), "");
    const MeshData data = data_of(mesh());
    return std::count(data.edge_refs.begin(), data.edge_refs.end(), curve);
  }
};

TEST_F(DividedCurves, HaveThePrescribedEdges) {
  use_paraboloid();
  const std::int64_t by_sizes = edges_of(1);
  ASSERT_EQ(carreau_model_divide_curve(session, 1, 1, 7, CARREAU_ARITHMETIC, 2), CARREAU_OK) << error();
  EXPECT_EQ(edges_of(1), 7);
  const double t[] = {0.1, 0.2, 0.9};
  ASSERT_EQ(carreau_model_divide_curve_at(session, 1, 1, 3, t), CARREAU_OK) << error();
  EXPECT_EQ(edges_of(1), 4);
  ASSERT_EQ(carreau_model_divide_curve_at(session, 1, 1, 0, nullptr), CARREAU_OK) << error();
  EXPECT_EQ(edges_of(1), 1);
  ASSERT_EQ(carreau_model_divide_curve(session, 1, 1, 0, CARREAU_EQUAL, 0), CARREAU_OK) << error();
  EXPECT_EQ(edges_of(1), by_sizes);
}

TEST_F(DividedCurves, AreRejectedWithASentence) {
  use_paraboloid();
  const double down[] = {0.5, 0.4}, nan[] = {std::numeric_limits<double>::quiet_NaN()}, beyond[] = {2};
  EXPECT_EQ(carreau_model_divide_curve(session, 2, 1, 5, CARREAU_EQUAL, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve(session, 1, 5, 5, CARREAU_EQUAL, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "face 1, curve 5: the face has no such curve");
  EXPECT_EQ(carreau_model_divide_curve(session, 1, 1, -1, CARREAU_EQUAL, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve(session, 1, 1, 5, 3, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve(session, 1, 1, 5, CARREAU_GEOMETRIC, 0), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve_at(session, 1, 1, 2, down), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve_at(session, 1, 1, 1, nan), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve_at(session, 1, 1, -1, down), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_divide_curve_at(session, 1, 1, 2, nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_divide_curve_at(session, 1, 1, 1, beyond), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(error().find("its parameter 2 does not lie between 0 and 1"), std::string::npos) << error();
}

// A helix of one turn, of radius 1 and height 2 pi, that no face has: S(t, 0). Without derivatives.
std::int32_t helix(std::int32_t, double u, double, std::int32_t, double* S, double*, double*, double*, double*, double*,
                   void*) {
  return S[0] = std::cos(u), S[1] = std::sin(u), S[2] = u, 0;
}
std::int32_t turn(std::int32_t, std::int32_t, double* a, double* b, void*) {
  return *a = 0, *b = 2 * std::numbers::pi, 0;
}
std::int32_t along(std::int32_t, std::int32_t, double t, std::int32_t, double* C, double*, double*, void*) {
  return C[0] = t, C[1] = 0, 0;
}

TEST_F(DividedCurves, MayBeWiresOfNoFace) {
  auto cad = sized<carreau_cad>();
  cad.surface = helix, cad.curve_interval = turn, cad.curve = along;
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_face(session, 3, 0), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_curve(session, 3, CARREAU_INTERNAL, 5, 1, 2), CARREAU_OK) << error();
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  const double length = 2 * std::numbers::pi * std::sqrt(2.0);  // 8.886: 44 edges
  EXPECT_EQ(edges_of(5), 44);
  std::int64_t faces = -1;
  ASSERT_EQ(carreau_mesh_count(mesh(), nullptr, nullptr, nullptr, &faces), CARREAU_OK);
  EXPECT_EQ(faces, 0);
  ASSERT_EQ(carreau_model_divide_curve(session, 3, 1, 6, CARREAU_GEOMETRIC, 2), CARREAU_OK) << error();
  EXPECT_EQ(edges_of(5), 6);
  const MeshData data = data_of(mesh());
  double z = 0, edge = length / 63;  // 1 + 2 + ... + 32
  for (std::size_t e = 0; e < 6; ++e, edge *= 2) {
    const double next = data.xyz[3 * static_cast<std::size_t>(data.edges[2 * e + 1]) + 2];
    EXPECT_NEAR((next - z) * std::sqrt(2.0), edge, 1e-7 * length);  // derivatives by finite differences
    z = next;
  }
}

}  // namespace
}  // namespace abi_tests
