// Jobs that print a list, which is also a page of the reference.
#pragma once

#include <string>
#include <utility>

#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

struct PageChoices {
  bool markdown = false;

  static const options::Spec<PageChoices>& options() {
    using namespace options;
    static const options::Spec<PageChoices> spec{
        flag("--markdown", &PageChoices::markdown, "Print the whole reference")};
    return spec;
  }
};

template <void (*list)(const Session& session), std::string (*page)()>
JobKind page_kind(const std::string& name, std::string help) {
  const auto run = [](const PageChoices& a, Session& session) -> int {
    if (a.markdown)
      session.events.print(page());
    else
      list(session);
    return done;
  };
  return job_kind<PageChoices>(name, std::move(help), "Example:\n  ombre " + name + "\n", run);
}

}  // namespace ombre::jobs
