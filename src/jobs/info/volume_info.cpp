#include "jobs/info/volume_info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <type_traits>

#include "base/math/point_text.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/images/png.h"
#include "jobs/common/events.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/info/volume_planes.h"
#include "sources/volume_file_parts.h"

namespace ombre::jobs {
namespace {

struct ValueCounts {
  double least = 0, greatest = 0;
  std::vector<double> counts;          // counts in equal parts of the range
  std::map<int64_t, uint64_t> labels;  // how often each number occurs; empty if there are many
};

// Counts whole numbers if there are few enough to be labels; returns none otherwise.
std::map<int64_t, uint64_t> count_labels(const formats::VoxelVolume& volume) {
  constexpr size_t most_labels = 256;
  return formats::visit_numbers(volume, [&]<class T>(const formats::Numbers<T>& numbers) {
    std::map<int64_t, uint64_t> labels;
    if constexpr (std::is_integral_v<T>)
      for (size_t n = 0, end = 0; n < numbers.size(); n = end) {
        const T value = numbers[n];
        for (end = n + 1; end < numbers.size() && numbers[end] == value;) ++end;
        labels[value] += end - n;
        if (labels.size() > most_labels) return std::map<int64_t, uint64_t>();
      }
    return labels;
  });
}

ValueCounts count_values(const formats::VoxelVolume& volume, size_t parts) {
  const Interval range = sources::value_range(volume);
  ValueCounts result{range.lo, range.hi, std::vector<double>(parts, 0), count_labels(volume)};
  const double width = range.hi - range.lo;
  formats::visit_numbers(volume, [&](const auto& numbers) {
    for (size_t n = 0; n < numbers.size(); ++n) {
      const double share = width > 0 ? (static_cast<double>(numbers[n]) - range.lo) / width : 0;
      ++result.counts[std::min(static_cast<size_t>(share * static_cast<double>(parts)), parts - 1)];
    }
  });
  return result;
}

DataList to_list(Vec3 v) { return {v.x, v.y, v.z}; }

// Returns the step from voxel to voxel along an axis of the grid.
Vec3 step_of(const Affine& map, int axis) { return {map.rows[0][axis], map.rows[1][axis], map.rows[2][axis]}; }

std::string placement_text(const formats::VoxelVolume& volume) {
  if (!volume.space_from_index) return "  voxels    the file does not say how large they are\n";
  const Affine& map = *volume.space_from_index;
  std::string text = "  voxels    ";
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? " x " : "") + format_rounded(length(step_of(map, axis)), 6);
  text += " mm\n  origin    " + format_point(map.offset, 6) + " mm, the centre of the first voxel\n";
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = step_of(map, axis);
    text += "  axis " + std::to_string(axis + 1) + "    along " + format_point((1 / length(step)) * step, 6) + "\n";
  }
  return text;
}

std::string histogram_text(const ValueCounts& values) {
  constexpr double longest_bar = 40;
  const double most = std::ranges::max(values.counts), parts = static_cast<double>(values.counts.size());
  std::string text;
  for (size_t n = 0; n < values.counts.size(); ++n) {
    const double from = values.least + static_cast<double>(n) * (values.greatest - values.least) / parts;
    std::string line = "  " + format_rounded(from, 5);
    line.resize(std::max<size_t>(line.size() + 1, 14), ' ');
    line += format_count(static_cast<unsigned long long>(values.counts[n]));
    line.resize(std::max<size_t>(line.size() + 1, 30), ' ');
    text += line + std::string(static_cast<size_t>(std::ceil(longest_bar * values.counts[n] / most)), '#') + "\n";
  }
  return text;
}

std::string labels_text(const std::map<int64_t, uint64_t>& labels) {
  constexpr size_t most_shown = 32;
  if (labels.empty() || labels.size() > most_shown) return "";
  std::string text = "\n  label       voxels\n";
  for (const auto& [label, count] : labels) {
    std::string line = "  " + std::to_string(label);
    line.resize(std::max<size_t>(line.size() + 1, 14), ' ');
    text += line + format_count(count) + "\n";
  }
  return text;
}

// A segment of a segmentation, and its number of voxels.
struct CountedSegment {
  formats::VolumeSegment segment;
  uint64_t voxels = 0;
};

uint64_t count_label(const formats::VoxelVolume& volume, int64_t label) {
  return formats::visit_numbers(volume, [&](const auto& numbers) {
    uint64_t count = 0;
    for (size_t n = 0; n < numbers.size(); ++n) count += static_cast<double>(numbers[n]) == static_cast<double>(label);
    return count;
  });
}

bool is_layered(const std::vector<formats::VolumeSegment>& segments) {
  return std::ranges::any_of(segments, [](const formats::VolumeSegment& segment) { return segment.layer > 0; });
}

// Counts segments; `read` returns a channel of the file.
std::vector<CountedSegment> count_segments(const std::vector<formats::VolumeSegment>& segments,
                                           const std::function<formats::VoxelVolume(int channel)>& read) {
  const bool has_layers = is_layered(segments);
  std::vector<CountedSegment> counted;
  for (const formats::VolumeSegment& segment : segments) counted.push_back({segment});
  std::map<int, std::vector<CountedSegment*>> by_layer;
  for (CountedSegment& segment : counted) by_layer[segment.segment.layer].push_back(&segment);
  for (const auto& [layer, of_layer] : by_layer) {
    const formats::VoxelVolume volume = read(has_layers ? layer : -1);
    for (CountedSegment* segment : of_layer) segment->voxels = count_label(volume, segment->segment.label);
  }
  return counted;
}

std::string hex_colour(const std::array<double, 3>& colour) {
  std::string text = "#";
  for (const double channel : colour) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(std::lround(255 * channel)));
    text += digits;
  }
  return text;
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

std::string segments_text(const std::vector<CountedSegment>& segments) {
  if (segments.empty()) return "";
  const std::string heading = "segment";
  size_t width = heading.size();
  for (const CountedSegment& counted : segments) width = std::max(width, counted.segment.name.size());
  std::string text = "\n  " + padded(heading, width + 2) + "label  layer  colour   voxels\n";
  for (const auto& [segment, voxels] : segments)
    text += "  " + padded(segment.name, width + 2) + padded(std::to_string(segment.label), 7) +
            padded(std::to_string(segment.layer), 7) + padded(segment.colour ? hex_colour(*segment.colour) : "-", 9) +
            format_count(voxels) + "\n";
  return text;
}

DataList segments_data(const std::vector<CountedSegment>& segments) {
  DataList list;
  for (const auto& [segment, voxels] : segments)
    list.emplace_back(DataMembers{{"name", segment.name},
                                  {"id", segment.id},
                                  {"label", static_cast<double>(segment.label)},
                                  {"layer", static_cast<double>(segment.layer)},
                                  {"colour", segment.colour ? Data(hex_colour(*segment.colour)) : Data()},
                                  {"voxels", static_cast<double>(voxels)}});
  return list;
}

std::string volume_text(const std::string& path, const formats::VoxelVolume& volume, const ValueCounts& values) {
  const auto& [nx, ny, nz] = volume.count;
  return path + ": a volume\n  size      " + std::to_string(nx) + " x " + std::to_string(ny) + " x " +
         std::to_string(nz) + " voxels, " + volume.type +
         (volume.channels > 1 ? ", one of " + std::to_string(volume.channels) + " channels" : "") + "\n" +
         placement_text(volume) + "  space     " + std::string(formats::name(volume.space)) + "\n  values    " +
         format_rounded(values.least, 9) + " to " + format_rounded(values.greatest, 9) + "\n  Otsu      " +
         format_rounded(sources::otsu_level(volume), 9) +
         ", a level between dark and bright\n\n  from        voxels\n" + histogram_text(values) +
         labels_text(values.labels);
}

DataMembers volume_members(const std::string& path, const formats::VoxelVolume& volume, const ValueCounts& values,
                           const std::vector<CountedSegment>& segments) {
  DataList counts, histogram, steps, labels;
  for (const auto& [label, count] : values.labels)
    labels.emplace_back(DataList{static_cast<double>(label), static_cast<double>(count)});
  for (const int64_t count : volume.count) counts.emplace_back(static_cast<double>(count));
  for (const double count : values.counts) histogram.emplace_back(count);
  DataMembers members{{"file", path},
                      {"size", std::move(counts)},
                      {"data_type", volume.type},
                      {"space", std::string(formats::name(volume.space))},
                      {"least", values.least},
                      {"greatest", values.greatest},
                      {"otsu", sources::otsu_level(volume)},
                      {"histogram", std::move(histogram)},
                      {"labels", std::move(labels)},
                      {"segments", segments_data(segments)},
                      {"channels", static_cast<double>(volume.channels)},
                      {"slope", volume.slope},
                      {"intercept", volume.intercept}};
  if (!volume.space_from_index) return members;
  for (int axis = 0; axis < 3; ++axis) steps.emplace_back(to_list(step_of(*volume.space_from_index, axis)));
  members.emplace_back("steps_mm", std::move(steps));
  members.emplace_back("origin_mm", to_list(volume.space_from_index->offset));
  return members;
}

void write_planes(const formats::VoxelVolume& volume, const InfoChoices& arguments) {
  refuse_to_overwrite(arguments.picture, arguments.force);
  const PlanesPicture picture = draw_planes(volume);
  exporting::write_file(arguments.picture, formats::encode_png(picture.width, picture.height, picture.rgba));
}

}  // namespace

int show_volume(const InfoChoices& arguments, Session& session) {
  const std::string& path = arguments.file;
  sources::FileStore files;
  const sources::ReadFile read = [&](const std::string& file) { return files.view(file, files.content(file)); };
  std::vector<std::string> warnings;
  const sources::VolumeParts files_of_volume = sources::volume_parts(path, read);
  const auto read_channel = [&](int channel) {
    formats::VolumeChoice choice{arguments.series, channel, arguments.nan, arguments.phase};
    choice.is_regular = arguments.is_regular;
    return sources::read_volume_parts(path, files_of_volume, choice, read, &session.stop, warnings);
  };
  // A segmentation in layers has segments in all channels, which are all reported.
  const bool has_layers = is_layered(files_of_volume.segments);
  const int channel = has_layers ? std::max(arguments.channel, 0) : arguments.channel;
  const formats::VoxelVolume volume = read_channel(channel);
  const std::vector<CountedSegment> segments = count_segments(files_of_volume.segments, read_channel);
  Diagnostics remarks;
  for (const std::string& warning : warnings) remarks.warning({}, warning);
  session.events.diagnose(remarks);
  constexpr size_t parts = 16;
  const ValueCounts values = count_values(volume, parts);
  if (!arguments.picture.empty()) write_planes(volume, arguments);
  if (session.events.wants_data())
    session.events.event("volume", volume_members(path, volume, values, segments));
  else
    session.events.print(volume_text(path, volume, values) + segments_text(segments));
  return done;
}

}  // namespace ombre::jobs
