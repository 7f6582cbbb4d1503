// Draws contact sheets of slice jobs.
#include "jobs/stacks/job_sheet.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/math/evenly_spaced.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "export/contact_sheet.h"
#include "export/image_stack.h"
#include "formats/containers/file.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/job_reader.h"
#include "jobs/slice/stored_slices.h"
#include "stores/journal_folder.h"
#include "stores/open_store.h"

namespace ombre::compile {
namespace {

SliceRequest read_request(const std::string& path) {
  Diagnostics problems;
  auto job = read_job(make_source(path, formats::read_file(path)), problems);
  if (!job)
    throw Error(Code::file_kind, path + " is not a slice job: " + std::string(trim(to_text(problems))),
                {{"file", path}});
  return std::move(job->request);
}

exporting::SheetStyle style_of(const SliceRequest& request) {
  const Vec3 voxel = request.lattice.voxel_mm();
  const bool is_mask = request.format == ImageFormat::mask;
  return {voxel.x, voxel.y, is_mask ? exporting::mask_off : exporting::shown(request.background, request.format)};
}

// Returns a layer's files, with the materials' colours for masks.
exporting::SheetLayer sheet_layer(const LayerEntry& entry, const SliceRequest& request,
                                  const std::filesystem::path& folder) {
  exporting::SheetLayer layer;
  layer.layer = entry.layer;
  layer.z_mm = request.lattice.center(2, entry.layer);
  for (size_t i = 0; i < entry.files.size(); ++i) {
    layer.images.push_back({(folder / entry.files[i].name).string(), std::nullopt});
    if (request.format == ImageFormat::mask && i < request.materials.size())
      layer.images.back().ink = request.materials[i].rgba;
  }
  return layer;
}

}  // namespace

std::string contact_sheet(const std::string& folder, int layer_count) {
  if (stores::is_archive(folder))
    throw Error(Code::file_kind, folder + " is an archive; unpack it, and give the folder with the layers",
                {{"file", folder}});
  const std::filesystem::path base(folder);
  const SliceRequest request = read_request((base / job_file).string());
  const std::string journal = formats::read_file((base / stores::journal_file).string());
  std::vector<exporting::SheetLayer> layers;
  for (const LayerEntry& entry : parse_layers(journal, layer_sizes(request)))
    if (!entry.counts.is_empty() && !entry.files.empty()) layers.push_back(sheet_layer(entry, request, base));
  if (layers.empty())
    throw Error(Code::file_content, folder + " has no layer with material to draw", {{"file", folder}});
  layers = evenly_spaced(layers, static_cast<size_t>(std::max(1, layer_count)));
  const exporting::Picture sheet = exporting::draw_contact_sheet(layers, style_of(request));
  return formats::encode_png(sheet.width, sheet.height, sheet.rgba);
}

}  // namespace ombre::compile
