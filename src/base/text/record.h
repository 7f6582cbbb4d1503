// JSON objects that become structs: a row for each member says how it is called, what it may be and where it goes.
//
//   Record<Search>("a search", {field::choice("method", &Search::method, method_names()).required(),
//                               field::whole("seed", &Search::seed, 0, 1000)})
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "base/text/plain.h"

namespace ombre {

// Numbers that a member may be, ends included.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool is_whole = false, without_least = false;  // the least number itself is not in the range
};
inline constexpr NumberRange above_zero{0, std::numeric_limits<double>::infinity(), false, true};

// The names of rows of a table, to choose from.
template <class Rows>
std::vector<std::string> names_in(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

// Reads values of members, and reports what is wrong with them. All messages have the same code, except those about
// unknown members.
class MemberReader {
 public:
  explicit MemberReader(Diagnostics& diagnostics, Code code = Code::design) : diagnostics_(diagnostics), code_(code) {}

  void fail(const Data& at, const std::string& message, const Phrase& hint = {}) const {
    diagnostics_.error(code_, at.where, message, hint);
  }
  // "expected a list, not 3"
  void fail_expected(const Data& data, const std::string& expected, const Phrase& hint = {}) const;
  void fail_missing(const Data& owner, const std::string& what, const std::string& name,
                    const Phrase& hint = {}) const {
    fail(owner, what + " needs \"" + name + '"', hint);
  }
  Diagnostics& diagnostics() const { return diagnostics_; }
  size_t error_count() const { return diagnostics_.error_count(); }

  // Each returns nothing, and reports it, for data of another kind. A text has more than spaces.
  std::optional<double> number(const Data& data, const std::string& name, const NumberRange& range = {}) const;
  std::optional<bool> boolean(const Data& data, const std::string& name) const;
  std::optional<std::string> text(const Data& data, const std::string& name) const;
  // The place of the text among the words.
  std::optional<size_t> choice(const Data& data, const std::string& name, const std::vector<std::string>& words) const;
  // Reads a list of exactly `count` numbers. `form` says what to write: "[x, y, z]".
  std::optional<std::vector<double>> numbers(const Data& data, const std::string& name, size_t count,
                                             const std::string& form, const NumberRange& range = {}) const;
  const DataList* list(const Data& data, const std::string& name) const;
  // The members of an object whose names mean something themselves.
  const DataMembers* named(const Data& data, const std::string& what) const;
  // Reports data that is not an object, and members that are not known, with the name that may be meant.
  bool has_only(const Data& data, const std::string& what, const std::vector<std::string>& known) const;
  // Does so for an object that may have other members, too. Of these it reports names that look like slips of a known
  // one that the object lacks.
  bool has_no_slips(const Data& data, const std::string& what, const std::vector<std::string>& known) const;
  // Returns the member "name", if it is made of lower-case letters, digits and '-'; else reports it.
  std::optional<std::string> plain_name(const Data& data, const std::string& what) const;
  // Reports it unless the object has one of these members, and no two.
  void has_one_of(const Data& data, const std::string& what, const std::vector<std::string>& names,
                  const Phrase& hint) const;

 private:
  bool is_object(const Data& data, const std::string& what, const std::vector<std::string>& known) const;
  void fail_unknown(const DataMembers::value_type& member, const std::string& what, const std::string& hint) const;

  Diagnostics& diagnostics_;
  Code code_;
};

// A member of an object, for its reference.
struct MemberInfo {
  std::string name, meaning;
  bool is_required = false;
};

// Sets what a member says of the struct, or reports what is wrong with it.
template <class T>
struct Field {
  std::string name;
  std::function<void(T& value, const Data& data, const MemberReader& reader)> read;
  bool is_required = false;
  Phrase hint;          // what to write where it is missing
  std::string meaning;  // for the reference, in Markdown

  Field(std::string name, decltype(read) read) : name(std::move(name)), read(std::move(read)) {}
  // A member of what the struct inherits from.
  template <class Base>
  requires(std::derived_from<T, Base> && !std::same_as<T, Base>)
      Field(const Field<Base>& field)  // NOLINT: rows of both stand in one table
      : name(field.name), read(field.read), is_required(field.is_required), hint(field.hint), meaning(field.meaning) {}

  Field required(Phrase what_to_write = {}) && {
    is_required = true;
    hint = std::move(what_to_write);
    return std::move(*this);
  }
  Field means(std::string text) && {
    meaning = std::move(text);
    return std::move(*this);
  }
  // An object with this member has this value in another one, such as its kind.
  template <class Member>
  Field sets(Member T::*member, std::type_identity_t<Member> constant) && {
    read = [=, before = std::move(read)](T& value, const Data& data, const MemberReader& reader) {
      value.*member = constant;
      before(value, data, reader);
    };
    return std::move(*this);
  }
};

template <class T>
class Record {
 public:
  // `what` names the object in messages: "a printer profile".
  Record(std::string what, std::vector<Field<T>> fields) : what_(std::move(what)), fields_(std::move(fields)) {
    for (const Field<T>& field : fields_) members_.push_back({field.name, field.meaning, field.is_required});
  }

  // The object also has these members, which something else reads.
  Record knows(const std::vector<std::string>& names) && {
    for (const std::string& name : names) members_.push_back({name, ""});
    return std::move(*this);
  }
  // The object may have any other members.
  Record open() && {
    is_open_ = true;
    return std::move(*this);
  }
  // The members of a part stand among those of the whole; a part that is optional is there then.
  template <class Member, class Part>
  Record with(Member T::*member, const Record<Part>& part) && {
    parts_.push_back([=](T& value, const Data& data, const MemberReader& reader) {
      if constexpr (std::same_as<Member, std::optional<Part>>)
        part.read_members(data, (value.*member).emplace(), reader);
      else
        part.read_members(data, value.*member, reader);
    });
    members_.insert(members_.end(), part.members().begin(), part.members().end());
    return std::move(*this);
  }
  Record one_of(const std::vector<std::string>& names, const Phrase& hint) && {
    parts_.push_back([=, what = what_](T&, const Data& data, const MemberReader& reader) {
      reader.has_one_of(data, what, names, hint);
    });
    return std::move(*this);
  }
  // The check says what several members must be together. It runs once each by itself is right.
  Record checked(std::function<void(T& value, const Data& data, const MemberReader& reader)> check) && {
    check_ = std::move(check);
    return std::move(*this);
  }

  const std::vector<MemberInfo>& members() const { return members_; }
  std::vector<std::string> names() const { return names_in(members_); }

  // Sets the members that the object has. Returns false, and reports why, if anything is wrong; then the others are set
  // all the same. A struct with a `where` gets the object's place.
  bool read(const Data& data, T& value, const MemberReader& reader) const {
    const size_t before = reader.error_count();
    is_open_ ? reader.has_no_slips(data, what_, names()) : reader.has_only(data, what_, names());
    if (data.members()) read_members(data, value, reader);
    return reader.error_count() == before;
  }
  // This reads an object that may have other members.
  void read_members(const Data& data, T& value, const MemberReader& reader) const {
    const size_t before = reader.error_count();
    if constexpr (requires { value.where = data.where; }) value.where = data.where;
    for (const Field<T>& field : fields_) {
      if (const Data* member = data.find(field.name))
        field.read(value, *member, reader);
      else if (field.is_required)
        reader.fail_missing(data, what_, field.name, field.hint);
    }
    for (const auto& part : parts_) part(value, data, reader);
    if (check_ && reader.error_count() == before) check_(value, data, reader);
  }

 private:
  using Read = std::function<void(T& value, const Data& data, const MemberReader& reader)>;

  std::string what_;
  std::vector<Field<T>> fields_;
  std::vector<MemberInfo> members_;
  std::vector<Read> parts_;
  Read check_;
  bool is_open_ = false;
};

namespace field {

// The member becomes what `read` makes of the data, if anything: std::optional<Value>(const Data&, const
// MemberReader&).
template <class T, class Member, class Read>
Field<T> value(std::string name, Member T::*member, Read read) {
  return {std::move(name), [=](T& value, const Data& data, const MemberReader& reader) {
            if (auto found = read(data, reader)) value.*member = std::move(*found);
          }};
}

// The member "name" of a file that bears the same name.
template <class T>
Field<T> plain_name(const std::string& what, std::string T::*member) {
  const auto read = [what](const Data& data, const MemberReader& reader) { return reader.plain_name(data, what); };
  return value("name", member, read)
      .required()
      .means("lower-case letters, digits and `-`; the same as the file's name");
}

// The function sets what it likes of the struct.
template <class T>
Field<T> special(std::string name, void (*read)(T&, const Data&, const MemberReader&)) {
  return {std::move(name), read};
}

template <class T, class Member>
Field<T> number(const std::string& name, Member T::*member, NumberRange range = {}) {
  return {name, [=](T& value, const Data& data, const MemberReader& reader) {
            if (const auto read = reader.number(data, name, range)) value.*member = static_cast<Plain<Member>>(*read);
          }};
}

template <class T, class Member>
Field<T> whole(const std::string& name, Member T::*member, double least, double most) {
  return number(name, member, {least, most, true});
}

template <class T>
Field<T> flag(const std::string& name, bool T::*member) {
  return value(name, member, [=](const Data& data, const MemberReader& reader) { return reader.boolean(data, name); });
}

template <class T, class Member>
Field<T> text(const std::string& name, Member T::*member) {
  return value(name, member, [=](const Data& data, const MemberReader& reader) { return reader.text(data, name); });
}

// The words are in the order of an enumeration's values, or say false and true.
template <class T, class Member>
Field<T> choice(const std::string& name, Member T::*member, const std::vector<std::string>& words) {
  return {name, [=](T& value, const Data& data, const MemberReader& reader) {
            const auto read = reader.choice(data, name, words);
            if (!read) return;
            if constexpr (std::is_same_v<Member, std::string>)
              value.*member = words[*read];
            else
              value.*member = static_cast<Plain<Member>>(*read);
          }};
}

// The list has as many numbers as the member has places: an array, a vector of the space.
template <class T, class Member>
Field<T> numbers(const std::string& name, Member T::*member, const std::string& form, NumberRange range = {}) {
  return value(name, member, [=](const Data& data, const MemberReader& reader) {
    Plain<Member> values{};
    using Number = std::remove_cvref_t<decltype(values[0])>;
    constexpr size_t count = sizeof(values) / sizeof(Number);
    const auto read = reader.numbers(data, name, count, form, range);
    if (read)
      for (size_t n = 0; n < count; ++n) values[static_cast<int>(n)] = static_cast<Number>((*read)[n]);
    return read ? std::optional(values) : std::nullopt;
  });
}

template <class T, class Member>
Field<T> object(std::string name, Member T::*member, const Record<Plain<Member>>& record) {
  return value(std::move(name), member, [=](const Data& data, const MemberReader& reader) {
    Plain<Member> part{};
    return record.read(data, part, reader) ? std::optional(part) : std::nullopt;
  });
}

// A list of objects. The table may depend on what is already known of the struct: Record<Part>(const T& value).
template <class T, class Part, class MakeRecord>
requires std::invocable<MakeRecord, const T&> Field<T> objects(const std::string& name, std::vector<Part> T::*member,
                                                               MakeRecord make_record) {
  return {name, [=](T& value, const Data& data, const MemberReader& reader) {
            const DataList* const items = reader.list(data, name);
            if (!items) return;
            const Record<Part> record = make_record(value);
            for (const Data& item : *items) record.read(item, (value.*member).emplace_back(), reader);
          }};
}
template <class T, class Part>
Field<T> objects(const std::string& name, std::vector<Part> T::*member, const Record<Part>& record) {
  return objects(name, member, [=](const T&) { return record; });
}

}  // namespace field

}  // namespace ombre
