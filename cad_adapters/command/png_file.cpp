#include "png_file.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "mesh_file.h"

namespace command {

void write_png(const Image& image, const std::string& path) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  const std::string temporary = path + ".part";
  if (png_image_write_to_file(&header, temporary.c_str(), 0, image.bytes.data(), 0, nullptr) == 0) {
    std::remove(temporary.c_str());
    throw Failure("The picture '" + path + "' cannot be written: " + header.message + ".");
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    std::remove(temporary.c_str());
    throw Failure("The picture '" + path + "' cannot be written: " + why + ".");
  }
}

}  // namespace command
