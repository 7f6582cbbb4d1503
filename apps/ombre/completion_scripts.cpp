// Scripts for shells; each passes the words typed so far to `ombre completion words`.
#include <map>

#include "base/text/text.h"
#include "ombre/completion.h"

namespace ombre::cli {
namespace {

constexpr const char* bash = R"(# bash completion of ombre: source <(ombre completion bash)
_ombre() {
  local line
  COMPREPLY=()
  while IFS= read -r line; do
    COMPREPLY+=("${line%%$'\t'*}")
  done < <("${COMP_WORDS[0]}" completion words "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o bashdefault -o default -F _ombre ombre
)";

constexpr const char* zsh = R"(#compdef ombre
# zsh completion of ombre: source <(ombre completion zsh), after compinit
_ombre() {
  local line
  local -a found
  while IFS= read -r line; do
    found+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
  done < <("${words[1]}" completion words "${(@)words[2,CURRENT]}" 2>/dev/null)
  if (( ${#found} )); then
    _describe ombre found
  else
    _files
  fi
}
if [ "${funcstack[1]}" = _ombre ]; then
  _ombre "$@"
else
  compdef _ombre ombre
fi
)";

constexpr const char* fish = R"(# fish completion of ombre: ombre completion fish | source
function __ombre_words
  set -l words (commandline -opc) (commandline -ct)
  set -l found ($words[1] completion words $words[2..-1] 2>/dev/null)
  if test (count $found) -gt 0
    printf '%s\n' $found
  else
    __fish_complete_path (commandline -ct)
  end
end
complete -c ombre -f -a '(__ombre_words)'
)";

const std::map<std::string, const char*>& scripts() {
  static const std::map<std::string, const char*> all{{"bash", bash}, {"fish", fish}, {"zsh", zsh}};
  return all;
}

}  // namespace

std::string completion_script(const std::string& shell) {
  const auto found = scripts().find(shell);
  return found == scripts().end() ? "" : found->second;
}

std::vector<std::string> completion_shells() {
  std::vector<std::string> names;
  for (const auto& [name, script] : scripts()) names.push_back(name);
  return names;
}

}  // namespace ombre::cli
