// SPDX-License-Identifier: BSD-3-Clause
// EXR files read back with OpenEXR's own C++ library, not with the code that wrote them.
#pragma once

#include <ImfAttribute.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace carreau::testing {

/// One part of a file. Pixels row by row, the upper row first.
struct ExrImage {
  Imf::Header header;
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> real;             ///< FLOAT and HALF channels
  std::map<std::string, std::vector<std::uint32_t>> integer;  ///< UINT channels

  [[nodiscard]] float at(const std::string& channel, int column, int row) const {
    return real.at(channel).at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(column));
  }
  [[nodiscard]] std::uint32_t number(const std::string& channel, int column, int row) const {
    return integer.at(channel).at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(column));
  }
  [[nodiscard]] bool has(const std::string& attribute) const { return header.find(attribute.c_str()) != header.end(); }
  [[nodiscard]] int integer_attribute(const char* name) const {
    return header.typedAttribute<Imf::IntAttribute>(name).value();
  }
  [[nodiscard]] double real_attribute(const char* name) const {
    return header.typedAttribute<Imf::DoubleAttribute>(name).value();
  }
  [[nodiscard]] std::string text_attribute(const char* name) const {
    return header.typedAttribute<Imf::StringAttribute>(name).value();
  }
  [[nodiscard]] Imath::V2d pair_attribute(const char* name) const {
    return header.typedAttribute<Imf::V2dAttribute>(name).value();
  }
};

/// All parts. Throws OpenEXR's exceptions.
inline std::vector<ExrImage> read_exr(const std::string& path) {
  Imf::MultiPartInputFile file(path.c_str());
  std::vector<ExrImage> images;
  for (int p = 0; p < file.parts(); ++p) {
    Imf::InputPart part(file, p);
    ExrImage image;
    image.header = part.header();
    const Imath::Box2i window = image.header.dataWindow();
    if (window.min != Imath::V2i(0, 0)) throw std::runtime_error("the data window does not start at 0");
    image.width = window.max.x + 1;
    image.height = window.max.y + 1;
    const std::size_t row = static_cast<std::size_t>(image.width),
                      pixels = row * static_cast<std::size_t>(image.height);
    Imf::FrameBuffer buffer;
    const Imf::ChannelList& channels = image.header.channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) {
      const bool integer = c.channel().type == Imf::UINT;
      void* data = nullptr;
      if (integer)
        data = (image.integer[c.name()] = std::vector<std::uint32_t>(pixels)).data();
      else
        data = (image.real[c.name()] = std::vector<float>(pixels)).data();
      buffer.insert(c.name(), Imf::Slice(integer ? Imf::UINT : Imf::FLOAT, static_cast<char*>(data), 4, 4 * row));
    }
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace carreau::testing
