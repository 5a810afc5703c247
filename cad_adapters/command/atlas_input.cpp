#include "atlas_input.h"

#include <carreau_atlas.h>

#include <algorithm>
#include <vector>

#include "built_input.h"
#include "failure.h"
#include "text_file.h"

namespace command {
namespace {

struct FreeMesh {
  void operator()(carreau_mesh* mesh) const noexcept { carreau_mesh_free(mesh); }
};
struct FreeAtlas {
  void operator()(carreau_atlas* atlas) const noexcept { carreau_atlas_free(atlas); }
};
using AtlasHandle = std::unique_ptr<carreau_atlas, FreeAtlas>;

AtlasHandle build(const std::string& path) {
  carreau_mesh* made_mesh = nullptr;
  if (carreau_mesh_create(&made_mesh) != CARREAU_OK) throw Failure("out of memory");
  const std::unique_ptr<carreau_mesh, FreeMesh> mesh(made_mesh);
  const auto require_mesh = [&](carreau_status status) {
    if (status != CARREAU_OK) throw Failure(carreau_mesh_last_error(mesh.get()));
  };
  require_mesh(carreau_mesh_read(mesh.get(), path.c_str()));
  int64_t vertices = 0, triangles = 0, edges = 0, faces = 0;
  require_mesh(carreau_mesh_count(mesh.get(), &vertices, &triangles, &edges, &faces));
  std::vector<double> xyz(3 * static_cast<std::size_t>(vertices));
  std::vector<std::int32_t> corners(3 * static_cast<std::size_t>(triangles));
  require_mesh(carreau_mesh_vertices(mesh.get(), vertices, xyz.data()));
  require_mesh(carreau_mesh_triangles(mesh.get(), triangles, corners.data()));
  carreau_atlas* made = nullptr;
  if (carreau_atlas_create(&made) != CARREAU_OK) throw Failure("out of memory");
  AtlasHandle atlas(made);
  if (carreau_atlas_build(made, nullptr, vertices, xyz.data(), triangles, corners.data(), nullptr) != CARREAU_OK)
    throw Failure(path + ": " + carreau_atlas_last_error(made));
  return atlas;
}

class AtlasInput final : public BuiltInput {
 public:
  AtlasInput(SessionHandle session, const std::string& path, AtlasHandle atlas)
      : BuiltInput(std::move(session), path), atlas_(std::move(atlas)) {}

  carreau_status give_to(carreau_session* session) override { return carreau_add_atlas(session, atlas_.get()); }

  [[nodiscard]] std::string summary() const override {
    carreau_atlas_counts counts{};
    counts.struct_size = sizeof counts;
    carreau_atlas_count(atlas_.get(), &counts);
    return "atlas over " + std::to_string(counts.triangles) + " triangles, " + ModelInput::summary();
  }
  [[nodiscard]] bool closed() const override { return true; }
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "chart"; }

  AtlasHandle atlas_;
};

}  // namespace

bool is_mesh_file(const std::string& path) {
  const std::string suffix = suffix_of(path);
  constexpr const char* suffixes[] = {".mesh", ".meshb", ".vtu", ".stl", ".msh", ".msh2", ".off", ".obj", ".ply"};
  return std::any_of(std::begin(suffixes), std::end(suffixes), [&](const char* known) { return suffix == known; });
}

std::unique_ptr<CadInput> open_atlas(const std::string& path) {
  if (!is_mesh_file(path))
    throw Failure(
        "--surface atlas goes with a mesh of triangles (.off, .obj, .ply, .stl, .mesh, .vtu, .msh), not with '" + path +
        "'.");
  AtlasHandle atlas = build(path);
  SessionHandle session = make_silent_session();
  require(session.get(), carreau_add_atlas(session.get(), atlas.get()));
  return std::make_unique<AtlasInput>(std::move(session), path, std::move(atlas));
}

}  // namespace command
