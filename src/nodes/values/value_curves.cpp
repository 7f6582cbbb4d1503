// Values computed from numbers: ramps, rescaling, tables.
#include <cmath>

#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/field_math.h"
#include "nodes/common/number_table.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Ramp {
  Number of;
  double from = 0, to = 1;
  Choice shape = "linear";

  static Spec<Ramp> spec() {
    return {"ramp",
            "A ramp: 0 up to one number, 1 from another on, and a line or a smooth curve between them.",
            {{"of", &Ramp::of, "The number, such as \"z\" or a value", required()},
             {"lo", &Ramp::from, "Number where it begins to rise; if it is the greater one, the ramp falls"},
             {"hi", &Ramp::to, "Number where it ends"},
             {"shape", &Ramp::shape,
              "linear; smooth (3t^2 - 2t^3); smoother (6t^5 - 15t^4 + 10t^3); or step (1 from the middle on)",
              one_of({"linear", "smooth", "smoother", "step"})}},
            no_inputs,
            "cube(10, mix(\"red\", \"blue\", ramp(\"z\", -3, 3, \"smooth\")));",
            {{"value", &Ramp::value, "Number from 0 to 1", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) const {
    return from != to ||
           reader.refuse("ramp begins where it ends",
                         "write for example " + spelled::either("ramp(\"z\", 0, 10)", "\"lo\": 0, \"hi\": 10",
                                                                "ombre.ramp(\"z\", 0, 10)"));
  }

  Field value(const Ask& ask) const {
    const Field t = limited((of(ask.p) - from) / (to - from), 0, 1);
    if (shape == "step") return less_equal(ask.p.constant(0.5), t);
    if (shape == "smooth") return limited(smooth_step(t), 0, 1);
    if (shape == "smoother") return limited(t * t * t * (t * (t * 6.0 - 15) + 10), 0, 1);
    return t;
  }
};

struct Rescale {
  Number of;
  double from_lo = 0, from_hi = 1, to_lo = 0, to_hi = 1;
  bool clamped = false;

  static Spec<Rescale> spec() {
    return {"rescale",
            "Maps one range of numbers linearly to another.",
            {{"of", &Rescale::of, "The number", required()},
             {"from_lo", &Rescale::from_lo, "Number that is mapped to to_lo"},
             {"from_hi", &Rescale::from_hi, "Number that is mapped to to_hi"},
             {"to_lo", &Rescale::to_lo, "Result for from_lo"},
             {"to_hi", &Rescale::to_hi, "Result for from_hi"},
             {"clamp", &Rescale::clamped, "Keeps the result within to_lo and to_hi"}},
            no_inputs,
            "sphere(rescale(\"z\", -8, 8, 5, 8, clamp=true));",
            {{"value", &Rescale::value, "The mapped number"}}};
  }

  bool complete(const Reader& reader) const {
    return from_lo != from_hi ||
           reader.refuse("the range that rescale begins with is empty",
                         "write for example " + spelled::either("rescale(\"z\", 0, 10, 1, 2)",
                                                                "other numbers for the two ends of that range",
                                                                "ombre.rescale(\"z\", 0, 10, 1, 2)"));
  }

  Field value(const Ask& ask) const {
    Field share = (of(ask.p) - from_lo) / (from_hi - from_lo);
    if (clamped) share = limited(share, 0, 1);
    return share * (to_hi - to_lo) + to_lo;
  }
};

TableMode mode_called(const Choice& mode) {
  return mode == "step" ? TableMode::step : mode == "cubic" ? TableMode::cubic : TableMode::linear;
}

struct TableValue {
  NumberTable rows;
  Number a;
  SharedList<Number> more;
  Choice mode = "linear", outside = "clamp";
  double otherwise = 0;
  program::SourceField source;  // made with the node
  std::vector<Interval> keys;   // range of each input's keys
  size_t given = 1;             // number of outputs

  static Spec<TableValue> spec() {
    return {"table",
            "A table of values for one, two or three numbers. Its rows are keys followed by values.",
            {{"rows", &TableValue::rows,
              "Rows such as [[0, 1], [10, 5]], or the path of a CSV file. With one input, keys ascend; with several, "
              "there is a row for each combination",
              required()},
             {"a", &TableValue::a, "Number for the first column", required()},
             {"more", &TableValue::more, "One or two numbers for the next columns"},
             {"mode", &TableValue::mode,
              "Interpolation between keys: linear, step (the value of the key below), or cubic (smooth, and monotone "
              "where the values are; for one input)",
              one_of({"linear", "step", "cubic"})},
             {"outside", &TableValue::outside,
              "Value beyond the keys: clamp (that of the nearest key), value (that of otherwise), or error (not a "
              "number, with a warning of the job)",
              one_of({"clamp", "value", "error"})},
             {"otherwise", &TableValue::otherwise, "Value beyond the keys, with outside=\"value\""}},
            no_inputs,
            "cylinder(table([[-5, 2], [0, 4], [5, 3]], \"z\"), 10);",
            {{"value", &TableValue::value, "Value of the first column after the keys"},
             {"values", &TableValue::values, "Values of the first three columns after the keys; 0 for missing ones"}}};
  }

  bool complete(const Reader& reader) {
    if (more.size() > 2) return reader.refuse("a table has at most three inputs", "give more one or two numbers");
    const size_t inputs = 1 + more.size();
    if (mode == "cubic" && inputs > 1)
      return reader.refuse("cubic tables have one input",
                           "write " + spelled::parameter("mode", "\"linear\"") + " for several");
    const auto read = rows_of(reader);
    if (!read) return false;
    auto made = table_of(*read, inputs);
    if (const auto* problem = std::get_if<TableProblem>(&made)) return reader.refuse(problem->message, problem->hint);
    auto& table = std::get<TableKeys>(made);
    keys.clear();
    for (const auto& axis : table.axes) keys.emplace_back(axis.front(), axis.back());
    given = table.values.size();
    source = make_table(std::move(table), mode_called(mode));
    return true;
  }

  Field value(const Ask& ask) const { return column(ask, 0); }
  VectorField values(const Ask& ask) const {
    const auto at = [&](size_t n) { return n < given ? column(ask, n) : ask.p.constant(0); };
    return {at(0), at(1), at(2)};
  }

 private:
  std::optional<std::vector<std::vector<double>>> rows_of(const Reader& reader) {
    if (rows.file.path.empty()) return rows.rows;
    if (!reader.loader) {
      reader.refuse("tables in files cannot be read here", "write its rows out");
      return std::nullopt;
    }
    TableRequest request{rows.file};
    const auto loaded = reader.loader->source(request, reader);
    rows.file = request.file;
    return loaded ? std::optional(*loaded) : std::nullopt;
  }

  Field column(const Ask& ask, size_t output) const {
    const Point& p = ask.p;
    std::vector<Field> inputs{a(p)};
    for (const Number& number : more) inputs.push_back(number(p));
    Field within = p.constant(1);
    for (size_t n = 0; n < inputs.size(); ++n)
      within = logical_and(within, logical_and(less_equal(p.constant(keys[n].lo), inputs[n]),
                                               less_equal(inputs[n], p.constant(keys[n].hi))));
    const auto input = [&](size_t n) { return n < inputs.size() ? inputs[n] : p.constant(0); };
    const Field found = p.builder().source(source, static_cast<int>(output), input(0), input(1), input(2));
    if (outside == "clamp") return found;
    return select(within, found, p.constant(outside == "value" ? otherwise : std::nan("")));
  }
};

}  // namespace

void add_value_curves(Registry& registry) { registry.add<Ramp, Rescale, TableValue>("values"); }

}  // namespace ombre::nodes
