#include "base/text/diagnostic.h"

#include <algorithm>

namespace ombre {
namespace {

constexpr size_t widest_line = 160;  // longer source lines are cut around the error

// Replaces control characters, which could change the state of the terminal.
std::string without_controls(std::string_view text) {
  std::string clean;
  for (const char c : text) {
    if ((c >= 0 && c < ' ' && c != '\t' && c != '\n') || c == '\x7f')
      clean += "\uFFFD";
    else
      clean += c;
  }
  return clean;
}

bool has_place(const SourceRange& where) { return where.source && where.end > 0; }

// Returns "file:line:column: ", "file: " or nothing.
std::string place_text(const SourceRange& where) {
  if (!where.source) return "";
  if (!has_place(where)) return where.source->name() + ": ";
  const Place place = where.source->place(where.begin);
  return where.source->name() + ':' + std::to_string(place.line) + ':' + std::to_string(place.column) + ": ";
}

// Returns the source line and, below it, a marker as long as the range.
std::string excerpt(const SourceRange& where) {
  const Place place = where.source->place(where.begin);
  std::string_view line = where.source->line(place.line);
  if (line.empty()) return {};
  const SourceText& source = *where.source;
  const Place end = source.place(std::max(where.end, where.begin));
  // The marker line repeats tabs, so that it lines up at any tab width.
  size_t at = 0;
  for (int column = 1; column < place.column && at < line.size(); ++at)
    if (at + 1 >= line.size() || (static_cast<unsigned char>(line[at + 1]) & 0xC0) != 0x80) ++column;
  size_t from = 0;
  if (at > widest_line / 2) from = at - 20;
  while (from > 0 && (static_cast<unsigned char>(line[from]) & 0xC0) == 0x80) --from;
  size_t to = std::min(line.size(), from + widest_line);
  while (to < line.size() && (static_cast<unsigned char>(line[to]) & 0xC0) == 0x80) ++to;

  const std::string number = std::to_string(place.line);
  std::string text = "  " + number + " | ";
  text += line.substr(from, to - from);
  text += "\n  " + std::string(number.size(), ' ') + " | ";
  for (size_t i = from; i < at && i < line.size(); ++i) {
    if (line[i] == '\t')
      text += '\t';
    else if ((static_cast<unsigned char>(line[i]) & 0xC0) != 0x80)
      text += ' ';
  }
  // The marker is no longer than the visible part of the range.
  int shown = 0;
  for (size_t i = at; i < to; ++i) shown += (static_cast<unsigned char>(line[i]) & 0xC0) != 0x80;
  const int width = std::clamp(end.line == place.line ? end.column - place.column : 1, 1, std::max(1, shown));
  text += '^' + std::string(width - 1, '~') + '\n';
  return text;
}

}  // namespace

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error && ++error_count_ > most) return;
  list_.push_back(std::move(diagnostic));
}

void Diagnostics::add_all(const Diagnostics& others) {
  for (const Diagnostic& diagnostic : others.list_) add(diagnostic);
  // Adds the errors that `others` counted but did not keep.
  error_count_ += others.error_count_ - std::min(others.error_count_, most);
}

void Diagnostics::add_new(const Diagnostic& diagnostic) {
  if (std::find(list_.begin(), list_.end(), diagnostic) == list_.end()) add(diagnostic);
}

void Diagnostics::add_new(const Diagnostics& others) {
  for (const Diagnostic& diagnostic : others.list_) add_new(diagnostic);
}

Diagnostics Diagnostics::after(size_t count) const {
  Diagnostics rest = *this;
  rest.list_.erase(rest.list_.begin(), rest.list_.begin() + static_cast<ptrdiff_t>(std::min(count, list_.size())));
  return rest;
}

void Diagnostics::error(SourceRange where, std::string message, Phrase hint) {
  add({Severity::error, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::error(Code code, SourceRange where, std::string message, Phrase hint, CodeValues values) {
  add({Severity::error, std::move(where), std::move(message), std::move(hint), code, std::move(values)});
}

void Diagnostics::warning(SourceRange where, std::string message, Phrase hint) {
  add({Severity::warning, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::warning(Code code, SourceRange where, std::string message, Phrase hint, CodeValues values) {
  add({Severity::warning, std::move(where), std::move(message), std::move(hint), code, std::move(values)});
}

void Diagnostics::note(SourceRange where, std::string message) {
  add({Severity::note, std::move(where), std::move(message), {}});
}

void Diagnostics::tell_code(size_t count, Code code, const CodeValues& values) {
  for (size_t n = count; n < list_.size(); ++n) {
    if (list_[n].code == Code::design) list_[n].code = code;
    if (list_[n].values.empty()) list_[n].values = values;
  }
}

std::string hint_of(const Diagnostic& diagnostic, FrontEnd front_end) {
  const SourcePtr& source = diagnostic.where.source;
  return diagnostic.hint.in(wording_of(source ? std::string_view(source->name()) : std::string_view(), front_end));
}

std::string sentence_of(const Diagnostic& diagnostic, FrontEnd front_end) {
  return diagnostic.hint.empty() ? diagnostic.message : diagnostic.message + "; " + hint_of(diagnostic, front_end);
}

std::string placed_sentence_of(const Diagnostic& diagnostic, FrontEnd front_end) {
  return place_text(diagnostic.where) + sentence_of(diagnostic, front_end);
}

std::string to_text(const Diagnostic& diagnostic, FrontEnd front_end) {
  const SourceRange& where = diagnostic.where;
  std::string text = place_text(where);
  text += name_of(diagnostic.severity);
  text += ": " + sentence_of(diagnostic, front_end) + '\n';
  if (has_place(where)) text += excerpt(where);
  return without_controls(text);
}

std::string to_text(const Diagnostics& diagnostics, FrontEnd front_end) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.list()) text += to_text(diagnostic, front_end);
  if (diagnostics.error_count() > Diagnostics::most)
    text += "and " + std::to_string(diagnostics.error_count() - Diagnostics::most) + " more errors\n";
  return text;
}

}  // namespace ombre
