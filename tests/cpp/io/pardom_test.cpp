// SPDX-License-Identifier: BSD-3-Clause
#include "io/model/pardom.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/files.h"
#include "io_test_support.h"
#include "support/infinity.h"

namespace carreau {
namespace {

std::string error_of(std::string_view text) {
  return sentence_of<FileError>([&] { read_pardom_text(text, "x.pardom"); });
}

void expect_same_model(const Model& a, const Model& b) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    const Face &f = a.faces[i], &g = b.faces[i];
    EXPECT_EQ(f.ref, g.ref);
    EXPECT_EQ(f.orientation, g.orientation);
    ASSERT_EQ(f.curves.size(), g.curves.size());
    ASSERT_EQ(f.points.size(), g.points.size());
    for (std::size_t k = 0; k < f.curves.size(); ++k) {
      EXPECT_EQ(f.curves[k].type, g.curves[k].type);
      EXPECT_EQ(f.curves[k].ref, g.curves[k].ref);
      EXPECT_EQ(f.curves[k].end1, g.curves[k].end1);
      EXPECT_EQ(f.curves[k].end2, g.curves[k].end2);
      EXPECT_EQ(f.curves[k].part_of, g.curves[k].part_of);
      EXPECT_EQ(f.curves[k].part_a, g.curves[k].part_a);
      EXPECT_EQ(f.curves[k].part_b, g.curves[k].part_b);
    }
    for (std::size_t k = 0; k < f.points.size(); ++k) {
      EXPECT_EQ(f.points[k].ref, g.points[k].ref);
      EXPECT_EQ(f.points[k].uv, g.points[k].uv);
    }
  }
}

// RT-0232 sec. 6.1.
constexpr const char* manual_paraboloid =
    "1 ! ns (number of surfaces)\n"
    "1 ! refs (reference of the surface)\n"
    "1 ! orientation\n"
    "4 ! nc (number of curves)\n"
    "1 1 1 2 ! typc refc refp1 refp2\n"
    "1 2 2 4\n"
    "1 3 4 6\n"
    "1 4 6 1\n"
    "0 ! np (number of internal points)\n";

TEST(Pardom, ReadsTheManualsParaboloidAndWritesItBack) {
  const Model model = read_pardom_text(manual_paraboloid, "x.pardom");
  EXPECT_EQ(model.source, "x.pardom");
  ASSERT_EQ(model.faces.size(), 1u);
  const Face& face = model.faces[0];
  EXPECT_EQ(face.orientation, 1);
  EXPECT_EQ(face.line, 2);
  ASSERT_EQ(face.curves.size(), 4u);
  EXPECT_EQ(face.curves[2].ref, 3);
  EXPECT_EQ(face.curves[2].end1, 4);
  EXPECT_EQ(face.curves[2].end2, 6);
  EXPECT_EQ(face.curves[2].line, 7);
  EXPECT_TRUE(face.points.empty());
  EXPECT_EQ(pardom_text(model), manual_paraboloid);
}

TEST(Pardom, ReadsInternalPointsAndCurves) {
  const Model model =
      read_pardom_text("1\n\n3 ! refs\n-2\n2\n2 0 0 0\n1 0 0 0 ! typc\n2 !np\n1 0. 0.\n5 -1.5d0 +2.5E-1", "p");
  const Face& face = model.faces[0];
  EXPECT_EQ(face.ref, 3);
  EXPECT_EQ(face.orientation, -2);
  EXPECT_EQ(face.curves[0].type, CurveType::internal);
  EXPECT_EQ(face.curves[1].type, CurveType::boundary);
  ASSERT_EQ(face.points.size(), 2u);
  EXPECT_EQ(face.points[1].ref, 5);
  EXPECT_EQ(face.points[1].uv, (Vec2{-1.5, 0.25}));
  EXPECT_EQ(face.points[1].line, 10);
}

TEST(Pardom, TheLayoutOfTheTextDoesNotMatter) {
  const Model reference = read_pardom_text(manual_paraboloid, "p");
  for (const char* text :
       {"1 1 1 4 1 1 1 2 1 2 2 4 1 3 4 6 1 4 6 1 0", "1,1, 1 ,4\n1,1,1,2\r\n1,2,2,4,\n1,3,4,6\n1,4,6,1\n0\n",
        "\xEF\xBB\xBF! r\xC3\xA9"
        "f\xC3\xA9rence\n1\t1 1!x\n4\n1 1 1\n2 1 2 2 4 +1 3 4 6 1 4 6 1 0 ! fin"})
    expect_same_model(read_pardom_text(text, "p"), reference);
}

TEST(Pardom, RandomModelsReadBackAsWritten) {
  std::mt19937_64 random(7);
  const auto ref = [&] { return static_cast<int>(random()); };
  for (int run = 0; run < 200; ++run) {
    Model model;
    for (std::size_t i = 1 + random() % 5; i > 0; --i) {
      Face face;
      face.ref = ref();
      for (std::size_t k = 1 + random() % 6; k > 0; --k) {
        face.curves.push_back({static_cast<CurveType>(1 + random() % 2), ref(), ref(), ref()});
        if (random() % 3 != 0) continue;
        FaceCurve& part = face.curves.back();
        part.part_of = 1 + static_cast<int>(random() % 9);
        part.part_a = random_double(random), part.part_b = random_double(random);
        if (part.part_a > part.part_b) std::swap(part.part_a, part.part_b);
      }
      for (std::size_t k = random() % 4; k > 0; --k)
        face.points.push_back({ref(), {random_double(random), random_double(random)}});
      const int ic = 1 + static_cast<int>(random() % face.curves.size());
      face.orientation = random() % 2 == 0 ? ic : -ic;
      model.faces.push_back(face);
    }
    expect_same_model(read_pardom_text(pardom_text(model), "p"), model);
  }
}

TEST(Pardom, PartsOfCurvesAreCommentsForOtherPrograms) {
  const std::string text = "1\n1\n1\n2\n1 1 1 2 ! part of curve 1 0.5 1.25\n1 2 2 1 ! part of the house\n0\n";
  const Model model = read_pardom_text(text, "x.pardom");
  EXPECT_EQ(model.faces[0].curves[0].part_of, 1);
  EXPECT_EQ(model.faces[0].curves[0].part_a, 0.5);
  EXPECT_EQ(model.faces[0].curves[0].part_b, 1.25);
  EXPECT_EQ(model.faces[0].curves[1].part_of, 0);
  for (const char* wrong : {" 0 0.5 1.25", " 1 1.25 0.5", " 1 0.5", " x 0 1"})
    EXPECT_EQ(
        error_of("1\n1\n1\n2\n1 1 1 2 ! part of curve" + std::string(wrong) + "\n1 2 2 1\n0\n").find("x.pardom, line "),
        0u)
        << wrong;
}

TEST(Pardom, EveryTruncationIsAnErrorThatNamesTheExpectedItem) {
  std::string text = manual_paraboloid;
  std::string bare;
  for (std::size_t i = 0; i < text.size(); ++i) {  // without comments, so that every cut removes a number
    if (text[i] == '!') i = text.find('\n', i);
    bare += text[i];
  }
  const std::size_t last = bare.find_last_of('0');
  for (std::size_t n = 0; n < last; ++n) {
    const std::string sentence = error_of(std::string_view(bare).substr(0, n));
    EXPECT_NE(sentence, "") << n;
    EXPECT_EQ(sentence.find("x.pardom, line "), 0u) << n;
  }
}

// Fortran's input reads the numbers that it needs: old files have notes behind them.
TEST(Pardom, AnythingMayFollowTheLastSurface) {
  const std::string text = "1\n1\n1\n2\n1 1 1 2\n1 2 2 1\n0 ! np\n! a comment\n";
  int line = -1;
  EXPECT_EQ(read_pardom_text(text, "x.pardom", &line).faces.size(), 1u);
  EXPECT_EQ(line, 0);
  EXPECT_EQ(read_pardom_text(text + ",, 'the end\x01", "x.pardom", &line).faces[0].curves.size(), 2u);
  EXPECT_EQ(line, 9);
}

TEST(Pardom, NamesTheExpectedItemAtTheEnd) {
  const std::string two = "2\n1\n1\n1\n1 0 0 0\n0\n2\n1\n3\n1 0 0 0\n1 0 0 0\n";
  EXPECT_EQ(error_of(""), "x.pardom, line 1: the file ends where ns was expected");
  EXPECT_EQ(error_of("! nothing\n"), "x.pardom, line 1: the file ends where ns was expected");
  EXPECT_EQ(error_of("1 0 0 0\n"), "x.pardom, line 1: surface 1 has no curve: nc is 0");
  EXPECT_EQ(error_of(two), "x.pardom, line 11: the file ends where typc of curve 3 of surface 2 was expected");
  EXPECT_EQ(error_of(two + "1 0 0"),
            "x.pardom, line 12: the file ends where refp2 of curve 3 of surface 2 was expected");
  EXPECT_EQ(error_of(two + "1 0 0 0\n"), "x.pardom, line 12: the file ends where np of surface 2 was expected");
  EXPECT_EQ(error_of(two + "1 0 0 0\n1\n7 0.5 "),
            "x.pardom, line 14: the file ends where v of point 1 of surface 2 was expected");
}

TEST(Pardom, NamesTheLineOfEveryViolation) {
  const auto with = [](const std::string& line, const std::string& replacement) {
    std::string text = manual_paraboloid;
    return error_of(text.replace(text.find(line), line.size(), replacement));
  };
  EXPECT_EQ(with("1 2 2 4", "3 2 2 4"),
            "x.pardom, line 6: typc of curve 2 of surface 1 should be 1 (boundary) or 2 (internal), not 3");
  EXPECT_EQ(with("1 2 2 4", "1 2.5 2 4"),
            "x.pardom, line 6: refc of curve 2 of surface 1 should be an integer, not '2.5'");
  EXPECT_EQ(with("1 2 2 4", "1 2 x 4"),
            "x.pardom, line 6: refp1 of curve 2 of surface 1 should be an integer, not 'x'");
  EXPECT_EQ(with("1 2 2 4", "1 2 9999999999 4"),
            "x.pardom, line 6: refp1 of curve 2 of surface 1 is too large for an integer: '9999999999'");
  EXPECT_EQ(with("1 2 2 4", "1,,2 4"), "x.pardom, line 6: a value is missing before a comma");
  EXPECT_EQ(with("4 ! nc", "-4 ! nc"), "x.pardom, line 4: nc of surface 1 is negative: -4");
  EXPECT_EQ(with("4 ! nc", "1000000000 ! nc")
                .find("x.pardom, line 4: nc of surface 1 is 1000000000, but the rest "
                      "of the file has room for at most "),
            0u);
  EXPECT_EQ(with("1 ! ns", "2000000000 ! ns").find("x.pardom, line 1: ns is 2000000000, but the rest"), 0u);
  EXPECT_EQ(with("1 ! ns", "-1 ! ns"), "x.pardom, line 1: ns is negative: -1");
  EXPECT_EQ(with("1 ! ns", "0 ! ns"), "x.pardom, line 1: the file describes no surface: ns is 0");
  for (const char* orientation : {"5", "-5", "-2147483648"})
    EXPECT_EQ(with("1 ! orientation", orientation),
              "x.pardom, line 3: orientation of surface 1 is " + std::string(orientation) +
                  ", but its absolute value should be the rank of a curve, from 1 to 4, or 0 for a wire");
  EXPECT_EQ(with("0 ! np", "1 1 nan 0 ! np"), "x.pardom, line 9: u of point 1 of surface 1 is not finite: 'nan'");
  EXPECT_EQ(with("0 ! np", "1 1 0 a ! np"), "x.pardom, line 9: v of point 1 of surface 1 should be a number, not 'a'");
  EXPECT_EQ(error_of(", 1"), "x.pardom, line 1: a value is missing before a comma");
}

TEST(Pardom, BinaryContentIsShownSafely) {
  EXPECT_EQ(error_of(std::string_view("\x7F"
                                      "ELF\x02\x01\0\xFF",
                                      8)),
            "x.pardom, line 1: ns should be an integer, not '?ELF?"
            "?"
            "?"
            "?'");
  EXPECT_EQ(error_of(std::string(1000, 'x')),
            "x.pardom, line 1: ns should be an integer, not '" + std::string(40, 'x') + "...'");
}

TEST(Pardom, ReadsInEveryLocale) {
  const CommaLocale locale;
  const Model model = read_pardom_text("1 1 1 1 1 0 0 0 1 1 0.5 1.5d1", "p");
  EXPECT_EQ(model.faces[0].points[0].uv, (Vec2{0.5, 15}));
  EXPECT_NE(pardom_text(model).find("1 0.5 15 ! refp u v"), std::string::npos);
}

TEST(Pardom, APointThatIsNotFiniteIsNotWritten) {
  Model model = read_pardom_text("1 4 1 1 1 0 0 0 1 1 0.5 0.5", "p");
  model.faces[0].points[0].uv.x() = infinity;
  EXPECT_THROW(pardom_text(model), InvalidArgument);
}

TEST(Pardom, ReadsAFileAndNamesIt) {
  const TemporaryFolder folder;
  write_file(folder.file("x.pardom"), manual_paraboloid);
  EXPECT_EQ(read_pardom(folder.file("x.pardom")).source, folder.file("x.pardom"));
  write_file(folder.file("x.pardom"), "1 1");
  EXPECT_EQ(sentence_of<FileError>([&] { read_pardom(folder.file("x.pardom")); }),
            folder.file("x.pardom") + ", line 1: the file ends where orientation of surface 1 was expected");
}

}  // namespace
}  // namespace carreau
