// `ombre submit` hands the shares of a plan to Slurm, Kubernetes, GNU parallel or Dask.
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/system/other_program.h"
#include "base/text/error.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/overwrite.h"
#include "jobs/shared_plan.h"
#include "jobs/submit_scripts.h"

namespace ombre::jobs {
namespace {

constexpr const char* submit_footer =
    "Writes a script beside the plan, such as plan.slurm.sh, and runs it. The script begins the shares in the current\n"
    "folder, again if their machine fails, and joins them at the end. It may be changed, and run again by hand.\n"
    "Kubernetes sees the folder as a volume at /work. The variable OMBRE may name another program than ombre.\n\n"
    "Examples:\n"
    "  ombre submit plan.json --to slurm\n"
    "  ombre submit plan.json --to slurm --print > mine.sh     to change it first\n"
    "  ombre submit plan.json --to kubernetes --image registry.example/ombre:0.1 --claim parts\n"
    "  ombre submit plan.json --to parallel\n";

struct SubmitChoices {
  std::string plan, to, output, image, claim;
  int cores = 4, attempts = 3;
  std::optional<int> minutes, memory_mib;
  bool prints = false, force = false;

  static const options::Spec<SubmitChoices>& options() {
    using namespace options;
    constexpr double most = 1e6;
    static const options::Spec<SubmitChoices> spec{
        option("plan", &SubmitChoices::plan, kind::file, "The plan: a file that ombre plan wrote", "PLAN").required(),
        choice("--to", &SubmitChoices::to, names_in(engines()), "The engine that begins the processes", "ENGINE")
            .required(),
        flag("--print", &SubmitChoices::prints, "Print the script, and do nothing else"),
        option("-o,--output", &SubmitChoices::output, kind::file,
               "The script to write (default: the plan's name, .slurm.sh for example)", "FILE"),
        option("--cores", &SubmitChoices::cores, kind::whole, "Cores of each process", "N").between(1, most),
        option("--minutes", &SubmitChoices::minutes, kind::whole,
               "Time after which the engine ends a share; minutes (default: 10, and 3 times the plan's estimate)", "N")
            .between(1, most),
        option("--memory", &SubmitChoices::memory_mib, kind::whole,
               "Memory of each process; MiB (default: 512, and 1.5 times the plan's estimate)", "N")
            .between(1, 1e9),
        option("--attempts", &SubmitChoices::attempts, kind::whole, "How often a share is begun that fails", "N")
            .between(1, 100),
        option("--image", &SubmitChoices::image, kind::text, "Image of the containers (kubernetes)", "IMAGE"),
        option("--claim", &SubmitChoices::claim, kind::text,
               "Claim of the volume with the plan, the design and its files (kubernetes)", "NAME"),
        flag("--force", &SubmitChoices::force, "Replace an existing script")};
    return spec;
  }
};

const Engine& engine_of(const SubmitChoices& a) {
  const Engine& engine = *std::ranges::find(engines(), a.to, &Engine::name);
  if (engine.has_own_folder && (a.image.empty() || a.claim.empty()))
    throw WrongArgument(spelled::option("--to", engine.name) + " needs " + spelled::option("--image", "IMAGE") +
                        ", which holds ombre, and " + spelled::option("--claim", "NAME") +
                        ", the volume with the plan, the design and its files");
  if (!engine.has_own_folder && !(a.image.empty() && a.claim.empty()))
    throw WrongArgument(spelled::option("--image") + " and " + spelled::option("--claim") + " are for " +
                        spelled::option("--to", "kubernetes"));
  return engine;
}

Submission submission_of(const SubmitChoices& a, const SharedPlan& plan) {
  constexpr double seconds_in_minute = 60, bytes_in_mib = 1 << 20;
  const double slowest = *std::ranges::max_element(plan.seconds) / a.cores;
  if (slowest == 0 && !a.minutes)
    throw WrongArgument("how long the shares take is not known; write for example " +
                        spelled::option("--minutes", "30"));
  if (plan.memory_bytes == 0 && !a.memory_mib)
    throw WrongArgument("how much memory they take is not known; write for example " +
                        spelled::option("--memory", "4096"));
  Submission made;
  made.plan = a.plan;
  made.folder = std::filesystem::current_path().string();
  made.shares = static_cast<int64_t>(plan.shards.size());
  made.has_stages = plan.has_stages;
  made.cores = a.cores;
  made.minutes = a.minutes.value_or(static_cast<int>(std::min(1e6, 10 + std::ceil(3 * slowest / seconds_in_minute))));
  made.memory_mib =
      a.memory_mib.value_or(static_cast<int>(std::min(1e9, 512 + std::ceil(1.5 * plan.memory_bytes / bytes_in_mib))));
  made.attempts = a.attempts;
  made.image = a.image;
  made.claim = a.claim;
  return made;
}

// Returns the exit code of the script, which says itself what it does.
int run_script(const Engine& engine, const std::string& script, Session& session) {
  const auto there_is = [&](const std::string& program) {
    return OtherProgram{{"bash", "-c", "command -v \"$0\"", program}, "", "/dev/null", {}, SIGTERM}
               .run(nullptr)
               .value_or(1) == 0;
  };
  if (!there_is(engine.program))
    throw Error(Code::other_program, "there is no " + engine.program + " here; " + script +
                                         " is the script: where there is, run " + engine.starter + " " + script);
  const OtherProgram program{{engine.starter, script}, "", "", {}, SIGTERM};
  const int status = program.run(&session.stop).value_or(-1);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return done;
  throw Error(Code::other_program,
              script + " failed" +
                  (WIFEXITED(status) ? " with the exit code " + std::to_string(WEXITSTATUS(status)) : "") +
                  "; it may be changed, and run again by " + engine.starter + " " + script);
}

int submit(const SubmitChoices& a, Session& session) {
  const Engine& engine = engine_of(a);
  Diagnostics diagnostics;
  const auto plan = read_plan(make_source(a.plan, formats::read_file(a.plan)), diagnostics);
  session.events.diagnose(diagnostics);
  if (!plan) return wrong_input;
  const std::string script = engine.script(submission_of(a, *plan));
  if (a.prints) {
    session.events.print(script);
    return done;
  }
  const std::string output =
      a.output.empty() ? std::filesystem::path(a.plan).replace_extension().string() + engine.ending : a.output;
  refuse_to_overwrite(output, a.force);
  exporting::write_file(output, script);
  session.events.say("the script is " + output);
  session.events.event("submission", {{"file", output}, {"engine", engine.name}});
  return run_script(engine, output, session);
}

}  // namespace

JobKind submit_kind() {
  return job_kind<SubmitChoices>("submit", "Hand the shares of a plan to Slurm, Kubernetes, GNU parallel or Dask",
                                 submit_footer, submit);
}

}  // namespace ombre::jobs
