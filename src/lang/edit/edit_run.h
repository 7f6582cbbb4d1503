// The steps of an edit of a script's graph.
#pragma once

#include <string>
#include <utility>

#include "lang/edit/edit_steps.h"
#include "lang/edit/graph_edit.h"
#include "lang/edit/text_layout.h"

namespace ombre::lang {

// The blanks by which what stands in braces is indented.
inline const std::string step_in = "  ";

// Makes an edit, in one or more steps. After each step the graph is read again.
class EditRun : public EditSteps<ScriptGraph> {
 public:
  using EditSteps::EditSteps;

  void run(const SetArgument& edit);
  void run(const InsertCall& edit);
  void run(const AddVariable& edit);
  void run(const RemoveItem& edit);
  void run(const ConnectItems& edit);
  void run(const RenameVariable& edit);
  void run(const MoveCall& edit);
  void run(const GroupCalls& edit);
  void run(const UseLibrary& edit);
  void run(const MoveToLibrary& edit);

 private:
  using Kind = GraphItem::Kind;

  [[noreturn]] void refuse(const ast::Span& where, const std::string& message, Phrase hint = {}) const;
  const GraphItem& item(size_t number) const;
  // Returns the item if it may be changed, and refuses otherwise.
  const GraphItem& open_item(size_t number) const;
  const GraphItem& open_statement(size_t number) const;
  void check_place(const GraphItem& item) const;
  int line(const ast::Span& span) const { return graph_.line(span); }
  TextLayout layout() const { return TextLayout(graph_.text()); }

  // The text of a statement begins with its modifiers and ends with its ";" or "}".
  size_t begin_of(const ast::Statement& statement) const;
  size_t end_of(const ast::Statement& statement) const;
  // Includes a comment behind the statement that begins a line.
  size_t end_with_comment(const ast::Statement& statement) const;
  bool is_closed(const ast::Statement& statement) const;
  bool is_only_child_without_braces(const GraphItem& item) const;
  // Returns a statement's text with a ";" at its end, in lines with another indent.
  std::string text_of(const ast::Statement& statement, const std::string& indent, bool takes_comment) const;
  void close(const ast::Statement& statement, Replacements& step) const;

  // Return the value, call or name without blanks around it, or refuse it.
  std::string checked_value(const std::string& value) const;
  std::string checked_call(const std::string& call, bool may_hold_children) const;
  std::string checked_name(const std::string& name) const;
  std::string checked_new_name(const std::string& name) const;  // one that the script does not use
  std::string free_name(const std::string& wanted) const;

  void remove_argument(const GraphItem& of, size_t index);
  void add_argument(const GraphItem& to, const std::string& name, const std::string& value);
  void insert_at_end(const std::string& statement);
  void insert_inside(size_t into, const std::string& statement);
  void insert_in_braces(const GraphItem& parent, const ast::Block& block, const std::string& statement);
  void insert_first_child(const GraphItem& parent, const std::string& statement);
  void insert_beside_only_child(const GraphItem& parent, const std::string& statement);
  void insert_after(size_t after, const std::string& statement);
  size_t place_of_variables() const;
  void remove_statement(const GraphItem& removed);
  void keep_children(const GraphItem& removed);
  void drop_braces(const GraphItem& removed);
  void check_unused(size_t variable) const;
  void check_names(size_t moved, std::optional<size_t> scope) const;

  size_t place_before(size_t item) const;
  size_t as_variable(size_t value, size_t& other);
  bool needs(size_t item, size_t variable) const;
  size_t move_up(size_t variable, size_t before);

  void check_row(const std::vector<size_t>& row) const;
  const ast::Statement& module_called(const std::string& name) const;
  void check_alone(const ast::Statement& module, const std::string& name) const;
  std::string used_libraries() const;
  std::string module_text(const GroupCalls& edit, const std::vector<size_t>& row) const;
};

}  // namespace ombre::lang
