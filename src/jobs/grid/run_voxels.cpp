// `ombre voxels` writes a design as a voxel grid for other programs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <variant>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "jobs/common/events.h"
#include "jobs/common/free_space.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/remarks.h"
#include "jobs/common/session.h"
#include "jobs/common/settings_key.h"
#include "jobs/grid/grid_choices.h"
#include "jobs/grid/scan_files.h"
#include "jobs/grid/shared_grid.h"
#include "jobs/grid/sparse_file.h"
#include "jobs/grid/volume_files.h"
#include "jobs/grid/voxels_in_memory.h"
#include "jobs/grid/vti_files.h"
#include "jobs/slice/plan_part.h"

namespace ombre::jobs {
namespace {

using compile::GridChoices;

constexpr const char* usual_footer =
    "--what is\n"
    "  materials   the number of the material that ombre slice puts there, 0 is void; a byte a voxel\n"
    "  fractions   a grid for each material: its fraction in each voxel before dithering, 0 outside\n"
    "  distance    mm from each voxel's centre to the surface, negative inside. Where a design has only a bound of\n"
    "              its distance (unions inside, differences, blends) the surface may be farther away; for a\n"
    "              function only the sign has a meaning. ombre slice --emit tree says which. .vdb and .nvdb hold a\n"
    "              narrow band around the surface, 3 voxels to both sides\n"
    "  attributes  a grid for each attribute of the design, in its unit; its default outside. Vectors, colours and\n"
    "              mixtures have one for each of their numbers\n"
    "  NAME        the attribute of that name, or one of its numbers (fibre.x); several with commas\n\n"
    "Examples:\n"
    "  ombre voxels part.vcad -o part.npy                        materials, as ombre slice has them\n"
    "  ombre voxels part.vcad -o part.nrrd --what distance --voxel 0.2\n"
    "  ombre voxels part.vcad -o part.raw --what fractions       part_red.raw, part_blue.raw and so on\n"
    "  ombre voxels part.vcad -o part.vdb                        distance, and a grid for each material\n"
    "  ombre voxels part.vcad -o part.npy --what density         the attribute \"density\"\n"
    "  ombre voxels part.vcad -o part.vti --what materials,distance,attributes\n"
    "  ombre voxels part.vcad -o part.nrrd --gzip --box -5,-5,0,5,5,2\n"
    "  ombre voxels scan.nii -o small.nrrd --voxel 1 --box 0,0,0,50,50,40   a scan, on other voxels and cropped; its\n"
    "              number between voxels, or with --what nearest that of the nearest, for labels\n";

struct VtiFormat {};
using Format = std::variant<compile::DenseFormat, vdb::FileFormat, VtiFormat>;

struct WrittenFormat {
  std::string ending, help;
  Format format;
};

const std::vector<WrittenFormat>& written_formats() {
  static const std::vector<WrittenFormat> formats = [] {
    std::vector<WrittenFormat> rows;
    for (const exporting::VolumeFormat& dense : exporting::volume_formats())
      rows.push_back({dense.ending, dense.help, compile::DenseFormat{&dense}});
    rows.push_back(
        {".vti", "image data of VTK, for ParaView: all grids in one file, vectors and colours as such", VtiFormat{}});
    rows.push_back({".vdb", "sparse grids of OpenVDB, for Blender, Houdini and others", vdb::FileFormat::vdb});
    rows.push_back({".nvdb", "the same for NanoVDB", vdb::FileFormat::nvdb});
    return rows;
  }();
  return formats;
}

std::string voxels_footer() {
  std::string text = "Lengths are millimetres in the design's space.\n\nFILE ends in\n";
  for (const WrittenFormat& format : written_formats())
    text += "  " + format.ending + std::string(8 - format.ending.size(), ' ') + format.help + "\n";
  return text + "\n" + usual_footer;
}

Format chosen_format(const GridChoices& a) {
  const std::string ending = ending_of(a.output);
  std::vector<std::string> endings;
  for (const WrittenFormat& row : written_formats()) {
    endings.push_back(row.ending);
    if (row.ending != ending) continue;
    Format format = row.format;
    auto* const dense = std::get_if<compile::DenseFormat>(&format);
    if (a.gzip && !(dense && dense->format->can_compress))
      throw WrongArgument(spelled::option("--gzip") + " is for .nrrd files; leave it out, or write " +
                          spelled::option("-o", "part.nrrd"));
    if (dense) dense->is_gzip = a.gzip;
    return format;
  }
  throw WrongArgument(spelled::option("-o", a.output) + " does not say a format; let it end in " + words_text(endings));
}

bool is_sparse(const Format& format) { return std::holds_alternative<vdb::FileFormat>(format); }

void tell_plan(const Events& events, const compile::GridJob& job, int threads, const std::vector<std::string>& paths,
               const std::string& bytes) {
  const compile::GridWork work = compile::size_grid_work(job, threads);
  const auto& pitch = job.request.lattice.pitch;
  const int64_t nx = job.region.size(0), ny = job.region.size(1), nz = job.region.size(2);
  events.say(std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz) + " voxels of " +
             mm_text(pitch[0].mm()) + " x " + mm_text(pitch[1].mm()) + " x " + mm_text(pitch[2].mm()) + " mm, " +
             bytes + " in " + join(paths, ", ") + "; at most " + format_bytes(work.memory_bytes) +
             " of memory for slabs in flight");
  warn_of_memory(events, "a slab of one layer", work.memory_bytes, job.memory_bytes);
  DataList files, names;
  for (const std::string& path : paths) files.emplace_back(path);
  for (const compile::Grid& grid : job.grids) names.emplace_back(grid.name);
  events.event("plan", {{"files", files},
                        {"grids", names},
                        {"voxels", DataList{number(nx), number(ny), number(nz)}},
                        {"pitch_mm", DataList{pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}},
                        {"memory_bytes", work.memory_bytes}});
}

void tell_report(const Events& events, const compile::GridReport& report) {
  events.say(join(report.files, ", ") + " written, " + format_bytes(static_cast<double>(report.bytes_written)) +
             " in " + format_rounded(report.seconds, 3) + " s");
  if (!report.has_inside) events.warn("no voxel's centre is inside the design: the grid is empty");
  DataList files;
  for (const std::string& path : report.files) files.emplace_back(path);
  events.event(
      "done",
      {{"files", files}, {"bytes_written", static_cast<double>(report.bytes_written)}, {"seconds", report.seconds}});
}

void warn_of_metric(const Events& events, const compile::GridJob& job) {
  const bool has_distance = std::any_of(job.grids.begin(), job.grids.end(), [](const compile::Grid& grid) {
    return grid.kind == compile::GridKind::distance;
  });
  if (has_distance && job.metric.is_implicit())
    events.warn(
        "only the sign of this design's distance has a meaning, since a formula gives it; its values are not in mm");
}

// Returns the files of a grid, without descriptions beside them.
std::vector<std::string> paths_of(const GridChoices& a, const compile::GridJob& job, const Format& format) {
  const bool is_dense = std::holds_alternative<compile::DenseFormat>(format);
  return is_dense ? compile::volume_paths(a.output, job.grids) : std::vector{a.output};
}

// Refuses to overwrite files of the grid, and those beside them.
void refuse_to_overwrite_any(const std::vector<std::string>& paths, const Format& format, bool force) {
  const auto* dense = std::get_if<compile::DenseFormat>(&format);
  for (const std::string& path : paths) {
    refuse_to_overwrite(path, force);
    if (dense && dense->format->has_description) refuse_to_overwrite(exporting::description_path(path), force);
  }
}

// True if one file is certain; otherwise only the design says how many grids of fractions and attributes there are.
bool has_one_file(const Format& format, const compile::GridQuery& query) {
  if (!std::holds_alternative<compile::DenseFormat>(format)) return true;
  const bool is_one = query.materials != query.distance;
  return is_one && !query.fractions && !query.all_attributes && query.attributes.empty();
}

// Reports the plan, once it is known to be possible.
void check(const GridChoices& a, const compile::GridJob& job, const Format& format, Session& session) {
  const std::vector<std::string> paths = paths_of(a, job, format);
  refuse_to_overwrite_any(paths, format, a.force);
  warn_of_metric(session.events, job);
  if (is_sparse(format)) return tell_plan(session.events, job, a.work.threads, paths, "sparse");
  const auto bytes = static_cast<double>(compile::volume_bytes(job));
  const auto* dense = std::get_if<compile::DenseFormat>(&format);
  const bool is_compressed = dense && dense->is_gzip;
  if (!a.force && !is_compressed)
    refuse_small_disk(a.output, bytes, "the grid", "choose larger voxels with " + spelled::option("--voxel"));
  tell_plan(session.events, job, a.work.threads, paths, (is_compressed ? "at most " : "") + format_bytes(bytes));
}

int write(const GridChoices& a, const compile::GridJob& job, const Format& format, Session& session) {
  JobProgress progress(session.events);
  const auto written = [&]() -> compile::GridReport {
    const int threads = a.work.threads;
    if (const auto* sparse = std::get_if<vdb::FileFormat>(&format))
      return compile::write_sparse(job, a.output, *sparse, threads, &progress, &session.stop);
    if (std::holds_alternative<VtiFormat>(format))
      return compile::write_vti(job, a.output, threads, &progress, &session.stop);
    return compile::write_volumes(job, paths_of(a, job, format), std::get<compile::DenseFormat>(format), threads,
                                  &progress, &session.stop);
  };
  const compile::GridReport report = written();
  progress.finish();
  tell_report(session.events, report);
  return done;
}

// A grid with the design that it is of.
struct Planned {
  compile::GridJob job;
  compile::LoadedPtr loaded;
};

std::optional<Planned> plan_job(const GridChoices& a, const compile::GridQuery& query, Session& session,
                                Diagnostics& diagnostics) {
  const auto options = plan_options(a.sampling, a.work, session, diagnostics);
  if (!options) return std::nullopt;
  if (is_scan(a.design.design) && !options->pitch[0])
    throw WrongArgument("how large the voxels of a scan are to be is not said; write for example " +
                        spelled::option("--voxel", "1") + " (mm; ombre info " + a.design.design + " prints its own)");
  const compile::LoadedPtr loaded = is_scan(a.design.design)
                                        ? load_scan(a.design, session, diagnostics, a.work.threads)
                                        : load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded) return std::nullopt;
  const auto plan = compile::plan_slice(loaded, *options, diagnostics);
  if (!plan) return std::nullopt;
  auto job =
      compile::plan_grids(loaded, *plan, query, compile::chosen_region(a.box, plan->request.lattice), diagnostics);
  if (!job) return std::nullopt;
  job->memory_bytes = a.work.memory_bytes;
  return Planned{std::move(*job), loaded};
}

compile::GridQuery query_of(const GridChoices& a, const Format& format) {
  const std::string usual = is_scan(a.design.design) ? "number"
                            : is_sparse(format)      ? "distance,fractions"
                                                     : "materials";
  return a.query(usual, is_sparse(format));
}

int voxels(const GridChoices& a, Session& session) {
  const Format format = chosen_format(a);
  const compile::GridQuery query = query_of(a, format);
  JobSteps<Planned> steps;
  steps.refuse = [&] {
    if (has_one_file(format, query)) refuse_to_overwrite_any({a.output}, format, a.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) { return plan_job(a, query, session, diagnostics); };
  steps.check = [&](const Planned& planned) { check(a, planned.job, format, session); };
  steps.run = [&](const Planned& planned) { return write(a, planned.job, format, session); };
  return take_steps(steps, session);
}

// Returns a key of everything that decides the numbers, such as the pitch of a printer whose profile is a file.
stores::JobKey key_of(const GridChoices& a, const Planned& planned, const Session& session) {
  stores::JobKey key = settings_key(a.design.design, planned.loaded->design, a.settings, session.program);
  const compile::Sampling& sampling = planned.job.request;
  std::string voxels, materials;
  for (size_t axis = 0; axis < 3; ++axis)
    voxels += sampling.lattice.pitch[axis].text() + ' ' +
              format_number(sampling.lattice.origin[static_cast<int>(axis)]) + ' ' +
              std::to_string(planned.job.region.lo[axis]) + ' ' + std::to_string(planned.job.region.hi[axis]) + '\n';
  for (const compile::SliceMaterial& material : sampling.materials) materials += material.name + '\n';
  key.add("the voxels", voxels);
  key.add("the materials", materials);
  return key;
}

SharedJobPtr share(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& choices = *static_cast<const GridChoices*>(job);
  const Format format = chosen_format(choices);
  const auto* const dense = std::get_if<compile::DenseFormat>(&format);
  if (!dense || choices.force)
    throw WrongArgument("of grids those in .npy, .nrrd and .raw files are shared out, without " +
                        spelled::option("--force"));
  auto planned = plan_job(choices, query_of(choices, format), session, diagnostics);
  if (!planned || diagnostics.has_errors()) return nullptr;
  stores::JobKey key = key_of(choices, *planned, session);
  std::vector<std::string> paths = compile::volume_paths(choices.output, planned->job.grids);
  return share_grid(choices, {std::move(planned->job), std::move(paths), *dense}, std::move(key), tell_report);
}

}  // namespace

int make_voxels(const GridChoices& a, Session& session, std::vector<compile::VolumeInMemory>& made) {
  JobSteps<Planned> steps;
  steps.plan = [&](Diagnostics& diagnostics) { return plan_job(a, a.query("materials", false), session, diagnostics); };
  steps.check = [&](const Planned& planned) { warn_of_metric(session.events, planned.job); };
  steps.run = [&](const Planned& planned) {
    JobProgress progress(session.events);
    made = compile::volumes_in_memory(planned.job, a.work.threads, &progress, &session.stop);
    return done;
  };
  return take_steps(steps, session);
}

JobKind voxels_kind() {
  JobKind kind = job_kind<GridChoices>("voxels", "Write a voxel grid for other programs", voxels_footer(), voxels);
  for (const WrittenFormat& format : written_formats()) kind.endings.push_back(format.ending);
  kind.share = share;
  return kind;
}

}  // namespace ombre::jobs
