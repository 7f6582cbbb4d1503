// Values with named members, which OpenSCAD calls objects.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lang/engine/value.h"

namespace ombre::lang {

// The names are those of a finished RecordBuilder, each once.
struct Record {
  using Members = std::vector<std::pair<std::string, Value>>;  // in the order in which they were set first

  Record(Members m, uint64_t bytes, Meter& counter);
  ~Record();
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  const Value* find(const std::string& name) const;  // null if there is none

  Members members;
  std::map<std::string, size_t> places;  // of the members
  uint64_t weight;                       // as that of a list
  int depth;
  uint64_t name_bytes;
  Meter& meter;
};

// Collects members within the limits.
class RecordBuilder {
 public:
  explicit RecordBuilder(Meter& meter) : meter_(meter) {}
  ~RecordBuilder();
  RecordBuilder(const RecordBuilder&) = delete;
  RecordBuilder& operator=(const RecordBuilder&) = delete;

  void set(const std::string& name, Value value);  // an older value of the name is replaced in its place
  void set_all(const Record& other);
  void remove(const std::string& name);
  Value finish();

 private:
  Meter& meter_;
  Record::Members members_;
  std::map<std::string, size_t> places_;
  uint64_t name_bytes_ = 0;
};

}  // namespace ombre::lang
