// SPDX-License-Identifier: BSD-3-Clause
// carreau: meshes of CAD files, pictures and checks of meshes, fields that govern them, and the list of parameters.
// Exit codes: 0 done, 1 the mesh has defects or lacks faces, 2 the command line or a file cannot be used, or there is
// no mesh.
#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/heap.h"
#include "base/terminal.h"
#include "cli/command_line.h"

namespace {

constexpr int unusable = 2;

/// Opens closed standard streams: otherwise the next file would get their number, and output would go into it. The file
/// opened in its place cannot be written (or read), as before.
void open_standard_files() {
  for (int file = 0; file < 3; ++file) {
    if (fcntl(file, F_GETFD) != -1 || errno != EBADF) continue;
    if (open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY) == -1) return;  // the lowest number that is free
  }
}

/// Output may still be in a buffer, and the disk full.
int flushed(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  std::fprintf(stderr, "carreau: the standard output cannot be written: %s\n",
               errno != 0 ? std::strerror(errno) : "an earlier write failed");
  return unusable;
}

}  // namespace

int main(int argc, char** argv) {
  command::prepare_heap();
  open_standard_files();
  try {
    command::CommandLine line(argc > 1 ? argv[1] : "");
    return flushed(line.run(argc, argv));
  } catch (const std::bad_alloc&) {
    command::print_marked("carreau", command::colour::red, "there is not enough memory");
  } catch (const std::exception& error) {
    command::print_marked("carreau", command::colour::red, error.what());
  }
  return unusable;
}
