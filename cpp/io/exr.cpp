// SPDX-License-Identifier: BSD-3-Clause
#include "io/exr.h"

#include <openexr.h>

#include <algorithm>
#include <deque>
#include <future>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>

#include "io/files.h"
#include "support/error.h"

namespace carreau {

namespace {

// Chunks of 2^31 bytes and more are beyond the format; this leaves room for some hundred channels of 32 rows.
constexpr int max_pixels_a_side = 65536;

// The state for the library's callbacks.
struct Sink {
  NewFile* file = nullptr;
  std::mutex mutex;
  std::string message;       // first error of the library
  std::exception_ptr error;  // first error of the file

  void keep(const char* text) {
    const std::lock_guard lock(mutex);
    if (message.empty()) message = text != nullptr ? text : "";
  }
};

Sink* sink_of(exr_const_context_t context) {
  void* user = nullptr;
  exr_get_user_data(context, &user);
  return static_cast<Sink*>(user);
}

void on_error(exr_const_context_t context, exr_result_t, const char* text) {
  if (Sink* sink = sink_of(context)) sink->keep(text);
}

int64_t on_write(exr_const_context_t, void* user, const void* buffer, uint64_t size, uint64_t offset,
                 exr_stream_error_func_ptr_t) {
  auto* sink = static_cast<Sink*>(user);
  try {
    sink->file->write_at(offset, {static_cast<const char*>(buffer), static_cast<std::size_t>(size)});
    return static_cast<int64_t>(size);
  } catch (...) {
    if (!sink->error) sink->error = std::current_exception();
    return -1;
  }
}

exr_pixel_type_t stored_type(ExrType type) {
  switch (type) {
    case ExrType::half:
      return EXR_PIXEL_HALF;
    case ExrType::integer:
      return EXR_PIXEL_UINT;
    default:
      return EXR_PIXEL_FLOAT;
  }
}

void check_part(const ExrPart& part) {
  const std::string name = "the part '" + part.name + "' of an EXR file ";
  if (part.width < 1 || part.height < 1 || part.width > max_pixels_a_side || part.height > max_pixels_a_side)
    throw InvalidArgument(name + "would be " + std::to_string(part.width) + " x " + std::to_string(part.height) +
                          " pixels; each number must be from 1 to " + std::to_string(max_pixels_a_side));
  if (part.channels.empty()) throw InvalidArgument(name + "has no channel");
  std::set<std::string> names;
  for (const ExrChannel& channel : part.channels)
    if (!names.insert(channel.name).second)
      throw InvalidArgument(name + "has two channels of the name '" + channel.name + "'");
}

// Compressed rows of a part.
struct Packed {
  int row = 0;
  std::string bytes;
};

}  // namespace

struct ExrWriter::State {
  State(const std::string& name, std::span<const ExrPart> given, const ExrOptions& how)
      : path(name), parts(given.begin(), given.end()), options(how), file(name) {
    sink.file = &file;
  }
  ~State() {
    if (context != nullptr) exr_finish(&context);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void require(exr_result_t result) {
    if (result == EXR_ERR_SUCCESS) return;
    if (sink.error) std::rethrow_exception(sink.error);
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    const std::string why = sink.message.empty() ? exr_get_default_error_message(result) : sink.message;
    throw FileError("cannot write '" + path + "': " + why);
  }

  void set(int part, const ExrAttribute& attribute) {
    const char* name = attribute.name.c_str();
    if (const auto* integer = std::get_if<std::int32_t>(&attribute.value)) {
      require(exr_attr_set_int(context, part, name, *integer));
    } else if (const auto* real = std::get_if<double>(&attribute.value)) {
      require(exr_attr_set_double(context, part, name, *real));
    } else if (const auto* pair = std::get_if<Vec2>(&attribute.value)) {
      exr_attr_v2d_t value{};
      value.x = pair->x(), value.y = pair->y();
      require(exr_attr_set_v2d(context, part, name, &value));
    } else {
      require(exr_attr_set_string(context, part, name, std::get<std::string>(attribute.value).c_str()));
    }
  }

  void add_part(const ExrPart& part) {
    int index = 0;
    require(exr_add_part(context, part.name.c_str(), EXR_STORAGE_SCANLINE, &index));
    const exr_compression_t compression =
        options.compression == ExrCompression::piz ? EXR_COMPRESSION_PIZ : EXR_COMPRESSION_ZIP;
    // All parts of a file must have one display window: the smallest one around all of them.
    exr_attr_box2i_t display{}, data{};
    for (const ExrPart& each : parts)
      display.max.x = std::max(display.max.x, each.width - 1), display.max.y = std::max(display.max.y, each.height - 1);
    data.max.x = part.width - 1, data.max.y = part.height - 1;
    const exr_attr_v2f_t centre{};
    require(exr_initialize_required_attr(context, index, &display, &data, 1, &centre, 1, EXR_LINEORDER_INCREASING_Y,
                                         compression));
    for (const ExrChannel& channel : part.channels)
      require(exr_add_channel(context, index, channel.name.c_str(), stored_type(channel.type),
                              channel.type == ExrType::half ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR, 1,
                              1));
    for (const ExrAttribute& attribute : part.attributes) set(index, attribute);
  }

  Packed pack(int part, const exr_chunk_info_t& chunk, const ExrFill& fill);

  std::string path;
  std::vector<ExrPart> parts;
  ExrOptions options;
  NewFile file;
  Sink sink;
  exr_context_t context = nullptr;
};

// The rows of one chunk, filled and compressed. From any thread: the context is only read.
Packed ExrWriter::State::pack(int part, const exr_chunk_info_t& chunk, const ExrFill& fill) {
  const std::vector<ExrChannel>& channels = parts[part].channels;
  std::vector<ExrPlane> planes(channels.size());
  const std::size_t pixels = static_cast<std::size_t>(chunk.width) * static_cast<std::size_t>(chunk.height);
  for (ExrPlane& plane : planes) plane.resize(pixels);
  fill(planes);

  exr_encode_pipeline_t encoder{};  // the value of EXR_ENCODE_PIPELINE_INITIALIZER, without Clang's warning
  require(exr_encoding_initialize(context, part, &chunk, &encoder));
  const auto release = [&](exr_encode_pipeline_t* e) { exr_encoding_destroy(context, e); };
  const std::unique_ptr<exr_encode_pipeline_t, decltype(release)> guard(&encoder, release);
  for (int k = 0; k < encoder.channel_count; ++k) {
    exr_coding_channel_info_t& slot = encoder.channels[k];
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const ExrChannel& channel) { return channel.name == slot.channel_name; });
    const auto c = static_cast<std::size_t>(found - channels.begin());
    slot.user_bytes_per_element = 4;
    slot.user_data_type =
        static_cast<std::uint16_t>(channels[c].type == ExrType::integer ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT);
    slot.user_pixel_stride = 4;
    slot.user_line_stride = 4 * chunk.width;
    slot.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(planes[c].data());
  }
  require(exr_encoding_choose_default_routines(context, part, &encoder));
  // Chunks are written in order, by the thread that waits for them.
  encoder.yield_until_ready_fn = nullptr;
  encoder.write_fn = nullptr;
  require(exr_encoding_run(context, part, &encoder));
  return {chunk.start_y, {static_cast<const char*>(encoder.compressed_buffer), encoder.compressed_bytes}};
}

ExrWriter::ExrWriter(const std::string& path, std::span<const ExrPart> parts, const ExrOptions& options) {
  if (parts.empty()) throw InvalidArgument("an EXR file needs a part");
  std::set<std::string> names;
  for (const ExrPart& part : parts) {
    check_part(part);
    if (!names.insert(part.name).second)
      throw InvalidArgument("two parts of an EXR file have the name '" + part.name + "'");
  }
  state_ = std::make_unique<State>(path, parts, options);
  State& s = *state_;
  exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
  setup.error_handler_fn = on_error;
  setup.user_data = &s.sink;
  setup.write_fn = on_write;
  s.require(exr_start_write(&s.context, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &setup));
  for (const ExrPart& part : parts) s.add_part(part);
  s.require(exr_write_header(s.context));
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write_part(int part, const ExrPrepare& prepare) {
  State& s = *state_;
  std::deque<std::future<Packed>> under_way;
  const auto write_oldest = [&] {
    const Packed packed = under_way.front().get();
    under_way.pop_front();
    s.require(exr_write_scanline_chunk(s.context, part, packed.row, packed.bytes.data(), packed.bytes.size()));
  };
  const std::size_t together = static_cast<std::size_t>(std::max(s.options.threads, 1));
  for (int row = 0; row < s.parts[part].height;) {
    exr_chunk_info_t chunk{};
    s.require(exr_write_scanline_chunk_info(s.context, part, row, &chunk));
    ExrFill fill = prepare(row, chunk.height);
    row += chunk.height;
    under_way.push_back(std::async(together > 1 ? std::launch::async : std::launch::deferred,
                                   [&s, part, chunk, fill = std::move(fill)] { return s.pack(part, chunk, fill); }));
    if (under_way.size() >= together) write_oldest();
  }
  while (!under_way.empty()) write_oldest();
}

void ExrWriter::commit() {
  State& s = *state_;
  s.require(exr_finish(&s.context));
  if (s.sink.error) std::rethrow_exception(s.sink.error);
  s.file.commit();
}

}  // namespace carreau
