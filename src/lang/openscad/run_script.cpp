#include "lang/openscad/run_script.h"

#include <pthread.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "base/system/environment.h"
#include "base/text/error.h"
#include "lang/openscad/overwritten.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"
#include "lang/syntax/lexer.h"

namespace ombre::lang::openscad {
namespace {

namespace fs = std::filesystem;

constexpr size_t stack_bytes = 512u << 20;  // reserved address space; pages are allocated as the evaluation gets deeper

// Runs `work` on a thread with a deep stack, and rethrows its exceptions.
template <class Work>
void with_deep_stack(const Work& work) {
  struct Task {
    const Work& work;
    std::exception_ptr failure;
  } task{work, nullptr};
  const auto body = [](void* data) -> void* {
    auto& running = *static_cast<Task*>(data);
    try {
      running.work();
    } catch (...) {
      running.failure = std::current_exception();
    }
    return nullptr;
  };
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack_bytes);
  pthread_t thread;
  const int status = pthread_create(&thread, &attributes, body, &task);
  pthread_attr_destroy(&attributes);
  if (status != 0) throw Error("no thread could be started for a script");
  pthread_join(thread, nullptr);
  if (task.failure) std::rethrow_exception(task.failure);
}

// Appends the definitions of the command line to the script, so that they are its last assignments.
SourcePtr with_definitions(const SourcePtr& source, const std::vector<std::string>& definitions) {
  if (definitions.empty()) return source;
  std::string text(source->text());
  for (const std::string& definition : definitions) text += '\n' + definition + ';';
  return make_source(source->name(), std::move(text));
}

// Returns what OpenSCAD calls unterminated, or an empty text for other mistakes.
std::string unterminated(const Diagnostic& diagnostic) {
  if (diagnostic.message.starts_with("the string is not closed")) return "string";
  if (diagnostic.message.starts_with("the comment is not closed")) return "comment";
  if (!diagnostic.message.starts_with("the path is not closed")) return "";
  const std::string_view before = diagnostic.where.source->text().substr(0, diagnostic.where.begin);
  return trim(before).ends_with("use") ? "use statement" : "include statement";
}

// Returns the line that OpenSCAD reports for a syntax error: that of the token at which it was found. A missing token
// is reported at the next one. OpenSCAD appends a line and an empty line to a script; unclosed constructs are reported
// on the last one.
int line_of(const Diagnostic& diagnostic) {
  const SourceRange& where = diagnostic.where;
  const std::string_view text = where.source->text();
  const int last = static_cast<int>(std::ranges::count(text, '\n')) + 3;
  const std::string what = unterminated(diagnostic);
  if (what == "string" || what == "comment") return last;
  if (!what.empty()) return where.source->place(where.begin).line;
  Diagnostics ignored;
  Lexer lexer(where.source, where.begin, Dialect::openscad, ignored);
  const Token token = lexer.next();
  if (token.kind == TokenKind::end) return diagnostic.message.starts_with("expected \"}\"") ? last : last - 1;
  return where.source->place(token.begin).line;
}

void report_syntax(const Diagnostics& found, const std::string& main, Messages& messages) {
  for (const Diagnostic& diagnostic : found.list()) {
    if (diagnostic.severity == Severity::error) continue;
    messages.add({Message::Kind::warning, diagnostic.message, "", 0});
  }
  if (!found.has_errors()) return;
  for (const Diagnostic& diagnostic : found.list()) {
    if (diagnostic.severity != Severity::error) continue;
    messages.details.add(diagnostic);
    if (!diagnostic.where.source || messages.error_count() > 0) continue;
    const std::string file = shown_path(diagnostic.where.source->name(), "");
    const int line = line_of(diagnostic);
    if (const std::string what = unterminated(diagnostic); !what.empty())
      messages.add({Message::Kind::error, "Parser error: Unterminated " + what, file, line, Code::syntax});
    messages.add({Message::Kind::error, "Parser error: syntax error", file, line, Code::syntax});
  }
  messages.add({Message::Kind::note, "Can't parse file '" + main + "'!\n", "", 0});
}

lang::Options engine_options(const Options& options) {
  lang::Options result;
  result.limits = options.limits;
  result.stop = options.stop;
  result.read_file = options.read_file;
  result.dialect = Dialect::openscad;
  result.libraries = options.libraries;
  return result;
}

// Returns the parsed script, or nothing if its text is wrong.
std::optional<Program> load_script(const SourcePtr& source, const Options& options, const lang::Options& engine,
                                   Messages& messages) {
  Diagnostics found;
  Program program = load(with_definitions(source, options.definitions), engine, found);
  for (const Message& message : overwritten(program, static_cast<uint32_t>(source->text().size())))
    messages.add(message);
  report_syntax(found, source->name(), messages);
  if (found.has_errors()) return std::nullopt;
  return program;
}

void add_imports(const solids::Tree& tree, std::vector<std::string>& files) {
  if (const auto* file = std::get_if<solids::Import>(&tree.operation)) files.push_back(file->path);
  if (const auto* file = std::get_if<solids::Surface>(&tree.operation)) files.push_back(file->path);
  for (const solids::TreePtr& child : tree.children) add_imports(*child, files);
}

}  // namespace

Limits Options::openscad_limits() {
  Limits limits;
  limits.depth = 50'000;
  limits.list_depth = 2'000;
  return limits;
}

Outcome run_with_files(const SourcePtr& source, const Options& options, Messages& messages) {
  Outcome outcome;
  with_deep_stack([&] {
    const lang::Options engine = engine_options(options);
    const auto program = load_script(source, options, engine, messages);
    if (!program) return;
    Evaluator evaluator(*program, options, messages);
    outcome.tree = evaluator.run();
    if (outcome.tree) evaluator.check_view();
    for (const ast::File& file : program->files) outcome.files.push_back((*file.source)->name());
    outcome.files.insert(outcome.files.end(), evaluator.read_files().begin(), evaluator.read_files().end());
    if (outcome.tree) add_imports(*outcome.tree, outcome.files);
  });
  return outcome;
}

solids::TreePtr run(const SourcePtr& source, const Options& options, Messages& messages) {
  return run_with_files(source, options, messages).tree;
}

bool uses_words(const SourcePtr& source, const Options& options) {
  Diagnostics ignored;
  const Program program = load(source, engine_options(options), ignored);
  return std::ranges::any_of(program.units, &Unit::has_words);
}

std::optional<std::string> syntax_tree(const SourcePtr& source, const Options& options, Messages& messages) {
  const lang::Options engine = engine_options(options);
  const auto program = load_script(source, options, engine, messages);
  if (!program) return std::nullopt;
  return scope_text(program->units.front().plan);
}

std::vector<std::string> library_folders() {
  std::vector<std::string> folders;
  for (const std::string& folder : split(environment("OPENSCADPATH"), ':'))
    if (!folder.empty()) folders.push_back(folder);
  if (const std::string home = environment("HOME"); !home.empty())
    folders.push_back((fs::path(home) / ".local/share/OpenSCAD/libraries").generic_string());
  folders.emplace_back("/usr/share/openscad/libraries");
  return folders;
}

}  // namespace ombre::lang::openscad
