// SPDX-License-Identifier: BSD-3-Clause
#include "fields/fields.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "cad/fundamental_forms.h"
#include "fields/false_colours.h"
#include "fields/field_samples.h"
#include "io/files.h"
#include "io/png.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau {

namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();
const Vec3 nowhere{nan, nan, nan};
constexpr int max_pixels_a_side = 65536;  // as in io/exr.cpp

// Channels in the order of this table; a file has them by name.
struct Channel {
  const char* name;
  FieldGroup group;
  ExrType type = ExrType::real;
};
constexpr std::array channels{Channel{"size.h", field_size},
                              Channel{"size.h1", field_size},
                              Channel{"size.h2", field_size},
                              Channel{"size.angle", field_size},
                              Channel{"induced.e", field_induced},
                              Channel{"induced.f", field_induced},
                              Channel{"induced.g", field_induced},
                              Channel{"target.m11", field_target},
                              Channel{"target.m12", field_target},
                              Channel{"target.m22", field_target},
                              Channel{"curvature.k1", field_curvature},
                              Channel{"curvature.k2", field_curvature},
                              Channel{"position.x", field_position},
                              Channel{"position.y", field_position},
                              Channel{"position.z", field_position},
                              Channel{"normal.x", field_normal},
                              Channel{"normal.y", field_normal},
                              Channel{"normal.z", field_normal},
                              Channel{"deviation.a0", field_deviation},
                              Channel{"deviation.a1", field_deviation},
                              Channel{"triangle", field_triangle, ExrType::integer},
                              Channel{"mask", field_mask},
                              Channel{"physical.h", field_governs},
                              Channel{"physical.h1", field_governs},
                              Channel{"physical.h2", field_governs},
                              Channel{"physical.angle", field_governs},
                              Channel{"geometric.h", field_governs},
                              Channel{"geometric.h1", field_governs},
                              Channel{"geometric.h2", field_governs},
                              Channel{"geometric.angle", field_governs},
                              Channel{"governs", field_governs, ExrType::integer},
                              Channel{"R", field_preview, ExrType::half},
                              Channel{"G", field_preview, ExrType::half},
                              Channel{"B", field_preview, ExrType::half},
                              Channel{"A", field_preview, ExrType::half}};

// Samples that choose the range of colours and the shape of the image.
constexpr int probe_columns = 32;
// The shorter side of an image is not below this share of the longer one.
constexpr double flattest = 1.0 / 16;
// Lengths come from a coarse sample: a shape that differs less than this from a square is taken as one.
constexpr double nearly_square = 0.01;
// Lines of previews, in pixels.
constexpr double edge_width = 1.2, curve_width = 2.6;
// Sides of triangles fade out where triangles are this many pixels high, and less.
constexpr double visible_height = 7, hidden_height = 2;

// The pixels of some rows, and the host's values there.
struct Block {
  int first = 0, rows = 0;
  std::vector<std::uint8_t> mask;
  std::vector<std::uint32_t> pixel;  // pixels inside, as ranks in the block
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  std::vector<Metric2> prescribed;
  std::vector<OriginsAt> origins;  // or empty
  FieldDeviations deviations;
};

unsigned wants_of(unsigned groups) {
  unsigned want = 0;
  if ((groups & field_position) != 0) want |= want_position;
  if ((groups & (field_size | field_induced | field_normal | field_preview | field_governs)) != 0) want |= want_first;
  if ((groups & field_curvature) != 0) want |= want_first | want_second;
  return want;
}

PixelGrid grid_of(const FieldShape& shape, int width, int height) {
  return {.low = shape.low, .high = shape.high, .width = width, .height = height};
}

// Writes the channels of one block; channels that are not requested have no plane.
class Painter {
 public:
  Painter(unsigned groups, std::span<ExrPlane> planes) {
    std::size_t next = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if ((groups & channels[c].group) == 0) continue;
      planes_[c] = &planes[next++];
      const bool opaque = channels[c].group == field_mask || channels[c].group == field_preview;
      const std::uint32_t empty = channels[c].type == ExrType::integer ? no_triangle
                                  : opaque                             ? 0U
                                                                       : std::bit_cast<std::uint32_t>(no_value);
      std::fill(planes_[c]->begin(), planes_[c]->end(), empty);
    }
    for (const unsigned group : {field_size, field_induced, field_target, field_curvature, field_position, field_normal,
                                 field_deviation, field_triangle, field_mask, field_preview, field_governs})
      first_[std::countr_zero(group)] = static_cast<std::size_t>(
          std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.group == group; }) -
          channels.begin());
  }

  /// Values of a group's channels at a pixel, in the order of the table.
  void put(FieldGroup group, std::uint32_t pixel, std::initializer_list<double> values) const {
    std::size_t c = first_[std::countr_zero(static_cast<unsigned>(group))];
    for (const double value : values) (*planes_[c++])[pixel] = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  }
  /// A whole number in the channel of this rank in its group.
  void put_number(FieldGroup group, std::size_t rank, std::uint32_t pixel, std::uint32_t number) const {
    (*planes_[first_[std::countr_zero(static_cast<unsigned>(group))] + rank])[pixel] = number;
  }

 private:
  std::array<ExrPlane*, channels.size()> planes_{};
  std::array<std::size_t, 11> first_{};
};

// Darkness of a pixel by the sides of a triangle, 0 to 1.
double ink_of_triangle(const std::array<Vec2, 3>& corner, const Vec2& pixel) {
  double nearest = infinity, longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    nearest = std::min(nearest, distance_to_segment(pixel, corner[i], corner[(i + 1) % 3]));
    longest = std::max(longest, norm(corner[(i + 1) % 3] - corner[i]));
  }
  const double height = std::abs(cross(corner[1] - corner[0], corner[2] - corner[0])) / longest;
  const double visible = std::clamp((height - hidden_height) / (visible_height - hidden_height), 0.0, 1.0);
  return 0.8 * visible * std::clamp(edge_width / 2 + 0.5 - nearest, 0.0, 1.0);
}

void paint_origins(const Painter& painter, const OriginsAt& at, std::uint32_t pixel) {
  const TangentSizes &p = at.physical, &g = at.geometric;
  painter.put(field_governs, pixel, {p.h, p.h1, p.h2, p.angle, g.h, g.h1, g.h2, g.angle});
  if (at.governs) painter.put_number(field_governs, 8, pixel, static_cast<std::uint32_t>(*at.governs));
}

// Relief: surfaces that face this direction, or turn their back to it, are lightest.
double shade_of(const Vec3& normal) {
  const Vec3 light{0.36, 0.48, 0.8};
  return 0.62 + 0.38 * std::abs(dot(normal, light));
}

}  // namespace

struct FieldImage::State {
  State(const FieldSource& what, const FieldOptions& how, std::function<FieldDeviations()> measure, Cad& geometry,
        Monitor& who)
      : source(what),
        options(how),
        deviations(std::move(measure)),
        cad(geometry),
        monitor(who),
        sampler(what.ref, wants_of(how.groups),
                (how.groups & (field_size | field_preview | field_governs)) != 0 ? what.prescribed : nullptr, geometry,
                who) {}

  void probe();
  void choose_grid(double length_u, double length_v);
  std::span<const std::array<std::int32_t, 3>> own_triangles();
  void make_rasters();
  std::shared_ptr<Block> sample(int first, int rows);
  void paint(const Block& block, std::span<ExrPlane> planes) const;
  void paint_point(const Painter& painter, const Block& block, std::size_t i) const;
  [[nodiscard]] LinearColour colour_of(const Block& block, std::size_t i, std::uint32_t triangle, double h,
                                       const Vec3& normal) const;

  [[nodiscard]] bool has(FieldGroup group) const { return (options.groups & group) != 0; }

  const FieldSource& source;
  FieldOptions options;
  std::function<FieldDeviations()> deviations;
  Cad& cad;
  Monitor& monitor;
  FieldSampler sampler;
  PixelGrid grid;
  std::optional<DomainRaster> domain;
  std::optional<TriangleRaster> triangles;
  std::vector<std::array<std::int32_t, 3>> own;  // of a mesh that is independent of its patches
  std::optional<LineRaster> curves;
  double smallest = 0, largest = 0;  // sizes at the ends of the scale of colours
};

// A coarse grid over the whole domain: lengths of the patch and range of the prescribed sizes.
void FieldImage::State::probe() {
  const bool needs_shape = options.width == 0;
  const Vec2 box = source.shape.high - source.shape.low;
  if (!(box.x() > 0 && box.y() > 0)) return choose_grid(1, 1);
  if (!needs_shape && !has(field_preview)) return choose_grid(1, 1);
  const PixelGrid coarse = grid_of(source.shape, probe_columns, probe_columns);
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(probe_columns) * probe_columns);
  DomainRaster(source.shape.loops, coarse).mask(0, probe_columns, inside);
  std::vector<Vec2> uv;
  for (int row = 0, k = 0; row < probe_columns; ++row)
    for (int column = 0; column < probe_columns; ++column, ++k)
      if (inside[static_cast<std::size_t>(k)] != 0) uv.push_back(coarse.centre(column, row));
  std::vector<SurfaceJet> jets(uv.size());
  std::vector<Metric2> metric(uv.size());
  FieldSampler probing(source.ref, want_first, has(field_preview) ? source.prescribed : nullptr, cad, monitor);
  probing.sample(uv, jets, metric);

  double length_u = 0, length_v = 0;
  smallest = infinity, largest = 0;
  const auto extend = [&](double h) {
    if (h > 0 && std::isfinite(h)) smallest = std::min(smallest, h), largest = std::max(largest, h);
  };
  for (std::size_t i = 0; i < uv.size(); ++i) {
    if (!is_finite(jets[i].su) || !is_finite(jets[i].sv)) continue;
    length_u += norm(jets[i].su), length_v += norm(jets[i].sv);
    extend(tangent_sizes(jets[i], metric[i]).h);
  }
  if (source.mesh != nullptr && !source.vertex_size.empty())
    for (const std::int32_t v : source.mesh->vertex) extend(source.vertex_size[static_cast<std::size_t>(v)]);
  choose_grid(box.x() * length_u, box.y() * length_v);
}

void FieldImage::State::choose_grid(double length_u, double length_v) {
  int width = options.width, height = options.height;
  if (width == 0) {
    const Vec2 box = source.shape.high - source.shape.low;
    double ratio = length_v / length_u;
    if (!(ratio > 0 && std::isfinite(ratio))) ratio = box.y() / box.x();  // the host gives no usable value
    if (!(ratio > 0 && std::isfinite(ratio)) || std::abs(ratio - 1) < nearly_square) ratio = 1;
    ratio = std::clamp(ratio, flattest, 1 / flattest);
    const auto shorter = [&](double share) {
      return std::max(1, static_cast<int>(std::lround(share * options.longest)));
    };
    width = ratio <= 1 ? options.longest : shorter(1 / ratio);
    height = ratio <= 1 ? shorter(ratio) : options.longest;
  }
  grid = grid_of(source.shape, width, height);
}

// Triangles whose corners are of several charts are points here, and keep their numbers.
std::span<const std::array<std::int32_t, 3>> FieldImage::State::own_triangles() {
  if (source.mesh->spread.empty()) return source.mesh->triangles;
  own = source.mesh->triangles;
  for (std::size_t t = 0; t < own.size(); ++t)
    if (source.mesh->is_spread(t)) own[t] = {own[t][0], own[t][0], own[t][0]};
  return own;
}

void FieldImage::State::make_rasters() {
  domain.emplace(source.shape.loops, grid);
  if (source.mesh != nullptr && (has(field_triangle) || has(field_deviation) || has(field_preview)))
    triangles.emplace(source.mesh->uv, own_triangles(), grid);
  if (has(field_preview)) curves.emplace(source.shape.lines, curve_width, grid);
}

// The part of the work that needs the caller's thread.
std::shared_ptr<Block> FieldImage::State::sample(int first, int rows) {
  monitor.progress(Phase::writing, source.ref, static_cast<double>(first) / grid.height);
  auto block = std::make_shared<Block>();
  block->first = first, block->rows = rows;
  block->mask.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(grid.width));
  domain->mask(first, rows, block->mask);
  std::uint32_t pixel = 0;
  for (int row = first; row < first + rows; ++row)
    for (int column = 0; column < grid.width; ++column, ++pixel)
      if (block->mask[pixel] != 0) {
        block->pixel.push_back(pixel);
        block->uv.push_back(grid.centre(column, row));
      }
  block->jets.resize(block->uv.size());
  block->prescribed.resize(block->uv.size());
  sampler.sample(block->uv, block->jets, block->prescribed);
  if (has(field_governs) && source.origins != nullptr) {
    block->origins.resize(block->uv.size());
    source.origins->at(block->uv, block->jets, block->prescribed, block->origins);
  }
  if (has(field_deviation) && triangles && deviations) block->deviations = deviations();
  return block;
}

// Colour of a pixel of the domain before its curves are drawn.
LinearColour FieldImage::State::colour_of(const Block& block, std::size_t i, std::uint32_t triangle, double h,
                                          const Vec3& normal) const {
  LinearColour colour = h > 0 ? false_colour(place_of_size(h, smallest, largest)) : colour_of_nothing;
  double light = is_finite(normal) ? shade_of(normal) : 1;
  if (triangle != TriangleRaster::none) {
    std::array<Vec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = grid.in_pixels(source.mesh->uv[static_cast<std::size_t>(source.mesh->triangles[triangle][k])]);
    light *= 1 - ink_of_triangle(corner, grid.in_pixels(block.uv[i]));
  }
  for (float& part : colour) part *= static_cast<float>(light);
  return colour;
}

void FieldImage::State::paint_point(const Painter& painter, const Block& block, std::size_t i) const {
  const std::uint32_t pixel = block.pixel[i];
  const SurfaceJet& jet = block.jets[i];
  if (has(field_induced)) {
    const FirstForm form = first_form(jet);
    painter.put(field_induced, pixel, {form.e, form.f, form.g});
  }
  if (has(field_target) && source.space != nullptr) {
    const Metric2 m = source.space->at(block.uv[i]);
    painter.put(field_target, pixel, {m.a, m.b, m.c});
  }
  if (has(field_curvature))
    if (const auto frame = principal_frame(jet)) painter.put(field_curvature, pixel, {frame->k1, frame->k2});
  if (has(field_position)) painter.put(field_position, pixel, {jet.s.x(), jet.s.y(), jet.s.z()});
  if (has(field_mask)) painter.put(field_mask, pixel, {1});
  if (!block.origins.empty()) paint_origins(painter, block.origins[i], pixel);
}

void FieldImage::State::paint(const Block& block, std::span<ExrPlane> planes) const {
  const Painter painter(options.groups, planes);
  std::vector<std::uint32_t> triangle(block.mask.size(), TriangleRaster::none);
  if (triangles) triangles->triangles(block.first, block.rows, triangle);
  std::vector<float> ink(block.mask.size(), 0.0F);
  if (curves) curves->coverage(block.first, block.rows, ink);
  if (has(field_preview))
    for (std::uint32_t pixel = 0; pixel < ink.size(); ++pixel) painter.put(field_preview, pixel, {0, 0, 0, ink[pixel]});
  for (std::size_t i = 0; i < block.pixel.size(); ++i) {
    paint_point(painter, block, i);
    const std::uint32_t pixel = block.pixel[i];
    const TangentSizes size = tangent_sizes(block.jets[i], block.prescribed[i]);
    if (has(field_size)) painter.put(field_size, pixel, {size.h, size.h1, size.h2, size.angle});
    if (has(field_normal) || has(field_preview)) {
      const Vec3 normal = unit_normal(block.jets[i]).value_or(nowhere);
      if (has(field_normal)) painter.put(field_normal, pixel, {normal.x(), normal.y(), normal.z()});
      if (has(field_preview)) {
        const LinearColour colour = colour_of(block, i, triangle[pixel], size.h, normal);
        const double light = 1 - static_cast<double>(ink[pixel]);
        painter.put(field_preview, pixel, {light * colour[0], light * colour[1], light * colour[2], 1});
      }
    }
    if (triangle[pixel] == TriangleRaster::none) continue;
    const std::uint32_t number = source.first_triangle + triangle[pixel];
    if (has(field_triangle)) painter.put_number(field_triangle, 0, pixel, number);
    if (has(field_deviation) && number < block.deviations.a0.size())
      painter.put(field_deviation, pixel, {block.deviations.a0[number], block.deviations.a1[number]});
  }
}

FieldImage::FieldImage(const FieldSource& source, const FieldOptions& options,
                       std::function<FieldDeviations()> deviations, Cad& cad, Monitor& monitor) {
  check_field_options(options);
  state_ = std::make_unique<State>(source, options, std::move(deviations), cad, monitor);
  state_->probe();
  state_->make_rasters();
}

FieldImage::~FieldImage() = default;

const PixelGrid& FieldImage::grid() const noexcept { return state_->grid; }
std::int64_t FieldImage::failures() const noexcept { return state_->sampler.failures(); }
const std::string& FieldImage::first_failure() const noexcept { return state_->sampler.first_failure(); }

ExrPart FieldImage::part() const {
  const State& s = *state_;
  ExrPart part{.name = "face." + std::to_string(s.source.ref),
               .width = s.grid.width,
               .height = s.grid.height,
               .channels = {},
               .attributes = s.source.attributes};
  for (const Channel& channel : channels)
    if (s.has(channel.group)) part.channels.push_back({channel.name, channel.type});
  const auto add = [&](const char* name, const auto& value) { part.attributes.push_back({name, value}); };
  add("carreau.version", std::string(CARREAU_ENGINE_VERSION));
  add("face", std::int32_t{s.source.ref});
  add("uv.low", s.grid.low);
  add("uv.high", s.grid.high);
  add("rows", std::string("v falls from row to row: the centre of row j, from 0, has "
                          "v = high - (j + 1/2) (high - low) / height; u rises from column to column"));
  if (s.has(field_triangle) && s.triangles) {
    add("triangle.first", static_cast<std::int32_t>(s.source.first_triangle));
    add("triangle.count", static_cast<std::int32_t>(s.source.mesh->triangles.size()));
  }
  if (s.has(field_preview) && s.largest > 0) add("preview.size", Vec2{s.smallest, s.largest});
  return part;
}

ExrPrepare FieldImage::pixels() {
  return [this](int first, int rows) -> ExrFill {
    return [this, block = state_->sample(first, rows)](std::span<ExrPlane> planes) { state_->paint(*block, planes); };
  };
}

std::string FieldImage::png() {
  const ExrPrepare prepare = pixels();
  const std::vector<ExrChannel> names = part().channels;
  std::array<std::size_t, 4> rgba{};
  for (std::size_t k = 0; k < rgba.size(); ++k)
    rgba[k] = static_cast<std::size_t>(
        std::find_if(names.begin(), names.end(), [k](const ExrChannel& c) { return c.name[0] == "RGBA"[k]; }) -
        names.begin());
  const int width = state_->grid.width;
  return png_bytes(width, state_->grid.height, [&](int first, int rows, std::span<std::array<float, 3>> colours) {
    std::vector<ExrPlane> planes(names.size(), ExrPlane(colours.size()));
    prepare(first, rows)(planes);
    const auto at = [&](std::size_t k, std::size_t i) { return std::bit_cast<float>(planes[rgba[k]][i]); };
    // Over white.
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) colours[i][k] = at(k, i) + (1 - at(3, i));
  });
}

std::string field_file_of_face(const std::string& path, int ref) {
  const std::string suffix = suffix_of(path);
  if (path.size() <= suffix.size() || (suffix != ".exr" && suffix != ".png"))
    throw InvalidArgument("the name '" + path + "' ends neither in .exr nor in .png");
  const std::size_t stem = path.size() - suffix.size();
  return path.substr(0, stem) + ".face." + std::to_string(ref) + path.substr(stem);
}

void check_field_options(const FieldOptions& options) {
  const auto check = [](const char* name, int pixels) {
    if (pixels < 1 || pixels > max_pixels_a_side)
      throw InvalidArgument(std::string("the ") + name + " of an image is " + std::to_string(pixels) +
                            " pixels; it must be from 1 to " + std::to_string(max_pixels_a_side));
  };
  if (options.width == 0 && options.height == 0) {
    check("longer side", options.longest);
  } else {
    check("width", options.width);
    check("height", options.height);
  }
  if (options.groups == 0 || (options.groups & ~unsigned{all_fields}) != 0)
    throw InvalidArgument("the groups of channels are " + std::to_string(options.groups) + ", which is not from 1 to " +
                          std::to_string(unsigned{all_fields}));
  if (options.file.threads < 1)
    throw InvalidArgument("the number of threads is " + std::to_string(options.file.threads) +
                          "; it must be at least 1");
}

}  // namespace carreau
