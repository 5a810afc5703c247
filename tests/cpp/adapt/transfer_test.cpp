// SPDX-License-Identifier: BSD-3-Clause
// Transfer between meshes, interpolation errors and estimates by differences against closed forms.
#include "adapt/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metric/metric3_algebra.h"
#include "support/error.h"
#include "test_meshes.h"

namespace carreau {
namespace {

using testing::square_mesh;
using testing::TestMesh;

/// One face of reference `ref` whose parameters are x, y.
SurfaceMesh surface(const TestMesh& mesh, int ref) {
  SurfaceMesh result;
  FaceMesh face;
  face.ref = ref;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    face.uv.push_back({mesh.vertices[v].x(), mesh.vertices[v].y()});
    face.vertex.push_back(static_cast<std::int32_t>(v));
  }
  face.triangles = mesh.triangles;
  result.vertices = mesh.vertices;
  result.vertex_ref.resize(mesh.vertices.size());
  result.faces = {face};
  return result;
}

void field_of(std::span<const Vec3> points, std::span<double> values) {
  for (std::size_t i = 0; i < points.size(); ++i) values[i] = 3 * points[i].x() * points[i].x() + points[i].y() * points[i].y();
}

TEST(TransferField, IsExactForLinearFieldsAndKeepsComponentsTogether) {
  const TestMesh coarse = square_mesh(5), fine = square_mesh(13);
  std::vector<double> values;
  for (const Vec3& p : coarse.vertices) values.insert(values.end(), {2 * p.x() - p.y(), 7 + p.y()});
  for (const int ref : {1, 2}) {  // face by face, and in space
    const TransferredField moved = transfer_field(surface(coarse, 1), surface(fine, ref), values, 2);
    ASSERT_EQ(moved.values.size(), 2 * fine.vertices.size());
    EXPECT_EQ(moved.outside, 0);
    for (std::size_t v = 0; v < fine.vertices.size(); ++v) {
      const Vec3 p = fine.vertices[v];
      EXPECT_NEAR(moved.values[2 * v], 2 * p.x() - p.y(), 1e-13);
      EXPECT_NEAR(moved.values[2 * v + 1], 7 + p.y(), 1e-13);
    }
  }
}

TEST(TransferField, DistinguishesSheetsByTheirFaces) {
  // Two sheets that coincide in space, with values 1 and 2.
  const TestMesh coarse = square_mesh(3), fine = square_mesh(6);
  const auto two_sheets = [](const TestMesh& mesh) {
    SurfaceMesh result = surface(mesh, 1);
    FaceMesh other = result.faces[0];
    other.ref = 2;
    const auto n = static_cast<std::int32_t>(mesh.vertices.size());
    for (std::int32_t& v : other.vertex) v += n;
    result.vertices.insert(result.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    result.vertex_ref.resize(result.vertices.size());
    result.faces.push_back(other);
    return result;
  };
  std::vector<double> values(coarse.vertices.size(), 1);
  values.resize(2 * values.size(), 2);
  const TransferredField moved = transfer_field(two_sheets(coarse), two_sheets(fine), values, 1);
  for (std::size_t v = 0; v < moved.values.size(); ++v)
    EXPECT_DOUBLE_EQ(moved.values[v], v < fine.vertices.size() ? 1 : 2);
}

/// Half of the cap of the unit sphere within `angle` of its pole; u = longitude and v = latitude, so that the side
/// v = pi / 2 is one vertex in space: n x n cells. The cells of the last row are cut into a triangle and a triangle
/// that is flat in space.
SurfaceMesh half_cap(int n, double angle) {
  const double pi = 3.141592653589793;
  SurfaceMesh result;
  FaceMesh face;
  face.ref = 1;
  std::int32_t pole = -1;
  const TestMesh square = square_mesh(n, 0.2);
  for (const Vec3& p : square.vertices) {
    const double u = pi / 2 * (p.x() + 1), v = pi / 2 - angle * (1 - p.y()) / 2;
    face.uv.push_back({u, v});
    const bool top = p.y() > 1 - 1e-12;
    if (top && pole >= 0) {
      face.vertex.push_back(pole);
      continue;
    }
    face.vertex.push_back(static_cast<std::int32_t>(result.vertices.size()));
    if (top) pole = face.vertex.back();
    result.vertices.push_back(top ? Vec3{0, 0, 1}
                                  : Vec3{std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)});
  }
  for (const auto& t : square.triangles) {
    int at_pole = 0;
    for (const std::int32_t v : t) at_pole += face.vertex[static_cast<std::size_t>(v)] == pole ? 1 : 0;
    (at_pole > 1 ? face.flattened : face.triangles).push_back(t);
  }
  result.vertex_ref.resize(result.vertices.size());
  result.faces = {face};
  return result;
}

TEST(TransferField, IsOfSecondOrderAroundPoles) {
  // Three sectors of 60 degrees: in (u, v) the triangle of a sector covers half of its cell, and the flat one the rest.
  const auto linear = [](Vec3 p) { return 1 + 2 * p.x() - 3 * p.y() + 0.5 * p.z(); };
  std::vector<double> errors;
  for (const double angle : {0.4, 0.2, 0.1}) {
    const SurfaceMesh coarse = half_cap(3, angle), fine = half_cap(20, angle);
    std::vector<double> values;
    for (const Vec3& p : coarse.vertices) values.push_back(linear(p));
    const TransferredField moved = transfer_field(coarse, fine, values, 1);
    EXPECT_EQ(moved.outside, 0);
    double largest = 0;
    for (std::size_t v = 0; v < fine.vertices.size(); ++v) {
      const Vec3 p = fine.vertices[v];
      // Inside of the chords of the rim and of the first meridian.
      if (std::hypot(p.x(), p.y()) > 0.8 * angle || p.y() < 0.1 * angle) continue;
      largest = std::max(largest, std::abs(moved.values[v] - linear(p)));
    }
    errors.push_back(largest);
    // A place in (u, v) counts while it is four times as far from the vertex as the triangles are at most.
    EXPECT_LT(largest, 4 * std::sqrt(4 + 9 + 0.25) * angle * angle / 8);
  }
  EXPECT_GT(errors[0] / errors[1], 3.5);
  EXPECT_GT(errors[1] / errors[2], 3.5);
}

TEST(TransferField, KeepsValuesAtVerticesThatStay) {
  const SurfaceMesh mesh = half_cap(9, 1.2);
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) values.push_back(std::sin(1e3 * double(v)));
  EXPECT_EQ(transfer_field(mesh, mesh, values, 1).values, values);
}

TEST(TransferField, CountsVerticesOutside) {
  TestMesh half = square_mesh(4);
  for (Vec3& p : half.vertices) p.x() /= 2;
  std::vector<double> values;
  for (const Vec3& p : half.vertices) values.push_back(p.x());
  const TestMesh fine = square_mesh(10);
  const TransferredField moved = transfer_field(surface(half, 1), surface(fine, 1), values, 1);
  EXPECT_GT(moved.outside, 0);
  double right = 0;
  for (const Vec3& p : half.vertices) right = std::max(right, p.x());
  for (std::size_t v = 0; v < fine.vertices.size(); ++v)
    EXPECT_NEAR(moved.values[v], std::clamp(fine.vertices[v].x(), -right, right), 1e-12);
}

TEST(TransferField, RejectsWrongSizesOfInput) {
  const TestMesh mesh = square_mesh(2);
  const std::vector<double> values(mesh.vertices.size() - 1);
  EXPECT_THROW(transfer_field(surface(mesh, 1), surface(mesh, 1), values, 1), InvalidArgument);
  EXPECT_THROW(transfer_field(surface(mesh, 1), surface(mesh, 1), values, 0), InvalidArgument);
  EXPECT_THROW(transfer_field({}, surface(mesh, 1), {}, 1), InvalidArgument);
}

TEST(InterpolationError, AQuadraticHasTheErrorOfItsEdges) {
  // On an edge of length h along x the error is 3 h^2 / 4, h^2 / 4 along y: all middles, exactly.
  TestMesh mesh = square_mesh(8);
  mesh.with([](Vec3 p) { return 3 * p.x() * p.x() + p.y() * p.y(); });
  double largest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 d =
          mesh.vertices[static_cast<std::size_t>(t[k])] - mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
      largest = std::max(largest, std::abs(3 * d.x() * d.x() + d.y() * d.y()) / 4);
    }
  const InterpolationError error = interpolation_error(mesh.field(), field_of);
  EXPECT_NEAR(error.largest, largest, 1e-12);
  EXPECT_GT(error.rms, 0.3 * largest);
  EXPECT_LT(error.rms, largest);
  EXPECT_THROW(
      interpolation_error(mesh.field(), [](std::span<const Vec3>, std::span<double> v) { v[0] = std::nan(""); }),
      InvalidArgument);
}

TEST(EstimateFunction, IsExactForQuadratics) {
  const TestMesh mesh = square_mesh(4);
  const auto wanted =
      estimate_function(mesh.vertices, mesh.triangles, field_of,
                        {.shape = ErrorShape::anisotropic, .tolerance = 0.02, .hmin = 1e-3, .hmax = 10});
  ASSERT_EQ(wanted.metrics.size(), mesh.vertices.size());
  for (const Metric3& m : wanted.metrics) {
    EXPECT_NEAR(m.xx, 2 * 6 / (9 * 0.02), 1e-3);
    EXPECT_NEAR(m.yy, 2 * 2 / (9 * 0.02), 1e-3);
    EXPECT_NEAR(m.xy, 0, 1e-3);
  }
}

TEST(EstimateFunction, SeesBetweenVertices) {
  // A ridge along the middle of a column of squares: flat at all vertices.
  const TestMesh mesh = square_mesh(4, 0);
  double left = 1e9, next = 1e9;
  for (const Vec3& p : mesh.vertices) left = std::min(left, p.x());
  for (const Vec3& p : mesh.vertices)
    if (p.x() > left) next = std::min(next, p.x());
  const double middle = (left + next) / 2, width = (next - left) / 20;
  const auto ridge = [&](std::span<const Vec3> points, std::span<double> values) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = std::exp(-std::pow((points[i].x() - middle) / width, 2));
  };
  const auto wanted =
      estimate_function(mesh.vertices, mesh.triangles, ridge, {.tolerance = 0.01, .hmin = 1e-4, .hmax = 10});
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].x() <= next + 1e-12)
      EXPECT_NEAR(wanted.sizes[v], std::sqrt(4.5 * 0.01 / 2) * width, 1e-3 * width) << v;
    else
      EXPECT_EQ(wanted.sizes[v], 10) << v;
}

}  // namespace
}  // namespace carreau
