#include "lang/edit/edit_run.h"

#include <algorithm>

#include "base/text/text.h"
#include "lang/syntax/parser.h"

namespace ombre::lang {

using namespace ast;

namespace {

// Returns the only statement of a file, or null.
const Statement* only_statement(const File& file, const Diagnostics& mistakes) {
  return mistakes.has_errors() || file.statements.size() != 1 ? nullptr : file.statements.front().get();
}

}  // namespace

std::optional<EditedScript> edit(const SourcePtr& script, Dialect dialect, const GraphEdit& edit,
                                 Diagnostics& diagnostics) {
  return make_edit<EditRun>(ScriptGraph::read(script, dialect, diagnostics), edit, diagnostics);
}

void EditRun::refuse(const Span& where, const std::string& message, Phrase hint) const {
  refuse_at(where.source ? where.range() : SourceRange(), message, std::move(hint));
}

const GraphItem& EditRun::item(size_t number) const {
  if (number >= graph_.items().size()) refuse({}, "the script has no call with the number " + std::to_string(number));
  return graph_.items()[number];
}

const GraphItem& EditRun::open_item(size_t number) const {
  const GraphItem& found = item(number);
  check_place(found);
  if (found.kind == Kind::group)
    refuse(found.span, '"' + found.callee + "\" is edited as text", "edit line " + std::to_string(line(found.span)));
  return found;
}

const GraphItem& EditRun::open_statement(size_t number) const {
  const GraphItem& found = item(number);
  check_place(found);
  if (!found.statement)
    refuse(found.span, "this call is part of an expression", "edit line " + std::to_string(line(found.span)));
  return found;
}

void EditRun::check_place(const GraphItem& found) const {
  if (!found.is_locked()) return;
  refuse(found.span, "this is made by " + found.locked_by, "edit line " + std::to_string(line(found.span)));
}

// Modifiers stand before the span of a statement.
size_t EditRun::begin_of(const Statement& statement) const {
  size_t begin = statement.span.begin;
  if (statement.modifiers.empty()) return begin;
  const std::string_view text = graph_.text();
  Modifiers found;
  for (size_t at = begin; at > 0; --at) {
    const char before = text[at - 1];
    if (std::string_view("*!#%").find(before) != std::string_view::npos) {
      found.add(before);
      begin = at - 1;
    } else if (std::string_view(" \t\r\n").find(before) == std::string_view::npos) {
      break;
    }
  }
  if (found.text().size() != statement.modifiers.text().size())
    refuse(statement.span, "a comment stands between a call and its modifier",
           "edit line " + std::to_string(line(statement.span)));
  return begin;
}

// The spans of assignments and functions end before their ";".
size_t EditRun::end_of(const Statement& statement) const {
  const size_t end = statement.span.end;
  if (statement.kind != Statement::Kind::assign && statement.kind != Statement::Kind::function) return end;
  const size_t next = layout().skip_blank(end);
  return layout().at(next) == ';' ? next + 1 : end;
}

size_t EditRun::end_with_comment(const Statement& statement) const {
  const size_t end = end_of(statement);
  return layout().is_first_on_line(begin_of(statement)) ? layout().behind_comment(end) : end;
}

// The last statement before "}" may lack its ";".
bool EditRun::is_closed(const Statement& statement) const {
  const char last = layout().at(end_of(statement) - 1);
  return last == ';' || (last == '}' && statement.kind != Statement::Kind::assign);
}

void EditRun::close(const Statement& statement, Replacements& step) const {
  const size_t end = end_of(statement);
  if (!is_closed(statement)) step.push_back({end, end, ";"});
}

bool EditRun::is_only_child_without_braces(const GraphItem& found) const {
  return found.container && !found.container->has_braces;
}

std::string EditRun::text_of(const Statement& statement, const std::string& indent, bool takes_comment) const {
  const size_t begin = begin_of(statement), end = end_of(statement);
  const TextLayout lines = layout();
  Replacements moved = lines.reindent(begin, end, lines.indent_of(begin), indent);
  for (Replacement& one : moved) {
    one.from -= begin;
    one.to -= begin;
  }
  const size_t behind = takes_comment ? end_with_comment(statement) : end;
  return applied(lines.between(begin, end), moved) + (is_closed(statement) ? "" : ";") +
         std::string(lines.between(end, behind));
}

std::string EditRun::checked_value(const std::string& value) const {
  const std::string text(trim(value));
  constexpr std::string_view before = "_=";
  Diagnostics mistakes;
  const File file = parse(make_source("", std::string(before) + text + "\n;"), mistakes, graph_.dialect());
  const Statement* statement = only_statement(file, mistakes);
  const bool is_value = statement && statement->kind == Statement::Kind::assign &&
                        static_cast<const Assign&>(*statement).value->span.end == before.size() + text.size();
  if (!is_value) refuse({}, '"' + text + "\" is no value", "write for example 5, [1, 2, 3], \"red\" or size / 2");
  return text;
}

std::string EditRun::checked_call(const std::string& call, bool may_hold_children) const {
  std::string text(trim(call));
  while (text.ends_with(';')) text = trim(std::string_view(text).substr(0, text.size() - 1));
  Diagnostics mistakes;
  const File file = parse(make_source("", text + "\n;"), mistakes, graph_.dialect());
  const Statement* statement = only_statement(file, mistakes);
  const bool is_call =
      statement && statement->kind == Statement::Kind::call && statement->modifiers.empty() && !text.empty();
  if (!is_call) refuse({}, '"' + text + "\" is no call", "write for example sphere(5)");
  const auto& made = static_cast<const CallStatement&>(*statement);
  const bool ends_with_head = made.whole.end == text.size();
  if (!ends_with_head && !may_hold_children)
    refuse({}, '"' + text + "\" has children already", "write for example translate([1, 0, 0])");
  return text;
}

std::string EditRun::checked_name(const std::string& name) const {
  const std::string text(trim(name));
  Diagnostics mistakes;
  const File file = parse(make_source("", text + "=1;"), mistakes, graph_.dialect());
  const Statement* statement = only_statement(file, mistakes);
  if (!statement || statement->kind != Statement::Kind::assign || statement->span.begin != 0 ||
      static_cast<const Assign&>(*statement).name.text() != text)
    refuse({}, '"' + text + "\" is no name", "names have letters, digits and \"_\"");
  return text;
}

std::string EditRun::checked_new_name(const std::string& name) const {
  std::string text = checked_name(name);
  const auto& mentions = graph_.mentions();
  const auto used = std::ranges::find(mentions, text, &Mention::name);
  if (used != mentions.end())
    refuse(used->span, '"' + text + "\" is used in line " + std::to_string(line(used->span)), "choose another name");
  for (const GraphItem& other : graph_.items())
    if (other.variable == text)
      refuse(other.span, '"' + text + "\" is there already, in line " + std::to_string(line(other.span)),
             "choose another name");
  if (graph_.file().names->contains(text)) refuse({}, '"' + text + "\" is used in the script", "choose another name");
  return text;
}

// Returns the wanted name, with a number if it is taken.
std::string EditRun::free_name(const std::string& wanted) const {
  const auto is_free = [&](const std::string& name) {
    return !graph_.file().names->contains(name) &&
           std::ranges::find(graph_.mentions(), name, &Mention::name) == graph_.mentions().end();
  };
  std::string name = wanted;
  for (int n = 2; !is_free(name); ++n) name = wanted + std::to_string(n);
  return name;
}

}  // namespace ombre::lang
