#include "studio/python_design.h"

#include <utility>

#include "base/text/text.h"
#include "load/load.h"
#include "studio/workspace/child_process.h"

namespace ombre::studio {
namespace {

constexpr size_t most_bytes = size_t{256} << 20;

// Passes on whole lines as they come in. A line that never ends is passed on in pieces.
class Lines {
 public:
  explicit Lines(const std::function<void(const std::string&)>& take) : take_(take) {}

  void add(std::string_view piece) {
    constexpr size_t longest = 64 << 10;
    rest_ += piece;
    for (size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
      pass(rest_.substr(0, end));
      rest_.erase(0, end + 1);
    }
    if (rest_.size() > longest) finish();
  }
  void finish() { pass(std::exchange(rest_, "")); }

 private:
  void pass(const std::string& line) const {
    if (take_ && !line.empty()) take_(line);
  }

  const std::function<void(const std::string&)>& take_;
  std::string rest_;
};

}  // namespace

compile::LoadedPtr load_python(const std::string& path, const std::vector<std::string>& program,
                               const compile::LoadOptions& options, Diagnostics& diagnostics) {
  std::vector<std::string> command = program;
  command.insert(command.end(), {"slice", path, "--emit", "json"});
  for (const std::string& definition : options.definitions) command.insert(command.end(), {"-D", definition});
  Lines lines(options.echo);
  const ProgramOutput output =
      run_program(command, *options.stop, most_bytes, [&](std::string_view piece) { lines.add(piece); });
  lines.finish();
  const std::string said(trim(output.err));
  if (output.status != 0) {
    diagnostics.error(Code::script, {make_source(path, ""), 0, 0},
                      said.empty() ? "the script ended without a design" : said);
    return nullptr;
  }
  compile::LoadOptions plain = options;
  plain.definitions.clear();
  return compile::load_text(output.out, path + ".json", plain, diagnostics);
}

}  // namespace ombre::studio
