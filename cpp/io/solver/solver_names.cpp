// SPDX-License-Identifier: BSD-3-Clause
#include "io/solver/solver_names.h"

#include <algorithm>
#include <limits>
#include <set>

#include "io/element_lists.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

template <std::size_t N>
void append(const SolverElement& element, std::int32_t ref, const SolverNodes& nodes, ElementList<N>& list) {
  auto& own = list.nodes.emplace_back();
  for (std::size_t k = 0; k < N; ++k) own[k] = nodes.vertex(element.nodes[k], element.at);
  list.refs.push_back(ref);
}

}  // namespace

void refuse_zero_bytes(const Words& in, std::string_view text) {
  const std::size_t at = text.find('\0');
  if (at != std::string_view::npos) in.fail(text.data() + at, "a byte of value zero stands here: this is not a text");
}

bool reference_in(std::string_view name, std::string_view before, std::int32_t& ref) {
  if (in_capitals(name.substr(0, before.size())) != in_capitals(before)) return false;
  name.remove_prefix(std::min(before.size(), name.size()));
  const bool minus = name.starts_with('m') || name.starts_with('M');
  if (minus) name.remove_prefix(1);
  int n = 0;
  if (name.empty() || name.front() < '0' || name.front() > '9' || !parse_number(name, n)) return false;
  ref = minus ? -n : n;
  return true;
}

std::string_view next_field(std::string_view& line) noexcept {
  const std::size_t comma = line.find(',');
  const std::string_view field = trimmed(line.substr(0, comma));
  line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  if (trimmed(line).empty()) line = {};
  return field;
}

void SolverNodes::add(std::int64_t number, const Vec3& p, const char* at) {
  if (!nodes_.emplace(number, p).second) in_.fail(at, "node " + std::to_string(number) + " comes twice");
}

void SolverNodes::give_to(FlatMesh& mesh) {
  if (nodes_.empty()) in_.fail(in_.end(), "the file has no nodes");
  if (nodes_.size() > std::size_t(std::numeric_limits<std::int32_t>::max())) in_.fail(in_.end(), "there are too many nodes");
  for (const auto& [number, p] : nodes_) {
    vertices_.emplace(number, static_cast<std::int32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(p);
  }
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
}

std::int32_t SolverNodes::vertex(std::int64_t number, const char* at) const {
  const auto found = vertices_.find(number);
  if (found == vertices_.end()) in_.fail(at, "node " + std::to_string(number) + " is named, and the file does not have it");
  return found->second;
}

/// Elements that name no set belong to the set of the first list that has them.
void SolverGroups::take_ranges() {
  std::map<std::int64_t, std::size_t> free;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (elements_[i].set.empty()) free.emplace(elements_[i].number, i);
  for (const Range& range : ranges_)
    for (auto at = free.lower_bound(range.first); at != free.end() && at->first <= range.last;) {
      const bool inside = (at->first - range.first) % range.step == 0;
      if (inside) elements_[at->second].set = range.set;
      at = inside ? free.erase(at) : std::next(at);
    }
}

void SolverGroups::number_sets() {
  std::int32_t last = 0;
  std::vector<std::string> others;
  for (const SolverElement& element : elements_) {
    const std::string name = in_capitals(element.set);
    std::int32_t ref = 0;
    if (element.set.empty() || refs_.contains(name)) continue;
    if (reference_in(name, "face_", ref))
      refs_[name] = ref;
    else
      refs_[name] = 0, others.push_back(element.set);
  }
  for (const auto& [name, ref] : refs_) last = std::max(last, ref);
  for (const std::string& name : others) {
    if (last == std::numeric_limits<std::int32_t>::max()) in_.fail(in_.end(), "references of faces have no number left");
    refs_[in_capitals(name)] = ++last;
    names_[last] = name;
  }
  for (const OfSet& each : of_sets_)
    if (const auto found = refs_.find(each.other); found != refs_.end() && in_capitals(each.set) != "ALL_FACES")
      names_.emplace(found->second, each.set);
}

void SolverGroups::name_faces(FlatMesh& mesh) const {
  const std::set<std::int32_t> meshed(mesh.triangle_refs.begin(), mesh.triangle_refs.end());
  for (const auto& [ref, name] : names_)
    if (meshed.contains(ref)) mesh.faces.push_back({.ref = ref, .status = FaceStatus::meshed, .name = name});
}

void SolverGroups::give_to(FlatMesh& mesh, const SolverNodes& nodes) {
  if (std::ranges::any_of(elements_, [](const SolverElement& each) { return !each.solid; }))
    std::erase_if(elements_, [](const SolverElement& each) { return each.solid.has_value(); });
  take_ranges();
  number_sets();
  ElementLists lists;
  SolidSkin skin;
  for (const SolverElement& element : elements_) {
    const auto found = refs_.find(in_capitals(element.set));
    const std::int32_t ref = found == refs_.end() ? 0 : found->second;
    if (element.solid) {
      std::vector<std::int32_t> own;
      for (const std::int64_t number : element.nodes) own.push_back(nodes.vertex(number, element.at));
      if (own.size() == 4) mesh.tetrahedra.push_back({own[0], own[1], own[2], own[3]});
      skin.add(*element.solid, own, ref);
      continue;
    }
    if (element.nodes.size() == 3) append(element, ref, nodes, lists.triangles);
    if (element.nodes.size() == 4) append(element, ref, nodes, lists.quads);
    if (element.nodes.size() == 6) append(element, ref, nodes, lists.triangles6);
    if (element.nodes.size() == 8) append(element, ref, nodes, lists.quads8);
  }
  if (!skin.empty()) skin.give_to(lists, mesh.vertices);
  try {
    set_elements(lists, mesh);
  } catch (const InvalidArgument& error) {
    in_.fail(in_.end(), error.what());
  }
  name_faces(mesh);
}

}  // namespace carreau
