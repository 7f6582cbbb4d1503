// A search as a job whose pieces are stored.
#include "jobs/optimise/stored_search.h"

#include <filesystem>

#include "base/system/named_files.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "jobs/common/study_source.h"
#include "jobs/optimise/search_history.h"
#include "load/files_read.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

// Adds the files that the first design reads.
void add_files(const OptimiseChoices& choices, const OptimiseStudy& study, stores::JobKey& key) {
  std::vector<double> start;
  for (const DesignVariable& variable : study.variables) start.push_back(variable.start);
  LoadOptions options = choices.design.load();
  for (std::string& definition : definitions_of(study, start)) options.definitions.push_back(std::move(definition));
  Diagnostics ignored;  // measuring the first design reports them
  const std::string& design = choices.design.design;
  const auto files = files_read(design, options, ignored);
  if (!files) return key.add(design, formats::read_file(design));
  const fs::path folder = whole_path(design).parent_path();
  for (const fs::path& file : *files)
    key.add(fs::proximate(file, folder).generic_string(), formats::read_file(file.string()));
}

}  // namespace

stores::JobKey search_key(const OptimiseChoices& choices, const Data& data, const OptimiseStudy& study,
                          const std::string& program) {
  stores::JobKey key;
  DataMembers members;
  for (const auto& [name, value] : *data.members())
    if (name != "evaluations") members.emplace_back(name, value);
  key.add("the study", print_json_line(Data(members)));
  if (const Data* fea = data.find("fea"); fea && fea->string())
    key.add(*fea->string(),
            formats::read_file((fs::path(jobs::study_folder(choices.study)) / *fea->string()).string()));
  std::string definitions;
  for (const std::string& definition : choices.design.definitions) definitions += definition + "\n";
  key.add(spelled::option("-D").text(), definitions);
  const Vec3 turn = choices.design.rotate.value_or(Vec3{});
  key.add(spelled::option("--rotate").text(),
          format_number(turn.x) + "," + format_number(turn.y) + "," + format_number(turn.z));
  add_files(choices, study, key);
  key.add("the version of Ombre", program);
  return key;
}

const stores::JobWords& StoredSearch::words() const {
  static const stores::JobWords words{"search", "ombre search", "designs", search_file, "design", ""};
  return words;
}

std::string StoredSearch::description(const stores::Entries&) const {
  DataList variables, measures;
  for (const DesignVariable& variable : study_.variables) variables.emplace_back(variable.name);
  for (const Measure& measure : study_.measures()) measures.emplace_back(measure.label());
  return described({{"variables", variables}, {"measures", measures}});
}

void StoredSearch::check_same(const std::string& folder, const DataMembers& there) const {
  const std::string differing = difference(there);
  if (differing.empty()) return;
  throw options::WrongValue("the history in " + folder + " is of another study or design, since " + differing +
                            "; choose another " + spelled::option("-o") + ", or " + spelled::option("--force") +
                            " to begin again");
}

bool StoredSearch::accepts(const stores::Entry& entry) const { return measured_design(entry, study_).has_value(); }

std::optional<stores::NameTest> StoredSearch::files_of(const Data&) const {
  return [](std::string_view) { return false; };
}

}  // namespace ombre::compile
