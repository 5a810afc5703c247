// SPDX-License-Identifier: BSD-3-Clause
// carreau_write_exr, read back with OpenEXR.
#include <filesystem>
#include <random>

#include "abi_fixture.h"
#include "common/exr_image.h"

namespace abi_tests {
namespace {

using carreau::testing::ExrImage;
using carreau::testing::read_exr;

class FieldsTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    folder = std::filesystem::temp_directory_path() / ("carreau abi fields " + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override {
    SessionTest::TearDown();
    std::filesystem::remove_all(folder);
  }
  [[nodiscard]] std::string file(const char* name) const { return (folder / name).string(); }
  static carreau_exr_options options(std::int32_t width, std::int32_t height) {
    auto result = sized<carreau_exr_options>();
    result.width = width, result.height = height;
    return result;
  }

  std::filesystem::path folder;
};

TEST_F(FieldsTest, HoldEveryChannelOfTheMesh) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  carreau_exr_options usual = options(0, 0);
  usual.channels = CARREAU_EXR_MASK;
  ASSERT_EQ(carreau_write_exr(session, file("x.exr").c_str(), &usual), CARREAU_OK) << error();
  const ExrImage mask = read_exr(file("x.face.1.exr")).at(0);
  EXPECT_EQ(mask.width, 1024);
  EXPECT_EQ(mask.height, 1024);
  EXPECT_EQ(mask.real.size(), 1U);

  carreau_exr_options small = options(20, 30);
  small.face = 1;
  small.compression = CARREAU_EXR_PIZ;
  small.threads = 2;
  ASSERT_EQ(carreau_write_exr(session, file("y.exr").c_str(), &small), CARREAU_OK) << error();
  const ExrImage image = read_exr(file("y.exr")).at(0);
  EXPECT_EQ(image.header.compression(), Imf::PIZ_COMPRESSION);
  EXPECT_EQ(image.real.size() + image.integer.size(), 35U);
  EXPECT_EQ(image.width, 20);
  EXPECT_EQ(image.height, 30);
  EXPECT_EQ(image.text_attribute("carreau.version"), carreau_version());
  EXPECT_EQ(image.real_attribute("diag"), report().diag);
  // The triangle of the pixel at u = v = 0+, in the numbers of carreau_mesh_triangles.
  const MeshData data = data_of(mesh());
  const std::uint32_t t = image.integer.at("triangle").at(20 * 14 + 10);
  ASSERT_LT(t, data.triangle_count());
  const double u = 2.5 / 20, v = 2.5 / 30;
  for (int i = 0; i < 3; ++i) {
    const double* p = &data.uv[6 * t + 2 * i];
    const double* q = &data.uv[6 * t + 2 * ((i + 1) % 3)];
    EXPECT_GE((q[0] - p[0]) * (v - p[1]) - (q[1] - p[1]) * (u - p[0]), 0);
  }
  EXPECT_NEAR(image.at("position.z", 10, 14), (u * u + v * v) / 2, 1e-7);
}

TEST_F(FieldsTest, HoldTheRequestedChannelsOnly) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const std::int64_t before = host.calls;
  carreau_exr_options few = options(8, 8);
  few.channels = CARREAU_EXR_MASK | CARREAU_EXR_TARGET;
  few.multi_part = 1;
  ASSERT_EQ(carreau_write_exr(session, file("x.exr").c_str(), &few), CARREAU_OK) << error();
  const ExrImage image = read_exr(file("x.exr")).at(0);
  EXPECT_EQ(image.real.size(), 4U);
  EXPECT_GT(image.at("target.m11", 4, 4), 3.9);
  EXPECT_EQ(host.calls, before);  // the control space knows
}

TEST_F(FieldsTest, ThatCannotBeWrittenLoseNoMesh) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData before = data_of(mesh());
  EXPECT_EQ(carreau_write_exr(session, file("none/x.exr").c_str(), nullptr), CARREAU_ERR_FILE);
  EXPECT_EQ(error(), "cannot write '" + file("none/x.face.1.exr") + "': No such file or directory");
  EXPECT_EQ(carreau_write_exr(session, file("x.tif").c_str(), nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_write(mesh(), file("none/x.exr").c_str()), CARREAU_ERR_FILE);
  EXPECT_TRUE(data_of(mesh()) == before);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(FieldsTest, OptionsThatCannotBeAreRejected) {
  use_paraboloid(0.5);
  const std::string path = file("x.exr");
  const auto refused = [&](auto change) {
    auto bad = options(8, 8);
    change(bad);
    EXPECT_EQ(carreau_write_exr(session, path.c_str(), &bad), CARREAU_ERR_ARGUMENT);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    return error();
  };
  EXPECT_EQ(refused([](auto& o) { o.raw = 2; }), "options->raw is 2, not 0 or 1");
  EXPECT_EQ(refused([](auto& o) { o.compression = 7; }), "options->compression is 7, not 0 or 1");
  EXPECT_EQ(refused([](auto& o) { o.reserved = 1; }), "options->reserved is not 0");
  EXPECT_EQ(refused([](auto& o) { o.width = -8; }), "the width of an image is -8 pixels; it must be from 1 to 65536");
  EXPECT_EQ(refused([](auto& o) { o.height = 0; }), "the height of an image is 0 pixels; it must be from 1 to 65536");
  EXPECT_EQ(refused([](auto& o) { o.channels = -1; }),
            "the groups of channels are 4294967295, which is not from 1 to 2047");
  EXPECT_EQ(refused([](auto& o) { o.threads = -1; }), "the number of threads is -1; it must be at least 1");
  EXPECT_EQ(refused([](auto& o) { o.face = 3; }),
            "there is no face of the reference 3, whose fields are to be written");
  EXPECT_EQ(carreau_write_exr(session, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_write_exr(nullptr, path.c_str(), nullptr), CARREAU_ERR_ARGUMENT);
}

TEST_F(FieldsTest, NeedAGeometryAndAModel) {
  EXPECT_EQ(carreau_write_exr(session, file("x.exr").c_str(), nullptr), CARREAU_ERR_SEQUENCE);
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  EXPECT_EQ(carreau_write_exr(session, file("x.exr").c_str(), nullptr), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(error(), "the model has no face yet");
}

// The case of the owner of a failed patch: a host that goes wrong from some call on.
TEST_F(FieldsTest, AFailedRunShowsTheHostsAnswers) {
  use_paraboloid(0.5);
  host.misbehaviour = HOST_NAN;
  host.misbehave_from = 20;
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK);
  const carreau_exr_options small = options(10, 10);
  ASSERT_EQ(carreau_write_exr(session, file("x.exr").c_str(), &small), CARREAU_OK) << error();
  const ExrImage broken = read_exr(file("x.face.1.exr")).at(0);
  EXPECT_TRUE(std::isnan(broken.at("position.x", 5, 5)));
  EXPECT_EQ(broken.at("mask", 5, 5), 1);
  EXPECT_EQ(broken.text_attribute("face.status"), "not meshed");
  // The same patch, repaired, without a run.
  host.misbehaviour = HOST_FINE;
  ASSERT_EQ(carreau_write_exr(session, file("x.exr").c_str(), &small), CARREAU_OK) << error();
  const ExrImage mended = read_exr(file("x.face.1.exr")).at(0);
  EXPECT_NEAR(mended.at("position.x", 5, 5), 0.25, 1e-7);
  EXPECT_NEAR(mended.at("curvature.k1", 5, 5), 1 / std::sqrt(1 + 2 * 0.25 * 0.25), 1e-6);
  EXPECT_EQ(mended.integer.at("triangle").at(55), 0xFFFFFFFFU);
}

TEST_F(FieldsTest, StopOnRequest) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const auto stop = [](std::int32_t phase, std::int32_t face, double fraction, void*) -> std::int32_t {
    EXPECT_TRUE(face == 1 || phase != CARREAU_PHASE_WRITING);
    return phase == CARREAU_PHASE_WRITING && fraction > 0.5 ? 1 : 0;
  };
  ASSERT_EQ(carreau_set_progress_callback(session, stop, nullptr), CARREAU_OK);
  const carreau_exr_options small = options(50, 100);
  EXPECT_EQ(carreau_write_exr(session, file("x.exr").c_str(), &small), CARREAU_ERR_CANCELLED);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace abi_tests
