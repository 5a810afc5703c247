// SPDX-License-Identifier: BSD-3-Clause
#include "io/model/env.h"

#include <gtest/gtest.h>

#include "io/files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

std::string error_of(std::string_view text) {
  return sentence_of<FileError>([&] { read_env_text(text, "blsurf.env"); });
}

TEST(Env, ReadsTheManualsCoarseParaboloid) {
  const auto pairs = read_env_text(
      "hphydef 1.5\nhphymax 1.5\ncall inimesh\ncall export\n\noption onesurf2d\npref 2d\ncall export\n\n"
      "option onesurf3d\npref 3d\ncall export\n\ncall exit\n",
      "blsurf.env");
  ASSERT_EQ(pairs.size(), 11u);
  EXPECT_EQ(pairs[0].name, "hphydef");
  EXPECT_EQ(pairs[0].value, "1.5");
  EXPECT_FALSE(pairs[0].quoted);
  EXPECT_EQ(pairs[4].name, "option");
  EXPECT_EQ(pairs[4].line, 6);
  EXPECT_EQ(pairs[10].value, "exit");
  EXPECT_EQ(pairs[10].line, 14);
}

TEST(Env, TakesBlanksTabsAndEqualSignsAsSeparators) {
  for (const char* text : {"verb 10", "verb=10", "verb = 10", "\tverb\t=\t10\t", "=verb==10=", "verb 10\r\n",
                           "verb 10!x", "\xEF\xBB\xBFverb 10"}) {
    const auto pairs = read_env_text(text, "e");
    ASSERT_EQ(pairs.size(), 1u) << text;
    EXPECT_EQ(pairs[0].name, "verb") << text;
    EXPECT_EQ(pairs[0].value, "10") << text;
  }
}

TEST(Env, TakesSeveralPairsOnALine) {
  const auto pairs = read_env_text("a 1 b 2 ! c 3", "e");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].name, "b");
  EXPECT_EQ(pairs[1].value, "2");
}

// RT-0232 sec. 3.3: a sequence of words between blanks; the ends of lines have no meaning for Fortran's input.
TEST(Env, ANameAndItsValueMayStandOnTwoLines) {
  const auto pairs = read_env_text("hphydef ! a size\n\n  = 0.5\ncall\ninimesh\n", "e");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].name, "hphydef");
  EXPECT_EQ(pairs[0].value, "0.5");
  EXPECT_EQ(pairs[0].line, 1);
  EXPECT_EQ(pairs[1].value, "inimesh");
}

TEST(Env, AnythingMayFollowTheExit) {
  const auto pairs = read_env_text("verb 0 call exit and 'the rest\n\x01 is a note", "e");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].value, "exit");
}

TEST(Env, KeepsBlanksAndExclamationMarksWithinQuotes) {
  const auto pairs = read_env_text("pref \"my mesh! = 1\"\noption ''\npref 'l''\xC3\xA9t\xC3\xA9'! note", "e");
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].value, "my mesh! = 1");
  EXPECT_TRUE(pairs[0].quoted);
  EXPECT_EQ(pairs[1].value, "");
  EXPECT_TRUE(pairs[1].quoted);
  EXPECT_EQ(pairs[2].value, "l'\xC3\xA9t\xC3\xA9");
}

TEST(Env, CommentsMayHoldAnything) {
  EXPECT_TRUE(read_env_text("! a 'quote\x01 =\n  !b\n\n", "e").empty());
  EXPECT_TRUE(read_env_text("", "e").empty());
}

TEST(Env, NamesTheLineOfEveryViolation) {
  EXPECT_EQ(error_of("verb 1\nhphydef\ncall exit"), "blsurf.env, line 2: 'hphydef' has no value");
  EXPECT_EQ(error_of("verb 1 hphydef ! 2"), "blsurf.env, line 1: 'hphydef' has no value");
  EXPECT_EQ(error_of("\npref 'abc\n'"), "blsurf.env, line 2: the quote that opens 'abc' is not closed on its line");
  EXPECT_EQ(error_of("pref \""), "blsurf.env, line 1: the quote that opens '' is not closed on its line");
  EXPECT_EQ(error_of("pref 'a'b"), "blsurf.env, line 1: a blank is missing after the quote that closes 'a'");
  EXPECT_EQ(error_of("pref a'b'"), "blsurf.env, line 1: a quote inside the word 'a'");
  EXPECT_EQ(error_of("'pref' x"), "blsurf.env, line 1: the name of a variable was expected, not the text 'pref'");
  EXPECT_EQ(error_of("\n\npref a\x02"), "blsurf.env, line 3: a character that is not printable (code 2)");
  EXPECT_EQ(error_of(std::string_view("a\0b 1", 5)), "blsurf.env, line 1: a character that is not printable (code 0)");
}

TEST(Env, ReadsAFileAndNamesIt) {
  const TemporaryFolder folder;
  const std::string path = folder.file("blsurf.env");
  write_file(path, "call inimesh\ncall");
  EXPECT_EQ(sentence_of<FileError>([&] { read_env(path); }), path + ", line 2: 'call' has no value");
}

}  // namespace
}  // namespace carreau
