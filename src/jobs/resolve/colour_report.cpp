#include "jobs/resolve/colour_report.h"

#include "base/math/point_text.h"
#include "base/text/text.h"

namespace ombre::jobs {

using compile::ColourIntent;

namespace {

std::string lab_text(const ink::Lab& lab) {
  return '(' + format_rounded(lab.x, 3) + ", " + format_rounded(lab.y, 3) + ", " + format_rounded(lab.z, 3) + ')';
}

Data vector_data(const Vec3& v) { return DataList{v.x, v.y, v.z}; }

}  // namespace

std::string percent(double share) { return format_rounded(100 * share, 3) + " %"; }

std::vector<std::string> colour_lines(const ColourIntent& colour) {
  if (colour.points == 0) return {"no point of the part has a mixture of these inks alone"};
  std::vector<std::string> lines{
      "CIEDE2000 from what is asked for: mean " + format_rounded(colour.mean, 3) + ", 95 % below " +
          format_rounded(colour.most_of_95_percent, 3) + ", worst " + format_rounded(colour.worst, 3) + " at " +
          format_point(colour.worst_mm) + " mm, where L*a*b* " + lab_text(colour.worst_wanted) + " becomes " +
          lab_text(colour.worst_given),
      percent(colour.share_out_of_gamut) + " of the volume is out of gamut, by more than " +
          format_rounded(compile::gamut_tolerance) + "; the intent " + colour.intent + " replaces its colours"};
  if (colour.share_divided > 0)
    lines.push_back("in " + percent(colour.share_divided) +
                    " of the volume the profile asks for more than 100 % of ink, which is divided by the sum");
  if (!colour.knows_materials) lines.push_back("parts with other materials are left out");
  return lines;
}

std::string colour_heading(const ColourIntent& colour) { return colour.attribute + " by " + colour.by; }

Data colour_data(const ColourIntent& colour) {
  return DataMembers{{"attribute", Data(colour.attribute)},
                     {"by", Data(colour.by)},
                     {"intent", Data(colour.intent)},
                     {"points", number(colour.points)},
                     {"mean_difference", Data(colour.mean)},
                     {"difference_of_95_percent", Data(colour.most_of_95_percent)},
                     {"worst_difference", Data(colour.worst)},
                     {"worst_at_mm", vector_data(colour.worst_mm)},
                     {"worst_srgb", vector_data(colour.worst_srgb)},
                     {"worst_lab", vector_data(colour.worst_wanted)},
                     {"worst_lab_given", vector_data(colour.worst_given)},
                     {"share_out_of_gamut", Data(colour.share_out_of_gamut)},
                     {"share_divided", Data(colour.share_divided)}};
}

}  // namespace ombre::jobs
