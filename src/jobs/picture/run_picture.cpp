// `ombre render` draws pictures of a design.
#include <filesystem>
#include <functional>
#include <memory>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/info/result_files.h"
#include "jobs/picture/frame_job.h"
#include "jobs/picture/picture_choices.h"
#include "load/load.h"
#include "questions/question.h"
#include "stores/open_store.h"
#include "stores/stored_job.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using compile::PictureChoices;

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
    "  ombre render part.vcad --frames 36 -o turn.png       turn_00.png to turn_35.png, all around the part\n"
    "  ombre render part.vcad --frames 360 -o turn/ --resume     frame_000.png ..., to go on after an interruption\n"
    "  ombre render part.vcad --frames 36 -o - | ffmpeg -f image2pipe -i - turn.mp4\n";

// True if the frames go into a folder or an archive, from which a stopped job is resumed.
bool is_stored(const PictureChoices& a) {
  const std::string ending = ending_of(a.output);
  return a.frames > 1 && a.output != "-" && !a.output.empty() && (ending.empty() || ending == ".zip");
}

void check_output(const PictureChoices& a, const Session& session) {
  if (a.output == "-" && session.events.prints_among_events())
    throw WrongArgument("-o - writes the picture to stdout, where " + spelled::option("--json") +
                        " writes events; give -o a file name");
  if (a.resume && !is_stored(a))
    throw WrongArgument(spelled::option("--resume") +
                        " goes on with frames in a folder or an archive; write for example -o turn/ or -o turn.zip");
}

// Returns the files: turn.png becomes turn_00.png and so on if there are several frames. Returns none for stdout, where
// pictures follow each other.
std::vector<std::string> output_files(const PictureChoices& a) {
  if (a.output == "-") return {};
  const fs::path path(a.output.empty() ? fs::path(a.design.design).stem().string() + ".png" : a.output);
  if (const std::string ending = ending_of(path); !ending.empty() && ending != ".png")
    throw WrongArgument(spelled::option("-o", a.output) + ": pictures are PNG files; write for example -o " +
                        fs::path(path).replace_extension(".png").string());
  if (a.frames == 1) return {path.string()};
  std::vector<std::string> files;
  for (int frame = 0; frame < a.frames; ++frame)
    files.push_back((path.parent_path() /
                     (path.stem().string() + "_" + stores::piece_number(frame, a.frames) + path.extension().string()))
                        .string());
  return files;
}

// Loads a design, or the mesh of results as one.
compile::LoadedPtr load_pictured(const PictureChoices& a, Session& session, Diagnostics& diagnostics) {
  if (is_results(a.design.design)) {
    compile::LoadOptions options = a.design.load();
    options.stop = &session.stop;
    options.threads = a.work.threads;
    options.cache = &session.cache;
    const fs::path path = fs::path(a.design.design).replace_extension(".vcad");
    return compile::load_text(results_as_script(a.design.design, a.by, a.deform, a.step), path.string(), options,
                              diagnostics);
  }
  for (const auto& [name, is_given] : {std::pair("--deform", a.deform != 0), std::pair("--step", a.step > 0)})
    if (is_given)
      throw WrongArgument(spelled::option(name) + " is for results; write for example ombre render part.vtu " +
                          spelled::option(name, "5"));
  return load_design(a.design, session, diagnostics, a.work.threads);
}

// Says which attributes a design has, if its picture shows materials.
void tell_attributes(const compile::Loaded& loaded, const compile::PictureRequest& request, const Events& events) {
  const std::vector<std::string> names = compile::attribute_names(loaded.design);
  if (names.empty() || !request.by.empty()) return;
  events.say("it has the attributes " + join(names, ", ") + "; " + spelled::option("--by", names.front()) +
             " colours by one");
}

int write_pictures(const compile::Loaded& loaded, const compile::PictureRequest& request,
                   const std::vector<std::string>& files, Session& session) {
  if (!files.empty()) tell_attributes(loaded, request, session.events);
  JobProgress progress(session.events, Counted::steps);
  return take_pictures(loaded, request, session, progress, [&](int frame, const compile::Picture& picture) {
    const std::string bytes = png_of(request, picture);
    if (files.empty()) return session.events.print(bytes);
    const std::string& file = files[static_cast<size_t>(frame)];
    exporting::write_file(file, bytes);
    progress.finish();
    session.events.say("written to " + file + ", " + format_rounded(picture.pixel_mm, 3) + " mm a pixel");
    session.events.event("picture", {{"file", file}, {"pixel_mm", picture.pixel_mm}});
  });
}

int render_design(const PictureChoices& a, Session& session) {
  const compile::PictureRequest request = a.request();
  check_output(a, session);
  const std::vector<std::string> files = is_stored(a) ? std::vector<std::string>() : output_files(a);
  JobSteps<compile::LoadedPtr> steps;
  steps.refuse = [&] {
    if (is_stored(a)) refuse_used_folder(a);
    for (const std::string& file : files) refuse_to_overwrite(file, a.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<compile::LoadedPtr> {
    const compile::LoadedPtr loaded = load_pictured(a, session, diagnostics);
    return loaded ? std::optional(loaded) : std::nullopt;
  };
  steps.run = [&](const compile::LoadedPtr& loaded) {
    return is_stored(a) ? store_frames(a, *loaded, request, session) : write_pictures(*loaded, request, files, session);
  };
  return take_steps(steps, session);
}

SharedJobPtr share(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& choices = *static_cast<const PictureChoices*>(job);
  if (!is_stored(choices) || choices.force || choices.resume)
    throw WrongArgument("of pictures the frames in a folder or an archive are shared out; write for example " +
                        spelled::option("--frames", "360") + " -o turn/, without " + spelled::option("--force") +
                        " and " + spelled::option("--resume"));
  const compile::LoadedPtr loaded = load_pictured(choices, session, diagnostics);
  return loaded ? share_frames(choices, loaded, session) : nullptr;
}

}  // namespace

JobKind render_kind() {
  JobKind kind = job_kind<PictureChoices>("render", "Make pictures of a design", render_footer, render_design);
  kind.endings = {".png"};
  kind.share = share;
  return kind;
}

}  // namespace ombre::jobs
