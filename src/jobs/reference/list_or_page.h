// A kind of job lists things, or prints a page of the reference about them: options and output.
#pragma once

#include "jobs/common/job_kind.h"

namespace ombre::jobs {

struct ListChoices {
  bool markdown = false;

  static const options::Spec<ListChoices>& options() {
    static const options::Spec<ListChoices> spec{
        options::flag("--markdown", &ListChoices::markdown, "Print the whole reference")};
    return spec;
  }
};

template <void list(const Session& session), std::string page()>
int list_or_print(const ListChoices& a, Session& session) {
  if (a.markdown)
    session.events.print(page());
  else
    list(session);
  return done;
}

}  // namespace ombre::jobs
