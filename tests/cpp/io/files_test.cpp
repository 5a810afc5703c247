// SPDX-License-Identifier: BSD-3-Clause
#include "io/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "io_test_support.h"

namespace carreau {
namespace {

namespace fs = std::filesystem;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Files, ReadBackWrittenBytes) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 200000; ++i) content += static_cast<char>(i % 251);
  for (const std::string& text : {std::string(), std::string("one"), content}) {
    write_file(folder.file("x.bin"), text);
    EXPECT_EQ(read_file(folder.file("x.bin")), text);
  }
  EXPECT_EQ(folder.entries(), 1u);  // no temporary is left
}

TEST(Files, PositionsGoBeyond32Bits) {
  const TemporaryFolder folder;
  constexpr std::uint64_t far = (std::uint64_t{1} << 32) + 7;
  NewFile file(folder.file("x.bin"));
  file.write_at(far, "far");
  file.write_at(0, "near");
  file.commit();
  EXPECT_EQ(fs::file_size(folder.file("x.bin")), far + 3);
  std::ifstream in(folder.file("x.bin"), std::ios::binary);
  std::string start(4, ' '), end(3, ' ');
  in.read(start.data(), 4).seekg(static_cast<std::streamoff>(far)).read(end.data(), 3);
  EXPECT_EQ(start, "near");
  EXPECT_EQ(end, "far");
}

TEST(Files, ReadingErrorsNameTheFileAndTheReason) {
  const TemporaryFolder folder;
  const auto sentence = [](const std::string& path) { return sentence_of<FileError>([&] { read_file(path); }); };
  EXPECT_EQ(sentence(folder.file("none")), "cannot read '" + folder.file("none") + "': No such file or directory");
  EXPECT_EQ(sentence(folder.file("")), "cannot read '" + folder.file("") + "': it is a folder");
  EXPECT_EQ(sentence("/dev/zero"), "cannot read '/dev/zero': it is a device");
  EXPECT_EQ(sentence(""), "cannot read a file without a name");
  EXPECT_EQ(sentence(std::string("/a\0b", 4)), "cannot read '/a': the name holds a zero byte");
  EXPECT_TRUE(contains(sentence("no_such_file_here"), fs::current_path().string() + "/no_such_file_here"));
}

TEST(Files, ReadingStopsAtTheLimit) {
  const TemporaryFolder folder;
  write_file(folder.file("x"), "12345");
  EXPECT_EQ(read_file(folder.file("x"), 5), "12345");
  EXPECT_EQ(sentence_of<FileError>([&] { read_file(folder.file("x"), 4); }),
            "cannot read '" + folder.file("x") + "': it is larger than 4 bytes");
}

TEST(Files, WritingIntoAMissingFolderIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.file("none/x.mesh");
  EXPECT_EQ(sentence_of<FileError>([&] { write_file(path, "a"); }),
            "cannot write '" + path + "': No such file or directory");
}

TEST(Files, WritingOverAFolderIsRejected) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("x.mesh"));
  EXPECT_EQ(sentence_of<FileError>([&] { write_file(folder.file("x.mesh"), "a"); }),
            "cannot write '" + folder.file("x.mesh") + "': it is a folder");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Files, AnOldFileSurvivesAFolderThatCannotBeWritten) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("f"));
  write_file(folder.file("f/x.mesh"), "old");
  fs::permissions(folder.file("f"),
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  fs::permissions(folder.file(""), fs::perms::all);
  // The superuser writes everywhere; another user's rights are taken for the length of the write.
  const bool superuser = geteuid() == 0;
  if (superuser) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  const std::string sentence = sentence_of<FileError>([&] { write_file(folder.file("f/x.mesh"), "new"); });
  if (superuser) {
    ASSERT_EQ(seteuid(0), 0);
  }
  fs::permissions(folder.file("f"), fs::perms::owner_all);
  EXPECT_EQ(sentence, "cannot write '" + folder.file("f/x.mesh") + "': Permission denied");
  EXPECT_EQ(read_file(folder.file("f/x.mesh")), "old");
}

TEST(Files, AnOldFileSurvivesAFullDisk) {
  const TemporaryFolder folder;
  write_file(folder.file("x.mesh"), "old");
  // A limit on the size of files stands for the disk: the write fails half-way in the same manner.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit limited = before;
  limited.rlim_cur = 100000;
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  const std::string sentence =
      sentence_of<FileError>([&] { write_file(folder.file("x.mesh"), std::string(1000000, 'n')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(sentence, "cannot write '" + folder.file("x.mesh") + "': File too large");
  EXPECT_EQ(read_file(folder.file("x.mesh")), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Files, AFullDeviceIsReported) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_EQ(sentence_of<FileError>([] { write_file("/dev/full", "a"); }),
            "cannot write '/dev/full': No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Files, KeepPermissionsAndLinksOfTheOldFile) {
  const TemporaryFolder folder;
  write_file(folder.file("x.mesh"), "old");
  fs::permissions(folder.file("x.mesh"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("x.mesh", folder.file("link.mesh"));
  write_file(folder.file("link.mesh"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("link.mesh")));
  EXPECT_EQ(read_file(folder.file("x.mesh")), "new");
  EXPECT_EQ(fs::status(folder.file("x.mesh")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Files, ATemporaryOfAKilledRunIsNotTouched) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("x.mesh.0.tmp")) << "other";
  write_file(folder.file("x.mesh"), "new");
  EXPECT_EQ(read_file(folder.file("x.mesh")), "new");
  EXPECT_EQ(read_file(folder.file("x.mesh.0.tmp")), "other");
  EXPECT_EQ(folder.entries(), 2u);
}

}  // namespace
}  // namespace carreau
