#include "ombre/job_arguments.h"

#include "load/turned.h"
#include "ombre/interrupt.h"

namespace ombre::cli {

std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling, Diagnostics& diagnostics,
                                                 const compile::ImageOptions& images) {
  return compile::plan_options("ombre " OMBRE_VERSION, sampling, images, diagnostics);
}

std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling,
                                                 const compile::WorkOptions& work, const Session& session,
                                                 Diagnostics& diagnostics, const compile::ImageOptions& images) {
  auto options = plan_options(sampling, diagnostics, images);
  if (!options) return std::nullopt;
  options->threads = work.threads;
  options->memory_bytes = work.memory_bytes;
  options->stop = &session.stop;
  return options;
}

compile::LoadedPtr load_design(const DesignArguments& a, Session& session, Diagnostics& diagnostics, int threads) {
  compile::LoadOptions options{a.materials, a.definitions, a.needed};
  options.echo = [&](const std::string& text) { session.console.say(text); };
  options.stop = &session.stop;
  options.threads = threads;
  options.cache = &session.cache;
  const QuitAtOnce quits;
  const compile::LoadedPtr loaded = session.load(a.design, options, diagnostics);
  return loaded ? compile::turned(loaded, a.rotate.value_or(Vec3{}), diagnostics) : nullptr;
}

}  // namespace ombre::cli
