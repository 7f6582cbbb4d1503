#include "jobs/stacks/report_page.h"

#include "formats/containers/base64.h"
#include "formats/containers/xml_text.h"

namespace ombre::jobs {
namespace {}  // namespace

ReportPage::ReportPage(const std::string& title)
    : html_(
          "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
          formats::xml_escaped(title) +
          "</title>\n<style>body { font-family: sans-serif; max-width: 60em; margin: 2em auto; }\n"
          "img { max-width: 100%; } td, th { padding: 0.2em 0.6em; text-align: left; }</style>\n</head>\n<body>\n<h1>" +
          formats::xml_escaped(title) + "</h1>\n") {}

void ReportPage::add_list(const std::string& heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  add_heading(heading);
  html_ += "<ul>\n";
  for (const std::string& line : lines) html_ += "<li>" + formats::xml_escaped(line) + "</li>\n";
  html_ += "</ul>\n";
}

void ReportPage::add_heading(const std::string& heading) {
  html_ += "<h2>" + formats::xml_escaped(heading) + "</h2>\n";
}

void ReportPage::add_table(const std::vector<std::vector<std::string>>& rows) {
  html_ += "<table>\n";
  for (size_t n = 0; n < rows.size(); ++n) {
    html_ += "<tr>";
    const std::string cell = n == 0 ? "th" : "td";
    for (const std::string& text : rows[n])
      html_.append("<" + cell + ">").append(formats::xml_escaped(text)).append("</" + cell + ">");
    html_ += "</tr>\n";
  }
  html_ += "</table>\n";
}

void ReportPage::add_picture(const std::string& title, const std::string& png) {
  html_ += "<h3>" + formats::xml_escaped(title) + "</h3>\n<img alt=\"" + formats::xml_escaped(title) +
           "\" src=\"data:image/png;base64," + formats::to_base64(png) + "\">\n";
}

}  // namespace ombre::jobs
