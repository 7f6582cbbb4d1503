// `ombre operators` lists the operators of libraries.
#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/reference/list_or_page.h"
#include "jobs/reference/operator_text.h"

namespace ombre::jobs {
namespace {

constexpr OneThing one_operator{"operator", "An operator's name"};

int show_known_operator(const std::string& name, Session& session) {
  if (show_operator(name, session)) return done;
  const std::string hint = did_you_mean(name, names_with_operators({}));
  throw WrongArgument("there is no operator \"" + name + "\"; " + (hint.empty() ? "ombre operators lists them" : hint));
}

}  // namespace

JobKind operators_kind() {
  return one_or_all_kind<one_operator, show_known_operator, list_operators, operators_reference>(
      "operators", "List the operators of libraries, or explain one",
      "Examples:\n  ombre operators\n  ombre operators honeycomb_walls\n");
}

}  // namespace ombre::jobs
