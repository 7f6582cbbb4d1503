#include "sources/volume_parts.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "dicom/series.h"
#include "formats/png.h"
#include "sources/file_numbers.h"
#include "vdb/dense_grid.h"

namespace ombre::sources {
namespace {

namespace fs = std::filesystem;

bool is_png(const std::string& path) { return to_lower(path).ends_with(".png"); }

// All files of the folder, in the order of the numbers in their names.
std::vector<std::string> files_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> files;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code unknown;
    if (it->is_regular_file(unknown)) files.push_back(it->path().string());
  }
  if (error) throw Error("the folder \"" + folder + "\" cannot be read: " + error.message());
  if (files.empty()) throw Error("the folder \"" + folder + "\" is empty; give one of DICOM files or of PNG images");
  std::ranges::sort(files, is_numbered_before);
  return files;
}

VolumeParts parts_of_folder(const std::string& folder) {
  VolumeParts parts{VolumeParts::Kind::dicom, files_in(folder)};
  if (!std::ranges::any_of(parts.files, is_png)) return parts;
  std::erase_if(parts.files, [](const std::string& file) { return !is_png(file); });
  parts.kind = VolumeParts::Kind::images;
  return parts;
}

// Adds an image's rows, from the lowest up.
void add_layer(const formats::GrayImage& image, const std::string& path, formats::VoxelVolume& volume) {
  if (volume.count[0] == 0) volume.count = {image.width, image.height, 0};
  if (volume.count[0] != image.width || volume.count[1] != image.height)
    throw Error("the image \"" + path + "\" has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                " pixels, but those below it have " + std::to_string(volume.count[0]) + " x " +
                std::to_string(volume.count[1]) + "; all images of a stack need the same size");
  auto& values = std::get<std::vector<uint16_t>>(volume.values);
  for (uint32_t row = image.height; row-- > 0;) {
    const auto begin = image.pixels.begin() + static_cast<ptrdiff_t>(size_t{row} * image.width);
    values.insert(values.end(), begin, begin + image.width);
  }
  ++volume.count[2];
}

formats::VoxelVolume read_images(const std::vector<std::string>& files, const ReadFile& read, const StopFlag* stop,
                                 std::vector<std::string>& warnings) {
  formats::VoxelVolume volume;
  volume.type = "uint16";
  volume.values = std::vector<uint16_t>();
  for (const std::string& file : files) {
    if (stop && stop->requested()) throw Cancelled();
    add_layer(formats::decode_gray_png(*read(file), file), file, volume);
  }
  if (const auto missing = missing_number(files))
    warnings.push_back("the images have a gap: number " + std::to_string(*missing) +
                       " is missing, and the layers above it move down by one");
  return volume;
}

formats::VoxelVolume read_dicom(const std::string& path, const std::vector<std::string>& files,
                                const std::string& series, const StopFlag* stop, std::vector<std::string>& warnings) {
  dicom::Series read = dicom::read_series(path, files, series, stop);
  warnings = std::move(read.warnings);
  formats::VoxelVolume volume;
  volume.count = read.count;
  volume.type = read.whole.empty() ? "float32" : "int16";
  if (read.whole.empty())
    volume.values = std::move(read.real);
  else
    volume.values = std::move(read.whole);
  volume.space_from_index = read.lps_from_index;
  volume.space = formats::VolumeSpace::lps;
  formats::check_volume(path, volume);
  return volume;
}

formats::VoxelVolume read_vdb(const std::string& path, const std::string& grid, const StopFlag* stop) {
  vdb::DenseGrid dense = vdb::read_grid(path, grid, stop);
  formats::VoxelVolume volume;
  volume.count = dense.count;
  volume.type = "float32";
  volume.values = std::move(dense.values);
  volume.space_from_index = dense.space_from_index;
  formats::check_volume(path, volume);
  return volume;
}

}  // namespace

VolumeParts volume_parts(const std::string& path, const ReadFile& read) {
  std::error_code error;
  if (fs::is_directory(path, error)) return parts_of_folder(path);
  VolumeParts parts{VolumeParts::Kind::numbers, {path}};
  const auto bytes = read(path);
  if (dicom::is_dicom(*bytes)) parts.kind = VolumeParts::Kind::dicom;
  if (vdb::is_vdb(*bytes)) parts.kind = VolumeParts::Kind::vdb;
  if (parts.kind != VolumeParts::Kind::numbers) return parts;
  const std::string companion = formats::companion_of(path, *bytes);
  parts.has_companion = !companion.empty() && fs::exists(companion, error);
  if (parts.has_companion) parts.files.push_back(companion);
  return parts;
}

formats::VoxelVolume read_volume_parts(const std::string& path, const VolumeParts& parts, const std::string& series,
                                       const ReadFile& read, const StopFlag* stop, std::vector<std::string>& warnings) {
  switch (parts.kind) {
    case VolumeParts::Kind::dicom:
      return read_dicom(path, parts.files, series, stop, warnings);
    case VolumeParts::Kind::vdb:
      return read_vdb(path, series, stop);
    case VolumeParts::Kind::images:
      return read_images(parts.files, read, stop, warnings);
    default: {
      const auto rest = parts.has_companion ? read(parts.files[1]) : nullptr;
      return formats::read_volume(path, *read(parts.files[0]), rest.get());
    }
  }
}

double otsu_level(const formats::VoxelValues& values) {
  constexpr size_t parts = 256;
  std::array<double, parts> counts{};
  double least = 0, width = 0;
  std::visit(
      [&](const auto& list) {
        const auto [low, high] = std::ranges::minmax(list);
        least = static_cast<double>(low);
        width = static_cast<double>(high) - least;
        for (const auto value : list) {
          const double share = width > 0 ? (static_cast<double>(value) - least) / width : 0;
          counts[std::min(static_cast<size_t>(share * parts), parts - 1)] += 1;
        }
      },
      values);
  double all = 0, sum = 0, below = 0, sum_below = 0, best = -1;
  size_t level = 0;
  for (size_t n = 0; n < parts; ++n) {
    all += counts[n];
    sum += counts[n] * static_cast<double>(n);
  }
  for (size_t n = 0; n + 1 < parts; ++n) {
    below += counts[n];
    sum_below += counts[n] * static_cast<double>(n);
    if (below == 0 || below == all) continue;
    const double difference = sum_below / below - (sum - sum_below) / (all - below);
    const double between = below * (all - below) * difference * difference;
    if (between <= best) continue;
    best = between;
    level = n;
  }
  return least + static_cast<double>(level + 1) / parts * width;
}

}  // namespace ombre::sources
