#include "jobs/stacks/report_page.h"

#include "formats/containers/base64.h"
#include "formats/containers/xml_text.h"

namespace ombre::jobs {
namespace {}  // namespace

ReportPage::ReportPage(const std::string& title)
    : html_("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
            formats::xml_escaped(title) +
            "</title>\n<style>body { font-family: sans-serif; max-width: 60em; margin: 2em auto; }\n"
            "img { max-width: 100%; }</style>\n</head>\n<body>\n<h1>" +
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

void ReportPage::add_picture(const std::string& title, const std::string& png) {
  html_ += "<h3>" + formats::xml_escaped(title) + "</h3>\n<img alt=\"" + formats::xml_escaped(title) +
           "\" src=\"data:image/png;base64," + formats::to_base64(png) + "\">\n";
}

}  // namespace ombre::jobs
