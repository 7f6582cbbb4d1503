// A summary of a file: lines for people, and members for programs.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/box.h"
#include "base/math/point_text.h"
#include "base/text/data.h"
#include "base/text/text.h"

namespace ombre::jobs {

struct FileSummary {
  std::string event, kind;  // "mesh", "a surface mesh"
  std::string text = {};    // lines that follow the kind
  DataMembers members = {};

  // Adds a member, and a line unless its text is empty. The line begins with the name's first word.
  void add(const std::string& name, const std::string& shown, Data value) {
    members.emplace_back(name, std::move(value));
    if (!shown.empty()) text += label(name) + shown + "\n";
  }
  void add_count(const std::string& name, size_t count) {
    add(name, format_count(count), Data(static_cast<double>(count)));
  }
  void add_box(const Box& box) {
    if (box.is_empty()) return;
    add("bounds_mm", "from " + format_point(box.lo, 6) + " to " + format_point(box.hi, 6) + " mm",
        Data(DataList{box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}));
  }
  void add_names(const std::string& name, const std::vector<std::string>& words) {
    constexpr size_t most_shown = 12;
    std::vector<std::string> shown(words.begin(),
                                   words.begin() + static_cast<std::ptrdiff_t>(std::min(words.size(), most_shown)));
    if (words.size() > most_shown) shown.push_back("and " + format_count(words.size() - most_shown) + " more");
    add(name, join(shown, ", "), Data(DataList(words.begin(), words.end())));
  }

 private:
  static std::string label(const std::string& name) {
    constexpr size_t width = 14;
    std::string label = "  " + name.substr(0, name.find('_'));
    label.resize(std::max(label.size() + 1, width), ' ');
    return label;
  }
};

}  // namespace ombre::jobs
