#include "jobs/stacks/verify_report.h"

#include <map>

#include "base/text/text.h"
#include "jobs/stacks/report_page.h"

namespace ombre::jobs {
namespace {

using compile::Finding;
using compile::FindingPicture;
using compile::Verification;

constexpr size_t most_of_kind = 10;  // findings of a kind that people read

// Returns the first findings of each kind, and a line for those that are left out.
std::vector<std::string> shortened(const compile::Findings& findings) {
  std::map<std::string, size_t> counts;
  std::vector<std::string> lines;
  for (const Finding& finding : findings)
    if (++counts[finding.kind] <= most_of_kind) lines.push_back(finding.kind + ": " + finding.text);
  for (const auto& [kind, count] : counts)
    if (count > most_of_kind) lines.push_back(kind + ": and " + format_count(count - most_of_kind) + " more");
  return lines;
}

// Returns what was looked at, a sentence each.
std::vector<std::string> summary(const Verification& all) {
  std::vector<std::string> lines{format_count(static_cast<unsigned long long>(all.stack.layers)) + " of " +
                                 format_count(static_cast<unsigned long long>(all.layer_count)) +
                                 " layers were read, " + format_count(all.stack.files) + " images of " +
                                 format_bytes(static_cast<double>(all.stack.bytes))};
  if (!all.design) return lines;
  const compile::DesignCheck& design = *all.design;
  lines.push_back(
      format_count(design.voxels) +
      " voxels were evaluated again by the reference; within rounding of a boundary: " + format_count(design.rounded));
  if (design.diffused > 0)
    lines.push_back(format_count(design.diffused) +
                    " differ since diffusion passed on what was rounded; their layers are what the job's own "
                    "evaluator gives, and their fractions were compared in " +
                    format_count(design.windows) + " windows (chi square, level 1e-6)");
  return lines;
}

std::string verdict(const Verification& all) {
  const size_t count = all.findings().size();
  if (count == 0) return "everything that was checked holds";
  return format_count(count) + (count == 1 ? " thing does not hold" : " things do not hold");
}

}  // namespace

void tell_verification(const Events& events, const Verification& all) {
  DataList findings, unchecked;
  for (const Finding& finding : all.findings()) {
    DataMembers members{{"kind", finding.kind}, {"text", finding.text}};
    if (finding.layer) members.emplace_back("layer", number(*finding.layer));
    findings.emplace_back(std::move(members));
  }
  const std::vector<std::string> not_checked = all.unchecked();
  unchecked.assign(not_checked.begin(), not_checked.end());
  DataMembers members{{"holds", all.findings().empty()},
                      {"findings", std::move(findings)},
                      {"unchecked", std::move(unchecked)},
                      {"layers", number(all.stack.layers)},
                      {"files", number(all.stack.files)}};
  if (all.design) {
    members.emplace_back("voxels_compared", number(all.design->voxels));
    members.emplace_back("voxels_rounded", number(all.design->rounded));
    members.emplace_back("voxels_diffused", number(all.design->diffused));
    members.emplace_back("windows", number(all.design->windows));
  }
  const std::vector<std::string> wrong = shortened(all.findings());
  if (events.wants_data()) {
    for (const std::string& line : wrong) events.warn(line, Code::file_content);
    return events.event("verified", std::move(members));
  }
  std::string text;
  for (const std::string& line : summary(all)) text += line + "\n";
  for (const std::string& line : not_checked) text += "not checked: " + line + "\n";
  for (const std::string& line : wrong) text += line + "\n";
  events.print(text + verdict(all) + "\n");
}

std::string verification_page(const std::string& stack, const Verification& all) {
  ReportPage page(stack + ": " + verdict(all));
  page.add_list("Looked at", summary(all));
  page.add_list("Does not hold", shortened(all.findings()));
  page.add_list("Not checked", all.unchecked());
  if (!all.design || all.design->pictures.empty()) return page.html();
  page.add_heading("Voxels that the design does not give, in red");
  for (const FindingPicture& picture : all.design->pictures) page.add_picture(picture.title, picture.png);
  return page.html();
}

}  // namespace ombre::jobs
