// SPDX-License-Identifier: BSD-3-Clause
// Functions that the readers of solvers' files share: nodes and elements by number, named sets, fields between commas.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/solid_skin.h"
#include "io/text.h"
#include "io/words.h"
#include "mesh/flat_mesh.h"

namespace carreau {

/// Throws FileError if `text`, which `in` reads, has a zero byte: names would end there in other files.
void refuse_zero_bytes(const Words& in, std::string_view text);

/// Returns 7 for "face_7" if `before` is "face_", and -7 for "face_m7", capitals or not; false: a different name.
bool reference_in(std::string_view name, std::string_view before, std::int32_t& ref);

/// Returns the text before the first comma, without blanks; removes it and the comma from the line.
std::string_view next_field(std::string_view& line) noexcept;

/// Nodes with numbers of a file's own; vertices get the order of these numbers. Keeps a reference to `in`.
class SolverNodes {
 public:
  explicit SolverNodes(const Words& in) : in_(in) {}

  /// `at`: its place in the text. Throws FileError if the number comes twice.
  void add(std::int64_t number, const Vec3& p, const char* at);
  /// All vertices, once. Throws FileError when there are none.
  void give_to(FlatMesh& mesh);
  /// After give_to(): the vertex, from 0. Throws FileError if there is no such vertex.
  [[nodiscard]] std::int32_t vertex(std::int64_t number, const char* at) const;

 private:
  const Words& in_;
  std::map<std::int64_t, Vec3> nodes_;
  std::unordered_map<std::int64_t, std::int32_t> vertices_;
};

struct SolverElement {
  std::int64_t number = 0;
  std::vector<std::int64_t> nodes;  ///< 3, 4, 6 or 8: corners, then nodes on sides; of a solid as SolidSkin has them
  std::string set;                  ///< that it names itself; "": none
  const char* at = nullptr;         ///< its place in the text
  std::optional<SolidShape> solid = {};  ///< nothing: an element of a surface
};

/// Elements, and the sets that they are in. Sets become faces: "face_7" has reference 7 ("face_m7": -7), others get the numbers
/// behind the largest one in their order. A set of sets names their faces. Names differ in more than capitals. Solids count when
/// there is no other element: their outer faces are the surface. Keeps a reference to `in`.
class SolverGroups {
 public:
  explicit SolverGroups(const Words& in) : in_(in) {}

  void add(const SolverElement& element) { elements_.push_back(element); }
  void add_set_to(const std::string& set, const std::string& other) { of_sets_.push_back({set, in_capitals(other)}); }
  /// Elements first, first + step, ... up to last.
  void add_range_to(const std::string& set, std::int64_t first, std::int64_t last, std::int64_t step) {
    ranges_.push_back({set, first, last, step});
  }
  /// Sets the reference of a set in place of the rules above.
  void set_ref(const std::string& set, std::int32_t ref) { refs_[in_capitals(set)] = ref; }
  /// All elements and faces. Throws FileError.
  void give_to(FlatMesh& mesh, const SolverNodes& nodes);

 private:
  struct OfSet {
    std::string set, other;
  };
  struct Range {
    std::string set;
    std::int64_t first, last, step;
  };

  void take_ranges();
  void number_sets();
  void name_faces(FlatMesh& mesh) const;

  const Words& in_;
  std::vector<SolverElement> elements_;
  std::vector<OfSet> of_sets_;
  std::vector<Range> ranges_;
  std::map<std::string, std::int32_t> refs_;    ///< by name in capitals
  std::map<std::int32_t, std::string> names_;   ///< of faces whose name is not made of their reference
};

}  // namespace carreau
