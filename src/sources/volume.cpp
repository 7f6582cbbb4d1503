// Volumes of designs: grids of numbers.
#include "formats/volume.h"

#include <filesystem>

#include "base/error.h"
#include "import/volume_source.h"
#include "sources/loading.h"
#include "sources/volume_parts.h"

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

// What a file alone is made of; found once for the same content. Null, and diagnostics, where it is wrong.
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

// What stands in all of its files.
std::optional<Hash> content_of(const VolumeParts& parts, const VolumeRequest& request, sources::Loading& loading) {
  sources::Key key("volume");
  key.add(request.series).add(request.channel);
  for (const std::string& path : parts.files) {
    FilePath part{path, {}};
    if (!loading.read_content(part)) return std::nullopt;
    key.add(part.content);
  }
  return key.hash();
}

}  // namespace

std::shared_ptr<const VolumeGrid> VolumeRequest::load(sources::Loading& loading) {
  if (!loading.find(file)) return nullptr;
  const auto parts = parts_of(file, loading);
  const auto content = parts ? content_of(*parts, *this, loading) : std::nullopt;
  if (!content) return nullptr;
  file.content = *content;
  using Made = sources::Loading::Made<VolumeGrid>;
  return loading.cached<VolumeGrid>(*content, file.path, [&](const Reader& reader) {
    std::vector<std::string> warnings;
    formats::VoxelVolume volume =
        sources::read_volume_parts(file.path, *parts, {series, channel}, reader_of(loading), loading.stop(), warnings);
    for (const std::string& warning : warnings) reader.diagnostics.warning(reader.where, warning);
    auto grid = std::make_shared<VolumeGrid>();
    grid->space_from_index = volume.space_from_index;
    grid->space = patient_space(volume.space);
    grid->otsu_level = sources::otsu_level(volume);
    auto made = importing::make_volume_source(file.path, std::move(volume), file.content);
    grid->source = std::move(made.source);
    grid->places = std::move(made.places);
    return Made{std::move(grid), made.bytes};
  });
}

}  // namespace ombre::design
