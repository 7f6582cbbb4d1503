#include "jobs/common/job_design.h"

#include "base/text/file_ending.h"
#include "load/turned.h"

namespace ombre::jobs {

std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling, const Session& session,
                                                 Diagnostics& diagnostics, const compile::ImageOptions& images) {
  return compile::plan_options(session.program, sampling, images, diagnostics);
}

std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling,
                                                 const compile::WorkOptions& work, const Session& session,
                                                 Diagnostics& diagnostics, const compile::ImageOptions& images) {
  auto options = plan_options(sampling, session, diagnostics, images);
  if (!options) return std::nullopt;
  options->threads = work.threads;
  options->memory_bytes = work.memory_bytes;
  options->stop = &session.stop;
  return options;
}

compile::LoadedPtr load_design(const DesignArguments& a, Session& session, Diagnostics& diagnostics, int threads) {
  if (!a.material_map.empty() && ending_of(a.design) == ".py")
    throw WrongArgument(spelled::option("--material-map") + " is for OpenSCAD scripts; " + a.design +
                        " is a Python script, which names its materials itself");
  compile::LoadOptions options = a.load();
  options.echo = [&](const std::string& text) { session.events.say(text); };
  options.stop = &session.stop;
  options.threads = threads;
  options.cache = &session.cache;
  const auto quits = session.quit_at_once();
  const compile::LoadedPtr loaded = session.load(a.design, options, diagnostics);
  return loaded ? compile::turned(loaded, a.rotate.value_or(Vec3{}), diagnostics) : nullptr;
}

}  // namespace ombre::jobs
