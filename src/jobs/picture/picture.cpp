#include "jobs/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/picture/picture_labels.h"
#include "jobs/picture/picture_overlays.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/part_labels.h"
#include "questions/question.h"
#include "questions/region_survey.h"
#include "render/ray_ends.h"

namespace ombre::compile {
namespace {

// Returns the side towards the eye; if the plane is seen from its edge, the side above it.
int side_of_eye(int axis, const render::Camera& camera) {
  constexpr double edge_on = 1e-9;
  return camera.forward[axis] > edge_on ? -1 : 1;
}

std::optional<SceneOptions> scene_options(const Loaded& loaded, const PictureRequest& request,
                                          Diagnostics& diagnostics) {
  SceneOptions options;
  options.box = request.box;
  options.threads = request.threads;
  options.memory = request.memory;
  const design::MaterialTable& materials = loaded.design.materials;
  for (const auto& [name, opacity] : request.opacity) {
    if (const design::Material* material = materials.find(name)) {
      options.opacity[material->id] = opacity;
      continue;
    }
    diagnostics.error(Code::unknown_material, {loaded.source, 0, 0},
                      "there is no material \"" + name + "\" to give an opacity",
                      "the materials are " + join(materials.names(), ", "));
    return std::nullopt;
  }
  return options;
}

render::ViewOptions turned(render::ViewOptions view, int frame, int frames) {
  view.azimuth_deg += 360.0 * frame / frames;
  return view;
}

// The scene and the film of a frame.
struct Shot {
  render::Camera camera;
  render::Film film;
  render::Lighting lighting = render::Lighting::from_the_eye;
  std::function<render::RayBand(int64_t begin, int64_t end)> cast;
};

// Keeps ends of rays in the memory of sub-designs.
class EndsMemory : public render::KnownEnds {
 public:
  explicit EndsMemory(design::SubDesignMemory& memory) : memory_(memory) {}

  std::shared_ptr<const render::RayEnds> find(const Hash& key) override {
    return std::static_pointer_cast<const render::RayEnds>(memory_.find(key));
  }
  void keep(const Hash& key, std::shared_ptr<const render::RayEnds> ends) override {
    const size_t bytes = ends->bytes();
    memory_.keep(key, std::move(ends), bytes);
  }

 private:
  design::SubDesignMemory& memory_;
};

constexpr int64_t most_rays = 2'000'000;  // limit for a band

class Studio {
 public:
  Studio(const Loaded& loaded, const PictureRequest& request, const StageLoan& loan, Diagnostics& diagnostics)
      : loaded_(loaded),
        request_(request),
        loan_(loan),
        stop_(*loan.stop),
        diagnostics_(diagnostics),
        progress_(loan.progress) {}

  bool take_all(const std::function<void(int, const Picture&)>& take) {
    if (!prepare()) return false;
    for (int frame = 0; frame < request_.frames; ++frame) {
      if (!is_wanted(frame)) continue;
      const auto shot = request_.slice ? section() : turned_solid(frame);
      if (!shot) return false;
      stages_of(loaded_.design)->prepare(loan_);
      is_empty_ = true;
      Picture picture{expose(*shot), shot->film.pixel_mm * static_cast<double>(request_.samples), shown_range_};
      if (!draw_overlays(picture, frame)) return false;
      if (labels_) labels_->add_to(picture, shot->camera);
      take(frame, picture);
      if (is_empty_ && frame == 0)
        diagnostics_.warning(Code::nothing_inside, {loaded_.source, 0, 0}, "there is nothing to be seen in the picture",
                             "look elsewhere: the design lies in " + extents());
    }
    return true;
  }

  std::optional<Vec3> point_at(int64_t column, int64_t row) {
    if (!prepare()) return std::nullopt;
    const auto shot = turned_solid(0);
    if (!shot) return std::nullopt;
    stages_of(loaded_.design)->prepare(loan_);
    const auto band = shot->cast(row, row + 1);
    if (stop_.requested()) throw Cancelled();
    const render::RayHit& hit = band.at(column, row);
    if (hit.surface == render::RayHit::none) return std::nullopt;
    const Vec3 view{hit.surface, shot->film.right_of(column), shot->film.down_of(row)};
    return shot->camera.design_from_view()(shot->camera.unprojected(view));
  }

 private:
  bool prepare() {
    const auto whole = design_box(loaded_.design, diagnostics_);
    if (!whole) return false;
    whole_ = *whole;
    auto options = scene_options(loaded_, request_, diagnostics_);
    if (!options) return false;
    options_ = std::move(*options);
    // Parts outside of the box that is sampled do not belong to the job.
    if (loaded_.design.sampling) options_.box = options_.box ? intersect(*options_.box, whole_) : whole_;
    if (!request_.by.empty() && !choose_range()) return false;
    width_ = request_.width;
    height_ = request_.height;
    const AnnotationRequest& wanted = request_.annotations;
    return !(wanted.axes || wanted.scale_bar || wanted.legend) || make_room();
  }

  bool choose_range() {
    options_.value = ValueColours{request_.by, {0, 1}, request_.palette};
    if (request_.by == part_label && !part_names(loaded_.design).empty()) return true;
    const bool is_fraction = loaded_.design.materials.find(request_.by) != nullptr;
    if (!is_fraction && attribute_parts(loaded_.design, request_.by).size() >= 3) return true;  // a colour
    const size_t errors = diagnostics_.error_count();
    std::optional<Interval> range = request_.range;
    if (!range && !is_fraction) range = value_range(loaded_.design, whole_, request_.by, diagnostics_);
    if (range) options_.value->range = *range;
    shown_range_ = options_.value->range;
    return diagnostics_.error_count() == errors;
  }

  bool make_room() {
    aim_cuts(camera_around(whole_, view_of(0)));
    const Box box = scene_box(whole_, options_);
    if (box.is_empty()) return nothing_left();
    labels_ = PictureLabels::make(loaded_, request_, request_.slice ? plane(box) : box, options_.value, diagnostics_);
    if (!labels_) return false;
    width_ = labels_->layout().width;
    height_ = labels_->layout().height;
    return true;
  }

  bool draw_overlays(Picture& picture, int frame) {
    const OverlayRequest& wanted = request_.overlays;
    for (const Divided by : {Divided::parts, Divided::materials}) {
      const bool outlines = wanted.outlines == by, names = wanted.names == by;
      if (!outlines && !names) continue;
      const auto numbers = numbers_of(by, frame);
      if (!numbers) return false;
      if (outlines) draw_outlines(picture.rgba, *numbers);
      if (!names) continue;
      draw::Pen pen(request_.annotations.font_file);
      draw_names(picture.rgba, *numbers, names_of(by), pen);
    }
    return true;
  }

  // Finds the numbers of parts or materials by one ray for each pixel.
  std::optional<PictureNumbers> numbers_of(Divided by, int frame) {
    if (by == Divided::parts && part_names(loaded_.design).empty()) {
      report_nameless_parts(loaded_.design, diagnostics_);
      return std::nullopt;
    }
    options_.numbers = by;
    samples_ = 1;
    const auto shot = request_.slice ? section() : turned_solid(frame);
    options_.numbers.reset();
    samples_ = request_.samples;
    if (!shot) return std::nullopt;
    PictureNumbers made{width_, height_, {}};
    made.numbers.reserve(static_cast<size_t>(width_ * height_));
    const int64_t rows = rows_at_once(1);
    for (int64_t begin = 0; begin < height_; begin += rows) {
      const int64_t end = std::min(begin + rows, height_);
      const auto band = shot->cast(begin, end);
      if (stop_.requested()) throw Cancelled();
      for (int64_t row = begin; row < end; ++row)
        for (int64_t column = 0; column < width_; ++column) {
          const render::RayHit& hit = band.at(column, row);
          const bool is_there = hit.surface != render::RayHit::none;
          made.numbers.push_back(
              is_there ? static_cast<int16_t>(std::lround(hit.at_end.red * static_cast<float>(most_numbers)))
                       : int16_t{-1});
        }
    }
    return made;
  }

  std::map<int, std::string> names_of(Divided by) const {
    std::map<int, std::string> names;
    if (by == Divided::materials)
      for (const design::Material& material : loaded_.design.materials.all()) names[material.id] = material.name;
    else
      for (const std::string& name : part_names(loaded_.design)) names[static_cast<int>(names.size()) + 1] = name;
    return names;
  }

  double aspect() const { return static_cast<double>(width_) / static_cast<double>(height_); }
  render::Camera camera_around(const Box& box, const render::ViewOptions& view) const {
    return render::camera_around(box, view, aspect());
  }

  render::ViewOptions view_of(int frame) const {
    if (!request_.slice) return turned(request_.view, frame, request_.frames);
    constexpr const char* views[] = {"right", "front", "top"};
    render::ViewOptions view = *render::named_view(views[request_.slice->axis]);
    view.zoom = request_.view.zoom;
    return view;
  }

  void aim_cuts(const render::Camera& towards) {
    options_.cuts.clear();
    for (const CutRequest& request : request_.cuts) {
      Cut& cut = options_.cuts.emplace_back();
      for (const CutSide& side : request) {
        const int sign = side.removed == '>' ? 1 : side.removed == '<' ? -1 : side_of_eye(side.axis, towards);
        cut.push_back({side.axis, side.mm, sign});
      }
    }
  }

  bool nothing_left() {
    diagnostics_.error(Code::nothing_inside, {loaded_.source, 0, 0}, "nothing of the design is left by the cuts",
                       "move them: the design lies in " + extents());
    return false;
  }
  std::string extent(int axis) const {
    return std::string(1, static_cast<char>('x' + axis)) + " " + format_rounded(whole_.lo[axis]) + " to " +
           format_rounded(whole_.hi[axis]);
  }

  std::string extents() const { return extent(0) + ", " + extent(1) + ", " + extent(2) + " mm"; }

  // Returns a height that every frame fits into.
  double common_height(const Box& box) const {
    double height = 0;
    for (int frame = 0; frame < request_.frames; ++frame)
      height = std::max(height, camera_around(box, view_of(frame)).height_mm);
    return height;
  }

  render::Film film_of(const render::Camera& camera) const {
    const int64_t height = height_ * samples_;
    return {width_ * samples_, height, camera.height_mm / static_cast<double>(height), samples_};
  }

  // Returns the design for voxels as fine as the picture's pixels.
  design::Design design_for(const render::Film& film) const {
    const double pixel = film.pixel_mm * static_cast<double>(film.samples);
    return design::for_job(loaded_.design, Vec3{pixel, pixel, pixel});
  }

  std::optional<Shot> turned_solid(int frame) {
    const render::ViewOptions view = view_of(frame);
    aim_cuts(camera_around(whole_, view));
    const Box box = scene_box(whole_, options_);
    if (box.is_empty()) {
      nothing_left();
      return std::nullopt;
    }
    Shot shot;
    shot.camera = camera_around(box, view);
    if (request_.frames > 1) shot.camera.height_mm = common_height(box);
    shot.film = film_of(shot.camera);
    auto scene = make_scene(design_for(shot.film), box, shot.camera, options_, diagnostics_);
    if (!scene) return std::nullopt;
    shot.cast = [this, film = shot.film, scene = std::move(*scene)](int64_t begin, int64_t end) {
      std::optional<EndsMemory> ends;
      if (request_.memory) ends.emplace(*request_.memory);
      return render::cast_rays(
          scene, film, begin - 1, end + 1, request_.threads, [&] { return stop_.requested(); },
          ends ? &*ends : nullptr);
    };
    return shot;
  }

  Box plane(Box box) const {
    box.lo[request_.slice->axis] = box.hi[request_.slice->axis] = request_.slice->mm;
    return box;
  }

  std::optional<Shot> section() {
    const SliceView& slice = *request_.slice;
    const render::ViewOptions view = view_of(0);
    aim_cuts(camera_around(whole_, view));
    const Box box = scene_box(whole_, options_);
    if (box.is_empty() || slice.mm < box.lo[slice.axis] || slice.mm > box.hi[slice.axis]) {
      diagnostics_.error(Code::nothing_inside, {loaded_.source, 0, 0}, "the slice does not meet the design",
                         "move it: the design lies in " + extents());
      return std::nullopt;
    }
    Shot shot;
    shot.camera = camera_around(plane(box), view);
    shot.film = film_of(shot.camera);
    shot.lighting = render::Lighting::none;
    const auto made = make_section(design_for(shot.film), shot.camera, shot.film, options_, diagnostics_);
    if (!made) return std::nullopt;
    shot.cast = [this, made](int64_t begin, int64_t end) { return made->cast(begin, end, request_.threads, stop_); };
    return shot;
  }

  std::vector<uint8_t> expose(const Shot& shot) {
    const int64_t samples = request_.samples, rows = rows_at_once(samples);
    std::vector<uint8_t> pixels;
    pixels.reserve(static_cast<size_t>(width_ * height_ * 4));
    for (int64_t begin = 0; begin < height_; begin += rows) {
      const int64_t end = std::min(begin + rows, height_);
      auto band = shot.cast(begin * samples, end * samples);
      if (stop_.requested()) throw Cancelled();
      // With lighting, the rows around count, too.
      if (request_.face_colours && !request_.slice)
        colour_faces(band, begin * samples - 1, end * samples + 1, shot.film, shot.camera, cut_faces(options_),
                     request_.face_colours);
      is_empty_ = is_empty_ && std::ranges::none_of(band.all(), [](const render::RayHit& ray) {
                    return ray.surface != render::RayHit::none;
                  });
      render::shade(band, shot.film, shot.camera, {shot.lighting, samples, request_.background}, begin, end,
                    request_.threads, pixels);
      rows_done_ += static_cast<uint64_t>(end - begin);
      if (progress_) progress_->update(at_steady_pace(rows_done_, rows_in_all(), watch_.seconds()));
    }
    return pixels;
  }

  // Returns the number of rows of pixels in a band, so that large pictures fit into memory.
  int64_t rows_at_once(int64_t samples) const { return std::max<int64_t>(1, most_rays / (width_ * samples * samples)); }

  bool is_wanted(int frame) const { return !request_.wants || request_.wants(frame); }
  uint64_t rows_in_all() const {
    uint64_t frames = 0;
    for (int frame = 0; frame < request_.frames; ++frame) frames += is_wanted(frame) ? 1 : 0;
    return frames * static_cast<uint64_t>(height_);
  }

  const Loaded& loaded_;
  const PictureRequest& request_;
  const StageLoan& loan_;
  const StopFlag& stop_;
  Diagnostics& diagnostics_;
  Box whole_;
  SceneOptions options_;
  std::optional<Interval> shown_range_;  // range of the colours
  int64_t width_ = 0, height_ = 0;       // size of the shown part, pixels
  int64_t samples_ = request_.samples;
  std::optional<PictureLabels> labels_;
  bool is_empty_ = true;  // in the current frame
  Progress* progress_;
  Stopwatch watch_;
  uint64_t rows_done_ = 0;
};

// Checks the memory. Bands always have the same size, since their borders show in sums over translucent material.
void check_memory(const PictureRequest& request) {
  const double row = static_cast<double>(request.width * request.samples * request.samples);
  const double rays = std::max<double>(most_rays, row) * sizeof(render::RayHit);
  // The pixels, and the file that they become.
  const double pixels = 2.0 * 4 * static_cast<double>(request.width) * static_cast<double>(request.height);
  if (rays + pixels > static_cast<double>(request.memory_bytes))
    throw Error(Code::memory, "the picture takes about " + format_bytes(rays + pixels) + " of memory, more than the " +
                                  format_bytes(static_cast<double>(request.memory_bytes)) +
                                  " allowed; choose a smaller " + spelled::option("--size") + ", or more " +
                                  spelled::option("--memory"));
}

}  // namespace

std::optional<Vec3> point_at_pixel(const Loaded& loaded, const PictureRequest& request, int64_t column, int64_t row,
                                   const StopFlag& stop, Diagnostics& diagnostics) {
  check_memory(request);
  const StageLoan loan{request.threads, request.memory_bytes, nullptr, &stop, request.memory, true};
  PictureRequest effective = request;
  effective.samples = 1;
  effective.by.clear();
  const Loaded own{loaded.path, loaded.source, with_stages(loaded.design, loan)};
  return Studio(own, effective, loan, diagnostics).point_at(column, row);
}

bool take_pictures(const Loaded& loaded, const PictureRequest& request, const StopFlag& stop,
                   const std::function<void(int, const Picture&)>& take, Diagnostics& diagnostics, Progress* progress) {
  check_memory(request);
  const StageLoan loan{request.threads, request.memory_bytes, progress, &stop, request.memory, true};
  PictureRequest effective = request;
  const std::vector<std::string> attributes = attribute_names(loaded.design);
  const bool by_parts = request.by == "parts" && std::ranges::find(attributes, request.by) == attributes.end();
  if (by_parts) effective.by = part_label;
  const bool has_parts =
      by_parts || request.overlays.outlines == Divided::parts || request.overlays.names == Divided::parts;
  const Loaded own{loaded.path, loaded.source,
                   with_stages(has_parts ? with_part_nodes(loaded.design) : loaded.design, loan)};
  if (by_parts && part_names(own.design).empty()) {
    report_nameless_parts(own.design, diagnostics);
    return false;
  }
  return Studio(own, effective, loan, diagnostics).take_all(take);
}

}  // namespace ombre::compile
