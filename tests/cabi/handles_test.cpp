// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

TEST(Status, HasANameAndAMeaningForEachValue) {
  std::set<std::string> names;
  std::set<int> values;
#define CARREAU_TEST_ROW(symbol, value, meaning)        \
  EXPECT_STREQ(carreau_status_name(symbol), #symbol);   \
  EXPECT_STREQ(carreau_status_meaning(value), meaning); \
  names.insert(#symbol);                                \
  EXPECT_TRUE(values.insert(value).second);
  CARREAU_STATUS_TABLE(CARREAU_TEST_ROW)
#undef CARREAU_TEST_ROW
  EXPECT_EQ(names.size(), 13u);
  EXPECT_STREQ(carreau_status_name(12345), "CARREAU_UNKNOWN_STATUS");
  EXPECT_STREQ(carreau_status_meaning(-1), "unknown status");
}

// A binary that was built with an older header must keep its meaning.
TEST(Status, ValuesAreFixedForever) {
  EXPECT_EQ(CARREAU_OK, 0);
  EXPECT_EQ(CARREAU_ERR_ARGUMENT, 1);
  EXPECT_EQ(CARREAU_ERR_MODEL, 2);
  EXPECT_EQ(CARREAU_ERR_FILE, 3);
  EXPECT_EQ(CARREAU_ERR_CALLBACK, 4);
  EXPECT_EQ(CARREAU_ERR_DOMAIN, 5);
  EXPECT_EQ(CARREAU_ERR_LIMIT, 6);
  EXPECT_EQ(CARREAU_ERR_CANCELLED, 7);
  EXPECT_EQ(CARREAU_ERR_MEMORY, 8);
  EXPECT_EQ(CARREAU_ERR_SEQUENCE, 9);
  EXPECT_EQ(CARREAU_ERR_PARTIAL, 10);
  EXPECT_EQ(CARREAU_ERR_BUSY, 11);
  EXPECT_EQ(CARREAU_ERR_INTERNAL, 99);
}

TEST(Version, MatchesTheProject) {
  EXPECT_STREQ(carreau_version(), CARREAU_TEST_VERSION);
  int major = -1, minor = -1, patch = -1;
  ASSERT_EQ(std::sscanf(carreau_version(), "%d.%d.%d", &major, &minor, &patch), 3);
  EXPECT_EQ(carreau_version_number(), major * 10000 + minor * 100 + patch);
}

TEST(Handles, MayBeNull) {
  carreau_session_free(nullptr);
  carreau_mesh_free(nullptr);
  carreau_stop(nullptr);
  EXPECT_STREQ(carreau_last_error(nullptr), "");
  EXPECT_STREQ(carreau_mesh_last_error(nullptr), "");
  EXPECT_EQ(carreau_session_create(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_create(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_generate(nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_run_env(nullptr, "blsurf.env"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_read_env(nullptr, "blsurf.env"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_face(nullptr, 1, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_real(nullptr, "hphydef", 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_count(nullptr, nullptr, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_write(nullptr, "x.mesh"), CARREAU_ERR_ARGUMENT);
  auto place = sized<carreau_error_place>();
  EXPECT_EQ(carreau_last_error_place(nullptr, &place), CARREAU_ERR_ARGUMENT);
}

TEST_F(SessionTest, NullArgumentsHaveASentence) {
  EXPECT_EQ(carreau_set_real(session, nullptr, 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the argument name is NULL");
  EXPECT_EQ(carreau_set_cad(session, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the argument carreau_cad is NULL");
  EXPECT_EQ(carreau_model_read_pardom(session, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the argument path is NULL");
  EXPECT_EQ(carreau_get_text(session, "pref", nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the argument out_value is NULL");
}

TEST_F(SessionTest, TheSentenceBelongsToTheLastCall) {
  EXPECT_EQ(error(), "");
  EXPECT_EQ(carreau_set_integer(session, "frontel", 1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "there is no parameter 'frontel'; did you mean 'frontal'?");
  EXPECT_EQ(carreau_set_integer(session, "frontal", 1), CARREAU_OK);
  EXPECT_EQ(error(), "");
}

TEST_F(SessionTest, CallsOutOfOrderAreRejected) {
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(error(), "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
  EXPECT_EQ(carreau_run_env(session, "blsurf.env"), CARREAU_ERR_SEQUENCE);
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(error(), "the model has no face yet");
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(mesh, nullptr);
  auto result = sized<carreau_report>();
  EXPECT_EQ(carreau_session_report(session, &result), CARREAU_ERR_SEQUENCE);
  double value = -7;
  EXPECT_EQ(carreau_get_real(session, "hphydef", &value), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(error(), "the default of hphydef is relative to diag, which is known after the first mesh");
  EXPECT_EQ(value, -7);
}

// ---- structs that carry their size ----

TEST_F(SessionTest, StructsWithoutASizeAreRejected) {
  carreau_cad cad = paraboloid_cad(&host);
  cad.struct_size = 0;
  EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "carreau_cad->struct_size is 0, not sizeof(carreau_cad)");
  carreau_parameter info{};
  EXPECT_EQ(carreau_parameter_info(0, &info), CARREAU_ERR_ARGUMENT);
  cad.struct_size = std::size_t(-1);
  EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_ERR_ARGUMENT);
}

TEST_F(SessionTest, AStructOfAnOlderHeaderIsReadAsFarAsItGoes) {
  carreau_cad_m cad = paraboloid_cad_m();
  // An older header ended before the sizes: the library must not read the bytes behind.
  cad.struct_size = offsetof(carreau_cad_m, cad_hphys);
  cad.cad_hphys = reinterpret_cast<void (*)(const std::int32_t*, const double*, double*)>(0x1);
  ASSERT_EQ(carreau_set_cad_m(session, &cad), CARREAU_OK) << error();
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 2), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
}

TEST_F(SessionTest, AStructOfANewerHeaderIsAcceptedWhenItsNewMembersAreZero) {
  struct Newer {
    carreau_cad known;
    void* added;
  } newer{};
  newer.known = paraboloid_cad(&host);
  newer.known.struct_size = sizeof newer;
  EXPECT_EQ(carreau_set_cad(session, &newer.known), CARREAU_OK) << error();
  newer.added = &newer;
  EXPECT_EQ(carreau_set_cad(session, &newer.known), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "carreau_cad has members set that this version of the library does not know");
}

TEST(Structs, OlderOnesAreFilledAsFarAsTheyGo) {
  carreau_parameter info{};
  info.struct_size = offsetof(carreau_parameter, default_text);
  const char* untouched = "untouched";
  info.default_text = untouched;
  ASSERT_EQ(carreau_parameter_info(0, &info), CARREAU_OK);
  EXPECT_STREQ(info.name, "CheckAdjacentEdges");
  EXPECT_EQ(info.default_text, untouched);
  EXPECT_EQ(info.struct_size, offsetof(carreau_parameter, default_text));
}

TEST_F(SessionTest, GeometryThatLacksARoutineIsRejected) {
  carreau_cad_m cad_m = paraboloid_cad_m();
  cad_m.curv0 = nullptr;
  EXPECT_EQ(carreau_set_cad_m(session, &cad_m), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("curv0"), std::string::npos) << error();
  carreau_cad cad = paraboloid_cad(&host);
  cad.surface = nullptr;
  EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("surface"), std::string::npos) << error();
  cad = paraboloid_cad(&host);
  cad.surface_order = 3;
  EXPECT_EQ(carreau_set_cad(session, &cad), CARREAU_ERR_ARGUMENT);
}

// ---- parameters ----

TEST_F(SessionTest, ParametersAreListedSetAndReset) {
  ASSERT_GT(carreau_parameter_count(), 25);
  std::set<std::string> names;
  for (std::int32_t i = 0; i < carreau_parameter_count(); ++i) {
    auto info = sized<carreau_parameter>();
    ASSERT_EQ(carreau_parameter_info(i, &info), CARREAU_OK);
    SCOPED_TRACE(info.name);
    names.insert(info.name);
    EXPECT_GT(std::strlen(info.help), 10u);
    if (info.type == CARREAU_INTEGER) {
      std::int32_t value = -99;
      EXPECT_EQ(carreau_get_integer(session, info.name, &value), CARREAU_OK);
      EXPECT_EQ(value, info.default_number);
      EXPECT_LE(info.minimum, value);
      EXPECT_GE(info.maximum, value);
    } else if (info.type == CARREAU_REAL && info.diag_relative == 0) {
      double value = -99;
      EXPECT_EQ(carreau_get_real(session, info.name, &value), CARREAU_OK);
      EXPECT_EQ(value, info.default_number);
    } else if (info.type == CARREAU_TEXT) {
      const char* value = nullptr;
      EXPECT_EQ(carreau_get_text(session, info.name, &value), CARREAU_OK);
      EXPECT_STREQ(value, info.default_text);
    }
  }
  EXPECT_EQ(names.size(), std::size_t(carreau_parameter_count()));
  auto info = sized<carreau_parameter>();
  EXPECT_EQ(carreau_parameter_info(-1, &info), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_parameter_info(carreau_parameter_count(), &info), CARREAU_ERR_ARGUMENT);

  double real = 0;
  EXPECT_EQ(carreau_set_word(session, "hphydef", "1.5d-1"), CARREAU_OK);
  EXPECT_EQ(carreau_get_real(session, "hphydef", &real), CARREAU_OK);
  EXPECT_EQ(real, 0.15);
  EXPECT_EQ(carreau_reset_parameter(session, "hphydef"), CARREAU_OK);
  EXPECT_EQ(carreau_get_real(session, "hphydef", &real), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_set_text(session, "option", "smo3d"), CARREAU_OK);
  EXPECT_EQ(carreau_set_integer(session, "flag", 1), CARREAU_OK);
  EXPECT_EQ(carreau_reset_parameters(session), CARREAU_OK);
  std::int32_t flag = -1;
  EXPECT_EQ(carreau_get_integer(session, "flag", &flag), CARREAU_OK);
  EXPECT_EQ(flag, 0);
}

TEST_F(SessionTest, WrongParametersAreRejected) {
  EXPECT_EQ(carreau_set_real(session, "hphydef", -1), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "parameter hphydef must be greater than 0; -1 is not");
  EXPECT_EQ(carreau_set_real(session, "hphydef", std::nan("")), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_text(session, "hphydef", "1"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_word(session, "hphydef", "one"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "parameter hphydef is a number, not 'one'");
  std::int32_t value = 5;
  EXPECT_EQ(carreau_get_integer(session, "hphydef", &value), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(carreau_reset_parameter(session, "hphyd"), CARREAU_ERR_ARGUMENT);
}

// ---- model ----

TEST_F(SessionTest, TheModelIsReadBackAsItWasBuilt) {
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_point(session, 1, 77, 0.25, -0.5), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_check(session), CARREAU_OK) << error();
  std::int64_t faces = 0, curves = 0, points = 0;
  ASSERT_EQ(carreau_model_count(session, &faces, &curves, &points), CARREAU_OK);
  EXPECT_EQ(faces, 1);
  EXPECT_EQ(curves, 4);
  EXPECT_EQ(points, 1);
  std::int32_t ref = 0, orientation = 0, point_face = 0, point_ref = 0;
  EXPECT_EQ(carreau_model_faces(session, 1, &ref, &orientation), CARREAU_OK);
  EXPECT_EQ(ref, 1);
  EXPECT_EQ(orientation, 1);
  std::array<std::int32_t, 4> face_refs{}, types{}, refs{};
  std::array<std::int32_t, 8> ends{};
  EXPECT_EQ(carreau_model_curves(session, 4, face_refs.data(), types.data(), refs.data(), ends.data()), CARREAU_OK);
  EXPECT_EQ(face_refs, (std::array<std::int32_t, 4>{1, 1, 1, 1}));
  EXPECT_EQ(types, (std::array<std::int32_t, 4>{1, 1, 1, 1}));
  EXPECT_EQ(refs, (std::array<std::int32_t, 4>{1, 2, 3, 4}));
  EXPECT_EQ(ends, (std::array<std::int32_t, 8>{1, 2, 2, 3, 3, 4, 4, 1}));
  std::array<double, 2> uv{};
  EXPECT_EQ(carreau_model_points(session, 1, &point_face, &point_ref, uv.data()), CARREAU_OK);
  EXPECT_EQ(point_face, 1);
  EXPECT_EQ(point_ref, 77);
  EXPECT_EQ(uv, (std::array<double, 2>{0.25, -0.5}));
  EXPECT_EQ(carreau_model_curves(session, 3, face_refs.data(), nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the array has room for 3 rows, there are 4 curves");
}

TEST_F(SessionTest, AModelWrittenAsPardomIsReadBack) {
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_model_add_point(session, 1, 77, 0.1, -0.3), CARREAU_OK);
  const std::string path = testing::TempDir() + "carreau_abi.pardom";
  ASSERT_EQ(carreau_model_write_pardom(session, path.c_str()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  std::int64_t faces = -1;
  EXPECT_EQ(carreau_model_count(session, &faces, nullptr, nullptr), CARREAU_OK);
  EXPECT_EQ(faces, 0);
  ASSERT_EQ(carreau_model_read_pardom(session, path.c_str()), CARREAU_OK) << error();
  std::array<std::int32_t, 8> ends{};
  std::array<double, 2> uv{};
  EXPECT_EQ(carreau_model_curves(session, 4, nullptr, nullptr, nullptr, ends.data()), CARREAU_OK);
  EXPECT_EQ(ends, (std::array<std::int32_t, 8>{1, 2, 2, 3, 3, 4, 4, 1}));
  EXPECT_EQ(carreau_model_points(session, 1, nullptr, nullptr, uv.data()), CARREAU_OK);
  EXPECT_EQ(uv, (std::array<double, 2>{0.1, -0.3}));
  EXPECT_EQ(carreau_model_read_pardom(session, "/nonexistent/x.pardom"), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("/nonexistent/x.pardom"), std::string::npos) << error();
  EXPECT_EQ(carreau_model_count(session, &faces, nullptr, nullptr), CARREAU_OK);
  EXPECT_EQ(faces, 1);
  std::remove(path.c_str());
}

TEST_F(SessionTest, ModelsThatContradictThemselvesAreRejected) {
  EXPECT_EQ(carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, 1, 1, 2), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "the model has no face of reference 1: call carreau_model_add_face first");
  EXPECT_EQ(carreau_model_check(session), CARREAU_ERR_MODEL);
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  EXPECT_EQ(carreau_model_add_curve(session, 1, 3, 1, 1, 2), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_add_point(session, 1, 1, std::nan(""), 0), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_check(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_model_add_face(session, 1, 1), CARREAU_OK);  // the same reference twice
  EXPECT_EQ(carreau_model_check(session), CARREAU_ERR_MODEL);
  EXPECT_FALSE(error().empty());
}

}  // namespace
}  // namespace abi_tests
