// SPDX-License-Identifier: BSD-3-Clause
// The memory of a run above the mesh that it makes: requested bytes, counted exactly.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace {

std::atomic<long long> live{0}, peak{0}, allocations{0};

void* count(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  const long long now = live += static_cast<long long>(malloc_usable_size(p));
  ++allocations;
  long long high = peak;
  while (now > high && !peak.compare_exchange_weak(high, now)) {
  }
  return p;
}
void uncount(void* p) {
  if (p != nullptr) live -= static_cast<long long>(malloc_usable_size(p));
  std::free(p);
}

}  // namespace

void* operator new(std::size_t n) { return count(std::malloc(n > 0 ? n : 1)); }
void* operator new[](std::size_t n) { return count(std::malloc(n > 0 ? n : 1)); }
void* operator new(std::size_t n, std::align_val_t a) {
  const auto align = static_cast<std::size_t>(a);
  return count(std::aligned_alloc(align, (n + align - 1) / align * align));
}
void operator delete(void* p) noexcept { uncount(p); }
void operator delete[](void* p) noexcept { uncount(p); }
void operator delete(void* p, std::size_t) noexcept { uncount(p); }
void operator delete[](void* p, std::size_t) noexcept { uncount(p); }
void operator delete(void* p, std::align_val_t) noexcept { uncount(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { uncount(p); }

namespace carreau {
namespace {

// Paraboloid, uniform size.
TEST(Memory, AMillionTrianglesNeedAtMostFortyBytesEachAboveTheMesh) {
  auto cad = std::make_shared<testing::AnalyticCad>(testing::paraboloid());
  Monitor monitor;
  Session session(monitor);
  session.set_cad(cad);
  session.set_model(testing::unglued(*cad));
  session.parameters().set("hphydef", 0.011252);
  session.parameters().set("hphymin", 0.001);
  const long long before = live;
  peak = before;
  allocations = 0;
  session.make_mesh();
  const auto mesh = static_cast<double>(live - before), high = static_cast<double>(peak - before);
  std::size_t count = 0;
  for (const FaceMesh& face : session.mesh().faces) count += face.triangles.size();
  const auto triangles = static_cast<double>(count);
  RecordProperty("triangles", static_cast<int>(count));
  RecordProperty("mesh_bytes_a_triangle", std::to_string(mesh / triangles));
  RecordProperty("bytes_a_triangle_above", std::to_string((high - mesh) / triangles));
  RecordProperty("allocations", std::to_string(allocations.load()));
  std::printf("%zu triangles; mesh %.1f bytes each, %.1f more at the peak; %lld allocations\n", count, mesh / triangles,
              (high - mesh) / triangles, allocations.load());
  EXPECT_GT(triangles, 950'000);
  EXPECT_LE((high - mesh) / triangles, 40);
  EXPECT_LE(high / triangles, 56);
  // Structures grow; nothing is allocated for each triangle.
  EXPECT_LT(static_cast<double>(allocations.load()), 0.01 * triangles);
}

}  // namespace
}  // namespace carreau
