#include "ombre/command_options.h"

#include "ombre/checks.h"

namespace ombre::cli {
namespace {

CLI::Option* add_one(CLI::App& app, const options::Option& option, void* job) {
  if (option.takes == options::Takes::nothing)
    return app.add_flag_callback(
        option.names, [option, job] { option.set(job, {}); }, option.help);
  const auto take = [option, job](const CLI::results_t& texts) {
    option.set(job, texts);
    return true;
  };
  CLI::Option* made = app.add_option(option.names, take, option.help);
  if (option.takes == options::Takes::several)
    made->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args(!option.names.starts_with('-'));
  return made->type_name(option.placeholder);
}

}  // namespace

void add_options(CLI::App& app, const std::vector<options::Option>& options, void* job) {
  for (const options::Option& option : options) {
    CLI::Option* made = add_one(app, option, job);
    if (!option.choices.empty()) made->check(one_of(option.choices));
    if (option.limits) made->check(within(*option.limits));
    if (option.is_required) made->required();
  }
  // Conditions are added once all options exist, since an option may need a later one.
  for (const options::Option& option : options) {
    CLI::Option* made = app.get_option(option.name());
    for (const std::string& name : option.needs) made->needs(app.get_option(name));
    for (const std::string& name : option.excludes) made->excludes(app.get_option(name));
  }
}

}  // namespace ombre::cli
