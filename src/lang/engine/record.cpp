#include "lang/engine/record.h"

#include <algorithm>

namespace ombre::lang {
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

}  // namespace ombre::lang
