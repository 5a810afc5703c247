// SPDX-License-Identifier: BSD-3-Clause
// bench_threads FILE SIZE [REPEATS]: wall time of carreau_mesh_generate on a CAD file, the least of all repeats, with
// one thread and with several, by turns.
#include <brep_host.h>
#include <shape_file.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "measured_mesh.h"

namespace {

struct Run {
  double seconds = 0;  // of the whole call
  carreau_report report{};
  std::int64_t triangles = 0;
};

Run run(carreau_occ::BrepHost& host, double size, int threads) {
  carreau_session* session = nullptr;
  carreau_session_create(&session);
  adapters::use_command_parameters(session, size, host.diagonal());
  carreau_set_integer(session, "threads", threads);
  host.give_to(session);
  const auto start = std::chrono::steady_clock::now();
  const carreau_status status = carreau_mesh_generate(session);
  Run result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (status != CARREAU_OK) std::fprintf(stderr, "%s\n", carreau_last_error(session));
  result.report.struct_size = sizeof result.report;
  carreau_session_report(session, &result.report);
  carreau_mesh* mesh = nullptr;
  if (carreau_session_mesh(session, &mesh) == CARREAU_OK)
    carreau_mesh_count(mesh, nullptr, &result.triangles, nullptr, nullptr);
  carreau_session_free(session);
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) return std::fputs("bench_threads FILE SIZE [REPEATS]\n", stderr), 2;
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(argv[1]);
  carreau_occ::BrepHost host(file);
  const double size = std::strtod(argv[2], nullptr);
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 15;
  std::vector<int> counts{1, 2};
  for (int n = 4; n <= static_cast<int>(std::thread::hardware_concurrency()); n *= 2) counts.push_back(n);
  std::vector<Run> best(counts.size());
  for (Run& each : best) each.seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i)
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (const Run now = run(host, size, counts[k]); now.seconds < best[k].seconds) best[k] = now;
  std::puts("threads  triangles  whole call  speed-up  from sizes to mesh  speed-up");
  for (std::size_t k = 0; k < counts.size(); ++k)
    std::printf("%7d %10lld %11.4f %9.2f %19.4f %9.2f\n", counts[k], static_cast<long long>(best[k].triangles),
                best[k].seconds, best[0].seconds / best[k].seconds, best[k].report.seconds_total,
                best[0].report.seconds_total / best[k].report.seconds_total);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
