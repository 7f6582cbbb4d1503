// JSON objects that become structs: a row for each member says how it is called, what it may be and where it goes.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre {

// Numbers that a member may be, ends included.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool is_whole = false, without_least = false;  // the least number itself is not in the range
};

// Messages of mistakes in JSON objects. `code` is that of all messages.
class RecordErrors {
 public:
  RecordErrors(Diagnostics& diagnostics, Code code) : diagnostics_(&diagnostics), code_(code) {}

  void fail(const SourceRange& at, const std::string& message, const Phrase& hint = {}) const {
    diagnostics_->error(code_, at, message, hint);
  }
  // "expected ..., not a number"
  void fail_expected(const Data& data, const std::string& expected, const Phrase& hint = {}) const;
  Diagnostics& diagnostics() const { return *diagnostics_; }
  size_t count() const { return diagnostics_->error_count(); }

  // Each returns nothing, and reports it, for data of another kind.
  std::optional<double> number(const Data& data, const std::string& name, const NumberRange& range = {}) const;
  std::optional<bool> boolean(const Data& data, const std::string& name) const;
  std::optional<std::string> text(const Data& data, const std::string& name) const;
  // The place of the text among the words.
  std::optional<size_t> choice(const Data& data, const std::string& name, const std::vector<std::string>& words) const;
  // Exactly so many numbers. `form` says what to write: "[x, y, z]".
  std::optional<std::vector<double>> numbers(const Data& data, const std::string& name, size_t count,
                                             const std::string& form, const NumberRange& range = {}) const;
  const DataList* list(const Data& data, const std::string& name) const;
  // Reports members that are not known, with the name that may be meant, and data that is no object.
  bool members(const Data& data, const std::string& what, const std::vector<std::string>& known) const;

 private:
  Diagnostics* diagnostics_;
  Code code_;
};

template <class T>
struct Field {
  std::string name;
  // Sets what the member says of the struct, or reports what is wrong with it.
  std::function<void(T& value, const Data& data, const RecordErrors& errors)> read;
  bool is_required = false;

  Field required() && {
    is_required = true;
    return std::move(*this);
  }
};

template <class T>
class Record {
 public:
  // `what` names the object in messages: "a printer profile".
  Record(std::string what, std::vector<Field<T>> fields, Code code = Code::design)
      : what_(std::move(what)), fields_(std::move(fields)), code_(code) {}

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Field<T>& field : fields_) names.push_back(field.name);
    return names;
  }

  // Sets the members that the data has. Returns false, and reports why, if anything is wrong; then the others are set
  // all the same.
  bool read(const Data& data, T& value, Diagnostics& diagnostics) const {
    const RecordErrors errors(diagnostics, code_);
    const size_t before = errors.count();
    if (!errors.members(data, what_, names()) && !data.members()) return false;
    for (const Field<T>& field : fields_) {
      if (const Data* member = data.find(field.name))
        field.read(value, *member, errors);
      else if (field.is_required)
        errors.fail(data.where, what_ + " has no \"" + field.name + '"');
    }
    return errors.count() == before;
  }
  T read(const Data& data, Diagnostics& diagnostics) const {
    T value{};
    read(data, value, diagnostics);
    return value;
  }

 private:
  std::string what_;
  std::vector<Field<T>> fields_;
  Code code_;
};

namespace field {

template <class T, class Member>
Field<T> number(std::string name, Member T::*member, NumberRange range = {}) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            using Plain = typename std::conditional_t<std::is_arithmetic_v<Member>, std::type_identity<Member>,
                                                      std::type_identity<double>>::type;
            if (const auto read = errors.number(data, name, range)) value.*member = static_cast<Plain>(*read);
          }};
}

template <class T, class Member>
Field<T> whole(std::string name, Member T::*member, double least, double most) {
  return number(std::move(name), member, {least, most, true});
}

template <class T>
Field<T> flag(std::string name, bool T::*member) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            if (const auto read = errors.boolean(data, name)) value.*member = *read;
          }};
}

template <class T, class Member>
Field<T> text(std::string name, Member T::*member) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            if (auto read = errors.text(data, name)) value.*member = std::move(*read);
          }};
}

// A choice of words, which are in the order of an enumeration's values; or false and true.
template <class T, class Member>
Field<T> choice(std::string name, Member T::*member, std::vector<std::string> words) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            const auto read = errors.choice(data, name, words);
            if (!read) return;
            if constexpr (std::is_same_v<Member, std::string>)
              value.*member = words[*read];
            else
              value.*member = static_cast<Member>(*read);
          }};
}

// An object.
template <class T, class Member, class Part>
Field<T> object(std::string name, Member T::*member, Record<Part> record) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            value.*member = record.read(data, errors.diagnostics());
          }};
}

// A list of objects.
template <class T, class Part>
Field<T> objects(std::string name, std::vector<Part> T::*member, Record<Part> record) {
  return {name, [=](T& value, const Data& data, const RecordErrors& errors) {
            if (const DataList* items = errors.list(data, name))
              for (const Data& item : *items) (value.*member).push_back(record.read(item, errors.diagnostics()));
          }};
}

// A member of another kind, which `read` sets: void(T& value, const Data& data, const RecordErrors& errors).
template <class T, class Read>
Field<T> special(std::string name, Read read) {
  return {std::move(name), read};
}

}  // namespace field

}  // namespace ombre
