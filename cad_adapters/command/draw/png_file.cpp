// SPDX-License-Identifier: BSD-3-Clause
#include "draw/png_file.h"

#include <png.h>

#include <cstring>

#include "base/failure.h"

namespace command {

void write_png(const Image& image, const std::string& path) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&header, path.c_str(), 0, image.bytes.data(), 0, nullptr) == 0)
    throw Failure("The picture '" + path + "' cannot be written: " + header.message + ".");
}

}  // namespace command
