// `ombre calibrations` lists the calibrations, or shows one.
#include <algorithm>

#include "base/text/text.h"
#include "calibration/piecewise.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/reference/measured_inks.h"
#include "load/find_calibration.h"
#include "load/ink_step.h"

namespace ombre::jobs {
namespace {

using calibration::Calibration;

struct CalibrationsChoices {
  std::string calibration;
  std::string measured = {}, output = {};
  bool force = false;

  static const options::Spec<CalibrationsChoices>& options() {
    using namespace options;
    static const options::Spec<CalibrationsChoices> spec{
        option("calibration", &CalibrationsChoices::calibration, kind::text,
               "A calibration's name, or the path of a .json file", "NAME"),
        option("--measured", &CalibrationsChoices::measured, kind::file,
               "Make a calibration of inks from measured patches: a .csv file with shares, L, a and b", "FILE")
            .needs("--output"),
        option("-o,--output", &CalibrationsChoices::output, kind::file,
               "Write that calibration, and its ICC profile beside it: a .json file", "FILE")
            .needs("--measured"),
        flag("--force", &CalibrationsChoices::force, "Replace existing files")};
    return spec;
  }
};

std::string labelled(const std::string& label, const std::string& text) {
  constexpr size_t width = 14;
  return text.empty() ? "" : label + std::string(width - label.size(), ' ') + text + '\n';
}

// Returns what a calibration says besides its numbers.
std::string origin_of(const Calibration& calibration) {
  return labelled("method", calibration.method) + labelled("printer", calibration.printer) +
         labelled("lots", join(calibration.lots, ", ")) + labelled("date", calibration.date) +
         labelled("source", calibration.citation) + labelled("licence", calibration.licence);
}

std::string describe_inks(const Calibration& calibration) {
  const calibration::InkUse& inks = *calibration.inks;
  std::string text = calibration.name + ": " + calibration.title + '\n' + labelled("from", "color_rgb, or color_rgba") +
                     labelled("profile", inks.profile);
  for (size_t n = 0; n < calibration.inputs.size(); ++n)
    text += labelled("ink " + inks.channels[n], join(calibration.inputs[n].materials, " or "));
  text += labelled("the rest is", join(calibration.rest, " or ")) + labelled("clear is", join(inks.clear, " or "));
  return text +
         labelled("intent", ink::intent_names()[static_cast<size_t>(inks.intent)] +
                                (inks.black_point ? ", with black point compensation" : "")) +
         origin_of(calibration);
}

std::string describe(const Calibration& calibration) {
  if (calibration.inks) return describe_inks(calibration);
  const std::string unit = calibration.unit == "1" ? "" : ' ' + calibration.unit;
  std::string text = calibration.name + ": " + calibration.title + '\n' +
                     labelled("gives", calibration.property + (unit.empty() ? "" : "," + unit));
  for (size_t n = 0; n < calibration.inputs.size(); ++n) {
    const calibration::Input& input = calibration.inputs[n];
    const Interval reach = calibration.reach(n, calibration.usual());
    text += labelled("from", input.text() + ", " + format_rounded(input.valid->lo, 6) + " to " +
                                 format_rounded(input.valid->hi, 6) + (input.unit.empty() ? "" : ' ' + input.unit));
    text += labelled("reaches", format_rounded(reach.lo, 6) + " to " + format_rounded(reach.hi, 6) + unit);
  }
  if (calibration.has_fractions()) text += labelled("the rest is", calibration.rest.front());
  text +=
      labelled("interpolant",
               calibration::interpolant_names()[static_cast<size_t>(calibration.interpolant)] +
                   (calibration.points.empty() ? "" : ", " + std::to_string(calibration.points.size()) + " points") +
                   (calibration.is_illustrative ? ", illustrative" : ""));
  return text + origin_of(calibration);
}

Data curve_data(const calibration::Piecewise& curve) {
  DataList points;
  for (const auto& [at, value] : curve.points) points.emplace_back(DataList{at, value});
  return DataMembers{{"of_logarithm", curve.of_logarithm}, {"points", Data(std::move(points))}};
}

Data text_data(const std::vector<std::string>& texts) {
  DataList list;
  for (const std::string& text : texts) list.emplace_back(text);
  return Data(std::move(list));
}

DataMembers data_of(const Calibration& calibration) {
  DataMembers members{{"name", calibration.name},
                      {"title", calibration.title},
                      {"property", calibration.property},
                      {"unit", calibration.unit},
                      {"illustrative", calibration.is_illustrative},
                      {"citation", calibration.citation}};
  if (calibration.inks) members.emplace_back("inks", compile::describe(*calibration.inks));
  if (calibration.inks || calibration.inputs.size() > 1) return members;
  // The curves of a single input.
  const calibration::Input& input = calibration.inputs.front();
  const std::vector<double> usual = calibration.usual();
  members.emplace_back("input", input.is_fraction() ? std::string(calibration::fractions) : input.attribute);
  if (input.is_fraction())
    members.emplace_back("materials", DataList{text_data(input.materials), text_data(calibration.rest)});
  members.emplace_back("forward", curve_data(calibration::forward_curve(calibration, 0, usual)));
  if (calibration.is_invertible(0))
    members.emplace_back("inverse", curve_data(calibration::inverse_curve(calibration, 0, usual)));
  return members;
}

void tell(const Calibration& calibration, const std::string& text, const Session& session) {
  if (session.events.wants_data())
    session.events.event("calibration", data_of(calibration));
  else
    session.events.print(text);
}

int show_calibrations(const CalibrationsChoices& a, Session& session) {
  if (!a.measured.empty()) {
    if (!a.calibration.empty())
      throw WrongArgument("a calibration is either shown or made; leave out " + a.calibration);
    if (!a.output.ends_with(".json")) throw WrongArgument("-o writes a calibration; give it a name that ends in .json");
    calibrate_inks(a.measured, a.output, a.force, session);
    return done;
  }
  const std::vector<std::string> names =
      a.calibration.empty() ? compile::calibration_names() : std::vector<std::string>{a.calibration};
  size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());
  for (const std::string& name : names) {
    Diagnostics diagnostics;
    const auto calibration = compile::find_calibration(name, diagnostics);
    session.events.diagnose(diagnostics);
    if (!calibration) return wrong_input;
    tell(*calibration,
         a.calibration.empty() ? name + std::string(width + 2 - name.size(), ' ') + calibration->title + '\n'
                               : describe(*calibration),
         session);
  }
  return done;
}

}  // namespace

JobKind calibrations_kind() {
  return job_kind<CalibrationsChoices>("calibrations", "List the calibrations, show one, or make one of measured inks",
                                       "Examples:\n  ombre calibrations\n  ombre calibrations agilus-vero-modulus\n"
                                       "  ombre calibrations --measured patches.csv -o our-inks.json\n",
                                       show_calibrations);
}

}  // namespace ombre::jobs
