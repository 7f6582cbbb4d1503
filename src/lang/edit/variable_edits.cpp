// Edits of variables: new ones, their names, and what uses them.
#include <algorithm>

#include "base/text/text.h"
#include "lang/edit/edit_run.h"

namespace ombre::lang {

using namespace ast;

void EditRun::run(const AddVariable& edit) {
  const std::string name = checked_new_name(edit.name), value = checked_value(edit.value);
  const TextLayout lines = layout();
  const size_t place = place_of_variables();
  const bool has_line = lines.line_begin(place) == place;
  const std::string before = has_line ? "" : lines.newline();
  commit({{place, place, before + name + " = " + value + ";" + lines.newline()}}, place + before.size());
}

// Returns the line behind the last variable or library of the top level, else that of the first statement.
size_t EditRun::place_of_variables() const {
  const TextLayout lines = layout();
  const auto& statements = graph_.file().statements;
  for (size_t n = statements.size(); n-- > 0;) {
    const Statement& one = *statements[n];
    if (one.kind != Statement::Kind::assign && one.kind != Statement::Kind::include) continue;
    const size_t behind = lines.behind_comment(end_of(one));
    return lines.is_last_on_line(behind) ? lines.next_line(behind) : lines.line_begin(begin_of(one));
  }
  return statements.empty() ? graph_.text().size() : lines.above_comments(begin_of(*statements.front()));
}

void EditRun::run(const RenameVariable& edit) {
  const GraphItem& renamed = open_statement(edit.item);
  if (renamed.kind != Kind::variable) refuse(renamed.span, "only variables have names here");
  if (trim(edit.name) == renamed.variable) return;
  const std::string name = checked_new_name(edit.name);
  Replacements step;
  for (const GraphItem& other : graph_.items()) {
    if (other.kind != Kind::variable || other.variable != renamed.variable || other.parent != renamed.parent) continue;
    const Span& old = static_cast<const Assign&>(*other.statement).name.span;
    step.push_back({old.begin, old.end, name});
  }
  const std::optional<size_t> meant = graph_.find(renamed.variable, renamed.parent);
  for (const Mention& mention : graph_.mentions()) {
    if (mention.target != meant) continue;
    if (mention.is_bare_text)
      refuse(mention.span, "the text \"" + mention.name + "\" may mean this variable",
             "edit line " + std::to_string(line(mention.span)));
    step.push_back({mention.span.begin, mention.span.end, name});
  }
  commit(std::move(step));
}

void EditRun::run(const ConnectItems& edit) {
  size_t from = edit.from, to = edit.to.item;
  open_item(to);
  const Kind kind = open_item(from).kind;
  if (kind == Kind::call)
    refuse(item(from).span, "a solid goes into the braces of a call", "move it there, or give it a name");
  if (graph_.is_within(to, from)) refuse(item(to).span, "a value cannot depend on itself");
  if (kind == Kind::value) from = as_variable(from, to);
  const std::string name = item(from).variable;
  const size_t user = graph_.statement_of(to);
  if (graph_.find(name, item(user).parent) != from)
    refuse(item(from).span, '"' + name + "\" is not known in line " + std::to_string(line(item(to).span)),
           "put it before the braces");
  if (item(user).kind == Kind::variable) {
    if (needs(from, user)) refuse(item(to).span, '"' + item(user).variable + "\" would depend on itself");
    to += move_up(from, user);
  }
  SetArgument set = edit.to;
  set.item = to;
  set.value = name + (edit.output.empty() ? "" : "." + edit.output);
  run(set);
}

// Returns the place before the statement of an item at the top level, with the comments above it.
size_t EditRun::place_before(size_t number) const {
  size_t top = graph_.statement_of(number);
  while (item(top).parent) top = *item(top).parent;
  return layout().above_comments(begin_of(*item(top).statement));
}

// Makes a variable of a call in an expression. Returns its number, and corrects that of another item.
size_t EditRun::as_variable(size_t value, size_t& other) {
  for (const Mention& mention : graph_.mentions())
    if (mention.item != ScriptGraph::no_item && graph_.is_within(mention.item, value) && mention.target &&
        item(*mention.target).parent)
      refuse(mention.span, '"' + mention.name + "\" is known within its braces alone",
             "edit line " + std::to_string(line(mention.span)));
  const Span span = item(value).span;
  const std::string name = free_name(item(value).callee + "_values");
  const size_t place = place_before(value), count = graph_.end_of(value) - value;
  size_t made = 0;
  while (graph_.items()[made].span.begin < place) ++made;
  const TextLayout lines = layout();
  const std::string text(graph_.text(span));
  commit({{place, place, name + " = " + text + ";" + lines.newline()}, {span.begin, span.end, name}});
  if (other >= made && other < value) other += count;
  return made;
}

// True if the statement of an item uses a variable, by way of others too.
bool EditRun::needs(size_t used, size_t variable) const {
  std::vector<size_t> found{used};
  for (size_t n = 0; n < found.size(); ++n) {
    if (found[n] == variable) return true;
    for (const Mention& mention : graph_.mentions()) {
      const bool is_inside = mention.item != ScriptGraph::no_item && graph_.is_within(mention.item, found[n]);
      if (is_inside && mention.target && std::ranges::find(found, *mention.target) == found.end())
        found.push_back(*mention.target);
    }
  }
  return false;
}

// Puts a variable, and those that it uses, before another one that uses it. Returns the count of items that came there.
size_t EditRun::move_up(size_t variable, size_t before) {
  const TextLayout lines = layout();
  const size_t user = begin_of(*item(before).statement), place = lines.above_comments(user);
  const std::string indent = lines.indent_of(user);
  Replacements step{{place, place, ""}};
  size_t count = 0;
  for (size_t n = before + 1; n <= variable; ++n) {
    const GraphItem& late = item(n);
    if (late.kind != Kind::variable || late.parent != item(before).parent || !needs(variable, n)) continue;
    const size_t begin = begin_of(*late.statement), end = end_with_comment(*late.statement);
    if (!lines.is_first_on_line(user) || !lines.is_first_on_line(begin) || !lines.is_last_on_line(end))
      refuse(late.span, '"' + late.variable + "\" stands behind what uses it, on a line with others",
             "edit line " + std::to_string(line(late.span)));
    step.front().text += indent + std::string(lines.between(begin, end)) + lines.newline();
    step.push_back({lines.line_begin(begin), lines.next_line(end), ""});
    count += graph_.end_of(n) - n;
  }
  if (count > 0) commit(std::move(step));
  return count;
}

}  // namespace ombre::lang
