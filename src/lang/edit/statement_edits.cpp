// Edits that insert, remove and move calls.
#include <algorithm>

#include "base/text/text.h"
#include "lang/edit/edit_run.h"

namespace ombre::lang {

using namespace ast;

namespace {

const CallStatement& call_of(const GraphItem& item) { return static_cast<const CallStatement&>(*item.statement); }

bool defines(const Statement& statement) {
  return statement.kind == Statement::Kind::assign || statement.kind == Statement::Kind::function ||
         statement.kind == Statement::Kind::module;
}

}  // namespace

void EditRun::run(const InsertCall& edit) {
  using Where = InsertCall::Where;
  const std::string call = checked_call(edit.call, edit.where != Where::around);
  const std::string statement = call.ends_with('}') ? call : call + ";";
  if (edit.where == Where::end) return insert_at_end(statement);
  if (edit.where == Where::inside) return insert_inside(edit.item, statement);
  if (edit.where == Where::after) return insert_after(edit.item, statement);
  const GraphItem& inner = open_statement(edit.item);
  if (inner.kind == Kind::variable || inner.callee == "module")
    refuse(inner.span, "only solids have calls around them");
  const size_t begin = inner.kind == Kind::call ? inner.span.begin : begin_of(*inner.statement);
  commit({{begin, begin, call + " "}}, begin);
}

void EditRun::insert_at_end(const std::string& statement) {
  const TextLayout lines = layout();
  const size_t end = graph_.text().size();
  const bool has_line = end > 0 && lines.line_begin(end) != end;
  const std::string before = has_line ? lines.newline() : "";
  commit({{end, end, before + statement + lines.newline()}}, end + before.size());
}

void EditRun::insert_inside(size_t into, const std::string& statement) {
  const GraphItem& parent = open_item(into);
  if (parent.kind != Kind::call) refuse(parent.span, "only calls of solids have children");
  const Block& block = call_of(parent).children;
  if (block.has_braces) return insert_in_braces(parent, block, statement);
  if (block.statements.empty()) return insert_first_child(parent, statement);
  insert_beside_only_child(parent, statement);
}

void EditRun::insert_in_braces(const GraphItem& parent, const Block& block, const std::string& statement) {
  const TextLayout lines = layout();
  const size_t close_at = parent.span.end - 1;
  const std::string outer = lines.indent_of(begin_of(*parent.statement)), newline = lines.newline();
  if (block.statements.empty() && !lines.is_first_on_line(close_at)) {
    const size_t gap = lines.before_blanks(close_at);
    const std::string before = newline + outer + step_in;
    return commit({{gap, close_at, before + statement + newline + outer}}, gap + before.size());
  }
  std::string indent = outer + step_in;
  Replacements step;
  if (!block.statements.empty()) {
    const Statement& last = *block.statements.back();
    close(last, step);
    if (lines.is_first_on_line(begin_of(last))) indent = lines.indent_of(begin_of(last));
  }
  const size_t grown = step.empty() ? 0 : 1;
  if (lines.is_first_on_line(close_at)) {
    const size_t begin = lines.line_begin(close_at);
    step.push_back({begin, begin, indent + statement + newline});
    return commit(std::move(step), begin + indent.size() + grown);
  }
  const size_t end = end_of(*block.statements.back());
  const bool ends_with_comment = !statement.ends_with(';') && !statement.ends_with('}');
  const std::string before = ends_with_comment ? newline + indent : " ";
  step.push_back({end, end, before + statement + (ends_with_comment ? newline + outer : "")});
  commit(std::move(step), end + before.size() + grown);
}

void EditRun::insert_first_child(const GraphItem& parent, const std::string& statement) {
  const TextLayout lines = layout();
  const std::string outer = lines.indent_of(begin_of(*parent.statement)), newline = lines.newline();
  const bool is_ended = parent.span.end > call_of(parent).whole.end;
  const size_t end = is_ended ? parent.span.end - 1 : parent.span.end;
  const std::string before = " {" + newline + outer + step_in;
  commit({{end, parent.span.end, before + statement + newline + outer + "}"}}, end + before.size());
}

// Puts braces around the only child, and the statement behind it.
void EditRun::insert_beside_only_child(const GraphItem& parent, const std::string& statement) {
  const TextLayout lines = layout();
  const Statement& child = *call_of(parent).children.statements.front();
  const size_t head = call_of(parent).whole.end, begin = begin_of(child), end = end_of(child);
  const std::string outer = lines.indent_of(begin_of(*parent.statement)), inner = outer + step_in;
  const std::string newline = lines.newline();
  Replacements step;
  const bool is_on_line = lines.is_blank(head, begin) && !lines.is_first_on_line(begin);
  if (is_on_line) {
    step.push_back({head, begin, " {" + newline + inner});
    for (Replacement& one : lines.reindent(begin, end, outer, inner)) step.push_back(std::move(one));
  } else {
    step.push_back({head, head, " {"});
  }
  close(child, step);
  const size_t behind = lines.behind_comment(end);
  const std::string own = is_on_line ? inner : lines.indent_of(begin);
  step.push_back({behind, behind, newline + own + statement + newline + outer + "}"});
  commit(std::move(step));
}

void EditRun::insert_after(size_t after, const std::string& statement) {
  const GraphItem& before = open_statement(after);
  if (is_only_child_without_braces(before)) return insert_inside(*before.parent, statement);
  const TextLayout lines = layout();
  const size_t end = end_of(*before.statement), behind = lines.behind_comment(end);
  Replacements step;
  close(*before.statement, step);
  const std::string gap =
      lines.is_last_on_line(behind) ? lines.newline() + lines.indent_of(begin_of(*before.statement)) : std::string(" ");
  const size_t made = behind + gap.size() + step.size();
  step.push_back({behind, behind, gap + statement});
  commit(std::move(step), made);
}

void EditRun::run(const RemoveItem& edit) {
  const GraphItem& removed = item(edit.item);
  check_place(removed);
  if (!removed.statement) {
    const GraphItem& owner = item(*removed.parent);
    const bool is_whole = owner.arguments.size() > removed.argument &&
                          owner.arguments[removed.argument].value == removed.expression && owner.kind != Kind::variable;
    if (!is_whole)
      refuse(removed.span, "this call is part of an expression", "edit line " + std::to_string(line(removed.span)));
    return remove_argument(owner, removed.argument);
  }
  if (removed.kind == Kind::variable) check_unused(edit.item);
  const bool has_children = removed.kind == Kind::call && !call_of(removed).children.statements.empty();
  if (edit.keeps_children && has_children) return keep_children(removed);
  remove_statement(removed);
}

void EditRun::check_unused(size_t variable) const {
  for (const Mention& mention : graph_.mentions())
    if (mention.target == variable &&
        !graph_.is_within(mention.item == ScriptGraph::no_item ? variable : mention.item, variable))
      refuse(mention.span, '"' + mention.name + "\" is used in line " + std::to_string(line(mention.span)),
             "give that another value first");
}

// A comment behind the statement goes with it, if nothing stands before it on the line.
void EditRun::remove_statement(const GraphItem& removed) {
  const TextLayout lines = layout();
  const size_t begin = begin_of(*removed.statement);
  const size_t end = end_with_comment(*removed.statement);
  if (is_only_child_without_braces(removed)) {
    const size_t head = call_of(item(*removed.parent)).whole.end;
    return commit({{lines.is_blank(head, begin) ? head : begin, end_of(*removed.statement), ";"}});
  }
  if (lines.is_first_on_line(begin) && lines.is_last_on_line(end))
    return commit({{lines.line_begin(begin), lines.next_line(end), ""}});
  if (lines.is_first_on_line(begin)) return commit({{begin, lines.after_blanks(end), ""}});
  commit({{lines.before_blanks(begin), end, ""}});
}

// Removes a call, and leaves its children where it was.
void EditRun::keep_children(const GraphItem& removed) {
  const TextLayout lines = layout();
  const CallStatement& call = call_of(removed);
  const size_t begin = begin_of(call);
  const bool keeps_braces = call.children.has_braces && is_only_child_without_braces(removed);
  if (call.children.has_braces && !keeps_braces) return drop_braces(removed);
  size_t end = call.whole.end;
  const size_t next = lines.skip_blank(end);
  if (lines.is_blank(end, next)) end = next;
  Replacements step{{begin, end, ""}};
  const Statement& child = *call.children.statements.front();
  if (!keeps_braces && end == begin_of(child))
    for (Replacement& one : lines.reindent(end, end_of(child), lines.indent_of(end), lines.indent_of(begin)))
      step.push_back(std::move(one));
  commit(std::move(step));
}

void EditRun::drop_braces(const GraphItem& removed) {
  const TextLayout lines = layout();
  const CallStatement& call = call_of(removed);
  const std::vector<StatementPtr>& children = call.children.statements;
  for (const StatementPtr& child : children)
    if (defines(*child))
      refuse(child->span, "variables of these braces would become those of others",
             "edit line " + std::to_string(line(child->span)));
  const size_t begin = begin_of(call), close_at = call.span.end - 1;
  const size_t open = lines.skip_blank(call.whole.end);
  Replacements step;
  close(*children.back(), step);
  const bool has_own_line = lines.is_first_on_line(begin) && lines.is_last_on_line(open + 1);
  if (has_own_line && lines.is_blank(call.whole.end, open)) {
    step.push_back({lines.line_begin(begin), lines.next_line(open), ""});
    const Statement& first = *children.front();
    for (Replacement& one : lines.reindent(open, close_at, lines.indent_of(begin_of(first)), lines.indent_of(begin)))
      if (one.from < lines.line_begin(close_at)) step.push_back(std::move(one));
  } else {
    const size_t next = lines.after_blanks(open + 1);
    const bool is_blank = lines.is_blank(call.whole.end, open);
    step.push_back({begin, is_blank ? next : call.whole.end, ""});
    if (!is_blank) step.push_back({open, open + 1, ""});
  }
  const bool closes_alone = lines.is_first_on_line(close_at) && lines.is_last_on_line(close_at + 1);
  if (closes_alone)
    step.push_back({lines.line_begin(close_at), lines.next_line(close_at), ""});
  else
    step.push_back({lines.before_blanks(close_at), close_at + 1, ""});
  commit(std::move(step));
}

void EditRun::run(const MoveCall& edit) {
  const GraphItem& moved = open_statement(edit.item);
  if (moved.kind == Kind::variable || moved.callee == "module") refuse(moved.span, "only solids are moved");
  if (edit.into) {
    const GraphItem& parent = open_item(*edit.into);
    if (graph_.is_within(*edit.into, edit.item))
      refuse(moved.span, "a call cannot be a child of itself", "move it elsewhere");
    if (parent.kind != Kind::call) refuse(parent.span, "only calls of solids have children");
  }
  check_names(edit.item, edit.into);
  const std::string indent = edit.into ? layout().indent_of(begin_of(*item(*edit.into).statement)) + step_in : "";
  const std::string text = text_of(*moved.statement, indent, !is_only_child_without_braces(moved));
  const size_t count = graph_.end_of(edit.item) - edit.item;
  remove_statement(moved);
  if (!edit.into) return insert_at_end(text);
  insert_inside(*edit.into > edit.item ? *edit.into - count : *edit.into, text);
}

// Refuses if a name in the moved call would mean something else there.
void EditRun::check_names(size_t moved, std::optional<size_t> scope) const {
  for (const Mention& mention : graph_.mentions()) {
    if (!mention.target || mention.item == ScriptGraph::no_item || !graph_.is_within(mention.item, moved)) continue;
    if (graph_.is_within(*mention.target, moved) || graph_.find(mention.name, scope) == mention.target) continue;
    refuse(mention.span, '"' + mention.name + "\" means something else there",
           "edit line " + std::to_string(line(mention.span)));
  }
}

}  // namespace ombre::lang
