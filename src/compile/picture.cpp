#include "compile/picture.h"

#include "base/text.h"
#include "compile/build.h"

namespace ombre::compile {
namespace {

// Towards the eye, if the plane is not seen from its edge: then what is above it.
int side_of_eye(int axis, const render::Camera& camera) {
  constexpr double edge_on = 1e-9;
  return camera.forward[axis] > edge_on ? -1 : 1;
}

std::optional<SceneOptions> scene_options(const Loaded& loaded, const PictureRequest& request,
                                          Diagnostics& diagnostics) {
  SceneOptions options;
  options.box = request.box;
  const design::MaterialTable& materials = loaded.design.materials;
  for (const auto& [name, opacity] : request.opacity) {
    if (const design::Material* material = materials.find(name)) {
      options.opacity[material->id] = opacity;
      continue;
    }
    diagnostics.error({loaded.source, 0, 0}, "there is no material \"" + name + "\" to give an opacity",
                      "the materials are " + join(materials.names(), ", "));
    return std::nullopt;
  }
  return options;
}

render::ViewOptions turned(render::ViewOptions view, int frame, int frames) {
  view.azimuth_deg += 360.0 * frame / frames;
  return view;
}

// The height that every frame fits into.
double common_height(const Box& box, const PictureRequest& request, double aspect) {
  double height = 0;
  for (int frame = 0; frame < request.frames; ++frame)
    height =
        std::max(height, render::camera_around(box, turned(request.view, frame, request.frames), aspect).height_mm);
  return height;
}

// Some rows after the other, so that large pictures fit into memory.
std::vector<uint8_t> expose(const render::Scene& scene, const render::Film& film, const render::Camera& camera,
                            const PictureRequest& request, const StopFlag& stop) {
  constexpr int64_t most_rays = 4'000'000;
  const int64_t samples = request.samples, rows = std::max<int64_t>(1, most_rays / (film.width * samples));
  std::vector<uint8_t> pixels;
  pixels.reserve(static_cast<size_t>(request.width * request.height * 4));
  for (int64_t begin = 0; begin < request.height; begin += rows) {
    const int64_t end = std::min(begin + rows, request.height);
    const auto band = render::cast_rays(scene, film, begin * samples - 1, end * samples + 1, request.threads,
                                        [&] { return stop.requested(); });
    if (stop.requested()) throw Cancelled();
    render::shade(band, film, camera, samples, request.background, begin, end, pixels);
  }
  return pixels;
}

}  // namespace

std::optional<CutRequest> parse_cut(std::string_view text) {
  const size_t sign = text.find_first_of("=<>");
  if (sign == std::string_view::npos) return std::nullopt;
  const std::string_view axis = trim(text.substr(0, sign));
  const std::optional<double> mm = parse_number(trim(text.substr(sign + 1)));
  if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z' || !mm || !std::isfinite(*mm)) return std::nullopt;
  return CutRequest{axis[0] - 'x', text[sign], *mm};
}

bool take_pictures(const Loaded& loaded, const PictureRequest& request, const StopFlag& stop,
                   const std::function<void(int, const Picture&)>& take, Diagnostics& diagnostics) {
  const auto whole = design_box(loaded.design, diagnostics);
  if (!whole) return false;
  auto options = scene_options(loaded, request, diagnostics);
  if (!options) return false;
  // What lies outside of the box that is sampled is not part of the job.
  if (loaded.design.sampling) options->box = options->box ? intersect(*options->box, *whole) : *whole;
  const double aspect = static_cast<double>(request.width) / static_cast<double>(request.height);
  const render::Film film{request.width * request.samples, request.height * request.samples, 0};
  for (int frame = 0; frame < request.frames; ++frame) {
    const render::ViewOptions view = turned(request.view, frame, request.frames);
    const render::Camera towards = render::camera_around(*whole, view, aspect);
    options->cuts.clear();
    for (const CutRequest& cut : request.cuts) {
      const int sign = cut.removed == '>' ? 1 : cut.removed == '<' ? -1 : side_of_eye(cut.axis, towards);
      options->cuts.push_back({cut.axis, cut.mm, sign});
    }
    const Box box = scene_box(*whole, *options);
    if (box.is_empty()) {
      diagnostics.error({loaded.source, 0, 0}, "nothing of the design is left by the cuts",
                        "move them: the design lies in x " + format_rounded(whole->lo.x) + " to " +
                            format_rounded(whole->hi.x) + ", y " + format_rounded(whole->lo.y) + " to " +
                            format_rounded(whole->hi.y) + ", z " + format_rounded(whole->lo.z) + " to " +
                            format_rounded(whole->hi.z) + " mm");
      return false;
    }
    render::Camera camera = render::camera_around(box, view, aspect);
    if (request.frames > 1) camera.height_mm = common_height(box, request, aspect);
    const auto scene = make_scene(loaded.design, box, camera, *options, diagnostics);
    if (!scene) return false;
    render::Film sharp = film;
    sharp.pixel_mm = camera.height_mm / static_cast<double>(sharp.height);
    take(frame, {expose(*scene, sharp, camera, request, stop), sharp.pixel_mm * static_cast<double>(request.samples)});
  }
  return true;
}

}  // namespace ombre::compile
