// SPDX-License-Identifier: BSD-3-Clause
// Whole numbers beyond 32 bits in text: they are never truncated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

struct TextFormat {
  const char* name;
  MeshFormat format;
  FlatMesh (*read)(std::string_view, const std::string&);
};

const std::vector<TextFormat> text_formats{
    {"mesh", MeshFormat::mesh, read_mesh_text}, {"msh", MeshFormat::msh, read_mesh_msh},   {"msh2", MeshFormat::msh2, read_mesh_msh},
    {"inp", MeshFormat::inp, read_mesh_inp},    {"bdf", MeshFormat::bdf, read_mesh_bdf},   {"unv", MeshFormat::unv, read_mesh_unv},
    {"su2", MeshFormat::su2, read_mesh_su2},    {"off", MeshFormat::off, read_mesh_off},   {"obj", MeshFormat::obj, read_mesh_obj},
    {"bl2d", MeshFormat::bl2d, read_mesh_bl2d}, {"vtu", MeshFormat::vtu, read_mesh_vtu}};

/// A whole number in a text.
struct Token {
  std::size_t begin = 0, size = 0;
};

std::vector<Token> whole_numbers(const std::string& text) {
  std::vector<Token> tokens;
  const auto is_part = [&](std::size_t i) { return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.' || text[i] == '-' || text[i] == '+' || text[i] == '_'); };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    bool digits = true;
    for (; is_part(end); ++end) digits = digits && std::isdigit(static_cast<unsigned char>(text[end])) != 0;
    if (end > i && digits && end - i < 6) tokens.push_back({i, end - i});
    i = std::max(end, i + 1);
  }
  return tokens;
}

std::optional<FlatMesh> read(const TextFormat& format, std::string text) {
  try {
    return format.read(text, "x");
  } catch (const FileError&) {
    return {};
  }
}

bool same(const FlatMesh& a, const FlatMesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && a.edges == b.edges && a.triangle_refs == b.triangle_refs &&
         a.edge_refs == b.edge_refs && a.vertex_refs == b.vertex_refs;
}

void expect_sound(const FlatMesh& mesh, const std::string& what) {
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) {
      EXPECT_GE(v, 0) << what;
      EXPECT_LT(static_cast<std::size_t>(v), mesh.vertices.size()) << what;
    }
}

// k becomes 2^32 + k, of which the lower half is k; and 2^31, 2^63, 2^64 + k. Numbers that mean nothing may be anything.
TEST(LargeNumbers, AreNeverReadAsTheirLowerBits) {
  FlatMesh mesh = square();
  mesh.triangle_refs = {7, 2};
  for (Vec3& p : mesh.vertices) p.z() = 0;  // .bl2d knows a plane
  for (const TextFormat& format : text_formats) {
    const std::string text = mesh_bytes(mesh, format.format);
    const std::string head = text.substr(0, text.find("<AppendedData"));  // of .vtu
    const FlatMesh known = *read(format, text);
    int counted = 0;
    for (const Token& token : whole_numbers(head)) {
      const std::string number = text.substr(token.begin, token.size);
      const auto with = [&](const std::string& other) { return std::string(text).replace(token.begin, token.size, other); };
      const std::optional<FlatMesh> unusual = read(format, with("77777"));
      if (unusual && same(*unusual, known)) continue;
      ++counted;
      const std::string below = std::to_string((std::uint64_t{1} << 32) + std::stoul(number));
      // 2^64 + k, decimal.
      const std::string far = "18446744073709" + std::to_string(551616 + std::stoul(number));
      for (const std::string& large : {below, far, std::string("2147483648"), std::string("9223372036854775808")}) {
        const std::string what = std::string(format.name) + ": " + number + " at byte " + std::to_string(token.begin) + " is " + large;
        const std::optional<FlatMesh> found = read(format, with(large));
        if (!found) continue;
        EXPECT_FALSE(same(*found, known)) << what;
        expect_sound(*found, what);
      }
    }
    EXPECT_GT(counted, 3) << format.name;
  }
}

}  // namespace
}  // namespace carreau
