// Makes the contents of job.json.
#include "jobs/slice/job_description.h"

#include <algorithm>

#include "base/text/json.h"
#include "base/text/text.h"

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
  return DataMembers{{"format", voxel::to_text(request.format)},
                     {"files", request.files.text()},
                     {"first_index", number(request.first_index)},
                     {"empty_layers", request.drop_empty_layers ? "drop" : "keep"},
                     {"flip", flip}};
}

Data shades(const ShadeMeaning& meaning) {
  return DataMembers{{"of", meaning.of},
                     {"unit", meaning.unit},
                     {"black", meaning.range.lo},
                     {"white", meaning.range.hi},
                     {"bits", static_cast<double>(meaning.bits)}};
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
                  {"sampling", sampling(request)},
                  {"materials", materials(request)},
                  {"images", images(request)},
                  {"checks", checks}};
  if (request.shades) job.emplace_back("shades", shades(*request.shades));
  return job;
}

Data describe_totals(const SliceRequest& request, const std::map<int64_t, LayerEntry>& layers) {
  std::vector<uint64_t> voxels(request.materials.size());
  uint64_t files = 0, bytes = 0;
  const LayerEntry *lowest = nullptr, *highest = nullptr;
  for (const auto& [index, layer] : layers) {
    for (size_t i = 0; i < voxels.size(); ++i) voxels[i] += layer.voxels[i];
    files += layer.files.size();
    for (const stores::StoredFile& file : layer.files) bytes += file.bytes;
    if (layer.is_empty()) continue;
    if (!lowest) lowest = &layer;
    highest = &layer;
  }
  const auto& pitch = request.lattice.pitch;
  const double voxel_mm3 = pitch[0].mm() * pitch[1].mm() * pitch[2].mm();
  DataList by_material;
  for (size_t i = 0; i < voxels.size(); ++i)
    by_material.emplace_back(DataMembers{{"name", request.materials[i].name},
                                         {"voxels", number(voxels[i])},
                                         {"volume_mm3", static_cast<double>(voxels[i]) * voxel_mm3}});
  // The layers with material, counted from the lowest layer of the job. They give the offset of a stack that drops its
  // empty layers.
  const Data occupied = lowest ? Data(DataList{number(lowest->layer), number(highest->layer)}) : Data();
  return DataMembers{{"materials", by_material},
                     {"first_and_last_layer", occupied},
                     {"files", number(files)},
                     {"bytes", number(bytes)}};
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
