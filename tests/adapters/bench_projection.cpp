// SPDX-License-Identifier: BSD-3-Clause
// bench_projection FILE... : distances of random points to CAD files, by carreau_project and by OpenCASCADE (BRepExtrema_DistShapeShape):
// the largest excess of each over the other, in shares of the diagonal, and points a second. OpenCASCADE's point on an edge lies on the curve
// of the edge, beside the faces by up to its tolerance: the last figure is the largest difference there. A .bpt file has Carreau's figures alone.
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <brep_host.h>
#include <shape_file.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void require(carreau_status status, const carreau_session* session) {
  if (status != CARREAU_OK) throw std::runtime_error(carreau_last_error(session));
}

std::vector<double> points_about(const std::vector<double>& box, std::size_t n) {
  std::mt19937_64 random(1);
  std::vector<double> x(3 * n);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double low = box[i % 3], high = box[3 + i % 3], margin = 0.1 * (high - low);
    x[i] = std::uniform_real_distribution<double>(low - margin, high + margin)(random);
  }
  return x;
}

/// The faces alone: inside a solid the peer's distance would be 0.
TopoDS_Shape faces_of(const TopoDS_Shape& shape) {
  TopoDS_Compound faces;
  BRep_Builder builder;
  builder.MakeCompound(faces);
  for (TopExp_Explorer each(shape, TopAbs_FACE); each.More(); each.Next()) builder.Add(faces, each.Current());
  return faces;
}

/// Box of the closest points of a far cloud.
std::vector<double> box_of(carreau_session* session, double reach) {
  const std::vector<double> far = points_about({-reach, -reach, -reach, reach, reach, reach}, 2000);
  std::vector<double> closest(far.size());
  require(carreau_project(session, 2, 0, 2000, far.data(), nullptr, nullptr, closest.data(), nullptr), session);
  std::vector<double> box{1e300, 1e300, 1e300, -1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < closest.size(); ++i)
    box[i % 3] = std::min(box[i % 3], closest[i]), box[3 + i % 3] = std::max(box[3 + i % 3], closest[i]);
  return box;
}

void measure(const std::string& path) {
  carreau_session* session = nullptr;
  require(carreau_session_create(&session), session);
  const bool patches = path.size() > 4 && path.substr(path.size() - 4) == ".bpt";
  carreau_occ::ShapeFile file;
  double reach = 10;
  if (patches) {
    require(carreau_load_bezier(session, path.c_str()), session);
  } else {
    file = carreau_occ::read_shape(path);
    carreau_occ::BrepHost host(file);
    require(host.give_to(session), session);
    reach = host.diagonal();
  }
  const Clock::time_point begin = Clock::now();
  const std::vector<double> box = box_of(session, reach);
  const double trees = seconds_since(begin);
  double diagonal = 0;
  for (std::size_t k = 0; k < 3; ++k) diagonal = std::max(diagonal, box[3 + k] - box[k]);
  const std::size_t n = patches ? 1'000'000 : 20'000, peers = patches ? 0 : 100;
  const std::vector<double> x = points_about(box, n);
  std::vector<double> distances(n);
  double best = 1e300;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Clock::time_point start = Clock::now();
    require(carreau_project(session, 2, 0, std::int64_t(n), x.data(), nullptr, nullptr, nullptr, distances.data()), session);
    best = std::min(best, seconds_since(start));
  }
  double ours = 0, theirs = 0, on_edges = 0;
  const TopoDS_Shape faces = patches ? TopoDS_Shape() : faces_of(file.shape);
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < peers; ++i) {
    BRepExtrema_DistShapeShape peer(BRepBuilderAPI_MakeVertex(gp_Pnt(x[3 * i], x[3 * i + 1], x[3 * i + 2])).Vertex(), faces);
    if (!peer.IsDone()) continue;
    const double d = peer.Value();
    if (peer.SupportTypeShape2(1) == BRepExtrema_IsInFace)
      ours = std::max(ours, distances[i] - d), theirs = std::max(theirs, d - distances[i]);
    else
      on_edges = std::max(on_edges, std::abs(distances[i] - d));
  }
  const double by_peer = seconds_since(start);
  std::printf("%-32s trees %7.3f s  %10.0f points/s", path.substr(path.rfind('/') + 1).c_str(), trees, double(n) / best);
  if (peers > 0) std::printf("  OpenCASCADE %8.0f points/s  excess %9.2e  of OpenCASCADE %9.2e  edges %9.2e",
                             double(peers) / by_peer, ours / diagonal, theirs / diagonal, on_edges / diagonal);
  std::puts("");
  std::fflush(stdout);
  carreau_session_free(session);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("bench_projection FILE...\n", stderr), 2;
  int failed = 0;
  for (int i = 1; i < argc; ++i) try {
      measure(argv[i]);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", argv[i], error.what()), failed = 1;
    }
  return failed;
}
