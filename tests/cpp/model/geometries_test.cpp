// SPDX-License-Identifier: BSD-3-Clause
// References of several geometries in one model.
#include "model/geometries.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/topology.h"
#include "support/error.h"

namespace carreau {
namespace {

/// A face of one closed chain of `n` curves, with references from `first` on; 0: they are not known.
Face polygon(int ref, int n, int first) {
  Face face{.ref = ref, .curves = {}, .points = {}};
  for (int k = 0; k < n; ++k) {
    FaceCurve curve;
    if (first > 0) curve.ref = first + k, curve.end1 = first + k, curve.end2 = first + (k + 1) % n;
    face.curves.push_back(curve);
  }
  return face;
}

Model model_of(std::vector<Face> faces) { return {.faces = std::move(faces), .source = {}}; }

TEST(Geometries, StandBehindOneAnother) {
  Model model;
  const GeometryRange first = append_geometry(model, model_of({polygon(1, 4, 1), polygon(3, 4, 5)}));
  EXPECT_EQ(first.first_face, 1);
  EXPECT_EQ(first.last_face, 3);
  EXPECT_EQ(first.last_curve, 8);
  const GeometryRange second = append_geometry(model, model_of({polygon(2, 3, 1)}));
  EXPECT_EQ(second.first_face, 4);
  EXPECT_EQ(second.last_face, 5);
  EXPECT_EQ(model.faces[2].ref, 5);
  EXPECT_EQ(model.faces[2].curves[0].ref, 9);
  EXPECT_EQ(model.faces[2].curves[0].end2, 10);
  EXPECT_TRUE(is_mixed(model));
  EXPECT_TRUE(find_model_defects(model).empty());
}

TEST(Geometries, KeepRoomForReferencesThatAreToBeFound) {
  Model model;
  append_geometry(model, model_of({polygon(1, 4, 0)}));
  const GeometryRange second = append_geometry(model, model_of({polygon(1, 4, 1)}));
  EXPECT_EQ(second.first_curve, 5);
  EXPECT_EQ(second.first_point, 9);
  EXPECT_TRUE(find_model_defects(model).empty());  // zero references are no mixture of one geometry
  EXPECT_EQ(geometries_to_glue(model), std::vector<int>{1});
  GeometryPart part = part_of(model, 1);
  ASSERT_EQ(part.faces, std::vector<std::size_t>{0});
  part.model.faces = {polygon(1, 4, 1)};
  put_back(part, 1, model);
  EXPECT_EQ(model.faces[0].curves[0].ref, 1);
  // More curves than there was room for: they were cut.
  Model cut = model;
  part.model.faces = {polygon(1, 20, 1)};
  put_back(part, 1, cut);
  EXPECT_GT(cut.faces[0].curves[0].ref, 8);
  EXPECT_TRUE(find_model_defects(cut).empty());
}

TEST(Geometries, OneGeometryMayNotMixReferences) {
  Model model;
  Face wrong = polygon(1, 4, 1);
  wrong.curves[2] = {};
  append_geometry(model, model_of({polygon(1, 4, 0)}));
  append_geometry(model, model_of({wrong}));
  EXPECT_EQ(list_model_defects(model).size(), 1);
}

TEST(Geometries, RejectReferencesThatNoModelMayHave) {
  Model model = model_of({polygon(5, 4, 1)});
  const auto refused = [&](const Face& face) {
    EXPECT_THROW(append_geometry(model, model_of({face})), InvalidModel);
    EXPECT_EQ(model.faces.size(), 1);
    EXPECT_TRUE(model.geometries.empty());
  };
  refused(polygon(0, 4, 1));
  refused(polygon(std::numeric_limits<int>::max(), 4, 1));
  refused(polygon(1, 4, std::numeric_limits<int>::max() - 4));
  Face negative = polygon(1, 4, 1);
  negative.curves[1].end1 = -2;
  refused(negative);
  EXPECT_THROW(append_geometry(model, {}), InvalidModel);
}

TEST(Geometries, PartsAndShownReferencesMoveToo) {
  Model model = model_of({polygon(5, 4, 1)});
  Model part = model_of({polygon(1, 4, 1), polygon(2, 4, 5)});
  part.faces[1].part_of = 1;
  part.faces[1].curves[0].shown_as = 3;
  part.faces[1].points.push_back({.ref = 7, .uv = {}});
  part.shown_points[2] = 9;
  append_geometry(model, part);
  EXPECT_EQ(model.faces[2].part_of, 6);
  EXPECT_EQ(model.faces[2].curves[0].shown_as, 7);
  EXPECT_EQ(model.faces[2].points[0].ref, 11);
  EXPECT_EQ(model.shown_points.at(6), 13);
  EXPECT_EQ(largest_references(model).point, 13);
}

}  // namespace
}  // namespace carreau
