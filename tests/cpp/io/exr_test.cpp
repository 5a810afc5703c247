// SPDX-License-Identifier: BSD-3-Clause
#include "io/exr.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <set>
#include <thread>

#include "common/exr_image.h"
#include "io/files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

using testing::ExrImage;
using testing::read_exr;

// Values that only this pixel has; all kinds of numbers among them.
float real_at(int column, int row) {
  switch ((column * 7 + row * 13) % 11) {
    case 0:
      return std::numeric_limits<float>::quiet_NaN();
    case 1:
      return -std::numeric_limits<float>::infinity();
    case 2:
      return std::numeric_limits<float>::denorm_min();
    case 3:
      return -0.0F;
    default:
      return std::sin(static_cast<float>(column)) * std::exp(static_cast<float>(row % 60) - 30);
  }
}
std::uint32_t integer_at(int column, int row) {
  return 0xFFFFFFFFU - static_cast<std::uint32_t>(column) * 2654435761U - static_cast<std::uint32_t>(row);
}
float half_at(int column, int row) { return static_cast<float>((column * 31 + row) % 257) / 256; }

ExrPart part_of(const std::string& name, int width, int height) {
  return {.name = name,
          .width = width,
          .height = height,
          .channels = {{"size.h"}, {"triangle", ExrType::integer}, {"R", ExrType::half}, {"induced.e"}},
          .attributes = {{"face", 7}, {"diag", 7.5}, {"uv.low", Vec2{-1, 0.1}}, {"rows", std::string("v decreases")}}};
}

// The pixels of part_of(), for write_part.
ExrPrepare pattern(int width) {
  return [width](int first, int rows) -> ExrFill {
    return [width, first, rows](std::span<ExrPlane> planes) {
      std::size_t k = 0;
      for (int row = first; row < first + rows; ++row)
        for (int column = 0; column < width; ++column, ++k) {
          planes[0][k] = std::bit_cast<std::uint32_t>(real_at(column, row));
          planes[1][k] = integer_at(column, row);
          planes[2][k] = std::bit_cast<std::uint32_t>(half_at(column, row));
          planes[3][k] = std::bit_cast<std::uint32_t>(2 * real_at(column, row));
        }
    };
  };
}

void write_pattern(const std::string& path, std::span<const ExrPart> parts, const ExrOptions& options) {
  ExrWriter writer(path, parts, options);
  for (std::size_t p = 0; p < parts.size(); ++p) writer.write_part(static_cast<int>(p), pattern(parts[p].width));
  writer.commit();
}

// Every bit, NaN included.
void expect_pattern(const ExrImage& image) {
  std::size_t wrong = 0, k = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column, ++k) {
      wrong += std::bit_cast<std::uint32_t>(image.real.at("size.h")[k]) !=
               std::bit_cast<std::uint32_t>(real_at(column, row));
      wrong += std::bit_cast<std::uint32_t>(image.real.at("induced.e")[k]) !=
               std::bit_cast<std::uint32_t>(2 * real_at(column, row));
      wrong += image.integer.at("triangle")[k] != integer_at(column, row);
      wrong += image.real.at("R")[k] != half_at(column, row);
    }
  EXPECT_EQ(wrong, 0U);
}

TEST(Exr, ReadsBackBitForBit) {
  const TemporaryFolder folder;
  for (const ExrCompression compression : {ExrCompression::zip, ExrCompression::piz})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {300, 1}, {37, 101}, {129, 64}}) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      const ExrPart part = part_of("face.7", width, height);
      write_pattern(folder.file("x.exr"), {&part, 1}, {.compression = compression});
      const std::vector<ExrImage> images = read_exr(folder.file("x.exr"));
      ASSERT_EQ(images.size(), 1U);
      EXPECT_EQ(images[0].width, width);
      EXPECT_EQ(images[0].height, height);
      EXPECT_EQ(images[0].header.compression(),
                compression == ExrCompression::zip ? Imf::ZIP_COMPRESSION : Imf::PIZ_COMPRESSION);
      expect_pattern(images[0]);
    }
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(Exr, HoldsTypesNamesAndAttributes) {
  const TemporaryFolder folder;
  const ExrPart part = part_of("face.7", 5, 3);
  write_pattern(folder.file("x.exr"), {&part, 1}, {});
  const ExrImage image = read_exr(folder.file("x.exr")).at(0);
  const Imf::ChannelList& channels = image.header.channels();
  EXPECT_EQ(channels["size.h"].type, Imf::FLOAT);
  EXPECT_EQ(channels["induced.e"].type, Imf::FLOAT);
  EXPECT_EQ(channels["triangle"].type, Imf::UINT);
  EXPECT_EQ(channels["R"].type, Imf::HALF);
  EXPECT_EQ(image.header.name(), "face.7");
  EXPECT_EQ(image.integer_attribute("face"), 7);
  EXPECT_EQ(image.real_attribute("diag"), 7.5);
  EXPECT_EQ(image.pair_attribute("uv.low"), Imath::V2d(-1, 0.1));
  EXPECT_EQ(image.text_attribute("rows"), "v decreases");
}

TEST(Exr, PartsOfOneFileKeepTheirOwnSizeAndPixels) {
  const TemporaryFolder folder;
  const std::vector<ExrPart> parts = {part_of("face.1", 64, 33), part_of("face.2", 3, 200), part_of("face.-3", 1, 1)};
  write_pattern(folder.file("x.exr"), parts, {.threads = 3});
  const std::vector<ExrImage> images = read_exr(folder.file("x.exr"));
  ASSERT_EQ(images.size(), parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    SCOPED_TRACE(parts[p].name);
    EXPECT_EQ(images[p].header.name(), parts[p].name);
    EXPECT_EQ(images[p].width, parts[p].width);
    EXPECT_EQ(images[p].height, parts[p].height);
    expect_pattern(images[p]);
  }
}

TEST(Exr, BytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  const std::vector<ExrPart> parts = {part_of("face.1", 211, 307), part_of("face.2", 50, 1)};
  for (const ExrCompression compression : {ExrCompression::zip, ExrCompression::piz}) {
    std::set<std::string> contents;
    for (const int threads : {0, 1, 2, 3, 8, 64}) {
      write_pattern(folder.file("x.exr"), parts, {.compression = compression, .threads = threads});
      contents.insert(read_file(folder.file("x.exr")));
    }
    EXPECT_EQ(contents.size(), 1U);
  }
}

TEST(Exr, PreparesFromTheCallersThreadInOrderOfRows) {
  const TemporaryFolder folder;
  const ExrPart part = part_of("face.1", 40, 333);
  ExrWriter writer(folder.file("x.exr"), {&part, 1}, {.threads = 4});
  int next = 0;
  std::mutex mutex;
  std::set<std::thread::id> fillers;
  const ExrPrepare inner = pattern(part.width);
  writer.write_part(0, [&](int first, int rows) -> ExrFill {
    EXPECT_EQ(first, next);
    next = first + rows;
    const auto caller = std::this_thread::get_id();
    return [&, fill = inner(first, rows), caller](std::span<ExrPlane> planes) {
      fill(planes);
      const std::lock_guard lock(mutex);
      fillers.insert(std::this_thread::get_id());
      EXPECT_NE(std::this_thread::get_id(), caller);
    };
  });
  writer.commit();
  EXPECT_EQ(next, part.height);
  EXPECT_FALSE(fillers.empty());
  expect_pattern(read_exr(folder.file("x.exr")).at(0));
}

// Debian package openexr; the test reports its absence.
TEST(Exr, ToolsOfOpenExrAcceptFiles) {
  if (std::system("command -v exrinfo exrheader >/dev/null") != 0) GTEST_SKIP() << "exrinfo and exrheader are missing";
  const TemporaryFolder folder;
  const std::vector<ExrPart> parts = {part_of("face.1", 64, 33), part_of("face.2", 3, 20)};
  for (const std::size_t count : {1, 2}) {
    write_pattern(folder.file("x.exr"), std::span(parts).first(count), {});
    for (const std::string tool : {"exrinfo -v", "exrinfo -s", "exrheader"}) {
      SCOPED_TRACE(tool);
      const std::string command = tool + " '" + folder.file("x.exr") + "' >'" + folder.file("out") + "' 2>&1";
      // exrinfo of OpenEXR 3.1.5 ends with a status that varies from run to run; its output does not.
      const int status = std::system(command.c_str());
      const std::string out = read_file(folder.file("out"));
      EXPECT_TRUE(status == 0 || tool != "exrheader") << status << out;
      EXPECT_EQ(out.find("rror"), std::string::npos) << out;
      EXPECT_NE(out.find("size.h"), std::string::npos) << out;
      EXPECT_NE(out.find("triangle"), std::string::npos) << out;
    }
  }
}

TEST(Exr, NothingIsSeenBeforeCommit) {
  const TemporaryFolder folder;
  write_file(folder.file("x.exr"), "old");
  const ExrPart part = part_of("face.1", 64, 33);
  {
    ExrWriter writer(folder.file("x.exr"), {&part, 1}, {});
    writer.write_part(0, pattern(64));
    EXPECT_EQ(read_file(folder.file("x.exr")), "old");
  }
  EXPECT_EQ(read_file(folder.file("x.exr")), "old");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(Exr, UnwritablePlacesAreReported) {
  const TemporaryFolder folder;
  const ExrPart part = part_of("face.1", 64, 64);
  const auto sentence = [&](const std::string& path) {
    return sentence_of<FileError>([&] { write_pattern(path, {&part, 1}, {.threads = 2}); });
  };
  EXPECT_EQ(sentence(folder.file("none/x.exr")),
            "cannot write '" + folder.file("none/x.exr") + "': No such file or directory");
  EXPECT_EQ(sentence(folder.file("")), "cannot write '" + folder.file("") + "': it is a folder");
  if (std::filesystem::is_character_file("/dev/full")) {
    EXPECT_EQ(sentence("/dev/full"), "cannot write '/dev/full': No space left on device");
  }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Exr, AnErrorWhilePixelsAreMadeLeavesNoFile) {
  const TemporaryFolder folder;
  const ExrPart part = part_of("face.1", 64, 200);
  for (const bool in_prepare : {true, false})
    for (const int threads : {1, 4}) {
      const ExrPrepare inner = pattern(64);
      const ExrPrepare fails = [&](int first, int rows) -> ExrFill {
        if (in_prepare && first >= 48) throw Cancelled("stopped by the host");
        return [&, first, fill = inner(first, rows)](std::span<ExrPlane> planes) {
          if (first >= 48) throw Cancelled("stopped by the host");
          fill(planes);
        };
      };
      EXPECT_THROW(
          {
            ExrWriter writer(folder.file("x.exr"), {&part, 1}, {.threads = threads});
            writer.write_part(0, fails);
            writer.commit();
          },
          Cancelled);
      EXPECT_EQ(folder.entries(), 0U);
    }
}

TEST(Exr, PartsThatCannotBeAreRejected) {
  const TemporaryFolder folder;
  const auto sentence = [&](const std::vector<ExrPart>& parts) {
    return sentence_of<InvalidArgument>([&] { ExrWriter(folder.file("x.exr"), parts, {}); });
  };
  EXPECT_EQ(sentence({}), "an EXR file needs a part");
  EXPECT_EQ(sentence({part_of("face.1", 0, 5)}),
            "the part 'face.1' of an EXR file would be 0 x 5 pixels; each number must be from 1 to 65536");
  EXPECT_EQ(sentence({part_of("face.1", 5, 65537)}),
            "the part 'face.1' of an EXR file would be 5 x 65537 pixels; each number must be from 1 to 65536");
  EXPECT_EQ(sentence({part_of("face.1", 5, 5), part_of("face.1", 6, 6)}),
            "two parts of an EXR file have the name 'face.1'");
  ExrPart part = part_of("face.1", 5, 5);
  part.channels.push_back({"size.h"});
  EXPECT_EQ(sentence({part}), "the part 'face.1' of an EXR file has two channels of the name 'size.h'");
  part.channels.clear();
  EXPECT_EQ(sentence({part}), "the part 'face.1' of an EXR file has no channel");
  EXPECT_EQ(folder.entries(), 0U);
}

}  // namespace
}  // namespace carreau
