// `ombre render` draws pictures of a design.
#include <filesystem>
#include <memory>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/images/png.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/info/result_files.h"
#include "jobs/picture/picture_choices.h"
#include "load/load.h"

namespace ombre::jobs {
namespace {

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
    "  ombre render part.vcad --frames 36 -o - | ffmpeg -f image2pipe -i - turn.mp4\n";

// Returns the files: turn.png becomes turn_00.png and so on if there are several frames. Returns none for stdout, where
// pictures follow each other.
std::vector<std::string> output_files(const PictureChoices& a) {
  namespace fs = std::filesystem;
  if (a.output == "-") return {};
  const fs::path path(a.output.empty() ? fs::path(a.design.design).stem().string() + ".png" : a.output);
  if (const std::string ending = ending_of(path); !ending.empty() && ending != ".png")
    throw WrongArgument(spelled::option("-o", a.output) + ": pictures are PNG files; write for example -o " +
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

// Loads a design, or the mesh of results as one.
compile::LoadedPtr load_pictured(const PictureChoices& a, Session& session, Diagnostics& diagnostics) {
  if (is_results(a.design.design)) {
    compile::LoadOptions options{a.design.materials, a.design.definitions};
    options.stop = &session.stop;
    options.threads = a.work.threads;
    options.cache = &session.cache;
    const std::filesystem::path path = std::filesystem::path(a.design.design).replace_extension(".vcad");
    return compile::load_text(results_as_script(a.design.design, a.by, a.deform), path.string(), options, diagnostics);
  }
  if (a.deform != 0)
    throw WrongArgument(spelled::option("--deform") + " is for results; write for example ombre render part.vtu " +
                        spelled::option("--deform", "5"));
  return load_design(a.design, session, diagnostics, a.work.threads);
}

int take_pictures(const compile::Loaded& loaded, const compile::PictureRequest& request,
                  const std::vector<std::string>& files, Session& session) {
  Diagnostics diagnostics;
  JobProgress progress(session.events, Counted::steps);
  const auto take = [&](int frame, const compile::Picture& picture) {
    const std::string bytes =
        formats::encode_png(static_cast<uint32_t>(request.width), static_cast<uint32_t>(request.height), picture.rgba);
    if (files.empty()) return session.events.print(bytes);
    const std::string& file = files[static_cast<size_t>(frame)];
    exporting::write_file(file, bytes);
    progress.finish();
    session.events.say("written to " + file + ", " + format_rounded(picture.pixel_mm, 3) + " mm a pixel");
    session.events.event("picture", {{"file", file}, {"pixel_mm", picture.pixel_mm}});
  };
  const bool is_done = compile::take_pictures(loaded, request, session.stop, take, diagnostics, &progress);
  progress.finish();
  session.events.diagnose(diagnostics);
  return is_done && !diagnostics.has_errors() ? done : wrong_input;
}

int render_design(const PictureChoices& a, Session& session) {
  const compile::PictureRequest request = a.request();
  if (a.output == "-" && session.events.prints_among_events())
    throw WrongArgument("-o - writes the picture to stdout, where " + spelled::option("--json") +
                        " writes events; give -o a file name");
  const std::vector<std::string> files = output_files(a);
  JobSteps<compile::LoadedPtr> steps;
  steps.refuse = [&] {
    for (const std::string& file : files) refuse_to_overwrite(file, a.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<compile::LoadedPtr> {
    const compile::LoadedPtr loaded = load_pictured(a, session, diagnostics);
    return loaded ? std::optional(loaded) : std::nullopt;
  };
  steps.run = [&](const compile::LoadedPtr& loaded) { return take_pictures(*loaded, request, files, session); };
  return take_steps(steps, session);
}

}  // namespace

JobKind render_kind() {
  JobKind kind = job_kind<PictureChoices>("render", "Make pictures of a design", render_footer, render_design);
  kind.endings = {".png"};
  return kind;
}

}  // namespace ombre::jobs
