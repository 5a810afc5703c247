// SPDX-License-Identifier: BSD-3-Clause
#include "solids.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>

#include "extent.h"
#include "faults.h"

namespace carreau_occ {
namespace {

/// Points of each edge, both ends included.
constexpr int edge_points = 9;
/// Points of a solid that are classified against another solid.
constexpr std::size_t points_of_pair = 24;
/// Classifications in all: about two seconds.
constexpr int max_classifications = 10'000;
/// Share of the diagonal within which surfaces are at one place.
constexpr double contact_tolerance = 1e-6;

class ContactFinder {
 public:
  explicit ContactFinder(const ShapeFile& file) : tolerance_(contact_tolerance * diagonal_of(file.shape)) {
    TopExp::MapShapes(file.shape, TopAbs_SOLID, solids_);
    tolerance_ = std::max(tolerance_, Precision::Confusion());
    for (int s = 1; s <= solids_.Extent(); ++s) {
      Looked& solid = looked_.emplace_back();
      guard([&] { BRepBndLib::Add(solids_(s), solid.box, Standard_False); });
      if (!solid.box.IsVoid()) solid.box.Enlarge(tolerance_);
    }
  }

  SolidContacts run() {
    for (const auto& pair : pairs_of_boxes()) {
      if (classifications_ >= max_classifications) {
        ++found_.untested;
        continue;
      }
      guard([&] { compare(pair[0], pair[1]); });
    }
    std::sort(found_.contacts.begin(), found_.contacts.end(),
              [](const SolidContact& p, const SolidContact& q) { return p.solids < q.solids; });
    return std::move(found_);
  }

 private:
  struct Looked {
    Bnd_Box box;
    std::vector<gp_Pnt> points;  // on edges; computed on first use
    bool sampled = false;
    std::unique_ptr<BRepClass3d_SolidClassifier> classifier;
  };

  template <typename Body>
  void guard(Body&& body) {
    try {
      guarded(body);
    } catch (const Standard_Failure&) {
      return;  // this solid, or pair, has no contact
    }
  }

  /// Sorted along x: only boxes that meet there are compared.
  [[nodiscard]] std::vector<std::array<int, 2>> pairs_of_boxes() const {
    std::vector<int> order;
    for (int s = 0; s < static_cast<int>(looked_.size()); ++s)
      if (!looked_[static_cast<std::size_t>(s)].box.IsVoid()) order.push_back(s);
    const auto low = [&](int s) { return box(s).CornerMin().X(); };
    std::stable_sort(order.begin(), order.end(), [&](int s, int t) { return low(s) < low(t); });
    std::vector<std::array<int, 2>> pairs;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size() && low(order[k]) <= box(order[i]).CornerMax().X(); ++k)
        if (!box(order[i]).IsOut(box(order[k])))
          pairs.push_back({std::min(order[i], order[k]), std::max(order[i], order[k])});
    return pairs;
  }
  [[nodiscard]] const Bnd_Box& box(int s) const { return looked_[static_cast<std::size_t>(s)].box; }

  void sample(int s) {
    Looked& solid = looked_[static_cast<std::size_t>(s)];
    solid.sampled = true;
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(solids_(s + 1), TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e) {
      const TopoDS_Edge edge = TopoDS::Edge(edges(e));
      if (BRep_Tool::Degenerated(edge)) continue;
      const BRepAdaptor_Curve curve(edge);
      const double a = curve.FirstParameter(), b = curve.LastParameter();
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      for (int i = 0; i < edge_points; ++i) solid.points.push_back(curve.Value(a + (b - a) * i / (edge_points - 1)));
    }
  }

  [[nodiscard]] bool share_a_face(int a, int b) const {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(solids_(a + 1), TopAbs_FACE, faces);
    for (TopExp_Explorer f(solids_(b + 1), TopAbs_FACE); f.More(); f.Next())
      if (faces.Contains(f.Current())) return true;
    return false;
  }

  void compare(int a, int b) {
    if (share_a_face(a, b)) return;
    SolidContact contact{.solids = {a + 1, b + 1}};
    bool any = false;
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}}) {
      any = classify(from, to, contact) || any;
      if (contact.overlap) break;
    }
    if (any) found_.contacts.push_back(contact);
  }

  /// True if a point of an edge of `from` lies on or in `to`.
  bool classify(int from, int to, SolidContact& contact) {
    Looked &mine = looked_[static_cast<std::size_t>(from)], &other = looked_[static_cast<std::size_t>(to)];
    if (!mine.sampled) sample(from);
    std::vector<gp_Pnt> inside;
    for (const gp_Pnt& p : mine.points)
      if (!other.box.IsOut(p)) inside.push_back(p);
    if (inside.empty()) return false;
    if (!other.classifier) other.classifier = std::make_unique<BRepClass3d_SolidClassifier>(solids_(to + 1));
    const std::size_t n = std::min(inside.size(), points_of_pair);
    bool any = false;
    for (std::size_t k = 0; k < n; ++k) {
      const gp_Pnt& p = inside[k * inside.size() / n];
      other.classifier->Perform(p, tolerance_);
      ++classifications_;
      const TopAbs_State state = other.classifier->State();
      if (state != TopAbs_IN && state != TopAbs_ON) continue;
      if (!any || state == TopAbs_IN) contact.place = {p.X(), p.Y(), p.Z()};
      any = true;
      if (state == TopAbs_IN) return contact.overlap = true;
    }
    return any;
  }

  TopTools_IndexedMapOfShape solids_;
  double tolerance_;
  std::vector<Looked> looked_;
  SolidContacts found_;
  int classifications_ = 0;
};

void make_distinct(std::vector<std::string>& names) {
  std::set<std::string> taken(names.begin(), names.end());
  std::map<std::string, int> used;
  for (std::string& name : names) {
    if (name.empty() || used[name]++ == 0) continue;
    const std::string base = name;
    do name = base + "_" + std::to_string(used[base]++);
    while (!taken.insert(name).second);
    --used[base];
  }
}

}  // namespace

Solids solids_of(const ShapeFile& file) {
  TopTools_IndexedMapOfShape faces, solids;
  TopExp::MapShapes(file.shape, TopAbs_FACE, faces);
  TopExp::MapShapes(file.shape, TopAbs_SOLID, solids);
  Solids found{.of_face = std::vector<std::array<int, 2>>(static_cast<std::size_t>(faces.Extent())),
               .names = std::vector<std::string>(static_cast<std::size_t>(solids.Extent()))};
  for (int s = 1; s <= solids.Extent(); ++s)
    for (TopExp_Explorer f(solids(s), TopAbs_FACE); f.More(); f.Next())
      if (const int number = faces.FindIndex(f.Current()); number > 0) {
        // The map has the face as its first solid uses it.
        std::array<int, 2>& sides = found.of_face[static_cast<std::size_t>(number - 1)];
        int& side = f.Current().Orientation() == faces(number).Orientation() ? sides[0] : sides[1];
        if (side == 0) side = s;
      }
  for (const ShapeFile::Label& label : file.labels)
    if (const int s = solids.FindIndex(label.part); s > 0 && !label.name.empty())
      found.names[static_cast<std::size_t>(s - 1)] = label.name;
  make_distinct(found.names);
  return found;
}

SolidContacts find_contacts(const ShapeFile& file) { return ContactFinder(file).run(); }

}  // namespace carreau_occ
