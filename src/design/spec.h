// Makes a node type from a plain struct, using the struct's spec() and its methods.
//
// A node is a struct with parameters as members. It has these methods:
// - static Spec<T> spec() gives its name, sentence, parameters, inputs and an example.
// - Box bounds(where) const, for leaves, returns a box around the inside within `where`.
// - Box reach(Inputs, where, margin) const, for other nodes, returns a box around the points with g <= margin.
// - Field distance([Inputs,] Point) const returns g, which is negative inside.
// - Point inner(Point) const, in place of `distance` for nodes that only map points, returns the point at which the
//   input is evaluated; `scale()` is the factor of its distance.
//
// It may have these methods if the defaults do not fit:
// - Metric metric([Inputs]) const; by default leaves with constant numbers are exact.
// - membership, composition, attribute, declares, passed, complete, traits, makes_nothing.
//
// A node may have outputs in its spec; one without a shape gives values alone. An output is a method of the struct,
// whose return type determines the output's type (design/ports/output.h):
// - R method(Ask) const, for a number (Field), vector, colour, frame (Point), label, mixture (Composition), solid or
//   region. The last two also have Box bounds(where) const.
// - M method() const, or a member, for a constant of any type of parameters: a text, points, a file, ...
// - bool gives(output) const, which is true by default, says whether the parameters allow an output.
#pragma once

#include <algorithm>
#include <concepts>

#include "base/system/assert.h"
#include "design/registry.h"

namespace ombre::design {

// True if the solid has a composition of its own, besides that of its material.
template <class T>
concept HasComposition = requires(const T& t, const Inputs& in, const Point& p) {
  t.composition(in, p, Demand::inside);
};

template <class T>
struct Parameter {
  // The member may be one of a base class of T.
  template <class M, class Owner>
  requires std::derived_from<T, Owner> Parameter(std::string_view name_, M Owner::*member, std::string_view doc_,
                                                 Domain domain_ = {})
      : name(name_), doc(doc_), domain(std::move(domain_)) {
    static_assert(std::is_object_v<M>, "a parameter is a member, not a method");
    static_assert(IsPort<M>, "a type of parameters has a Port (design/ports/port.h)");
    if constexpr (requires { Port<M>::adapt(domain, true); }) Port<M>::adapt(domain, HasComposition<T>);
    if constexpr (requires { Port<M>::takes_other_names; }) takes_other_names = true;
    text = Port<M>::text(domain);
    set = [member, limits = domain](T& value, const Data& data, const Reader& reader) {
      return Port<M>::read(data, limits, value.*member, reader);
    };
    get = [member](const T& value, bool for_hash) { return Port<M>::write(value.*member, for_hash); };
    if constexpr (requires(const M& m) { Port<M>::is_constant(m); })
      is_constant = [member](const T& value) { return Port<M>::is_constant(value.*member); };
    if constexpr (requires(const M& m) { Port<M>::uses_cell(m); })
      uses_cell = [member](const T& value) { return Port<M>::uses_cell(value.*member); };
    if constexpr (requires(M & m, const Reader& reader) { Port<M>::fill(m, reader); })
      fill = [member](T& value, const Reader& reader) { Port<M>::fill(value.*member, reader); };
  }

  std::string_view name, doc;
  PortText text;
  Domain domain;
  bool takes_other_names = false;
  std::function<bool(T&, const Data&, const Reader&)> set;
  std::function<Data(const T&, bool)> get;
  // Empty for types that neither vary in space nor have a default that depends on the design.
  std::function<bool(const T&)> is_constant, uses_cell;
  std::function<void(T&, const Reader&)> fill;
};

// A method that computes an output, or a constant.
template <class T>
struct OutputSpec {
  // `range` contains all values of a number.
  template <VariesInSpace R>
  OutputSpec(std::string_view name, R (T::*method)(const Ask&) const, std::string_view doc,
             const Interval& range = Interval::everything())
      : info{std::string(name), std::string(doc), OutputPort<R>::type(), range},
        answer([method](const T& t, const Ask& ask) { return OutputPort<R>::answer((t.*method)(ask)); }) {
    ASSERT(info.type.form != OutputForm::solid && "an output that is a solid has bounds");
  }
  // `where_` returns a box around the inside of the solid or region.
  template <VariesInSpace R>
  OutputSpec(std::string_view name, R (T::*method)(const Ask&) const, Box (T::*where_)(const Box&) const,
             std::string_view doc)
      : info{std::string(name), std::string(doc), OutputPort<R>::type()},
        answer([method](const T& t, const Ask& ask) { return OutputPort<R>::answer((t.*method)(ask)); }),
        bounds([where_](const T& t, const Box& where) { return (t.*where_)(where); }) {}
  template <IsPort M>
  OutputSpec(std::string_view name, M (T::*method)() const, std::string_view doc)
      : info{std::string(name), std::string(doc), OutputPort<M>::type()},
        constant([method](const T& t) { return Port<M>::write((t.*method)(), false); }) {}
  template <IsPort M, class Owner>
  requires std::derived_from<T, Owner> OutputSpec(std::string_view name, M Owner::*member, std::string_view doc)
      : info{std::string(name), std::string(doc), OutputPort<M>::type()},
        constant([member](const T& t) { return Port<M>::write(t.*member, false); }) {}
  template <class M>
  requires(!IsPort<M>)
      OutputSpec(std::string_view, M T::*, std::string_view, const Interval& = Interval::everything()) {
    static_assert(
        !std::is_same_v<M, M>,
        "an output is a method that takes a const Ask&, is const, and returns a Field, VectorField or another "
        "type that has an OutputPort");
  }

  OutputInfo info;
  std::function<OutputAnswer(const T&, const Ask&)> answer;
  std::function<Data(const T&)> constant;
  std::function<Box(const T&, const Box&)> bounds;
};

template <class T>
struct Spec {
  std::string_view name, sentence;
  std::vector<Parameter<T>> parameters;
  InputInfo inputs = no_inputs;
  std::string_view example;
  std::vector<OutputSpec<T>> outputs = {};
};

// Returns the box that `within` computes for `where`. If that depends on fields, the box is refined by calling `within`
// again on the result.
template <class Within>
Box tightened(const Box& where, const Within& within) {
  constexpr int most = 16;
  Box box = within(where);
  for (int n = 0; n < most && !box.is_empty(); ++n) {
    const Box next = within(box);
    if (next == box || next.is_empty() || length(next.size()) > 0.99 * length(box.size())) return next;
    box = next;
  }
  return box;
}

template <class T>
class NodeTypeOf;

// A node with its struct.
template <class T>
class NodeOf final : public Node {
 public:
  // True if it has neither a shape nor a map of points, but adds something to its input.
  static constexpr bool passes_on = !requires(const T& t, const Inputs& in, const Point& p) { t.distance(in, p); }
  &&!requires(const T& t, const Point& p) { t.distance(p); }
  &&!requires(const T& t, const Point& p) { t.inner(p); };

  T data;

  explicit NodeOf(const NodeTypeOf<T>& type) : type_(type) {}

  const NodeType& type() const override { return type_; }

  Box reach(const Inputs& in, const Box& where, double margin) const override {
    if constexpr (requires { data.reach(in, where, margin); }) return intersect(data.reach(in, where, margin), where);
    // The g of a leaf is at least the distance to its shape.
    else if constexpr (requires { data.bounds(where); }) {
      const auto within = [&](const Box& box) {
        return intersect(data.bounds(box.expanded(margin)).expanded(margin), box);
      };
      return tightened(where, within);
    } else
      return in.count() > 0 ? in.reach(0, where, margin) : where;
  }

  Field distance(const Inputs& in, const Point& p) const override {
    if constexpr (requires { data.distance(in, p); })
      return data.distance(in, p);
    else if constexpr (requires { data.distance(p); })
      return data.distance(p);
    else if constexpr (requires { data.scale(); }) {
      const Field inner_distance = in.distance(0, data.inner(p));
      return data.scale() == 1 ? inner_distance : inner_distance * data.scale();
    } else
      return in.distance(0, p);
  }

  std::optional<Field> membership(const Inputs& in, const Point& p, Border border) const override {
    if constexpr (requires { data.membership(in, p, border); })
      return data.membership(in, p, border);
    else if constexpr (passes_on)
      return in.membership(0, p, border);
    else
      return std::nullopt;
  }

  std::optional<Composition> composition(const Inputs& in, const Point& p, Demand demand) const override {
    if constexpr (requires { data.composition(in, p, demand); })
      return data.composition(in, p, demand);
    else if constexpr (requires { data.material; })
      return in.composition_of(data.material, p);
    else
      return std::nullopt;
  }

  std::optional<Field> attribute(const Inputs& in, std::string_view name, const Point& p,
                                 Demand demand) const override {
    if constexpr (requires { data.attribute(in, name, p, demand); })
      return data.attribute(in, name, p, demand);
    else
      return std::nullopt;
  }

  std::optional<AttributeDeclaration> declares() const override {
    if constexpr (requires { data.declares(); })
      return data.declares();
    else
      return std::nullopt;
  }

  bool keeps_shape() const override { return passes_on && type_.is_solid() && inputs().size() == 1; }

  std::optional<Point> inner(const Point& p) const override {
    if constexpr (requires { data.inner(p); })
      return data.inner(p);
    else
      return std::nullopt;
  }

  std::optional<Numbers4> passed(const Inputs& in, std::string_view output, const Point& p) const override {
    if constexpr (requires { data.passed(in, output, p); })
      return data.passed(in, output, p);
    else
      return std::nullopt;
  }

  Traits traits() const override {
    Traits traits;
    if constexpr (requires { data.traits(); }) traits = data.traits();
    if (!type_.has_constant_numbers(data)) traits.nearest_copy_is_enough_from = Traits().nearest_copy_is_enough_from;
    return traits;
  }

  bool gives(size_t output) const override {
    if constexpr (requires { data.gives(output); })
      return data.gives(output);
    else
      return output < type_.outputs.size();
  }

  OutputAnswer answer(size_t output, const Ask& ask) const override {
    return type_.output_spec(output).answer(data, ask);
  }

  Data constant(size_t output) const override { return type_.output_spec(output).constant(data); }

  Box output_bounds(size_t output, const Box& where) const override {
    return intersect(type_.output_spec(output).bounds(data, where), where);
  }

 private:
  Metric find_metric(const Inputs& in) const override {
    // A field in place of a number distorts the node's own shape. A node that only adds a field keeps its input's
    // shape.
    if constexpr (!passes_on)
      if (!type_.has_constant_numbers(data)) return Metric::implicit();
    if constexpr (requires { data.metric(in); })
      return data.metric(in);
    else if constexpr (requires { data.metric(); })
      return data.metric();
    else
      return in.count() > 0 ? in.metric(0) : Metric::exact();
  }

  bool parameters_use_cell() const override { return type_.uses_cell(data); }

  const NodeTypeOf<T>& type_;
};

// Checks the signatures of a node's methods. A method with a wrong signature would otherwise be ignored silently.
template <class T>
consteval bool has_right_methods() {
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::distance)>; })
    static_assert(
        requires(const T& t, const Inputs& in, const Point& p) { Field(t.distance(in, p)); } ||
            requires(const T& t, const Point& p) { Field(t.distance(p)); } ||
            requires(const T& t, const Ask& ask) { Field(t.distance(ask)); },
        "distance is Field distance(const Inputs&, const Point&) const, or takes a Point alone");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::membership)>; })
    static_assert(
        requires(const T& t, const Inputs& in, const Point& p) { Field(t.membership(in, p, Border::included)); },
        "membership is Field membership(const Inputs&, const Point&, Border) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::composition)>; })
    static_assert(HasComposition<T>,
                  "composition is Composition composition(const Inputs&, const Point&, Demand) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::attribute)>; })
    static_assert(
        requires(const T& t, const Inputs& in, const Point& p) {
          std::optional<Field>(t.attribute(in, "", p, Demand::inside));
        },
        "attribute is Field attribute(const Inputs&, std::string_view, const Point&, Demand) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::passed)>; })
    static_assert(
        requires(const T& t, const Inputs& in, const Point& p) { Numbers4(t.passed(in, "", p)); },
        "passed is Numbers4 passed(const Inputs&, std::string_view output, const Point&) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::inner)>; })
    static_assert(
        requires(const T& t, const Point& p) { Point(t.inner(p)); }, "inner is Point inner(const Point&) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::reach)>; })
    static_assert(
        requires(const T& t, const Inputs& in, const Box& where) { Box(t.reach(in, where, 0.0)); },
        "reach is Box reach(const Inputs&, const Box& where, double margin) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::bounds)>; })
    static_assert(
        requires(const T& t, const Box& where) { Box(t.bounds(where)); },
        "bounds is Box bounds(const Box& where) const");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::metric)>; })
    static_assert(
        requires(const T& t, const Inputs& in) { Metric(t.metric(in)); } ||
            requires(const T& t) { Metric(t.metric()); },
        "metric is Metric metric(const Inputs&) const, or takes nothing");
  if constexpr (requires { requires std::is_member_function_pointer_v<decltype(&T::traits)>; })
    static_assert(
        requires(const T& t) { Traits(t.traits()); }, "traits is Traits traits() const");
  return true;
}

template <class T>
class NodeTypeOf final : public NodeType {
  static_assert(has_right_methods<T>());

 public:
  explicit NodeTypeOf(std::string_view category_) : spec_(T::spec()) {
    name = spec_.name;
    category = category_;
    sentence = spec_.sentence;
    example = spec_.example;
    inputs = spec_.inputs;
    for (const OutputSpec<T>& output : spec_.outputs) outputs.push_back(output.info);
    gives_solid = outputs.empty() || inputs.most > 0 || !NodeOf<T>::passes_on;
    is_nothing = requires { T::is_nothing_itself; };
    ASSERT((inputs.most > 0 || !is_solid() || !NodeOf<T>::passes_on) && "a solid without inputs has a distance");
    const T defaults{};
    for (const Parameter<T>& parameter : spec_.parameters)
      parameters.push_back({std::string(parameter.name), std::string(parameter.doc), parameter.text, parameter.domain,
                            parameter.domain.required ? Data() : parameter.get(defaults, false),
                            parameter.takes_other_names});
  }

  std::shared_ptr<Node> create() const override { return std::make_shared<NodeOf<T>>(*this); }

  bool set(Node& node, size_t parameter, const Data& data, const Reader& reader) const override {
    return spec_.parameters[parameter].set(struct_of(node), data, reader);
  }

  Data get(const Node& node, size_t parameter, bool for_hash) const override {
    Data data = spec_.parameters[parameter].get(static_cast<const NodeOf<T>&>(node).data, for_hash);
    return node.values().empty() ? data : with_held_nodes(data, node.values());
  }

  bool makes_nothing(const Node& node) const override {
    if constexpr (requires(const T& t) { t.makes_nothing(); })
      return static_cast<const NodeOf<T>&>(node).data.makes_nothing();
    else
      return false;
  }

  bool complete(Node& node, const Reader& reader, const std::vector<NodePtr>& children) const override {
    T& data = struct_of(node);
    for (const Parameter<T>& parameter : spec_.parameters)
      if (parameter.fill) parameter.fill(data, reader);
    if constexpr (requires { data.complete(reader, children); })
      return data.complete(reader, children);
    else if constexpr (requires { data.complete(reader); })
      return data.complete(reader);
    else
      return true;
  }

  NodePtr with_inputs(const Node& node, std::vector<NodePtr> others) const override {
    const auto copy = std::make_shared<NodeOf<T>>(*this);
    copy->data = static_cast<const NodeOf<T>&>(node).data;
    copy->finish(std::move(others), {node.values().begin(), node.values().end()}, node.where());
    return copy;
  }

  const OutputSpec<T>& output_spec(size_t output) const { return spec_.outputs[output]; }

  bool uses_cell(const T& data) const {
    return std::ranges::any_of(spec_.parameters,
                               [&](const Parameter<T>& one) { return one.uses_cell && one.uses_cell(data); });
  }

  bool has_constant_numbers(const T& data) const {
    for (const Parameter<T>& parameter : spec_.parameters)
      if (parameter.is_constant && !parameter.is_constant(data)) return false;
    return true;
  }

 private:
  static T& struct_of(Node& node) { return static_cast<NodeOf<T>&>(node).data; }

  Spec<T> spec_;
};

template <class... Nodes>
void Registry::add(std::string_view category) {
  (add_type(std::make_unique<NodeTypeOf<Nodes>>(category)), ...);
}

}  // namespace ombre::design
