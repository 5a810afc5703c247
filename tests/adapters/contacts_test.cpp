// SPDX-License-Identifier: BSD-3-Clause
// Faces of different solids that lie on each other, and their common area.
#include <gtest/gtest.h>
#include <assembly/common_area.h>
#include <assembly/domain_cells.h>
#include <assembly/face_contacts.h>
#include <shape_file.h>
#include <solids.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <array>
#include <chrono>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <numbers>
#include <random>

namespace contact_tests {

using carreau_occ::FaceContact;
using carreau_occ::Segment;
using carreau_occ::ShapeFile;
using std::numbers::pi;

ShapeFile file_of_parts(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& part : parts) builder.Add(all, part);
  ShapeFile file;
  file.shape = all;
  return file;
}

std::vector<FaceContact> contacts_of(const std::vector<TopoDS_Shape>& parts) {
  const ShapeFile file = file_of_parts(parts);
  return carreau_occ::find_face_contacts(file, carreau_occ::solids_of(file));
}

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape cylinder(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

std::vector<Segment> polygon(const std::vector<std::array<double, 2>>& corners) {
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) sides.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return sides;
}

/// A regular polygon: its area is n / 2 r^2 sin(2 pi / n).
std::vector<std::array<double, 2>> regular(int n, double radius, double angle) {
  std::vector<std::array<double, 2>> corners;
  for (int k = 0; k < n; ++k) corners.push_back({radius * std::cos(angle + 2 * pi * k / n), radius * std::sin(angle + 2 * pi * k / n)});
  return corners;
}

TEST(CommonArea, OfPolygonsInClosedForm) {
  std::array<double, 2> inside{};
  const auto unit = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_NEAR(carreau_occ::common_area(unit, unit, inside), 1, 1e-12);
  EXPECT_NEAR(carreau_occ::common_area(unit, polygon({{0.25, 0.5}, {3, 0.5}, {3, 2}, {0.25, 2}}), inside), 0.375, 1e-12);
  EXPECT_TRUE(inside[0] > 0.25 && inside[0] < 1 && inside[1] > 0.5 && inside[1] < 1);
  EXPECT_EQ(carreau_occ::common_area(unit, polygon({{1, 0}, {2, 0}, {2, 1}, {1, 1}}), inside), 0);
  // Two equal squares, one turned by 45 degrees: a regular octagon of inradius 1.
  const double common = carreau_occ::common_area(polygon(regular(4, std::sqrt(2), 0)), polygon(regular(4, std::sqrt(2), pi / 4)), inside);
  EXPECT_NEAR(common, 8 * std::tan(pi / 8), 1e-9);
  // A square with a square hole, and one that covers half of both.
  auto frame = polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  for (const Segment& side : polygon({{1, 1}, {1, 3}, {3, 3}, {3, 1}})) frame.push_back(side);
  EXPECT_NEAR(carreau_occ::common_area(frame, polygon({{2, -1}, {9, -1}, {9, 9}, {2, 9}}), inside), 6, 1e-12);
}

/// A polygon that is turned and moved has its area in common with itself, and the sum over a division of the plane is the
/// whole.
TEST(CommonArea, OfRandomPolygons) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  std::array<double, 2> inside{};
  for (int i = 0; i < 200; ++i) {
    const int n = 3 + static_cast<int>(9 * number(random));
    const double radius = 0.1 + number(random);
    auto corners = regular(n, radius, 2 * pi * number(random));
    const double x = number(random), y = number(random);
    for (auto& corner : corners) corner[0] += x, corner[1] += y;
    const auto some = polygon(corners);
    const double area = n / 2.0 * radius * radius * std::sin(2 * pi / n);
    EXPECT_NEAR(carreau_occ::common_area(some, some, inside), area, 1e-9);
    const double slope = number(random) - 0.5;
    const auto left = polygon({{-9, -9}, {x - 9 * slope, -9}, {x + 9 * slope, 9}, {-9, 9}});
    const auto right = polygon({{x - 9 * slope, -9}, {9, -9}, {9, 9}, {x + 9 * slope, 9}});
    EXPECT_NEAR(carreau_occ::common_area(some, left, inside) + carreau_occ::common_area(some, right, inside), area, 1e-5 * area);
  }
}

TEST(Contacts, OfBoxesInClosedForm) {
  // A cube of side 2 that overhangs a plate by 1/2.
  const auto contacts = contacts_of({box(0, 0, 0, 4, 4, 1), box(2.5, 1, 1, 2, 2, 2)});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].solids, (std::array<int, 2>{1, 2}));
  EXPECT_NEAR(contacts[0].area, 3, 1e-12);
  EXPECT_EQ(contacts[0].pairs, 1);
  EXPECT_NEAR(contacts[0].place[2], 1, 1e-12);
  EXPECT_TRUE(contacts_of({box(0, 0, 0, 1, 1, 1), box(0, 0, 1.001, 1, 1, 1)}).empty());  // apart
  EXPECT_TRUE(contacts_of({box(0, 0, 0, 1, 1, 1), box(1, 1, 0, 1, 1, 1)}).empty());      // one edge
  EXPECT_TRUE(contacts_of({box(0, 0, 0, 1, 1, 1), box(0.5, 0, 0, 2, 1, 1)}).empty());    // flush sides of solids that overlap
  // The same turned in space.
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, -1)), 1.1);
  const auto turned = contacts_of({box(0, 0, 0, 4, 4, 1).Moved(TopLoc_Location(turn)), box(2.5, 1, 1, 2, 2, 2).Moved(TopLoc_Location(turn))});
  ASSERT_EQ(turned.size(), 1U);
  EXPECT_NEAR(turned[0].area, 3, 1e-9);
}

TEST(Contacts, OfABoltInAHole) {
  // A shaft of radius 1/2 through a plate of height 1, with a head of radius 1 on the plate.
  const TopoDS_Shape plate = BRepAlgoAPI_Cut(box(-2, -2, 0, 4, 4, 1), cylinder(0, 0, -1, 0.5, 3)).Shape();
  const auto shaft = contacts_of({plate, cylinder(0, 0, -1, 0.5, 4)});
  ASSERT_EQ(shaft.size(), 1U);
  EXPECT_NEAR(shaft[0].area, pi, 1e-6);  // 2 pi r h
  const auto head = contacts_of({plate, cylinder(0, 0, 1, 1, 1)});
  ASSERT_EQ(head.size(), 1U);
  EXPECT_NEAR(head[0].area, 0.75 * pi, 0.75 * pi * 3e-4);
  // A shaft that ends inside the hole: half of its side is in contact.
  const auto part = contacts_of({plate, cylinder(0, 0, 0.5, 0.5, 2)});
  ASSERT_EQ(part.size(), 1U);
  EXPECT_NEAR(part[0].area, pi / 2, 0.05 * pi / 2);
}

TEST(Contacts, OfASphereInItsSocket) {
  const TopoDS_Shape tool = BRepPrimAPI_MakeSphere(1).Shape(), ball = BRepPrimAPI_MakeSphere(1).Shape();
  const TopoDS_Shape socket = BRepAlgoAPI_Cut(box(-2, -2, -2, 4, 4, 4), tool).Shape();
  EXPECT_TRUE(contacts_of({socket, tool}).empty());  // one face of both
  const auto contacts = contacts_of({socket, ball});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].area, 4 * pi, 4 * pi * 1e-6);
}

// 1000 unit cubes in a block: 2700 contacts of area 1.
TEST(Contacts, OfAThousandParts) {
  std::vector<TopoDS_Shape> cubes;
  for (int i = 0; i < 1000; ++i) cubes.push_back(box(i % 10, i / 10 % 10, i / 100, 1, 1, 1));
  const ShapeFile file = file_of_parts(cubes);
  const carreau_occ::Solids solids = carreau_occ::solids_of(file);
  const auto start = std::chrono::steady_clock::now();
  const auto contacts = carreau_occ::find_face_contacts(file, solids);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("2700 contacts of 1000 parts: %.2f s\n", seconds.count());
  ASSERT_EQ(contacts.size(), 2700U);
  for (const FaceContact& contact : contacts) EXPECT_NEAR(contact.area, 1, 1e-9);
}

/// Domains of planes, cylinders and spheres with round holes and crossing cuts, also beyond their boxes.
TEST(Contacts, StatesOfPointsMatchTheClassifier) {
  TopoDS_Shape body = BRepAlgoAPI_Cut(box(0, 0, 0, 3, 2, 1), cylinder(1, 1, -1, 0.4, 3)).Shape();
  body = BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeSphere(gp_Pnt(2.2, 1, 1), 0.6).Shape()).Shape();
  body = BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-1, 1, 0.6), gp_Dir(1, 0, 0)), 0.3, 5).Shape()).Shape();
  std::mt19937 dice(7);
  const auto share = [&] { return static_cast<double>(dice()) / 4294967295.0 * 1.2 - 0.1; };
  int inside = 0, outside = 0;
  for (TopExp_Explorer faces(body, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    carreau_occ::DomainCells cells(face);
    const BRepTopAdaptor_FClass2d classifier(face, Precision::PConfusion());
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    for (int k = 0; k < 2000; ++k) {
      const double u = u0 + (u1 - u0) * share(), v = v0 + (v1 - v0) * share();
      const TopAbs_State state = classifier.Perform(gp_Pnt2d(u, v));
      ASSERT_EQ(cells.state(gp_Pnt2d(u, v)), state) << u << " " << v;
      ++(state == TopAbs_IN ? inside : outside);
    }
  }
  EXPECT_GT(inside, 2000);
  EXPECT_GT(outside, 2000);
}

}  // namespace contact_tests
