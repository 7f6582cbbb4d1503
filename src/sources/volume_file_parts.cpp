#include "sources/volume_file_parts.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "base/text/error.h"
#include "dicom/series.h"
#include "formats/volumes/volume_parts.h"
#include "sources/file_numbers.h"
#include "sources/layer_images.h"
#include "vdb/dense_grid.h"

namespace ombre::sources {
namespace {

namespace fs = std::filesystem;

// Returns all files of the folder and of the folders in it, in the order of the numbers in their names.
std::vector<std::string> files_in(const std::string& folder) {
  constexpr int most_depth = 16;
  constexpr size_t most_files = 1'000'000;
  std::error_code error;
  std::vector<std::string> files;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end && files.size() < most_files; it.increment(error)) {
    std::error_code unknown;
    if (it.depth() >= most_depth) it.disable_recursion_pending();
    if (it->is_regular_file(unknown)) files.push_back(it->path().string());
  }
  if (error)
    throw Error(Code::cannot_read, "the folder \"" + folder + "\" cannot be read: " + error.message(),
                {{"file", folder}});
  if (files.empty())
    throw Error(Code::file_missing, "the folder \"" + folder + "\" is empty; give one of DICOM files or of images",
                {{"file", folder}});
  std::ranges::sort(files, is_numbered_before);
  return files;
}

// Returns the first bytes of a file, by which its kind is known.
std::string head_of(const std::string& path) {
  constexpr size_t most = 512;
  std::string bytes(most, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<size_t>(file.gcount()));
  return bytes;
}

bool is_dicom_file(const std::string& path) { return dicom::is_dicom(head_of(path)); }

// Directories of media list what lies beside them, and hold no images.
VolumeParts dicom_parts(std::vector<std::string> files) {
  std::erase_if(files, [](const std::string& file) { return dicom::is_directory_of_files(head_of(file)); });
  return {VolumeParts::Kind::dicom, std::move(files)};
}

// Images form a stack if they lie in the folder itself and none of its files is DICOM; pictures beside a scan do not.
VolumeParts parts_of_folder(const std::string& folder) {
  const std::vector<std::string> files = files_in(folder);
  std::vector<std::string> images = files;
  std::erase_if(images, [&](const std::string& file) {
    return !has_image_name(file) || fs::path(file).parent_path() != fs::path(folder + "/").parent_path();
  });
  if (images.empty() || std::ranges::any_of(files, is_dicom_file)) return dicom_parts(files);
  return {VolumeParts::Kind::images, std::move(images)};
}

std::vector<formats::VolumeSegment> dicom_segments(const std::string& path, std::string_view bytes) {
  std::vector<formats::VolumeSegment> segments;
  for (const dicom::Segment& segment : dicom::read_segments(path, path, bytes))
    segments.push_back({segment.name, std::to_string(segment.label), segment.label, 0, segment.colour});
  return segments;
}

// Adds the rows of an image, from the bottom up.
void add_layer(const LayerNumbers& image, const std::string& path, formats::VoxelVolume& volume) {
  if (volume.count[0] == 0) {
    volume.count = {image.width, image.height, 0};
    volume.type = image.type;
    volume.channels = image.channels;
    volume.values = formats::values_of_type(path, image.type);
  }
  if (volume.count[0] != image.width || volume.count[1] != image.height)
    throw Error(Code::file_content,
                "the image \"" + path + "\" has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " pixels, but those below it have " + std::to_string(volume.count[0]) + " x " +
                    std::to_string(volume.count[1]) + "; all images of a stack need the same size",
                {{"file", path}});
  if (volume.type != image.type)
    throw Error(Code::file_content,
                "the image \"" + path + "\" has numbers of the type " + image.type + ", but those below it have " +
                    volume.type + "; all images of a stack need the same type",
                {{"file", path}});
  std::visit(
      [&]<class T>(std::vector<T>& values) {
        const auto& rows = std::get<std::vector<T>>(image.values);
        for (uint32_t row = image.height; row-- > 0;) {
          const auto begin = rows.begin() + static_cast<ptrdiff_t>(size_t{row} * image.width);
          values.insert(values.end(), begin, begin + image.width);
        }
      },
      volume.values);
  ++volume.count[2];
}

formats::VoxelVolume read_images(const std::string& path, const std::vector<std::string>& files,
                                 const formats::VolumeChoice& choice, const ReadFile& read, const StopFlag* stop,
                                 std::vector<std::string>& warnings) {
  formats::VoxelVolume volume;
  for (const std::string& file : files) {
    if (stop && stop->requested()) throw Cancelled();
    const LayerStack stack = read_layer_numbers(file, read(file).bytes, choice, stop);
    for (const LayerNumbers& layer : stack.layers) add_layer(layer, file, volume);
    warnings.insert(warnings.end(), stack.warnings.begin(), stack.warnings.end());
    if (stack.spacing_mm && files.size() == 1)
      volume.space_from_index = formats::placed_along_axes(path, *stack.spacing_mm, {});
  }
  formats::settle_volume(path, choice.nan, volume);
  if (const auto missing = files.size() > 1 ? missing_number(files) : std::nullopt)
    warnings.push_back("the images have a gap: number " + std::to_string(*missing) +
                       " is missing, and the layers above it move down by one");
  return volume;
}

formats::VoxelVolume read_dicom(const std::string& path, const std::vector<std::string>& files,
                                const formats::VolumeChoice& choice, const StopFlag* stop,
                                std::vector<std::string>& warnings) {
  const dicom::SeriesChoice wanted{choice.name,    choice.phase,           choice.label, choice.is_regular,
                                   choice.outside, choice.is_outside_high, choice.level};
  dicom::Series read = dicom::read_series(path, files, wanted, stop);
  warnings = std::move(read.warnings);
  formats::VoxelVolume volume;
  volume.count = read.count;
  volume.type = read.whole.empty() ? "float32" : "int16";
  if (read.whole.empty())
    volume.values = std::move(read.real);
  else
    volume.values = std::move(read.whole);
  volume.padding = read.padding;
  volume.slope = read.slope;
  volume.intercept = read.intercept;
  if (read.has_lengths) volume.space_from_index = read.lps_from_index;
  volume.space = formats::VolumeSpace::lps;
  formats::settle_volume(path, choice.nan, volume);
  return volume;
}

formats::VoxelVolume read_vdb(const std::string& path, const formats::VolumeChoice& choice, const StopFlag* stop) {
  vdb::DenseGrid dense = vdb::read_grid(path, choice.name, choice.channel, stop);
  formats::VoxelVolume volume;
  volume.count = dense.count;
  volume.type = "float32";
  volume.channels = dense.channels;
  volume.values = std::move(dense.values);
  volume.space_from_index = dense.space_from_index;
  formats::settle_volume(path, choice.nan, volume);
  return volume;
}

formats::VoxelVolume read_numbers(const std::string& path, const VolumeParts& parts,
                                  const formats::VolumeChoice& choice, const ReadFile& read,
                                  std::vector<std::string>& warnings) {
  const FileView whole = read(parts.files[0]);
  formats::VolumeFile file{path, whole.bytes, nullptr, choice, true};
  FileView rest;
  if (parts.has_companion) {
    rest = read(parts.files[1]);
    file.companion = &rest.bytes;
  }
  formats::VoxelVolume volume = formats::read_volume(file);
  warnings.insert(warnings.end(), volume.warnings.begin(), volume.warnings.end());
  const bool is_in_rest =
      volume.in_file.data() >= rest.bytes.data() && volume.in_file.data() < rest.bytes.data() + rest.bytes.size();
  if (!volume.in_file.empty() && !volume.file) {
    volume.file = is_in_rest ? rest.keeper : whole.keeper;
    volume.stays_in_file = is_in_rest ? rest.is_mapped : whole.is_mapped;
  }
  return volume;
}

void check_no_channel(const std::string& path, int channel) {
  if (channel > 0)
    throw Error(Code::file_content,
                "the scan \"" + path + "\" has one value in each voxel, and no channel " + std::to_string(channel),
                {{"file", path}});
}

void check_no_phase(const std::string& path, int phase) {
  if (phase > 1)
    throw Error(Code::file_content,
                "the volume \"" + path + "\" has no phase " + std::to_string(phase) +
                    "; volumes in time are chosen by channel=0 in files other than DICOM and TIFF",
                {{"file", path}});
}

}  // namespace

VolumeParts volume_parts(const std::string& path, const ReadFile& read) {
  std::error_code error;
  if (fs::is_directory(path, error)) return parts_of_folder(path);
  VolumeParts parts{VolumeParts::Kind::numbers, {path}};
  const FileView file = read(path);
  if (dicom::is_directory_of_files(file.bytes)) {
    const std::string folder = fs::path(path).parent_path().string();
    return dicom_parts(files_in(folder.empty() ? "." : folder));
  }
  if (dicom::is_dicom(file.bytes)) {  // before images, since a TIFF header may lie before its mark
    parts.kind = VolumeParts::Kind::dicom;
    parts.segments = dicom_segments(path, file.bytes);
    return parts;
  }
  if (vdb::is_vdb(file.bytes)) parts.kind = VolumeParts::Kind::vdb;
  if (is_image(file.bytes)) parts.kind = VolumeParts::Kind::images;
  if (parts.kind != VolumeParts::Kind::numbers) return parts;
  parts.segments = formats::segments_of(path, file.bytes);
  const std::string companion = formats::companion_of(path, file.bytes);
  parts.has_companion = !companion.empty() && fs::exists(companion, error);
  if (parts.has_companion) parts.files.push_back(companion);
  return parts;
}

formats::VoxelVolume read_volume_parts(const std::string& path, const VolumeParts& parts,
                                       const formats::VolumeChoice& choice, const ReadFile& read, const StopFlag* stop,
                                       std::vector<std::string>& warnings) {
  switch (parts.kind) {
    case VolumeParts::Kind::dicom:
      check_no_channel(path, choice.channel);
      return read_dicom(path, parts.files, choice, stop, warnings);
    case VolumeParts::Kind::vdb:
      check_no_phase(path, choice.phase);
      return read_vdb(path, choice, stop);
    case VolumeParts::Kind::images:
      return read_images(path, parts.files, choice, read, stop, warnings);
    default:
      check_no_phase(path, choice.phase);
      return read_numbers(path, parts, choice, read, warnings);
  }
}

Interval value_range(const formats::VoxelVolume& volume) {
  return formats::visit_numbers(volume, [](const auto& numbers) {
    auto least = numbers[0], greatest = numbers[0];
    for (size_t n = 1; n < numbers.size(); ++n) {
      least = std::min(least, numbers[n]);
      greatest = std::max(greatest, numbers[n]);
    }
    return Interval(static_cast<double>(least), static_cast<double>(greatest));
  });
}

Interval shown_range(const formats::VoxelVolume& volume) {
  constexpr size_t parts = 4096;
  constexpr double left_out = 0.005;
  const Interval all = value_range(volume);
  const double width = all.hi - all.lo;
  if (!(width > 0)) return {all.lo, all.lo + 1};
  std::array<double, parts> counts{};
  const double few = left_out * formats::visit_numbers(volume, [&](const auto& numbers) {
                       for (size_t n = 0; n < numbers.size(); ++n) {
                         const double share = (static_cast<double>(numbers[n]) - all.lo) / width;
                         counts[std::min(static_cast<size_t>(share * parts), parts - 1)] += 1;
                       }
                       return static_cast<double>(numbers.size());
                     });
  size_t first = 0, last = parts - 1;
  for (double below = counts[first]; first < last && below <= few; below += counts[first]) ++first;
  for (double above = counts[last]; last > first && above <= few; above += counts[last]) --last;
  const double step = width / parts;
  return {all.lo + static_cast<double>(first) * step, all.lo + static_cast<double>(last + 1) * step};
}

double otsu_level(const formats::VoxelVolume& volume) {
  constexpr size_t parts = 256;
  std::array<double, parts> counts{};
  double least = 0, width = 0;
  const Interval range = value_range(volume);
  least = range.lo;
  width = range.hi - least;
  formats::visit_numbers(volume, [&](const auto& numbers) {
    for (size_t n = 0; n < numbers.size(); ++n) {
      const double share = width > 0 ? (static_cast<double>(numbers[n]) - least) / width : 0;
      counts[std::min(static_cast<size_t>(share * parts), parts - 1)] += 1;
    }
  });
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
