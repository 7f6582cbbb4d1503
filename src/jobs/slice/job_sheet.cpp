// Draws contact sheets of slice jobs.
#include "jobs/slice/job_sheet.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/math/evenly_spaced.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "export/contact_sheet.h"
#include "export/image_stack.h"
#include "formats/containers/file.h"
#include "jobs/slice/stored_slices.h"
#include "stores/journal_folder.h"
#include "stores/open_store.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {
namespace {

// Returns the numbers of a member that must be a list of them.
std::vector<double> numbers(const Data* data, const std::string& path) {
  std::vector<double> values;
  if (data && data->list())
    for (const Data& element : *data->list())
      if (const double* number = element.number()) values.push_back(*number);
  if (!data || !data->list() || values.size() != data->list()->size())
    throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
  return values;
}

const Data* member(const Data* object, const char* name) { return object ? object->find(name) : nullptr; }

struct JobSummary {
  exporting::SheetStyle style;
  ImageFormat format = ImageFormat::indexed;
  std::vector<formats::Rgba> colours;  // colours of the materials, without void
  double origin_z_mm = 0, layer_mm = 0;
  LayerSizes sizes;
};

formats::Rgba read_colour(const Data& material, const std::string& path) {
  const std::vector<double> channels = numbers(member(&material, "rgba"), path);
  if (channels.size() != 4) throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
  formats::Rgba rgba{};
  for (size_t i = 0; i < 4; ++i) rgba[i] = static_cast<uint8_t>(std::clamp(channels[i], 0.0, 255.0));
  return rgba;
}

ImageFormat format(const Data* images, const std::string& path) {
  const Data* name = member(images, "format");
  const auto format = name && name->string() ? voxel::image_format(*name->string()) : std::nullopt;
  if (!format) throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
  return *format;
}

// Reads the materials, the first of which is void. Returns the colour of the background.
formats::Rgba read_materials(const Data* materials, JobSummary& summary, const std::string& path) {
  if (!materials) return {};
  if (!materials->list() || materials->list()->empty())
    throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
  for (const Data& material : *materials->list()) summary.colours.push_back(read_colour(material, path));
  const formats::Rgba background = summary.colours.front();
  summary.colours.erase(summary.colours.begin());
  summary.sizes.voxels += summary.colours.size();
  return background;
}

void read_channels(const Data* channels, JobSummary& summary, const std::string& path) {
  if (!channels || !channels->list()) return;
  for (const Data& channel : *channels->list()) {
    const Data* name = member(&channel, "type");
    const auto type = name && name->string() ? voxel::channel_type(*name->string()) : std::nullopt;
    if (!type) throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
    ++summary.sizes.voxels;
    summary.sizes.shades += voxel::channel_kind(*type).is_dose() ? 1 : 0;
  }
}

JobSummary read_summary(const std::string& path) {
  Diagnostics ignored;
  const std::optional<Data> job = parse_json(make_source(path, formats::read_file(path)), ignored);
  const Data* sampling = member(job ? &*job : nullptr, "sampling");
  const std::vector<double> pitch = numbers(member(sampling, "pitch_mm"), path);
  const std::vector<double> origin = numbers(member(sampling, "origin_mm"), path);
  const Data* checks = member(&*job, "checks");
  if (pitch.size() != 3 || origin.size() != 3 || !checks || !checks->list())
    throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});

  JobSummary summary;
  summary.style.pixel_width_mm = pitch[0];
  summary.style.pixel_height_mm = pitch[1];
  summary.format = format(member(&*job, "images"), path);
  const formats::Rgba background = read_materials(member(&*job, "materials"), summary, path);
  read_channels(member(&*job, "channels"), summary, path);
  if (summary.sizes.voxels == 0) throw Error(Code::file_kind, path + " is not a slice job", {{"file", path}});
  const bool is_mask = summary.format == ImageFormat::mask;
  summary.style.background = is_mask ? exporting::mask_off : exporting::shown(background, summary.format);
  summary.origin_z_mm = origin[2];
  summary.layer_mm = pitch[2];
  summary.sizes.checks = checks->list()->size();
  return summary;
}

// Returns a layer's files, with the materials' colours for masks.
exporting::SheetLayer sheet_layer(const LayerEntry& entry, const JobSummary& summary,
                                  const std::filesystem::path& folder) {
  exporting::SheetLayer layer;
  layer.layer = entry.layer;
  layer.z_mm = summary.origin_z_mm + (static_cast<double>(entry.layer) + 0.5) * summary.layer_mm;
  for (size_t i = 0; i < entry.files.size(); ++i) {
    layer.images.push_back({(folder / entry.files[i].name).string(), std::nullopt});
    if (summary.format == ImageFormat::mask && i < summary.colours.size()) layer.images.back().ink = summary.colours[i];
  }
  return layer;
}

}  // namespace

std::string contact_sheet(const std::string& folder, int layer_count) {
  if (stores::is_archive(folder))
    throw Error(Code::file_kind, folder + " is an archive; unpack it, and give the folder with the layers",
                {{"file", folder}});
  const std::filesystem::path base(folder);
  const JobSummary summary = read_summary((base / job_file).string());
  const std::string journal = formats::read_file((base / stores::journal_file).string());
  std::vector<exporting::SheetLayer> layers;
  for (const LayerEntry& entry : parse_layers(journal, summary.sizes))
    if (!entry.counts.is_empty() && !entry.files.empty()) layers.push_back(sheet_layer(entry, summary, base));
  if (layers.empty())
    throw Error(Code::file_content, folder + " has no layer with material to draw", {{"file", folder}});
  layers = evenly_spaced(layers, static_cast<size_t>(std::max(1, layer_count)));
  const exporting::Picture sheet = exporting::draw_contact_sheet(layers, summary.style);
  return formats::encode_png(sheet.width, sheet.height, sheet.rgba);
}

}  // namespace ombre::compile
