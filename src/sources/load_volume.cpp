// Loads volumes for designs: grids of numbers.
#include "formats/volumes/volume.h"

#include <algorithm>
#include <filesystem>

#include "base/text/error.h"
#include "base/text/text.h"
#include "import/fields/volume_source.h"
#include "sources/loading.h"
#include "sources/volume_file_parts.h"

namespace ombre::design {
namespace {

using sources::VolumeParts;

PatientSpace patient_space(formats::VolumeSpace space) {
  switch (space) {
    case formats::VolumeSpace::ras:
      return PatientSpace::ras;
    case formats::VolumeSpace::lps:
      return PatientSpace::lps;
    case formats::VolumeSpace::las:
      return PatientSpace::las;
    case formats::VolumeSpace::left_handed:
      return PatientSpace::left_handed;
    default:
      return PatientSpace::unknown;
  }
}

sources::ReadFile reader_of(sources::Loading& loading) {
  return [&loading](const std::string& path) { return loading.view({path, {}}); };
}

// Returns the parts of a volume that depend only on its file, determined once per content. Null, with diagnostics, if
// the file is invalid.
std::shared_ptr<const VolumeParts> parts_of_file(FilePath& file, sources::Loading& loading) {
  if (!loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<VolumeParts>;
  const Hash key = sources::Key("parts of a volume").add(file.content).add(file.path).hash();
  return loading.cached<VolumeParts>(key, file.path, [&](const Reader&) {
    return Made{std::make_shared<VolumeParts>(sources::volume_parts(file.path, reader_of(loading))),
                sizeof(VolumeParts)};
  });
}

std::shared_ptr<const VolumeParts> parts_of(FilePath& file, sources::Loading& loading) {
  std::error_code error;
  if (!std::filesystem::is_directory(file.path, error)) return parts_of_file(file, loading);
  try {
    return std::make_shared<VolumeParts>(sources::volume_parts(file.path, reader_of(loading)));
  } catch (const Error& wrong) {
    loading.reader().diagnostics.error(loading.reader().where, wrong.what());
    return nullptr;
  }
}

// Returns the hash of the contents of all of its files.
std::optional<Hash> content_of(const VolumeParts& parts, const VolumeRequest& request, sources::Loading& loading) {
  sources::Key key("volume");
  key.add(request.series).add(request.channel).add(request.phase).add(static_cast<double>(request.label));
  for (const bool flag : {request.are_labels, request.is_regular, request.is_outside_high}) key.add(flag);
  for (const auto& number : {request.nan, request.outside, request.level})
    key.add(number ? format_number(*number) : "none");
  for (const std::string& path : parts.files) {
    FilePath part{path, {}};
    if (!loading.read_content(part)) return std::nullopt;
    key.add(part.content);
  }
  return key.hash();
}

std::vector<std::string> segment_names(const std::vector<formats::VolumeSegment>& segments) {
  std::vector<std::string> names;
  for (const formats::VolumeSegment& segment : segments) names.push_back(segment.name);
  return names;
}

// Finds a segment by its name or, if several have that name, by its ID. Null, with a diagnostic, if there is none.
const formats::VolumeSegment* find_segment(const VolumeParts& parts, const VolumeRequest& request,
                                           const Reader& reader) {
  const auto& segments = parts.segments;
  const std::string file = "the volume \"" + request.file.path + '"';
  const std::string name = '"' + request.segment + '"';
  const auto is_meant = [&](const formats::VolumeSegment& s) { return s.name == request.segment; };
  const auto found = std::ranges::find_if(segments, is_meant);
  const auto count = std::ranges::count_if(segments, is_meant);
  if (count == 1) return &*found;
  const auto by_id = std::ranges::find(segments, request.segment, &formats::VolumeSegment::id);
  if (by_id != segments.end()) return &*by_id;
  const auto fail = [&](const std::string& message, const Phrase& hint) {
    reader.diagnostics.error(Code::unknown_object, reader.where, message, hint,
                             {{"file", request.file.path}, {"name", request.segment}});
    return nullptr;
  };
  if (count > 1)
    return fail(
        file + " has " + std::to_string(count) + " segments " + name,
        "write the ID of the one that is meant, such as " + spelled::parameter("segment", '"' + found->id + '"'));
  if (segments.empty())
    return fail(file + " names no segments", "write its number: " + spelled::parameter("label", "1") +
                                                 "; names are read from .seg.nrrd and DICOM files");
  return fail(file + " has no segment " + name, sources::hint_of_names(request.segment, segment_names(segments), ""));
}

// Sets the channel and the label of the requested segment. Returns false, with a diagnostic, if there is none.
bool choose_segment(const VolumeParts& parts, VolumeRequest& request, const Reader& reader) {
  if (request.segment.empty()) return true;
  const formats::VolumeSegment* segment = find_segment(parts, request, reader);
  if (!segment) return false;
  request.label = segment->label;
  const auto has_layer = [](const formats::VolumeSegment& s) { return s.layer > 0; };
  if (std::ranges::any_of(parts.segments, has_layer)) request.channel = segment->layer;
  return true;
}

formats::VolumeChoice choice_of(const VolumeRequest& request) {
  formats::VolumeChoice choice{request.series, request.channel, request.nan, request.phase, request.are_labels};
  choice.label = request.label;
  choice.is_regular = request.is_regular;
  choice.outside = request.outside;
  choice.is_outside_high = request.is_outside_high;
  choice.level = request.level;
  return choice;
}

// Warns once for a design where two files call different sides of a patient positive, and both keep their axes.
void compare_axes(const VolumeRequest& request, const VolumeGrid& grid, const sources::Loading& loading) {
  if (request.has_space) return;
  const std::string other = loading.loader().first_with_other_axes(request.file.path, grid.space);
  if (other.empty()) return;
  const bool is_ras = grid.space == PatientSpace::ras;
  loading.reader().diagnostics.warning(
      loading.reader().where,
      "the volume \"" + request.file.path + "\" has the axes " + (is_ras ? "RAS" : "LPS") + ", and \"" + other +
          "\" the axes " + (is_ras ? "LPS" : "RAS") + ", so they are turned by 180 degrees to each other",
      "write " + spelled::parameter("space", "\"RAS\"") + " or " + spelled::parameter("space", "\"LPS\"") +
          " for both");
}

}  // namespace

std::shared_ptr<const VolumeGrid> VolumeRequest::load(sources::Loading& loading) {
  if (!loading.find(file)) return nullptr;
  const auto parts = parts_of(file, loading);
  if (!parts || !choose_segment(*parts, *this, loading.reader())) return nullptr;
  const auto content = content_of(*parts, *this, loading);
  if (!content) return nullptr;
  file.content = *content;
  using Made = sources::Loading::Made<VolumeGrid>;
  const auto loaded = loading.cached<VolumeGrid>(*content, file.path, [&](const Reader& reader) {
    std::vector<std::string> warnings;
    formats::VoxelVolume volume =
        sources::read_volume_parts(file.path, *parts, choice_of(*this), reader_of(loading), loading.stop(), warnings);
    for (const std::string& warning : warnings) reader.diagnostics.warning(reader.where, warning);
    auto grid = std::make_shared<VolumeGrid>();
    grid->space_from_index = volume.space_from_index;
    grid->space = patient_space(volume.space);
    grid->otsu_level = sources::otsu_level(volume);
    grid->padding = volume.padding;
    auto made = importing::make_volume_source(file.path, std::move(volume), file.content);
    grid->source = std::move(made.source);
    grid->places = std::move(made.places);
    return Made{std::move(grid), made.bytes};
  });
  if (loaded) compare_axes(*this, *loaded, loading);
  return loaded;
}

}  // namespace ombre::design
