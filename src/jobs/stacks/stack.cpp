#include "jobs/stacks/stack.h"

#include <algorithm>
#include <filesystem>

#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/slice/stored_slices.h"
#include "stores/journal_folder.h"
#include "stores/shard.h"

namespace ombre::compile {
namespace {

DescribedJob read_description(const std::string& path, std::string text) {
  Diagnostics problems;
  auto job = read_job(make_source(path, std::move(text)), problems);
  if (!job) throw Error(Code::file_content, std::string(trim(to_text(problems))), {{"file", path}});
  return std::move(*job);
}

// Adds the lines of a journal to the stack, and what is wrong with them.
void add_journal(const std::string& name, Stack& stack, Findings& findings) {
  const std::string text = stack.read(name);
  const StoredSlices slices(stack.request());
  const auto all = [](const stores::Entry&) { return true; };
  size_t number = 0;
  for (size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    const size_t newline = text.find('\n', begin);
    end = newline == std::string::npos ? text.size() : newline + 1;
    const std::string place = name + ":" + std::to_string(++number) + ": ";
    const auto line = std::string_view(text).substr(begin, end - begin);
    const stores::Entries read = stores::parse_journal(layer_member, line, all);
    if (read.empty()) {
      findings.push_back({"journal", place + "this line cannot be read"});
      continue;
    }
    const auto& [layer, entry] = *read.begin();
    if (!slices.accepts(entry))
      findings.push_back({"journal", place + "the line is of no layer of this job", layer});
    else if (const auto [there, is_new] = stack.entries.emplace(layer, entry); !is_new && there->second != entry)
      findings.push_back({"journal", place + "an earlier line says something else of the layer", layer});
  }
}

}  // namespace

Stack open_stack(const std::string& folder, Findings& findings) {
  auto stored = stores::open_files(folder);
  const std::vector<std::string>& names = stored->names();
  if (std::ranges::find(names, job_file) == names.end())
    throw Error(Code::file_kind, folder + " holds no slice job: there is no " + job_file + " in it",
                {{"file", folder}});
  DescribedJob job = read_description((std::filesystem::path(folder) / job_file).string(), stored->read(job_file));
  LayerFiles files(job.request);
  Stack stack{folder, std::move(stored), std::move(job), std::move(files), {names.begin(), names.end()}, false, {}};
  for (const std::string& name : names) {
    if (name != stores::journal_file && !stores::is_journal_of_shard(name)) continue;
    stack.has_journal = true;
    add_journal(name, stack, findings);
  }
  return stack;
}

}  // namespace ombre::compile
