// Builtin functions of lists, and of objects.
#include <cmath>

#include "base/text/utf8.h"
#include "lang/engine/builtins.h"
#include "lang/engine/common_functions.h"

namespace ombre::lang {
namespace {

Value lookup(const BuiltinCall& call) {
  const double key = call.number(0);
  const List& table = call.list(1);
  call.meter.spend(table.items.size());
  return common::lookup(key, table, [&](const Value& row) {
    const List* pair = row.list();
    if (!pair || pair->items.size() < 2 || !pair->items[0].number() || !pair->items[1].number())
      call.expected(1, "a list of [key, value] pairs", "write lookup(key, [[key, value], [key, value], ...])");
    return pair;
  });
}

// Finds the positions of values in a list, or of characters in a string.
class Search {
 public:
  explicit Search(const BuiltinCall& call) : call_(call) {
    most_ = call.has(2) ? call.number(2) : 1;
    column_ = call.has(3) ? call.number(3) : 0;
    if (!call[1].list() && !call[1].text()) call.expected(1, "a list or a string to search in");
    if (const Text* text = call[1].text()) characters_ = characters(text->text);
  }

  Value run() {
    const Value& wanted = call_[0];
    if (!wanted.text() && !wanted.list()) return make_list(places(wanted), call_.meter);
    ListBuilder result(call_.meter);
    if (const Text* text = wanted.text())
      for (const Value& character : characters(text->text)) add(character, false, result);
    if (const List* list = wanted.list())
      for (const Value& value : list->items) add(value, true, result);
    return result.finish();
  }

 private:
  // A listed value that is not found gives [].
  void add(const Value& wanted, bool is_listed, ListBuilder& result) {
    common::push_places(places(wanted), most_ == 1, is_listed, result, call_.meter);
  }

  std::vector<double> places(const Value& wanted) const {
    std::vector<double> found;
    const auto* list = call_[1].list();
    const std::vector<Value>& items = list ? list->items : characters_;
    for (size_t i = 0; i < items.size(); ++i) {
      call_.meter.spend();
      if (!matches(items[i], wanted)) continue;
      found.push_back(static_cast<double>(i));
      if (most_ > 0 && static_cast<double>(found.size()) >= most_) break;
    }
    return found;
  }

  bool matches(const Value& item, const Value& wanted) const {
    const List* row = item.list();
    if (!row) return equal(item, wanted, call_.meter);
    const bool has_column = column_ >= 0 && column_ < static_cast<double>(row->items.size());
    return (has_column && equal(row->items[static_cast<size_t>(column_)], wanted, call_.meter)) ||
           (wanted.list() && equal(item, wanted, call_.meter));
  }

  std::vector<Value> characters(const std::string& text) const {
    std::vector<Value> result;
    for (size_t at = 0; at < text.size();) {
      call_.meter.spend();
      if (result.size() >= call_.meter.limits().elements) call_.meter.too_many_elements();
      const size_t size = character_size(text, at);
      result.push_back(make_text(text.substr(at, size), call_.meter));
      at += size;
    }
    return result;
  }

  const BuiltinCall& call_;
  double most_, column_;
  std::vector<Value> characters_;  // characters of the string that is searched; empty for a list
};

Value search(const BuiltinCall& call) { return Search(call).run(); }

Value object(const BuiltinCall& call) {
  RecordBuilder members(call.meter);
  for (size_t n = 0; n < call.size(); ++n) {
    if (!call.name_of(n).empty())
      members.set(call.name_of(n), call[n]);
    else if (const Record* other = call[n].record())
      members.set_all(*other);
    else
      return call.expected(n, "members with names, or objects", "write for example object(size = 3)");
  }
  return members.finish();
}

Value is_object(const BuiltinCall& call) { return call[0].record() != nullptr; }

Value is_solid(const BuiltinCall& call) {
  const auto object = call[0].object();
  return object && object->form() == Object::Form::solid;
}

Value has_key(const BuiltinCall& call) {
  const Record* record = call[0].record();
  return record ? Value(record->find(call.text(1)) != nullptr) : call.expected(0, "an object");
}

}  // namespace

std::vector<Builtin> list_builtins() {
  return {
      {"lookup", {"key", "table"}, 2, false, lookup},
      {"search", {"match_value", "string_or_vector", "num_returns_per_match", "index_col_num"}, 2, false, search},
      {"object", {}, 0, true, object, true},
      {"is_object", {"value"}, 1, false, is_object},
      {"is_solid", {"value"}, 1, false, is_solid},
      {"has_key", {"object", "name"}, 2, false, has_key},
  };
}

}  // namespace ombre::lang
