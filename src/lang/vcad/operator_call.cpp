#include "lang/vcad/operator_call.h"

#include "lang/engine/interpret.h"
#include "lang/vcad/node_calls.h"

namespace ombre::lang {
namespace {

using design::NodePtr;

// Words of the script that makes the call. Their only argument is a number of the list that they stand for.
constexpr std::string_view argument_word = "host_argument", child_word = "host_child", result_word = "host_result";

size_t index_in(const Invocation& call) { return static_cast<size_t>(*call.arguments.front().value.number()); }

// Knows the words by which the script gets what the host gives, and returns what it makes.
class HostVocabulary final : public VcadVocabulary {
 public:
  HostVocabulary(const HostCall& call, const design::Registry& registry, const design::MaterialTable& materials,
                 design::SourceLoader* loader)
      : VcadVocabulary(registry, materials, loader), call_(call), maker_{registry, materials} {}

  bool knows(std::string_view name) const override {
    return name == child_word || name == result_word || VcadVocabulary::knows(name);
  }
  bool gives_value(std::string_view name) const override {
    return name == argument_word || VcadVocabulary::gives_value(name);
  }
  Product make(Invocation call, Diagnostics& diagnostics) override {
    if (call.name == child_word) return call_.children[index_in(call)];
    if (call.name != result_word) return VcadVocabulary::make(std::move(call), diagnostics);
    result_ = std::move(call.arguments.front().value);
    return nullptr;
  }
  std::optional<Value> value(Invocation call, Diagnostics& diagnostics, Meter& meter) override {
    if (call.name != argument_word) return VcadVocabulary::value(std::move(call), diagnostics, meter);
    return host_value(call_.arguments[index_in(call)].second, maker_, meter);
  }

  const std::optional<Data>& result() const { return result_; }

 private:
  const HostCall& call_;
  ValueMaker maker_;
  std::optional<Data> result_;
};

std::string numbered(std::string_view word, size_t n) { return std::string(word) + '(' + std::to_string(n) + ')'; }

std::string script_of(const HostCall& call) {
  std::string text = call.name + '(';
  for (size_t n = 0; n < call.arguments.size(); ++n) {
    const std::string& name = call.arguments[n].first;
    text += (n == 0 ? "" : ", ") + (name.empty() ? "" : name + " = ") + numbered(argument_word, n);
  }
  text += ')';
  if (!call.is_module) text = std::string(result_word) + '(' + text + ')';
  if (!call.children.empty()) {
    text += " {";
    for (size_t n = 0; n < call.children.size(); ++n) text += ' ' + numbered(child_word, n) + ';';
    text += " }";
  } else {
    text += ';';
  }
  return "use <" + call.library + ">\n" + text + '\n';
}

NodePtr joined_solids(std::vector<Product> products, const design::Registry& registry, const design::Reader& reader) {
  std::vector<NodePtr> nodes;
  for (Product& product : products) nodes.push_back(std::static_pointer_cast<const design::Node>(std::move(product)));
  if (nodes.empty()) return design::make_nothing(*registry.find("union"), reader.where);
  return joined(std::move(nodes), registry, reader);
}

}  // namespace

std::optional<HostResult> call_operator(const HostCall& call, const design::Registry& registry,
                                        const design::MaterialTable& materials, design::SourceLoader* loader,
                                        const Options& options, const SourceRange& where, Diagnostics& diagnostics) {
  HostVocabulary vocabulary(call, registry, materials, loader);
  Diagnostics found;
  std::vector<Product> products = run(make_source("", script_of(call)), vocabulary, options, found);
  for (const Diagnostic& diagnostic : found.list()) {
    Diagnostic here = diagnostic;
    const bool is_in_call = !here.where.source || here.where.source->name().empty();
    if (is_in_call) here.where = where;  // the text of the call is not the user's
    diagnostics.add(std::move(here));
  }
  if (found.has_errors()) return std::nullopt;
  if (!call.is_module) return HostResult{nullptr, vocabulary.result().value_or(Data())};
  const design::Reader reader{materials, diagnostics, loader, where, call.name, ""};
  NodePtr solid = joined_solids(std::move(products), registry, reader);
  return solid ? std::optional(HostResult{std::move(solid), {}}) : std::nullopt;
}

}  // namespace ombre::lang
