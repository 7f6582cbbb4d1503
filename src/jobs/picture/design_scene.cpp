#include "jobs/picture/design_scene.h"

#include <algorithm>
#include <cmath>

#include "questions/build.h"
#include "questions/colour_map.h"
#include "questions/part_labels.h"
#include "questions/question.h"
#include "render/shade.h"

namespace ombre::compile {
namespace {

using program::Field;
using program::Point;

// Returns the point in a perspective view for a program's inputs: a depth, and a place (right, down) at that depth.
Point in_perspective(program::Builder& builder, const render::Camera& camera) {
  const Point view = Point::origin_frame(builder);
  const Field stretch = (view.x + camera.distance_mm) / camera.distance_mm;
  return Point::of(view.x, view.y * stretch, view.z * stretch);
}

Field within_cuts(Field inside, const Point& p, const SceneOptions& options) {
  const Field coordinates[] = {p.x, p.y, p.z};
  for (const Cut& cut : options.cuts) {
    std::optional<Field> before;  // true in front of one of the planes
    for (const CutPlane& plane : cut) {
      const Field at = coordinates[plane.axis], face = p.constant(plane.mm);
      const Field is_before = plane.sign > 0 ? less_equal(at, face) : less_equal(face, at);
      before = before ? logical_or(*before, is_before) : is_before;
    }
    if (before) inside = logical_and(inside, *before);
  }
  if (!options.box) return inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside = logical_and(inside, less_equal(coordinates[axis], p.constant(options.box->hi[axis])));
    inside = logical_and(inside, less_equal(p.constant(options.box->lo[axis]), coordinates[axis]));
  }
  return inside;
}

double opacity_of(const design::Material& material, const SceneOptions& options) {
  const auto given = options.opacity.find(material.id);
  if (given != options.opacity.end()) return given->second;
  return options.value || options.numbers ? 1 : material.colour[3] / 255.0;
}

// Returns the sum of something over the materials, weighted by their fractions.
template <class Of>
Field mean(const design::Composition& composition, const Point& p, Of of) {
  Field sum = p.constant(0);
  for (const auto& [id, fraction] : composition.fractions) sum = sum + max(fraction, 0.0) * of(id);
  return sum;
}

// Finds the least and the greatest depth of the box.
void find_depths(render::Scene& scene, const Box& box, const render::Camera& camera) {
  scene.near_mm = Box::inf;
  scene.far_mm = -Box::inf;
  for (int n = 0; n < 8; ++n) {
    const Vec3 corner{n & 1 ? box.hi.x : box.lo.x, n & 2 ? box.hi.y : box.lo.y, n & 4 ? box.hi.z : box.lo.z};
    const double depth = dot(corner - camera.target, camera.forward);
    scene.near_mm = std::min(scene.near_mm, depth);
    scene.far_mm = std::max(scene.far_mm, depth);
  }
  // Places at the eye or behind it are not seen.
  if (!camera.is_orthographic()) scene.near_mm = std::max(scene.near_mm, -0.99 * camera.distance_mm);
}

// A program of all outputs of a Scene.
struct Shown {
  program::Program program;
  bool is_translucent = false;
};

bool is_colour(Question& question, const std::string& name) {
  const design::AttributeDeclaration* declared = question.declaration(name);
  return declared && declared->name == name && declared->type != design::ValueType::number &&
         design::parts_of(*declared).size() >= 3 && declared->type != design::ValueType::mixture;
}

// Returns the colour of an attribute in linear light; the numbers of a vector count as red, green and blue.
std::optional<std::array<Field, 3>> own_colour(Question& question, const std::string& name, Diagnostics& diagnostics) {
  std::array<Field, 3> colour;
  const std::vector<std::string> parts = design::parts_of(*question.declaration(name));
  for (size_t n = 0; n < 3; ++n) {
    const auto number = question.attribute(parts[n], diagnostics);
    if (!number) return std::nullopt;
    const Field srgb = min(max(*number, 0.0), question.builder().constant(1));
    // IEC 61966-2-1.
    const Field light = power((srgb + 0.055) / 1.055, question.builder().constant(2.4));
    colour[n] = select(srgb <= 0.04045, srgb / 12.92, light);
  }
  return colour;
}

// Returns the number of a part (0: none), or the id of the material with the greatest fraction.
std::optional<Field> number_at(Question& question, const design::Composition& composition, Divided by,
                               Diagnostics& diagnostics) {
  if (by == Divided::parts) return question.attribute(part_label, diagnostics);
  const Point& p = question.point();
  Field most = p.constant(-1), number = p.constant(0);
  for (const auto& [id, fraction] : composition.fractions) {
    number = select(less(most, fraction), p.constant(id), number);
    most = max(most, fraction);
  }
  return number;
}

// Returns one of a few colours that are easy to tell apart, in turn.
std::array<Field, 3> label_colour(Field label) {
  const auto few = static_cast<double>(label_colours().size()) - 1;  // the first is that of no label
  const Field place = label - few * (ceil(label * (1 / few)) - 1);
  std::array<Field, 3> colour;
  for (size_t channel = 0; channel < 3; ++channel) {
    const auto light = [&](size_t n) {
      const render::Colour c = render::linear(label_colours()[n]);
      return label.builder->constant(channel == 0 ? c.red : channel == 1 ? c.green : c.blue);
    };
    colour[channel] = light(0);
    for (size_t n = 1; n < label_colours().size(); ++n) {
      const Field is_this =
          logical_and(less(label.builder->constant(0), label),
                      label.builder->apply(program::Op::equal, place, label.builder->constant(static_cast<double>(n))));
      colour[channel] = select(is_this, light(n), colour[channel]);
    }
  }
  return colour;
}

// Returns linear red, green and blue.
std::optional<std::array<Field, 3>> colour_at(Question& question, const design::Composition& composition,
                                              const SceneOptions& options, Diagnostics& diagnostics) {
  if (options.numbers) {
    const auto number = number_at(question, composition, *options.numbers, diagnostics);
    if (!number) return std::nullopt;
    const Field zero = question.builder().constant(0);
    return std::array{*number * (1.0 / most_numbers), zero, zero};
  }
  if (options.value) {
    const std::string& of = options.value->of;
    if (is_colour(question, of)) return own_colour(question, of, diagnostics);
    const auto value = question.value(of, diagnostics);
    if (!value) return std::nullopt;
    const design::AttributeDeclaration* declared = question.declaration(of);
    if (declared && declared->type == design::ValueType::label) return label_colour(*value);
    const Palette* palette = palette_called(options.value->palette);
    return mapped_colour(*value, options.value->range, palette ? *palette : palettes().front());
  }
  const auto channel = [&](float render::Colour::*part) {
    return mean(composition, question.point(), [&](MaterialId id) {
      return static_cast<double>(render::linear(question.design().materials.all()[id].colour).*part);
    });
  };
  return std::array{channel(&render::Colour::red), channel(&render::Colour::green), channel(&render::Colour::blue)};
}

// `further` outputs come after the others.
std::optional<Shown> lower(Question& question, const SceneOptions& options, const program::Outputs& further,
                           Diagnostics& diagnostics) {
  const Point& p = question.point();
  const auto& materials = question.design().materials.all();
  const Field inside = within_cuts(question.inside(), p, options);
  const design::Composition composition = question.composition();

  Shown shown;
  for (const auto& [id, fraction] : composition.fractions)
    if (opacity_of(materials[id], options) < 1) shown.is_translucent = true;
  const Field opacity = mean(composition, p, [&](MaterialId id) { return opacity_of(materials[id], options); });
  const Field opaque = shown.is_translucent ? logical_and(inside, less_equal(p.constant(0.5), opacity)) : inside;
  const auto colour = colour_at(question, composition, options, diagnostics);
  if (!colour) return std::nullopt;
  program::Outputs outputs{{"inside", inside},      {"opaque", opaque},     {"red", (*colour)[0]},
                           {"green", (*colour)[1]}, {"blue", (*colour)[2]}, {"opacity", opacity}};
  outputs.insert(outputs.end(), further.begin(), further.end());
  auto program = question.program(outputs, diagnostics);
  if (!program) return std::nullopt;
  shown.program = std::move(*program);
  return shown;
}

}  // namespace

Box scene_box(const Box& design_box, const SceneOptions& options) {
  Box box = options.box ? intersect(design_box, *options.box) : design_box;
  for (const Cut& cut : options.cuts) {
    if (cut.size() != 1) continue;  // wedges may leave the whole box
    const CutPlane& plane = cut.front();
    if (plane.sign > 0)
      box.hi[plane.axis] = std::min(box.hi[plane.axis], plane.mm);
    else
      box.lo[plane.axis] = std::max(box.lo[plane.axis], plane.mm);
  }
  return box.is_empty() ? Box::empty() : box;
}

std::optional<render::Scene> make_scene(const design::Design& design, const Box& box, const render::Camera& camera,
                                        const SceneOptions& options, Diagnostics& diagnostics) {
  // In a perspective view the inputs are a depth and a place on the picture plane, not the view's point.
  std::optional<Point> view;
  const Frame frame = [&](program::Builder& builder) {
    view = camera.is_orthographic() ? Point::origin_frame(builder) : in_perspective(builder, camera);
    return view->mapped(camera.design_from_view());
  };
  Question question(design, {.threads = options.threads, .frame = frame, .memory = options.memory});
  program::Outputs base;
  if (!camera.is_orthographic()) base = {{"depth", view->x}, {"right", view->y}, {"down", view->z}};
  auto shown = lower(question, options, base, diagnostics);
  if (!shown) return std::nullopt;
  render::Scene scene;
  scene.eye_mm = camera.distance_mm;
  scene.program = std::move(shown->program);
  scene.is_translucent = shown->is_translucent;
  find_depths(scene, box, camera);
  scene.clarity_mm = length(box.size()) / 4;
  return scene;
}

std::shared_ptr<const render::Section> make_section(const design::Design& design, const render::Camera& camera,
                                                    const render::Film& film, const SceneOptions& options,
                                                    Diagnostics& diagnostics) {
  const Frame frame = [&](program::Builder& builder) {
    return Point::origin_frame(builder).mapped(render::Section::design_from_film(camera, film));
  };
  Question question(design, {.threads = options.threads, .frame = frame, .memory = options.memory});
  auto shown = lower(question, options, {}, diagnostics);
  if (!shown) return nullptr;
  program::Program& program = shown->program;
  using render::Scene;
  program.outputs = {program.outputs[Scene::inside], program.outputs[Scene::red], program.outputs[Scene::green],
                     program.outputs[Scene::blue]};
  program.output_names = {"inside", "red", "green", "blue"};
  return std::make_shared<render::Section>(std::move(program), film);
}

std::optional<std::vector<MaterialId>> materials_within(const design::Design& design, const Box& box, int threads,
                                                        Diagnostics& diagnostics, design::SubDesignMemory* memory) {
  // Remarks of nodes come from the picture's own program, which is as fine as its pixels.
  Diagnostics own;
  auto built = build_flat_program(design, own, threads, memory);
  if (!built) {
    diagnostics.add_new(own);
    return std::nullopt;
  }
  leave_out_impossible(*built, box, threads);
  return built->materials.materials;
}

}  // namespace ombre::compile
