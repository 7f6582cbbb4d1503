#include "studio/views.h"

#include <algorithm>
#include <array>

#include "base/text/error.h"
#include "base/text/json.h"
#include "formats/images/png.h"
#include "jobs/picture/picture.h"
#include "jobs/probe/probe.h"
#include "jobs/slice/job_description.h"
#include "jobs/slice/layer.h"
#include "jobs/slice/slice.h"
#include "questions/colour_map.h"
#include "studio/design_answer.h"
#include "studio/nodes_at.h"

namespace ombre::studio {
namespace {

constexpr int64_t most_pixels = 4096;  // limit for pictures along each axis
constexpr int64_t most_tile = 1024;    // limit for tiles along each axis

void read_camera(const Request& request, render::ViewOptions& view) {
  view.azimuth_deg = request.number("azimuth", view.azimuth_deg);
  view.elevation_deg = std::clamp(request.number("elevation", view.elevation_deg), -90.0, 90.0);
  view.field_of_view_deg = std::clamp(request.number("perspective", 0), 0.0, 120.0);
  if (request.body.find("target")) {
    const std::vector<double> target = request.numbers("target", 3);
    view.target = Vec3{target[0], target[1], target[2]};
  }
  if (!request.body.find("height_mm")) return;
  view.height_mm = request.number("height_mm");
  if (!(*view.height_mm > 0)) throw RequestError("request", "\"height_mm\" of a picture is greater than 0");
}

Box box_of(const Request& request) {
  const std::vector<double> v = request.numbers("box", 6);
  if (!(v[0] < v[3] && v[1] < v[4] && v[2] < v[5]))
    throw RequestError("request", "\"box\" is [x0, y0, z0, x1, y1, z1], each at its end greater than at its beginning");
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

void read_opacity(const Request& request, compile::PictureRequest& picture) {
  const Data* opacity = request.body.find("opacity");
  if (!opacity || opacity->is_null()) return;
  if (!opacity->members()) throw RequestError("request", "\"opacity\" is an object, {\"clear\": 0.2}");
  for (const auto& [name, value] : *opacity->members()) {
    if (!value.number() || !(*value.number() >= 0 && *value.number() <= 1))
      throw RequestError("request", "the opacity of " + name + " is a number from 0 to 1");
    picture.opacity.emplace_back(name, *value.number());
  }
}

compile::PictureRequest picture_request(const Request& request) {
  compile::PictureRequest picture;
  picture.width = request.whole("width", 1, most_pixels);
  picture.height = request.whole("height", 1, most_pixels);
  picture.samples = request.body.find("samples") ? request.whole("samples", 1, 4) : 1;
  picture.background.is_transparent = true;
  read_camera(request, picture.view);
  read_opacity(request, picture);
  for (const std::string& text : request.texts("cuts")) {
    const auto cut = compile::parse_cut(text);
    if (!cut)
      throw RequestError("request", "\"" + text + "\" is no cut; write for example x=0, or x>0,y<0 for a wedge");
    picture.cuts.push_back(*cut);
  }
  if (request.body.find("box")) picture.box = box_of(request);
  picture.by = request.text("by", "");
  picture.palette = request.text("palette", "");
  if (!picture.palette.empty() && !compile::palette_called(picture.palette))
    throw RequestError("request", "there is no palette called \"" + picture.palette + "\"");
  if (request.body.find("range")) {
    const std::vector<double> range = request.numbers("range", 2);
    picture.range = Interval{range[0], range[1]};
  }
  return picture;
}

DataList colour_list(const formats::Rgba& colour) {
  DataList list;
  for (const uint8_t channel : colour) list.emplace_back(number(channel));
  return list;
}

// Changes a request so that tiles show materials in their colours, or the job's values, with x to the right and y up,
// whatever the printer's files do.
compile::SliceRequest shown(const compile::SliceRequest& request) {
  compile::SliceRequest tile = request;
  if (tile.has_materials()) tile.format = ImageFormat::rgba;
  tile.flip_x = tile.flip_y = false;
  tile.background = {0, 0, 0, 0};
  tile.files = {};
  return tile;
}

DataMembers members_of(const std::vector<std::pair<std::string, double>>& values) {
  DataMembers members;
  for (const auto& [name, value] : values) members.emplace_back(name, value);
  return members;
}

// Describes the voxel that holds the point, and what slicing puts there.
DataMembers voxel_at(OpenDesign& design, const Request& request, Vec3 point, const StopFlag& stop) {
  const CutDesignPtr cut = design.cut(read_job_choices(request, {"at"}));
  const compile::SliceRequest& job = cut->plan.request;
  std::array<int64_t, 3> voxel{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double at = point[static_cast<int>(axis)];
    const double in_voxels = (at - job.lattice.origin[static_cast<int>(axis)]) / job.lattice.pitch[axis].mm();
    if (!(in_voxels >= 0 && in_voxels < static_cast<double>(job.lattice.count[axis]))) return {};
    voxel[axis] = static_cast<int64_t>(in_voxels);
  }
  const voxel::TileBox box{voxel, {voxel[0] + 1, voxel[1] + 1, voxel[2] + 1}};
  const DataList index{number(voxel[0]), number(voxel[1]), number(voxel[2])};
  if (!job.has_materials()) return {{"index", index}};
  const auto made = cut->plan.regions(box, &stop);
  MaterialId id = 0;
  made.front().materials().row(0).unpack(&id);
  std::string name = "void";
  for (const compile::SliceMaterial& material : job.materials)
    if (material.id == id) name = material.name;
  return {{"index", index}, {"material", name}};
}

}  // namespace

namespace {

// Returns the job whose voxels are shown on faces, with voxels as long along x and y as pixels, or shorter.
CutDesignPtr job_for_faces(OpenDesign& design, const Request& request, double pixel_mm) {
  Request of_job = request;
  of_job.body = *request.body.find("voxels");
  if (!of_job.body.members()) throw RequestError("request", "\"voxels\" is an object with options of the job");
  JobChoices choices = read_job_choices(of_job, {});
  choices.level = 0;
  CutDesignPtr cut = design.cut(choices);
  const auto& pitch = cut->plan.request.lattice.pitch;
  const double in_voxels = pixel_mm / std::min(pitch[0].mm(), pitch[1].mm());
  choices.level = in_voxels >= 2 ? std::min(coarsest_level, std::ilogb(in_voxels)) : 0;
  return choices.level > 0 ? design.cut(choices) : cut;
}

}  // namespace

Answer picture_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  compile::PictureRequest picture = picture_request(request);
  picture.memory = &design.memory;
  if (request.body.find("voxels")) {
    if (!picture.view.height_mm) throw RequestError("request", "\"voxels\" of a picture need its \"height_mm\"");
    CutDesignPtr cut = job_for_faces(design, request, *picture.view.height_mm / static_cast<double>(picture.height));
    if (cut->plan.request.has_materials()) picture.face_colours = voxels_on_faces(std::move(cut), design.memory, stop);
  }
  Answer answer;
  Diagnostics diagnostics;
  const auto take = [&](int, const compile::Picture& made) {
    if (stop.requested()) throw Cancelled();
    answer.bytes =
        formats::encode_png(static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height), made.rgba);
    answer.members = {{"pixel_mm", made.pixel_mm}};
    if (made.range) answer.members.emplace_back("range", DataList{made.range->lo, made.range->hi});
  };
  if (!compile::take_pictures(*design.loaded, picture, stop, take, diagnostics) || diagnostics.has_errors())
    throw design_error(diagnostics);
  return answer;
}

Answer seen_at_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  compile::PictureRequest picture = picture_request(request);
  picture.memory = &design.memory;
  const std::vector<double> pixel = request.numbers("pixel", 2);
  const auto within = [](double v, int64_t size) { return v >= 0 && v < static_cast<double>(size); };
  if (!within(pixel[0], picture.width) || !within(pixel[1], picture.height))
    throw RequestError("request", "\"pixel\" is [column, row] in the picture");
  Diagnostics diagnostics;
  const auto point = compile::point_at_pixel(*design.loaded, picture, static_cast<int64_t>(pixel[0]),
                                             static_cast<int64_t>(pixel[1]), stop, diagnostics);
  if (diagnostics.has_errors()) throw design_error(diagnostics);
  return {{{"at", point ? Data(list_of(*point)) : Data()}}, {}};
}

Answer plan_answer(OpenDesign& design, const Request& request, const StopFlag&) {
  const CutDesignPtr cut = design.cut(read_job_choices(request, {}));
  const compile::SliceRequest& job = cut->plan.request;
  DataList count, pitch, materials;
  for (size_t axis = 0; axis < 3; ++axis) {
    count.emplace_back(number(job.lattice.count[axis]));
    pitch.emplace_back(job.lattice.pitch[axis].mm());
  }
  for (const compile::SliceMaterial& material : job.materials)
    materials.emplace_back(DataMembers{{"name", material.name}, {"colour", colour_list(material.rgba)}});
  return {{{"title", cut->printer.title},
           {"count", std::move(count)},
           {"pitch_mm", std::move(pitch)},
           {"origin_mm", list_of(job.lattice.origin)},
           {"materials", std::move(materials)},
           {"remarks", describe(cut->remarks, design.loaded->source)},
           {"job", print_json(compile::describe_job(job))}},
          {}};
}

Answer tile_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  const CutDesignPtr cut = design.cut(read_job_choices(request, {"layer", "x", "y", "width", "height"}));
  const auto& count = cut->plan.request.lattice.count;
  const int64_t layer = request.whole("layer", 0, count[2] - 1);
  const int64_t x = request.whole("x", 0, count[0] - 1), y = request.whole("y", 0, count[1] - 1);
  const int64_t width = std::min(request.whole("width", 1, most_tile), count[0] - x);
  const int64_t height = std::min(request.whole("height", 1, most_tile), count[1] - y);
  const compile::LayerWindow window{{x, y}, {x + width, y + height}};
  const compile::RegionProducer regions = [&](const voxel::TileBox& box, const StopFlag*) {
    return cut->plan.regions(box, &stop);
  };
  compile::LayerImages images = compile::make_layer(shown(cut->plan.request), regions, layer, window);
  return {{{"width", number(width)}, {"height", number(height)}}, std::move(images.bytes.front())};
}

Answer probe_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  const std::vector<double> at = request.numbers("at", 3);
  const Vec3 point{at[0], at[1], at[2]};
  Diagnostics diagnostics;
  const auto results = compile::probe(*design.loaded, {point}, diagnostics);
  if (!results) throw design_error(diagnostics);
  const compile::ProbeResult& result = results->front();
  DataList parts;
  for (const std::string& part : result.parts) parts.emplace_back(part);
  const compile::Loaded& loaded = *design.loaded;
  const PageOffsets offsets(loaded.source->text());
  DataList nodes;
  if (result.inside)
    for (const design::Node* node : nodes_at(loaded.design, point, stop))
      nodes.emplace_back(describe_call(*node, loaded.source, offsets));
  return {{{"at", list_of(point)},
           {"inside", result.inside},
           {"distance_mm", result.distance},
           {"composition", members_of(result.composition)},
           {"attributes", members_of(result.attributes)},
           {"parts", std::move(parts)},
           {"nodes", std::move(nodes)},
           {"voxel", voxel_at(design, request, point, stop)}},
          {}};
}

Answer estimate_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  const CutDesignPtr cut = design.cut(read_job_choices(request, {}));
  compile::SliceOptions options;
  options.stages = cut->plan.stages;
  const compile::SliceEstimate estimate = compile::estimate_slice(cut->plan.request, cut->plan.samples, options, &stop);
  DataList checks;
  for (const compile::CheckReport& check : estimate.checks) checks.emplace_back(check.text);
  return {{{"seconds", estimate.seconds},
           {"bytes", number(estimate.bytes)},
           {"is_least", estimate.is_least},
           {"memory_bytes", number(estimate.memory_bytes)},
           {"checks", std::move(checks)}},
          {}};
}

}  // namespace ombre::studio
