#include "ink/patch_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::ink {
namespace {

constexpr std::array<std::string_view, 3> lab_names{"L", "a", "b"};
constexpr size_t most_materials_of_patches = 9;

class PatchReader {
 public:
  PatchReader(const std::string& name, std::string_view text) : name_(name), text_(text) {}

  PatchTable run() {
    for (size_t begin = 0; begin < text_.size(); ++line_) {
      const size_t end = std::min(text_.find('\n', begin), text_.size());
      take(trim(text_.substr(begin, end - begin)));
      begin = end + 1;
    }
    if (names_.empty() || found_.empty()) fail("it has no patches below a line of names", remedy());
    add_means();
    if (const auto missing = DropletModel::missing_alone(table_.patches))
      fail("no patch is " + table_.materials[*missing] + " alone", "measure one whose share of it is 1");
    return std::move(table_);
  }

 private:
  static std::string remedy() {
    return "write for example VeroCyan,VeroPureWht,L,a,b and below it 0.25,0.75,70,-20,-30";
  }
  [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
    throw Error(Code::file_content, name_ + ':' + std::to_string(line_) + ": " + message + "; " + hint,
                {{"file", name_}});
  }

  void take(std::string_view line) {
    if (line.empty() || line.front() == '#') return;
    std::vector<std::string> words;
    const char separator = line.find(';') != std::string_view::npos    ? ';'
                           : line.find('\t') != std::string_view::npos ? '\t'
                                                                       : ',';
    for (const std::string& word : split(line, separator)) words.emplace_back(trim(word));
    names_.empty() ? take_names(words) : take_patch(words);
  }

  void take_names(const std::vector<std::string>& words) {
    names_ = words;
    for (const std::string_view wanted : lab_names)
      if (std::ranges::count(words, wanted) != 1)
        fail("the first line has no column " + std::string(wanted) + ", or several", remedy());
    for (const std::string& word : words) {
      if (!is_material(word)) continue;
      if (word.empty() || std::ranges::find(table_.materials, word) != table_.materials.end())
        fail("a column has no name, or that of another one", remedy());
      table_.materials.push_back(word);
    }
    if (table_.materials.size() < 2 || table_.materials.size() > most_materials_of_patches)
      fail("it has " + std::to_string(table_.materials.size()) + " materials", "give 1 to 8 inks, and last the white");
  }

  static bool is_material(const std::string& word) {
    return word != "patch" && std::ranges::find(lab_names, word) == lab_names.end();
  }

  void take_patch(const std::vector<std::string>& words) {
    if (words.size() != names_.size())
      fail(
          "this line has " + std::to_string(words.size()) + " values for " + std::to_string(names_.size()) + " columns",
          "give a value for each");
    Patch patch;
    for (size_t n = 0; n < words.size(); ++n) {
      if (names_[n] == "patch") continue;
      const auto value = parse_number(words[n]);
      if (!value) fail('"' + words[n] + "\" in the column " + names_[n] + " is no number", "write for example 0.25");
      if (is_material(names_[n]))
        patch.shares.push_back(*value);
      else
        patch.colour[static_cast<int>(std::ranges::find(lab_names, names_[n]) - lab_names.begin())] = *value;
    }
    add(std::move(patch));
  }

  void add(Patch patch) {
    constexpr double slack = 2e-3;  // of shares with three digits
    const double sum = std::accumulate(patch.shares.begin(), patch.shares.end(), 0.0);
    const bool is_negative = std::ranges::any_of(patch.shares, [](double share) { return share < 0; });
    if (is_negative || std::abs(sum - 1) > slack)
      fail("the shares add up to " + format_rounded(sum, 6) + (is_negative ? ", and one is negative" : ""),
           "give shares from 0 to 1 of all materials, " + table_.materials.back() + " among them, whose sum is 1");
    for (double& share : patch.shares) share /= sum;
    if (patch.colour.x < 0 || patch.colour.x > 100)
      fail("L is " + format_rounded(patch.colour.x) + ", and it goes from 0 to 100", "give CIE L*a*b* under D50");
    found_[patch.shares].push_back(patch.colour);
  }

  void add_means() {
    for (const auto& [shares, colours] : found_) {
      Lab sum{};
      for (const Lab& colour : colours) sum = sum + colour;
      table_.patches.push_back({shares, (1 / static_cast<double>(colours.size())) * sum});
    }
  }

  const std::string& name_;
  std::string_view text_;
  int line_ = 1;
  std::vector<std::string> names_;
  std::map<std::vector<double>, std::vector<Lab>> found_;
  PatchTable table_;
};

}  // namespace

PatchTable read_patches(const std::string& name, std::string_view text) { return PatchReader(name, text).run(); }

}  // namespace ombre::ink
