// Makes the contents of job.json.
#include "jobs/slice/job_description.h"

#include <algorithm>

#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/slice/channel_counts.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {
namespace {

Data triple(Vec3 v) { return DataList{v.x, v.y, v.z}; }

Data colour(const formats::Rgba& rgba) {
  DataList list;
  for (const uint8_t channel : rgba) list.emplace_back(static_cast<double>(channel));
  return list;
}

Data sampling(const SliceRequest& request) {
  const voxel::Lattice& lattice = request.lattice;
  DataList pitch, pitch_mm, voxels;
  for (int axis = 0; axis < 3; ++axis) {
    pitch.emplace_back(lattice.pitch[axis].text());
    pitch_mm.emplace_back(lattice.pitch[axis].mm());
    voxels.push_back(number(lattice.count[axis]));
  }
  DataMembers members{{"pitch", pitch},
                      {"pitch_mm", pitch_mm},
                      {"voxels", voxels},
                      {"origin_mm", triple(lattice.origin)},
                      {"size_mm", triple(lattice.box().size())}};
  if (request.part) {
    DataList first, count;
    for (const int64_t n : request.part->first) first.push_back(number(n));
    for (const int64_t n : request.part->count) count.push_back(number(n));
    members.emplace_back("part_of", DataMembers{{"first_voxel", first}, {"voxels", count}});
  }
  const DataMembers rules = SamplingRules::options().describe(request);
  members.insert(members.end(), rules.begin(), rules.end());
  return members;
}

Data images(const SliceRequest& request) {
  DataList flip;
  if (request.flip_x) flip.emplace_back("x");
  if (request.flip_y) flip.emplace_back("y");
  DataMembers members{{"format", voxel::to_text(request.format)},
                      {"files", request.files.text()},
                      {"first_index", number(request.first_index)},
                      {"empty_layers", request.drop_empty_layers ? "drop" : "keep"},
                      {"flip", flip}};
  if (const auto& exposure = request.exposure) {
    DataMembers light{{"seconds", exposure->seconds},
                      {"first_seconds", exposure->first_seconds},
                      {"fade_layers", number(exposure->fade_layers)}};
    if (exposure->irradiance) light.emplace_back("irradiance", *exposure->irradiance);
    members.emplace_back("exposure", std::move(light));
  }
  if (request.vats && request.has_materials() && request.files.has_material())
    members.emplace_back("vats", DataMembers{{"wash_seconds", request.vats->wash_seconds}});
  return members;
}

// Describes the materials in the order of the palette of indexed images.
Data materials(const SliceRequest& request) {
  DataList list{DataMembers{{"name", "void"}, {"id", 0.0}, {"rgba", colour(request.background)}}};
  for (const SliceMaterial& material : request.materials)
    list.emplace_back(
        DataMembers{{"name", material.name}, {"id", number(material.id)}, {"rgba", colour(material.rgba)}});
  return list;
}

std::string member_difference(const std::string& name, const Data* there, const Data* here) {
  if (there && here && *there == *here) return "";
  if (there && here && there->members() && here->members())
    return first_difference(*there->members(), *here->members());
  const auto text = [](const Data* data) { return data ? print_json_line(*data) : std::string("missing"); };
  return name + " is " + text(there) + " there and " + text(here) + " here";
}

}  // namespace

DataMembers describe_job(const SliceRequest& request) {
  DataList checks;
  for (const std::string& text : request.check_texts) checks.emplace_back(text);
  DataMembers job{{"format", std::string(job_format) + ", version 1"},
                  {"program", request.program},
                  {"design_hash", request.design_hash},
                  {"printer", request.printer},
                  {"sampling", sampling(request)}};
  if (!request.resolved.empty()) job.emplace_back("resolved", request.resolved);
  if (!request.corrections.empty()) job.emplace_back("corrections", request.corrections);
  if (request.has_materials()) job.emplace_back("materials", materials(request));
  if (DataList others = describe_channels(request); !others.empty()) job.emplace_back("channels", std::move(others));
  job.emplace_back("images", images(request));
  job.emplace_back("checks", checks);
  return job;
}

Data describe_totals(const SliceRequest& request, const std::map<int64_t, LayerEntry>& layers) {
  VoxelCounts counts = no_counts(request);
  uint64_t files = 0, bytes = 0;
  const LayerEntry *lowest = nullptr, *highest = nullptr;
  for (const auto& [index, layer] : layers) {
    counts.add(layer.counts);
    files += layer.files.size();
    for (const stores::StoredFile& file : layer.files) bytes += file.bytes;
    if (layer.counts.is_empty()) continue;
    if (!lowest) lowest = &layer;
    highest = &layer;
  }
  // The layers that are not empty, counted from the lowest layer of the job. They give the offset of a stack that drops
  // its empty layers.
  const Data occupied = lowest ? Data(DataList{number(lowest->layer), number(highest->layer)}) : Data();
  DataMembers totals = describe_counts(request, counts, voxel_mm3(request.lattice));
  totals.emplace_back("first_and_last_layer", occupied);
  totals.emplace_back("files", number(files));
  totals.emplace_back("bytes", number(bytes));
  return totals;
}

std::string first_difference(const DataMembers& there, const DataMembers& here) {
  const Data old_job(there), new_job(here);
  for (const auto& [name, member] : here)
    if (std::string text = member_difference(name, old_job.find(name), &member); !text.empty()) return text;
  for (const auto& [name, member] : there)
    if (!new_job.find(name)) return member_difference(name, &member, nullptr);
  return "";
}

}  // namespace ombre::compile
