// ombre formats: the formats of files that designs read and jobs write.
#include <algorithm>

#include "base/text/markdown.h"
#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/reference/list_or_page.h"
#include "sources/file_formats.h"

namespace ombre::jobs {
namespace {

std::string use_of(const FileFormat& format) {
  if (!format.is_written) return "read";
  return format.is_read ? "read, written" : "written";
}

std::string ending_texts(const FileFormat& format) {
  return join(std::vector<std::string>(format.endings.begin(), format.endings.end()), ", ");
}

void list_formats(const Session& session) {
  for (const FileFormat& format : sources::file_formats()) {
    if (session.events.wants_data()) {
      DataList endings;
      for (const std::string_view ending : format.endings) endings.emplace_back(std::string(ending));
      DataMembers members{{"name", std::string(format.name)},
                          {"holds", std::string(name_of(format.content))},
                          {"endings", std::move(endings)},
                          {"is_read", format.is_read},
                          {"is_written", format.is_written}};
      if (format.module) {
        members.emplace_back("library", format.module->library);
        members.emplace_back("is_available", has_module(*format.module));
      }
      if (format.is_read) {
        members.emplace_back("refused", std::string(format.refused));
        members.emplace_back("left_out", std::string(format.left_out));
      }
      session.events.event("format", members);
      continue;
    }
    constexpr size_t name_width = 28, ending_width = 22, use_width = 15;
    std::string line(format.name);
    line.append(name_width - std::min(line.size(), name_width - 1), ' ');
    const std::string endings = ending_texts(format);
    line.append(endings).append(ending_width - std::min(endings.size(), ending_width - 1), ' ');
    line.append(use_of(format)).append(use_width - use_of(format).size(), ' ').append(name_of(format.content));
    if (format.module && !has_module(*format.module)) line.append("; ").append(without(*format.module));
    session.events.print(line + "\n");
  }
}

// A table of what the readers refuse and leave out.
std::string limits_of_readers() {
  std::string text =
      "\n## Contents that are not read\n\nContent that could change shape, place, number or material and is not "
      "understood "
      "is an error. Readers warn once\nof content that they leave out and that could matter, with its count.\n\n| "
      "format | an error | left out "
      "|\n| --- | --- | --- |\n";
  for (const FileFormat& format : sources::file_formats()) {
    if (format.refused.empty() && format.left_out.empty()) continue;
    text += table_row({std::string(format.name), std::string(format.refused), std::string(format.left_out)});
  }
  return text;
}

// A page of the reference, with a row for each format.
std::string formats_reference() {
  std::string text =
      "# File formats\n\nMade by `ombre formats --markdown`. A library is named where a build may lack it; the "
      "packages "
      "are Debian's, the option\nCMake's.\n\n| format | endings | holds | | needs |\n| --- | --- | --- | --- | --- |\n";
  for (const FileFormat& format : sources::file_formats()) {
    const Module* const module = format.module;
    text += table_row(
        {std::string(format.name),
         "`" + join(std::vector<std::string>(format.endings.begin(), format.endings.end()), "` `") + "`",
         std::string(name_of(format.content)), use_of(format),
         module ? std::string(module->library) + " (" + module->packages + ", `" + module->option + "`)" : ""});
  }
  return text + limits_of_readers();
}

}  // namespace

JobKind formats_kind() {
  return job_kind<ListChoices>("formats", "List the formats of files that are read and written",
                               "Example:\n  ombre formats\n", list_or_print<list_formats, formats_reference>);
}

}  // namespace ombre::jobs
