// The builtin functions of scripts.
#pragma once

#include <string>
#include <vector>

#include "lang/engine/value.h"

namespace ombre::lang {

// Thrown for an argument that a builtin function does not accept.
struct BadArgument {
  size_t index;         // number of the argument
  std::string message;  // for example "abs() needs a number, found a string"
  Phrase hint;
};

// The arguments of one call, which are checked as they are read.
class BuiltinCall {
 public:
  BuiltinCall(const char* name, std::vector<Value> arguments, Meter& m, std::vector<std::string> names = {})
      : meter(m), name_(name), arguments_(std::move(arguments)), names_(std::move(names)) {}

  size_t size() const { return arguments_.size(); }
  bool has(size_t i) const { return i < size() && !arguments_[i].is_undef(); }
  const Value& operator[](size_t i) const { return arguments_[i]; }
  const char* name() const { return name_; }
  double number(size_t i) const;
  const List& list(size_t i) const;
  const std::string& text(size_t i) const;
  const std::vector<Value>& all() const { return arguments_; }
  // Returns the name before an argument of a function with named members; empty if there is none.
  const std::string& name_of(size_t i) const { return names_[i]; }
  [[noreturn]] Value expected(size_t i, const std::string& what, const Phrase& hint = {}) const;

  Meter& meter;

 private:
  const char* name_;
  std::vector<Value> arguments_;
  std::vector<std::string> names_;
};

struct Builtin {
  const char* name;
  std::vector<const char*> parameters;
  size_t required;   // number of required arguments
  bool is_variadic;  // any number of further arguments may follow
  Value (*call)(const BuiltinCall& call);
  bool names_members = false;  // names before arguments are not those of parameters

  std::string signature() const;  // for example "pow(base, exponent)"
};

// Returns all of them.
const std::vector<Builtin>& builtins();

std::vector<Builtin> math_builtins();
std::vector<Builtin> list_builtins();
std::vector<Builtin> text_builtins();
std::vector<Builtin> point_builtins();

}  // namespace ombre::lang
