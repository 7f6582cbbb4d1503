#include "ombre/checks.h"

#include "base/text/text.h"

namespace ombre::cli {

CLI::Validator within(const options::Limits& limits) {
  return CLI::Validator([=](const std::string& text) { return options::problem(limits, text); },
                        options::range_text(limits), "");
}

CLI::Validator between(double least, double greatest) { return within({least, greatest, false}); }
CLI::Validator whole_between(int least, int greatest) {
  return within({static_cast<double>(least), static_cast<double>(greatest), true});
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return CLI::Validator([=](const std::string& text) { return options::problem(names, text); },
                        '{' + join(names, ",") + '}', "");
}

}  // namespace ombre::cli
