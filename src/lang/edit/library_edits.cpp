// Edits about libraries: lines that use them, and modules that become one.
#include <algorithm>

#include "base/text/text.h"
#include "lang/edit/edit_run.h"

namespace ombre::lang {

using namespace ast;

void EditRun::run(const UseLibrary& edit) {
  if (edit.path.empty() || edit.path.find_first_of("<>\r\n\"") != std::string::npos)
    refuse({}, '"' + edit.path + "\" is no path of a library", "write for example ombre/cellular.vcad");
  const TextLayout lines = layout();
  std::optional<size_t> last;
  for (const StatementPtr& statement : graph_.file().statements) {
    if (statement->kind != Statement::Kind::include) continue;
    if (static_cast<const Include&>(*statement).path == edit.path) return;
    last = lines.next_line(statement->span.end);
  }
  const size_t place = last ? *last : lines.behind_first_comments();
  const bool has_line = lines.line_begin(place) == place;
  commit({{place, place, (has_line ? "" : lines.newline()) + "use <" + edit.path + ">" + lines.newline()}});
}

void EditRun::run(const MoveToLibrary& edit) {
  const Statement& moved = module_called(edit.module);
  check_alone(moved, edit.module);
  const TextLayout lines = layout();
  const size_t begin = lines.above_comments(begin_of(moved)), end = end_with_comment(moved);
  const std::string text(trim(lines.between(begin, end))), newline = lines.newline();
  const std::string sentence(trim(edit.sentence));
  if (sentence.find_first_of(line_ends) != std::string::npos) refuse({}, "the sentence of a library has one line");
  const bool is_declared = text.starts_with("///");
  result_.library =
      used_libraries() + (is_declared || sentence.empty() ? "" : "/// " + sentence + newline) + text + newline;
  const bool has_lines = lines.is_first_on_line(begin) && lines.is_last_on_line(end);
  commit({{has_lines ? lines.line_begin(begin) : begin, has_lines ? lines.next_line(end) : end, ""}});
  run(UseLibrary{edit.path});
}

const Statement& EditRun::module_called(const std::string& name) const {
  const Statement* found = nullptr;
  for (const StatementPtr& statement : graph_.file().statements) {
    if (statement->kind != Statement::Kind::module) continue;
    if (static_cast<const ModuleDef&>(*statement).name.text() != name) continue;
    if (found) refuse(statement->span, "the script has two modules \"" + name + '"', "remove one of them");
    found = statement.get();
  }
  if (!found) refuse({}, "the script has no module \"" + name + "\" outside of braces");
  return *found;
}

// Refuses a module that needs variables, functions or other modules of the script.
void EditRun::check_alone(const Statement& module, const std::string& name) const {
  if (graph_.is_cut()) refuse({}, "the script has too many calls to look for what \"" + name + "\" needs");
  const auto is_inside = [&](const Span& span) {
    return span.begin >= module.span.begin && span.end <= module.span.end;
  };
  for (const Mention& mention : graph_.mentions())
    if (is_inside(mention.span) && mention.target && !is_inside(item(*mention.target).span))
      refuse(mention.span, '"' + name + "\" needs the variable \"" + mention.name + "\" of the script",
             "make it a parameter of the module");
  for (const GraphDefinition& other : graph_.definitions()) {
    if (is_inside(other.span)) continue;
    const auto uses = [&](const GraphItem& one) { return is_inside(one.span) && one.callee == other.name; };
    const auto used = std::ranges::find_if(graph_.items(), uses);
    if (used != graph_.items().end())
      refuse(used->span, '"' + name + "\" needs \"" + other.name + "\", which the script defines",
             "put that into a library first");
    const auto names = [&](const Mention& one) {
      return is_inside(one.span) && !one.is_local && one.name == other.name;
    };
    const auto named = std::ranges::find_if(graph_.mentions(), names);
    if (named != graph_.mentions().end())
      refuse(named->span, '"' + name + "\" needs \"" + other.name + "\", which the script defines",
             "put that into a library first");
  }
}

// Returns the lines that use libraries, each with its end.
std::string EditRun::used_libraries() const {
  std::string text;
  for (const StatementPtr& statement : graph_.file().statements) {
    if (statement->kind != Statement::Kind::include) continue;
    text += std::string(graph_.text(statement->span)) + layout().newline();
  }
  return text;
}

}  // namespace ombre::lang
