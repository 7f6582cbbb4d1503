// Edits of the arguments of calls, and of the values of variables.
#include "base/text/text.h"
#include "lang/edit/edit_run.h"

namespace ombre::lang {

using namespace ast;

void EditRun::run(const SetArgument& edit) {
  const GraphItem& of = open_item(edit.item);
  if (edit.index && *edit.index >= of.arguments.size())
    refuse(of.span, "this call has no argument with the number " + std::to_string(*edit.index));
  if (trim(edit.value).empty()) {
    if (!edit.index) return;
    return remove_argument(of, *edit.index);
  }
  const std::string value = checked_value(edit.value);
  if (!edit.index) return add_argument(of, edit.name, value);
  const Span& old = of.arguments[*edit.index].value->span;
  if (graph_.text(old) != value) commit({{old.begin, old.end, value}});
}

namespace {

bool takes_arguments(const GraphItem& item) { return item.kind != GraphItem::Kind::variable || !item.callee.empty(); }

// Returns the end of what is called.
size_t end_of_name(const GraphItem& item) {
  if (item.kind == GraphItem::Kind::call) return static_cast<const CallStatement&>(*item.statement).name.span.end;
  return static_cast<const Call&>(*item.expression).callee->span.end;
}

}  // namespace

void EditRun::remove_argument(const GraphItem& of, size_t index) {
  if (!takes_arguments(of)) refuse(of.span, "a variable has a value", "remove the variable");
  const GraphArgument& removed = of.arguments[index];
  const bool is_last = index + 1 == of.arguments.size();
  if (removed.name.empty() && !is_last && of.arguments[index + 1].name.empty())
    refuse(removed.whole, "the values behind this one have no names, and would take its place",
           "edit line " + std::to_string(line(removed.whole)));
  const TextLayout lines = layout();
  if (!is_last) {
    const size_t next = of.arguments[index + 1].whole.begin;
    const size_t comma = lines.skip_blank(removed.whole.end);
    const bool has_comment = !lines.is_blank(comma + 1, next);
    return commit({{removed.whole.begin, has_comment ? comma + 1 : next, ""}});
  }
  if (index == 0) return commit({{removed.whole.begin, removed.whole.end, ""}});
  const size_t before = of.arguments[index - 1].whole.end;
  const size_t comma = lines.skip_blank(before);
  if (lines.is_blank(comma + 1, removed.whole.begin)) return commit({{comma, removed.whole.end, ""}});
  commit({{comma, comma + 1, ""}, {removed.whole.begin, removed.whole.end, ""}});
}

void EditRun::add_argument(const GraphItem& to, const std::string& name, const std::string& value) {
  if (!takes_arguments(to)) refuse(to.span, "a variable has one value");
  const std::string argument = (name.empty() ? "" : name + " = ") + value;
  if (!name.empty()) {
    for (const GraphArgument& other : to.arguments)
      if (other.name == name) refuse(other.whole, "\"" + name + "\" has a value already");
  }
  const TextLayout lines = layout();
  if (!to.arguments.empty()) {
    const Span& last = to.arguments.back().whole;
    const std::string gap =
        lines.is_first_on_line(last.begin) ? lines.newline() + lines.indent_of(last.begin) : std::string(" ");
    return commit({{last.end, last.end, "," + gap + argument}});
  }
  const size_t end = end_of_name(to), open = lines.skip_blank(end);
  if (lines.at(open) == '(') return commit({{open + 1, open + 1, argument}});
  commit({{end, end, "(" + argument + ")"}});
}

}  // namespace ombre::lang
