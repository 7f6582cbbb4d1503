// Reads members of JSON studies, and reports each mistake at its place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::compile {

class StudyMembers {
 public:
  // `what` names the object in messages: "a variable". Adds a diagnostic when it is no object or has other members.
  StudyMembers(const Data& data, std::string what, const std::vector<std::string>& known, Diagnostics& diagnostics);

  bool has(const std::string& name) const { return data_.find(name) != nullptr; }
  const Data* find(const std::string& name) const { return data_.find(name); }
  const Data& data() const { return data_; }

  // Returns `missing` if there is no such member; adds a diagnostic if there is neither, or the member has another
  // type.
  double number(const std::string& name, std::optional<double> missing, double least, double most);
  bool boolean(const std::string& name, bool missing);
  std::string text(const std::string& name, const std::optional<std::string>& missing);
  std::string choice(const std::string& name, const std::string& missing, const std::vector<std::string>& choices);
  std::optional<Box> box(const std::string& name);

  void fail(const Data& at, const std::string& message, const Phrase& hint = {});

 private:
  const Data& data_;
  std::string what_;
  Diagnostics& diagnostics_;
};

}  // namespace ombre::compile
