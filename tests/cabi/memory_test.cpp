// SPDX-License-Identifier: BSD-3-Clause
// Memory that ends at the n-th allocation, for every n of a run. A separate executable, since it replaces operator new.
#include <cstdlib>
#include <new>

#include "abi_fixture.h"

namespace {

std::int64_t allocations = 0, fail_at = 0, living = 0;  // from 1; 0: none fails

void* allocate(std::size_t size, std::size_t alignment) {
  if (++allocations == fail_at) throw std::bad_alloc();
  const std::size_t whole = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  ++living;
  return memory;
}
void release(void* memory) noexcept {
  if (memory == nullptr) return;
  --living;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, std::size_t(alignment)); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace abi_tests {
namespace {

/// A run on a torus that may end without memory at any step.
class MemoryTest : public SessionTest {
 protected:
  carreau_status prepare(carreau_session* in) {
    const carreau_cad cad = torus_cad(&host);
    carreau_status status = carreau_set_cad(in, &cad);
    if (status == CARREAU_OK) status = torus_model(in);
    if (status == CARREAU_OK) status = carreau_set_real(in, "hphydef", 1.5);
    if (status == CARREAU_OK) status = carreau_set_real(in, "angle_smo", 8);
    return status;
  }
};

TEST_F(MemoryTest, EndsAtAnyAllocationOfARunWithAStatusAndNothingElse) {
  ASSERT_EQ(prepare(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();  // there is a mesh before from now on
  const MeshData before = data_of(mesh());
  allocations = 0;
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const std::int64_t all = allocations;
  ASSERT_GT(all, 500);
  const std::int64_t resting = living;
  std::int64_t failed = 0;
  for (std::int64_t n = 1; n <= all; ++n) {
    allocations = 0;
    fail_at = n;
    const carreau_status status = carreau_mesh_generate(session);
    fail_at = 0;
    // std::stable_sort can do without.
    if (status != CARREAU_OK) {
      ASSERT_EQ(status, CARREAU_ERR_MEMORY) << "allocation " << n << " of " << all << ": " << error();
      ASSERT_EQ(error(), "out of memory") << n;
      ++failed;
    }
    if (status == CARREAU_OK || n % 50 == 0) {
      ASSERT_TRUE(data_of(mesh()) == before) << n;
    }
  }
  EXPECT_GT(failed, all * 9 / 10);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_TRUE(data_of(mesh()) == before);
  EXPECT_EQ(living, resting);
}

TEST_F(MemoryTest, EndsAtAnyAllocationOfAWholeLifeWithoutALeak) {
  const std::int64_t resting = living;
  std::int64_t n = 0;
  for (bool failed = true; failed;) {
    allocations = 0;
    fail_at = ++n;
    carreau_session* mine = nullptr;
    carreau_status status = carreau_session_create(&mine);
    if (status == CARREAU_OK) status = prepare(mine);
    if (status == CARREAU_OK) status = carreau_model_check(mine);
    failed = allocations >= n;
    fail_at = 0;
    ASSERT_EQ(status, failed ? CARREAU_ERR_MEMORY : CARREAU_OK) << "allocation " << n;
    carreau_session_free(mine);
    ASSERT_EQ(living, resting) << "allocation " << n;
  }
  EXPECT_GT(n, 20);
}

}  // namespace
}  // namespace abi_tests
