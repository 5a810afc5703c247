// SPDX-License-Identifier: BSD-3-Clause
// Molecules through the interface: areas, meshes, mistakes.
#include <carreau_geometry.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

const std::vector<double> two_centers{0, 0, 0, 1.5, 0, 0}, two_radii{1.7, 1.7};

carreau_molecule_options surface(std::int32_t kind, double probe = 1.4) {
  carreau_molecule_options options = sized<carreau_molecule_options>();
  options.surface = kind, options.probe = probe;
  return options;
}

class Molecules : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(carreau_session_create(&session), CARREAU_OK); }
  void TearDown() override { carreau_session_free(session); }

  void add_two(std::int32_t kind) {
    const carreau_molecule_options options = surface(kind);
    ASSERT_EQ(carreau_add_molecule(session, &options, 2, two_centers.data(), two_radii.data()), CARREAU_OK)
        << carreau_last_error(session);
  }
  carreau_molecule_measures measures() {
    carreau_molecule_measures m = sized<carreau_molecule_measures>();
    EXPECT_EQ(carreau_molecule_measure(session, &m), CARREAU_OK) << carreau_last_error(session);
    return m;
  }

  carreau_session* session = nullptr;
};

TEST_F(Molecules, TwoBallsHaveTheAreasOfTheirSurfaces) {
  for (const auto& [kind, area] : {std::pair{CARREAU_VWS, 52.3389}, {CARREAU_SAS, 149.9796}, {CARREAU_SES, 52.0752}}) {
    ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
    add_two(kind);
    const carreau_molecule_measures m = measures();
    EXPECT_NEAR(m.area, area, 1e-4);
    EXPECT_EQ(m.atoms, 2);
    EXPECT_EQ(m.exposed_atoms, 2);
    EXPECT_EQ(m.shells, 1);
    EXPECT_EQ(m.euler_number, 2);
    EXPECT_NEAR(m.torus_area, kind == CARREAU_SES ? 6.9721 : 0, 5e-5);
    EXPECT_NEAR(m.convex_area, m.area - m.torus_area, 1e-12);
    EXPECT_EQ(m.concave_area, 0);
    std::array<std::int32_t, 2> refs{};
    std::array<double, 2> areas{};
    ASSERT_EQ(carreau_molecule_atoms(session, 2, refs.data(), areas.data()), CARREAU_OK);
    EXPECT_EQ(refs, (std::array<std::int32_t, 2>{1, 2}));
    EXPECT_NEAR(areas[0], areas[1], 1e-12);
  }
}

TEST_F(Molecules, TheMeshIsClosedAndOnItsSpheres) {
  add_two(CARREAU_SAS);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.3), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(defects_of(mesh, true), "");
  const MeshData data = data_of(mesh);
  EXPECT_EQ(2 * data.vertex_count() - data.triangle_count(), 4U);
  for (std::size_t t = 0; t < data.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const double* x = &data.xyz[3 * data.triangles[3 * t + k]];
      const double* c = &two_centers[3 * (data.triangle_refs[t] - 1)];
      EXPECT_NEAR(std::hypot(x[0] - c[0], x[1] - c[1], x[2] - c[2]), 3.1, 1e-12);
    }
}

TEST_F(Molecules, AtomsShareTheWholeExcludedSurface) {
  add_two(CARREAU_SES);
  std::array<double, 2> convex{}, torus{}, concave{};
  ASSERT_EQ(carreau_molecule_atom_areas(session, 2, convex.data(), torus.data(), concave.data()), CARREAU_OK);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(convex[i], 45.1031 / 2, 1e-4);
    EXPECT_NEAR(torus[i], 6.9721 / 2, 1e-4);
    EXPECT_EQ(concave[i], 0);
  }
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  const carreau_molecule_options options = surface(CARREAU_SES);
  const std::string path = std::string(CARREAU_TEST_DATA) + "/molecule/1bna.pdb";
  ASSERT_EQ(carreau_load_molecule(session, &options, path.c_str()), CARREAU_OK) << carreau_last_error(session);
  const carreau_molecule_measures m = measures();
  std::vector<double> a(m.atoms), b(m.atoms), c(m.atoms);
  EXPECT_EQ(carreau_molecule_atom_areas(session, m.atoms - 1, a.data(), b.data(), c.data()), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_molecule_atom_areas(session, m.atoms, a.data(), b.data(), c.data()), CARREAU_OK);
  const auto sum = [](const std::vector<double>& areas) { return std::accumulate(areas.begin(), areas.end(), 0.0); };
  EXPECT_NEAR(sum(a), m.convex_area, 1e-9 * m.area);
  EXPECT_NEAR(sum(b), m.torus_area, 1e-9 * m.area);
  EXPECT_NEAR(sum(c), m.concave_area, 1e-9 * m.area);
  for (std::int64_t i = 0; i < m.atoms; ++i) EXPECT_GE(std::min({a[i], b[i], c[i]}), -1e-9);
}

TEST_F(Molecules, PointsOfFacesCanBeRequested) {
  add_two(CARREAU_VWS);
  std::array<double, 2> uv{};
  std::array<double, 3> x{};
  for (const double share : {0.0, 0.3, 1.0}) {
    ASSERT_EQ(carreau_geometry_curve(session, 1, 1, share, uv.data()), CARREAU_OK);
    ASSERT_EQ(carreau_geometry_points(session, 1, 1, uv.data(), x.data()), CARREAU_OK);
    EXPECT_NEAR(x[0], 0.75, 1e-12);
    EXPECT_NEAR(std::hypot(x[1], x[2]), std::sqrt(1.7 * 1.7 - 0.75 * 0.75), 1e-12);
  }
  EXPECT_EQ(carreau_geometry_points(session, 3, 1, uv.data(), x.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_geometry_curve(session, 1, 3, 0, uv.data()), CARREAU_ERR_ARGUMENT);
}

TEST_F(Molecules, AFileHasNumbersAndResidues) {
  const carreau_molecule_options options = surface(CARREAU_SAS);
  const std::string path = std::string(CARREAU_TEST_DATA) + "/molecule/1bna.pdb";
  ASSERT_EQ(carreau_load_molecule(session, &options, path.c_str()), CARREAU_OK) << carreau_last_error(session);
  const carreau_molecule_measures m = measures();
  EXPECT_EQ(m.atoms, 486);
  EXPECT_EQ(m.exposed_atoms, 385);
  EXPECT_NEAR(m.area, 4659.5, 0.94);
  EXPECT_STREQ(carreau_molecule_atom_name(session, 0), "DC A 1");
  EXPECT_EQ(carreau_molecule_atom_name(session, 486), nullptr);
}

TEST_F(Molecules, MistakesAreReportedAndLeaveTheSessionAsItWas) {
  const auto add = [&](const carreau_molecule_options& options, std::int64_t n, const double* centers,
                       const double* radii) -> std::string {
    EXPECT_EQ(carreau_add_molecule(session, &options, n, centers, radii), CARREAU_ERR_ARGUMENT);
    return carreau_last_error(session);
  };
  const std::array<double, 2> bad{1.7, -1};
  EXPECT_EQ(add(surface(CARREAU_VWS), 2, two_centers.data(), bad.data()),
            "atom 2: the radius is -1; it must be positive and finite");
  EXPECT_EQ(add(surface(CARREAU_VWS), 0, two_centers.data(), bad.data()), "there is no atom: n is 0");
  EXPECT_EQ(add(surface(CARREAU_VWS), 2, nullptr, bad.data()), "the argument centers is NULL");
  EXPECT_EQ(add(surface(7), 2, two_centers.data(), two_radii.data()),
            "the surface of a molecule is 7; it must be 1 (CARREAU_VWS), 2 (CARREAU_SAS) or 3 (CARREAU_SES)");
  EXPECT_EQ(add(surface(CARREAU_SES, -1), 2, two_centers.data(), two_radii.data()),
            "the radius of the probe must be finite and not negative");
  carreau_molecule_measures m = sized<carreau_molecule_measures>();
  EXPECT_EQ(carreau_molecule_measure(session, &m), CARREAU_ERR_SEQUENCE);
  std::array<double, 3> x{};
  EXPECT_EQ(carreau_geometry_points(session, 1, 1, two_centers.data(), x.data()), CARREAU_ERR_SEQUENCE);
  add_two(CARREAU_VWS);
  EXPECT_EQ(add(surface(CARREAU_SAS), 2, two_centers.data(), bad.data()),
            "atom 2: the radius is -1; it must be positive and finite");
  EXPECT_NEAR(measures().area, 52.3389, 1e-4);
  const carreau_molecule_options options = surface(CARREAU_VWS);
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  EXPECT_EQ(carreau_load_molecule(session, &options, "no such file.pdb"), CARREAU_ERR_FILE);
}

}  // namespace
}  // namespace abi_tests
