// Loads tables of numbers in CSV files.
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

constexpr size_t most_table_numbers = size_t{1} << 22;

// Returns the separator of the numbers in a line: a comma if there is one, else a semicolon or a tab, else a space.
char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::vector<std::string> words_of(std::string_view line) {
  const char separator = separator_of(line);
  std::vector<std::string> words;
  for (const std::string& word : split(line, separator)) {
    const auto trimmed = trim(word);
    if (separator != ' ' || !trimmed.empty()) words.emplace_back(trimmed);
  }
  return words;
}

class TableReader {
 public:
  TableReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  std::vector<std::vector<double>> run() {
    size_t begin = 0;
    for (int line = 1; begin <= text_.size(); ++line) {
      const size_t end = std::min(text_.find('\n', begin), text_.size());
      take(trim(text_.substr(begin, end - begin)), line);
      begin = end + 1;
    }
    if (rows_.empty()) fail(1, "the table holds no numbers");
    return std::move(rows_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw Error(Code::file_content,
                path_ + ":" + std::to_string(line) + ": " + message +
                    "; expected lines of numbers such as 0.5, 20, beneath one of names if there is one",
                {{"file", path_}});
  }

  void take(std::string_view line, int number) {
    if (line.empty() || line.front() == '#') return;
    const std::vector<std::string> words = words_of(line);
    std::vector<double> row;
    for (const std::string& word : words) {
      const auto value = parse_number(word);
      if (!value && rows_.empty() && !has_names_ && row.empty()) {
        has_names_ = true;
        return;
      }
      if (!value) fail(number, "\"" + word + "\" is no number");
      row.push_back(*value);
    }
    if (!rows_.empty() && row.size() != rows_.front().size())
      fail(number, "this line has " + std::to_string(row.size()) + " numbers, the first has " +
                       std::to_string(rows_.front().size()));
    count_ += row.size();
    if (count_ > most_table_numbers) fail(number, "the table has more than 4 million numbers");
    rows_.push_back(std::move(row));
  }

  const std::string& path_;
  std::string_view text_;
  std::vector<std::vector<double>> rows_;
  bool has_names_ = false;
  size_t count_ = 0;
};

}  // namespace

std::shared_ptr<const std::vector<std::vector<double>>> TableRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<Result>;
  return loading.cached<Result>(sources::Key("table").add(file.content).hash(), file.path, [&](const Reader&) {
    auto rows = std::make_shared<Result>(TableReader(file.path, *loading.bytes(file)).run());
    const size_t bytes = rows->size() * (sizeof(std::vector<double>) + 8 * rows->front().size());
    return Made{std::move(rows), bytes};
  });
}

}  // namespace ombre::design
