// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tessellated/tessellated_assembly.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace command {

std::array<double, 3> Placement::operator()(const std::array<double, 3>& x) const {
  std::array<double, 3> y = origin;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) y[i] += axes[i][j] * x[j];
  return y;
}

Placement Placement::operator*(const Placement& inner) const {
  Placement both;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      both.axes[i][j] = 0;
      for (std::size_t k = 0; k < 3; ++k) both.axes[i][j] += axes[i][k] * inner.axes[k][j];
    }
  both.origin = (*this)(inner.origin);
  return both;
}

Placement Placement::inverse() const {
  Placement back;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) back.axes[i][j] = axes[j][i];
  const std::array<double, 3> moved = back(origin);
  for (std::size_t i = 0; i < 3; ++i) back.origin[i] = -moved[i];
  return back;
}

namespace {

constexpr int max_components = 1'000'000;  // a cycle is found before; nested patterns multiply
constexpr std::size_t max_levels = 1'000;     // of assemblies in assemblies; the walk over them recurs
constexpr double parallel = 1e-9;           // sine of the angle between two directions

using Record = StepRecords::Record;
using Direction = std::array<double, 3>;

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Direction cross(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class Assembly {
 public:
  explicit Assembly(const StepRecords& records) : records_(records) {}

  std::vector<PlacedItem> run() {
    for (const auto& [number, record] : records_.all()) {
      join_same(number, record);
      if (has_items(record)) items_[number] = StepRecords::references(records_.argument(number, record, 1));
    }
    for (const auto& [number, record] : records_.all()) find_components(number, record);
    if (components_.empty()) return {};
    for (const auto& [number, items] : items_) members_[set_of(number)].push_back(number);
    std::set<int> below;
    for (const auto& [parent, all] : components_)
      for (const Component& component : all) below.insert(component.child);
    for (const auto& [set, members] : members_)
      if (below.count(set) == 0) place(set, {});
    for (const auto& [set, all] : components_)  // assemblies without items of their own
      if (below.count(set) == 0 && members_.count(set) == 0) place(set, {});
    for (const auto& [set, all] : components_)  // of no root
      if (reached_.count(set) == 0) fail_as_cycle(all.front());
    return std::move(placed_);
  }

 private:
  struct Component {
    int child = 0, entity = 0;
    Placement placement;
  };

  static bool has_items(const Record& record) {
    return record.type.ends_with("REPRESENTATION") && record.type != "SHAPE_DEFINITION_REPRESENTATION" &&
           record.type != "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION" &&
           record.type != "PROPERTY_DEFINITION_REPRESENTATION";
  }

  /// Representations, and products that they define: all of them are one thing in one frame.
  int set_of(int number) {
    int root = parent_.try_emplace(number, number).first->second;
    while (parent_.at(root) != root) root = parent_.at(root);
    while (number != root) number = std::exchange(parent_.at(number), root);
    return root;
  }
  void join(int a, int b) {
    if (a != 0 && b != 0) parent_[set_of(a)] = set_of(b);
  }

  /// The product that PRODUCT_DEFINITION_SHAPE `shape` is about; 0 for an occurrence in an assembly.
  [[nodiscard]] int defined_by(int shape, int from) const {
    const Record& record = records_.at(shape, from);
    return record.type == "PRODUCT_DEFINITION_SHAPE" ? StepRecords::reference(records_.argument(shape, record, 2)) : 0;
  }

  void join_same(int number, const Record& record) {
    if (record.type == "SHAPE_DEFINITION_REPRESENTATION") {
      const int product = defined_by(StepRecords::reference(records_.argument(number, record, 0)), number);
      join(StepRecords::reference(records_.argument(number, record, 1)), product);
      return;
    }
    if (!StepRecords::part(record, "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION").type.empty()) return;
    for (const std::string_view type : {"SHAPE_REPRESENTATION_RELATIONSHIP", "REPRESENTATION_RELATIONSHIP"}) {
      const Record relation = StepRecords::part(record, type);
      if (relation.type.empty() || StepRecords::split(relation.arguments).size() < 4) continue;
      join(StepRecords::reference(records_.argument(number, relation, 2)),
           StepRecords::reference(records_.argument(number, relation, 3)));
      return;
    }
  }

  void find_components(int number, const Record& record) {
    if (record.type == "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") add_occurrence(number, record);
    const auto items = items_.find(number);
    if (items == items_.end()) return;
    for (const int item : items->second) {
      const auto found = records_.all().find(item);
      if (found != records_.all().end() && found->second.type == "MAPPED_ITEM") add_mapped(number, item, found->second);
    }
  }

  void add_occurrence(int number, const Record& record) {
    const int relation = StepRecords::reference(records_.argument(number, record, 0));
    const int occurrence = defined_by(StepRecords::reference(records_.argument(number, record, 1)), number);
    const Record& whole = records_.at(relation, number);
    const Record ends = StepRecords::part(whole, "REPRESENTATION_RELATIONSHIP");
    const Record move = StepRecords::part(whole, "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION");
    const Record& use = records_.at(occurrence, number);
    if (use.type != "NEXT_ASSEMBLY_USAGE_OCCURRENCE") records_.fail(number, "it is about no component of an assembly");
    if (ends.type.empty() || move.type.empty()) records_.fail(relation, "the placement of a component is missing");
    const int transformation = StepRecords::reference(records_.argument(relation, move, 0));
    const Record& axes = records_.at(transformation, relation);
    if (axes.type != "ITEM_DEFINED_TRANSFORMATION")
      records_.fail(transformation, "only ITEM_DEFINED_TRANSFORMATION places a component here");
    const Placement first = frame(StepRecords::reference(records_.argument(transformation, axes, 2)), transformation);
    const Placement second = frame(StepRecords::reference(records_.argument(transformation, axes, 3)), transformation);
    const int rep1 = set_of(StepRecords::reference(records_.argument(relation, ends, 2)));
    const int parent = set_of(StepRecords::reference(records_.argument(occurrence, use, 3)));
    const int child = set_of(StepRecords::reference(records_.argument(occurrence, use, 4)));
    // Either representation may be the component's.
    const bool swapped = rep1 == parent && rep1 != child;
    components_[parent].push_back(
        {child, occurrence, swapped ? first * second.inverse() : second * first.inverse()});
  }

  void add_mapped(int representation, int item, const Record& record) {
    const int map = StepRecords::reference(records_.argument(item, record, 1));
    const Record& source = records_.at(map, item);
    if (source.type != "REPRESENTATION_MAP") records_.fail(item, "it maps no representation");
    const Placement origin = frame(StepRecords::reference(records_.argument(map, source, 0)), map);
    const Placement target = frame(StepRecords::reference(records_.argument(item, record, 2)), item);
    const int mapped = set_of(StepRecords::reference(records_.argument(map, source, 1)));
    components_[set_of(representation)].push_back({mapped, item, target * origin.inverse()});
  }

  [[nodiscard]] Direction triple(int number, int from, std::string_view type) const {
    const Record& record = records_.at(number, from);
    if (record.type != type) records_.fail(number, "it is not a " + std::string(type));
    const std::vector<double> x = records_.numbers(records_.argument(number, record, 1), number);
    if (x.size() != 3) records_.fail(number, "it has no three coordinates");
    for (const double value : x)
      if (!std::isfinite(value)) records_.fail(number, "a coordinate is not finite");
    return {x[0], x[1], x[2]};
  }

  [[nodiscard]] Direction direction(int number, int from) const {
    Direction d = triple(number, from, "DIRECTION");
    const double length = std::sqrt(dot(d, d));
    if (!(length > 0) || !std::isfinite(length)) records_.fail(number, "the direction has no length");
    for (double& x : d) x /= length;
    return d;
  }

  /// From the coordinates of an AXIS2_PLACEMENT_3D to those in which it is given.
  [[nodiscard]] Placement frame(int number, int from) const {
    const Record& record = records_.at(number, from);
    if (record.type != "AXIS2_PLACEMENT_3D") records_.fail(number, "a component is placed by no AXIS2_PLACEMENT_3D");
    const std::vector<std::string_view> all = StepRecords::split(record.arguments);
    const auto given = [&](std::size_t rank) { return rank < all.size() ? StepRecords::reference(all[rank]) : 0; };
    const Direction z = given(2) != 0 ? direction(given(2), number) : Direction{0, 0, 1};
    Direction x = given(3) != 0 ? direction(given(3), number) : Direction{1, 0, 0};
    Direction y = cross(z, x);
    if (!(std::sqrt(dot(y, y)) > parallel)) {
      if (given(3) != 0) records_.fail(number, "its two directions are parallel");
      x = {0, 1, 0}, y = cross(z, x);
    }
    const double length = std::sqrt(dot(y, y));
    for (double& value : y) value /= length;
    x = cross(y, z);
    Placement placement{.origin = triple(given(1), number, "CARTESIAN_POINT")};
    for (std::size_t i = 0; i < 3; ++i) placement.axes[i] = {x[i], y[i], z[i]};
    return placement;
  }

  [[noreturn]] void fail_as_cycle(const Component& component) const {
    records_.fail(component.entity, "the assembly is a part of itself");
  }

  void place(int set, const Placement& placement) {
    for (const int representation : members_[set])
      for (const int item : items_[representation]) placed_.push_back({item, placement});
    const auto found = components_.find(set);
    if (found == components_.end()) return;
    open_.insert(set), reached_.insert(set);
    for (const Component& component : found->second) {
      if (open_.count(component.child) != 0) fail_as_cycle(component);
      if (open_.size() > max_levels) records_.fail(component.entity, "assemblies are nested over a thousand times");
      if (++count_ > max_components) records_.fail(component.entity, "the assembly has over a million components");
      place(component.child, placement * component.placement);
    }
    open_.erase(set);
  }

  const StepRecords& records_;
  std::map<int, int> parent_;                           // of representations and products that are one
  std::map<int, std::vector<int>> items_;               // by representation
  std::map<int, std::vector<int>> members_;             // representations by set
  std::map<int, std::vector<Component>> components_;    // by set
  std::set<int> open_, reached_;                        // sets that are being placed; sets that have components
  std::vector<PlacedItem> placed_;
  int count_ = 0;
};

}  // namespace

std::vector<PlacedItem> placed_items(const StepRecords& records) { return Assembly(records).run(); }

}  // namespace command
