// SPDX-License-Identifier: BSD-3-Clause
// libcarreau_cad as a program sees it: carreau_cad.h, and files that make_shapes makes (CARREAU_TEST_SHAPES).
#include <carreau_cad.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

const std::string& shapes() {
  static const std::string folder = [] {
    const std::string path = std::filesystem::temp_directory_path() / ("carreau_shapes_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    if (std::system((std::string("'") + CARREAU_TEST_SHAPES + "' '" + path + "' >/dev/null").c_str()) != 0)
      std::abort();
    return path;
  }();
  return folder;
}

class RemoveShapes : public testing::Environment {
 public:
  void TearDown() override { std::filesystem::remove_all(shapes()); }
};
[[maybe_unused]] const auto* const removed = testing::AddGlobalTestEnvironment(new RemoveShapes);

struct Session {
  Session() { carreau_session_create(&handle); }
  ~Session() { carreau_session_free(handle); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  operator carreau_session*() const { return handle; }  // NOLINT: as the C interface takes it
  carreau_session* handle = nullptr;
};

struct File {
  ~File() { carreau_cad_close(handle); }
  File() = default;
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  operator carreau_cad_file*() const { return handle; }  // NOLINT: as the C interface takes it
  carreau_cad_file* handle = nullptr;
};

template <typename Struct>
Struct empty() {
  Struct value{};
  value.struct_size = sizeof value;
  return value;
}

#define EXPECT_OK(handle, call) EXPECT_EQ(call, CARREAU_OK) << sentence(handle)
const char* sentence(const Session& session) { return carreau_last_error(session); }
const char* sentence(const File& file) { return carreau_cad_last_error(file); }

std::vector<double> triangles_of(carreau_session* session, std::int32_t first, std::int32_t last) {
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  std::int64_t n = 0, m = 0;
  carreau_mesh_count(mesh, &n, &m, nullptr, nullptr);
  std::vector<double> xyz(3 * n), points;
  std::vector<std::int32_t> vertices(3 * m), refs(m);
  carreau_mesh_vertices(mesh, n, xyz.data());
  carreau_mesh_triangles(mesh, m, vertices.data());
  carreau_mesh_triangle_refs(mesh, m, refs.data());
  for (std::int64_t t = 0; t < m; ++t)
    if (refs[t] >= first && refs[t] <= last)
      for (int k = 0; k < 9; ++k) points.push_back(xyz[3 * vertices[3 * t + k / 3] + k % 3]);
  return points;
}

carreau_quality mesh(const Session& session, double size, int threads = 1) {
  EXPECT_OK(session, carreau_set_real(session, "hphydef", size));
  EXPECT_OK(session, carreau_set_real(session, "hphymin", 1e-3 * size));
  EXPECT_OK(session, carreau_set_real(session, "hphymax", 10 * size));
  EXPECT_OK(session, carreau_set_integer(session, "threads", threads));
  EXPECT_OK(session, carreau_mesh_generate(session));
  carreau_mesh* made = nullptr;
  EXPECT_OK(session, carreau_session_mesh(session, &made));
  auto quality = empty<carreau_quality>();
  EXPECT_EQ(carreau_mesh_quality(made, &quality), CARREAU_OK);
  return quality;
}

carreau_geometry last_geometry(const Session& session) {
  std::int64_t count = 0;
  EXPECT_OK(session, carreau_geometry_count(session, &count));
  auto place = empty<carreau_geometry>();
  EXPECT_OK(session, carreau_geometry_info(session, count - 1, &place));
  return place;
}

TEST(CadLibrary, MeshesAnInchCube) {
  Session session;
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/inch.step").c_str(), nullptr, nullptr));
  const carreau_quality quality = mesh(session, 5);
  EXPECT_NEAR(quality.area, 6 * 25.4 * 25.4, 1e-9);
  EXPECT_EQ(quality.open_edges, 0);
}

TEST(CadLibrary, SetsTheToleranceOfSharedEdges) {
  const std::string path = shapes() + "/inch.step";
  Session by_file, by_caller;
  File file;
  EXPECT_OK(by_file, carreau_cad_open(by_file, path.c_str(), nullptr, &file.handle));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  double match = 0;
  EXPECT_OK(by_file, carreau_get_real(by_file, "eps_match", &match));
  EXPECT_GT(match, 0);
  EXPECT_EQ(match, content.match_tolerance);
  EXPECT_OK(by_caller, carreau_set_real(by_caller, "eps_match", 0.5));
  EXPECT_OK(by_caller, carreau_cad_open(by_caller, path.c_str(), nullptr, nullptr));
  EXPECT_OK(by_caller, carreau_get_real(by_caller, "eps_match", &match));
  EXPECT_EQ(match, 0.5);
}

TEST(CadLibrary, ListsTheContentOfAFile) {
  Session session;
  File file;
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/named_faces.step").c_str(), nullptr, &file.handle));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  EXPECT_EQ(content.faces, 6);
  EXPECT_EQ(content.edges, 12);
  EXPECT_EQ(content.vertices, 8);
  EXPECT_EQ(content.closed, 1);
  EXPECT_STREQ(content.unit, "mm");
  EXPECT_EQ(content.losses, 0);
  EXPECT_EQ(carreau_cad_loss(file, 0), nullptr);
  int tops = 0, green = 0;
  double area = 0;
  for (std::int32_t f = 1; f <= 6; ++f) {
    auto face = empty<carreau_cad_face>();
    EXPECT_OK(file, carreau_cad_file_face(file, f, &face));
    tops += std::string(face.name) == "top" ? 1 : 0;
    green += face.rgb == 0x40A030 ? 1 : 0;
    EXPECT_STREQ(face.why, "");
    auto figures = empty<carreau_cad_figures>();
    EXPECT_OK(file, carreau_cad_measure_face(file, f, &figures));
    EXPECT_STREQ(figures.kind, "plane");
    area += figures.area;
  }
  EXPECT_EQ(tops, 1);
  EXPECT_EQ(green, 5);  // the box is green, its top orange
  auto report = empty<carreau_cad_report>();
  EXPECT_OK(file, carreau_cad_inspect(file, 0, &report));
  EXPECT_NEAR(area, report.area, 1e-9 * area);
  EXPECT_EQ(report.kinds, 1);
  const char* kind = "";
  std::int32_t count = 0;
  EXPECT_OK(file, carreau_cad_surfaces(file, 0, &kind, &count));
  EXPECT_STREQ(kind, "plane");
  EXPECT_EQ(count, 6);
  EXPECT_EQ(carreau_cad_danger_at(file, report.dangers, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_file_face(file, 7, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(std::string(sentence(file)).find("face 7"), std::string::npos);
}

// press.step: a plate with two stamps on it, and names, layers and automatic names ("#197") in the file.
TEST(CadLibrary, ListsNamesLayersAndTheTree) {
  Session session;
  File file;
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/press.step").c_str(), nullptr, &file.handle));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  std::vector<std::string> rows;
  for (std::int32_t i = 0; i < content.tree_rows; ++i) {
    auto row = empty<carreau_cad_tree_row>();
    EXPECT_OK(file, carreau_cad_tree_at(file, i, &row));
    EXPECT_EQ(std::string(row.name).find('#'), std::string::npos);
    EXPECT_EQ(std::string(row.layer), row.kind == std::string("part") ? (row.name == std::string("plate") ? "walls" : "tools") : "");
    rows.push_back(std::string(static_cast<std::size_t>(row.depth), ' ') + row.kind + " " + row.name);
  }
  EXPECT_EQ(rows, (std::vector<std::string>{"assembly press", " part plate", "  solid plate", "   face contact", "   edge rim", "   vertex corner",
                                            " part stamp", "  solid stamp", " part stamp", "  solid stamp_2"}));
  EXPECT_EQ(carreau_cad_tree_at(file, content.tree_rows, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_tree_at(file, -1, nullptr), CARREAU_ERR_ARGUMENT);
  int rims = 0, corners = 0, contacts = 0, walls = 0;
  for (std::int32_t k = 1; k <= content.edges; ++k) rims += carreau_cad_entity_name(file, 1, k) == std::string("rim") ? 1 : 0;
  for (std::int32_t k = 1; k <= content.vertices; ++k) corners += carreau_cad_entity_name(file, 0, k) == std::string("corner") ? 1 : 0;
  for (std::int32_t k = 1; k <= content.faces; ++k) {
    auto face = empty<carreau_cad_face>();
    EXPECT_OK(file, carreau_cad_file_face(file, k, &face));
    contacts += face.name == std::string("contact") ? 1 : 0;
    walls += face.layer == std::string("walls") ? 1 : 0;
    EXPECT_STREQ(carreau_cad_entity_name(file, 2, k), face.name);
  }
  EXPECT_EQ((std::array{rims, corners, contacts, walls}), (std::array{1, 1, 1, 6}));
  EXPECT_STREQ(carreau_cad_entity_name(file, 3, 3), "stamp_2");
  for (const auto& [dimension, number] : {std::pair{3, 4}, {3, 0}, {2, 99}, {1, 99}, {0, 0}, {4, 1}, {-1, 1}})
    EXPECT_STREQ(carreau_cad_entity_name(file, dimension, number), "");
  EXPECT_OK(session, carreau_set_real(session, "hphydef", 0.5));
  EXPECT_OK(session, carreau_mesh_generate(session));
  carreau_mesh* made = nullptr;
  EXPECT_OK(session, carreau_session_mesh(session, &made));
  int named = 0;
  for (std::int32_t k = 1; k <= content.edges; ++k) named += carreau_mesh_entity_name(made, 1, k) == std::string("rim") ? 1 : 0;
  EXPECT_EQ(named, 1);
}

TEST(CadLibrary, MeasuresContacts) {
  Session session;
  File file;
  EXPECT_EQ(carreau_cad_count_contacts(nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/press.step").c_str(), nullptr, &file.handle));
  std::int64_t count = 0;
  EXPECT_OK(file, carreau_cad_count_contacts(file, &count));
  ASSERT_EQ(count, 2);
  EXPECT_EQ(carreau_cad_count_contacts(file, nullptr), CARREAU_ERR_ARGUMENT);
  for (std::int32_t i = 0; i < 2; ++i) {
    auto contact = empty<carreau_cad_contact>();
    EXPECT_OK(file, carreau_cad_contact_at(file, i, &contact));
    EXPECT_EQ((std::array{contact.solids[0], contact.solids[1], contact.pairs}), (std::array<std::int32_t, 3>{1, 2 + i, 1}));
    EXPECT_NEAR(contact.area, 1, 1e-9);
    EXPECT_NEAR(contact.place[2], 1, 1e-9);
  }
  EXPECT_EQ(carreau_cad_contact_at(file, 2, nullptr), CARREAU_ERR_ARGUMENT);
  auto report = empty<carreau_cad_report>();
  EXPECT_OK(file, carreau_cad_inspect(file, 0, &report));
  int touching = 0;
  for (std::int32_t i = 0; i < report.dangers; ++i) {
    auto danger = empty<carreau_cad_danger>();
    EXPECT_OK(file, carreau_cad_danger_at(file, i, &danger));
    if (danger.kind != std::string("touching solids")) continue;
    ++touching;
    EXPECT_NEAR(danger.value, 1, 1e-9);
    EXPECT_NE(std::string(danger.sentence).find("common area 1"), std::string::npos);
  }
  EXPECT_EQ(touching, 2);
  EXPECT_OK(file, carreau_cad_imprint(file, 0, nullptr, nullptr));
  EXPECT_OK(file, carreau_cad_count_contacts(file, &count));
  EXPECT_EQ(count, 0);
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  EXPECT_EQ(content.shared_faces, 2);
  int rims = 0;
  for (std::int32_t k = 1; k <= content.edges; ++k) rims += carreau_cad_entity_name(file, 1, k) == std::string("rim") ? 1 : 0;
  EXPECT_EQ(rims, 1);  // names of edges follow
}

std::string bytes_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(CadLibrary, ReadsBytes) {
  const std::string bytes = bytes_of_file(shapes() + "/inch.step");
  const auto size = static_cast<std::int64_t>(bytes.size());
  auto options = empty<carreau_cad_options>();
  options.unit = "in", options.scale = 3;
  Session session;
  EXPECT_OK(session, carreau_cad_open_bytes(session, bytes.data(), size, "step", &options, nullptr));
  EXPECT_NEAR(mesh(session, 0.5).area, 6 * 3 * 3, 1e-9);
  File file;
  EXPECT_EQ(carreau_cad_create(&file.handle), CARREAU_OK);
  EXPECT_OK(file, carreau_cad_read_bytes(file, bytes.data(), size, nullptr, nullptr));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  EXPECT_EQ(content.faces, 6);
  EXPECT_EQ(content.solids, 1);
  EXPECT_STREQ(content.unit, "mm");
  EXPECT_STREQ(content.file_unit, "in");
  EXPECT_EQ(carreau_cad_read_bytes(file, bytes.data(), size, "iges", nullptr), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_cad_read_bytes(file, bytes.data(), -1, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_read_bytes(file, nullptr, 0, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  options.scale = -1;
  EXPECT_EQ(carreau_cad_read_bytes(file, bytes.data(), size, nullptr, &options), CARREAU_ERR_ARGUMENT);
}

// A cube beside a plane gets its image; both together are symmetric, so that a second call changes nothing.
TEST(CadLibrary, MirrorsBodies) {
  File file;
  EXPECT_EQ(carreau_cad_create(&file.handle), CARREAU_OK);
  const std::array<double, 3> point{-100, 0, 0}, normal{2, 0, 0}, none{0, 0, 0}, off{-99, 0, 0};
  EXPECT_EQ(carreau_cad_mirror(file, point.data(), normal.data()), CARREAU_ERR_ARGUMENT);  // nothing was read
  EXPECT_OK(file, carreau_cad_read(file, (shapes() + "/inch.step").c_str(), nullptr));
  EXPECT_EQ(carreau_cad_mirror(file, point.data(), none.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_mirror(file, nullptr, normal.data()), CARREAU_ERR_ARGUMENT);
  for (int call = 0; call < 2; ++call) {
    EXPECT_OK(file, carreau_cad_mirror(file, point.data(), normal.data()));
    auto content = empty<carreau_cad_content>();
    EXPECT_OK(file, carreau_cad_info(file, &content));
    EXPECT_EQ(content.faces, 12);
    EXPECT_EQ(content.solids, 2);
    EXPECT_EQ(content.closed, 1);
  }
  EXPECT_EQ(carreau_cad_mirror(file, off.data(), normal.data()), CARREAU_ERR_FILE);
  EXPECT_NE(std::string(carreau_cad_last_error(file)).find("the image of face"), std::string::npos);
}

// A cube of side 2 on a plate of 4 x 4 x 1: named, then with one face between them, which has its own size.
TEST(CadLibrary, NamesAndImprintsParts) {
  File file;
  EXPECT_EQ(carreau_cad_create(&file.handle), CARREAU_OK);
  EXPECT_OK(file, carreau_cad_read(file, (shapes() + "/touching.brep").c_str(), nullptr));
  const std::array<const char*, 2> names{"part", "part"};
  const std::array<std::int32_t, 2> colours{0xFF0000, -1};
  EXPECT_EQ(carreau_cad_name_solids(file, 1, names.data(), nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_OK(file, carreau_cad_name_solids(file, 2, names.data(), colours.data()));
  EXPECT_EQ(carreau_cad_imprint(file, -1, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  const carreau_cad_progress_fn stop = [](double, void*) -> std::int32_t { return 1; };
  EXPECT_EQ(carreau_cad_imprint(file, 0, stop, nullptr), CARREAU_ERR_CANCELLED);
  EXPECT_OK(file, carreau_cad_imprint(file, 0, nullptr, nullptr));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  EXPECT_EQ(content.shared_faces, 1);
  EXPECT_EQ(content.closed, 1);
  std::int32_t shared = 0;
  for (std::int32_t f = 1; f <= content.faces; ++f) {
    auto face = empty<carreau_cad_face>();
    EXPECT_OK(file, carreau_cad_file_face(file, f, &face));
    if (face.other_solid == 0) continue;
    shared = f;
    EXPECT_STREQ(face.solid_name, "part");
    EXPECT_STREQ(face.other_solid_name, "part_2");  // distinct
    EXPECT_EQ(face.rgb, 0xFF0000);
  }
  EXPECT_OK(file, carreau_cad_set_size(file, 2, shared, 0.1));
  EXPECT_EQ(carreau_cad_set_size(file, 3, 3, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_set_size(file, 4, 1, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_set_size(file, 1, 1, 0), CARREAU_ERR_ARGUMENT);
  Session session;
  EXPECT_OK(session, carreau_cad_add(file, session));
  EXPECT_OK(session, carreau_set_integer(session, "hphy_flag", 2));
  EXPECT_NEAR(mesh(session, 0.5).area, 2 * 16 + 4 * 4 + 5 * 4, 1e-9);
  carreau_mesh* made = nullptr;
  EXPECT_OK(session, carreau_session_mesh(session, &made));
  std::array<std::int32_t, 2> sides{};
  EXPECT_EQ(carreau_mesh_face_sides(made, shared, sides.data()), CARREAU_OK);
  EXPECT_EQ(sides, (std::array<std::int32_t, 2>{1, 2}));
  EXPECT_STREQ(carreau_mesh_entity_name(made, 3, 2), "part_2");
  // 4 of about 800 triangles of edge .1 in a square of side 2
  const auto on_shared = static_cast<double>(triangles_of(session, shared, shared).size() / 9);
  EXPECT_NEAR(on_shared * 0.1 * 0.1 * std::sqrt(3) / 4, 4, 1);
}

TEST(CadLibrary, SmallFeaturesAreListed) {
  auto options = empty<carreau_cad_options>();
  options.min_feature = 1000;
  File file;
  EXPECT_EQ(carreau_cad_create(&file.handle), CARREAU_OK);
  EXPECT_OK(file, carreau_cad_read(file, (shapes() + "/bracket.step").c_str(), &options));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  EXPECT_GT(content.small_features, 0);
  for (std::int32_t i = 0; i < content.small_features; ++i) {
    auto feature = empty<carreau_cad_small_feature>();
    EXPECT_OK(file, carreau_cad_small_feature_at(file, i, &feature));
    EXPECT_GT(feature.size, 0);
    EXPECT_STRNE(feature.faces, "");
  }
  EXPECT_EQ(carreau_cad_small_feature_at(file, content.small_features, nullptr), CARREAU_ERR_ARGUMENT);
  options.min_feature = -1;
  EXPECT_EQ(carreau_cad_read(file, (shapes() + "/bracket.step").c_str(), &options), CARREAU_ERR_ARGUMENT);
}

TEST(CadLibrary, PutsPointsOnCurves) {
  File file;
  EXPECT_EQ(carreau_cad_create(&file.handle), CARREAU_OK);
  EXPECT_OK(file, carreau_cad_read(file, (shapes() + "/plate.step").c_str(), nullptr));
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  // Each edge has one end at each of its faces' curves: places of two faces on one edge agree within tolerances.
  std::vector<std::vector<std::array<double, 3>>> middles(content.edges + 1);
  for (std::int32_t f = 1; f <= content.faces; ++f) {
    std::int64_t n = 0;
    EXPECT_OK(file, carreau_cad_curves(file, f, 0, nullptr, &n));
    std::vector<std::int32_t> edges(n);
    EXPECT_OK(file, carreau_cad_curves(file, f, n, edges.data(), nullptr));
    for (std::int32_t ic = 1; ic <= n; ++ic) {
      std::array<double, 2> uv{};
      std::array<double, 3> p{};
      EXPECT_EQ(carreau_cad_curve_point(file, f, ic, 0.5, uv.data()), CARREAU_OK);
      EXPECT_EQ(carreau_cad_point(file, f, uv[0], uv[1], p.data(), nullptr), CARREAU_OK);
      middles[edges[ic - 1]].push_back(p);
      EXPECT_EQ(carreau_cad_whole_edge(file, edges[ic - 1]), edges[ic - 1]);
    }
    EXPECT_EQ(carreau_cad_whole_face(file, f), f);
    std::int64_t parts = 0;
    std::int32_t part = 0;
    EXPECT_OK(file, carreau_cad_parts(file, f, 1, &part, &parts));
    EXPECT_EQ(parts, 1);  // a face that is not cut is its only part
    EXPECT_EQ(part, f);
  }
  auto gaps = empty<carreau_cad_gaps>();
  EXPECT_OK(file, carreau_cad_measure_gaps(file, &gaps));
  EXPECT_EQ(gaps.beyond, 0);
  int shared = 0;
  double apart = 0;
  for (const auto& places : middles)
    if (places.size() == 2) {
      ++shared;
      for (int x = 0; x < 3; ++x) EXPECT_NEAR(places[0][x], places[1][x], 1e-5);
      apart = std::max(apart, std::hypot(places[0][0] - places[1][0], places[0][1] - places[1][1], places[0][2] - places[1][2]));
    }
  EXPECT_LE(apart, gaps.largest + 1e-5);
  EXPECT_GT(shared, 8);
}

TEST(CadLibrary, LeavesTheSessionAloneWhenAFileCannotBeRead) {
  Session session;
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/inch.step").c_str(), nullptr, nullptr));
  const std::string broken = shapes() + "/broken.step";
  std::ofstream(broken) << "ISO-10303-21;\nHEADER;\nnothing";
  File file;
  for (const std::string& path : {shapes() + "/none.step", broken, shapes()}) {
    const carreau_status status = carreau_cad_open(session, path.c_str(), nullptr, &file.handle);
    EXPECT_EQ(status, CARREAU_ERR_FILE);
    EXPECT_NE(std::string(carreau_last_error(session)).find(path), std::string::npos) << carreau_last_error(session);
    EXPECT_EQ(file.handle, nullptr);
  }
  EXPECT_EQ(carreau_cad_open(session, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_open(nullptr, "x.step", nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  std::int64_t geometries = 0, faces = 0;
  EXPECT_OK(session, carreau_geometry_count(session, &geometries));
  EXPECT_OK(session, carreau_model_count(session, &faces, nullptr, nullptr));
  EXPECT_EQ(geometries, 1);
  EXPECT_EQ(faces, 6);
  EXPECT_EQ(mesh(session, 10).open_edges, 0);
}

TEST(CadLibrary, StopsOnRequest) {
  Session session;
  auto options = empty<carreau_cad_options>();
  int calls = 0;
  options.user = &calls;
  options.progress = [](double, void* user) { return std::int32_t{++*static_cast<int*>(user) > 0}; };
  EXPECT_EQ(carreau_cad_open(session, (shapes() + "/assembly.step").c_str(), &options, nullptr), CARREAU_ERR_CANCELLED);
  EXPECT_EQ(calls, 1);
  options.struct_size = 3;
  EXPECT_EQ(carreau_cad_open(session, (shapes() + "/assembly.step").c_str(), &options, nullptr), CARREAU_ERR_ARGUMENT);
}

TEST(CadLibrary, AFileMayBeClosedBeforeItIsMeshed) {
  Session kept, closed;
  File file;
  const std::string path = shapes() + "/assembly.step";
  EXPECT_OK(kept, carreau_cad_open(kept, path.c_str(), nullptr, &file.handle));
  EXPECT_OK(closed, carreau_cad_open(closed, path.c_str(), nullptr, nullptr));
  mesh(kept, 2), mesh(closed, 2);
  EXPECT_EQ(triangles_of(kept, 1, 1000), triangles_of(closed, 1, 1000));
}

TEST(CadLibrary, FacesHaveSizesOfTheirOwn) {
  Session session;
  File file;
  EXPECT_OK(session, carreau_cad_open(session, (shapes() + "/named_faces.step").c_str(), nullptr, &file.handle));
  EXPECT_EQ(carreau_cad_set_face_size(file, "lid", 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_cad_set_face_size(file, "top", -1), CARREAU_ERR_ARGUMENT);
  auto content = empty<carreau_cad_content>();
  EXPECT_OK(file, carreau_cad_info(file, &content));
  const carreau_quality coarse = mesh(session, content.diagonal / 10);
  EXPECT_OK(file, carreau_cad_set_face_size(file, "top", content.diagonal / 50));
  EXPECT_OK(session, carreau_model_clear(session));
  EXPECT_EQ(carreau_cad_add(file, session), CARREAU_OK);
  EXPECT_OK(session, carreau_set_integer(session, "hphy_flag", 2));
  EXPECT_GT(mesh(session, content.diagonal / 10).triangles, 2 * coarse.triangles);
}

// A molecule, a Bezier patch, a face of callbacks and two STEP files: each mesh is identical to its mesh in a separate
// session.
struct Plate {
  double shift = 0;
};
std::int32_t plate(std::int32_t, double u, double v, std::int32_t, double* S, double* Su, double* Sv, double* Suu,
                   double* Suv, double* Svv, void* user) {
  S[0] = static_cast<const Plate*>(user)->shift + 20 * u, S[1] = 20 * v, S[2] = 4 * u * v;
  Su[0] = Sv[1] = 20, Su[1] = Sv[0] = 0, Su[2] = 4 * v, Sv[2] = 4 * u, Suv[2] = 4;
  for (int i = 0; i < 3; ++i) Suu[i] = Svv[i] = 0;
  Suv[0] = Suv[1] = 0;
  return 0;
}
std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void*) { return *a = 0, *b = 1, 0; }
std::int32_t side(std::int32_t, std::int32_t ic, double t, std::int32_t, double* C, double* Ct, double* Ctt, void*) {
  constexpr double at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int i = 0; i < 2; ++i)
    C[i] = (1 - t) * at[ic - 1][i] + t * at[ic][i], Ct[i] = at[ic][i] - at[ic - 1][i], Ctt[i] = 0;
  return 0;
}

class Mixed : public testing::Test {
 protected:
  static constexpr int kinds = 5;

  void add(const Session& session, int kind) {
    if (kind == 0) add_molecule(session);
    if (kind == 1) add_bezier(session);
    if (kind == 2) add_plate(session);
    if (kind < 3) return;
    const std::string path = shapes() + (kind == 3 ? "/assembly.step" : "/prism.brep");
    EXPECT_OK(session, carreau_cad_open(session, path.c_str(), nullptr, nullptr));
  }

 private:
  static void add_molecule(const Session& session) {
    auto options = empty<carreau_molecule_options>();
    options.surface = CARREAU_SES, options.probe = 4;
    const std::array<double, 9> centers{-500, 0, 0, -495, 1, 0, -497, 5, 2};
    const std::array<double, 3> radii{4, 5, 4.5};
    EXPECT_OK(session, carreau_add_molecule(session, &options, 3, centers.data(), radii.data()));
  }
  static void add_bezier(const Session& session) {
    const std::array<std::int32_t, 2> degrees{2, 2};
    std::vector<double> controls;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        controls.insert(controls.end(), {-900.0 + 10 * i, 10.0 * j, i == 1 && j == 1 ? 20.0 : 0});
    auto bezier = empty<carreau_bezier>();
    bezier.patch_count = 1, bezier.degrees = degrees.data(), bezier.controls = controls.data();
    EXPECT_OK(session, carreau_add_bezier(session, &bezier));
  }
  void add_plate(const Session& session) {
    auto cad = empty<carreau_cad>();
    cad.user = &plate_, cad.surface_order = cad.curve_order = 2;
    cad.surface = plate, cad.curve_interval = interval, cad.curve = side;
    EXPECT_OK(session, carreau_geometry_begin(session, &cad));
    EXPECT_OK(session, carreau_model_add_face(session, 1, 1));
    for (int k = 1; k <= 4; ++k)
      EXPECT_OK(session, carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, k, k, k % 4 + 1));
    EXPECT_OK(session, carreau_geometry_end(session));
  }

  Plate plate_{.shift = 500};
};

TEST_F(Mixed, GeometriesHaveTheMeshesThatTheyHaveAlone) {
  std::array<std::vector<double>, kinds> alone;
  for (int kind = 0; kind < kinds; ++kind) {
    Session session;
    add(session, kind);
    mesh(session, 2);
    alone[kind] = triangles_of(session, 1, 1000000);
    EXPECT_FALSE(alone[kind].empty());
  }
  for (const int threads : {1, 2, 4}) {
    Session all;
    std::array<carreau_geometry, kinds> places{};
    for (int kind = 0; kind < kinds; ++kind) add(all, kind), places[kind] = last_geometry(all);
    mesh(all, 2, threads);
    for (int kind = 0; kind < kinds; ++kind) {
      EXPECT_EQ(triangles_of(all, places[kind].first_face, places[kind].last_face), alone[kind]) << "geometry " << kind;
      EXPECT_EQ(places[kind].first_face, kind > 0 ? places[kind - 1].last_face + 1 : 1);
    }
  }
}

}  // namespace
