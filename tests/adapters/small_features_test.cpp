// SPDX-License-Identifier: BSD-3-Clause
// Features that are smaller than a length are found and removed: volumes in closed form.
#include <changes/small_features.h>
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Ax2.hxx>
#include <map>
#include <numbers>
#include <string>

#include "measured_mesh.h"

namespace small_feature_tests {

using carreau_occ::ShapeFile;
using carreau_occ::SmallFeature;
using std::numbers::pi;

TopoDS_Shape block() { return BRepPrimAPI_MakeBox(10, 8, 6).Shape(); }

TopoDS_Shape upright(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

double volume_of_shape(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

ShapeFile file_of_shape(const TopoDS_Shape& shape) {
  ShapeFile file;
  file.shape = shape;
  return file;
}

std::map<std::string, int> removed_of(const std::vector<SmallFeature>& features) {
  std::map<std::string, int> count;
  for (const SmallFeature& feature : features) count[feature.kind] += feature.removed ? 1 : 0;
  return count;
}

/// Edges of the block that are parallel to z.
template <typename Tool>
void add_upright_edges(const TopoDS_Shape& shape, Tool&& add) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int e = 1; e <= edges.Extent(); ++e) {
    const gp_Pnt p = BRep_Tool::Pnt(TopExp::FirstVertex(TopoDS::Edge(edges(e)))), q = BRep_Tool::Pnt(TopExp::LastVertex(TopoDS::Edge(edges(e))));
    if (std::abs(p.Z() - q.Z()) > 1) add(TopoDS::Edge(edges(e)));
  }
}

void expect_block(const ShapeFile& file, double volume) {
  EXPECT_NEAR(volume_of_shape(file.shape), volume, 1e-6 * volume);
  carreau_occ::BrepHost host(file);
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 1);
  EXPECT_EQ(m.trouble(true), "");
}

// Holes of diameter 1 (through), .8 (blind, flat) and 3; a pin of diameter .6.
TEST(SmallFeatures, HolesAndBosses) {
  TopoDS_Shape shape = BRepAlgoAPI_Cut(block(), upright(2, 2, -1, 0.5, 9)).Shape();
  shape = BRepAlgoAPI_Cut(shape, upright(2, 6, 4, 0.4, 3)).Shape();
  shape = BRepAlgoAPI_Cut(shape, upright(6, 4, -1, 1.5, 9)).Shape();
  shape = BRepAlgoAPI_Fuse(shape, upright(9, 1, 5.5, 0.3, 1.5)).Shape();
  ShapeFile file = file_of_shape(shape);
  const std::vector<SmallFeature> found = carreau_occ::find_small_features(file, 1.5);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].kind, "hole");
  EXPECT_EQ(found[2].kind, "boss");
  EXPECT_NEAR(std::min(found[0].size, found[1].size), 0.8, 1e-9);
  EXPECT_NEAR(std::max(found[0].size, found[1].size), 1, 1e-9);
  EXPECT_NEAR(found[2].size, 0.6, 1e-9);
  EXPECT_EQ(removed_of(carreau_occ::remove_small_features(file, 1.5, {})), (std::map<std::string, int>{{"boss", 1}, {"hole", 2}}));
  expect_block(file, 480 - pi * 1.5 * 1.5 * 6);
}

// Counterbored: both cylinders and the ring between them are one feature.
TEST(SmallFeatures, CounterboresAreOneHole) {
  TopoDS_Shape shape = BRepAlgoAPI_Cut(block(), upright(4, 4, -1, 0.3, 9)).Shape();
  shape = BRepAlgoAPI_Cut(shape, upright(4, 4, 5, 0.6, 2)).Shape();
  ShapeFile file = file_of_shape(shape);
  const std::vector<SmallFeature> features = carreau_occ::remove_small_features(file, 1.5, {});
  EXPECT_EQ(removed_of(features)["hole"], static_cast<int>(features.size()));
  expect_block(file, 480);
}

TEST(SmallFeatures, FilletsAndChamfers) {
  const TopoDS_Shape box = block();
  BRepFilletAPI_MakeFillet fillets(box);
  add_upright_edges(box, [&](const TopoDS_Edge& edge) { fillets.Add(0.5, edge); });
  ShapeFile round = file_of_shape(fillets.Shape());
  EXPECT_NEAR(volume_of_shape(round.shape), 480 - 6 * (4 - pi) * 0.25, 1e-9);
  EXPECT_EQ(removed_of(carreau_occ::remove_small_features(round, 0.6, {})), (std::map<std::string, int>{{"fillet", 4}}));
  expect_block(round, 480);
  BRepFilletAPI_MakeChamfer chamfers(box);
  add_upright_edges(box, [&](const TopoDS_Edge& edge) { chamfers.Add(0.3, edge); });
  ShapeFile blunt = file_of_shape(chamfers.Shape());
  EXPECT_NEAR(volume_of_shape(blunt.shape), 480 - 4 * 6 * 0.045, 1e-9);
  EXPECT_EQ(removed_of(carreau_occ::remove_small_features(blunt, 0.6, {})), (std::map<std::string, int>{{"chamfer", 4}}));
  expect_block(blunt, 480);
}

// All that is larger stays, and so does a plate that is thinner than the length.
TEST(SmallFeatures, LargerOnesAndThinPlatesStay) {
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(block(), upright(4, 4, -1, 1, 9)).Shape();
  ShapeFile file = file_of_shape(shape);
  EXPECT_TRUE(carreau_occ::remove_small_features(file, 1.9, {}).empty());
  EXPECT_TRUE(file.shape.IsSame(shape));
  ShapeFile plate = file_of_shape(BRepPrimAPI_MakeBox(10, 8, 0.2).Shape());
  for (const SmallFeature& feature : carreau_occ::remove_small_features(plate, 0.5, {})) EXPECT_FALSE(feature.removed);
  expect_block(plate, 16);
}

TEST(SmallFeatures, NamesStay) {
  ShapeFile file = file_of_shape(BRepAlgoAPI_Cut(block(), upright(2, 2, -1, 0.5, 9)).Shape());
  TopExp_Explorer faces(file.shape, TopAbs_FACE);
  file.labels.push_back({.part = faces.Current(), .name = "side"});
  carreau_occ::remove_small_features(file, 1.5, {});
  const carreau_occ::BrepHost host(file);
  int named = 0;
  for (int f = 1; f <= host.face_count(); ++f) named += host.face_name(f) == "side" ? 1 : 0;
  EXPECT_EQ(named, 1);
}

}  // namespace small_feature_tests
