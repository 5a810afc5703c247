#include <cstdio>

#include "commands.h"

namespace command {
namespace {

void print_quality(const carreau_quality& q) {
  std::printf("edges       %lld (%lld with one triangle)\n", static_cast<long long>(q.edges),
              static_cast<long long>(q.open_edges));
  std::printf("area        %.9g\n", q.area);
  std::printf("edge length %.6g to %.6g, mean %.6g\n", q.edge_min, q.edge_max, q.edge_mean);
  std::printf("angles      %.4g to %.4g degrees\n", q.angle_min, q.angle_max);
  std::printf("shape Q1    mean %.4f, first percentile %.4f, worst %.4f\n", q.q1_mean, q.q1_p1, q.q1_min);
  std::printf("shape Q2    mean %.4f, first percentile %.4f, worst %.4f\n", q.q2_mean, q.q2_p1, q.q2_min);
  std::printf("degree 6    %.1f %% of interior vertices\n", 100 * q.degree6);
}

}  // namespace

int check(const std::string& path, bool closed, int limit) {
  const MeshHandle mesh = read_mesh(path);
  std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0, defects = 0;
  require(mesh.get(), carreau_mesh_count(mesh.get(), &vertices, &triangles, &edges, &faces));
  std::printf("vertices    %lld\ntriangles   %lld\nfaces       %lld\ncurve edges %lld\n",
              static_cast<long long>(vertices), static_cast<long long>(triangles), static_cast<long long>(faces),
              static_cast<long long>(edges));
  const char* text = "";
  require(mesh.get(), carreau_mesh_defects(mesh.get(), closed ? 1 : 0, limit, &defects, &text));
  const std::string sentences = text;
  if (defects == 0) {
    carreau_quality quality{};
    quality.struct_size = sizeof quality;
    require(mesh.get(), carreau_mesh_quality(mesh.get(), &quality));
    print_quality(quality);
    std::puts("defects     none");
    return 0;
  }
  std::printf("defects     %lld%s\n%s\n", static_cast<long long>(defects), defects >= limit ? " or more" : "",
              sentences.c_str());
  return 1;
}

}  // namespace command
