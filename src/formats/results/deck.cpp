#include "formats/results/deck.h"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

// Calls `take` with each line that is neither empty nor a comment, trimmed, and its place.
template <class Take>
void each_line(std::string_view bytes, const Take& take) {
  size_t begin = bytes.size() - without_byte_order_mark(bytes).size();
  while (begin < bytes.size()) {
    const size_t end = std::min(bytes.find_first_of("\r\n", begin), bytes.size());
    const std::string_view line = trim(bytes.substr(begin, end - begin));
    if (!line.empty() && !line.starts_with("**")) take(line, begin, end);
    begin = end + 1;
  }
}

std::string_view without_quotes(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return text;
  return text.substr(1, text.size() - 2);
}

// Returns "end part" for " END  PART".
std::string plain_words(std::string_view text) {
  std::string words, small = to_lower(text);
  std::ranges::replace(small, '\t', ' ');
  for (const std::string& word : split(small, ' '))
    if (!word.empty()) words += (words.empty() ? "" : " ") + word;
  return words;
}

std::optional<double> number_in(std::string_view text) {
  if (const auto plain = parse_number(text)) return plain;
  // An exponent may have D in place of E, or no letter at all.
  std::string usual(text);
  std::ranges::replace(usual, 'd', 'e');
  std::ranges::replace(usual, 'D', 'e');
  const size_t sign = usual.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && usual.find_first_of("eE") == std::string::npos) usual.insert(sign, "e");
  return parse_number(usual);
}

Keyword parsed(const std::string& text, const DeckLine& line) {
  Keyword keyword;
  keyword.line = line;
  const std::vector<std::string> words = split(text, ',');
  keyword.name = '*' + plain_words(std::string_view(words.front()).substr(1));
  for (size_t n = 1; n < words.size(); ++n) {
    const std::string_view word = trim(words[n]);
    if (word.empty()) continue;
    const size_t equals = word.find('=');
    const std::string_view value = equals == std::string_view::npos ? "" : word.substr(equals + 1);
    keyword.parameters.insert_or_assign(plain_words(word.substr(0, equals)), without_quotes(trim(value)));
  }
  return keyword;
}

// True if the data of the keyword may stand in a file of their own, which decides the mesh.
bool has_data_of_mesh(const Keyword& keyword) {
  constexpr auto names = std::to_array<std::string_view>({"*include", "*node", "*element", "*nset", "*elset"});
  return keyword.has("input") && std::ranges::find(names, keyword.name) != names.end();
}

// Joins keyword lines, which go on in the next line if they end in a comma.
class Cards {
 public:
  Cards(std::function<void(const Keyword&)> keyword, std::function<void(const DeckLine&)> data)
      : keyword_(std::move(keyword)), data_(std::move(data)) {}

  void take(const DeckLine& line) {
    if (line.text.starts_with('*')) {
      finish();
      text_ = line.text;
      line_ = line;
    } else if (text_.ends_with(',')) {
      text_ += line.text;
    } else {
      finish();
      data_(line);
    }
  }
  void finish() {
    if (text_.empty()) return;
    const Keyword keyword = parsed(text_, line_);
    text_.clear();
    keyword_(keyword);
  }

 private:
  std::function<void(const Keyword&)> keyword_;
  std::function<void(const DeckLine&)> data_;
  std::string text_;  // a keyword line that may go on
  DeckLine line_;
};

class DeckFiles {
 public:
  DeckFiles(const std::vector<ResultsFile>& beside, DeckListener& listener, Diagnostics& diagnostics)
      : beside_(beside), listener_(listener), diagnostics_(diagnostics) {}

  void read(const std::string& name, std::string_view bytes) {
    const TextScanner& scanner = scanners_.emplace_back(name, bytes, diagnostics_);
    open_.push_back(&name);
    Cards cards([&](const Keyword& keyword) { take(keyword); }, [&](const DeckLine& line) { listener_.data(line); });
    each_line(bytes, [&](std::string_view text, size_t begin, size_t end) {
      cards.take({&scanner, text, begin, end});
    });
    cards.finish();
    open_.pop_back();
  }

 private:
  // Lines that are included belong to the keyword above.
  void take(const Keyword& keyword) {
    if (keyword.name != "*include") listener_.keyword(keyword);
    if (has_data_of_mesh(keyword)) include(keyword);
  }

  void include(const Keyword& keyword) {
    const std::string& written = keyword.value("input");
    const auto file = std::ranges::find(beside_, written, &ResultsFile::written);
    if (file == beside_.end())
      keyword.line.fail("the file " + formats::quoted(written) + ", which the deck includes, cannot be read",
                        "put it beside the deck");
    const auto is_this = [&](const std::string* name) { return *name == file->name; };
    if (std::ranges::any_of(open_, is_this))
      keyword.line.fail("the file " + formats::quoted(written) + " includes itself");
    read(file->name, file->bytes);
  }

  const std::vector<ResultsFile>& beside_;
  DeckListener& listener_;
  Diagnostics& diagnostics_;
  std::deque<TextScanner> scanners_;      // of all files
  std::vector<const std::string*> open_;  // names of the files that are being read
};

}  // namespace

std::vector<std::string_view> DeckLine::fields() const {
  std::vector<std::string_view> list;
  std::string_view rest = text;
  while (!rest.empty()) {
    const size_t comma = std::min(rest.find(','), rest.size());
    list.push_back(trim(rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return list;
}

std::vector<double> DeckLine::numbers() const {
  std::vector<double> list;
  for (const std::string_view field : fields()) {
    const auto number = field.empty() ? std::optional(0.0) : number_in(field);
    if (!number) fail("expected a number, found " + formats::quoted(field));
    list.push_back(*number);
  }
  return list;
}

uint64_t deck_number(const DeckLine& line, double number) {
  if (number >= 1 && number < 1e15 && number == static_cast<double>(static_cast<uint64_t>(number)))
    return static_cast<uint64_t>(number);
  line.fail("expected the number of a node or element, found " + format_number(number));
}

const std::string& Keyword::value(std::string_view parameter) const {
  static const std::string none;
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? none : found->second;
}

std::string Keyword::name_of(std::string_view parameter) const { return to_lower(value(parameter)); }

void read_cards(const std::string& name, std::string_view bytes, const std::vector<ResultsFile>& beside,
                DeckListener& listener, Diagnostics& diagnostics) {
  DeckFiles files(beside, listener, diagnostics);
  files.read(name, bytes);
  listener.end();
}

std::vector<std::string> files_named_in_deck(std::string_view bytes, uint64_t) {
  std::vector<std::string> names;
  Cards cards(
      [&](const Keyword& keyword) {
        if (has_data_of_mesh(keyword)) names.push_back(keyword.value("input"));
      },
      [](const DeckLine&) {});
  each_line(bytes, [&](std::string_view text, size_t begin, size_t end) { cards.take({nullptr, text, begin, end}); });
  cards.finish();
  return names;
}

}  // namespace ombre::formats
