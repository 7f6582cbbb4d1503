#include "load/node_factory.h"

#include "base/text/text.h"
#include "lang/vcad/node_calls.h"
#include "load/library_folders.h"
#include "nodes/all_nodes.h"

namespace ombre::compile {

design::NodePtr NodeFactory::make(std::string_view type, Arguments arguments, std::vector<design::NodePtr> inputs,
                                  const SourceRange& where, Diagnostics& diagnostics) {
  const design::Registry& registry = nodes::registry();
  const design::NodeType* known = registry.find(type);
  if (!known) {
    diagnostics.error(Code::unknown_node, where, "there is no node \"" + std::string(type) + "\"",
                      did_you_mean(std::string(type), registry.names()),
                      {{"node", std::string(type)}, {"similar", closest_name(type, registry.names()).value_or("")}});
    return nullptr;
  }
  const design::Reader reader{materials_, diagnostics, &loader_, where, known->name, ""};
  std::vector<lang::Argument> call;
  call.reserve(arguments.size());
  for (auto& [name, value] : arguments) call.push_back({std::move(name), {}, std::move(value)});
  const auto values = lang::bound_arguments(*known, std::move(call), reader);
  return values ? lang::make_called(*known, *values, std::move(inputs), registry, reader) : nullptr;
}

std::optional<lang::HostResult> NodeFactory::call(const lang::HostCall& call, const SourceRange& where,
                                                  Diagnostics& diagnostics) {
  lang::Options options;
  options.read_file = [this](const std::string& path) { return sources::read_included(path, *cache_); };
  options.libraries = library_folders();
  return lang::call_operator(call, nodes::registry(), materials_, &loader_, options, where, diagnostics);
}

}  // namespace ombre::compile
