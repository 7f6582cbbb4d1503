// `ombre mesh` writes a design as closed surfaces for slicers and other programs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "export/mesh_file.h"
#include "formats/packages/package_writers.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/common/settings_key.h"
#include "jobs/mesh/beam_document.h"
#include "jobs/mesh/exact_bodies.h"
#include "jobs/mesh/height_bands.h"
#include "jobs/mesh/material_filaments.h"
#include "jobs/mesh/mesh_choices.h"
#include "jobs/mesh/mixed_filaments.h"
#include "jobs/mesh/painted_surfaces.h"
#include "jobs/mesh/shared_mesh.h"
#include "jobs/mesh/slicer_bodies.h"
#include "jobs/mesh/vertex_colours.h"
#include "jobs/mesh/virtual_tools.h"

namespace ombre::jobs {
namespace {

using compile::MeshChoices;

constexpr const char* mesh_footer =
    ". Without -o the file is a .3mf. Bodies share their borders exactly: no gaps, no overlaps.\n\n"
    "Details thinner than a cell may be lost. Cells are cut finer where the surface would lie farther off than the\n"
    "tolerance, and triangles are joined where it is flat within the tolerance. A warning tells what remains.\n"
    "Polyhedra of OpenSCAD scripts keep their own triangles, unless --cell or --keep-all is given.\n\n"
    "Examples:\n"
    "  ombre mesh part.vcad                               a body for each material, in part.3mf\n"
    "  ombre mesh part.vcad --by whole -o part.stl        one body\n"
    "  ombre mesh part.vcad --tolerance 0.01\n"
    "  ombre mesh part.vcad --by parts --flavour prusa    a body for each named part, with its own extruder\n"
    "  ombre mesh part.vcad --beams -o part.3mf           struts as beams of a 3MF file, the rest as "
    "triangles\n"
    "  ombre mesh part.vcad --bands 4                     four bodies by the fraction that varies most\n"
    "  ombre mesh part.vcad --by red --borders 0.2,0.5    three bodies: red below 20 %, to 50 %, from there on\n"
    "  ombre mesh sole.vcad --by infill_density,temperature --flavour prusa     each band with its own settings\n"
    "  ombre mesh part.vcad --colour-by color_rgba -o part.glb                  vertices in the attribute's colours\n"
    "  ombre mesh seat.vcad --bands 4 --flavour prusa --setting fill_density=10%..60%\n";

void tell_bodies(const Events& events, const compile::MeshedDesign& made) {
  DataList bodies;
  size_t beams = 0;
  for (const compile::RegionBody& body : made.bodies) {
    const std::string name = body.region.name.empty() ? "body" : body.region.name;
    events.say(name + ": " + format_count(body.body.triangles.size()) + " triangles, " +
               format_rounded(body.volume_mm3, 6) + " mm3, " + format_rounded(body.area_mm2, 6) + " mm2");
    bodies.push_back(DataMembers{{"name", body.region.name},
                                 {"triangles", static_cast<double>(body.body.triangles.size())},
                                 {"volume_mm3", body.volume_mm3},
                                 {"area_mm2", body.area_mm2}});
  }
  for (const compile::BeamBody& body : made.beams) {
    const std::string cut = !body.clip                                          ? ""
                            : body.clipping == formats::LatticeClipping::inside ? ", cut to the inside of a mesh of "
                                                                                : ", cut to the outside of a mesh of ";
    events.say("beams: " + format_count(body.beams.size()) + cut +
               (body.clip ? format_count(made.clips[*body.clip].triangles.size()) + " triangles" : ""));
    beams += body.beams.size();
  }
  events.event("bodies", {{"bodies", bodies},
                          {"beams", static_cast<double>(beams)},
                          {"clips", static_cast<double>(made.clips.size())},
                          {"tolerance_mm", made.tolerance_mm},
                          {"cell_mm", made.cell_mm},
                          {"intersections", static_cast<double>(made.report.intersections)},
                          {"folded", static_cast<double>(made.report.folded)},
                          {"farthest_in_tolerances", made.report.farthest_in_tolerances},
                          {"lost_places", static_cast<double>(made.report.lost.places)}});
}

// The file to write, and its format.
struct MeshOutput {
  std::string stem, path;
  const formats::MeshFormat* format = nullptr;
};

std::string short_list(const std::vector<std::string>& names) {
  constexpr size_t most = 6;
  if (names.size() <= most) return join(names, ", ");
  return join({names.begin(), names.begin() + most}, ", ") + " and " + std::to_string(names.size() - most) + " more";
}

std::string endings_with_bodies() { return join(formats::mesh_endings_with(&formats::MeshFormat::holds_bodies), ", "); }

// Tells how several materials were treated if nobody chose regions.
void tell_materials(const Events& events, const compile::MeshedDesign& made, const MeshOutput& output) {
  const std::vector<std::string>& names = made.materials.names;
  if (names.size() < 2) return;
  if (made.is_by_bands) return events.say("mixtures of " + short_list(names) + " become bodies by bands of fractions");
  if (output.format->holds_bodies && made.materials.are_mixed)
    return events.say("mixtures of " + short_list(names) + " go to the body of the material that they have most of");
  if (output.format->holds_bodies) return;
  events.warn(short_list(names) + " are joined: " + output.path +
              " cannot say which is where; write a file that ends in " + endings_with_bodies() + ", or " +
              spelled::option("--by", "whole") + " if they are to be one");
}

// Colours of vertices show what the bodies are of.
void warn_of_joined_bodies(const Events& events, const compile::MeshedDesign& made, const MeshChoices& a,
                           const MeshOutput& output) {
  if (output.format->holds_bodies || made.bodies.size() < 2 || !a.colour_by.empty()) return;
  events.warn(format_count(made.bodies.size()) + " bodies are joined: " + output.path +
              " cannot say which triangles are whose; write a file that ends in " + endings_with_bodies());
}

void warn_of_folds(const Events& events, const compile::MeshedDesign& made) {
  const uint64_t folded = made.report.folded, crossing = made.report.intersections;
  std::vector<std::string> what;
  if (crossing == 1) what.emplace_back("1 pair of triangles goes through each other");
  if (crossing > 1) what.push_back(format_count(crossing) + " pairs of triangles go through each other");
  if (folded == 1) what.emplace_back("1 triangle faces inwards");
  if (folded > 1) what.push_back(format_count(folded) + " triangles look inwards");
  if (what.empty()) return;
  events.warn(join(what, " and ") + ", where the design is finer than the cells of " + format_rounded(made.cell_mm, 3) +
              " mm; choose a smaller " + spelled::option("--cell"));
}

void tell_distance(const Events& events, const compile::MeshedDesign& made) {
  if (made.is_exact) return events.say("the triangles are those of the script's polyhedra");
  const double farthest = made.report.farthest_in_tolerances;
  if (farthest <= 1 && !made.bodies.empty())
    return events.say("triangles and design lie within " + format_rounded(made.tolerance_mm, 3) + " mm of each other" +
                      (made.is_coarser ? "; a smaller " + spelled::option("--tolerance") + " takes longer" : ""));
  if (farthest <= 1) return;
  events.warn("the triangles lie up to " + format_rounded(farthest, 2) + " tolerances, " +
              format_rounded(farthest * made.tolerance_mm, 2) + " mm, from the design in places; choose a smaller " +
              spelled::option("--cell"));
}

void warn_of_lost_parts(const Events& events, const compile::MeshedDesign& made) {
  const surface::LostParts& lost = made.report.lost;
  if (lost.places == 0) return;
  events.warn("a part or a gap thinner than the cells of " + format_rounded(made.cell_mm, 3) +
              " mm is missing, for example near (" + format_rounded(lost.first.x, 4) + ", " +
              format_rounded(lost.first.y, 4) + ", " + format_rounded(lost.first.z, 4) + "); choose a " +
              spelled::option("--cell") + " no larger than it is thick");
}

void tell_plan(const Events& events, const compile::MeshPlan& plan) {
  events.say("cells of " + format_rounded(plan.cell_mm, 3) + " mm, about " +
             format_count(static_cast<unsigned long long>(plan.cells)) + " at the surface, which take about " +
             format_bytes(plan.memory_bytes) + " of memory, more where they are cut finer");
  events.event("plan", {{"cell_mm", plan.cell_mm},
                        {"tolerance_mm", plan.tolerance_mm},
                        {"cells", plan.cells},
                        {"memory_bytes", plan.memory_bytes}});
}

void check_beams(const MeshChoices& a, const compile::MeshRequest& request, const std::string& output,
                 const formats::MeshFormat& format) {
  if (!format.holds_beams)
    throw WrongArgument(spelled::option("--beams") + " are for .3mf; " + output + " cannot hold them");
  if (a.flavour != formats::SlicerFlavour::generic)
    throw WrongArgument(spelled::option("--flavour", formats::flavour_word(a.flavour)) +
                        " has no beams, which its slicers do not read; leave one of the two out");
  if (request.bands)
    throw WrongArgument("beams have a material each, but no bands; write " + spelled::option("--by", "materials") +
                        ", or leave " + spelled::option("--beams") + " out");
}

MeshOutput output_of(const MeshChoices& a) {
  const std::string stem = std::filesystem::path(a.design.design).stem().string();
  const std::string path = a.output.empty() ? stem + ".3mf" : a.output;
  const formats::MeshFormat* format = formats::find_mesh_format(path);
  if (!format || !format->is_written())
    throw WrongArgument(spelled::option("-o", path) + " does not say a format; let it end in " +
                        join(formats::written_mesh_endings(), ", "));
  return {stem, path, format};
}

// Colours of vertices already show the materials, so bodies may be joined.
compile::UsualRegions usual_regions(const MeshChoices& a, const formats::MeshFormat& format) {
  if (a.regions.are_chosen() || a.colour_by == "materials") return compile::UsualRegions::as_requested;
  return format.holds_bodies ? compile::UsualRegions::separate : compile::UsualRegions::joined;
}

// Refuses options that only projects of slicers have.
void check_project(const MeshChoices& a, const MeshOutput& output) {
  const bool is_written = formats::is_project(a.flavour) && output.format->is_archive;
  const auto needs = [&](bool is_chosen, const Phrase& option, bool fits, const std::string& words) {
    if (is_chosen && !(is_written && fits))
      throw WrongArgument(option + " is for projects of slicers in .3mf files; write " +
                          spelled::option("--flavour", words));
  };
  const std::string projects = "prusa, bambu, orca or snapmaker";
  const bool is_bambu = a.flavour == formats::SlicerFlavour::bambu;
  needs(a.mix_layers > 0, spelled::option("--mix-layers"), true, projects);
  needs(a.height_ranges, spelled::option("--height-ranges"), true, projects);
  needs(a.virtual_tools, spelled::option("--virtual-tools"), !is_bambu, "prusa, orca or snapmaker");
  if (a.height_ranges && (a.regions.by.empty() || a.mix_layers > 0 || a.virtual_tools))
    throw WrongArgument(spelled::option("--height-ranges") + " is for attributes; write " +
                        spelled::option("--by", "infill_density") + " without filaments of their own");
  if (a.mix_layers > 0 && a.virtual_tools)
    throw WrongArgument(spelled::option("--mix-layers") + " and " + spelled::option("--virtual-tools") +
                        " both choose filaments; leave one of the two out");
}

// Returns the paths of the files that the job writes.
std::vector<std::string> written_by(const MeshOutput& output) {
  std::vector<std::string> paths{output.path};
  if (output.format->companion_bytes) paths.push_back(exporting::companion_path(output.path, *output.format));
  return paths;
}

void refuse_options(const MeshChoices& a, const compile::MeshRequest& request, const MeshOutput& output) {
  const formats::MeshFormat& format = *output.format;
  if (a.beams) check_beams(a, request, output.path, format);
  check_project(a, output);
  for (const std::string& setting : a.settings) SlicerSetting(setting).check(a.flavour);
  if (!a.colour_by.empty() && !format.holds_colours)
    throw WrongArgument(spelled::option("--colour-by") + ": " + output.path + " holds no colours of vertices; write " +
                        words_text(formats::mesh_endings_with(&formats::MeshFormat::holds_colours)));
  if (format.is_archive && !formats::can_write_3mf())
    throw WrongArgument("this ombre was built without libzip, which " + std::string(format.ending) +
                        " files need; write -o " + output.stem + ".amf");
}

// Prints diagnostics as they come.
class PrintedDiagnostics {
 public:
  explicit PrintedDiagnostics(const Events& events) : events_(events) {}
  Diagnostics& diagnostics() { return diagnostics_; }
  void print() {
    events_.diagnose(diagnostics_.after(printed_));
    printed_ = diagnostics_.list().size();
  }

 private:
  const Events& events_;
  Diagnostics diagnostics_;
  size_t printed_ = 0;
};

// Makes the surfaces, and adds diagnostics.
using MakeMesh = std::function<std::optional<compile::MeshedDesign>(PrintedDiagnostics& printed, Progress& progress)>;

std::optional<compile::MeshedDesign> make_mesh(const MakeMesh& make, PrintedDiagnostics& printed, Session& session) {
  JobProgress progress(session.events, Counted::steps);
  auto made = make(printed, progress);
  progress.finish();
  printed.print();
  if (!made || printed.diagnostics().has_errors()) return std::nullopt;
  if (!made->bodies.empty() || !made->beams.empty()) return made;
  session.events.warn("no cell's corner is inside the design: there is nothing to write; choose a smaller " +
                      spelled::option("--cell"));
  return std::nullopt;
}

bool colour(const MeshChoices& a, const compile::Loaded& loaded, double tolerance_mm, formats::MeshDocument& document,
            Diagnostics& diagnostics, Session& session) {
  if (a.colour_by.empty()) return true;
  if (formats::is_project(a.flavour))
    return paint_surfaces(loaded, a.colour_by, tolerance_mm, session.events, document, diagnostics, a.work.threads,
                          &session.stop);
  const compile::VertexColouring colouring{a.colour_by, a.palette, a.range};
  return compile::colour_vertices(loaded, colouring, document, diagnostics, a.work.threads, &session.stop);
}

// Slicers expect a layer height in each range.
void set_layer_height(formats::SlicerProject& project) {
  std::string height = "0.2";
  for (const auto& [key, value] : project.object_settings)
    if (key == "layer_height") height = value;
  for (formats::HeightRange& range : project.ranges)
    if (std::ranges::none_of(range.settings, [](const auto& own) { return own.first == "layer_height"; }))
      range.settings.emplace_back("layer_height", height);
}

bool add_ranges(const MeshChoices& a, const compile::Loaded& loaded, formats::MeshDocument& document,
                Diagnostics& diagnostics, Session& session) {
  if (!a.height_ranges) return true;
  auto ranges = height_bands(loaded, a, diagnostics, &session.stop);
  if (!ranges) return false;
  document.project.ranges = std::move(*ranges);
  set_layer_height(document.project);
  session.events.say(format_count(document.project.ranges.size()) + " ranges of heights have their own settings");
  return true;
}

bool may_take_material_filaments(const MeshChoices& a, const compile::Loaded& loaded) {
  return formats::is_project(a.flavour) && describes_filaments(loaded.design.materials);
}

bool have_good_filaments(const MeshChoices& a, const compile::Loaded& loaded, Diagnostics& diagnostics) {
  if (may_take_material_filaments(a, loaded)) check_material_filaments(loaded.design.materials, a.flavour, diagnostics);
  return !diagnostics.has_errors();
}

void refuse_extruder(const MeshChoices& a) {
  for (const std::string& setting : a.settings)
    if (SlicerSetting(setting).key() == "extruder")
      throw WrongArgument(spelled::option("--setting", setting) +
                          " and the members \"extruder\" and \"mix_layers\" of materials both choose extruders; leave "
                          "one of the two out");
}

// Gives the one body of a design of one material this material, where nobody chose regions.
void name_only_material(const compile::Loaded& loaded, compile::MeshedDesign& made) {
  if (made.bodies.size() == 1 && made.materials.names.size() == 1)
    made.bodies[0].region.material = loaded.design.materials.find(made.materials.names[0])->id;
}

void choose_filaments(const MeshChoices& a, const compile::Loaded& loaded, compile::MeshedDesign& made,
                      const Events& events, formats::MeshDocument& document) {
  if (!may_take_material_filaments(a, loaded)) return;
  name_only_material(loaded, made);
  const auto is_of_material = [](const compile::RegionBody& body) { return body.region.material.has_value(); };
  const bool is_free = a.mix_layers == 0 && !a.virtual_tools && a.colour_by.empty();
  if (!is_free || !std::ranges::all_of(made.bodies, is_of_material))
    return events.warn(
        "\"extruder\" and \"mix_layers\" of materials are for bodies of materials, so they are not used here");
  refuse_extruder(a);
  add_material_filaments(loaded.design.materials, made, events, document);
}

int write(const MeshChoices& a, const compile::Loaded& loaded, compile::MeshedDesign& made, const MeshOutput& output,
          const std::vector<SlicerSetting>& settings, PrintedDiagnostics& printed, Session& session) {
  formats::MeshDocument document = document_of(made, output.stem, a, settings);
  if (a.virtual_tools) add_virtual_tools(made, session.events, document);
  Diagnostics& diagnostics = printed.diagnostics();
  if (a.mix_layers > 0) add_mixed_filaments(loaded, made, a.mix_layers, session.events, diagnostics, document);
  choose_filaments(a, loaded, made, session.events, document);
  if (formats::is_project(a.flavour))
    check_filament_numbers(document, a.flavour, may_take_material_filaments(a, loaded));
  tell_equal_bands(session.events, made, a, document);
  const bool good = colour(a, loaded, made.tolerance_mm, document, diagnostics, session) &&
                    add_ranges(a, loaded, document, diagnostics, session);
  if (good && formats::is_project(a.flavour)) name_only_filament(loaded, session.events, diagnostics, document);
  printed.print();
  if (!good) return wrong_input;
  if (output.format->holds_settings) tell_lost_attributes(session.events, made, a);
  compile::add_beams(made, loaded.design.materials, document);
  exporting::write_mesh_file(output.path, document, *output.format, a.flavour);
  return done;
}

// Makes the mesh, tells of it, and writes it; returns an exit code.
int make_and_write(const MeshChoices& a, const compile::Loaded& loaded, const MeshOutput& output, const MakeMesh& make,
                   const Stopwatch& watch, Session& session) {
  PrintedDiagnostics printed(session.events);
  auto made = make_mesh(make, printed, session);
  if (!made) return wrong_input;
  tell_materials(session.events, *made, output);
  warn_of_joined_bodies(session.events, *made, a, output);
  tell_bodies(session.events, *made);
  warn_of_folds(session.events, *made);
  tell_distance(session.events, *made);
  warn_of_lost_parts(session.events, *made);
  const std::vector<SlicerSetting> settings(a.settings.begin(), a.settings.end());
  if (const int code = write(a, loaded, *made, output, settings, printed, session); code != done) return code;
  session.events.say(output.path + " written in " + format_rounded(watch.seconds(), 3) + " s");
  session.events.event("done", {{"file", output.path}, {"seconds", watch.seconds()}});
  return done;
}

int mesh(const MeshChoices& a, Session& session) {
  compile::MeshRequest request = a.request();
  const MeshOutput output = output_of(a);
  request.usual = usual_regions(a, *output.format);
  const Stopwatch watch;
  JobSteps<compile::LoadedPtr> steps;
  steps.refuse = [&] {
    for (const std::string& path : written_by(output)) refuse_to_overwrite(path, a.force);
    refuse_options(a, request, output);
  };
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<compile::LoadedPtr> {
    const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
    return loaded && have_good_filaments(a, *loaded, diagnostics) ? std::optional(loaded) : std::nullopt;
  };
  steps.run = [&](const compile::LoadedPtr& loaded) {
    const MakeMesh make = [&](PrintedDiagnostics& printed, Progress& progress) {
      request.announce = [&](const compile::MeshPlan& plan) {
        printed.print();
        tell_plan(session.events, plan);
      };
      return compile::mesh_design(*loaded, request, printed.diagnostics(), &progress, &session.stop);
    };
    return make_and_write(a, *loaded, output, make, watch, session);
  };
  return take_steps(steps, session);
}

void refuse_unshared(const MeshChoices& a) {
  if (a.beams || a.force)
    throw WrongArgument("meshes are shared out without " + spelled::option("--beams") + " and " +
                        spelled::option("--force"));
}

// Exact bodies are cut without cells.
void refuse_exact(const compile::Loaded& loaded, const compile::MeshRequest& request, const Session& session) {
  if (request.keeps_polyhedra && compile::exact_bodies(loaded.design, request, &session.stop))
    throw WrongArgument(
        "a script's polyhedra keep their triangles, which one process writes at once; run the job, or "
        "save it with " +
        spelled::option("--keep-all"));
}

SharedJobPtr share(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& a = *static_cast<const MeshChoices*>(job);
  refuse_unshared(a);
  compile::MeshRequest request = a.request();
  const MeshOutput output = output_of(a);
  request.usual = usual_regions(a, *output.format);
  refuse_options(a, request, output);
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded || !have_good_filaments(a, *loaded, diagnostics)) return nullptr;
  refuse_exact(*loaded, request, session);
  auto planned = compile::plan_mesh(*loaded, request, diagnostics, nullptr, &session.stop);
  if (!planned || diagnostics.has_errors()) return nullptr;
  MeshToShare shared{output.path + ".slabs", std::move(*planned),
                     settings_key(a.design.design, loaded->design, a.given, session.program), written_by(output),
                     nullptr};
  shared.write = [a, output, loaded](const compile::PlannedMesh& mesh, const surface::GridBorders& known,
                                     Session& here) {
    const MakeMesh make = [&](PrintedDiagnostics& printed, Progress& progress) {
      return std::optional(compile::make_mesh(mesh, &known, printed.diagnostics(), &progress));
    };
    return make_and_write(a, *loaded, output, make, Stopwatch(), here);
  };
  return share_mesh(std::move(shared));
}

}  // namespace

JobKind mesh_kind() {
  const std::vector<std::string> endings = formats::written_mesh_endings();
  JobKind kind =
      job_kind<MeshChoices>("mesh", "Write closed surfaces: STL, 3MF and others",
                            "Lengths are millimetres.\n\nFILE ends in " + words_text(endings) + mesh_footer, mesh);
  kind.endings = endings;
  kind.share = share;
  return kind;
}

}  // namespace ombre::jobs
