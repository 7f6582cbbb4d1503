// Types of the outputs of nodes. `OutputPort<R>` says all that is known of outputs whose method returns R; an output
// that does not vary in space may have any type of parameters (design/ports/port.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "design/lowered.h"
#include "design/outputs.h"
#include "design/ports/port.h"

namespace ombre::design {

// A colour that varies in space; its numbers are 0 to 1.
struct ColourField {
  Field r, g, b, a;
};

// A number of a list of names that varies in space.
struct LabelField {
  Field number;
};

// A part of space: 1 inside, else 0.
struct Region {
  Field inside;
};

// A solid that a node gives besides its values: its g, which is negative inside and whose size says nothing, and its
// composition if it has one.
struct OutputSolid {
  Field distance;
  std::optional<Composition> composition = {};
};

// The value of an output at a point. Which of the members are set depends on the output's form.
struct OutputAnswer {
  Numbers4 numbers{};                           // of a form `numbers`; of a solid or region, g is the first
  std::optional<Composition> composition = {};  // of a mixture, or of a solid that has one
};

// Returns the numbers that are set, followed by the fractions of the composition.
std::vector<Field> fields_of(const OutputAnswer& answer);

template <class R>
struct OutputPort;

template <>
struct OutputPort<Field> {
  static OutputType type() { return {"number", "", OutputForm::numbers, "Expression"}; }
  static OutputAnswer answer(const Field& field) { return {{field}}; }
};

template <>
struct OutputPort<VectorField> {
  static OutputType type() { return {"vector", "xyz", OutputForm::numbers, "Vector"}; }
  static OutputAnswer answer(const VectorField& v) { return {{v.x, v.y, v.z}}; }
};

template <>
struct OutputPort<ColourField> {
  static OutputType type() { return {"colour", "rgba", OutputForm::numbers, "tuple[Expression, ...]"}; }
  static OutputAnswer answer(const ColourField& c) { return {{c.r, c.g, c.b, c.a}}; }
};

// A map of space: the place to which a point goes.
template <>
struct OutputPort<Point> {
  static OutputType type() { return {"frame", "xyz", OutputForm::numbers, "Vector"}; }
  static OutputAnswer answer(const Point& p) { return {{p.x, p.y, p.z}}; }
};

template <>
struct OutputPort<LabelField> {
  static OutputType type() { return {"label", "", OutputForm::numbers, "Expression"}; }
  static OutputAnswer answer(const LabelField& label) { return {{label.number}}; }
};

template <>
struct OutputPort<Composition> {
  static OutputType type() { return {"mixture", "", OutputForm::mixture, "Value"}; }
  static OutputAnswer answer(Composition made) { return {{}, std::move(made)}; }
};

template <>
struct OutputPort<OutputSolid> {
  static OutputType type() { return {"solid", "", OutputForm::solid, "Solid"}; }
  static OutputAnswer answer(OutputSolid made) { return {{made.distance}, std::move(made.composition)}; }
};

template <>
struct OutputPort<Region> {
  static OutputType type() { return {"region", "", OutputForm::solid, "Solid"}; }
  static OutputAnswer answer(const Region& region) { return {{0.5 - region.inside}}; }
};

// True for the types of outputs that vary in space.
template <class R>
concept VariesInSpace = requires(const R& made) {
  OutputPort<R>::answer(made);
};

// A value that is known when the node is made.
template <IsPort M>
struct OutputPort<M> {
  static OutputType type() {
    const PortText text = Port<M>::text({});
    return {text.kind, "", OutputForm::constant, text.python};
  }
};

}  // namespace ombre::design
