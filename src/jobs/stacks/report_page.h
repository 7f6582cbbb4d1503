// A page in HTML that needs no other files.
#pragma once

#include <string>
#include <vector>

namespace ombre::jobs {

class ReportPage {
 public:
  explicit ReportPage(const std::string& title);

  // Adds a list with a heading, unless it is empty.
  void add_list(const std::string& heading, const std::vector<std::string>& lines);
  // The first row is the head. Rows may be shorter.
  void add_table(const std::vector<std::vector<std::string>>& rows);
  void add_heading(const std::string& heading);
  void add_picture(const std::string& title, const std::string& png);
  std::string html() const { return html_ + "</body>\n</html>\n"; }

 private:
  std::string html_;
};

}  // namespace ombre::jobs
