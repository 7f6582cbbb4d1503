// Any bytes are a script: it parses, prints and runs within small limits, and its printed form is stable.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/checks.h"
#include "fuzz/small_limits.h"
#include "lang/engine/interpret.h"
#include "lang/syntax/ast_print.h"
#include "lang/syntax/parser.h"

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
  options.limits = fuzz::small_limits();
  options.definitions.push_back({"defined", Data(3.0)});
  options.read_file = [text](const std::string& path) { return fuzz::file_for_script(text, path); };
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
  fuzz::check_places(diagnostics);
  return 0;
}
