// Volumes of designs: grids of numbers.
#include "formats/volume.h"

#include <filesystem>

#include "import/volume_source.h"
#include "sources/loading.h"
#include "sources/mesh_materials.h"

namespace ombre::design {
namespace {

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

// The bytes of the rest of the file; null, and diagnostics, where the file is wrong.
std::shared_ptr<const std::string> companion_path(const FilePath& file, sources::Loading& loading) {
  using Made = sources::Loading::Made<std::string>;
  const Hash key = sources::Key("companion of a volume").add(file.content).add(file.path).hash();
  return loading.cached<std::string>(key, file.path, [&](const Reader&) {
    auto path = std::make_shared<std::string>(formats::companion_of(file.path, *loading.bytes(file)));
    const size_t bytes = path->size();
    return Made{std::move(path), bytes};
  });
}

}  // namespace

std::shared_ptr<const VolumeGrid> VolumeRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.look_at(file)) return nullptr;
  const auto beside = companion_path(file, loading);
  if (!beside) return nullptr;
  const FilePath own = file;
  FilePath companion{*beside, {}};
  std::error_code ignored;
  const bool has_companion = !beside->empty() && std::filesystem::exists(*beside, ignored);
  if (has_companion && !loading.look_at(companion)) return nullptr;
  if (has_companion) file.content = hash_bytes(file.content.hex() + companion.content.hex());

  using Made = sources::Loading::Made<VolumeGrid>;
  const Hash key = sources::Key("volume").add(file.content).hash();
  return loading.cached<VolumeGrid>(key, file.path, [&](const Reader&) {
    const auto rest = has_companion ? loading.bytes(companion) : nullptr;
    formats::VoxelVolume volume = formats::read_volume(file.path, *loading.bytes(own), rest.get());
    auto grid = std::make_shared<VolumeGrid>();
    grid->space_from_index = volume.space_from_index;
    grid->space = patient_space(volume.space);
    auto made = importing::make_volume_source(file.path, std::move(volume), file.content);
    grid->source = std::move(made.source);
    grid->places = std::move(made.places);
    return Made{std::move(grid), made.bytes};
  });
}

}  // namespace ombre::design
