// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <climits>
#include <functional>

#include "models.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace testing;

/// Two squares that share a side (reference 2), as if read from a file: faces on lines 2 and 9, curves on the next
/// ones.
Model sound() {
  Model model;
  model.source = "x.pardom";
  const std::vector<std::vector<std::vector<int>>> refs{{{1, 1, 2}, {2, 2, 3}, {3, 3, 4}, {4, 4, 1}},
                                                        {{5, 2, 5}, {6, 5, 6}, {7, 6, 3}, {2, 3, 2}}};
  int line = 2;
  for (std::size_t f = 0; f < refs.size(); ++f) {
    Face face{.ref = static_cast<int>(f) + 1, .orientation = 1, .curves = {}, .points = {}, .line = line++};
    for (const auto& r : refs[f])
      face.curves.push_back({.type = CurveType::boundary, .ref = r[0], .end1 = r[1], .end2 = r[2], .line = line++});
    face.points.push_back({.ref = 9, .uv = {0.5, 0.5}, .line = line++});
    line++;
    model.faces.push_back(face);
  }
  return model;
}

std::vector<std::string> defects_after(const std::function<void(Model&)>& change) {
  Model model = sound();
  change(model);
  return find_model_defects(model);
}

using Sentences = std::vector<std::string>;

TEST(FindModelDefects, FindsNothingInSoundModels) {
  EXPECT_EQ(find_model_defects(sound()), Sentences{});
  EXPECT_EQ(find_model_defects(unglued(paraboloid())), Sentences{});
}

TEST(FindModelDefects, AllowsSeamsClosedCurvesAndInternalOnes) {
  Model model;  // a cylinder with a line inside
  Face face{.ref = 4, .orientation = -2, .curves = {}, .points = {}};
  face.curves = {{CurveType::boundary, 1, 1, 1},
                 {CurveType::boundary, 2, 1, 4},
                 {CurveType::boundary, 3, 4, 4},
                 {CurveType::boundary, 2, 4, 1},
                 {CurveType::internal, 5, 7, 8}};
  model.faces = {face};
  EXPECT_EQ(find_model_defects(model), Sentences{});
}

TEST(FindModelDefects, RequiresFacesWithPositiveAndDistinctReferences) {
  EXPECT_EQ(find_model_defects({}), Sentences{"the model has no face"});
  EXPECT_EQ(defects_after([](Model& m) { m.faces[1].ref = 1; }),
            Sentences{"x.pardom, line 9, face 1: face number 2 has the same reference as face number 1 (line 2)"});
  EXPECT_EQ(defects_after([](Model& m) { m.faces[1].ref = 0; }),
            Sentences{"x.pardom, line 9: the reference of a face must be positive; face number 2 has 0"});
}

TEST(FindModelDefects, RequiresAnOrientationThatNamesABoundaryCurve) {
  for (const int orientation : {5, -5, INT_MAX, INT_MIN})
    EXPECT_EQ(defects_after([&](Model& m) { m.faces[0].orientation = orientation; }),
              Sentences{"x.pardom, line 2, face 1: orientation " + std::to_string(orientation) +
                        " names no curve of the face, which has 4"});
  const Sentences found = defects_after([](Model& m) {
    m.faces[0].curves.push_back({CurveType::internal, 20, 21, 22, 77});
    m.faces[0].orientation = -5;
  });
  EXPECT_EQ(
      found,
      Sentences{"x.pardom, line 2, face 1: orientation -5 names curve 5 (line 77), which is not of type 1 (boundary)"});
}

TEST(FindModelDefects, RequiresWiresWithoutBorders) {
  const std::string of_wire = ": a wire (orientation 0) bounds nothing: its curves have type 2 (internal), not 1";
  const Sentences found = defects_after([](Model& m) { m.faces[0].orientation = 0; });
  ASSERT_EQ(found.size(), 5U);
  EXPECT_TRUE(found[0].ends_with("has no area that points could lie in; its points are ends of its curves"));
  for (std::size_t i = 1; i < 5; ++i) EXPECT_TRUE(found[i].ends_with(of_wire)) << found[i];
  EXPECT_EQ(defects_after([](Model& m) {
              m.faces[0].orientation = 0;
              m.faces[0].points.clear();
              for (FaceCurve& curve : m.faces[0].curves) curve.type = CurveType::internal;
            }),
            Sentences{});
}

TEST(FindModelDefects, RequiresABoundary) {
  EXPECT_EQ(defects_after([](Model& m) { m.faces[1].curves.clear(); }),
            Sentences{"x.pardom, line 9, face 2: the face has no curve"});
  EXPECT_EQ(defects_after([](Model& m) {
              for (FaceCurve& c : m.faces[1].curves) c.type = CurveType::internal;
            }),
            Sentences{"x.pardom, line 9, face 2: the face has no curve of type 1 (boundary)"});
}

TEST(FindModelDefects, RequiresKnownTypes) {
  const Sentences found = defects_after([](Model& m) { m.faces[0].curves[1].type = static_cast<CurveType>(3); });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(
      found[0],
      "x.pardom, line 4, face 1, curve 2 (reference 2): the type of a curve must be 1 (boundary) or 2 (internal); it "
      "is 3");
}

TEST(FindModelDefects, RequiresAllReferencesUnlessTheFirstIsZero) {
  EXPECT_EQ(
      defects_after([](Model& m) { m.faces[1].curves[0].ref = 0; }),
      Sentences{"x.pardom, line 10, face 2, curve 1: zero references are mixed with others (refc 0, refp1 2, refp2 "
                "5): to find references, the references of all curves must be 0"});
  Model model = unglued(paraboloid());
  model.source = "x.pardom";
  model.faces[0].curves[0].line = 5;
  model.faces[0].curves[2].line = 7;
  model.faces[0].curves[2].end2 = 3;
  EXPECT_EQ(find_model_defects(model), Sentences{});
  EXPECT_EQ(references_to_forget(model), 1U);
}

TEST(FindModelDefects, RequiresPositiveReferences) {
  EXPECT_EQ(
      defects_after([](Model& m) { m.faces[1].curves[1].end1 = -5; }),
      Sentences{"x.pardom, line 11, face 2, curve 2 (reference 6): references must be positive (refc 6, refp1 -5, "
                "refp2 6)"});
  EXPECT_EQ(defects_after([](Model& m) { m.faces[1].points[0].ref = -1; }),
            Sentences{"x.pardom, line 14, face 2: the reference of internal point 1 must not be negative; it is -1"});
}

TEST(FindModelDefects, RequiresTheSameEndsForAllCurvesOfAReference) {
  const Sentences found = defects_after([](Model& m) {
    m.faces[1].curves[3].end1 = 8;
    m.faces[1].curves[2].end2 = 8;
  });
  EXPECT_EQ(found,
            Sentences{"x.pardom, line 13, face 2, curve 4 (reference 2): its ends 8 and 2 differ from the ends of the first "
                      "curve of this reference, 2 and 3 (line 4)"});
}

TEST(FindModelDefects, AllowsABoundaryReferenceTwiceInAFaceAndNoMore) {
  const auto with_sides = [](int n) {
    return defects_after([&](Model& m) {
      m.faces[0].curves.clear();
      for (int i = 0; i < n; ++i) m.faces[0].curves.push_back({CurveType::boundary, 2, 2 + i % 2, 3 - i % 2, 10 + i});
    });
  };
  EXPECT_EQ(with_sides(2), Sentences{});
  EXPECT_EQ(
      with_sides(4).front(),
      "x.pardom, line 12, face 1, curve 3 (reference 2): the reference belongs to boundary curves 1 (line 10) and 2 "
      "(line 11) of the face already; twice is a seam, more is not possible");
  const Sentences twice = defects_after([](Model& m) {
    m.faces[0].curves.push_back({CurveType::internal, 20, 21, 22, 30});
    m.faces[0].curves.push_back({CurveType::internal, 20, 21, 22, 31});
  });
  EXPECT_EQ(twice,
            Sentences{"x.pardom, line 31, face 1, curve 6 (reference 20): the reference belongs to internal curve 5 "
                      "(line 30) of the face already"});
}

TEST(FindModelDefects, RequiresBoundariesThatClose) {
  const Sentences found = defects_after([](Model& m) { m.faces[0].curves[2].end2 = 8; });
  EXPECT_EQ(found,
            (Sentences{"x.pardom, line 6, face 1, point of reference 4: the boundary of the face does not close: "
                       "boundary curve 4 ends there alone",
                       "x.pardom, line 5, face 1, point of reference 8: the boundary of the face does not close: "
                       "boundary curve 3 ends there alone"}));
  const Sentences odd = defects_after([](Model& m) {
    m.faces[0].curves.push_back({CurveType::boundary, 20, 1, 3, 30});
  });
  EXPECT_EQ(odd.size(), 2U);
  EXPECT_TRUE(contains(odd[0], "boundary curves 1, 4 and 5 end there, which is an odd number of ends")) << odd[0];
}

TEST(FindModelDefects, RequiresInternalPointsThatAreFiniteAndApart) {
  EXPECT_EQ(defects_after([](Model& m) { m.faces[0].points[0].uv.y() = infinity; }),
            Sentences{"x.pardom, line 7, face 1: the coordinates of internal point 1 are not finite"});
  EXPECT_EQ(
      defects_after([](Model& m) {
        m.faces[0].points.push_back({.ref = 12, .uv = {0.5, 0.5}, .line = 8});
      }),
      Sentences{"x.pardom, line 8, face 1, u = 0.5, v = 0.5: internal point 2 is at the same place as internal point "
                "1 (line 7)"});
}

TEST(FindModelDefects, ReportsEveryViolationOnceAndNeedsNoFile) {
  Model model = sound();
  model.source.clear();
  for (Face& face : model.faces) {
    face.line = 0;
    for (FaceCurve& curve : face.curves) curve.line = 0;
  }
  model.faces[1].ref = 1;
  model.faces[1].orientation = 9;
  model.faces[0].curves[0].ref = -1;
  EXPECT_EQ(find_model_defects(model),
            (Sentences{"face 1, curve 1 (reference -1): references must be positive (refc -1, refp1 1, refp2 2)",
                       "face 1: face number 2 has the same reference as face number 1",
                       "face 1: orientation 9 names no curve of the face, which has 4"}));
}

}  // namespace
}  // namespace carreau
