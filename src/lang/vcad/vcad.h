// The .vcad vocabulary, which makes nodes of a design from calls of a script, including older forms.
#pragma once

#include <optional>

#include "design/design.h"
#include "lang/engine/vocabulary.h"
#include "lang/vcad/equal_nodes.h"
#include "lang/vcad/value_objects.h"

namespace ombre::lang {

class VcadVocabulary : public Vocabulary {
 public:
  // All three arguments must outlive the vocabulary. Without a loader, meshes are errors.
  VcadVocabulary(const design::Registry& registry, const design::MaterialTable& materials,
                 design::SourceLoader* loader);

  bool knows(std::string_view name) const override;
  std::vector<std::string> names() const override;
  std::string hint(std::string_view unknown) const override;
  std::optional<Data> constant(std::string_view name) const override;
  std::vector<std::string> constants() const override;
  Product make(Invocation call, Diagnostics& diagnostics) override;
  bool gives_value(std::string_view name) const override;
  std::vector<std::string> value_names() const override { return registry_.value_names(); }
  std::optional<Value> value(Invocation call, Diagnostics& diagnostics, Meter& meter) override;
  std::optional<Value> solid(std::vector<Product> products, const SourceRange& where, Diagnostics& diagnostics,
                             Meter& meter) override;

  // Returns the design that the top-level nodes make. Returns nothing and adds a diagnostic if there is none.
  std::optional<design::Design> finish(std::vector<Product> top_level, const SourceRange& whole,
                                       Diagnostics& diagnostics);

 private:
  design::NodePtr make_root(Invocation& call, Diagnostics& diagnostics);
  design::NodePtr make_of_type(const design::NodeType& type, Invocation& call, Diagnostics& diagnostics);
  design::NodePtr nothing_inside(const design::NodeType& type, const Invocation& call, Diagnostics& diagnostics);
  std::vector<design::NodePtr> groups(const design::NodeType& type, const Invocation& call,
                                      const std::vector<design::NodePtr>& children, const design::Reader& reader);

  const design::Registry& registry_;
  const design::MaterialTable& materials_;
  design::SourceLoader* loader_;
  ValueMaker maker_;
  EqualNodes known_;
  std::optional<design::Sampling> sampling_;
  std::optional<SourceRange> root_where_;
  design::NodePtr root_;
  std::vector<design::NodePtr> root_children_;
};

}  // namespace ombre::lang
