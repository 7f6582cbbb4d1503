// The steps of an edit of a graph, each of which replaces places in its text.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/text/diagnostic.h"
#include "lang/edit/graph_edit.h"

namespace ombre::lang {

// Thrown within an edit that cannot be made.
struct EditRefusal {
  Diagnostic reason;
};

// Base of edits of a script's or a design file's graph. Graph has text(), source() and
// std::optional<Graph> read_again(source, diagnostics), which reads another text in the same way.
template <class Graph>
class EditSteps {
 public:
  explicit EditSteps(Graph graph) : graph_(std::move(graph)) { result_.text = graph_.source(); }
  EditedScript take() { return std::move(result_); }

 protected:
  // Applies a step, and reads the graph again. `made` is the place of what it has added, in the text after the step.
  void commit(Replacements step, std::optional<size_t> made = std::nullopt) {
    if (step.empty()) return;
    sort_by_place(step);
    const SourcePtr source = make_source(graph_.source()->name(), applied(graph_.text(), step));
    Diagnostics mistakes;
    auto next = graph_.read_again(source, mistakes);
    if (!next) refuse_at({}, "this edit would leave a text with mistakes", "edit the text");
    graph_ = std::move(*next);
    result_.text = source;
    result_.steps.push_back(std::move(step));
    result_.made = made;
  }

  // The place is the whole file if it has no source.
  [[noreturn]] void refuse_at(const SourceRange& where, const std::string& message, Phrase hint = {}) const {
    Diagnostic reason;
    reason.where = where.source ? where : SourceRange{graph_.source(), 0, 0};
    reason.message = message;
    reason.hint = std::move(hint);
    throw EditRefusal{std::move(reason)};
  }

  Graph graph_;
  EditedScript result_;
};

// Makes an edit of a graph by a Run of it. Returns nothing, with the reason in the diagnostics, if it cannot be made.
template <class Run, class Graph>
std::optional<EditedScript> make_edit(std::optional<Graph> graph, const GraphEdit& edit, Diagnostics& diagnostics) {
  if (!graph) return std::nullopt;
  try {
    Run run(std::move(*graph));
    std::visit([&](const auto& one) { run.run(one); }, edit);
    return run.take();
  } catch (const EditRefusal& refusal) {
    diagnostics.add(refusal.reason);
    return std::nullopt;
  }
}

}  // namespace ombre::lang
