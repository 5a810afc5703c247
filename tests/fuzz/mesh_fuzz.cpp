// Any bytes are a mesh or a FileError that names the file (ASCII Medit format).
#include <cstdint>

#include "mesh_fuzz_check.h"
#include "support/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  carreau::FlatMesh mesh;
  try {
    mesh = carreau::read_mesh_text(content, "x.mesh");
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "x.mesh");
    return 0;
  }
  carreau::check_written_and_read(mesh);
  return 0;
}
