// SPDX-License-Identifier: BSD-3-Clause
// `carreau report`: a mesh in a file as a page that people open.
#include "base/json_output.h"
#include "base/output_files.h"
#include "base/signals.h"
#include "base/text_file.h"
#include "commands/commands.h"
#include "report/report_content.h"

namespace command {

namespace {

/// "part.html" of "folder/part.vtu": in the folder where the command runs.
std::string usual_name(const std::string& mesh) {
  const std::string name = mesh.substr(mesh.find_last_of('/') + 1);
  return name.substr(0, name.size() - suffix_of(name).size()) + ".html";
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  static const std::string harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789@%+=:,./-_";
  if (!word.empty() && word.find_first_not_of(harmless) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) c == '\'' ? text.append("'\\''") : text.append(1, c);
  return text + "'";
}

}  // namespace

std::string shell_line(const std::string& program, const std::vector<std::string>& words) {
  std::string line = program;
  for (const std::string& word : words) line.append(" ").append(quoted(word));
  return line;
}

int report(const ReportOptions& options) {
  catch_signals();
  const std::string out = options.out.empty() ? usual_name(options.mesh) : options.out;
  OutputFiles output({out}, {".html"}, {options.mesh});
  const MeshHandle mesh = read_mesh(options.mesh);
  ReportContent content = content_of(mesh.get());
  content.file = options.mesh;
  content.repeat = options.repeat;
  const std::string page = report_page(content);
  output.write([&](const std::vector<std::string>& hidden) { write_text(hidden.front(), page); });
  if (!options.json) return 0;
  nlohmann::ordered_json summary = check_json(content.check, options.mesh, defects_told);
  summary["output"] = out, summary["bytes"] = page.size();
  print_json("report", summary);
  return 0;
}

}  // namespace command
