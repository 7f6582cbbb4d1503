#include "ombre/checks.h"

#include <algorithm>
#include <optional>

#include "base/text.h"

namespace ombre::cli {
namespace {

CLI::Validator number_between(double least, double greatest, bool is_whole) {
  const std::string range = format_rounded(least) + " to " + format_rounded(greatest);
  const auto check = [=](const std::string& text) {
    const auto number = parse_number(text);
    const bool has_form = !is_whole || text.find_first_not_of("+-0123456789") == std::string::npos;
    const bool fits = number && has_form && *number >= least && *number <= greatest;
    return fits ? "" : '"' + text + (is_whole ? "\" is not a whole number from " : "\" is not a number from ") + range;
  };
  return CLI::Validator(check, range, "");
}

}  // namespace

CLI::Validator between(double least, double greatest) { return number_between(least, greatest, false); }
CLI::Validator whole_between(int least, int greatest) { return number_between(least, greatest, true); }

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto check = [names](const std::string& text) -> std::string {
    if (std::ranges::find(names, text) != names.end()) return "";
    const std::string hint = did_you_mean(text, names);
    return "there is no \"" + text + "\"; " + (hint.empty() ? "there are " + join(names, ", ") : hint);
  };
  return CLI::Validator(check, '{' + join(names, ",") + '}', "");
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "Threads (default: all cores); never changes a result")
      ->check(whole_between(1, 1024))
      ->type_name("N");
}

}  // namespace ombre::cli
