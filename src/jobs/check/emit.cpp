#include "jobs/check/emit.h"

#include <algorithm>

#include "base/math/point_text.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/check/pass_list.h"
#include "lang/syntax/ast_print.h"
#include "lang/syntax/parser.h"
#include "program/passes/passes.h"
#include "program/program_text.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

std::string box_text(const Box& box) { return format_point(box.lo, 6) + " to " + format_point(box.hi, 6) + " mm"; }

std::string stats(const design::Design& design) {
  size_t nodes = 0;
  for ([[maybe_unused]] const design::Node* node : topological(design.roots())) ++nodes;
  const Built built = build_program(design);
  Diagnostics ignored;
  const auto flat = build_flat_program(design, ignored);
  const auto box = design_box(design, ignored);
  std::string text = "hash          " + design::hash(design).hex() + "\n";
  text += "parts         " + std::to_string(design.parts.size()) + "\n";
  text += "nodes         " + format_count(nodes) + "\n";
  text += "bounds        " + (box ? box_text(*box) : "none") + "\n";
  text += "materials     " + std::to_string(built.materials.materials.size()) + "\n";
  text += "operations    " + format_count(built.materials.program.code.size()) + ", " +
          (flat ? format_count(flat->materials.program.code.size()) : "too many") + " with bodies written out\n";
  return text;
}

// Returns a line for each pass: its name, the number of operations that it left, its time, and a description.
std::string pass_table(const design::Design& design) {
  std::string text;
  const auto column = [](std::string word, size_t width) {
    word.resize(std::max(width, word.size() + 1), ' ');
    return word;
  };
  for (const PassResult& pass : slicing_passes(design))
    text += column(pass.name, 22) + column(format_count(pass.program.code.size()) + " operations", 24) +
            column(format_rounded(1000 * pass.seconds, 3) + " ms", 12) + pass.sentence + "\n";
  return text;
}

std::string program_after(const design::Design& design, std::string_view name) {
  for (const PassResult& pass : slicing_passes(design))
    if (pass.name == name) return program::to_text(pass.program);
  return "";
}

constexpr std::string_view after = "program=after-";

}  // namespace

const std::vector<std::string>& emit_forms() {
  static const std::vector<std::string> forms = [] {
    std::vector<std::string> all{"ast", "tree", "program", "stats", "json", "passes"};
    for (const std::string& name : slicing_pass_names()) all.push_back(std::string(after) + name);
    return all;
  }();
  return forms;
}

std::string emit(const Loaded& loaded, const std::string& form) {
  if (form == "tree") return design::to_tree(loaded.design);
  if (form == "json") return print_json(design::to_data(loaded.design));
  if (form == "program") return program::to_text(build_program(loaded.design).materials.program);
  if (form == "passes") return pass_table(loaded.design);
  if (form.starts_with(after)) return program_after(loaded.design, std::string_view(form).substr(after.size()));
  if (form == "stats") return stats(loaded.design);
  if (loaded.path.ends_with(".json")) return std::string(loaded.source->text());
  Diagnostics ignored;  // the design was read already, so its diagnostics are known
  return lang::print(lang::parse(loaded.source, ignored));
}

}  // namespace ombre::compile
