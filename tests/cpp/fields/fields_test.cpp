// SPDX-License-Identifier: BSD-3-Clause
// Fields written by a session, read back with OpenEXR, against closed forms.
#include "fields/fields.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <thread>

#include "common/analytic_cad.h"
#include "common/exr_image.h"
#include "fields/field_samples.h"
#include "metric/metric2_algebra.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::ExrImage;
using testing::read_exr;

constexpr double pi = std::numbers::pi;

class Recorder : public Monitor {
 public:
  void message(Level level, std::string_view text) override {
    if (level <= Level::warning) warnings.emplace_back(text);
  }
  std::vector<std::string> warnings;
};

struct FieldCase {
  std::shared_ptr<AnalyticCad> cad;
  Recorder monitor;
  std::unique_ptr<Session> session;
  std::filesystem::path folder;

  explicit FieldCase(AnalyticCad geometry) : cad(std::make_shared<AnalyticCad>(std::move(geometry))) {
    session = std::make_unique<Session>(monitor);
    session->set_cad(cad);
    session->set_model(testing::unglued(*cad));
    folder = std::filesystem::temp_directory_path() / ("carreau fields " + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder);
  }
  ~FieldCase() { std::filesystem::remove_all(folder); }
  FieldCase(const FieldCase&) = delete;
  FieldCase& operator=(const FieldCase&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (folder / name).string(); }
  /// All faces in one file.
  std::vector<ExrImage> images(FieldOptions options = {}) {
    options.multi_part = true;
    session->write_fields(file("all.exr"), options);
    return read_exr(file("all.exr"));
  }
  ExrImage image(int width, int height, unsigned groups = all_fields) {
    FieldOptions options;
    options.width = width, options.height = height, options.groups = groups;
    return images(options).at(0);
  }
  void by_angle(double hgeomin = 1e-3) {
    session->parameters().set("hphy_flag", 0);
    session->parameters().set("hgeo_flag", 1);
    session->parameters().set("hgeomin", hgeomin);
    session->parameters().set("hgeomax", 100.0);
  }
};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <typename E, typename Action>
std::string sentence_of(Action&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return "no error";
}

// (u, v) of each pixel from the attributes of the file alone, as a reader would compute it.
Vec2 uv_of(const ExrImage& image, int column, int row) {
  const Imath::V2d low = image.pair_attribute("uv.low"), high = image.pair_attribute("uv.high");
  return {low.x + (column + 0.5) * (high.x - low.x) / image.width,
          high.y - (row + 0.5) * (high.y - low.y) / image.height};
}

template <typename Body>
int for_each_inside(const ExrImage& image, const Body& body) {
  int inside = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if (image.at("mask", column, row) == 1) {
        ++inside;
        body(column, row, uv_of(image, column, row));
      }
  return inside;
}

constexpr double single = 1e-6;  // rounding of 32-bit reals, and of preceding computations

TEST(TangentSizes, MatchTheMetric) {
  std::mt19937 random(11);
  std::uniform_real_distribution any(-1.0, 1.0), direction(1.0, 179.0);
  for (int i = 0; i < 1000; ++i) {
    SurfaceJet jet;
    jet.su = {any(random), any(random), 2 + any(random)};
    jet.sv = {2 + any(random), any(random), any(random)};
    const double h1 = std::exp(3 * any(random)), h2 = h1 * std::exp(0.01 + 4 * std::abs(any(random)));
    const double angle = direction(random);
    // The metric of the tangent plane, in a frame along Su, then through dx = e . (Su du + Sv dv).
    const Vec3 e1 = (1 / norm(jet.su)) * jet.su, n = cross(jet.su, jet.sv), e2 = (1 / norm(n)) * cross(n, e1);
    const double c = std::cos(angle * pi / 180), s = std::sin(angle * pi / 180);
    const auto along = [&](Vec3 w, double x, double y) { return x * dot(e1, w) + y * dot(e2, w); };
    const auto inner = [&](Vec3 p, Vec3 q) {
      return along(p, c, s) * along(q, c, s) / (h1 * h1) + along(p, -s, c) * along(q, -s, c) / (h2 * h2);
    };
    const TangentSizes sizes =
        tangent_sizes(jet, {inner(jet.su, jet.su), inner(jet.su, jet.sv), inner(jet.sv, jet.sv)});
    EXPECT_NEAR(sizes.h1 / h1, 1, 1e-9);
    EXPECT_NEAR(sizes.h2 / h2, 1, 1e-9);
    EXPECT_NEAR(sizes.h / std::sqrt(h1 * h2), 1, 1e-9);
    EXPECT_NEAR(sizes.angle, angle, 1e-8);
    const TangentSizes round = tangent_sizes(jet, induced_metric(jet.su, jet.sv, h1));
    EXPECT_NEAR(round.h / h1, 1, 1e-12);
    EXPECT_EQ(round.angle, 0);
  }
  SurfaceJet pole;
  pole.sv = {0, 1, 0};
  EXPECT_TRUE(std::isnan(tangent_sizes(pole, {0, 0, 1}).h));
}

TEST(Fields, HaveTheChannelsAndAttributesThatAreDocumented) {
  FieldCase run(testing::hemisphere());
  run.by_angle();
  run.session->make_mesh();
  const ExrImage image = run.image(20, 20);
  std::set<std::string> names;
  for (const auto& [name, values] : image.real) names.insert(name);
  for (const auto& [name, values] : image.integer) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"size.h",
                                          "size.h1",
                                          "size.h2",
                                          "size.angle",
                                          "induced.e",
                                          "induced.f",
                                          "induced.g",
                                          "target.m11",
                                          "target.m12",
                                          "target.m22",
                                          "curvature.k1",
                                          "curvature.k2",
                                          "position.x",
                                          "position.y",
                                          "position.z",
                                          "normal.x",
                                          "normal.y",
                                          "normal.z",
                                          "deviation.a0",
                                          "deviation.a1",
                                          "triangle",
                                          "mask",
                                          "physical.h",
                                          "physical.h1",
                                          "physical.h2",
                                          "physical.angle",
                                          "geometric.h",
                                          "geometric.h1",
                                          "geometric.h2",
                                          "geometric.angle",
                                          "governs",
                                          "R",
                                          "G",
                                          "B",
                                          "A"}));
  EXPECT_EQ(image.header.name(), "face.1");
  EXPECT_EQ(image.header.compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(image.integer_attribute("face"), 1);
  EXPECT_EQ(image.real_attribute("diag"), run.session->report().diag);
  EXPECT_EQ(image.integer_attribute("parameter.hgeo_flag"), 1);
  EXPECT_EQ(image.real_attribute("parameter.hgeomin"), 1e-3);
  EXPECT_DOUBLE_EQ(image.real_attribute("parameter.hphydef"), run.session->report().diag / 50);
  EXPECT_FALSE(image.has("parameter.pref"));
  EXPECT_EQ(image.text_attribute("face.status"), "meshed");
  EXPECT_EQ(image.text_attribute("rows").substr(0, 27), "v falls from row to row: th");
  EXPECT_FALSE(image.text_attribute("carreau.version").empty());
  EXPECT_NEAR(image.pair_attribute("uv.low").x, -1, 1e-12);
  EXPECT_NEAR(image.pair_attribute("uv.high").x, 1, 1e-12);
}

TEST(Fields, MatchTheClosedFormsOfASphere) {
  FieldCase run(testing::hemisphere());
  run.by_angle();
  run.session->make_mesh();
  const ExrImage image = run.image(90, 110);
  const double size = 2 * std::sin(8 * pi / 180);  // HDR eq. 4.35, radius 1
  const int inside = for_each_inside(image, [&](int i, int j, Vec2 p) {
    const auto at = [&](const char* name) { return static_cast<double>(image.at(name, i, j)); };
    const double d = 1 + dot(p, p), conformal = 4 / (d * d);
    ASSERT_NEAR(at("position.x"), 2 * p.x() / d, single);
    ASSERT_NEAR(at("position.y"), 2 * p.y() / d, single);
    ASSERT_NEAR(at("position.z"), (2 - d) / d, single);
    ASSERT_NEAR(at("induced.e"), conformal, 4 * single);
    ASSERT_NEAR(at("induced.f"), 0, single);
    ASSERT_NEAR(at("induced.g"), conformal, 4 * single);
    // Su x Sv points out of the sphere, which bends away from it.
    ASSERT_NEAR(at("normal.x"), 2 * p.x() / d, single);
    ASSERT_NEAR(at("normal.y"), 2 * p.y() / d, single);
    ASSERT_NEAR(at("normal.z"), (2 - d) / d, single);
    ASSERT_NEAR(at("curvature.k1"), -1, single);
    ASSERT_NEAR(at("curvature.k2"), -1, single);
    for (const char* name : {"size.h", "size.h1", "size.h2"}) ASSERT_NEAR(at(name), size, single);
    ASSERT_EQ(at("size.angle"), 0);
    // The control space promises 1 % of a length.
    const Metric2 target{at("target.m11"), at("target.m12"), at("target.m22")};
    ASSERT_LE(length_error(target, {conformal / (size * size), 0, conformal / (size * size)}), 0.011);
    // Both deviations of a triangle of side h inscribed in the sphere, roughly.
    ASSERT_GT(at("deviation.a0"), 0.05 * size * size);
    ASSERT_LT(at("deviation.a0"), 0.35 * size * size);
    ASSERT_GT(at("deviation.a1"), 5);
    ASSERT_LT(at("deviation.a1"), 15);
  });
  EXPECT_GT(inside, 0.75 * image.width * image.height);
}

TEST(Fields, MatchTheClosedFormsOfAParaboloid) {
  FieldCase run(testing::paraboloid());
  run.by_angle();
  run.session->make_mesh();
  const ExrImage image = run.image(64, 50);
  const int inside = for_each_inside(image, [&](int i, int j, Vec2 p) {
    const auto at = [&](const char* name) { return static_cast<double>(image.at(name, i, j)); };
    const double w = 1 + dot(p, p);
    const double parallel = 1 / std::sqrt(w), meridian = 1 / (w * std::sqrt(w));
    ASSERT_NEAR(at("curvature.k1"), parallel, single);
    ASSERT_NEAR(at("curvature.k2"), meridian, single);
    ASSERT_NEAR(at("size.h"), 2 * std::sin(8 * pi / 180) / parallel, 2 * single);
    ASSERT_NEAR(at("induced.e"), 1 + p.x() * p.x(), 5 * single);
    ASSERT_NEAR(at("induced.f"), p.x() * p.y(), 5 * single);
    ASSERT_NEAR(at("induced.g"), 1 + p.y() * p.y(), 5 * single);
    ASSERT_NEAR(at("normal.z"), 1 / std::sqrt(w), single);
  });
  EXPECT_EQ(inside, 64 * 50);
}

// Both principal radii of a torus of radii 2 and 0.7, sizes along its parameter lines.
TEST(Fields, AnAnisotropicMeshHasTwoSizesAndADirection) {
  FieldCase run(testing::torus_patch());
  run.by_angle();
  run.session->parameters().set("geo_metric", 1);
  run.session->parameters().set("geo_rule", "angle");
  run.session->make_mesh();
  const ExrImage image = run.image(40, 40);
  int across = 0, along = 0;
  for_each_inside(image, [&](int i, int j, Vec2 p) {
    const double small = 0.7, big = std::abs((2 + 0.7 * std::cos(p.y())) / std::cos(p.y()));  // radii of curvature
    const auto at = [&](const char* name) { return static_cast<double>(image.at(name, i, j)); };
    ASSERT_LE(at("size.h1"), at("size.h2"));
    ASSERT_NEAR(at("size.h"), std::sqrt(at("size.h1") * at("size.h2")), 2 * single);
    if (big < 20 * small) {
      ASSERT_GT(at("size.h2"), 1.05 * at("size.h1"));
      ASSERT_NEAR(at("size.h1"), 2 * std::sin(8 * pi / 180) * small, 0.02 * at("size.h1"));
      ASSERT_NEAR(at("size.angle"), 90, 1e-3);  // along v
      ++across;
    } else {
      ++along;
    }
  });
  EXPECT_GT(across, 1000);
  EXPECT_LT(along, 200);
}

// On a sphere of radius 1 the geometric size is 2 sin(angle) (HDR eq. 4.35); the physical one grows along x.
TEST(Fields, ShowTheSizeThatGoverns) {
  FieldCase run(testing::hemisphere());
  const auto physical = [](Vec2 p) { return 0.25 + 0.2 * p.x(); };
  run.cad->size_on_surface = [&](int, Vec2 p) { return std::optional<double>(physical(p)); };
  run.by_angle();
  Parameters& parameters = run.session->parameters();
  parameters.set("hphy_flag", 2);
  parameters.set("hphymin", 0.1);
  parameters.set("hphymax", 10.0);
  run.session->make_mesh();
  const ExrImage image = run.image(64, 64);
  const double geometric = 2 * std::sin(8 * pi / 180);
  std::array<int, 4> count{};
  for_each_inside(image, [&](int i, int j, Vec2 p) {
    const auto at = [&](const char* name) { return static_cast<double>(image.at(name, i, j)); };
    const double h = std::max(0.1, physical(p));
    for (const char* name : {"physical.h", "physical.h1", "physical.h2"}) ASSERT_NEAR(at(name), h, single);
    for (const char* name : {"geometric.h", "geometric.h1", "geometric.h2"}) ASSERT_NEAR(at(name), geometric, single);
    ASSERT_NEAR(at("size.h"), std::min(h, geometric), single);
    const auto governs = image.number("governs", i, j);
    if (std::abs(h - geometric) < 1e-5 || std::abs(physical(p) - 0.1) < 1e-5) return;
    ASSERT_EQ(governs, geometric < h ? 1u : physical(p) < 0.1 ? 2u : 0u);
    ++count[governs];
  });
  for (const std::size_t origin : {0u, 1u, 2u}) EXPECT_GT(count[origin], 50) << origin;
  EXPECT_EQ(image.number("governs", 0, 0), no_triangle) << "outside of the disc";
}

// Each size has its own bounds, also the geometric size, and the smaller size counts.
TEST(Fields, ShowWhereBoundsAndGradationGovern) {
  FieldCase run(testing::hemisphere());
  run.by_angle();
  Parameters& parameters = run.session->parameters();
  parameters.set("hphy_flag", 2);
  parameters.set("hphymin", 0.01);
  parameters.set("hphymax", 1.0);
  parameters.set("hgeomax", 0.2);  // 2 sin(8 degrees) = .278
  run.cad->size_on_surface = [](int, Vec2 p) { return std::optional<double>(p.x() < 0 ? 0.05 : 0.9); };
  run.session->make_mesh();
  const unsigned channels = field_governs | field_mask | field_size;
  ExrImage image = run.image(48, 48, channels);
  for_each_inside(image, [&](int i, int j, Vec2 p) {
    ASSERT_EQ(image.number("governs", i, j), p.x() < 0 ? 0u : 2u);
    ASSERT_NEAR(image.at("geometric.h", i, j), 0.2, single);
  });
  parameters.set("gradation", 1.3);
  run.session->make_mesh();
  image = run.image(48, 48, channels);
  std::array<int, 4> count{};
  for_each_inside(image, [&](int i, int j, Vec2 p) {
    const std::uint32_t governs = image.number("governs", i, j);
    ++count[governs];
    const double whole = p.x() < 0 ? 0.05 : 0.2;
    ASSERT_EQ(governs == 3, image.at("size.h", i, j) < (1 - 2e-6) * whole) << image.at("size.h", i, j);
  });
  EXPECT_GT(count[3], 200) << "sizes grow from .05 to .2 by steps of 1.3";
  EXPECT_GT(count[0], 700);
}

// In each direction the smaller of two sizes counts, and a size that is ignored is NaN.
TEST(Fields, AnAnisotropicMeshHasBothMetrics) {
  FieldCase run(testing::torus_patch());
  run.by_angle();
  run.session->parameters().set("geo_metric", 1);
  run.session->parameters().set("geo_rule", "angle");
  run.session->make_mesh();
  ExrImage image = run.image(24, 24);
  for_each_inside(image, [&](int i, int j, Vec2) {
    ASSERT_TRUE(std::isnan(image.at("physical.h1", i, j)));
    for (const char* name : {".h", ".h1", ".h2", ".angle"})
      ASSERT_EQ(image.at(std::string("geometric") + name, i, j), image.at(std::string("size") + name, i, j));
    ASSERT_EQ(image.number("governs", i, j), 1u);
  });
  run.session->parameters().set("hphy_flag", 1);
  run.session->parameters().set("hphydef", 0.15);
  run.session->parameters().set("hphymax", 10.0);
  run.session->parameters().set("hphymin", 1e-3);
  run.session->make_mesh();
  image = run.image(24, 24);
  for_each_inside(image, [&](int i, int j, Vec2) {
    ASSERT_NEAR(image.at("physical.h1", i, j), 0.15, single);
    ASSERT_EQ(image.number("governs", i, j), 0u) << image.at("geometric.h1", i, j);
    ASSERT_NEAR(image.at("size.h2", i, j), 0.15, single);
  });
}

// A small size at one place; with gradation 1.3 sizes grow by ln 1.3 at most along a path, and the target agrees.
TEST(Fields, ObeyTheGradationOfTheMesh) {
  FieldCase run(testing::hemisphere());
  run.cad->size_on_surface = [](int, Vec2 p) {
    return std::optional<double>(norm(p - Vec2{0.2, 0.1}) < 0.05 ? 0.02 : 0.3);
  };
  Parameters& parameters = run.session->parameters();
  parameters.set("hphy_flag", 2);
  parameters.set("hphymin", 0.01);
  parameters.set("hphymax", 0.5);
  parameters.set("gradation", 1.3);
  run.session->make_mesh();
  const ExrImage image = run.image(120, 120);
  const double slope = std::log(1.3);
  int bounded = 0, apart = 0;
  const int inside = for_each_inside(image, [&](int i, int j, Vec2 p) {
    const auto at = [&](const char* name) { return static_cast<double>(image.at(name, i, j)); };
    bounded += at("size.h") < 0.29;
    // Some pixels away it differs by no more than the slope times the distance on the sphere.
    if (i + 12 < 120 && image.at("mask", i + 12, j) == 1) {
      const Vec3 a{at("position.x"), at("position.y"), at("position.z")};
      const Vec3 b{image.at("position.x", i + 12, j), image.at("position.y", i + 12, j),
                   image.at("position.z", i + 12, j)};
      const double distance = 2 * std::asin(norm(b - a) / 2);
      ASSERT_LE(std::abs(image.at("size.h", i + 12, j) - at("size.h")), 1.05 * slope * distance);
    }
    const double d = 1 + dot(p, p), m = 4 / (d * d * at("size.h") * at("size.h"));
    apart += length_error({at("target.m11"), at("target.m12"), at("target.m22")}, {m, 0, m}) > 0.05;
  });
  EXPECT_GT(bounded, inside / 3);
  EXPECT_LT(apart, 0.02 * inside);
}

TEST(Fields, MaskCountsTheAreaOfTheDomain) {
  FieldCase run(testing::hemisphere());
  run.session->parameters().set("hphydef", 0.05);
  run.session->make_mesh();
  double area = 0;  // of the polygon that was meshed
  const FaceMesh& face = run.session->mesh().faces[0];
  for (const auto& t : face.triangles) area += cross(face.uv[t[1]] - face.uv[t[0]], face.uv[t[2]] - face.uv[t[0]]) / 2;
  for (const int side : {32, 128, 512}) {
    const ExrImage image = run.image(side, side, field_mask);
    ASSERT_EQ(image.real.size(), 1U);
    const Imath::V2d box = image.pair_attribute("uv.high") - image.pair_attribute("uv.low");
    const int inside = for_each_inside(image, [](int, int, Vec2) {});
    EXPECT_NEAR(inside * box.x * box.y / (side * side), area, 2.0 / side) << side;
  }
}

TEST(Fields, TriangleIsTheOneThatHoldsThePixel) {
  FieldCase run(testing::teapot());
  run.session->parameters().set("hphydef", 0.2);
  run.session->make_mesh();
  FieldOptions options;
  options.width = 61, options.height = 47, options.groups = field_triangle | field_mask;
  const std::vector<ExrImage> images = run.images(options);
  const SurfaceMesh& mesh = run.session->mesh();
  ASSERT_EQ(images.size(), mesh.faces.size());
  std::uint32_t first = 0;
  for (std::size_t f = 0; f < images.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    EXPECT_EQ(images[f].header.name(), "face." + std::to_string(face.ref));
    EXPECT_EQ(images[f].integer_attribute("triangle.first"), static_cast<int>(first));
    int without = 0;
    const int inside = for_each_inside(images[f], [&](int i, int j, Vec2 p) {
      const std::uint32_t number = images[f].integer.at("triangle")[static_cast<std::size_t>(j * 61 + i)];
      if (number == no_triangle) {
        ++without;
        return;
      }
      ASSERT_GE(number, first);
      ASSERT_LT(number - first, face.triangles.size());
      const auto& t = face.triangles[number - first];
      for (int k = 0; k < 3; ++k) ASSERT_GE(cross(face.uv[t[(k + 1) % 3]] - face.uv[t[k]], p - face.uv[t[k]]), -1e-13);
    });
    EXPECT_EQ(inside, 61 * 47);
    // Only triangles that a pole flattens are not in the mesh.
    EXPECT_TRUE(without == 0 || !face.flattened.empty());
    EXPECT_LT(without, 61 * 47 / 4);
    first += static_cast<std::uint32_t>(face.triangles.size());
  }
}

TEST(Fields, OutsideTheDomainAreNaN) {
  FieldCase run(testing::hemisphere());
  run.session->make_mesh();
  const ExrImage image = run.image(40, 40);
  int outside = 0;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) {
      if (image.at("mask", column, row) == 1) continue;
      ++outside;
      ASSERT_EQ(image.at("mask", column, row), 0);
      ASSERT_EQ(image.integer.at("triangle")[static_cast<std::size_t>(40 * row + column)], no_triangle);
      for (const auto& [name, values] : image.real)
        if (name.size() > 1 && name != "mask") {
          ASSERT_TRUE(std::isnan(image.at(name, column, row))) << name;
        }
    }
  EXPECT_GT(outside, 200);
}

TEST(Fields, PreviewShowsTheDomainAndTheSidesOfTriangles) {
  FieldCase run(testing::hemisphere());
  run.session->parameters().set("hphydef", 0.3);
  run.session->make_mesh();
  const ExrImage image = run.image(300, 300, field_preview | field_mask | field_triangle);
  EXPECT_EQ(image.at("A", 0, 0), 0);
  EXPECT_EQ(image.at("A", 150, 150), 1);
  EXPECT_EQ(image.header.channels()["R"].type, Imf::HALF);
  const FaceMesh& face = run.session->mesh().faces[0];
  int seen = 0;
  for (const auto& t : face.triangles) {
    const Vec2 a = face.uv[t[0]], b = face.uv[t[1]], c = face.uv[t[2]];
    const auto green = [&](Vec2 p) {
      const Imath::V2d low = image.pair_attribute("uv.low"), high = image.pair_attribute("uv.high");
      return image.at("G", static_cast<int>((p.x() - low.x) / (high.x - low.x) * 300),
                      static_cast<int>((high.y - p.y()) / (high.y - low.y) * 300));
    };
    const Vec2 centre = (1.0 / 3) * (a + b + c), middle = 0.5 * (a + b);
    if (norm(centre) > 0.8 || norm(middle) > 0.8) continue;
    ++seen;
    EXPECT_LT(green(middle), 0.75 * green(centre));
    EXPECT_GT(green(centre), 0.1);
  }
  EXPECT_GT(seen, 20);
}

TEST(Fields, BytesDoNotDependOnThreads) {
  FieldCase run(testing::hemisphere());
  run.by_angle();
  run.session->make_mesh();
  std::set<std::string> contents;
  for (const int threads : {1, 2, 8}) {
    FieldOptions options;
    options.longest = 150, options.face = 1, options.file.threads = threads;
    run.session->write_fields(run.file("x.exr"), options);
    contents.insert(bytes_of(run.file("x.exr")));
  }
  EXPECT_EQ(contents.size(), 1U);
}

// A host that is not re-entrant, and knows its surface on the domain only.
class StrictCad : public AnalyticCad {
 public:
  StrictCad() : AnalyticCad(testing::hemisphere()) {
    size_on_surface = [this](int, Vec2 p) {
      look_at(p);
      return std::optional<double>(0.1 + 0.05 * p.x());
    };
  }
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    for (const Vec2& p : uv) look_at(p);
    AnalyticCad::surface(face, want, uv, out);
  }
  int wrong = 0;

 private:
  void look_at(Vec2 p) { wrong += std::this_thread::get_id() != caller_ || norm(p) > 1 + 1e-12; }
  std::thread::id caller_ = std::this_thread::get_id();
};

TEST(Fields, CallTheHostFromTheCallersThreadAndInsideTheDomainOnly) {
  const auto cad = std::make_shared<StrictCad>();
  FieldCase run(testing::hemisphere());
  run.session->set_cad(cad);
  run.session->parameters().set("hphy_flag", 2);
  run.session->make_mesh();
  const std::int64_t before = cad->calls.surface();
  FieldOptions options;
  options.width = options.height = 100, options.file.threads = 4;
  for (const bool raw : {false, true}) {
    options.raw = raw;
    run.images(options);
  }
  EXPECT_EQ(cad->wrong, 0);
  EXPECT_GT(cad->calls.surface(), before + 10000);
}

TEST(Fields, AreOneFileAFaceByDefault) {
  FieldCase run(testing::teapot());
  run.session->parameters().set("hphydef", 0.5);
  run.session->make_mesh();
  FieldOptions options;
  options.longest = 20;
  const std::vector<std::string> files = run.session->write_fields(run.file("tea.exr"), options);
  ASSERT_EQ(files.size(), 32U);
  for (int ref = 1; ref <= 32; ++ref) {
    EXPECT_EQ(files[static_cast<std::size_t>(ref) - 1], run.file("tea.face." + std::to_string(ref) + ".exr"));
    const std::vector<ExrImage> images = read_exr(files[static_cast<std::size_t>(ref) - 1]);
    ASSERT_EQ(images.size(), 1U);
    EXPECT_EQ(images[0].integer_attribute("face"), ref);
    EXPECT_EQ(std::max(images[0].width, images[0].height), 20);
  }
  options.face = 7;
  EXPECT_EQ(run.session->write_fields(run.file("seven.exr"), options), std::vector<std::string>{run.file("seven.exr")});
  EXPECT_EQ(read_exr(run.file("seven.exr")).at(0).integer_attribute("face"), 7);
  EXPECT_EQ(run.images({.longest = 20}).size(), 32U);
}

// Formats of `call export`.
TEST(Fields, AreExportedUnderTheNameThatIsGiven) {
  AnalyticCad narrow;
  for (const int ref : {3, 5})
    narrow.faces[ref] = {testing::paraboloid_jet, testing::rectangle({double(ref), 0}, {ref + 1.0, 0.05})};
  FieldCase run(std::move(narrow));
  EXPECT_THROW(run.session->write(run.file("x.exr")), InvalidArgument);  // there is no mesh yet
  run.session->make_mesh();
  run.session->parameters().set("option", "onesurf3d");
  run.session->parameters().set("refs", 5);
  run.session->write(run.file("x.exr"));
  EXPECT_EQ(read_exr(run.file("x.exr")).at(0).integer_attribute("face"), 5);
  // The image shows the mesh, whatever happened later.
  run.session->parameters().set("hphymin", 2.0);
  run.session->parameters().set("hphymax", 1.0);
  EXPECT_THROW(run.session->make_mesh(), InvalidArgument);
  run.session->write(run.file("y.exr"));
  EXPECT_EQ(read_exr(run.file("y.exr")).at(0).text_attribute("face.status"), "meshed");
}

// The torus patch is pi long at most and 0.7 pi wide in space: 2.7 pi / 2 x 0.7 pi at its outer side.
TEST(Fields, ImagesHaveTheShapeOfThePatch) {
  FieldCase run(testing::torus_patch());
  run.session->make_mesh();
  const ExrImage image = run.images({.longest = 300, .groups = field_mask}).at(0);
  EXPECT_EQ(image.width, 300);
  // Mean of |Su| over v in [0, pi]: 2; of |Sv|: 0.7.
  EXPECT_NEAR(image.height, 300 * (0.7 * pi) / (2 * pi / 2), 2);
}

TEST(Fields, ThatCannotBeWrittenLeaveTheMesh) {
  FieldCase run(testing::paraboloid());
  run.session->parameters().set("hphydef", 0.5);
  run.session->make_mesh();
  const std::vector<Vec3> before = run.session->mesh().vertices;
  const auto write = [&](const std::string& path, const FieldOptions& options) {
    return [&run, path, options] { run.session->write_fields(path, options); };
  };
  EXPECT_EQ(sentence_of<FileError>(write(run.file("none/x.exr"), {.longest = 10})),
            "cannot write '" + run.file("none/x.face.1.exr") + "': No such file or directory");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.tif"), {})),
            "the name '" + run.file("x.tif") + "' ends neither in .exr nor in .png");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.exr"), {.face = 9})),
            "there is no face of the reference 9, whose fields are to be written");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.exr"), {.longest = 0})),
            "the longer side of an image is 0 pixels; it must be from 1 to 65536");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.exr"), {.width = 5})),
            "the height of an image is 0 pixels; it must be from 1 to 65536");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.exr"), {.groups = 2048})),
            "the groups of channels are 2048, which is not from 1 to 2047");
  EXPECT_EQ(sentence_of<InvalidArgument>(write(run.file("x.exr"), {.file = {.threads = -1}})),
            "the number of threads is -1; it must be at least 1");
  EXPECT_TRUE(std::filesystem::is_empty(run.folder));
  EXPECT_EQ(run.session->mesh().vertices, before);
  run.session->write_fields(run.file("x.exr"), {.longest = 10});
}

TEST(Fields, StopWithoutAFileOnRequestOfTheHost) {
  FieldCase run(testing::paraboloid());
  run.session->parameters().set("hphydef", 0.5);
  run.session->make_mesh();
  run.monitor.request_stop();
  EXPECT_THROW(run.session->write_fields(run.file("x.exr"), {}), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(run.folder));
}

// ---- patches that failed ----

// Throws, as a checked host does, inside a disc of the parameter plane.
class BrokenCad : public AnalyticCad {
 public:
  using AnalyticCad::AnalyticCad;
  explicit BrokenCad(AnalyticCad cad) : AnalyticCad(std::move(cad)) {}
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    AnalyticCad::surface(face, want, uv, out);
    for (std::size_t i = 0; i < uv.size(); ++i)
      if (broken && norm(uv[i]) < 1) out[i].s.x() = std::nan("");
  }
  bool broken = true;
};

TEST(Fields, ShowWhereAHostFails) {
  const auto cad = std::make_shared<BrokenCad>(testing::paraboloid());
  FieldCase run(testing::paraboloid());
  run.session->set_cad(cad);
  EXPECT_THROW(run.session->make_mesh(), CallbackError);
  run.monitor.warnings.clear();
  const ExrImage image = run.image(100, 100);
  int failing = 0;
  const int inside = for_each_inside(image, [&](int i, int j, Vec2 p) {
    ASSERT_EQ(std::isnan(image.at("position.x", i, j)), norm(p) < 1);
    failing += norm(p) < 1;
    // The values that the host does give are there.
    ASSERT_NEAR(image.at("induced.f", i, j), p.x() * p.y(), 5 * single);
    ASSERT_TRUE(std::isnan(image.at("target.m11", i, j)));
    ASSERT_EQ(image.integer.at("triangle")[static_cast<std::size_t>(100 * j + i)], no_triangle);
  });
  EXPECT_EQ(inside, 100 * 100);
  EXPECT_NEAR(failing, pi / 25 * 100 * 100, 100);
  EXPECT_EQ(image.text_attribute("face.status"), "not meshed");
  ASSERT_EQ(run.monitor.warnings.size(), 1U);
  EXPECT_EQ(run.monitor.warnings[0].find("the geometry fails at " + std::to_string(failing) +
                                         " pixels of the fields of face 1; first: face 1"),
            0U)
      << run.monitor.warnings[0];

  // Without the fault the fields belong to the mesh again.
  cad->broken = false;
  run.session->make_mesh();
  EXPECT_EQ(run.image(10, 10).text_attribute("face.status"), "meshed");
}

// Curves that the host cannot give at all, and a face whose loop does not close.
class OpenCad : public BrokenCad {
 public:
  OpenCad() : BrokenCad(testing::paraboloid()) { broken = false; }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    CurveJet jet = AnalyticCad::curve(face, ic, want, t);
    if (ic == 3 && t > 0.8) jet.c.x() = std::nan("");
    return jet;
  }
};

TEST(Fields, ADomainThatDoesNotCloseHasTheFieldsOfTheClosedOne) {
  FieldCase run(testing::paraboloid());
  run.session->set_cad(std::make_shared<OpenCad>());
  EXPECT_THROW(run.session->make_mesh(), CallbackError);
  const ExrImage image = run.image(50, 50);
  EXPECT_EQ(for_each_inside(image, [](int, int, Vec2) {}), 50 * 50);
  EXPECT_NEAR(image.real_attribute("domain.gap"), 1, 0.03);
  EXPECT_NEAR(image.real_attribute("diag"), 7.73, 0.01);
}

TEST(Fields, AFailedFaceShowsItsDomainAndTheReason) {
  AnalyticCad cad = testing::paraboloid();
  // A second face, next to it, whose upper side runs through its lower one.
  cad.faces[2] = {[](Vec2 p) { return testing::paraboloid_jet(p); },
                  {testing::segment({2.5, -2.5}, {5, -2.5}), testing::segment({5, -2.5}, {5, 2.5}),
                   testing::segment({5, 2.5}, {3, -5}), testing::segment({3, -5}, {2.5, 2.5}),
                   testing::segment({2.5, 2.5}, {2.5, -2.5})}};
  FieldCase run(std::move(cad));
  run.session->parameters().set("hphydef", 0.5);
  run.session->make_mesh();
  ASSERT_EQ(run.session->mesh().faces[1].status, FaceStatus::failed);
  FieldOptions options;
  options.width = options.height = 60;
  const std::vector<ExrImage> images = run.images(options);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].text_attribute("face.status"), "meshed");
  EXPECT_EQ(images[1].text_attribute("face.status"), "failed");
  EXPECT_EQ(images[1].text_attribute("face.why"), run.session->mesh().faces[1].why);
  int inside = 0;
  for (const float m : images[1].real.at("mask")) inside += m == 1;
  EXPECT_GT(inside, 500);
  EXPECT_LT(inside, 3000);
  for_each_inside(images[1], [&](int i, int j, Vec2 p) {
    ASSERT_NEAR(images[1].at("position.x", i, j), p.x(), single * 5);
    ASSERT_NEAR(images[1].at("size.h", i, j), 0.5, single);
  });
}

TEST(Fields, NeedNoMesh) {
  FieldCase run(testing::hemisphere());
  run.session->parameters().set("hphydef", 0.25);
  EXPECT_EQ(run.image(20, 20).at("size.h", 10, 10), 0.25F);
  EXPECT_FALSE(run.session->has_mesh());
  // For a host that answers in one half only, no values are invented in the other half.
  run.cad->size_on_surface = [](int, Vec2 p) { return p.x() < 0 ? std::optional<double>(0.1) : std::nullopt; };
  run.session->parameters().set("hphy_flag", 2);
  const ExrImage raw = run.image(40, 40);
  for_each_inside(raw, [&](int i, int j, Vec2 p) {
    if (p.x() < 0)
      ASSERT_EQ(raw.at("size.h", i, j), 0.1F);
    else
      ASSERT_TRUE(std::isnan(raw.at("size.h", i, j)));
  });
  // The mesher interpolates there.
  run.session->make_mesh();
  const ExrImage meshed = run.image(40, 40);
  for_each_inside(meshed, [&](int i, int j, Vec2) { ASSERT_GT(meshed.at("size.h", i, j), 0.05F); });
  EXPECT_TRUE(run.monitor.warnings.empty()) << run.monitor.warnings[0];
}

TEST(Fields, ContradictingParametersGiveNoSizes) {
  FieldCase run(testing::hemisphere());
  run.session->parameters().set("hphymin", 1.0);
  run.session->parameters().set("hphymax", 0.5);
  EXPECT_THROW(run.session->make_mesh(), InvalidArgument);
  const ExrImage image = run.image(10, 10);
  EXPECT_TRUE(std::isnan(image.at("size.h", 5, 5)));
  EXPECT_NEAR(image.at("position.z", 5, 5), 1, 0.1);
  ASSERT_EQ(run.monitor.warnings.size(), 1U);
  EXPECT_EQ(run.monitor.warnings[0].find("the fields have no sizes: hphymin and hphymax must be"), 0U);
}

}  // namespace
}  // namespace carreau
