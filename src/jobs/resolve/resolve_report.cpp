#include "jobs/resolve/resolve_report.h"

#include <algorithm>
#include <cmath>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "jobs/resolve/colour_report.h"
#include "jobs/stacks/marked_layer.h"
#include "jobs/stacks/report_page.h"

namespace ombre::jobs {
namespace {

using compile::ColourIntent;
using compile::Intent;
using compile::ResolvedStep;

using Row = std::vector<std::string>;

std::string with_unit(double value, const std::string& unit) {
  return format_rounded(value) + (unit.empty() || unit == "1" ? "" : ' ' + unit);
}

std::string materials_text(const ResolvedStep& step) {
  std::vector<std::string> names = step.materials;
  std::erase(names, "");
  return names.empty() ? "" : " of " + join(names, names.size() > 2 ? ", " : " and ");
}

// Returns how the profile of a step is used, and how exactly.
std::string inks_text(const ResolvedStep& step) {
  const calibration::InkUse& inks = *step.step.calibration->inks;
  return "profile " + inks.profile + ", intent " + ink::intent_names()[static_cast<size_t>(inks.intent)] +
         (inks.black_point ? " with black point compensation" : "") + ", up to " +
         format_rounded(100 * step.inks->most_ink, 3) +
         " % of ink (more than 100 % is divided by the sum); the table between colours differs by " +
         format_rounded(step.inks->mean_error, 2) + " on the average, " + format_rounded(step.inks->worst_error, 2) +
         " at most (CIEDE2000)";
}

std::string reach_text(const compile::ReadAttribute& read) {
  return "reaches " + read.attribute + ' ' + format_rounded(read.reach.lo, 6) + " to " +
         format_rounded(read.reach.hi, 6) + (read.unit.empty() || read.unit == "1" ? "" : ' ' + read.unit);
}

std::string rounding_text(const std::string& what, double step) {
  return "the machine takes multiples of " + format_rounded(step) + ", to which " + what +
         (what == calibration::fractions ? " are" : " is") + " rounded";
}

// Returns what a step does and where its numbers come from, a line each.
std::vector<std::string> lines_of(const ResolvedStep& step) {
  std::vector<std::string> lines{join(step.step.from(), " and ") + " to " + step.step.to() + materials_text(step) +
                                 " by " + step.step.names()};
  for (const calibration::CalibrationPtr& used : step.step.calibrations())
    lines.push_back(used->title + (used->is_illustrative ? " (illustrative)" : ""));
  lines.push_back(step.inks ? inks_text(step) : reach_text({step.attribute, step.unit, step.reach}));
  for (const compile::ReadAttribute& other : step.others) lines.push_back(reach_text(other));
  if (!step.place_in_reach.empty()) lines.push_back("at each place less is reached, as the other attributes allow");
  if (step.rounds_to) lines.push_back(rounding_text(step.step.to(), *step.rounds_to));
  for (const calibration::CalibrationPtr& used : step.step.calibrations()) {
    if (!used->method.empty()) lines.push_back("method: " + used->method);
    lines.push_back("source: " + used->citation);
  }
  return lines;
}

std::string heading(const ResolvedPart& part) {
  if (part.resolution.steps.empty()) return part.title + ": the design gives all that it needs";
  std::vector<std::string> texts;
  for (const ResolvedStep& step : part.resolution.steps) texts.push_back(step.step.text());
  return part.title + ": " + join(texts, ", then ");
}

Row table_head() {
  return {"printer",    "attribute", "requested",    "given",       "mean miss",
          "worst miss", "at, mm",    "out of reach", "expected sd", "by"};
}

Row row_of(const ResolvedPart& part, const Intent& intent) {
  const std::string reach = intent.share_out_of_reach ? percent(*intent.share_out_of_reach) : "";
  if (intent.by.empty() && !intent.is_setting)
    return {part.printer,
            intent.attribute,
            with_unit(intent.mean_wanted, intent.unit),
            "unknown",
            "",
            "",
            "",
            reach,
            "",
            ""};
  // Rounding is no miss.
  const auto shown = [&](double miss) { return std::abs(miss) < 1e-9 * std::abs(intent.mean_wanted) ? 0 : miss; };
  const double worst = shown(intent.worst_given - intent.worst_wanted);
  return {part.printer,
          intent.attribute,
          with_unit(intent.mean_wanted, intent.unit),
          with_unit(intent.mean_given, intent.unit),
          with_unit(shown(intent.mean_miss), intent.unit),
          with_unit(worst, intent.unit),
          worst == 0 ? "" : format_point(intent.worst_mm),
          reach,
          intent.spread       ? with_unit(*intent.spread, intent.unit)
          : intent.by.empty() ? ""
                              : "unknown",
          !intent.by.empty()     ? intent.by
          : intent.mean_miss > 0 ? "rounded"
                                 : "as it is"};
}

Row row_of(const ResolvedPart& part, const ColourIntent& colour) {
  if (colour.points == 0) return {part.printer, colour.attribute, "", "unknown", "", "", "", "", "", ""};
  const auto difference = [](double value) { return "CIEDE2000 " + format_rounded(value, 3); };
  return {part.printer,
          colour.attribute,
          "",
          "",
          difference(colour.mean),
          difference(colour.worst),
          format_point(colour.worst_mm),
          percent(colour.share_out_of_gamut),
          "",
          colour.by};
}

std::vector<Row> table_of(const std::vector<ResolvedPart>& parts) {
  std::vector<Row> rows{table_head()};
  for (const ResolvedPart& part : parts) {
    if (!part.problem.empty()) rows.push_back({part.printer, part.problem});
    for (const Intent& intent : part.report.intents) rows.push_back(row_of(part, intent));
    for (const ColourIntent& colour : part.report.colours) rows.push_back(row_of(part, colour));
    for (const std::string& colour : part.report.unknown_colours)
      rows.push_back({part.printer, colour, "", "unknown", "", "", "", "", "", ""});
  }
  return rows;
}

std::vector<std::string> cure_lines(const compile::CureReport& cure) {
  std::vector<std::string> lines;
  if (cure.under_mm3 > 0)
    lines.push_back("too little light, by " + cure.by + ": " + format_rounded(cure.under_mm3) + " mm3, " +
                    percent(cure.under_share) + " of the part, stay below the critical dose; at " +
                    format_point(cure.least_mm) + " mm " + format_rounded(cure.least_depth) + " mm of the layer of " +
                    format_rounded(cure.layer_mm) + " mm are cured");
  else
    lines.push_back("all of the part gets the critical dose, by " + cure.by);
  if (cure.over_mm3 > 0)
    lines.push_back("too much light: " + format_rounded(cure.over_mm3) +
                    " mm3 below overhangs are cured, too, down to " + format_rounded(cure.deepest) +
                    " mm below the part at " + format_point(cure.deepest_mm) + " mm");
  return lines;
}

Data cure_data(const compile::CureReport& cure) {
  const auto point = [](const Vec3& v) { return Data(DataList{v.x, v.y, v.z}); };
  DataMembers members{{"by", Data(cure.by)},
                      {"layer_mm", Data(cure.layer_mm)},
                      {"under_mm3", Data(cure.under_mm3)},
                      {"under_share", Data(cure.under_share)},
                      {"over_mm3", Data(cure.over_mm3)},
                      {"deepest_mm", Data(cure.deepest)}};
  if (cure.under_mm3 > 0) {
    members.emplace_back("least_depth_mm", Data(cure.least_depth));
    members.emplace_back("least_at_mm", point(cure.least_mm));
  }
  if (cure.over_mm3 > 0) members.emplace_back("deepest_at_mm", point(cure.deepest_mm));
  return Data(std::move(members));
}

// Returns what happens to a part beside its steps, a line each.
std::vector<std::string> further_lines(const ResolvedPart& part) {
  std::vector<std::string> lines;
  for (const voxel::ValueStep& step : part.resolution.rounded) lines.push_back(rounding_text(step.of, step.size));
  for (const ResolvedStep& step : part.resolution.agreeing)
    lines.push_back(step.step.text() + " gives the same, within " + percent(compile::agreement_tolerance) +
                    " of the whole");
  if (part.cure) std::ranges::move(cure_lines(*part.cure), std::back_inserter(lines));
  return lines;
}

// Returns the number of letters, which take several bytes each in UTF-8 if they are not ASCII.
size_t letters(const std::string& text) {
  return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string table_text(const std::vector<Row>& rows) {
  std::vector<size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (size_t n = 0; n < row.size() && row.size() == widths.size(); ++n)
      widths[n] = std::max(widths[n], letters(row[n]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (size_t n = 0; n < row.size(); ++n)
      line += row[n] + std::string(std::max(widths[n], letters(row[n])) + 2 - letters(row[n]), ' ');
    text += std::string(line.substr(0, line.find_last_not_of(' ') + 1)) + '\n';
  }
  return text;
}

std::string points_text(const ResolvedPart& part) {
  const Vec3 voxel = part.report.lattice.voxel_mm();
  return format_count(part.report.points) + " points, " + format_rounded(voxel.x) + " x " + format_rounded(voxel.y) +
         " x " + format_rounded(voxel.z) + " mm apart";
}

Data intent_data(const Intent& intent) {
  DataMembers members{
      {"attribute", Data(intent.attribute)}, {"unit", Data(intent.unit)}, {"requested", Data(intent.mean_wanted)}};
  if (!intent.by.empty() || intent.is_setting) {
    members.emplace_back("by", intent.by.empty() ? Data() : Data(intent.by));
    members.emplace_back("given", Data(intent.mean_given));
    members.emplace_back("mean_miss", Data(intent.mean_miss));
    members.emplace_back("worst_miss", Data(intent.worst_given - intent.worst_wanted));
    members.emplace_back("worst_requested", Data(intent.worst_wanted));
    members.emplace_back("worst_at_mm", DataList{intent.worst_mm.x, intent.worst_mm.y, intent.worst_mm.z});
  }
  if (intent.share_out_of_reach) members.emplace_back("share_out_of_reach", Data(*intent.share_out_of_reach));
  if (intent.spread) members.emplace_back("expected_sd", Data(*intent.spread));
  return Data(std::move(members));
}

Data part_data(const ResolvedPart& part) {
  DataMembers members{{"printer", Data(part.printer)}};
  if (!part.problem.empty()) {
    members.emplace_back("problem", Data(part.problem));
    return Data(std::move(members));
  }
  DataList steps, intents;
  for (const ResolvedStep& step : part.resolution.steps) steps.push_back(compile::describe(step));
  for (const Intent& intent : part.report.intents) intents.push_back(intent_data(intent));
  for (const voxel::ValueStep& step : part.resolution.rounded) steps.push_back(compile::describe(step));
  for (const std::string& colour : part.report.unknown_colours)
    intents.push_back(DataMembers{{"attribute", Data(colour)}});
  members.emplace_back("steps", Data(std::move(steps)));
  members.emplace_back("intent", Data(std::move(intents)));
  DataList colours;
  for (const ColourIntent& colour : part.report.colours) colours.push_back(colour_data(colour));
  if (!colours.empty()) members.emplace_back("colours", Data(std::move(colours)));
  if (part.cure) members.emplace_back("cure", cure_data(*part.cure));
  members.emplace_back("points", number(part.report.points));
  members.emplace_back("is_within_reach", Data(is_reached(part)));
  return Data(std::move(members));
}

// Returns the layer of the report's lattice with the most flags of 2.
int64_t worst_layer(const compile::IntentReport& report, const std::vector<uint8_t>& all) {
  const auto in_layer = static_cast<ptrdiff_t>(report.lattice.count[0] * report.lattice.count[1]);
  int64_t worst = 0;
  ptrdiff_t most = 0;
  for (int64_t k = 0; k < report.lattice.count[2]; ++k) {
    const auto begin = all.begin() + k * in_layer;
    const ptrdiff_t flagged = std::count(begin, begin + in_layer, uint8_t{2});
    if (flagged > most) worst = k;
    most = std::max(most, flagged);
  }
  return worst;
}

std::string picture(const compile::IntentReport& report, const std::vector<uint8_t>& all, int64_t layer) {
  const auto in_layer = static_cast<size_t>(report.lattice.count[0] * report.lattice.count[1]);
  const uint8_t* const points = all.data() + static_cast<size_t>(layer) * in_layer;
  std::vector<uint8_t> flags(in_layer);
  std::transform(points, points + in_layer, flags.begin(), [](uint8_t flag) { return flag == 2 ? 1 : 0; });
  const auto colour = [points](size_t n) {
    return points[n] == 0 ? formats::Rgba{0, 0, 0, 0} : formats::Rgba{120, 140, 160, 255};
  };
  return compile::marked_layer(report.lattice, colour, flags);
}

void add_picture(ReportPage& page, const compile::IntentReport& report, const std::vector<uint8_t>& flags,
                 const std::string& what) {
  const int64_t layer = worst_layer(report, flags);
  page.add_picture(what + " at z = " + format_rounded(report.lattice.center(2, layer)) + " mm (red)",
                   picture(report, flags, layer));
}

}  // namespace

bool is_reached(const ResolvedPart& part) {
  return std::ranges::find(part.report.flags, uint8_t{2}) == part.report.flags.end();
}

void tell_resolved(const Events& events, const std::vector<ResolvedPart>& parts) {
  if (events.wants_data()) {
    DataList printers;
    for (const ResolvedPart& part : parts) printers.push_back(part_data(part));
    return events.event("resolved", {{"printers", Data(std::move(printers))}});
  }
  std::string text;
  for (const ResolvedPart& part : parts) {
    if (!part.problem.empty()) continue;
    text += heading(part) + '\n';
    for (const ResolvedStep& step : part.resolution.steps)
      for (const std::string& line : lines_of(step)) text += "  " + line + '\n';
    for (const std::string& line : further_lines(part)) text += "  " + line + '\n';
    for (const std::string& sentence : part.resolution.unusable) text += "  not used: " + sentence + '\n';
    text += "  looked at " + points_text(part) + '\n';
    for (const ColourIntent& colour : part.report.colours) {
      text += "  " + colour_heading(colour) + '\n';
      for (const std::string& line : colour_lines(colour)) text += "    " + line + '\n';
    }
  }
  const std::vector<Row> rows = table_of(parts);
  events.print(rows.size() > 1 ? text + '\n' + table_text(rows) : text);
}

std::string resolved_page(const std::string& design, const std::vector<ResolvedPart>& parts) {
  ReportPage page(design + ": what it asks for, and what printers give");
  if (const std::vector<Row> rows = table_of(parts); rows.size() > 1) page.add_table(rows);
  for (const ResolvedPart& part : parts) {
    if (!part.problem.empty()) continue;
    page.add_heading(heading(part));
    for (const ResolvedStep& step : part.resolution.steps) page.add_list(step.step.text(), lines_of(step));
    page.add_list("Further", further_lines(part));
    page.add_list("Not used", part.resolution.unusable);
    for (const ColourIntent& colour : part.report.colours) page.add_list(colour_heading(colour), colour_lines(colour));
    if (!is_reached(part)) add_picture(page, part.report, part.report.flags, "out of reach");
    if (std::ranges::find(part.report.colour_flags, uint8_t{2}) != part.report.colour_flags.end())
      add_picture(page, part.report, part.report.colour_flags, "out of gamut");
  }
  return page.html();
}

}  // namespace ombre::jobs
