// SPDX-License-Identifier: BSD-3-Clause
// The page: its frame, with the parts of one report in their places.
#include <algorithm>
#include <map>
#include <string_view>

#include "report/html_text.h"
#include "report/packing.h"
#include "report/page_parts.h"
#include "report/report_content.h"
#include "report/sections.h"
#include "report/viewer_data.h"

namespace command {
namespace {

/// Base64 of bytes in hexadecimal digits, as content security policies require for a hash.
std::string base64_of_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return base64_of(bytes);
}

/// The frame with each {{name}} replaced, once: names within parts are not replaced.
std::string filled(std::string_view frame, const std::map<std::string_view, std::string>& parts) {
  std::string page;
  for (std::size_t at = 0; at < frame.size();) {
    const std::size_t open = std::min(frame.find("{{", at), frame.size());
    page += frame.substr(at, open - at);
    if (open == frame.size()) break;
    const std::size_t close = frame.find("}}", open);
    page += parts.at(frame.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  return page;
}

std::string name_of_file(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::string plural(std::int64_t n, const char* one, const char* many) {
  return count_text(n) + " " + (n == 1 ? one : many);
}

/// Describes the elements, and how the page draws them.
std::string lead_of(const ReportContent& content) {
  const MeshCheck& c = content.check;
  std::string text = plural(c.faces, "face", "faces") + ", " + plural(c.vertices, "vertex", "vertices") + ", " +
                     plural(c.triangles, "triangle", "triangles") + ".";
  if (c.cells.triangles6 + c.cells.quads8 > 0)
    text += " Elements of order 2 are drawn curved, and measured straight between their corners unless stated otherwise.";
  if (c.cells.quads4 + c.cells.quads8 > 0)
    text += std::string(" A quadrilateral is ") + (c.cells.quads8 > 0 ? "picked" : "drawn") + " as two triangles, and counts once in histograms.";
  if (!c.measured) text += " Indices out of range or numbers that are not finite: the mesh can be neither drawn nor measured.";
  return text;
}

std::string sections_of(const ReportContent& content) {
  return worst_section(content) + histograms_section(content) + faces_section(content) + asked_section(content) +
         delivered_section(content) + warnings_section(content) + mesh_section(content) + times_section(content) +
         command_section(content);
}

}  // namespace

std::string report_page(const ReportContent& content) {
  const std::string heading = "Mesh of " + name_of_file(content.file);
  const bool drawn = !content.values.empty();
  return filled(page_parts::page,
                {{"style-hash", base64_of_hex(page_parts::style_sha256)},
                 {"script-hash", base64_of_hex(page_parts::script_sha256)},
                 {"generator", html(std::string("carreau ") + carreau_version())},
                 {"title", html(heading)},
                 {"heading", html(heading)},
                 {"style", page_parts::style},
                 {"script", page_parts::script},
                 {"lead", html(lead_of(content))},
                 {"verdict", verdict_section(content)},
                 {"sections", sections_of(content)},
                 {"data", drawn ? viewer_data({content.mesh, content.halves, content.values}) : ""}});
}

}  // namespace command
