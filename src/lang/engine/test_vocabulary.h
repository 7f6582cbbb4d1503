// A vocabulary for tests. Its nodes are the texts of the calls that made them.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/text/text.h"
#include "lang/engine/interpret.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

inline Product text_node(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

inline const std::string& node_text(const Product& node) { return *static_cast<const std::string*>(node.get()); }

inline std::string data_text(const Data& data) {
  if (data.is_null()) return "undef";
  if (const bool* b = data.boolean()) return *b ? "true" : "false";
  if (const double* n = data.number()) return format_number(*n);
  if (const std::string* s = data.string()) return '"' + *s + '"';
  std::string text;
  for (const Data& item : *data.list()) text += (text.empty() ? "" : ",") + data_text(item);
  return '[' + text + ']';
}

class TestVocabulary : public Vocabulary {
 public:
  std::vector<Invocation> calls;

  bool knows(std::string_view name) const override { return nodes_.count(fold_name(name)) > 0; }
  std::vector<std::string> names() const override { return {nodes_.begin(), nodes_.end()}; }
  std::string hint(std::string_view unknown) const override { return unknown == "color" ? "write material" : ""; }
  std::optional<Data> constant(std::string_view name) const override {
    if (std::string(name).find_first_not_of("xyz") == std::string::npos && name.size() == 1)
      return Data("axis " + std::string(name));
    if (name == "red" || name == "green" || name == "blue") return Data(std::string(name));
    return std::nullopt;
  }
  std::vector<std::string> constants() const override { return {"x", "y", "z", "red", "green", "blue"}; }

  Product make(Invocation call, Diagnostics& diagnostics) override {
    calls.push_back(call);
    if (fold_name(call.name) == "broken") {
      diagnostics.error(call.where, "broken is broken");
      return nullptr;
    }
    std::string text = fold_name(call.name) + '(';
    for (const Argument& argument : call.arguments) {
      if (text.back() != '(') text += ',';
      if (!argument.name.empty()) text += argument.name + '=';
      text += data_text(argument.value);
    }
    text += ')';
    if (!call.children.empty()) {
      text += '{';
      for (const Product& child : call.children) text += (text.back() == '{' ? "" : " ") + node_text(child);
      text += '}';
    }
    return text_node(std::move(text));
  }

 private:
  std::set<std::string> nodes_ = {"sphere",   "cube", "translate", "rotate", "union", "fgrade",
                                  "function", "root", "frep",      "show",   "strut", "broken"};
};

// The nodes that a script makes, its messages and its echoes.
struct Result {
  std::string nodes, messages, echoes;
  std::vector<Invocation> calls;
};

inline Result run_script(const std::string& text, Options options = {}) {
  TestVocabulary vocabulary;
  Diagnostics diagnostics;
  Result result;
  options.echo = [&](const std::string& line) { result.echoes += line + '\n'; };
  if (!options.read_file) options.read_file = [](const std::string&) { return std::nullopt; };
  const auto nodes = run(make_source("part.vcad", text), vocabulary, options, diagnostics);
  for (const Product& node : nodes) result.nodes += (result.nodes.empty() ? "" : " ") + node_text(node);
  result.messages = to_text(diagnostics);
  result.calls = std::move(vocabulary.calls);
  return result;
}

// Returns the text of an expression's value.
inline std::string value_of(const std::string& expression) {
  const Result result = run_script("echo(" + expression + ");");
  return result.messages.empty() ? result.echoes.substr(0, result.echoes.size() - 1) : result.messages;
}

// Returns the first line of the messages.
inline std::string first_message(const std::string& text, const Options& options = {}) {
  const std::string messages = run_script(text, options).messages;
  return messages.substr(0, messages.find('\n'));
}

}  // namespace ombre::lang
