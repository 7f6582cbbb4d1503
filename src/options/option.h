// Options of jobs as data. A job is a plain struct. A row for each of its members gives the option's name, its meaning
// and the values that it takes. Command line, help, completion, Python's keyword arguments and stubs, and job.json are
// derived from these rows.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "base/text/plain.h"
#include "options/option_values.h"

namespace ombre::options {

enum class Takes { nothing, one, several };

// The range of numbers that an option takes, ends included.
struct Limits {
  double least = 0, most = 0;
  bool is_whole = false;
};

struct Option {
  std::string names;        // "-o,--output"; a name without dashes is a positional argument
  std::string help;         // a sentence or its beginning
  std::string placeholder;  // name of the value in help texts: "FILE"
  std::string kind;         // name of the value's Kind (option_values.h), or "word" for choices, or "flag"
  Takes takes = Takes::one;
  std::vector<std::string> choices = {};  // the words that it takes; empty if it takes any text
  std::optional<Limits> limits = {};
  bool is_required = false;
  std::vector<std::string> needs = {}, excludes = {};  // names of other options of the job

  // Sets the option's member in the job at address `job`. `texts` is empty for flags. Throws WrongValue.
  std::function<void(void* job, const std::vector<std::string>& texts)> set = nullptr;
  // Returns the value of the option's member in the job at address `job`. Null for members that job.json does not hold.
  std::function<Data(const void* job)> value = nullptr;

  // Returns the first long name: "--output".
  std::string name() const;
};

// Returns why the choices or limits do not allow a text: `"x" is not a number from 0 to 1`. Returns "" if they allow
// it.
std::string problem(const std::vector<std::string>& choices, const std::string& text);
std::string problem(const Limits& limits, const std::string& text);
// Returns for example "0 to 120".
std::string range_text(const Limits& limits);

// An option of a Job, or the options of a group.
template <class Job>
struct Row {
  std::vector<Option> options;

  Row required() && {
    options.front().is_required = true;
    return std::move(*this);
  }
  Row needs(std::string name) && {
    options.front().needs.push_back(std::move(name));
    return std::move(*this);
  }
  Row excludes(std::vector<std::string> names) && {
    options.front().excludes = std::move(names);
    return std::move(*this);
  }
  Row between(double least, double most) && {
    options.front().limits = Limits{least, most, options.front().kind == "whole number"};
    return std::move(*this);
  }
};

template <class Job>
class Spec {
 public:
  Spec(std::initializer_list<Row<Job>> rows) {
    for (const Row<Job>& row : rows) options_.insert(options_.end(), row.options.begin(), row.options.end());
  }
  const std::vector<Option>& options() const { return options_; }

  // Returns the members of job.json that describe the job, in the order of the rows.
  DataMembers describe(const Job& job) const {
    DataMembers members;
    for (const Option& option : options_)
      if (option.value) members.emplace_back(option.name().substr(2), option.value(&job));
    return members;
  }

 private:
  std::vector<Option> options_;
};

// Returns the rows, whose options also append what they are set to, "--size=800x600", to a member of the job.
template <class Job>
Spec<Job> recorded(const Spec<Job>& spec, std::vector<std::string> Job::*member) {
  Row<Job> row{spec.options()};
  for (Option& option : row.options)
    option.set = [=, set = option.set, name = option.name()](void* job, const std::vector<std::string>& texts) {
      set(job, texts);
      std::vector<std::string>& settings = static_cast<Job*>(job)->*member;
      if (texts.empty()) settings.push_back(name);
      for (const std::string& text : texts) settings.push_back(std::string(name).append("=").append(text));
    };
  return {row};
}

template <class T>
void assign(T& member, T value) {
  member = std::move(value);
}
template <class T>
void assign(std::optional<T>& member, T value) {
  member = std::move(value);
}

// Returns an option with a value. Its member has the kind's type, or is an optional of it.
template <class Job, class Member, class T>
Row<Job> option(std::string names, Member Job::*member, const Kind<T>& kind, std::string help,
                std::string placeholder) {
  Option made{std::move(names), std::move(help), std::move(placeholder), kind.name};
  made.set = [member, read = kind.read, name = made.name()](void* job, const std::vector<std::string>& texts) {
    assign(static_cast<Job*>(job)->*member, read(texts.front(), name));
  };
  if constexpr (std::is_same_v<Member, uint64_t>)  // written as text, since a double cannot hold 64 bits
    made.value = [member](const void* job) { return std::to_string(static_cast<const Job*>(job)->*member); };
  return {{made}};
}

// Returns an option that may be repeated.
template <class Job, class T>
Row<Job> list(std::string names, std::vector<T> Job::*member, const Kind<T>& kind, std::string help,
              std::string placeholder) {
  Option made{std::move(names), std::move(help), std::move(placeholder), kind.name, Takes::several};
  made.set = [member, read = kind.read, name = made.name()](void* job, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) (static_cast<Job*>(job)->*member).push_back(read(text, name));
  };
  return {{made}};
}

template <class Job>
Row<Job> flag(std::string names, bool Job::*member, std::string help) {
  Option made{std::move(names), std::move(help), "", "flag", Takes::nothing};
  made.set = [member](void* job, const std::vector<std::string>&) { static_cast<Job*>(job)->*member = true; };
  return {{made}};
}

// Returns an option that takes one of the words. A string member gets the word; an enumeration, whose values are in the
// order of the words, gets the corresponding value.
template <class Job, class Member>
Row<Job> choice(std::string names, Member Job::*member, const std::vector<std::string>& words, std::string help,
                std::string placeholder) {
  using Chosen = Plain<Member>;
  Option made{std::move(names), std::move(help), std::move(placeholder), "word", Takes::one, words};
  made.set = [member, words](void* job, const std::vector<std::string>& texts) {
    Member& chosen = static_cast<Job*>(job)->*member;
    if constexpr (std::is_same_v<Chosen, std::string>)
      chosen = texts.front();
    else
      chosen = static_cast<Chosen>(std::find(words.begin(), words.end(), texts.front()) - words.begin());
  };
  if constexpr (std::is_enum_v<Member>)
    made.value = [member, words](const void* job) {
      return words[static_cast<size_t>(static_cast<const Job*>(job)->*member)];
    };
  return {{made}};
}

// Returns the options of a struct that is a member of several jobs.
template <class Job, class Part>
Row<Job> group(Part Job::*part, const Spec<Part>& spec) {
  Row<Job> row{spec.options()};
  for (Option& option : row.options) {
    option.set = [part, set = option.set](void* job, const std::vector<std::string>& texts) {
      set(&(static_cast<Job*>(job)->*part), texts);
    };
    if (option.value)
      option.value = [part, value = option.value](const void* job) {
        return value(&(static_cast<const Job*>(job)->*part));
      };
  }
  return row;
}
// Returns the options of several such structs, one after another.
template <class Job, class... Parts>
Row<Job> group(Parts Job::*... parts) {
  Row<Job> row;
  const auto append = [&](std::vector<Option> options) { std::ranges::move(options, std::back_inserter(row.options)); };
  (append(group(parts, Parts::options()).options), ...);
  return row;
}

}  // namespace ombre::options
