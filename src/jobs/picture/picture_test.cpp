// Tests pictures: surfaces that rays meet, against geometry.
#include "jobs/picture/picture.h"

#include <cmath>
#include <functional>

#include "base/system/test_source_files.h"
#include "jobs/test_pictures.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "questions/build.h"
#include "questions/colour_map.h"

namespace ombre::compile {
namespace {

struct Shot {
  render::Film film;
  render::Camera camera;
  render::RayBand band;
  const render::RayHit& at(int64_t column, int64_t row) const { return band.at(column, row); }
};

Shot shoot(const std::string& text, render::ViewOptions view, SceneOptions options = {}, int threads = 1,
           int64_t edge = 200) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  const Box box = scene_box(*design_box(loaded->design, diagnostics), options);
  Shot shot;
  shot.camera = render::camera_around(box, view, 1);
  shot.film = {edge, edge, shot.camera.height_mm / static_cast<double>(edge)};
  const auto scene = make_scene(loaded->design, box, shot.camera, options, diagnostics);
  EXPECT_TRUE(scene) << to_text(diagnostics);
  shot.band = render::cast_rays(*scene, shot.film, 0, edge, threads, [] { return false; });
  return shot;
}

render::ViewOptions view(const char* name) { return *render::named_view(name); }

constexpr float none = render::RayHit::none;

}  // namespace

TEST(Pictures, RaysMeetASphereWhereItIs) {
  for (const char* name : {"iso", "front", "top"}) {
    const Shot shot = shoot("sphere(10, \"red\");", view(name));
    for (int64_t row = 0; row < shot.film.height; ++row) {
      for (int64_t column = 0; column < shot.film.width; ++column) {
        const double y = shot.film.right_of(column), z = shot.film.down_of(row), square = 100 - y * y - z * z;
        const float depth = shot.at(column, row).surface;
        if (square < -1e-3) {
          EXPECT_EQ(depth, none) << name << column << " " << row;
        }
        if (square < 1) continue;
        // The limit is two of the finest steps, of which a pixel has 1024.
        EXPECT_NEAR(depth, -std::sqrt(square), shot.film.pixel_mm / 500) << name << column << " " << row;
        EXPECT_EQ(shot.at(column, row).end, depth);
      }
    }
  }
}

TEST(Pictures, PerspectiveSeesTheConeAroundASphere) {
  render::ViewOptions options = view("iso");
  options.field_of_view_deg = 40;
  const Shot shot = shoot("sphere(10);", options);
  const double away = shot.camera.distance_mm;
  // The outline of a sphere lies on the cone of tangents.
  const double outline = away * std::tan(std::asin(10 / away));
  size_t seen = 0;
  for (const render::RayHit& ray : shot.band.all()) seen += ray.surface != none;
  const double area = static_cast<double>(seen) * shot.film.pixel_mm * shot.film.pixel_mm;
  EXPECT_NEAR(area / (3.14159265358979 * outline * outline), 1, 0.005);
  const float nearest = shot.at(100, 100).surface;
  EXPECT_NEAR(nearest, -10, 0.02);
}

TEST(Pictures, MeshesAndCallsAndManyPartsAreSeenToo) {
  const std::string mesh = "mesh(\"" + source_file("examples/models/gear.stl") + "\");";
  const Shot gear = shoot(mesh, view("top"));
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(mesh, diagnostics);
  const Box box = *design_box(loaded->design, diagnostics);
  float top = none;
  for (const render::RayHit& ray : gear.band.all()) top = std::min(top, ray.surface);
  EXPECT_NEAR(top, -box.size().z / 2, gear.film.pixel_mm / 100);

  std::string balls = "union() {";
  for (int n = 0; n < 40; ++n)
    balls += "translate(" + std::to_string(3 * (n % 8)) + ", " + std::to_string(3 * (n / 8)) + ", 0) sphere(1);";
  const Shot many = shoot(balls + "}", view("top"), {}, 1, 400);
  size_t seen = 0;
  for (const render::RayHit& ray : many.band.all()) seen += ray.surface != none;
  EXPECT_NEAR(static_cast<double>(seen) * many.film.pixel_mm * many.film.pixel_mm, 40 * 3.14159265, 1.5);
}

// Perspective vanishes from far away.
TEST(Pictures, MeshesFromAFarEyeAreThoseOfParallelRays) {
  const std::string mesh = "rotate(10, 20, 30) mesh(\"" + source_file("examples/models/gear.stl") + "\");";
  render::ViewOptions far = view("iso");
  far.field_of_view_deg = 0.001;
  const Shot perspective = shoot(mesh, far), parallel = shoot(mesh, view("iso"));
  EXPECT_NEAR(perspective.film.pixel_mm / parallel.film.pixel_mm, 1, 1e-4);
  size_t seen = 0, other = 0;
  for (size_t n = 0; n < parallel.band.all().size(); ++n) {
    const float a = parallel.band.all()[n].surface, b = perspective.band.all()[n].surface;
    seen += a != none;
    other += (a == none) != (b == none) || (a != none && std::abs(a - b) > parallel.film.pixel_mm / 10);
  }
  EXPECT_GT(seen, 4000U);
  EXPECT_LT(other, seen / 200);
}

// The mesh reaches beside the eye, outside of the picture.
TEST(Pictures, TheEyeMayStandWithinAMesh) {
  const std::string gear = "mesh(\"" + source_file("examples/models/gear.stl") + "\");";
  SceneOptions options;
  options.box = Box{{7, -1, -1}, {9, 1, 1}};  // within the gear's body, as is its eye
  render::ViewOptions close = view("right");
  close.field_of_view_deg = 100;
  const Shot shot = shoot(gear, close, options);
  // The face of the box towards the eye, at x = 9, is 1 mm before its middle.
  EXPECT_NEAR(shot.at(100, 100).surface, -1, shot.film.pixel_mm / 100);
  EXPECT_NEAR(shot.at(40, 100).surface, -1, shot.film.pixel_mm / 100);
}

TEST(Pictures, CutsShowTheInside) {
  SceneOptions options;
  options.cuts = {{{1, 0, -1}}};  // removes y < 0
  const Shot shot =
      shoot("union(materials=\"last\") { sphere(10, \"red\"); sphere(5, \"blue\"); }", view("front"), options);
  // The camera aims at the middle of the rest, y = 5.
  EXPECT_NEAR(shot.at(100, 100).surface, -5, shot.film.pixel_mm / 100);
  EXPECT_GT(shot.at(100, 100).at_end.blue, 2 * shot.at(100, 100).at_end.red);
  EXPECT_GT(shot.at(30, 100).at_end.red, 2 * shot.at(30, 100).at_end.blue);
}

TEST(Pictures, WedgesTakeAQuarterOut) {
  SceneOptions options;
  options.cuts = {{{1, 0, -1}, {0, 0, 1}}};  // removes y < 0 where x > 0
  const Shot shot = shoot("sphere(10, \"red\");", view("front"), options);
  for (const int64_t column : {130, 150, 170})
    EXPECT_NEAR(shot.at(column, 100).surface, 0, shot.film.pixel_mm / 100) << column;
  for (const int64_t column : {30, 50, 70}) {
    const double x = shot.film.right_of(column), z = shot.film.down_of(100);
    EXPECT_NEAR(shot.at(column, 100).surface, -std::sqrt(100 - x * x - z * z), shot.film.pixel_mm / 100) << column;
  }
}

TEST(Pictures, LightFadesInTranslucentMaterial) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("cube(10, \"clear\");", diagnostics);
  SceneOptions options;
  options.opacity[loaded->design.materials.find("clear")->id] = 0.3;
  const Shot shot = shoot("cube(10, \"clear\");", view("front"), options);
  const double clarity = std::sqrt(300.0) / 4;
  for (const int64_t column : {20, 100, 170}) {
    const render::RayHit& ray = shot.at(column, 100);
    EXPECT_NEAR(ray.surface, -5, shot.film.pixel_mm / 100);
    EXPECT_EQ(ray.end, none);
    EXPECT_NEAR(ray.passes, std::pow(0.7, 10 / clarity), 0.01);
  }
  // Opaque parts are seen through translucent ones.
  const Shot filled =
      shoot("union(materials=\"last\") { cube(10, \"clear\"); sphere(3, \"red\"); }", view("front"), options);
  EXPECT_NEAR(filled.at(100, 100).end, -3, filled.film.pixel_mm / 100);
  EXPECT_NEAR(filled.at(100, 100).passes, std::pow(0.7, 2 / clarity), 0.01);
}

TEST(Pictures, DoNotDependOnBands) {
  Diagnostics diagnostics;
  const LoadedPtr loaded =
      load_text("union() { sphere(8, \"red\"); translate(5, 0, 0) cube(9, \"clear\"); }", diagnostics);
  const Box box = *design_box(loaded->design, diagnostics);
  const render::Camera camera = render::camera_around(box, view("iso"), 1);
  const render::Film film{100, 100, camera.height_mm / 100};
  const auto scene = make_scene(loaded->design, box, camera, {}, diagnostics);
  const render::RayBand whole = render::cast_rays(*scene, film, 0, 100, 1, [] { return false; });
  for (const int64_t begin : {0, 13, 77}) {
    const render::RayBand part = render::cast_rays(*scene, film, begin, begin + 20, 1, [] { return false; });
    for (int64_t row = begin; row < begin + 20; ++row) {
      for (int64_t column = 0; column < film.width; ++column) {
        ASSERT_EQ(whole.at(column, row).surface, part.at(column, row).surface);
        ASSERT_EQ(whole.at(column, row).end, part.at(column, row).end);
        ASSERT_NEAR(whole.at(column, row).passes, part.at(column, row).passes, 0.02);
      }
    }
  }
}

TEST(Pictures, DoNotDependOnThreads) {
  const std::string text =
      "fgrade([\"0.5 + x/40\", \"0.5 - x/40\"], [\"red\", \"clear\"]) rotate(20, 30, 40) cube(20);";
  const Shot one = shoot(text, view("iso"), {}, 1), two = shoot(text, view("iso"), {}, 2);
  for (size_t n = 0; n < one.band.all().size(); ++n) {
    ASSERT_EQ(one.band.all()[n].end, two.band.all()[n].end);
    ASSERT_EQ(one.band.all()[n].passes, two.band.all()[n].passes);
    ASSERT_EQ(one.band.all()[n].veil.red, two.band.all()[n].veil.red);
  }
}

class EveryPicture : public testing::TestWithParam<std::tuple<std::string, double>> {};

// The reference finds the same material where a ray ends, except for rays that meet an edge.
TEST_P(EveryPicture, ShowsWhatTheReferenceFinds) {
  use_source_data();
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_design(source_file("examples/") + std::get<0>(GetParam()) + ".vcad", {}, diagnostics);
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  const Box box = *design_box(loaded->design, diagnostics);
  render::ViewOptions options = view("iso");
  options.field_of_view_deg = std::get<1>(GetParam());
  const render::Camera camera = render::camera_around(box, options, 1);
  const render::Film film{160, 160, camera.height_mm / 160};
  const auto scene = make_scene(loaded->design, box, camera, {}, diagnostics);
  const render::RayBand band = render::cast_rays(*scene, film, 0, film.height, 2, [] { return false; });
  const program::Program program =
      program::expand_parts(scene->program, std::vector<Interval>(scene->program.code.size(), Interval(-1e4, 1e4)),
                            program::Precision::reference);
  size_t seen = 0, wrong = 0;
  std::vector<double> values;
  for (int64_t n = 0; n < film.width * film.height; ++n) {
    const render::RayHit& ray = band.all()[static_cast<size_t>(n)];
    if (ray.end == none || ray.passes < 1) continue;
    ++seen;
    const auto value = [&](render::Scene::Output output) { return values[program.outputs[output]]; };
    // Colours are those a little behind the surface, if there is a solid.
    for (const double behind : {film.pixel_mm / 8, film.pixel_mm / 500}) {
      const Vec3 p{static_cast<double>(ray.end) + behind, film.right_of(n % film.width), film.down_of(n / film.width)};
      evaluate_point(program, p, values);
      if (value(render::Scene::opaque) == 1) break;
    }
    const bool same = value(render::Scene::opaque) == 1 &&
                      std::abs(value(render::Scene::red) - static_cast<double>(ray.at_end.red)) < 0.01 &&
                      std::abs(value(render::Scene::green) - static_cast<double>(ray.at_end.green)) < 0.01 &&
                      std::abs(value(render::Scene::blue) - static_cast<double>(ray.at_end.blue)) < 0.01;
    wrong += !same;
  }
  EXPECT_GT(seen, 500U);
  EXPECT_LT(wrong, seen / 100) << "of " << seen;
}

INSTANTIATE_TEST_SUITE_P(
    Examples, EveryPicture,
    testing::Combine(testing::Values("calibration_sheet", "cone_and_sphere", "gear", "graded_cube", "graded_wing",
                                     "knob", "mug", "overlap", "parametric_hook", "soft_actuator", "tensile_bar_prob",
                                     "tensile_bar_thresh", "tetrahedron"),
                     testing::Values(0.0, 50.0)),
    [](const auto& test) { return std::get<0>(test.param) + (std::get<1>(test.param) > 0 ? "_in_perspective" : ""); });

TEST(Pictures, PlanesAreReadAsPeopleWriteThem) {
  EXPECT_EQ(parse_cut("x=0")->front().axis, 0);
  EXPECT_EQ(parse_cut("z > 3.5")->front().removed, '>');
  EXPECT_EQ(parse_cut("z > 3.5")->front().mm, 3.5);
  EXPECT_EQ(parse_cut("x>0, y < -2")->at(1).mm, -2);
  for (const char* wrong : {"", "x", "w=1", "x=", "x=a", "xy=1", "=1", "x=nan", "x=1,", "x>1,x<2"})
    EXPECT_FALSE(parse_cut(wrong)) << wrong;
}

TEST(Pictures, WhatIsWrongIsSaid) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("sphere(10, \"red\");", diagnostics);
  PictureRequest request;
  request.width = request.height = 20;
  StopFlag stop;
  const auto ignore = [](int, const Picture&) {};
  request.opacity = {{"glass", 0.5}};
  EXPECT_FALSE(take_pictures(*loaded, request, stop, ignore, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("there is no material \"glass\""), std::string::npos);
  request.opacity.clear();
  request.slice = {{2, 10.5}};
  EXPECT_FALSE(take_pictures(*loaded, request, stop, ignore, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("the slice does not meet the design"), std::string::npos);
  request.slice.reset();
  request.cuts = {{{0, '>', -11}}};
  EXPECT_FALSE(take_pictures(*loaded, request, stop, ignore, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("nothing of the design is left by the cuts"), std::string::npos);
}

// The view is flat, so colours are those of the map.
TEST(Pictures, ColoursFollowAValue) {
  const auto coloured = [](const std::string& text, const std::string& by, std::optional<Interval> range) {
    PictureRequest request;
    request.width = request.height = 40;
    request.slice = {{2, 0}};
    request.by = by;
    request.range = range;
    return picture_of(text, request);
  };
  const auto expect_map = [](const Picture& picture, const std::function<double(double x)>& share, int tolerance) {
    for (int64_t column = 4; column < 36; ++column) {
      const double x = (static_cast<double>(column) - 19.5) * picture.pixel_mm;
      const design::Rgba expected = map_colour(share(x));
      for (size_t n = 0; n < 3; ++n)
        EXPECT_NEAR(picture.rgba[static_cast<size_t>((20 * 40 + column) * 4) + n], expected[n], tolerance) << column;
    }
  };
  const std::string block = "cube(10, \"clear\");";
  const std::string dosed = "attribute(\"dose\", \"3 + 0.2*x\") { " + block + " }";  // 2 to 4
  // The range is that of about 48 samples along the part, which begin half a step inside.
  expect_map(
      coloured(dosed, "dose", std::nullopt), [](double x) { return (x + 5) / 10; }, 8);
  expect_map(
      coloured(dosed, "dose", Interval(0, 3)), [](double x) { return (3 + 0.2 * x) / 3; }, 2);
  const std::string graded = "fgrade([\"0.5 + x/20\", \"0.5 - x/20\"], [\"red\", \"blue\"]) { " + block + " }";
  expect_map(
      coloured(graded, "blue", std::nullopt), [](double x) { return 0.5 - x / 20; }, 2);
}

TEST(Pictures, ValuesThatAreNotThereAreAnError) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("attribute(\"dose\", 1) { sphere(10, \"red\"); }", diagnostics);
  PictureRequest request;
  request.width = request.height = 20;
  request.by = "doze";
  StopFlag stop;
  EXPECT_FALSE(take_pictures(
      *loaded, request, stop, [](int, const Picture&) {}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("neither a material nor an attribute \"doze\"; did you mean \"dose\"?"),
            std::string::npos);
}

TEST(ColourMap, GoesFromDarkBlueToYellow) {
  EXPECT_EQ(map_colour(0), (design::Rgba{68, 1, 84, 255}));
  EXPECT_EQ(map_colour(0.5), (design::Rgba{33, 144, 141, 255}));
  EXPECT_EQ(map_colour(1), (design::Rgba{253, 231, 37, 255}));
  EXPECT_EQ(map_colour(7), map_colour(1));
  EXPECT_EQ(map_colour(-7), map_colour(0));
}

}  // namespace ombre::compile
