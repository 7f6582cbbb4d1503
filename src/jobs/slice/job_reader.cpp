// Reads job.json.
#include "jobs/slice/job_reader.h"

#include <cmath>

#include "base/text/json.h"
#include "base/text/record.h"
#include "jobs/slice/job_description.h"
#include "options/members.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {
namespace {

constexpr double most_voxels = 1e9;    // along an axis
constexpr int most_points_along = 16;  // along an axis of a voxel
constexpr NumberRange byte{0, 255, true}, voxel_count{1, most_voxels, true}, first_voxel{0, most_voxels, true};

void read_pitch(Sampling& sampling, const Data& data, const MemberReader& reader) {
  const DataList* list = data.list();
  if (!list || list->size() != 3) return reader.fail_expected(data, "three lengths");
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::string* text = (*list)[axis].string();
    const auto pitch = text ? Pitch::parse(*text) : std::nullopt;
    if (!pitch) return reader.fail_expected((*list)[axis], R"(a length in mm as text, such as "0.027" or "127/3000")");
    sampling.lattice.pitch[axis] = *pitch;
  }
}

Record<PartOfJob> part_record() {
  return Record<PartOfJob>("\"part_of\"",
                           {field::numbers("first_voxel", &PartOfJob::first, "[i, j, k]", first_voxel).required(),
                            field::numbers("voxels", &PartOfJob::count, "[x, y, z]", voxel_count).required()});
}

// Each rule is an option, which knows how its text is read.
Field<Sampling> rule_field(const options::Option& option) {
  const auto read = [option](Sampling& sampling, const Data& data, const MemberReader& reader) {
    try {
      options::set_member(option, static_cast<SamplingRules*>(&sampling), data);
    } catch (const options::WrongValue& wrong) {
      reader.fail(data, wrong.what());
    }
  };
  return Field<Sampling>(options::member_name(option.name()), read).required();
}

Record<Sampling> sampling_record() {
  std::vector<Field<Sampling>> fields{
      field::special("pitch", read_pitch).required(),
      Field<Sampling>("voxels",
                      [](Sampling& sampling, const Data& data, const MemberReader& reader) {
                        if (const auto counts = reader.numbers(data, "voxels", 3, "[x, y, z]", voxel_count))
                          for (size_t axis = 0; axis < 3; ++axis)
                            sampling.lattice.count[axis] = static_cast<int64_t>((*counts)[axis]);
                      })
          .required(),
      Field<Sampling>("origin_mm",
                      [](Sampling& sampling, const Data& data, const MemberReader& reader) {
                        if (const auto corner = reader.numbers(data, "origin_mm", 3, "[x, y, z] in mm"))
                          sampling.lattice.origin = {(*corner)[0], (*corner)[1], (*corner)[2]};
                      })
          .required(),
      field::object("part_of", &Sampling::part, part_record())};
  for (const options::Option& option : SamplingRules::options().options()) fields.push_back(rule_field(option));
  return Record<Sampling>("\"sampling\"", std::move(fields)).knows({"pitch_mm", "size_mm"});
}

struct ReadMaterial {
  std::string name;
  int id = 0;
  formats::Rgba rgba{};
};

Record<ReadMaterial> material_record() {
  using M = ReadMaterial;
  return Record<M>("a material",
                   {field::text("name", &M::name).required(), field::whole("id", &M::id, 0, 255).required(),
                    field::numbers("rgba", &M::rgba, "[r, g, b, a]", byte).required()});
}

// Reads the materials, the first of which is void.
void read_materials(DescribedJob& job, const Data& data, const MemberReader& reader) {
  const DataList* list = reader.list(data, "materials");
  if (!list || list->empty()) return reader.fail(data, "the first material is void");
  for (const Data& element : *list) {
    ReadMaterial read;
    if (!material_record().read(element, read, reader)) return;
    const bool is_void = &element == &list->front();
    if ((read.id == 0) != is_void) return reader.fail(element, "the first material, and no other one, has the id 0");
    if (is_void)
      job.request.background = read.rgba;
    else
      job.request.materials.push_back({read.name, static_cast<MaterialId>(read.id), read.rgba});
  }
  job.request.channels.insert(job.request.channels.begin(), voxel::Channel{});
}

std::optional<voxel::ChannelType> read_type(const Data& data, const MemberReader& reader) {
  const auto type = data.string() ? voxel::channel_type(*data.string()) : std::nullopt;
  if (!type) reader.fail(data, "this is not a type of channels: " + describe(data));
  return type;
}

std::optional<Interval> read_range(const Data& data, const MemberReader& reader) {
  const auto ends = reader.numbers(data, "range", 2, "[black, white]");
  return ends ? std::optional(Interval((*ends)[0], (*ends)[1])) : std::nullopt;
}

// Reads a text that may be empty.
std::optional<std::string> read_any_text(const Data& data, const MemberReader& reader) {
  if (data.string()) return *data.string();
  reader.fail_expected(data, "a text");
  return std::nullopt;
}

Record<voxel::Channel> channel_record() {
  using C = voxel::Channel;
  return Record<C>("a channel",
                   {field::text("name", &C::name).required(), field::value("type", &C::type, read_type).required(),
                    field::value("unit", &C::unit, read_any_text), field::value("range", &C::range, read_range),
                    field::whole("samples", &C::samples, 1, most_points_along)});
}

void read_channels(DescribedJob& job, const Data& data, const MemberReader& reader) {
  const DataList* list = reader.list(data, "channels");
  if (!list) return;
  for (const Data& element : *list) channel_record().read(element, job.request.channels.emplace_back(), reader);
}

std::optional<voxel::NamePattern> read_pattern(const Data& data, const MemberReader& reader) {
  const auto pattern = data.string() ? voxel::NamePattern::parse(*data.string()) : std::nullopt;
  if (!pattern) reader.fail(data, "this is not a pattern for file names: " + describe(data));
  return pattern;
}

void read_flip(voxel::Images& images, const Data& data, const MemberReader& reader) {
  const DataList* list = reader.list(data, "flip");
  if (!list) return;
  for (const Data& axis : *list) {
    if (axis == Data("x"))
      images.flip_x = true;
    else if (axis == Data("y"))
      images.flip_y = true;
    else
      reader.fail_expected(axis, R"("x" or "y")");
  }
}

Record<voxel::Images> images_record() {
  using I = voxel::Images;
  return Record<I>(
      "\"images\"",
      {field::choice("format", &I::format, voxel::image_format_names()).required(),
       field::value("files", &I::files, read_pattern).required(),
       field::whole("first_index", &I::first_index, -most_voxels, 2 * most_voxels).required(),
       field::choice("empty_layers", &I::drop_empty_layers, {"keep", "drop"}).required(),
       field::special("flip", read_flip).required(), field::object("exposure", &I::exposure, voxel::exposure_record()),
       field::object("vats", &I::vats, voxel::vats_record())});
}

void read_checks(DescribedJob& job, const Data& data, const MemberReader& reader) {
  const DataList* list = reader.list(data, "checks");
  if (!list) return;
  for (const Data& text : *list) {
    if (!text.string()) return reader.fail_expected(text, "a text");
    job.request.check_texts.push_back(*text.string());
  }
}

// Keeps a list as it is written.
Field<DescribedJob> list_field(const std::string& name, DataList SliceRequest::*member) {
  return {name, [=](DescribedJob& job, const Data& data, const MemberReader& reader) {
            if (const DataList* list = reader.list(data, name)) job.request.*member = *list;
          }};
}

// Reads an object whose record is of a part of the request.
template <class Part>
Field<DescribedJob> part_field(const std::string& name, Record<Part> record) {
  return {name, [record = std::move(record)](DescribedJob& job, const Data& data, const MemberReader& reader) {
            record.read(data, static_cast<Part&>(job.request), reader);
          }};
}

Field<DescribedJob> text_field(const std::string& name, std::string SliceRequest::*member) {
  return {name, [=](DescribedJob& job, const Data& data, const MemberReader& reader) {
            if (const auto text = read_any_text(data, reader)) job.request.*member = *text;
          }};
}

const Record<DescribedJob>& job_record() {
  using J = DescribedJob;
  static const Record<J> record =
      Record<J>("job.json",
                {text_field("program", &SliceRequest::program).required(),
                 text_field("design_hash", &SliceRequest::design_hash).required(),
                 text_field("printer", &SliceRequest::printer).required(),
                 part_field("sampling", sampling_record()).required(), field::special("materials", read_materials),
                 field::special("channels", read_channels), part_field("images", images_record()).required(),
                 field::special("checks", read_checks).required(), list_field("resolved", &SliceRequest::resolved),
                 list_field("corrections", &SliceRequest::corrections),
                 field::choice("status", &J::is_complete, {"unfinished", "complete"}),
                 Field<J>("totals", [](J& job, const Data& data, const MemberReader&) { job.totals = data; })})
          .knows({"format", "shades"})  // jobs of values had shades in an earlier version
          .checked([](J& job, const Data& data, const MemberReader& reader) {
            if (job.request.channels.empty()) reader.fail(data, "a job has \"materials\" or \"channels\"");
          });
  return record;
}

}  // namespace

std::optional<DescribedJob> read_job(const SourcePtr& source, Diagnostics& diagnostics) {
  const auto data = parse_json(source, diagnostics);
  if (!data) return std::nullopt;
  const MemberReader reader(diagnostics, Code::file_content);
  const Data* format = data->find("format");
  DescribedJob job;
  job.request.channels.clear();
  if (!format || *format != Data(std::string(job_format) + ", version 1"))
    reader.fail(*data, "this is not a slice job that this version of Ombre reads",
                "\"format\" is \"" + std::string(job_format) + ", version 1\" there");
  else if (job_record().read(*data, job, reader))
    return job;
  return std::nullopt;
}

}  // namespace ombre::compile
