#include "studio/python_design.h"

#include "base/text/text.h"
#include "load/load.h"
#include "studio/workspace/child_process.h"

namespace ombre::studio {
namespace {

constexpr size_t most_bytes = size_t{256} << 20;

}  // namespace

compile::LoadedPtr load_python(const std::string& path, const std::vector<std::string>& program,
                               const compile::LoadOptions& options, Diagnostics& diagnostics) {
  std::vector<std::string> command = program;
  command.insert(command.end(), {"slice", path, "--emit", "json"});
  for (const std::string& definition : options.definitions) command.insert(command.end(), {"-D", definition});
  const ProgramOutput output = run_program(command, *options.stop, most_bytes);
  const std::string said(trim(output.err));
  if (output.status != 0) {
    diagnostics.error(Code::script, {make_source(path, ""), 0, 0},
                      said.empty() ? "the script ended without a design" : said);
    return nullptr;
  }
  if (options.echo && !said.empty())
    for (const std::string& line : split(said, '\n')) options.echo(line);
  compile::LoadOptions plain = options;
  plain.definitions.clear();
  return compile::load_text(output.out, path + ".json", plain, diagnostics);
}

}  // namespace ombre::studio
