#include "lang/engine/loader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/system/named_files.h"
#include "base/system/temporary.h"
#include "base/text/text.h"
#include "lang/syntax/parser.h"

namespace ombre::lang {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = 256u << 20;

class Loader {
 public:
  Loader(const Options& options, Diagnostics& diagnostics)
      : limits_(options.limits),
        read_(options.read_file ? options.read_file : read_real_file),
        dialect_(options.dialect),
        libraries_(options.libraries),
        diagnostics_(diagnostics) {}

  Program run(const SourcePtr& source) {
    unit(source);
    return std::move(program_);
  }

 private:
  // A file that was found, and the name by which it is known while it is being read.
  struct Found {
    SourcePtr source;
    std::string known_as;
  };

  Unit& unit(const SourcePtr& source) {
    const Temporary begin(unit_begin_, open_.size());
    Unit& result = program_.units.emplace_back();
    result.path = source->name();
    result.has_words = dialect_ == Dialect::openscad && is_vcad(source->name());
    units_[normal(source->name())] = &result;  // before its files are read, since these may use it in turn
    splice({source, dialect_ == Dialect::openscad ? "" : normal(source->name())}, result);
    if (dialect_ == Dialect::vcad) warn_of_replaced(result.plan, diagnostics_);
    return result;
  }

  // Adds a file's statements to the unit, with the statements of included files in their places.
  void splice(const Found& found, Unit& into) {
    const SourcePtr& source = found.source;
    open_.push_back(found.known_as);
    program_.files.push_back(parse_deferred(source, program_.names, dialect_of(source->name()), diagnostics_));
    const ast::File& file = program_.files.back();
    for (const ast::StatementPtr& statement : file.statements) {
      if (statement->kind == ast::Statement::Kind::include)
        bring(static_cast<const ast::Include&>(*statement), into);
      else
        into.plan.add(*statement);
    }
    open_.pop_back();
  }

  void bring(const ast::Include& include, Unit& into) {
    if (dialect_ == Dialect::openscad && include.is_use && include.path == "ombre") {
      into.has_words = true;
      return;
    }
    if (is_font(include)) return find_font(include);
    const Found found = find(include);
    if (!found.source) return;
    if (include.is_use) {
      if (const auto known = units_.find(normal(found.source->name())); known != units_.end()) {
        into.uses.push_back(known->second);
        return;
      }
    }
    if (!may_open(include, found.known_as)) return;
    if (!include.is_use) return splice(found, into);
    into.uses.push_back(&unit(found.source));
  }

  bool may_open(const ast::Include& include, const std::string& path) {
    std::string message, hint;
    Code code = Code::limit;
    if (!include.is_use && is_open(path)) {
      message = '"' + path + "\" includes itself" + way_round(path);
      hint = "move what both need into a third file";
      code = Code::script;
    } else if (open_.size() > static_cast<size_t>(limits_.include_depth)) {
      message = "files include each other deeper than " + std::to_string(limits_.include_depth) + " levels";
    } else if (program_.files.size() >= static_cast<size_t>(limits_.files)) {
      if (was_reported_) return false;
      was_reported_ = true;
      message = "this design includes more than " + std::to_string(limits_.files) + " files";
    } else {
      return true;
    }
    diagnostics_.error(code, include.path_span.range(), message, hint);
    return false;
  }

  // Returns the place of the file among those of the unit that are being read.
  std::vector<std::string>::const_iterator find_open(const std::string& path) const {
    return std::find(open_.begin() + static_cast<std::ptrdiff_t>(unit_begin_), open_.end(), path);
  }
  bool is_open(const std::string& path) const { return find_open(path) != open_.end(); }

  // Returns the files between, for a message: ", through a.vcad and b.vcad".
  std::string way_round(const std::string& path) const {
    std::string names;
    for (auto at = find_open(path) + 1; at != open_.end(); ++at)
      names += (names.empty() ? ", through " : " and ") + *at;
    return names;
  }

  bool is_font(const ast::Include& include) const {
    const std::string ending = to_lower(fs::path(include.path).extension().string());
    return dialect_ == Dialect::openscad && include.is_use && (ending == ".ttf" || ending == ".otf");
  }

  void find_font(const ast::Include& include) {
    std::error_code ignored;
    for (const std::string& place : places(include))
      if (fs::is_regular_file(place, ignored)) return program_.fonts.push_back(place);
    cannot_open(include);
  }

  // The message of OpenSCAD, which goes on without the file. Returns false.
  bool cannot_open(const ast::Include& include) {
    const std::string what = include.is_use ? "library" : "include file";
    diagnostics_.warning({}, "Can't open " + what + " '" + include.path + "'.");
    return false;
  }

  static bool is_vcad(const std::string& path) { return to_lower(path).ends_with(".vcad"); }

  // Operators in .vcad files keep their language when OpenSCAD scripts use them.
  Dialect dialect_of(const std::string& path) const { return is_vcad(path) ? Dialect::vcad : dialect_; }

  // Returns the paths beside the including file, beside the file that it links to, and in the working directory.
  static std::vector<std::string> near_places(const ast::Include& include) {
    return places_of(include.path, (*include.span.source)->name());
  }

  // Returns the paths in the libraries, as OpenSCAD finds them; for designs, which only use libraries and whose paths
  // cannot leave them, also the path beside the design.
  std::vector<std::string> library_places(const ast::Include& include) const {
    const fs::path path(include.path);
    const bool is_design = dialect_ == Dialect::vcad;
    const bool stays_inside = path.is_relative() && std::ranges::find(path, fs::path("..")) == path.end();
    if (is_design && !(include.is_use && stays_inside)) return {};
    std::vector<std::string> places;
    if (is_design) places.push_back((fs::path(program_.units.front().path).parent_path() / path).generic_string());
    for (const std::string& library : libraries_) places.push_back((fs::path(library) / path).generic_string());
    return places;
  }

  std::vector<std::string> places(const ast::Include& include) const {
    std::vector<std::string> places = near_places(include);
    for (std::string& place : library_places(include))
      if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
    return places;
  }

  // Returns the places of a file that an OpenSCAD script includes, each with the name by which the file is known while
  // it is being read. As in OpenSCAD 2021.01, a path with a folder may also begin in the working directory. By this
  // path the file has a name of its own, so that it may include itself once more.
  std::vector<std::pair<std::string, std::string>> named_places(const ast::Include& include) const {
    const std::vector<std::string> places = this->places(include);
    std::vector<std::pair<std::string, std::string>> named{{places.front(), whole_path(places.front())}};
    for (const std::string& path : places)
      if (path != places.front() && path != include.path) named.emplace_back(path, whole_path(path));
    if (fs::path(include.path).has_parent_path()) named.emplace_back(include.path, include.path);
    return named;
  }

  Found find_unopened(const ast::Include& include) {
    for (const auto& [path, known_as] : named_places(include)) {
      if (is_open(known_as)) continue;
      if (auto text = read_(path)) return {make_source(path, std::move(*text)), known_as};
    }
    cannot_open(include);
    return {};
  }

  Found find(const ast::Include& include) {
    if (include.path.empty()) {
      diagnostics_.error(Code::syntax, include.span.range(), "there is no path between < and >");
      return {};
    }
    if (dialect_ == Dialect::openscad && !include.is_use) return find_unopened(include);
    const std::vector<std::string> places = this->places(include);
    for (const std::string& path : places)
      if (auto text = read_(path)) return {make_source(path, std::move(*text)), normal(path)};
    if (dialect_ == Dialect::openscad) {
      cannot_open(include);
      return {};
    }
    diagnostics_.error(Code::file_missing, include.path_span.range(), "there is no file \"" + include.path + '"',
                       "looked for " + places_text(include, places), {{"file", include.path}});
    return {};
  }

  static std::string places_text(const ast::Include& include, std::vector<std::string> places) {
    const size_t near = near_places(include).size();
    if (near > 1) places[near - 1] += " in the working directory";
    return join(places, " and ");
  }

  // Returns the path from the root, without links.
  static std::string whole_path(const std::string& path) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? normal(path) : whole.generic_string();
  }
  static std::string normal(const std::string& path) { return fs::path(path).lexically_normal().generic_string(); }

  const Limits& limits_;
  std::function<std::optional<std::string>(const std::string&)> read_;
  Dialect dialect_;
  const std::vector<std::string>& libraries_;
  Diagnostics& diagnostics_;
  Program program_;
  std::vector<std::string> open_;             // files that are being read, outermost first
  size_t unit_begin_ = 0;                     // number of the first of them that belongs to the unit
  std::map<std::string, const Unit*> units_;  // by the path of their first file
  bool was_reported_ = false;
};

}  // namespace

std::optional<std::string> read_real_file(const std::string& path) {
  std::error_code status;
  if (!fs::is_regular_file(path, status) || fs::file_size(path, status) > largest_file) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Program load(const SourcePtr& source, const Options& options, Diagnostics& diagnostics) {
  return Loader(options, diagnostics).run(source);
}

}  // namespace ombre::lang
