// SPDX-License-Identifier: BSD-3-Clause
// carreau_cad.hpp: a sphere of radius 1, by the command that reads it and by all questions to its file.
#include <gtest/gtest.h>

#include <carreau_cad.hpp>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <numbers>
#include <span>

namespace {

const std::string sphere = CARREAU_TEST_SPHERE;

TEST(CadWrapper, MeshesAFile) {
  carreau::Session session;
  const carreau::CadFile file = carreau::cad_open(session, sphere);
  session.set("hphydef", 0.1);
  session.generate();
  const carreau_quality quality = session.mesh().quality();
  EXPECT_NEAR(quality.area / file.measure_face(1).area, 1, 0.01);
  EXPECT_EQ(quality.open_edges, 0);
}

TEST(CadWrapper, ListsTheContentOfAFile) {
  double last = 0;
  carreau::CadFile file(sphere, [&](double fraction) { return last = fraction, true; });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(file.info().faces, 1);
  EXPECT_TRUE(file.losses().empty());
  EXPECT_EQ(file.face(1).number, 1);
  EXPECT_EQ(file.face(1).why, "");
  EXPECT_EQ(file.measure_face(1).kind, "sphere");
  const double radius = std::sqrt(file.measure_face(1).area / (4 * std::numbers::pi));
  const carreau_cad_report report = file.inspect();
  EXPECT_EQ(report.faces, 1);
  const auto surfaces = file.surfaces(report);
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_EQ(surfaces[0], std::pair(std::string("sphere"), 1));
  EXPECT_EQ(std::ssize(file.dangers(report)), report.dangers);
  EXPECT_LT(file.measure_gaps().largest, 1e-6);
  EXPECT_FALSE(file.curves(1).empty());
  EXPECT_EQ(file.parts(1), std::vector<std::int32_t>{1});
  EXPECT_EQ(file.whole_face(1), 1);
  EXPECT_EQ(file.whole_edge(1), 1);
  const carreau::Point2 uv = file.curve_point(1, 1, 0.5);
  const carreau::Point3 p = file.point(1, uv).xyz;
  const carreau::CadFigures figures = file.measure_face(1);
  double from_center = 0;
  for (std::size_t i = 0; i < 3; ++i) from_center = std::hypot(from_center, p[i] - (figures.low[i] + figures.high[i]) / 2);
  EXPECT_NEAR(from_center / radius, 1, 1e-6);
}

TEST(CadWrapper, SizesOfFacesCount) {
  carreau::CadFile file(sphere);
  const auto triangles = [&](double size) {
    carreau::Session session;
    file.add_to(session);
    file.set_face_size("1", size);
    session.set("hphy_flag", 2);
    session.generate();
    return static_cast<double>(session.mesh().triangle_count());
  };
  EXPECT_NEAR(triangles(0.1) / triangles(0.2), 4, 0.4);
}

TEST(CadWrapper, BytesNamesAndSizes) {
  std::ifstream stream(sphere, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  carreau::Session session;
  const carreau::CadFile opened = carreau::cad_open(session, bytes);
  EXPECT_EQ(opened.info().faces, 1);
  carreau::CadFile file(sphere);
  auto options = carreau::detail::sized<carreau_cad_options>();
  options.scale = 2, options.min_feature = 1e-9;
  file.read(bytes, "", options);
  EXPECT_NEAR(file.measure_face(1).area / opened.measure_face(1).area, 4, 1e-9);
  EXPECT_TRUE(file.small_features().empty());
  if (file.info().solids == 1) file.name_solids({"ball"}, {0x123456});
  double last = 0;
  EXPECT_THROW(file.mirror({0, 0, 0}, {0, 0, 0}), carreau::Error);
  file.imprint(0, [&](double fraction) { return last = fraction, true; });
  EXPECT_EQ(file.info().shared_faces, 0);
  file.set_size(2, 1, 0.5);
  EXPECT_THROW(file.set_size(0, 99, 0.5), carreau::Error);
  EXPECT_THROW(file.name_solids({"one", "two", "three"}), carreau::Error);
  session.set("hphydef", 0.3);
  session.generate();
  EXPECT_EQ(session.mesh().face_sides(1)[1], 0);
  EXPECT_EQ(file.entity_name(1, 1), "");
  EXPECT_TRUE(file.contacts().empty());
  EXPECT_EQ(static_cast<std::int32_t>(file.tree().size()), file.info().tree_rows);
  EXPECT_EQ(file.face(1).layer, "");
}

TEST(CadWrapper, Fails) {
  EXPECT_THROW(carreau::CadFile("none.step"), carreau::Error);
  carreau::CadFile file(sphere);
  EXPECT_THROW(file.read("none.step"), carreau::Error);
  EXPECT_EQ(file.info().faces, 1);  // the old content stays
  EXPECT_THROW(static_cast<void>(file.face(2)), carreau::Error);
  carreau::Session session;
  EXPECT_THROW(carreau::cad_open(session, "none.step"), carreau::Error);
  const carreau::CadFile::Progress broken = [](double) -> bool { throw std::runtime_error("progress"); };
  try {
    file.read(sphere, broken);
  } catch (const carreau::Error& error) {
    EXPECT_EQ(error.status(), carreau::Status::cancelled);
    EXPECT_THROW(std::rethrow_if_nested(error), std::runtime_error);
  }
}

}  // namespace
