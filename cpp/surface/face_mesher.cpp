#include "surface/face_mesher.h"

#include <chrono>

#include "surface/interface_sizes.h"
#include "surface/space_swaps.h"

namespace carreau {

namespace {

SampledDomain sampled_domain(const PlaneDomain& domain) {
  SampledDomain sampled{domain.vertices, {}};
  for (const PlaneEdge& edge : domain.edges)
    if (edge.kind != PlaneEdgeKind::internal) sampled.edges.emplace_back(edge.a, edge.b);
  return sampled;
}

// Points to evaluate at a time: large enough for hosts that like batches, small enough to stop soon.
constexpr std::size_t batch = 512;

std::vector<Vec3> lift(int face, std::span<const Vec2> uv, Cad& cad, Monitor& monitor) {
  std::vector<Vec3> xyz;
  xyz.reserve(uv.size());
  std::vector<SurfaceJet> jets(batch);
  for (std::size_t i = 0; i < uv.size(); i += batch) {
    monitor.checkpoint();
    const std::size_t n = std::min(batch, uv.size() - i);
    cad.surface(face, want_position, uv.subspan(i, n), std::span(jets).first(n));
    for (std::size_t k = 0; k < n; ++k) xyz.push_back(jets[k].s);
  }
  return xyz;
}

// The size that the control space prescribes at a vertex: true length over metric length, averaged over its edges.
// Spends no callback; exact when one size holds everywhere or the sampled first fundamental form is.
std::vector<double> sizes_at_vertices(const PatchInput& input, const PatchMesh& mesh, const ControlSpace& space) {
  if (input.constant_size) return std::vector<double>(mesh.xyz.size(), *input.constant_size);
  std::vector<double> in_space(mesh.xyz.size(), 0), in_metric(mesh.xyz.size(), 0);
  for (const auto& t : mesh.plane.triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const Vec2 p = mesh.plane.vertices[a], q = mesh.plane.vertices[b];
      const double l = norm(mesh.xyz[b] - mesh.xyz[a]);
      const double m = length(space.at(0.5 * (p + q)), q - p);
      in_space[a] += l;
      in_space[b] += l;
      in_metric[a] += m;
      in_metric[b] += m;
    }
  std::vector<double> size(mesh.xyz.size(), 0);
  for (std::size_t v = 0; v < size.size(); ++v) {
    const bool known = v < input.domain->size.size() && input.domain->size[v] > 0;
    size[v] = known ? input.domain->size[v] : in_metric[v] > 0 ? in_space[v] / in_metric[v] : 0;
  }
  return size;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ControlSpace sample_face(const PatchInput& input, Cad& cad, SizeRules& rules, const CompositeOptions& options,
                         Monitor& monitor) {
  // Built only when the host leaves a question open.
  std::optional<InterfaceSizes> interfaces;
  const auto fallback = [&](Vec2 uv) {
    if (!interfaces)
      interfaces.emplace(input.domain->plane, input.domain->physical, static_cast<SizeLaw>(options.size.hinterpol_flag),
                         monitor);
    return (*interfaces)(uv);
  };
  std::vector<SurfaceJet> jets;
  std::vector<double> h;
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    jets.resize(uv.size());
    h.resize(uv.size());
    cad.surface(input.ref, want_first | rules.surface_wants(), uv, jets);
    rules.on_surface(input.face, uv, jets, fallback, h);
    for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, h[i]);
  };
  return ControlSpace::build(sampled_domain(input.domain->plane), sampler, {}, monitor);
}

PatchMesh mesh_patch(const PatchInput& input, const ControlSpace& space, Cad& cad, const CompositeOptions& options,
                     CompositeReport& report, Monitor& monitor) {
  PatchMesh mesh;
  auto start = std::chrono::steady_clock::now();
  const PlaneMesherOptions plane_options{.frontal = options.frontal, .max_triangles = options.max_triangles};
  mesh.plane = mesh_plane(input.domain->plane, space, plane_options, monitor);
  report.seconds_plane += seconds_since(start);

  start = std::chrono::steady_clock::now();
  const std::span<const Vec2> uv = mesh.plane.vertices;
  const std::size_t on_curves = input.curve_xyz.size();
  mesh.xyz = input.curve_xyz;
  const std::vector<Vec3> rest = lift(input.ref, uv.subspan(on_curves), cad, monitor);
  mesh.xyz.insert(mesh.xyz.end(), rest.begin(), rest.end());
  improve_in_space(input.domain->plane, mesh.plane, mesh.xyz);
  mesh.size = sizes_at_vertices(input, mesh, space);
  report.seconds_lift += seconds_since(start);
  return mesh;
}

}  // namespace carreau
