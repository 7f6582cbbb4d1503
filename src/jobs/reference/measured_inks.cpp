#include "jobs/reference/measured_inks.h"

#include <filesystem>

#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "ink/patch_table.h"
#include "jobs/common/overwrite.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;

std::string method_text(const ink::PatchTable& table, const ink::DropletModel& model, const ink::ModelError& error) {
  return std::to_string(table.patches.size()) + " patches; Yule-Nielsen n = " + format_rounded(model.n()) +
         ", what it misses is interpolated; each patch predicted from the others: CIEDE2000 mean " +
         format_rounded(error.mean, 3) + ", 95 % below " + format_rounded(error.most_of_95_percent, 3) + ", worst " +
         format_rounded(error.worst, 3);
}

Data calibration_data(const fs::path& output, const std::string& measured, const ink::PatchTable& table,
                      const std::string& method) {
  DataMembers channels;
  for (size_t n = 0; n + 1 < table.materials.size(); ++n)
    channels.emplace_back(table.materials[n], Data(table.materials[n]));
  std::string name;
  for (const char c : to_lower(output.stem().string()))
    name += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '-';
  const std::string file = fs::path(measured).filename().string();
  return DataMembers{{"name", Data(name)},
                     {"title", Data("Inks measured in " + file)},
                     {"profile", Data(output.stem().string() + ".icc")},
                     {"channels", Data(std::move(channels))},
                     {"rest", Data(table.materials.back())},
                     {"intent", Data("relative")},
                     {"black_point", Data(true)},
                     {"method", Data(method)},
                     {"citation", Data("our measurements in " + file)},
                     {"licence", Data("ours")}};
}

std::string shares_text(const ink::PatchTable& table, size_t patch) {
  std::vector<std::string> texts;
  for (size_t n = 0; n < table.materials.size(); ++n)
    if (const double share = table.patches[patch].shares[n]; share > 0)
      texts.push_back(format_rounded(share, 3) + ' ' + table.materials[n]);
  return join(texts, ", ");
}

}  // namespace

void calibrate_inks(const std::string& measured, const std::string& output, bool force, const Session& session) {
  const fs::path profile = fs::path(output).replace_extension(".icc");
  refuse_to_overwrite(output, force);
  refuse_to_overwrite(profile.string(), force);
  const ink::PatchTable table = ink::read_patches(measured, formats::read_file(measured));
  const ink::DropletModel model(table.patches);
  const ink::ModelError error = model.error();
  const std::string method = method_text(table, model, error);
  exporting::write_file(profile.string(), ink::make_profile(ink::tables_of(
                                              model, "Inks measured in " + fs::path(measured).filename().string())));
  exporting::write_file(output, print_json(calibration_data(output, measured, table, method)));
  if (session.events.wants_data())
    session.events.event("measured", {{"patches", number(table.patches.size())},
                                      {"n", Data(model.n())},
                                      {"mean_error", Data(error.mean)},
                                      {"error_of_95_percent", Data(error.most_of_95_percent)},
                                      {"worst_error", Data(error.worst)}});
  else
    session.events.print(method + (error.worst > 0 ? " at " + shares_text(table, error.worst_patch) : "") + '\n');
  session.events.say("wrote " + output + " and " + profile.string());
}

}  // namespace ombre::jobs
