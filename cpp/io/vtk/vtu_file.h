// SPDX-License-Identifier: BSD-3-Clause
// VTK XML whose arrays follow the XML as raw bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "io/mesh_writers.h"

namespace carreau {

template <typename T>
struct VtkType;
template <>
struct VtkType<double> {
  static constexpr const char* name = "Float64";
};
template <>
struct VtkType<std::int32_t> {
  static constexpr const char* name = "Int32";
};
template <>
struct VtkType<std::int64_t> {
  static constexpr const char* name = "Int64";
};
template <>
struct VtkType<std::uint8_t> {
  static constexpr const char* name = "UInt8";
};

inline std::string escaped_for_xml(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '"')
      text += "&quot;";
    else
      text += static_cast<unsigned char>(c) < ' ' ? '_' : c;  // XML 1.0 has no way to write most control characters
  }
  return text;
}

/// The XML so far and the data that will follow it.
class VtuFile {
 public:
  void xml(const std::string& text) { xml_ += text; }

  /// The first tags, up to the piece. Version 2.2 has today's order of the nodes of Lagrange cells.
  void open(const std::string& version, std::size_t points, std::size_t cells) {
    const std::string order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    xml("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"" + version + "\" byte_order=\"" + order +
        "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
        std::to_string(cells) + "\">\n");
  }

  template <typename T>
  void array(const std::string& name, int components, const std::vector<T>& values) {
    xml_ += std::string("<DataArray type=\"") + VtkType<T>::name + "\" Name=\"" + escaped_for_xml(name) +
            "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"appended\" offset=\"" +
            std::to_string(offset_) + "\"/>\n";
    const std::uint64_t length = values.size() * sizeof(T);
    std::string& bytes = data_.emplace_back(sizeof length + length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    if (length > 0) std::memcpy(bytes.data() + sizeof length, values.data(), length);
    offset_ += bytes.size();
  }

  /// An array of the whole file instead of its points or cells.
  void field(const std::string& name, const std::vector<std::int32_t>& values) {
    xml_ += "<DataArray type=\"Int32\" Name=\"" + escaped_for_xml(name) + "\" NumberOfTuples=\"" +
            std::to_string(values.size()) + "\" format=\"ascii\">\n";
    for (const std::int32_t value : values) xml_ += std::to_string(value) + "\n";
    xml_ += "</DataArray>\n";
  }

  /// Gives everything away, array by array.
  void finish(const ByteSink& sink) {
    sink(xml_ + "<AppendedData encoding=\"raw\">\n_");
    for (std::string& bytes : data_) {
      sink(bytes);
      std::string().swap(bytes);
    }
    sink("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  std::string xml_;
  std::vector<std::string> data_;
  std::uint64_t offset_ = 0;
};

}  // namespace carreau
