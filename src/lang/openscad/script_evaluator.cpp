#include "lang/openscad/script_evaluator.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "lang/openscad/value_text.h"
#include "lang/openscad/vectors.h"

namespace ombre::lang::openscad {

Evaluator::Evaluator(const Program& program, const Options& options, Messages& messages)
    : Evaluation(program, options.limits, options.stop), options_(options), messages_(messages) {
  files_.read = [this](const std::string& path) {
    auto content = options_.read_file ? options_.read_file(path) : read_real_file(path);
    if (content && std::ranges::find(read_files_, path) == read_files_.end()) read_files_.push_back(path);
    return content;
  };
  children_name_ = symbol("children"), child_name_ = symbol("child");
  intersection_for_name_ = symbol("intersection_for"), assign_name_ = symbol("assign");
  children_count_ = symbol("$children"), parent_modules_ = symbol("$parent_modules");
  fa_ = symbol("$fa"), fs_ = symbol("$fs"), semantics_ = symbol("$semantics");
  for (const auto& [name, parameters, is_variadic, function] : common_functions<FunctionCall>())
    functions_[symbol(name)] = {name, function, parameters.size(), is_variadic ? any_number : parameters.size()};
  for (const auto& table :
       {math_functions(), value_functions(), drawing_functions(), object_functions(), text_functions()})
    for (const NamedFunction& function : table) functions_[symbol(function.name)] = function;
  module_table_ = operation_modules();
  for (Module& module : module_table_) module.is_operation = true;
  for (const auto& table : {shape_modules(), plane_modules(), transform_modules(), file_modules()})
    module_table_.insert(module_table_.end(), table.begin(), table.end());
  for (const char* name : {"cube", "sphere", "cylinder", "polyhedron", "square", "circle", "polygon"})
    std::ranges::find(module_table_, std::string_view(name), &Module::name)->warns_of_children = true;
  for (const Module& module : module_table_) modules_[symbol(module.name)] = &module;

  const auto special = [&](std::string_view name, Value value) {
    specials_.emplace_back(symbol(name), std::move(value));
  };
  const auto vector = [&](const std::array<double, 3>& numbers) {
    return make_list({numbers.begin(), numbers.end()}, meter_);
  };
  special("$fn", 0.0);
  special("$fa", 12.0);
  special("$fs", 2.0);
  special("$t", options.time);
  special("$preview", options.is_preview);
  special("$vpr", vector(options.view.rotation));
  special("$vpt", vector(options.view.target));
  special("$vpd", options.view.distance);
  special("$vpf", options.view.field);
}

solids::TreePtr Evaluator::run() {
  try {
    check_words();
    auto result = std::make_shared<solids::Tree>();
    const ScopePtr& scope = unit_scope(program_.units.front());
    run_actions(program_.units.front().plan, scope, result->children);
    if (roots_.empty()) return result;
    std::vector<solids::TreePtr> roots;
    find_roots(result, roots);
    for (const solids::TreePtr& root : roots)
      if (root->where != roots.front()->where) {
        warn_of_roots(*root);
        break;
      }
    return roots.empty() ? result : roots.front();
  } catch (const Stopped&) {
  } catch (const LimitReached& limit) {
    say(Message::Kind::error, limit.message + (limit.hint.empty() ? "" : "; " + limit.hint), at_, Code::limit);
  }
  return nullptr;
}

void Evaluator::check_view() {
  const ast::Plan& plan = program_.units.front().plan;
  bool sets_view = false;
  for (const auto& [name, is_vector] : std::array{std::pair{"$vpr", true}, std::pair{"$vpt", true},
                                                  std::pair{"$vpd", false}, std::pair{"$vpf", false}}) {
    const Value* value = plan.assigns(symbol(name)) ? find_special(symbol(name)) : nullptr;
    if (!value || value->is_undef()) continue;
    if (is_vector ? vector3(*value, 0).has_value() : value->number() != nullptr)
      sets_view = true;
    else
      warn(std::string("Unable to convert ") + name + '=' + value_text(*value, true, meter_) +
               (is_vector ? " to a vec3 or vec2 of numbers" : " to a number"),
           {});
  }
  if (sets_view) warn("Viewall and autocenter disabled in favor of $vp*", {});
}

// Collects the marked trees, parents before their children. The first one counts.
void Evaluator::find_roots(const solids::TreePtr& tree, std::vector<solids::TreePtr>& found) const {
  if (std::ranges::find(roots_, tree.get()) != roots_.end()) found.push_back(tree);
  for (const solids::TreePtr& child : tree->children) find_roots(child, found);
}

void Evaluator::warn_of_roots(const solids::Tree& second) {
  const SourceRange& where = second.where;
  warn("More than one Root Modifier (!)", {where.source ? &where.source : nullptr, where.begin, where.end});
}

// Functions that report messages.

std::string shown_path(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path file = fs::absolute(path, ignored).lexically_normal();
  const fs::path from = fs::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
  const fs::path relative = file.lexically_relative(from);
  return relative.empty() ? path : relative.generic_string();
}

std::string folder_of(const std::string& path) { return std::filesystem::path(path).parent_path().string(); }

const std::string& Evaluator::path_of(ShownFrom from, const SourcePtr* source) const {
  const auto holds_source = [&](const Unit& unit) {
    const auto is_there = [&](const auto* statement) { return statement->span.source == source; };
    const ast::Plan& plan = unit.plan;
    return std::ranges::any_of(plan.functions, is_there) || std::ranges::any_of(plan.modules, is_there) ||
           std::ranges::any_of(plan.assignments, is_there) || std::ranges::any_of(plan.actions, is_there);
  };
  const auto unit = std::ranges::find_if(program_.units, holds_source);
  const bool is_known = from == ShownFrom::unit && unit != program_.units.end();
  return is_known ? unit->path : program_.units.front().path;
}

std::pair<std::string, int> Evaluator::file_and_line(const ast::Span& where, ShownFrom from) {
  if (!where.source) return {};
  auto& shown = shown_files_[static_cast<size_t>(from)];
  const auto known = shown.find(where.source);
  const int line = (*where.source)->place(where.begin).line;
  if (known != shown.end()) return {known->second, line};
  const std::string folder = folder_of(path_of(from, where.source));
  return {shown[where.source] = shown_path((*where.source)->name(), folder), line};
}

void Evaluator::say(Message::Kind kind, std::string text, const ast::Span& where, Code code, ShownFrom from) {
  auto [file, line] = file_and_line(where, from);
  messages_.add({kind, std::move(text), std::move(file), line, code});
  if (kind == Message::Kind::warning && options_.stops_at_warnings) throw Stopped{};
}

void Evaluator::warn(std::string text, const ast::Span& where, ShownFrom from) {
  meter_.spend(10);
  say(Message::Kind::warning, std::move(text), where, Code::script, from);
}

void Evaluator::warn_all(Problems& problems, const ast::Span& where, ShownFrom from) {
  for (Problem& problem : problems) {
    const ast::Span& place = problem.has_place ? where : ast::Span{};
    if (problem.is_error) stop(std::move(problem.text), place);
    warn(std::move(problem.text), place, from);
  }
}

void Evaluator::stop(std::string text, const ast::Span& where, Code code) {
  say(Message::Kind::error, std::move(text), where, code);
  throw Stopped{};
}

void Evaluator::trace(const std::string& name, const ast::Span& where) {
  constexpr int most_traced = 12;
  if (++traced_ > most_traced) return;
  auto [file, line] = file_and_line(where);
  messages_.add({Message::Kind::trace, "called by '" + name + '\'', std::move(file), line});
}

double Evaluator::special_number(Symbol name) const {
  const Value* value = find_special(name);
  return value && value->number() ? *value->number() : 0;
}

// Functions for calls of builtin modules.

std::shared_ptr<solids::Tree> Evaluator::tree(solids::Operation operation, const ast::Span& where) {
  meter_.count_instance();
  auto result = std::make_shared<solids::Tree>();
  result->operation = std::move(operation);
  result->where = where.range();
  if (const Value* semantics = find_special(semantics_)) result->semantics = semantics_of(*semantics, where);
  return result;
}

solids::Semantics Evaluator::semantics_of(const Value& value, const ast::Span& where) {
  const std::string name = value.text() ? value.text()->text : "";
  if (name == "strict") return solids::Semantics::strict;
  if (name == "permissive") return solids::Semantics::permissive;
  if (name != "default" && name != "standard" && !value.is_undef())
    warn("semantics are \"default\", \"strict\" or \"permissive\", not " + value_text(value, true, meter_), where);
  return solids::Semantics::standard;
}

solids::TreePtr Evaluator::run_builtin(const Module& module, const ast::CallStatement& statement,
                                       const ScopePtr& scope) {
  ModuleCall call(*this, statement, scope);
  const SpecialsMark mark(*this);
  bind_builtin(module, statement.arguments, scope, call, mark.size());
  at_ = statement.span;
  if (module.warns_of_children && !statement.children.statements.empty())
    warn("module " + statement.name.text() + "() does not support child modules", statement.span);
  return module.make(call);
}

void Evaluator::bind_builtin(const Module& module, const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                             ModuleCall& call, size_t specials_from) {
  const ast::Span& where = call.statement_.span;
  size_t position = 0;
  bool has_too_many = false;
  const auto give = [&](std::string_view name, Value value) {
    for (auto& [known, old] : call.values_) {
      if (known != name) continue;
      warn("argument " + std::string(name) + " supplied more than once", where, ShownFrom::unit);
      old = std::move(value);
      return;
    }
    call.values_.emplace_back(name, std::move(value));
  };
  for (const ast::Argument& argument : arguments) {
    const Symbol name = argument.name.symbol;
    if (!name && position >= module.positional.size()) {
      if (!module.takes_anything && !std::exchange(has_too_many, true))
        warn("Too many unnamed arguments supplied", where, ShownFrom::unit);
      if (module.takes_anything) (void)eval(*argument.value, scope);
      continue;
    }
    if (!name) {
      give(module.positional[position++], eval(*argument.value, scope));
      continue;
    }
    Value value = eval(*argument.value, scope);
    if (name->front() == '$') {
      set_special(name, std::move(value), specials_from);
      continue;
    }
    if (*name == "semantics" && module.is_operation) {
      call.semantics_ = semantics_of(value, where);
      continue;
    }
    const auto is_declared = [&](const std::vector<std::string_view>& names) {
      return std::ranges::find(names, *name) != names.end();
    };
    if (!module.takes_anything && !is_declared(module.positional) && !is_declared(module.named))
      warn("variable " + *name + " not specified as parameter", where, ShownFrom::unit);
    give(*name, std::move(value));
  }
}

const Value& ModuleCall::operator[](std::string_view parameter) const {
  static const Value undef;
  for (const auto& [name, value] : values_)
    if (name == parameter) return value;
  return undef;
}

bool ModuleCall::has(std::string_view parameter) const { return !(*this)[parameter].is_undef(); }

std::optional<double> ModuleCall::number(std::string_view parameter) const {
  const double* number = (*this)[parameter].number();
  return number ? std::optional(*number) : std::nullopt;
}

bool ModuleCall::flag(std::string_view parameter, bool otherwise) const {
  const bool* flag = (*this)[parameter].boolean();
  return flag ? *flag : otherwise;
}

std::string ModuleCall::text(std::string_view parameter, const std::string& otherwise) const {
  const Text* text = (*this)[parameter].text();
  return text ? text->text : otherwise;
}

std::string ModuleCall::shown(std::string_view parameter) const { return shown_value((*this)[parameter]); }
std::string ModuleCall::shown_value(const Value& value) const { return value_text(value, true, evaluator_.meter_); }

void ModuleCall::warn(const std::string& text) const { evaluator_.warn(text, statement_.span); }
void ModuleCall::deprecate(const std::string& text) const {
  evaluator_.messages_.add({Message::Kind::deprecated, text, "", 0});
}

void ModuleCall::deprecate_here(const std::string& text) const {
  evaluator_.say(Message::Kind::deprecated, text, statement_.span);
}
void ModuleCall::note(const std::string& text) const { evaluator_.messages_.add({Message::Kind::note, text, "", 0}); }

solids::Fragments ModuleCall::fragments() const {
  return {evaluator_.special_number(evaluator_.facets_name_), evaluator_.special_number(evaluator_.fa_),
          evaluator_.special_number(evaluator_.fs_)};
}

solids::Fragments ModuleCall::checked_fragments() const {
  constexpr double least = 0.01;
  solids::Fragments result = fragments();
  if (result.size < least) {
    warn("$fs too small - clamping to 0.010000");
    result.size = least;
  }
  if (result.angle < least) {
    warn("$fa too small - clamping to 0.010000");
    result.angle = least;
  }
  return result;
}

std::string path_beside(const ast::Span& where, const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty() || fs::path(path).is_absolute()) return path;
  const fs::path folder = where.source ? fs::path((*where.source)->name()).parent_path() : fs::path();
  return (folder / path).lexically_normal().generic_string();
}

std::string ModuleCall::complete_path(const std::string& path) const { return path_beside(statement_.span, path); }

const std::vector<std::string>& ModuleCall::font_files() const { return evaluator_.program_.fonts; }

const Trees& ModuleCall::children() {
  if (!children_) {
    children_.emplace();
    evaluator_.run_block(statement_.children, scope_, *children_);
  }
  return *children_;
}

std::shared_ptr<solids::Tree> ModuleCall::node(solids::Operation operation) const {
  auto result = evaluator_.tree(std::move(operation), statement_.span);
  if (semantics_) result->semantics = *semantics_;
  return result;
}

solids::TreePtr ModuleCall::with_children(solids::Operation operation) {
  auto result = node(std::move(operation));
  result->children = children();
  return result;
}

}  // namespace ombre::lang::openscad
