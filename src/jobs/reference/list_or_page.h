// A kind of job lists things, or prints a page of the reference about them: options and output.
#pragma once

#include <string>

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

// The argument that names the one thing to show.
struct OneThing {
  const char* argument;
  const char* about;
};

template <const OneThing& thing>
struct OneOrAll {
  std::string name;
  ListChoices list;

  static const options::Spec<OneOrAll>& options() {
    using namespace options;
    static const options::Spec<OneOrAll> spec{option(thing.argument, &OneOrAll::name, kind::text, thing.about, "NAME"),
                                              group(&OneOrAll::list)};
    return spec;
  }
};

// Makes the kind that shows the thing with the given name, or lists all things, or prints their page.
template <const OneThing& thing, int show(const std::string& name, Session& session), void list(const Session& session),
          std::string page()>
JobKind one_or_all_kind(std::string name, std::string help, std::string footer) {
  const auto run = [](const OneOrAll<thing>& a, Session& session) {
    if (!a.list.markdown && !a.name.empty()) return show(a.name, session);
    return list_or_print<list, page>(a.list, session);
  };
  return job_kind<OneOrAll<thing>>(std::move(name), std::move(help), std::move(footer), run);
}

}  // namespace ombre::jobs
