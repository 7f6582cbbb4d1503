// What decides the pixels of a job: the arguments that slicing and its previews share.
#include "ombre/job_arguments.h"

#include <charconv>

#include "compile/find_printer.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/interrupt.h"

namespace ombre::cli {
namespace {

uint64_t parse_seed(const std::string& text) {
  uint64_t seed = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (status == std::errc() && end == text.data() + text.size()) return seed;
  throw WrongArgument("--seed " + text + " is not a whole number from 0 to 18446744073709551615");
}

}  // namespace

void add_design_arguments(CLI::App& app, DesignArguments& a) {
  app.add_option("design", a.design, "The design: a .vcad, .json or .py file")->required()->type_name("FILE");
  app.add_option("--materials", a.materials, "Materials file (see: ombre materials)")->type_name("FILE");
  app.add_option("-D,--define", a.definitions, "Set a variable of the design; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

void add_voxel_arguments(CLI::App& app, JobArguments& a) {
  add_design_arguments(app, a);
  app.add_option("--printer", a.printer, "Printer profile: a name, or the path of a .json file")->type_name("NAME");
  CLI::Option* voxel = app.add_option("--voxel", a.voxel, "Voxel size: one length, or x,y,z; mm")->type_name("X,Y,Z");
  app.add_option("--dpi", a.dpi, "Resolution in dots per inch: x and y alike, x,y or x,y,z")
      ->type_name("X,Y")
      ->excludes(voxel);
  app.add_option("--layer-height", a.layer_height, "Voxel size along z; mm")->type_name("MM");
  app.add_option("--dither", a.dither,
                 "How a mixture becomes one material a voxel: stochastic (default), blue-noise, diffusion or threshold")
      ->check(one_of(voxel::dither_names()))
      ->type_name("MODE");
  app.add_option("--evaluator", a.evaluator,
                 "Who computes values: batch (default, floats, fast) or reference (double precision, slow)")
      ->check(one_of({"batch", "reference"}))
      ->type_name("NAME");
  app.add_option("--seed", a.seed, "Seed of the dithering (default 0); equal seeds give equal files")->type_name("N");
  CLI::Option* place =
      app.add_option("--place", a.place,
                     "Layers cover the design's own box, or the build plate with the part in its middle")
          ->check(one_of({"design", "center"}))
          ->type_name("design|center");
  app.add_flag("--tray", a.tray, "Layers cover the printer's whole build box, the design where it stands")
      ->excludes(place);
}

void add_job_arguments(CLI::App& app, JobArguments& a) {
  add_voxel_arguments(app, a);
  app.add_option("--format", a.image, "Image format: rgba, indexed, gray or mask (default: the printer's)")
      ->check(one_of(voxel::image_format_names()))
      ->type_name("FORMAT");
  CLI::Option* by = app.add_option("--by,--gray,--grey", a.by,
                                   "Images in shades of gray by an attribute or a material's fraction, black outside, "
                                   "in place of\nmaterials")
                        ->type_name("NAME");
  app.add_option("--range", a.range, "The values that are black and white (default: those of the design)")
      ->needs(by)
      ->type_name("LO,HI");
  app.add_option("--bits", a.bits, "Of a gray pixel: 8 (default, 256 shades) or 16 (65,536)")
      ->needs(by)
      ->check(one_of({"8", "16"}))
      ->type_name("8|16");
}

Interval parse_range(const std::string& text) {
  const std::vector<double> ends = parse_numbers(text);
  if (ends.size() == 2 && ends[0] < ends[1]) return {ends[0], ends[1]};
  throw WrongArgument("--range " + text + " is not two numbers, the lesser first; write for example --range 0,1");
}

std::optional<compile::PlanOptions> plan_options(const JobArguments& a, Diagnostics& diagnostics) {
  const auto printer = compile::find_printer(a.printer.empty() ? "generic" : a.printer, diagnostics);
  if (!printer) return std::nullopt;
  compile::PlanOptions options;
  options.program = "ombre " OMBRE_VERSION;
  options.printer = *printer;
  options.printer_given = !a.printer.empty();
  if (!a.voxel.empty()) options.pitch = parse_voxel(a.voxel);
  if (!a.dpi.empty()) options.pitch = parse_dpi(a.dpi);
  if (!a.layer_height.empty()) options.pitch[2] = parse_layer_height(a.layer_height);
  options.dither = voxel::dither(a.dither).value();
  if (a.evaluator == "reference") options.evaluator.evaluator = voxel::Evaluator::reference;
  options.seed = parse_seed(a.seed);
  options.image = voxel::image_format(a.image);
  if (!a.place.empty()) options.place = a.place == "center" ? voxel::Placement::center : voxel::Placement::design;
  options.whole_tray = a.tray;
  if (a.by.empty()) return options;
  if (!a.image.empty() && a.image != "gray")
    throw WrongArgument("--format " + a.image + " holds materials; --by makes gray images: leave --format out");
  options.value = compile::ValueChoice{a.by, std::nullopt, a.bits == "16" ? 16 : 8};
  if (!a.range.empty()) options.value->range = parse_range(a.range);
  return options;
}

compile::LoadedPtr load_design(const DesignArguments& a, Session& session, Diagnostics& diagnostics, int threads) {
  compile::LoadOptions options{a.materials, a.definitions, a.needed};
  options.echo = [&](const std::string& text) { session.console.say(text); };
  options.stop = &session.stop;
  options.threads = threads;
  options.cache = &session.cache;
  const QuitAtOnce quits;
  return session.load(a.design, options, diagnostics);
}

}  // namespace ombre::cli
