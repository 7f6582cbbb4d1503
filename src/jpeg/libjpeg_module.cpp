// The module that reads JPEG files by libjpeg-turbo.
#include <csetjmp>
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>  // it takes its types from the headers above

#include <array>

#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "jpeg/libjpeg_calls.h"

// libjpeg exits by longjmp, which does not run destructors. So all objects that own memory are members of Decoder,
// outside of the functions that call libjpeg, which have only trivial local variables.

namespace ombre::jpeg {
namespace {

// Progressive files have some ten scans; a small file with thousands of them would take minutes.
constexpr int most_scans = 500;

struct Decoder : NotCopied {
  jpeg_decompress_struct state{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  std::string_view bytes;
  std::vector<uint8_t> row, rgba;

  explicit Decoder(std::string_view from) : bytes(from) {}
  ~Decoder() { jpeg_destroy_decompress(&state); }
};

[[noreturn]] void fail(Decoder& decoder, const char* message) {
  std::snprintf(decoder.message.data(), decoder.message.size(), "%s", message);
  std::longjmp(decoder.jump, 1);
}

[[noreturn]] void on_error(j_common_ptr state) {
  auto* decoder = static_cast<Decoder*>(state->client_data);
  state->err->format_message(state, decoder->message.data());
  std::longjmp(decoder->jump, 1);
}

// Warnings tell of damaged data, whose pixels would be invented.
void on_message(j_common_ptr state, int level) {
  if (level < 0) on_error(state);
}

void on_progress(j_common_ptr state) {
  const auto* decoder = static_cast<Decoder*>(state->client_data);
  if (decoder->state.input_scan_number > most_scans)
    fail(*static_cast<Decoder*>(state->client_data), "it has more than 500 scans");
}

// Reads what the file says of its pixels, and how they become colours.
bool read_header(Decoder& decoder) {
  if (setjmp(decoder.jump)) return false;
  jpeg_decompress_struct& state = decoder.state;
  state.err = jpeg_std_error(&decoder.errors);
  state.client_data = &decoder;  // jpeg_create_decompress() keeps both
  decoder.errors.error_exit = on_error;
  decoder.errors.emit_message = on_message;
  jpeg_create_decompress(&state);
  decoder.progress.progress_monitor = on_progress;
  state.progress = &decoder.progress;
  jpeg_mem_src(&state, reinterpret_cast<const unsigned char*>(decoder.bytes.data()), decoder.bytes.size());
  jpeg_read_header(&state, TRUE);
  if (state.data_precision != 8) fail(decoder, "its values have more than 8 bits; save it with 8");
  if (state.jpeg_color_space == JCS_CMYK || state.jpeg_color_space == JCS_YCCK)
    fail(decoder, "its colours are those of inks (CMYK), which differ from printer to printer; save it in RGB");
  if (state.num_components != 1 && state.num_components != 3)
    fail(decoder, "its pixels have neither one value nor three; save it in RGB");
  state.out_color_space = JCS_RGB;
  state.dct_method = JDCT_ISLOW;
  state.do_fancy_upsampling = TRUE;
  state.do_block_smoothing = FALSE;  // it differs between versions of the library
  return true;
}

bool read_pixels(Decoder& decoder) {
  if (setjmp(decoder.jump)) return false;
  jpeg_decompress_struct& state = decoder.state;
  jpeg_start_decompress(&state);
  uint8_t* to = decoder.rgba.data();
  while (state.output_scanline < state.output_height) {
    JSAMPROW from = decoder.row.data();
    jpeg_read_scanlines(&state, &from, 1);
    for (JDIMENSION column = 0; column < state.output_width; ++column, from += 3) {
      *to++ = from[0];
      *to++ = from[1];
      *to++ = from[2];
      *to++ = 255;
    }
  }
  jpeg_finish_decompress(&state);
  return true;
}

// Checks the size in the header before memory is allocated.
void check_size(const Decoder& decoder, uint64_t most_pixels, const std::string& name) {
  const jpeg_decompress_struct& state = decoder.state;
  const uint64_t pixels = uint64_t{state.image_width} * state.image_height;
  const std::string size = std::to_string(state.image_width) + " x " + std::to_string(state.image_height) + " pixels";
  if (pixels > most_pixels)
    throw Error(
        Code::cannot_read,
        "cannot read " + name + " as a JPEG image: it has " + size + ", more than " + std::to_string(most_pixels),
        {{"file", name}});
  // Each unit of at most 32 by 32 pixels takes a bit or more, unless it is coded arithmetically.
  constexpr uint64_t most_pixels_of_byte = uint64_t{32} * 32 * 8;
  if (state.arith_code == FALSE && pixels / most_pixels_of_byte > decoder.bytes.size())
    throw Error(Code::cannot_read, "cannot read " + name + " as a JPEG image: the file is too short for " + size,
                {{"file", name}});
}

Picture read(const std::string& name, std::string_view bytes, uint64_t most_pixels) {
  Decoder decoder(bytes);
  const auto require_read = [&](bool is_read) {
    if (!is_read)
      throw Error(Code::cannot_read, "cannot read " + name + " as a JPEG image: " + decoder.message.data(),
                  {{"file", name}});
  };
  require_read(read_header(decoder));
  check_size(decoder, most_pixels, name);
  const uint32_t width = decoder.state.image_width, height = decoder.state.image_height;
  decoder.row.resize(size_t{3} * width);
  decoder.rgba.resize(size_t{4} * width * height);
  require_read(read_pixels(decoder));
  return {width, height, std::move(decoder.rgba)};
}

}  // namespace
}  // namespace ombre::jpeg

void ombre_read_jpeg(const std::string* name, const std::string_view* bytes, uint64_t most_pixels,
                     ombre::jpeg::Picture* picture) {
  *picture = ombre::jpeg::read(*name, *bytes, most_pixels);
}
