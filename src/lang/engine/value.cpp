#include "lang/engine/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lang/engine/scope.h"

namespace ombre::lang {

List::List(std::vector<Value> i, const ast::List* o, Meter& m)
    : items(std::move(i)), origin(o), weight(items.size()), depth(1), meter(m) {
  for (const Value& item : items) {
    weight += weight_of(item);
    depth = std::max(depth, depth_of(item) + 1);
  }
}

uint64_t weight_of(const Value& value) {
  if (const List* list = value.list()) return list->weight;
  return value.record() ? value.record()->weight : 0;
}

int depth_of(const Value& value) {
  if (const List* list = value.list()) return list->depth;
  return value.record() ? value.record()->depth : 0;
}

void check_nesting(uint64_t weight, int depth, const Meter& meter) {
  if (weight > meter.limits().elements) meter.too_many_elements();
  if (depth > meter.limits().list_depth)
    throw LimitReached{"lists nest deeper than " + std::to_string(meter.limits().list_depth) + " levels",
                       "join lists with concat or each instead of putting them into each other"};
}

Value ListBuilder::finish(const ast::List* origin) {
  auto list = std::make_shared<const List>(std::move(items_), origin, meter_);
  items_.clear();  // the elements are now counted with the list
  check_nesting(list->weight, list->depth, meter_);
  return ListPtr(std::move(list));
}

namespace {

// Memory of a member's name in its two places, without its letters.
constexpr uint64_t name_overhead = 2 * Text::overhead + 64;

uint64_t bytes_of(const std::string& name) { return 2 * name.size() + name_overhead; }

}  // namespace

Record::Record(Members m, uint64_t bytes, Meter& counter)
    : members(std::move(m)), weight(members.size()), depth(1), name_bytes(bytes), meter(counter) {
  for (size_t n = 0; n < members.size(); ++n) {
    const auto& [name, value] = members[n];
    places.emplace(name, n);
    weight += weight_of(value);
    depth = std::max(depth, depth_of(value) + 1);
  }
}

Record::~Record() {
  meter.release_elements(members.size());
  meter.release_text(name_bytes);
}

const Value* Record::find(const std::string& name) const {
  const auto found = places.find(name);
  return found == places.end() ? nullptr : &members[found->second].second;
}

RecordBuilder::~RecordBuilder() {
  meter_.release_elements(members_.size());
  meter_.release_text(name_bytes_);
}

void RecordBuilder::set(const std::string& name, Value value) {
  meter_.spend(1 + name.size() / 16);
  if (const auto known = places_.find(name); known != places_.end()) {
    members_[known->second].second = std::move(value);
    return;
  }
  meter_.check_text(bytes_of(name));
  meter_.claim_element();
  members_.emplace_back(name, std::move(value));
  places_.emplace(name, members_.size() - 1);
  name_bytes_ += bytes_of(name);
  meter_.claim_text(bytes_of(name));
}

void RecordBuilder::set_all(const Record& other) {
  for (const auto& [name, value] : other.members) set(name, value);
}

void RecordBuilder::remove(const std::string& name) {
  const auto known = places_.find(name);
  if (known == places_.end()) return;
  meter_.spend(members_.size());
  const size_t place = known->second;
  places_.erase(known);
  members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(place));
  for (auto& [other, at] : places_) at -= at > place ? 1 : 0;
  meter_.release_elements(1);
  meter_.release_text(bytes_of(name));
  name_bytes_ -= bytes_of(name);
}

Value RecordBuilder::finish() {
  auto record = std::make_shared<const Record>(std::move(members_), name_bytes_, meter_);
  members_.clear();  // the members are now counted with the record
  name_bytes_ = 0;
  check_nesting(record->weight, record->depth, meter_);
  return RecordPtr(std::move(record));
}

const Object* first_object(std::span<const Value> values) {
  const auto found = std::ranges::find_if(values, [](const Value& value) { return value.object() != nullptr; });
  return found == values.end() ? nullptr : found->object();
}

bool holds_object(const Value& value) {
  if (const List* list = value.list()) return std::ranges::any_of(list->items, holds_object);
  return value.object() != nullptr;
}

std::string_view hint_for(const Value& found) {
  return found.object() ? "it is known only while the job runs; write a number here, and give the value to a solid: "
                          "sphere(5 + t);"
                        : "";
}

Value make_text(std::string text, Meter& meter) {
  return TextPtr(std::make_shared<const Text>(std::move(text), nullptr, meter));
}

Value make_list(const std::vector<double>& numbers, Meter& meter) {
  ListBuilder result(meter);
  for (const double number : numbers) result.push(number);
  return result.finish();
}

double Range::count() const {
  const double steps = (end - begin) / step;
  return steps < 0 ? 0 : std::floor(steps + std::min(steps * 1e-12, 1e-6)) + 1;
}

bool is_true(const Value& value) {
  if (value.is_undef()) return false;
  if (const bool* b = value.boolean()) return *b;
  if (const double* n = value.number()) return *n != 0;
  if (const Text* t = value.text()) return !t->text.empty();
  if (const List* l = value.list()) return !l->items.empty();
  if (const Record* r = value.record()) return !r->members.empty();
  return true;
}

namespace {

bool equal_lists(const List& a, const List& b, Meter& meter) {
  if (&a == &b) return true;
  if (a.items.size() != b.items.size()) return false;
  for (size_t i = 0; i < a.items.size(); ++i)
    if (!equal(a.items[i], b.items[i], meter)) return false;
  return true;
}

// The order of members does not matter.
bool equal_records(const Record& a, const Record& b, Meter& meter) {
  if (&a == &b) return true;
  if (a.members.size() != b.members.size()) return false;
  for (const auto& [name, value] : a.members) {
    const Value* other = b.find(name);
    if (!other || !equal(value, *other, meter)) return false;
  }
  return true;
}

}  // namespace

bool equal(const Value& a, const Value& b, Meter& meter) {
  meter.spend();
  if (a.is_undef() || b.is_undef()) return a.is_undef() && b.is_undef();
  if (const bool* x = a.boolean()) return b.boolean() && *x == *b.boolean();
  if (const double* x = a.number()) return b.number() && *x == *b.number();
  if (const Text* x = a.text()) {
    if (b.text()) meter.spend(std::min(x->text.size(), b.text()->text.size()) / 16);
    return b.text() && x->text == b.text()->text;
  }
  if (const List* x = a.list()) return b.list() && equal_lists(*x, *b.list(), meter);
  if (const Range* x = a.range()) {
    const Range* y = b.range();
    return y && x->begin == y->begin && x->step == y->step && x->end == y->end;
  }
  if (const Record* x = a.record()) return b.record() && equal_records(*x, *b.record(), meter);
  if (a.object()) return a.object() == b.object();
  return a.closure() && a.closure() == b.closure();
}

std::string describe(const Value& value) {
  if (value.boolean()) return "a boolean";
  if (value.number()) return "a number";
  if (value.text()) return "a string";
  if (const List* list = value.list())
    return list->items.empty() ? "an empty list" : "a list of " + std::to_string(list->items.size());
  if (value.range()) return "a range";
  if (value.closure()) return "a function";
  if (value.record()) return "an object";
  if (const Object* object = value.object()) return object->describe();
  return "undef";
}

std::string number_text(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  if (number == 0) return "0";
  std::array<char, 40> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::general, 15).ptr;
  return {buffer.data(), end};
}

void append_text(std::string& text, const Value& value, bool quoted, Meter& meter, const TextStyle& style) {
  meter.spend();
  meter.check_text(text.size());
  if (const bool* b = value.boolean()) {
    text += *b ? "true" : "false";
  } else if (const double* n = value.number()) {
    text += style.number(*n);
  } else if (const Text* t = value.text()) {
    meter.check_text(text.size() + t->text.size());
    text += quoted ? '"' + t->text + '"' : t->text;
  } else if (const List* list = value.list()) {
    text += '[';
    for (size_t i = 0; i < list->items.size(); ++i) {
      if (i > 0) text += ", ";
      append_text(text, list->items[i], true, meter, style);
    }
    text += ']';
  } else if (const Range* range = value.range()) {
    text +=
        '[' + style.number(range->begin) + " : " + style.number(range->step) + " : " + style.number(range->end) + ']';
  } else if (const Closure* closure = value.closure()) {
    text += style.function(*closure);
  } else if (const Record* record = value.record()) {
    text += "{ ";
    for (const auto& [name, member] : record->members) {
      text += name + " = ";
      append_text(text, member, true, meter, style);
      text += "; ";
    }
    text += '}';
  } else if (const Object* object = value.object()) {
    text += object->text();
  } else {
    text += "undef";
  }
}

bool is_number_list(const List& list) {
  return std::all_of(list.items.begin(), list.items.end(), [](const Value& item) { return item.number() != nullptr; });
}

Value from_data(const Data& data, Meter& meter) {
  if (const bool* b = data.boolean()) return *b;
  if (const double* n = data.number()) return *n;
  if (const std::string* s = data.string()) return make_text(*s, meter);
  if (const DataMembers* members = data.members()) {
    RecordBuilder builder(meter);
    for (const auto& [name, member] : *members) builder.set(name, from_data(member, meter));
    return builder.finish();
  }
  const DataList* list = data.list();
  if (!list) return {};
  ListBuilder builder(meter);
  for (const Data& item : *list) builder.push(from_data(item, meter));
  return builder.finish();
}

}  // namespace ombre::lang
