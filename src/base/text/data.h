// Plain data with source positions, such as a script's arguments to a node or the content of a JSON file.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/text/source_text.h"

namespace ombre {

struct Data;

// An opaque object of the host program that data carries, such as a Python function.
struct HostObject {
  virtual ~HostObject() = default;
  virtual std::string describe() const { return "a function"; }  // description for messages
};
using HostObjectPtr = std::shared_ptr<const HostObject>;

using DataList = std::vector<Data>;
using DataMembers = std::vector<std::pair<std::string, Data>>;  // members in the order written

// A host object in data. It is not a plain pointer, because libstdc++ takes a variant of strings, vectors and shared
// pointers alone for one that always has a value, and destroys a value that is not there when a copy runs out of
// memory.
struct HeldObject {
  HostObjectPtr object;
  bool operator==(const HeldObject&) const = default;
};

struct Data {
  std::variant<std::monostate, bool, double, std::string, DataList, DataMembers, HeldObject> value;
  // Position in the source. For a string literal without escapes the range covers exactly its characters, so that
  // positions inside the string can be reported.
  SourceRange where;

  Data() = default;
  Data(bool v, SourceRange at = {}) : value(v), where(std::move(at)) {}                                  // NOLINT
  Data(double v, SourceRange at = {}) : value(v), where(std::move(at)) {}                                // NOLINT
  Data(std::string v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}                // NOLINT
  Data(const char* v) : value(std::string(v)) {}                                                         // NOLINT
  Data(DataList v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}                   // NOLINT
  Data(DataMembers v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}                // NOLINT
  Data(HostObjectPtr v, SourceRange at = {}) : value(HeldObject{std::move(v)}), where(std::move(at)) {}  // NOLINT

  bool is_null() const { return std::holds_alternative<std::monostate>(value); }
  const bool* boolean() const { return std::get_if<bool>(&value); }
  const double* number() const { return std::get_if<double>(&value); }
  const std::string* string() const { return std::get_if<std::string>(&value); }
  const DataList* list() const { return std::get_if<DataList>(&value); }
  const DataMembers* members() const { return std::get_if<DataMembers>(&value); }
  HostObjectPtr host_object() const {
    const auto* held = std::get_if<HeldObject>(&value);
    return held ? held->object : nullptr;
  }
  // Returns the member with that name, or null.
  const Data* find(std::string_view name) const;

  // Compares values, not positions. Numbers compare as doubles: -0 equals 0, and NaN equals nothing.
  bool operator==(const Data& other) const { return value == other.value; }
};

// Converts any numeric type. Integers above 2^53 are rounded to a double.
template <class T>
Data number(T value) {
  return static_cast<double>(value);
}

// Returns a short description for messages: "a number", "a list of 3".
std::string describe(const Data& data);

}  // namespace ombre
