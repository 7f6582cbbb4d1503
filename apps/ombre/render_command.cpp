// ombre render: pictures of a design.
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/text.h"
#include "compile/colour_map.h"
#include "compile/picture.h"
#include "export/output_file.h"
#include "formats/png.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/job_arguments.h"
#include "ombre/overwrite.h"
#include "ombre/progress_line.h"
#include "ombre/result_files.h"

namespace ombre::cli {
namespace {

struct RenderArguments {
  DesignArguments design;
  std::string output, size = "800x600", view = "iso", from, slice, box, background = "white", font, by, range, palette,
                      outlines, names;
  std::vector<std::string> cuts, opacity;
  double perspective = 0, zoom = 1, deform = 0;
  int samples = 2, frames = 1, threads = 0;
  bool axes = false, scale_bar = false, legend = false, annotate = false, force = false;
};

constexpr const char* render_footer =
    "Lengths are millimetres, angles degrees.\n\n"
    "Examples:\n"
    "  ombre render part.vcad -o part.png\n"
    "  ombre render part.vcad --cut x=0 --view right        cut open, seen from the right\n"
    "  ombre render part.vcad --cut \"x>0,y<0\"              a quarter taken out\n"
    "  ombre render part.vcad --opacity clear=0.1           what the clear material hides\n"
    "  ombre render part.vcad --slice z=3.2 --annotate      the materials in a plane, with scale bar and legend\n"
    "  ombre render part.vcad --by density --cut y=0 --legend    an attribute, cut open\n"
    "  ombre render part.vtu --by von_mises --deform 5 --legend  results of ombre fea, displacements five times as "
    "large\n"
    "  ombre render part.vcad --frames 36 -o turn.png       turn_00.png to turn_35.png, all around the part\n";

constexpr int64_t most_pixels = 16384;

void add_arguments(CLI::App& app, RenderArguments& a) {
  add_design_arguments(app, a.design);
  app.add_option("-o,--output", a.output, "The picture to write, - for stdout (default: the design's name with .png)")
      ->type_name("FILE");
  app.add_option("--size", a.size, "Of the picture in pixels (default 800x600)")->type_name("WxH");
  CLI::Option* view =
      app.add_option("--view", a.view, "From where: iso (default), front, back, left, right, top or bottom")
          ->check(one_of(render::view_names()))
          ->type_name("NAME");
  CLI::Option* from =
      app.add_option("--from", a.from, "From where, as angles: azimuth (0 in front, 90 from the right), elevation")
          ->excludes(view)
          ->type_name("AZ,EL");
  CLI::Option* perspective =
      app.add_option("--perspective", a.perspective, "Vertical field of view; degrees (default 0: parallel rays)")
          ->check(between(0.0, 120.0))
          ->type_name("DEG");
  app.add_option("--zoom", a.zoom, "Enlarge the middle of the picture")->check(between(0.01, 1000.0))->type_name("X");
  app.add_option("--cut", a.cuts,
                 "Cut along a plane: x=0 takes away the side of the eye, x>0 or x<0 that side; x>0,y<0 takes a wedge "
                 "out; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PLANE");
  app.add_option("--box", a.box, "Show only what is within this box; mm")->type_name("X0,Y0,Z0,X1,Y1,Z1");
  CLI::Option* opacity =
      app.add_option("--opacity", a.opacity, "Of a material, 0 (clear) to 1, in place of its own; may be repeated")
          ->allow_extra_args(false)
          ->type_name("MATERIAL=N");
  CLI::Option* by = app.add_option("--by,--colour-by,--color-by", a.by,
                                   "Colour by a material's fraction or an attribute, from dark blue (least) to yellow, "
                                   "or\nby parts, each in a colour of its own")
                        ->type_name("NAME|parts");
  app.add_option("--range", a.range, "The values from the first colour to the last (default: those of the design)")
      ->needs(by)
      ->type_name("LO,HI");
  app.add_option("--palette", a.palette,
                 "From the least value to the greatest: " + join(compile::palette_names(), ", "))
      ->needs(by)
      ->check(one_of(compile::palette_names()))
      ->type_name("NAME");
  app.add_option("--deform", a.deform,
                 "Of results (.vtu, .xdmf, .frd): how many times the displacement moves the part (default 0)")
      ->type_name("X");
  app.add_option("--background", a.background, "white (default), black, gray, transparent or #rrggbb")
      ->type_name("COLOUR");
  app.add_option("--aa", a.samples, "Rays along the edge of a pixel, which smooth edges (default 2)")
      ->check(whole_between(1, 8))
      ->type_name("N");
  CLI::Option* frames = app.add_option("--frames", a.frames, "Pictures all around the part, numbered (default 1)")
                            ->check(whole_between(1, 3600))
                            ->type_name("N");
  add_threads(app, a.threads);
  app.add_option("--slice", a.slice, "The plane x, y or z = mm in place of a view: flat, in the materials' colours")
      ->excludes(view, from, perspective, opacity, frames)
      ->type_name("PLANE");
  app.add_flag("--axes", a.axes, "Draw the directions x, y and z in the corner");
  app.add_flag("--scale-bar", a.scale_bar, "Draw a length in mm; in perspective it holds at the part's middle");
  app.add_flag("--legend", a.legend, "List the materials and their colours");
  app.add_flag("--annotate", a.annotate, "Axes, scale bar and legend");
  app.add_option("--outlines", a.outlines, "Draw the borders between parts or materials, as they are seen")
      ->check(one_of({"parts", "materials"}))
      ->type_name("parts|materials");
  app.add_option("--names", a.names, "Write the names of parts or materials upon them")
      ->check(one_of({"parts", "materials"}))
      ->type_name("parts|materials");
  app.add_option("--font", a.font, "Of what is written (default: DejaVu Sans, or another of the system's)")
      ->type_name("FILE");
  app.add_flag("--force", a.force, "Replace pictures that are there");
}

std::optional<compile::Divided> divided_by(const std::string& word) {
  if (word.empty()) return std::nullopt;
  return word == "parts" ? compile::Divided::parts : compile::Divided::materials;
}

void set_size(const std::string& text, compile::PictureRequest& request) {
  const auto x = text.find('x');
  const auto width = x == std::string::npos ? std::nullopt : parse_number(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number(text.substr(x + 1));
  const auto is_right = [](std::optional<double> v) {
    return v && *v >= 1 && *v <= most_pixels && *v == std::floor(*v);
  };
  if (!is_right(width) || !is_right(height))
    throw WrongArgument("--size " + text + " is not a size in pixels; write for example --size 800x600 (at most " +
                        std::to_string(most_pixels) + " each way)");
  request.width = static_cast<int64_t>(*width);
  request.height = static_cast<int64_t>(*height);
}

void set_view(const RenderArguments& a, compile::PictureRequest& request) {
  request.view = render::named_view(a.view).value();
  if (!a.from.empty()) {
    const std::vector<double> angles = parse_numbers(a.from);
    if (angles.size() != 2 || std::abs(angles[1]) > 90)
      throw WrongArgument("--from " + a.from +
                          " is not azimuth,elevation; write for example --from 30,20 (elevation from -90 to 90)");
    request.view.azimuth_deg = angles[0];
    request.view.elevation_deg = angles[1];
  }
  request.view.field_of_view_deg = a.perspective;
  request.view.zoom = a.zoom;
}

uint8_t hex_byte(std::string_view digits) {
  unsigned value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (status != std::errc() || end != digits.data() + digits.size()) throw std::invalid_argument("not hexadecimal");
  return static_cast<uint8_t>(value);
}

void set_background(const std::string& text, compile::PictureRequest& request) {
  const auto plain = [&](render::Rgba8 colour) { request.background.colour = colour; };
  if (text == "white") return plain({255, 255, 255, 255});
  if (text == "black") return plain({0, 0, 0, 255});
  if (text == "gray") return plain({128, 128, 128, 255});
  if (text == "transparent") {
    request.background.is_transparent = true;
    return;
  }
  try {
    if (text.size() != 7 || text[0] != '#') throw std::invalid_argument("not a colour");
    const std::string_view digits = std::string_view(text).substr(1);
    plain({hex_byte(digits.substr(0, 2)), hex_byte(digits.substr(2, 2)), hex_byte(digits.substr(4, 2)), 255});
  } catch (const std::invalid_argument&) {
    throw WrongArgument("--background " + text +
                        " is not a colour; write white, black, gray, transparent or for example #20304a");
  }
}

compile::PictureRequest picture_request(const RenderArguments& a) {
  compile::PictureRequest request;
  set_size(a.size, request);
  set_view(a, request);
  if (!a.box.empty()) request.box = parse_box(a.box);
  set_background(a.background, request);
  for (const std::string& text : a.cuts) {
    const auto cut = compile::parse_cut(text);
    if (!cut)
      throw WrongArgument("--cut " + text + " is not a plane; write for example --cut x=0 or --cut \"z>3.5\" (mm)");
    request.cuts.push_back(*cut);
  }
  if (!a.slice.empty()) {
    request.slice = compile::parse_slice(a.slice);
    if (!request.slice)
      throw WrongArgument("--slice " + a.slice + " is not a plane; write for example --slice z=3.2 (mm)");
  }
  for (const std::string& text : a.opacity) {
    const auto sign = text.rfind('=');
    const auto value = sign == std::string::npos ? std::nullopt : parse_number(text.substr(sign + 1));
    if (!value || !(*value >= 0 && *value <= 1))
      throw WrongArgument("--opacity " + text + " is not a material and a number from 0 to 1; write for example " +
                          "--opacity clear=0.2");
    request.opacity.emplace_back(text.substr(0, sign), *value);
  }
  request.by = a.by;
  request.palette = a.palette;
  if (!a.range.empty()) request.range = parse_range(a.range);
  request.annotations = {a.axes || a.annotate, a.scale_bar || a.annotate, a.legend || a.annotate, a.font};
  request.marks = {divided_by(a.outlines), divided_by(a.names)};
  request.samples = a.samples;
  request.frames = a.frames;
  request.threads = a.threads;
  return request;
}

// turn.png gives turn_00.png and so on where there are several frames.
std::vector<std::string> output_files(const RenderArguments& a) {
  namespace fs = std::filesystem;
  const fs::path path(a.output.empty() ? fs::path(a.design.design).stem().string() + ".png" : a.output);
  if (const std::string ending = to_lower(path.extension().string());
      !ending.empty() && ending != ".png" && a.output != "-")
    throw WrongArgument("-o " + a.output + ": pictures are PNG files; write for example -o " +
                        fs::path(path).replace_extension(".png").string());
  if (a.frames == 1) return {path.string()};
  std::vector<std::string> files;
  const size_t digits = std::to_string(a.frames - 1).size();
  for (int frame = 0; frame < a.frames; ++frame) {
    std::string number = std::to_string(frame);
    number.insert(0, digits - number.size(), '0');
    files.push_back((path.parent_path() / (path.stem().string() + "_" + number + path.extension().string())).string());
  }
  return files;
}

// A design, or the mesh of results as one.
compile::LoadedPtr load_pictured(const RenderArguments& a, Session& session, Diagnostics& diagnostics) {
  if (is_results(a.design.design)) {
    compile::LoadOptions options{a.design.materials, a.design.definitions};
    options.stop = &session.stop;
    options.threads = a.threads;
    options.cache = &session.cache;
    const std::filesystem::path path = std::filesystem::path(a.design.design).replace_extension(".vcad");
    return compile::load_text(results_as_script(a.design.design, a.by, a.deform), path.string(), options, diagnostics);
  }
  if (a.deform != 0) throw WrongArgument("--deform is for results; write for example ombre render part.vtu --deform 5");
  return load_design(a.design, session, diagnostics, a.threads);
}

int render_design(const RenderArguments& a, Session& session) {
  const compile::PictureRequest request = picture_request(a);
  const bool to_stdout = a.output == "-";
  if (to_stdout && session.console.voice() == Voice::programs)
    throw WrongArgument("-o - writes the picture to stdout, where --json writes events; give -o a file name");
  if (to_stdout && a.frames > 1) throw WrongArgument("stdout holds one picture; give -o a file name");
  const std::vector<std::string> files = output_files(a);
  if (!to_stdout)
    for (const std::string& file : files) refuse_to_overwrite(file, a.force);

  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = load_pictured(a, session, diagnostics);
  ProgressLine progress(session.console, Counted::steps);
  const auto take = [&](int frame, const compile::Picture& picture) {
    const std::string bytes =
        formats::encode_png(static_cast<uint32_t>(request.width), static_cast<uint32_t>(request.height), picture.rgba);
    if (to_stdout) return session.console.print(bytes);
    const std::string& file = files[static_cast<size_t>(frame)];
    exporting::write_file(file, bytes);
    progress.finish();
    session.console.say("written to " + file + ", " + format_rounded(picture.pixel_mm, 3) + " mm a pixel");
    session.console.event("picture", {{"file", file}, {"pixel_mm", picture.pixel_mm}});
  };
  const bool is_done = loaded && compile::take_pictures(*loaded, request, session.stop, take, diagnostics, &progress);
  progress.finish();
  session.console.diagnose(diagnostics);
  return is_done && !diagnostics.has_errors() ? done : wrong_input;
}

}  // namespace

Command add_render(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("render", "Make pictures of a design");
  auto arguments = std::make_shared<RenderArguments>();
  add_arguments(*app, *arguments);
  add_output_options(*app, output);
  app->footer(render_footer);
  return {app, [arguments](Session& session) { return render_design(*arguments, session); }};
}

}  // namespace ombre::cli
