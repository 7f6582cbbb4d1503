// Reads calibrations.
#include <algorithm>
#include <cmath>

#include "base/math/math.h"
#include "base/text/json.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "calibration/calibration.h"

namespace ombre::calibration {
namespace {

constexpr size_t most_inputs = 3;

std::optional<std::vector<std::string>> read_texts(const Data& data, const std::string& name,
                                                   const MemberReader& reader) {
  const DataList one{data};
  const DataList* const items = data.string() ? &one : reader.list(data, name);
  if (!items) return std::nullopt;
  std::vector<std::string> texts;
  for (const Data& item : *items)
    if (auto text = reader.text(item, name)) texts.push_back(std::move(*text));
  if (texts.size() == items->size() && !texts.empty()) return texts;
  if (items->empty()) reader.fail_expected(data, "a name or several for \"" + name + '"');
  return std::nullopt;
}

template <class T>
ombre::Field<T> texts(const std::string& name, std::vector<std::string> T::*member) {
  return field::value(name, member,
                      [=](const Data& data, const MemberReader& reader) { return read_texts(data, name, reader); });
}

template <class T>
ombre::Field<T> number_list(const std::string& name, std::vector<double> T::*member) {
  return field::value(name, member,
                      [=](const Data& data, const MemberReader& reader) -> std::optional<std::vector<double>> {
                        const DataList* const items = reader.list(data, name);
                        if (!items) return std::nullopt;
                        return reader.numbers(data, name, items->size(), "numbers in square brackets");
                      });
}

// Reads the name of an attribute that is a number.
std::optional<std::string> read_attribute(const Data& data, const std::string& member, const MemberReader& reader) {
  const auto name = reader.text(data, member);
  if (!name || (name->find('.') == std::string::npos && *name != fractions)) return name;
  reader.fail(data, '"' + *name + "\" is not the name of an attribute", "write for example \"modulus\"");
  return std::nullopt;
}

std::optional<Interval> read_valid(const Data& data, const MemberReader& reader) {
  const auto ends = reader.numbers(data, "valid", 2, "[least, most]");
  if (!ends) return std::nullopt;
  if ((*ends)[0] < (*ends)[1]) return Interval((*ends)[0], (*ends)[1]);
  reader.fail(data, "\"valid\" begins where it ends, or behind", "write [least, most]");
  return std::nullopt;
}

const Record<Input>& input_record() {
  using I = Input;
  static const Record<I> record =
      Record<I>(
          "an input",
          {field::value("attribute", &I::attribute,
                        [](const Data& data, const MemberReader& r) { return read_attribute(data, "attribute", r); })
               .means("an attribute, such as `\"temperature\"`"),
           texts("fraction", &I::materials)
               .means("a material whose volume fraction counts, or a list of such: the first that the materials file "
                      "has"),
           field::text("unit", &I::unit).means("the attribute's unit"),
           field::number("usual", &I::usual).means("its value where a design gives none"),
           field::value("valid", &I::valid, read_valid)
               .means("`[least, most]` (default: the range of the points; of a law `[0, 1]`)")})
          .one_of({"attribute", "fraction"}, R"(write "attribute": "temperature" or "fraction": "VeroClear")")
          .checked([](I& input, const Data& data, const MemberReader& reader) {
            if (input.is_fraction() && input.valid && (input.valid->lo < 0 || input.valid->hi > 1))
              reader.fail(*data.find("valid"), "fractions go from 0 to 1");
          });
  return record;
}

const Record<Measurement>& point_record() {
  using M = Measurement;
  static const Record<M> record(
      "a point", {number_list("inputs", &M::inputs).required().means("a number for each input"),
                  field::number("value", &M::value).required().means("the mean of the property"),
                  field::number("sd", &M::sd, {0}).means("standard deviation; all points have one, or none has"),
                  field::whole("n", &M::count, 1, 1e6).means("number of specimens (default 1)")});
  return record;
}

const Record<Constants>& constant_record() {
  using C = Constants;
  static const Record<C> record(
      "\"constants\"",
      {number_list("values", &C::values)
           .means("of laws of fractions: the property of the rest alone, then that of each input's material alone"),
       field::number("poissons_ratio", &C::poissons_ratio, {0, 0.5}).means("of the matrix, for `kerner` (default 0)"),
       field::number("threshold", &C::threshold, {0, 0.99})
           .means("fraction at which `percolation` begins (default 0); below it the value is that of the rest"),
       field::number("exponent", &C::exponent, {0, 10, false, true}).means("power of `percolation` (default 2)"),
       field::number("penetration", &C::penetration, above_zero)
           .means("of `working-curve`: the depth at which light has fallen to 1/e (Dp), in the unit of the property"),
       field::number("critical", &C::critical, above_zero)
           .means("of `working-curve`: the dose at which the resin gels (Ec), in the unit of the input")});
  return record;
}

// Checks the members of a calibration against each other.
class Checker {
 public:
  Checker(Calibration& calibration, const Data& data, const MemberReader& reader)
      : c_(calibration), data_(data), reader_(reader) {}

  void run() {
    if (c_.inputs.empty() || c_.inputs.size() > most_inputs)
      return fail("inputs", "a calibration has one to three inputs, not " + std::to_string(c_.inputs.size()));
    check_materials();
    has_points(c_.interpolant) ? check_points() : check_law();
    check_usual();
  }

 private:
  std::string interpolant() const { return '"' + interpolant_names()[static_cast<size_t>(c_.interpolant)] + '"'; }
  void fail(const char* member, const std::string& message, const Phrase& hint = {}) {
    const Data* const at = data_.find(member);
    reader_.fail(at ? *at : data_, message, hint);
  }
  bool is_sound() const { return reader_.error_count() == errors_; }

  void check_materials() {
    const bool has_fraction = std::ranges::any_of(c_.inputs, &Input::is_fraction);
    if (has_fraction && c_.rest.empty())
      fail("rest", "fractions need \"rest\", the material that takes what they leave",
           R"(write for example "rest": "Agilus30Clr")");
    if (!has_fraction && !c_.rest.empty()) fail("rest", "\"rest\" needs an input that is a fraction");
  }

  void check_points() {
    if (data_.find("constants")) fail("constants", interpolant() + " has points instead of constants");
    for (const char* spread : {"sd", "relative_sd"})
      if (data_.find(spread))
        fail(spread, std::string("points have an \"sd\" of their own, so \"") + spread + "\" is for laws");
    if (c_.points.empty())
      return fail("points", interpolant() + " needs points", R"(write "points": [{"inputs": [0], "value": 1}, ...])");
    if (c_.interpolant == Interpolant::pchip && c_.inputs.size() > 1)
      return fail("interpolant", "\"pchip\" has one input, not " + std::to_string(c_.inputs.size()),
                  R"(write "linear" or "log-linear")");
    for (const Measurement& point : c_.points) check_point(point);
    if (is_sound()) make_grids();
    if (is_sound()) limit_to_points();
  }

  void check_point(const Measurement& point) {
    const Data place(DataList{}, point.where);
    if (point.inputs.size() != c_.inputs.size())
      return reader_.fail(place, "this point has " + std::to_string(point.inputs.size()) +
                                     " inputs, and the calibration " + std::to_string(c_.inputs.size()));
    if (c_.interpolant == Interpolant::log_linear && !(point.value > 0))
      reader_.fail(place, "\"log-linear\" needs values above 0, not " + format_number(point.value));
    if (point.sd.has_value() != c_.points.front().sd.has_value())
      reader_.fail(place, "some points have an \"sd\", and some have none", "give all of them one, or none");
    for (size_t n = 0; n < point.inputs.size(); ++n) {
      if (!c_.inputs[n].is_fraction()) continue;
      if (point.inputs[n] < 0 || point.inputs[n] > 1)
        reader_.fail(place, "fractions go from 0 to 1, not to " + format_number(point.inputs[n]));
    }
  }

  // Sorts the points into a grid.
  void make_grids() {
    std::vector<std::vector<double>> axes(c_.inputs.size());
    size_t combinations = 1;
    for (size_t n = 0; n < axes.size(); ++n) {
      for (const Measurement& point : c_.points) axes[n].push_back(point.inputs[n]);
      std::ranges::sort(axes[n]);
      axes[n].erase(std::unique(axes[n].begin(), axes[n].end()), axes[n].end());
      if (axes[n].size() < 2)
        return fail("points", "all points have the same number for " + c_.inputs[n].text(),
                    "leave the input out, or give points at two numbers at least");
      combinations = combinations > c_.points.size() ? combinations : combinations * axes[n].size();
    }
    std::vector<double> values(c_.points.size()), spreads(c_.points.size());
    std::vector<bool> is_known(c_.points.size(), false);
    for (const Measurement& point : c_.points) {
      size_t at = 0;
      for (size_t n = 0; n < axes.size(); ++n)
        at = at * axes[n].size() +
             static_cast<size_t>(std::ranges::lower_bound(axes[n], point.inputs[n]) - axes[n].begin());
      const Data place(DataList{}, point.where);
      if (at < is_known.size() && is_known[at])
        return reader_.fail(place, "two points have these inputs", "give their mean, with \"n\" and \"sd\"");
      if (at >= is_known.size()) break;
      is_known[at] = true;
      values[at] = c_.interpolant == Interpolant::log_linear ? math::log(point.value) : point.value;
      spreads[at] = point.sd.value_or(0);
    }
    if (combinations != c_.points.size())
      return fail("points",
                  "the points have gaps: there are " + std::to_string(c_.points.size()) +
                      ", which are not all combinations of their inputs",
                  "give a point for each combination");
    c_.grid = Grid(axes, std::move(values));
    if (c_.points.front().sd) c_.spreads = Grid(std::move(axes), std::move(spreads));
  }

  void limit_to_points() {
    for (size_t n = 0; n < c_.inputs.size(); ++n) {
      const Interval known(c_.grid.axes()[n].front(), c_.grid.axes()[n].back());
      std::optional<Interval>& valid = c_.inputs[n].valid;
      if (!valid) valid = known;
      if (valid->lo < known.lo || valid->hi > known.hi)
        fail("inputs",
             "the points of " + c_.inputs[n].text() + " go from " + format_number(known.lo) + " to " +
                 format_number(known.hi) + ", and \"valid\" goes beyond them",
             "nothing is known there: shorten \"valid\", or measure");
    }
  }

  void check_law() {
    const Interpolant law = c_.interpolant;
    if (!data_.find("constants"))
      return fail("interpolant", "the law " + interpolant() + " needs \"constants\"",
                  R"(write for example "constants": {"values": [1, 2000]})");
    if (c_.sd && c_.relative_sd) fail("sd", "\"sd\" and \"relative_sd\" exclude each other");
    if (law == Interpolant::working_curve) return check_working_curve();
    if (!std::ranges::all_of(c_.inputs, &Input::is_fraction))
      return fail("inputs", "the inputs of the law " + interpolant() + " are fractions");
    const bool takes_one = law == Interpolant::kerner || law == Interpolant::percolation;
    if (takes_one && c_.inputs.size() > 1)
      return fail("inputs", "the law " + interpolant() + " has one input, not " + std::to_string(c_.inputs.size()));
    if (!data_.find("constants")->find("values"))
      return fail("constants", "\"constants\" needs \"values\"",
                  "give the value of the rest alone, then that of each input's material alone");
    if (c_.constants.values.size() != c_.inputs.size() + 1)
      return fail("constants",
                  "\"values\" has " + std::to_string(c_.constants.values.size()) + " numbers for " +
                      std::to_string(c_.inputs.size() + 1) + " materials",
                  "give the value of the rest alone, then that of each input's material alone");
    const bool needs_above_zero = law == Interpolant::kerner || law == Interpolant::log_mixture;
    for (const double value : c_.constants.values)
      if (needs_above_zero && !(value > 0))
        fail("constants", interpolant() + " needs values above 0, not " + format_number(value));
    for (Input& input : c_.inputs)
      if (!input.valid) input.valid = Interval(0, 1);
    if (law == Interpolant::percolation && c_.constants.threshold >= c_.inputs[0].valid->hi)
      fail("constants", "the threshold is not below what is valid");
  }

  void check_working_curve() {
    if (c_.inputs.size() != 1 || c_.inputs[0].is_fraction())
      return fail("inputs", "the input of a working curve is a dose",
                  R"(write {"attribute": "dose", "unit": "mJ/cm2"})");
    if (c_.constants.penetration == 0 || c_.constants.critical == 0)
      return fail("constants", "a working curve needs the \"penetration\" depth and the \"critical\" dose",
                  R"(write for example {"penetration": 0.1, "critical": 8})");
    const std::optional<Interval>& valid = c_.inputs[0].valid;
    if (!valid)
      return fail("inputs", "a working curve needs the doses for which it is \"valid\"",
                  "give the least and the greatest dose that was measured");
    if (valid->lo < c_.constants.critical)
      fail("inputs", "below the critical dose, " + format_number(c_.constants.critical) + ", nothing is cured",
           "let \"valid\" begin there");
  }

  void check_usual() {
    for (const Input& input : c_.inputs)
      if (input.usual && input.valid && !input.valid->contains(*input.usual))
        fail("inputs", "the usual value of " + input.text() + ", " + format_number(*input.usual) + ", is not valid");
  }

  Calibration& c_;
  const Data& data_;
  const MemberReader& reader_;
  size_t errors_ = reader_.error_count();
};

// Rows that say what a calibration is and where it comes from, around those of its numbers.
std::vector<ombre::Field<Calibration>> with_origin(std::vector<ombre::Field<Calibration>> numbers) {
  using C = Calibration;
  std::vector<ombre::Field<C>> rows{field::plain_name("a calibration", &C::name),
                                    field::text("title", &C::title).required().means("what it says")};
  rows.insert(rows.end(), numbers.begin(), numbers.end());
  const std::vector<ombre::Field<C>> origin{
      field::text("method", &C::method).means("how it was measured or made"),
      field::flag("illustrative", &C::is_illustrative)
          .means("`true` where it interpolates between few points, or others' machines: reports say so"),
      field::text("printer", &C::printer).means("the machine"),
      texts("lots", &C::lots).means("lots of the materials"),
      field::text("date", &C::date).means("when it was measured or published"),
      field::text("citation", &C::citation).required().means("where the numbers come from"),
      field::text("licence", &C::licence).required().means("who may use them")};
  rows.insert(rows.end(), origin.begin(), origin.end());
  return rows;
}

const Record<Calibration>& calibration_record() {
  using C = Calibration;
  static const Record<C> record =
      Record<C>(
          "a calibration",
          with_origin(
              {field::value("property", &C::property,
                            [](const Data& data, const MemberReader& r) { return read_attribute(data, "property", r); })
                   .required()
                   .means("the attribute that it gives, such as `\"modulus\"`"),
               field::text("unit", &C::unit).required().means("its unit; `\"1\"` for a plain number"),
               field::objects("inputs", &C::inputs, input_record())
                   .required()
                   .means("what it depends on, one to three"),
               texts("rest", &C::rest)
                   .means("with fractions: the material that takes what they leave, or a list of such"),
               field::choice("interpolant", &C::interpolant, interpolant_names())
                   .required()
                   .means("between points: `pchip` (monotone cubics, one input), `linear`, `log-linear` (linear in the "
                          "logarithm); or a law of fractions: `mixture`, `log-mixture`, `kerner` or `percolation`; or "
                          "`working-curve`, the depth that a "
                          "dose of light cures"),
               field::objects("points", &C::points, point_record())
                   .means("what was measured, at all combinations of the inputs' numbers; of a law, what it was fitted "
                          "to"),
               field::object("constants", &C::constants, constant_record()).means("the constants of a law"),
               field::number("sd", &C::sd, {0}).means("standard deviation of a law"),
               field::number("relative_sd", &C::relative_sd, {0})
                   .means("standard deviation of a law, as a share of the value")}))
          .checked([](C& calibration, const Data& data, const MemberReader& reader) {
            Checker(calibration, data, reader).run();
          });
  return record;
}

// Reads the inks, each with its material: {"C": "VeroCyan", ...}.
void read_channels(Calibration& calibration, const Data& data, const MemberReader& reader) {
  const DataMembers* const channels = reader.named(data, "\"channels\"");
  if (!channels) return;
  for (const auto& [channel, materials] : *channels) {
    auto names = read_texts(materials, channel, reader);
    if (!names) continue;
    calibration.inks->channels.push_back(channel);
    calibration.inputs.push_back({"", std::move(*names), "", std::nullopt, Interval(0, 1)});
  }
  if (channels->empty())
    reader.fail(data, "\"channels\" is empty", R"(write for example {"C": "VeroCyan", "M": "VeroMagenta", ...})");
}

// Profiles have the channels C, M, Y and K in this order.
void sort_letters(Calibration& calibration) {
  constexpr std::string_view order = "CMYK";
  std::vector<std::string>& channels = calibration.inks->channels;
  std::vector<std::string> letters = channels;
  std::ranges::sort(letters);
  if (letters != std::vector<std::string>{"C", "K", "M", "Y"}) return;
  std::vector<Input> inputs;
  for (const char letter : order)
    inputs.push_back(
        calibration
            .inputs[static_cast<size_t>(std::ranges::find(channels, std::string(1, letter)) - channels.begin())]);
  calibration.inputs = std::move(inputs);
  channels = {"C", "M", "Y", "K"};
}

const Record<Calibration>& ink_record() {
  using C = Calibration;
  using I = InkUse;
  const auto row = [](const ombre::Field<I>& inner) {
    return ombre::Field<C>(inner.name, [inner](C& calibration, const Data& data, const MemberReader& reader) {
      inner.read(*calibration.inks, data, reader);
    });
  };
  using R = ink::Rendering;
  static const Record<C> record =
      Record<C>(
          "a calibration of inks",
          with_origin(
              {row(field::text("profile", &I::profile))
                   .required()
                   .means("an ICC output profile; its path begins in this file's folder"),
               field::special<C>("channels", read_channels)
                   .required()
                   .means("the material of each ink of the profile, in its order: `{\"C\": \"VeroCyan\", ...}`; a "
                          "material may be a list, of which the first that the materials file has is taken"),
               texts("rest", &C::rest).required().means("the material that takes what the inks leave: white"),
               row(texts("clear", &I::clear)).means("the material that takes what the alpha of `color_rgba` leaves"),
               row(field::choice("intent", &R::intent, ink::intent_names()))
                   .means("what replaces colours that the inks do not show: `perceptual`, `relative` (the usual), "
                          "`saturation` or `absolute`"),
               row(field::flag("black_point", &R::black_point))
                   .means("`false`: black is not mapped to the darkest that the inks show")}))
          .checked([](C& calibration, const Data&, const MemberReader&) { sort_letters(calibration); });
  return record;
}

}  // namespace

const std::vector<MemberInfo>& ink_members() { return ink_record().members(); }
const std::vector<MemberInfo>& calibration_members() { return calibration_record().members(); }
const std::vector<MemberInfo>& input_members() { return input_record().members(); }
const std::vector<MemberInfo>& point_members() { return point_record().members(); }
const std::vector<MemberInfo>& constant_members() { return constant_record().members(); }

CalibrationPtr parse_calibration(const SourcePtr& source, Diagnostics& diagnostics) {
  const std::optional<Data> root = parse_json(source, diagnostics);
  auto calibration = std::make_shared<Calibration>();
  if (!root) return nullptr;
  const bool is_of_inks = root->find("profile") != nullptr;
  if (is_of_inks) {
    calibration->inks.emplace();
    calibration->property = colour_property;
    calibration->unit = "1";
  }
  const Record<Calibration>& record = is_of_inks ? ink_record() : calibration_record();
  if (!record.read(*root, *calibration, MemberReader(diagnostics))) return nullptr;
  return calibration;
}

}  // namespace ombre::calibration
