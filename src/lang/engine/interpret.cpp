#include "lang/engine/interpret.h"

#include <algorithm>

#include "lang/engine/interpreter.h"

namespace ombre::lang {

Interpreter::Interpreter(const Program& program, Vocabulary& vocabulary, const Options& options,
                         Diagnostics& diagnostics)
    : Evaluation(program, options.limits, options.stop),
      vocabulary_(vocabulary),
      options_(options),
      diagnostics_(diagnostics),
      children_name_(symbol("children")),
      children_count_name_(symbol("$children")) {
  for (const Builtin& builtin : builtins()) builtins_[symbol(builtin.name)] = &builtin;
  // Initial values of OpenSCAD's special variables.
  const auto special = [&](const char* name, Value value) { specials_.emplace_back(symbol(name), std::move(value)); };
  special("$fn", 0.0);
  special("$fa", 12.0);
  special("$fs", 2.0);
  special("$t", 0.0);
  special("$preview", false);
}

// Reports a name that should be set but does not occur in the script, which is probably misspelt.
void Interpreter::report_missing(Severity severity, const std::string& name, const std::string& what,
                                 const Unit& main) {
  std::vector<std::string> names;
  for (const ast::Assign* assignment : main.plan.assignments) names.emplace_back(*assignment->name.symbol);
  report({severity,
          {},
          "the design has no variable \"" + name + "\" " + what,
          did_you_mean(name, names),
          Code::unknown_variable,
          {{"name", name}}});
}

Interpreter::Nodes Interpreter::run() {
  Nodes nodes;
  try {
    const Unit& main = program_.units.front();
    for (const std::string& name : options_.needed)
      if (!program_.names->contains(name)) report_missing(Severity::error, name, "that could get what is found", main);
    const auto is_needed = [&](const std::string& name) {
      return std::ranges::find(options_.needed, name) != options_.needed.end();
    };
    for (const Definition& definition : options_.definitions) {
      if (!program_.names->contains(definition.name) && !is_needed(definition.name))
        report_missing(Severity::warning, definition.name, "that -D could set", main);
      overrides_[program_.names->intern(definition.name)] = from_data(definition.value, meter_);
    }
    const ScopePtr& scope = unit_scope(main);
    try {
      run_actions(main.plan, scope, nodes);
    } catch (const Stopped&) {  // a failed assertion stops the script
    }
  } catch (const LimitReached& limit) {
    report({Severity::error, at_.range(), limit.message, limit.hint, Code::limit});
  }
  return has_roots_ ? std::move(roots_) : std::move(nodes);
}

std::vector<Product> run(const SourcePtr& source, Vocabulary& vocabulary, const Options& options,
                         Diagnostics& diagnostics) {
  const size_t errors_before = diagnostics.error_count();
  const Program program = load(source, options, diagnostics);
  // A file that could not be read would cause errors everywhere else.
  if (diagnostics.error_count() > errors_before) return {};
  return Interpreter(program, vocabulary, options, diagnostics).run();
}

}  // namespace ombre::lang
