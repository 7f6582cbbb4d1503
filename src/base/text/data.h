// Plain data with places: what a script hands to a node, and what a JSON file holds.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/text/source_text.h"

namespace ombre {

struct Data;

// Something of the program around us that data only carries, such as a function of a host language.
struct HostObject {
  virtual ~HostObject() = default;
  virtual std::string describe() const { return "a function"; }  // for messages
};
using HostObjectPtr = std::shared_ptr<const HostObject>;

using DataList = std::vector<Data>;
using DataMembers = std::vector<std::pair<std::string, Data>>;  // in the order written

struct Data {
  std::variant<std::monostate, bool, double, std::string, DataList, DataMembers, HostObjectPtr> value;
  // Where it was written. For a string that stands literally in the source and has no escapes,
  // the range covers exactly its characters, so that positions inside it can be named.
  SourceRange where;

  Data() = default;
  Data(bool v, SourceRange at = {}) : value(v), where(std::move(at)) {}                      // NOLINT
  Data(double v, SourceRange at = {}) : value(v), where(std::move(at)) {}                    // NOLINT
  Data(std::string v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}    // NOLINT
  Data(const char* v) : value(std::string(v)) {}                                             // NOLINT
  Data(DataList v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}       // NOLINT
  Data(DataMembers v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}    // NOLINT
  Data(HostObjectPtr v, SourceRange at = {}) : value(std::move(v)), where(std::move(at)) {}  // NOLINT

  bool is_null() const { return std::holds_alternative<std::monostate>(value); }
  const bool* boolean() const { return std::get_if<bool>(&value); }
  const double* number() const { return std::get_if<double>(&value); }
  const std::string* string() const { return std::get_if<std::string>(&value); }
  const DataList* list() const { return std::get_if<DataList>(&value); }
  const DataMembers* members() const { return std::get_if<DataMembers>(&value); }
  HostObjectPtr host_object() const {
    const auto* pointer = std::get_if<HostObjectPtr>(&value);
    return pointer ? *pointer : nullptr;
  }
  // The member of that name, or null.
  const Data* find(std::string_view name) const;

  // Equal values; places do not count. Numbers are equal when their bits are, but for -0 and NaN.
  bool operator==(const Data& other) const { return value == other.value; }
};

// Of any type of number; beyond 2^53 the nearest that a double holds.
template <class T>
Data number(T value) {
  return static_cast<double>(value);
}

// "a number", "a list of 3": for messages.
std::string describe(const Data& data);

}  // namespace ombre
