// The builtin functions of OpenSCAD.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "lang/engine/common_functions.h"
#include "lang/openscad/script_operators.h"

namespace ombre::lang::openscad {

// The files that functions read.
struct FunctionFiles {
  std::function<std::optional<std::string>(const std::string& path)> read;  // nothing if there is no such file
  const std::vector<std::string>& fonts;                                    // files of fonts that the script uses
};

// One call. Most functions identify arguments by their order and ignore names.
struct FunctionCall {
  std::string_view name;
  std::vector<Value> arguments;
  Meter& meter;
  Problems& problems;
  const std::vector<const ast::CallStatement*>& modules;  // calls that are being evaluated, innermost last
  std::mt19937& random;                                   // generator of rands(), which a seed begins anew
  const ast::Call& written;
  const FunctionFiles& files;

  size_t size() const { return arguments.size(); }
  const Value& operator[](size_t i) const { return arguments[i]; }
  const std::vector<Value>& all() const { return arguments; }
  // Adds a warning and returns undef.
  Value fail(std::string text) const {
    problems.push_back({std::move(text)});
    return {};
  }
  // Adds an error, which ends the evaluation.
  Value stop(std::string text) const {
    problems.push_back({.text = std::move(text), .is_error = true});
    return {};
  }
  // Adds a warning without a place.
  void note(std::string text) const { problems.push_back({std::move(text), false}); }
  Value wrong_count() const { return fail(std::string(name) + "() number of parameters does not match"); }
  Value wrong_type() const { return fail(std::string(name) + "() parameter could not be converted"); }
  Value expected(size_t, const char*) const { return wrong_type(); }  // OpenSCAD says nothing about what it expects
};

using Function = Value (*)(const FunctionCall& call);

// Returns the path that a script names, relative to the folder of the file in which it is written.
std::string path_beside(const ast::Span& where, const std::string& path);

inline constexpr size_t any_number = std::numeric_limits<size_t>::max();

struct NamedFunction {
  const char* name;
  Function call;
  size_t least = 0, most = any_number;  // numbers of arguments
  bool wants_numbers = false;           // as in OpenSCAD, arguments after one that is no number are not evaluated
};

std::vector<NamedFunction> math_functions();
std::vector<NamedFunction> value_functions();
std::vector<NamedFunction> drawing_functions();
std::vector<NamedFunction> object_functions();
std::vector<NamedFunction> text_functions();

}  // namespace ombre::lang::openscad
