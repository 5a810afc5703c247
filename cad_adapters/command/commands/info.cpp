// SPDX-License-Identifier: BSD-3-Clause
// `carreau info` on Bezier patches and on faces with a shared library; CAD files have a report of their own.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/text_file.h"
#include "commands/commands.h"
#include "inputs/base/cad_input.h"
#include "inputs/base/model_input.h"
#include "inputs/built/formula_input.h"
#include "inputs/built/grid_input.h"
#include "inputs/built/molecule_input.h"
#include "inputs/built/triangles_input.h"
#include "inputs/open_input.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

std::string sentence(const ModelDanger& danger) {
  char text[160];
  if (danger.ic == 0)
    std::snprintf(text, sizeof text, "face %d: %s", static_cast<int>(danger.face), danger.text.c_str());
  else
    std::snprintf(text, sizeof text, "face %d, side %d: %s", static_cast<int>(danger.face), static_cast<int>(danger.ic),
                  danger.text.c_str());
  return text;
}

}  // namespace

int info(const InfoOptions& options) {
  check_geometry_name(options.input);
  if (is_triangles(options.input) && options.host.empty() && !options.faces) {
    print_triangles_info(options.input, options.triangles, options.json);
    return 0;
  }
  if (is_triangles(options.input) && options.host.empty()) {
    print_faces(open_triangles(options.input, options.triangles)->faces());
    return 0;
  }
  const bool in_memory = needs_host(options.input) || suffix_of(options.input) == ".bpt" ||
                         is_molecule(options.input) || is_grid(options.input, options.grid) || is_formula(options.input);
  if (!in_memory) {
    return print_cad_info(options);
  }
  const auto input = open_input(options.input, options);
  const ModelFigures figures = static_cast<const ModelInput&>(*input).look_at();
  if (options.json) {
    Json dangers = Json::array();
    for (const ModelDanger& d : figures.dangers)
      dangers.push_back({{"kind", d.kind}, {"face", d.face}, {"side", d.ic}, {"text", d.text}});
    Json value = {{"input", options.input},
                  {"faces", figures.faces},
                  {"sides", figures.sides},
                  {"points", figures.points},
                  {"diagonal", input->diagonal()},
                  {"poles", figures.poles},
                  {"shortest_side", figures.shortest},
                  {"dangers", dangers}};
    if (options.faces) value["face_list"] = faces_json(input->faces());
    print_json("info", value);
    return 0;
  }
  std::printf("faces       %d\nsides       %d\npoints      %d\ndiagonal    %.6g\npoles       %d\nshortest side %.6g\n",
              figures.faces, figures.sides, figures.points, input->diagonal(), figures.poles, figures.shortest);
  if (figures.dangers.empty()) std::puts("nothing looks dangerous");
  int told = 0;
  std::string kind;
  for (const ModelDanger& d : figures.dangers) {
    if (d.kind != kind) {
      int count = 0;
      for (const ModelDanger& other : figures.dangers) count += other.kind == d.kind ? 1 : 0;
      std::printf("%s: %d\n", d.kind.c_str(), count);
      kind = d.kind, told = 0;
    }
    if (++told <= options.limit) std::printf("  %s\n", sentence(d).c_str());
    if (told == options.limit + 1) std::puts("  ...");
  }
  if (options.faces) print_faces(input->faces());
  return 0;
}

}  // namespace command
