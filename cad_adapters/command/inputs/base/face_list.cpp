// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/face_list.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace command {

double narrowness(const FaceLook& face) {
  // Sides a and b: a + b = perimeter / 2, a b = area.
  const double mean = face.perimeter / 4, rest = mean * mean - face.area;
  if (!(rest > 0) || !(face.area > 0)) return 1;
  const double root = std::sqrt(rest);
  return (mean + root) * (mean + root) / face.area;
}

void print_faces(const std::vector<FaceLook>& faces) {
  std::printf("%8s  %-22s %12s %10s  %-70s %s\n", "face", "kind", "area", "narrowness", "box", "name");
  for (const FaceLook& face : faces) {
    char box[200];
    std::snprintf(box, sizeof box, "(%.5g, %.5g, %.5g) - (%.5g, %.5g, %.5g)", face.low[0], face.low[1], face.low[2],
                  face.high[0], face.high[1], face.high[2]);
    std::printf("%8d  %-22s %12.6g %10.4g  %-70s %s\n", static_cast<int>(face.number), face.kind.c_str(), face.area,
                narrowness(face), box, face.name.c_str());
  }
}

nlohmann::ordered_json faces_json(const std::vector<FaceLook>& faces) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FaceLook& face : faces)
    list.push_back({{"face", face.number},
                    {"name", face.name},
                    {"kind", face.kind},
                    {"area", face.area},
                    {"perimeter", face.perimeter},
                    {"narrowness", narrowness(face)},
                    {"box", {face.low, face.high}}});
  return list;
}

bool fits(const std::string& name, const std::string& pattern) {
  // The last star may take more characters, as long as the rest does not fit.
  std::size_t n = 0, p = 0, star = std::string::npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p, ++n;
    } else if (star != std::string::npos) {
      p = star + 1, n = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace command
