// `ombre operators` lists the operators of libraries.
#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/reference/list_or_page.h"
#include "jobs/reference/operator_text.h"

namespace ombre::jobs {
namespace {

struct OperatorsChoices {
  std::string name;
  ListChoices list;

  static const options::Spec<OperatorsChoices>& options() {
    using namespace options;
    static const options::Spec<OperatorsChoices> spec{
        option("operator", &OperatorsChoices::name, kind::text, "An operator's name", "NAME"),
        group(&OperatorsChoices::list)};
    return spec;
  }
};

int show_operators(const OperatorsChoices& a, Session& session) {
  if (a.list.markdown || a.name.empty()) return list_or_print<list_operators, operators_reference>(a.list, session);
  if (show_operator(a.name, session)) return done;
  const std::string hint = did_you_mean(a.name, names_with_operators({}));
  throw WrongArgument("there is no operator \"" + a.name + "\"; " +
                      (hint.empty() ? "ombre operators lists them" : hint));
}

}  // namespace

JobKind operators_kind() {
  return job_kind<OperatorsChoices>("operators", "List the operators of libraries, or explain one",
                                    "Examples:\n  ombre operators\n  ombre operators honeycomb_walls\n",
                                    show_operators);
}

}  // namespace ombre::jobs
