#include "base/text/json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "base/text/text.h"

namespace ombre {
namespace {

// Counts the characters that the parser has read, to find the positions of values. The parser reads one character past
// a number; token() corrects this when it seeks the start of the next token.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  size_t* count = nullptr;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    ++at;
    ++*count;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
  bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(const SourcePtr& source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  size_t read = 0;
  Data root;

  bool null() override { return add({}); }
  bool boolean(bool value) override { return add(Data(value)); }
  bool number_integer(number_integer_t value) override { return add(Data(static_cast<double>(value))); }
  bool number_unsigned(number_unsigned_t value) override { return add(Data(static_cast<double>(value))); }
  bool number_float(number_float_t value, const string_t&) override { return add(Data(value)); }
  bool string(string_t& value) override { return add(Data(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Data(DataMembers{})); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Data(DataList{})); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    const SourceRange where = token();
    if (!names_.back().insert(name).second)
      diagnostics_.error(Code::twice, where, "the key \"" + name + "\" is given twice");
    keys_.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    // Keeps the last part of "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ..."
    // or "[json.exception.out_of_range.406] number overflow parsing '1e999'".
    std::string message = error.what();
    const bool has_place = message.find("] parse error at ") != std::string::npos;
    if (const size_t at = message.find(has_place ? ": " : "] "); at != std::string::npos)
      message = message.substr(at + 2);
    const auto offset = static_cast<uint32_t>(position > 0 ? position - 1 : 0);
    for (const char bracket : {'}', ']'}) {
      const std::string end = std::string("; expected '") + bracket + "'";
      if (const size_t at = message.find(end); at != std::string::npos)
        message.replace(at, end.size(), std::string("; expected ',' or '") + bracket + "'");
    }
    const auto size = static_cast<uint32_t>(source_->text().size());
    diagnostics_.error({source_, std::min(offset, size), std::min(offset + 1, size)},
                       "this is not valid JSON: " + message);
    return false;
  }

 private:
  static constexpr size_t deepest = 200;

  // Returns the range of the token that was just read. It starts at the first character after the previous token that
  // can begin a token.
  SourceRange token() {
    const std::string_view text = source_->text();
    size_t begin = text.find_first_not_of(" \t\r\n,:", last_end_);
    if (begin == std::string_view::npos) begin = text.size();
    size_t end = std::max(read, begin);
    while (end > begin + 1 && end <= text.size() &&
           std::string_view(" \t\r\n,:]}").find(text[end - 1]) != std::string_view::npos && text[begin] != '"' &&
           text[begin] != '[' && text[begin] != '{')
      --end;
    last_end_ = end;
    return {source_, static_cast<uint32_t>(begin), static_cast<uint32_t>(std::min(end, text.size()))};
  }

  bool place(Data data) {
    if (stack_.empty()) {
      root = std::move(data);
      return true;
    }
    if (auto* list = std::get_if<DataList>(&stack_.back().value)) {
      list->push_back(std::move(data));
    } else {
      std::get<DataMembers>(stack_.back().value).emplace_back(std::move(keys_.back()), std::move(data));
      keys_.pop_back();
    }
    return true;
  }

  bool add(Data data) {
    data.where = token();
    // A string without escapes consists of the characters between the quotes.
    if (const std::string* s = data.string(); s && data.where.end - data.where.begin == s->size() + 2) {
      ++data.where.begin;
      --data.where.end;
    }
    return place(std::move(data));
  }

  bool open(Data data) {
    data.where = token();
    if (stack_.size() >= deepest) {
      diagnostics_.error(Code::limit, data.where, "this nests deeper than " + std::to_string(deepest) + " levels");
      return false;
    }
    stack_.push_back(std::move(data));
    names_.emplace_back();
    return true;
  }

  bool close() {
    const SourceRange where = token();
    Data data = std::move(stack_.back());
    stack_.pop_back();
    names_.pop_back();
    data.where.end = where.end;
    return place(std::move(data));
  }

  const SourcePtr& source_;
  Diagnostics& diagnostics_;
  std::vector<Data> stack_;
  std::vector<std::string> keys_;
  std::vector<std::unordered_set<std::string>> names_;  // the keys of all open objects
  size_t last_end_ = 0;
};

// Returns the string as a JSON literal. Invalid UTF-8 becomes U+FFFD.
std::string quoted(const std::string& text) {
  const auto is_plain = [](char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return '"' + text + '"';
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "null";
  // Writes integers without an exponent, so that other programs read them as integers.
  if (std::abs(value) < 0x1p53 && value == std::trunc(value)) return std::to_string(static_cast<long long>(value));
  return format_number(value == 0 ? 0.0 : value);
}

// Returns the text of a value that is neither a list nor an object.
std::string scalar_text(const Data& data) {
  if (const bool* b = data.boolean()) return *b ? "true" : "false";
  if (const double* n = data.number()) return number_text(*n);
  if (const std::string* s = data.string()) return quoted(*s);
  if (data.host_object()) return quoted("a function of the host program");  // for people only; it cannot be read back
  return "null";
}

constexpr size_t longest_line = 100;

// Prints lists and objects on one line if they fit.
class Printer {
 public:
  std::string print(const Data& data, size_t indent) const {
    if (const DataList* list = data.list()) {
      std::vector<std::string> parts;
      bool flat = true;
      for (const Data& element : *list) {
        flat = flat && !element.members();
        parts.push_back(print(element, indent + 2));
      }
      return bracket(parts, '[', ']', indent, flat);
    }
    const DataMembers* members = data.members();
    if (!members) return scalar_text(data);
    std::vector<std::string> parts;
    for (const auto& [key, member] : *members) parts.push_back(quoted(key) + ": " + print(member, indent + 2));
    return bracket(parts, '{', '}', indent, indent >= 4);
  }

 private:
  std::string bracket(const std::vector<std::string>& parts, char open, char close, size_t indent,
                      bool may_be_flat) const {
    if (parts.empty()) return {open, close};
    size_t width = indent;
    for (const std::string& part : parts) {
      width += part.size() + 2;
      may_be_flat = may_be_flat && part.find('\n') == std::string::npos;
    }
    if (may_be_flat && width <= longest_line) return open + join(parts, ", ") + close;
    const std::string pad(indent + 2, ' ');
    return open + ("\n" + pad) + join(parts, ",\n" + pad) + "\n" + std::string(indent, ' ') + close;
  }
};

void append_line(const Data& data, std::string& text) {
  if (const DataList* list = data.list()) {
    char before = '[';
    for (const Data& element : *list) {
      text += std::exchange(before, ',');
      append_line(element, text);
    }
    text += list->empty() ? "[]" : "]";
  } else if (const DataMembers* members = data.members()) {
    char before = '{';
    for (const auto& [key, member] : *members) {
      text += std::exchange(before, ',');
      text += quoted(key) + ':';
      append_line(member, text);
    }
    text += members->empty() ? "{}" : "}";
  } else {
    text += scalar_text(data);
  }
}

}  // namespace

std::optional<Data> parse_json(const SourcePtr& source, Diagnostics& diagnostics) {
  Builder builder(source, diagnostics);
  const std::string_view text = source->text();
  const size_t errors_before = diagnostics.error_count();
  const CountingIterator begin{text.data(), &builder.read}, end{text.data() + text.size(), &builder.read};
  const bool parsed = nlohmann::json::sax_parse(begin, end, &builder);
  if (!parsed || diagnostics.error_count() > errors_before) return std::nullopt;
  return std::move(builder.root);
}

std::string print_json(const Data& data) { return Printer().print(data, 0) + '\n'; }

std::string print_json_line(const Data& data) {
  std::string text;
  append_line(data, text);
  return text;
}

}  // namespace ombre
