// SPDX-License-Identifier: BSD-3-Clause
#include "report/histogram.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "draw/colour_scale.h"
#include "report/html_text.h"

namespace command {
namespace {

/// Measures of the drawing, in its own units.
constexpr double bar_width = 15, drawn_height = 120, label_height = 20;

double share_of(const TriangleValues& values, double x) {
  if (values.scale == Scale::linear) return (x - values.low) / (values.high - values.low);
  return x > 0 ? std::log(x / values.low) / std::log(values.high / values.low) : 0;
}

double value_at(const TriangleValues& values, double share) {
  if (values.scale == Scale::linear) return values.low + share * (values.high - values.low);
  return values.low * std::pow(values.high / values.low, share);
}

std::string range_text(const Histogram& h, std::size_t i) {
  return number_text(h.bounds[i]) + " to " + number_text(h.bounds[i + 1]);
}

std::string bar(const Histogram& h, std::size_t i, std::int64_t most) {
  // The lowest visible bar: readers look for one triangle of a million.
  const double share = static_cast<double>(h.counts[i]) / static_cast<double>(most);
  const double height = h.counts[i] > 0 ? std::max(1.5, share * drawn_height) : 0;
  char text[400];
  std::snprintf(text, sizeof text,
                "<rect x=\"%g\" y=\"%.2f\" width=\"%g\" height=\"%.2f\" fill=\"%s\"><title>%s: %s</title></rect>\n",
                static_cast<double>(i) * bar_width + 1, drawn_height - height, bar_width - 2, height,
                hex_text(scale_rgb((static_cast<double>(i) + 0.5) / histogram_classes)).c_str(), range_text(h, i).c_str(),
                count_text(h.counts[i]).c_str());
  return text;
}

std::string label(double x, const char* anchor, const std::string& text) {
  char line[200];
  std::snprintf(line, sizeof line, "<text x=\"%g\" y=\"%g\" text-anchor=\"%s\">%s</text>\n", x, drawn_height + 15, anchor,
                text.c_str());
  return line;
}

std::string drawing(const Histogram& h, const TriangleValues& values) {
  const double width = bar_width * histogram_classes;
  const std::int64_t most = std::max<std::int64_t>(1, *std::max_element(h.counts.begin(), h.counts.end()));
  char head[200];
  std::snprintf(head, sizeof head, "<svg viewBox=\"0 0 %g %g\" role=\"img\" aria-label=\"", width,
                drawn_height + label_height);
  std::string text = head + html(values.title + ", how many elements have it") + "\">\n";
  for (std::size_t i = 0; i < histogram_classes; ++i) text += bar(h, i, most);
  char line[120];
  std::snprintf(line, sizeof line, "<path d=\"M0 %g H%g\" />\n", drawn_height, width);
  return text + line + label(0, "start", number_text(h.bounds.front())) +
         label(width / 2, "middle", number_text(h.bounds[histogram_classes / 2])) +
         label(width, "end", number_text(h.bounds.back())) + "</svg>\n";
}

HtmlTable numbers_of(const Histogram& h, const TriangleValues& values) {
  HtmlTable table{.id = "histogram-" + values.key, .caption = values.title, .columns = {"From", "To", "Elements"}};
  for (std::size_t i = 0; i < histogram_classes; ++i)
    table.rows.push_back({number_cell(h.bounds[i]), number_cell(h.bounds[i + 1]), count_cell(h.counts[i])});
  return table;
}

}  // namespace

Histogram histogram_of(const TriangleValues& values, const std::vector<std::uint8_t>& halves) {
  Histogram h;
  for (int i = 0; i <= histogram_classes; ++i)
    h.bounds[static_cast<std::size_t>(i)] = value_at(values, static_cast<double>(i) / histogram_classes);
  for (std::size_t t = 0; t < values.values.size(); ++t) {
    if (halves[t] == 2) continue;
    const double x = values.values[t];
    if (std::isnan(x)) {
      ++h.without;
      continue;
    }
    const double place = std::clamp(share_of(values, x) * histogram_classes, 0.0, histogram_classes - 1.0);
    ++h.counts[static_cast<std::size_t>(place)];
  }
  return h;
}

std::string html_of(const Histogram& h, const TriangleValues& values) {
  std::string title = values.title;
  if (!values.unit.empty()) title.append(", ").append(values.unit);
  std::string help = html(values.help);
  if (h.without > 0) help.append(" ").append(count_text(h.without)).append(" elements have none.");
  const std::string text =
      "<figure><figcaption>" + html(title) + "<small>" + help + "</small></figcaption>\n" + drawing(h, values);
  return text + "<details><summary>As numbers</summary>\n" + html_of(numbers_of(h, values)) + "</details></figure>\n";
}

}  // namespace command
