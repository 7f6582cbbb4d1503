// Any bytes are a script: it parses, prints and runs within small limits, and its printed form is stable.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lang/engine/ast_print.h"
#include "lang/engine/interpret.h"
#include "lang/engine/parser.h"

namespace {

using namespace ombre;

// Knows every name that does not begin with "u", so that unknown ones occur as well.
class Permissive : public lang::Vocabulary {
 public:
  bool knows(std::string_view name) const override { return name.empty() || name.front() != 'u'; }
  std::vector<std::string> names() const override { return {"cube", "sphere", "translate"}; }
  std::string hint(std::string_view unknown) const override { return unknown == "union" ? "write it otherwise" : ""; }
  std::optional<Data> constant(std::string_view name) const override {
    if (name == "red" || name == "x") return Data(std::string(name));
    return std::nullopt;
  }
  std::vector<std::string> constants() const override { return {"red", "x"}; }
  lang::Product make(lang::Invocation call, Diagnostics& diagnostics) override {
    for (const lang::Argument& argument : call.arguments)
      if (argument.value.is_null()) diagnostics.error(argument.value.where, "nothing was given");
    return call.name == "null" ? nullptr : node_;
  }

 private:
  lang::Product node_ = std::make_shared<const int>(0);
};

lang::Options small_options(const std::string& text) {
  lang::Options options;
  options.limits.elements = 10'000;
  options.limits.text_bytes = 1'000'000;
  options.limits.instances = 10'000;
  options.limits.calls = 10'000;
  options.limits.steps = 100'000;
  options.limits.closures = 2'000;
  options.limits.files = 10;
  options.definitions.push_back({"defined", Data(3.0)});
  options.read_file = [text](const std::string& path) -> std::optional<std::string> {
    if (path == "self") return text;
    if (path == "lib") return "module m(a = 1) { children(); cube(a); } function f(x) = x + 1; v = 2;";
    return std::nullopt;
  };
  return options;
}

void check_printing(const std::string& text) {
  Diagnostics diagnostics;
  const lang::ast::File file = lang::parse(make_source("fuzz.vcad", text), diagnostics);
  const std::string printed = lang::print(file);
  if (diagnostics.has_errors()) return;
  Diagnostics again;
  const lang::ast::File reread = lang::parse(make_source("printed.vcad", printed), again);
  if (again.has_errors() || lang::print(reread) != printed) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check_printing(text);
  Permissive vocabulary;
  Diagnostics diagnostics;
  lang::run(make_source("fuzz.vcad", text), vocabulary, small_options(text), diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    const SourceRange& where = diagnostic.where;
    if (where.source && (where.begin > where.end || where.begin > where.source->text().size())) std::abort();
  }
  (void)to_text(diagnostics);
  return 0;
}
