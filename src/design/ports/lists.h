// Lists of values as parameters, and values that may be missing.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "design/ports/port.h"

namespace ombre::design {

// An immutable list. Consecutive equal lists share memory, since loops make millions of them.
template <class T>
class SharedList {
 public:
  SharedList() = default;
  explicit SharedList(std::vector<T> list) {
    if (list.empty()) return;
    thread_local std::weak_ptr<const std::vector<T>> last;
    list_ = last.lock();
    if (list_ && *list_ == list) return;
    list_ = std::make_shared<const std::vector<T>>(std::move(list));
    last = list_;
  }

  std::span<const T> items() const { return list_ ? std::span<const T>(*list_) : std::span<const T>(); }
  auto begin() const { return items().begin(); }
  auto end() const { return items().end(); }
  size_t size() const { return items().size(); }
  bool empty() const { return items().empty(); }

 private:
  std::shared_ptr<const std::vector<T>> list_;  // null if empty
};

// Returns the elements of a list, or the data itself if it is one element.
template <class T>
std::optional<std::span<const Data>> elements_of(const Data& data) {
  if constexpr (requires { Port<T>::is_one(data); })
    if (Port<T>::is_one(data)) return std::span(&data, 1);
  if (!data.list()) return std::nullopt;
  return std::span<const Data>(*data.list());
}

template <class T>
Data written_list(std::span<const T> values, bool for_hash) {
  DataList list;
  list.reserve(values.size());
  for (const T& value : values) list.push_back(Port<T>::write(value, for_hash));
  return Data(std::move(list));
}

template <class T>
struct Port<std::vector<T>> {
  static PortText text(const Domain& domain) {
    const PortText one = Port<T>::text(domain);
    return {"list of " + one.plural, "lists of " + one.plural, "Sequence[" + one.python + "]"};
  }
  static bool read(const Data& data, const Domain& domain, std::vector<T>& value, const Reader& reader) {
    value.clear();
    const auto elements = elements_of<T>(data);
    if (!elements) return reader.fail(data, "a list of " + Port<T>::text(domain).plural);
    value.reserve(elements->size());
    bool good = true;
    for (const Data& element : *elements) good = Port<T>::read(element, domain, value.emplace_back(), reader) && good;
    return good;
  }
  static Data write(const std::vector<T>& value, bool for_hash) { return written_list(std::span(value), for_hash); }
};

// A single element counts as a list of one element.
template <class T>
struct Port<SharedList<T>> {
  static PortText text(const Domain& domain) {
    const PortText one = Port<T>::text(domain);
    return {"list of " + one.plural, "lists of " + one.plural,
            "Union[" + one.python + ", Sequence[" + one.python + "]]"};
  }
  static bool read(const Data& data, const Domain& domain, SharedList<T>& value, const Reader& reader) {
    const std::span<const Data> elements = data.list() ? std::span<const Data>(*data.list()) : std::span(&data, 1);
    std::vector<T> list(elements.size());
    bool good = true;
    for (size_t i = 0; i < list.size(); ++i) good = Port<T>::read(elements[i], domain, list[i], reader) && good;
    value = SharedList<T>(std::move(list));
    return good;
  }
  static Data write(const SharedList<T>& value, bool for_hash) { return written_list(value.items(), for_hash); }
  static bool uses_cell(const SharedList<T>& value) {
    return std::ranges::any_of(value, [](const T& element) { return design::uses_cell(element); });
  }
};

// Null data gives no value.
template <class T>
struct Port<std::optional<T>> {
  static PortText text(const Domain& domain) {
    PortText one = Port<T>::text(domain);
    one.python = "Optional[" + one.python + "]";
    return one;
  }
  static bool read(const Data& data, const Domain& domain, std::optional<T>& value, const Reader& reader) {
    value.reset();
    return data.is_null() || Port<T>::read(data, domain, value.emplace(), reader);
  }
  static Data write(const std::optional<T>& value, bool for_hash) {
    return value ? Port<T>::write(*value, for_hash) : Data();
  }
};

}  // namespace ombre::design
