// Layers of 4096 x 2048 voxels to PNG files: speed, and size over the entropy of what was drawn.
//
// Beside our encoders stands libpng with its defaults on RGBA rows, as such stacks are usually written.
// Figures are for comparing within one run on one machine.
#include <benchmark/benchmark.h>
#include <png.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/math/run.h"
#include "formats/images/png.h"

namespace ombre {
namespace {

constexpr uint32_t width = 4096, height = 2048;

// A material with each of some probabilities; what they leave over is void.
using Fractions = std::vector<double>;

// Shares of materials 1, 2, ... at a place from -1 to 1 along y and -2 to 2 along x.
using Design = Fractions (*)(double x, double y);

Fractions half_void(double, double) { return {0.5}; }
Fractions half_and_half(double, double) { return {0.5, 0.5}; }
Fractions tenth(double, double) { return {0.1, 0.9}; }
Fractions four_materials(double, double) { return {0.25, 0.25, 0.25, 0.25}; }
Fractions eight_materials(double, double) { return Fractions(8, 0.125); }
Fractions sixteen_materials(double, double) { return Fractions(16, 0.0625); }
Fractions four_in_disc(double x, double y) {
  return x * x + y * y > 0.95 ? Fractions(4) : Fractions{0.25, 0.25, 0.25, 0.25};
}
Fractions graded(double x, double) { return {(x + 2) / 4, (2 - x) / 4}; }
Fractions graded_disc(double x, double y) {
  const double share = 1 / (1 + std::exp(-5 * x));
  return x * x + y * y > 0.95 ? Fractions{0, 0} : Fractions{share, 1 - share};
}
Fractions uniform(double, double) { return {1}; }
Fractions disc(double x, double y) { return {x * x + y * y > 0.95 ? 0.0 : 1.0}; }
Fractions gyroid(double x, double y) {
  const double u = 50 * x, v = 50 * y, w = 1.3;
  return {std::sin(u) * std::cos(v) + std::sin(v) * std::cos(w) + std::sin(w) * std::cos(u) > 0 ? 1.0 : 0.0};
}

struct Kind {
  const char* name;
  Design design;
  int materials;  // of the job
};

constexpr Kind kinds[] = {{"half void", half_void, 1},
                          {"half and half", half_and_half, 2},
                          {"tenth", tenth, 2},
                          {"four materials", four_materials, 4},
                          {"four of twenty", four_materials, 20},
                          {"half of four", half_and_half, 4},
                          {"eight materials", eight_materials, 8},
                          {"sixteen materials", sixteen_materials, 16},
                          {"four in a disc", four_in_disc, 4},
                          {"graded", graded, 2},
                          {"graded disc", graded_disc, 2},
                          {"uniform", uniform, 1},
                          {"disc", disc, 1},
                          {"gyroid", gyroid, 1}};

struct Drawn {
  std::vector<MaterialId> voxels;
  double entropy_bytes = 0;
};

Drawn draw(const Kind& kind) {
  Drawn drawn;
  std::mt19937 random(1);
  drawn.voxels.reserve(size_t{width} * height);
  for (uint32_t j = 0; j < height; ++j) {
    for (uint32_t i = 0; i < width; ++i) {
      const Fractions fractions = kind.design((i + 0.5) / (width / 4) - 2, (j + 0.5) / (height / 2) - 1);
      double left = 1, u = static_cast<double>(random()) / 4294967296.0;
      size_t chosen = fractions.size();
      for (size_t n = fractions.size(); n-- > 0; u -= fractions[n]) {
        left -= fractions[n];
        if (fractions[n] > 0) drawn.entropy_bytes -= fractions[n] * std::log2(fractions[n]) / 8;
        if (chosen == fractions.size() && u < fractions[n]) chosen = n;
      }
      if (left > 0) drawn.entropy_bytes -= left * std::log2(left) / 8;
      drawn.voxels.push_back(static_cast<MaterialId>(chosen == fractions.size() ? 0 : chosen + 1));
    }
  }
  return drawn;
}

RunLayer runs_of(const std::vector<MaterialId>& voxels) {
  RunLayer layer(width);
  for (uint32_t j = 0; j < height; ++j) layer.append_row(voxels.data() + size_t{j} * width);
  return layer;
}

formats::Palette palette_of(int materials) {
  formats::Palette palette;
  for (int id = 1; id <= materials; ++id) {
    const auto channel = [&](int factor) { return static_cast<uint8_t>(id * factor % 256); };
    palette.add(static_cast<MaterialId>(id), {channel(91), channel(53), channel(201), 255});
  }
  return palette;
}

void append_to_string(png_structp png, png_bytep data, size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

std::string libpng_rgba(const std::vector<MaterialId>& voxels, const formats::Palette& palette) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append_to_string, [](png_structp) {});
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGBA, 0, 0, 0);
  png_write_info(png, info);
  std::vector<formats::Rgba> row(width);
  for (uint32_t j = 0; j < height; ++j) {
    for (uint32_t i = 0; i < width; ++i)
      row[i] = palette.colours()[palette.entry(voxels[size_t{height - 1 - j} * width + i])];
    png_write_row(png, row[0].data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

void report(benchmark::State& state, const Drawn& drawn, size_t bytes) {
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * width * height);
  state.counters["bytes"] = static_cast<double>(bytes);
  if (drawn.entropy_bytes > 1) state.counters["size/entropy"] = static_cast<double>(bytes) / drawn.entropy_bytes;
}

void encode(benchmark::State& state, const Kind& kind, ImageFormat format) {
  const Drawn drawn = draw(kind);
  const RunLayer layer = runs_of(drawn.voxels);
  const formats::Palette palette = palette_of(kind.materials);
  formats::PngLayout layout;
  layout.format = format;
  layout.mask_of = 1;
  size_t bytes = 0;
  for (auto _ : state) bytes = encode_png(layer, palette, layout).size();
  report(state, drawn, bytes);
}

void encode_with_libpng(benchmark::State& state, const Kind& kind) {
  const Drawn drawn = draw(kind);
  const formats::Palette palette = palette_of(kind.materials);
  size_t bytes = 0;
  for (auto _ : state) bytes = libpng_rgba(drawn.voxels, palette).size();
  report(state, drawn, bytes);
}

void make_runs(benchmark::State& state, const Kind& kind) {
  const Drawn drawn = draw(kind);
  for (auto _ : state) benchmark::DoNotOptimize(runs_of(drawn.voxels));
  report(state, drawn, 0);
}

void count(benchmark::State& state, const Kind& kind) {
  const Drawn drawn = draw(kind);
  const RunLayer layer = runs_of(drawn.voxels);
  for (auto _ : state) benchmark::DoNotOptimize(count_materials(layer));
  report(state, drawn, 0);
}

void register_all() {
  const std::pair<const char*, ImageFormat> encoders[] = {{"indexed", ImageFormat::indexed},
                                                          {"rgba", ImageFormat::rgba},
                                                          {"gray", ImageFormat::gray},
                                                          {"mask", ImageFormat::mask}};
  const auto add = [](const std::string& what, const Kind& kind, auto run) {
    benchmark::RegisterBenchmark((what + "/" + kind.name).c_str(), run)->Unit(benchmark::kMillisecond);
  };
  for (const Kind& kind : kinds) {
    for (const auto& [name, format] : encoders)
      add(name, kind, [kind, format = format](benchmark::State& state) { encode(state, kind, format); });
    add("libpng rgba", kind, [kind](benchmark::State& state) { encode_with_libpng(state, kind); });
    add("voxels to runs", kind, [kind](benchmark::State& state) { make_runs(state, kind); });
    add("count", kind, [kind](benchmark::State& state) { count(state, kind); });
  }
}

}  // namespace
}  // namespace ombre

int main(int argc, char** argv) {
  ombre::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
