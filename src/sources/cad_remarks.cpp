// Remarks on CAD parts that are added when they are made.
#include "sources/cad_remarks.h"

#include <cmath>

#include "base/math/point_text.h"
#include "base/text/text.h"

namespace ombre::sources {
namespace {

std::string time_text(double seconds) {
  const double minutes = seconds / 60, hours = minutes / 60;
  if (minutes < 2) return format_rounded(seconds, 2) + " s";
  return hours < 2 ? format_rounded(minutes, 2) + " min" : format_rounded(hours, 2) + " h";
}

}  // namespace

design::Remark remark_on_gaps(const std::string& path, const std::vector<importing::OpenSolid>& open, double tolerance,
                              bool is_exact) {
  const auto& [name, edges] = open.front();
  std::string message = "the triangles of the CAD file \"" + path + "\"";
  if (!name.empty()) message += ", of its solid \"" + name + "\",";
  message += " are open along " + format_count(edges.count) + (edges.count == 1 ? " edge" : " edges") +
             ", for example from " + format_point(edges.example[0]) + " to " + format_point(edges.example[1]);
  if (std::isfinite(edges.gap_mm)) message += ", by up to about " + format_rounded(edges.gap_mm, 2) + " mm";
  if (open.size() > 1)
    message += ", and so are those of " + format_count(open.size() - 1) + (open.size() == 2 ? " other" : " others");
  message += "; what is inside near the gaps is a guess, by winding number";
  if (is_exact) return {Severity::warning, message, "repair the file where it was drawn"};
  return {Severity::warning, message,
          "repair the file where it was drawn, or write a tolerance below " + format_rounded(tolerance, 2) + ", or " +
              spelled::parameter("mode", "\"exact\"")};
}

design::Remark remark_on_time(const std::string& path, double voxels, double seconds, double tolerance) {
  return {Severity::note,
          "mode=\"exact\" of the CAD file \"" + path + "\" will take about " + time_text(seconds) +
              " on all cores, longer where distances are needed: its surfaces are evaluated at " +
              format_count(static_cast<unsigned long long>(voxels)) + " voxels",
          "where triangles will do, write " + spelled::parameter("mode", "\"fast\"") + " with " +
              spelled::parameter("tolerance", format_rounded(tolerance, 2))};
}

}  // namespace ombre::sources
