// Makes a module of calls.
#include <algorithm>
#include <set>

#include "base/text/text.h"
#include "lang/edit/edit_run.h"

namespace ombre::lang {

using namespace ast;

void EditRun::run(const GroupCalls& edit) {
  std::vector<size_t> row = edit.items;
  std::ranges::sort(row);
  row.erase(std::unique(row.begin(), row.end()), row.end());
  check_row(row);
  const std::string module = module_text(edit, row);
  const size_t place = place_before(row.front());
  const size_t begin = begin_of(*item(row.front()).statement), end = end_of(*item(row.back()).statement);
  const std::string call = std::string(trim(edit.name)) + "();";
  const size_t grown = module.size();
  commit({{place, place, module}, {begin, end, call}}, begin + grown);
}

// Refuses calls that do not follow each other, and those that use variables of the braces around them.
void EditRun::check_row(const std::vector<size_t>& row) const {
  if (row.empty()) refuse({}, "a group has at least one call");
  for (size_t n = 0; n < row.size(); ++n) {
    const GraphItem& one = open_statement(row[n]);
    if (one.kind == Kind::variable || one.callee == "module") refuse(one.span, "a group has calls of solids alone");
    if (n == 0) continue;
    if (one.container != item(row.front()).container || one.parent != item(row.front()).parent ||
        graph_.end_of(row[n - 1]) != row[n])
      refuse(one.span, "the calls of a group follow each other within the same braces", "move them together first");
  }
  for (const Mention& mention : graph_.mentions()) {
    const bool is_inside = mention.item != ScriptGraph::no_item &&
                           std::ranges::any_of(row, [&](size_t one) { return graph_.is_within(mention.item, one); });
    if (!is_inside || !mention.target) continue;
    const std::optional<size_t>& scope = item(*mention.target).parent;
    if (scope && std::ranges::none_of(row, [&](size_t one) { return graph_.is_within(*scope, one); }))
      refuse(mention.span, '"' + mention.name + "\" is known within its braces alone",
             "edit line " + std::to_string(line(mention.span)));
  }
}

std::string EditRun::module_text(const GroupCalls& edit, const std::vector<size_t>& row) const {
  const std::string name = checked_new_name(edit.name);
  const TextLayout lines = layout();
  const size_t begin = begin_of(*item(row.front()).statement), end = end_of(*item(row.back()).statement);
  const std::string newline = lines.newline();
  Replacements inside;
  std::set<std::string> names{name};
  std::string parameters;
  for (const GroupCalls::Parameter& parameter : edit.parameters) {
    const GraphItem& of = open_item(parameter.item);
    if (of.span.begin < begin || of.span.end > end || parameter.argument >= of.arguments.size())
      refuse(of.span, "a parameter of the group is an argument of one of its calls");
    const std::string own = checked_name(parameter.name);
    for (const Mention& mention : graph_.mentions())
      if (mention.name == own && mention.span.begin >= begin && mention.span.end <= end)
        refuse(mention.span, '"' + own + "\" means something else in the group", "choose another name");
    if (!names.insert(own).second)
      refuse(of.span, "two parameters have the name \"" + own + '"', "choose another name");
    const Span& value = of.arguments[parameter.argument].value->span;
    inside.push_back({value.begin - begin, value.end - begin, own});
    parameters.append(parameters.empty() ? "" : ",").append(newline).append(step_in).append(own).append(" = ");
    parameters += graph_.text(value);
  }
  for (Replacement& one : lines.reindent(begin, end, lines.indent_of(begin), step_in))
    inside.push_back({one.from - begin, one.to - begin, one.text});
  sort_by_place(inside);
  for (size_t n = 1; n < inside.size(); ++n)
    if (inside[n].from < inside[n - 1].to)
      refuse({}, "one parameter of the group lies within another", "choose one of them");
  const std::string body =
      applied(lines.between(begin, end), inside) + (is_closed(*item(row.back()).statement) ? "" : ";");
  const std::string sentence(trim(edit.sentence));
  if (sentence.find_first_of(line_ends) != std::string::npos) refuse({}, "the sentence of a group has one line");
  return (sentence.empty() ? "" : "/// " + sentence + newline) + "module " + name + "(" + parameters +
         (parameters.empty() ? "" : newline) + ") {" + newline + step_in + body + newline + "}" + newline;
}

}  // namespace ombre::lang
