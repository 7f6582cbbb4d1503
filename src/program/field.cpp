#include "program/field.h"

#include <algorithm>
#include <bit>

#include "base/system/assert.h"

namespace ombre::program {

Builder::Builder() { clear(); }

void Builder::clear() {
  constexpr size_t usual_size = 256;
  code_.clear();
  maps_.clear();
  reads_.clear();
  calls_.clear();
  part_sets_.clear();
  keys_.clear();
  table_.assign(std::min(std::max(table_.size(), usual_size), 4 * usual_size), 0);
  for (int axis = 0; axis < 3; ++axis) {
    Instruction in;
    in.op = Op::input;
    in.value = axis;
    push({}, in);
  }
}

size_t Builder::hash(const Key& key) {
  uint64_t h = key.bits * 0x9E3779B97F4A7C15ull + static_cast<uint64_t>(key.op);
  for (const uint64_t part :
       {uint64_t{key.a}, uint64_t{key.b}, uint64_t{key.c}, std::bit_cast<uint64_t>(key.pointer)}) {
    h = (h ^ part) * 0xD6E8FEB86659FD93ull;
    h ^= h >> 32;
  }
  return h;
}

void Builder::push(const Key& key, const Instruction& instruction) {
  code_.push_back(instruction);
  keys_.push_back(key);
}

Field Builder::intern(const Key& key, Instruction instruction) {
  const size_t mask = table_.size() - 1;
  size_t at = hash(key) & mask;
  for (; table_[at] != 0; at = (at + 1) & mask)
    if (keys_[table_[at]] == key) return {this, table_[at]};
  table_[at] = static_cast<ValueId>(code_.size());
  push(key, instruction);
  if (2 * code_.size() > table_.size()) widen_table();
  return {this, static_cast<ValueId>(code_.size() - 1)};
}

void Builder::widen_table() {
  std::vector<ValueId> wide(2 * table_.size(), 0);
  const size_t mask = wide.size() - 1;
  for (const ValueId id : table_) {
    if (id == 0) continue;
    size_t at = hash(keys_[id]) & mask;
    while (wide[at] != 0) at = (at + 1) & mask;
    wide[at] = id;
  }
  table_ = std::move(wide);
}

Field Builder::constant(double value) {
  if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();  // all NaNs become the same constant
  Instruction in;
  in.value = value;
  return intern({Op::constant, 0, 0, 0, std::bit_cast<uint64_t>(value), nullptr}, in);
}

std::optional<double> Builder::constant_value(Field field) const {
  const Instruction& in = code_[field.id];
  if (in.op != Op::constant) return std::nullopt;
  return in.value;
}

bool Builder::is_truth(Field field) const {
  const Instruction& in = code_[field.id];
  return gives_truth(in.op) || (in.op == Op::constant && (in.value == 0 || in.value == 1));
}

Field Builder::apply(Op op, Field a, Field b, Field c) {
  const int arity = info(op).arity;
  ASSERT(a.builder == this && (arity < 2 || b.builder == this) && (arity < 3 || c.builder == this));
  const auto va = constant_value(a);
  const auto vb = arity > 1 ? constant_value(b) : va;
  const auto vc = arity > 2 ? constant_value(c) : va;
  if (va && vb && vc) return constant(program::apply(op, *va, *vb, *vc));
  // Simplifications that hold for all values, including infinities and NaN.
  switch (op) {
    case Op::multiply:
    case Op::divide:
      if (vb == 1.0) return a;
      if (op == Op::multiply && va == 1.0) return b;
      break;
    case Op::subtract:
      if (vb == 0.0) return a;
      break;
    case Op::min:
    case Op::max:
      if (a == b) return a;
      break;
    case Op::truth:
      if (is_truth(a)) return a;
      break;
    case Op::logical_not:
      if (code_[a.id].op == Op::logical_not && is_truth({this, code_[a.id].a})) return {this, code_[a.id].a};
      break;
    case Op::logical_and:
      if ((va && *va == 0) || (vb && *vb == 0)) return constant(0);
      if (va && *va != 0) return apply(Op::truth, b);
      if (vb && *vb != 0) return apply(Op::truth, a);
      break;
    case Op::logical_or:
      if ((va && *va != 0) || (vb && *vb != 0)) return constant(1);
      if (va && *va == 0) return apply(Op::truth, b);
      if (vb && *vb == 0) return apply(Op::truth, a);
      break;
    case Op::select:
      if (va) return *va != 0 ? b : c;
      if (b == c) return b;
      if (vb == 1.0 && vc == 0.0 && is_truth(a)) return a;
      break;
    default:
      break;
  }
  Instruction in;
  in.op = op;
  in.a = a.id;
  in.b = arity > 1 ? b.id : 0;
  in.c = arity > 2 ? c.id : 0;
  return intern({op, in.a, in.b, in.c, 0, nullptr}, in);
}

namespace {

// Returns an instruction of three operands with an entry of a table.
Instruction with_entry(Op op, Field a, Field b, Field c, size_t entry) {
  Instruction in;
  in.op = op;
  in.a = a.id;
  in.b = b.id;
  in.c = c.id;
  in.aux = static_cast<uint32_t>(entry);
  return in;
}

}  // namespace

Field Builder::affine(const AffineRow& row, Field a, Field b, Field c) {
  // Rows with a single non-zero coefficient are common; translations produce them.
  const Field parts[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    if (row[i] == 0 || row[(i + 1) % 3] != 0 || row[(i + 2) % 3] != 0) continue;
    Field result = row[i] == 1    ? parts[i]
                   : row[i] == -1 ? apply(Op::negate, parts[i])
                                  : apply(Op::multiply, constant(row[i]), parts[i]);
    return row[3] == 0 ? result : apply(Op::add, result, constant(row[3]));
  }
  const Instruction in = with_entry(Op::affine, a, b, c, maps_.size());
  uint64_t bits = 1;
  for (const double m : row) bits = (bits ^ std::bit_cast<uint64_t>(m == 0 ? 0.0 : m)) * 0x9E3779B97F4A7C15ull;
  const Field field = intern({Op::affine, in.a, in.b, in.c, bits, nullptr}, in);
  if (code_[field.id].aux == maps_.size()) maps_.push_back(row);
  // The rows have the same hash but differ, so both are kept.
  if (maps_[code_[field.id].aux] != row) {
    push({}, in);
    maps_.push_back(row);
    return {this, static_cast<ValueId>(code_.size() - 1)};
  }
  return field;
}

Field Builder::source(const SourceField& source, int channel, Field a, Field b, Field c, uint32_t tag) {
  const Instruction in = with_entry(Op::source, a, b, c, reads_.size());
  const Field field = intern({Op::source, in.a, in.b, in.c, static_cast<uint64_t>(channel), source.get()}, in);
  if (code_[field.id].aux == reads_.size()) reads_.push_back({source, channel, tag});
  return field;
}

Field Builder::call(const std::shared_ptr<Program>& body, uint32_t output, Field a, Field b, Field c) {
  const Instruction in = with_entry(Op::call, a, b, c, calls_.size());
  const Field field = intern({Op::call, in.a, in.b, in.c, output, body.get()}, in);
  if (code_[field.id].aux == calls_.size()) calls_.push_back({body, output});
  return field;
}

Field Builder::parts(const std::shared_ptr<const PartSet>& set, size_t slot, Field a, Field b, Field c) {
  Instruction in = with_entry(Op::parts, a, b, c, part_sets_.size());
  in.value = static_cast<double>(slot);
  const Field field = intern({Op::parts, in.a, in.b, in.c, slot, set.get()}, in);
  if (code_[field.id].aux == part_sets_.size()) part_sets_.push_back(set);
  return field;
}

Program Builder::finish(const Outputs& outputs) const {
  Program program;
  finish(outputs, program);
  return program;
}

void Builder::finish(const Outputs& outputs, Program& program) const {
  program.code.clear();
  program.maps.clear();
  program.reads.clear();
  program.calls.clear();
  program.part_sets.clear();
  program.outputs.clear();
  program.output_names.clear();
  constexpr ValueId unneeded = ~ValueId{0};
  std::vector<ValueId> renamed(code_.size(), unneeded);
  for (const auto& [name, field] : outputs) renamed[field.id] = 0;
  size_t count = 0;
  for (size_t i = code_.size(); i-- > 0;) {
    if (renamed[i] == unneeded) continue;
    ++count;
    const int arity = info(code_[i].op).arity;
    if (arity > 0) renamed[code_[i].a] = 0;
    if (arity > 1) renamed[code_[i].b] = 0;
    if (arity > 2) renamed[code_[i].c] = 0;
  }
  program.code.reserve(count);
  for (size_t i = 0; i < code_.size(); ++i) {
    if (renamed[i] == unneeded) continue;
    Instruction in = code_[i];
    const int arity = info(in.op).arity;
    in.a = arity > 0 ? renamed[in.a] : 0;
    in.b = arity > 1 ? renamed[in.b] : 0;
    in.c = arity > 2 ? renamed[in.c] : 0;
    if (in.op == Op::affine) {
      program.maps.push_back(maps_[in.aux]);
      in.aux = static_cast<uint32_t>(program.maps.size() - 1);
    } else if (in.op == Op::source) {
      program.reads.push_back(reads_[in.aux]);
      in.aux = static_cast<uint32_t>(program.reads.size() - 1);
    } else if (in.op == Op::call) {
      program.calls.push_back(calls_[in.aux]);
      in.aux = static_cast<uint32_t>(program.calls.size() - 1);
    } else if (in.op == Op::parts) {
      program.part_sets.push_back(part_sets_[in.aux]);
      in.aux = static_cast<uint32_t>(program.part_sets.size() - 1);
    }
    renamed[i] = static_cast<ValueId>(program.code.size());
    program.code.push_back(in);
  }
  for (const auto& [name, field] : outputs) {
    program.outputs.push_back(renamed[field.id]);
    program.output_names.push_back(name);
  }
}

Field operator+(Field a, Field b) { return a.builder->apply(Op::add, a, b); }
Field operator-(Field a, Field b) { return a.builder->apply(Op::subtract, a, b); }
Field operator*(Field a, Field b) { return a.builder->apply(Op::multiply, a, b); }
Field operator/(Field a, Field b) { return a.builder->apply(Op::divide, a, b); }
Field operator-(Field a) { return a.builder->apply(Op::negate, a); }
Field operator+(Field a, double b) { return a + a.builder->constant(b); }
Field operator-(Field a, double b) { return a - a.builder->constant(b); }
Field operator*(Field a, double b) { return a * a.builder->constant(b); }
Field operator/(Field a, double b) { return a / a.builder->constant(b); }
Field operator-(double a, Field b) { return b.builder->constant(a) - b; }
Field operator*(double a, Field b) { return b.builder->constant(a) * b; }
Field min(Field a, Field b) { return a.builder->apply(Op::min, a, b); }
Field max(Field a, Field b) { return a.builder->apply(Op::max, a, b); }
Field max(Field a, double b) { return max(a, a.builder->constant(b)); }
Field abs(Field a) { return a.builder->apply(Op::abs, a); }
Field sqrt(Field a) { return a.builder->apply(Op::sqrt, a); }
Field square(Field a) { return a.builder->apply(Op::square, a); }
Field signed_square(Field a) { return a * abs(a); }
Field length(Field a, Field b) { return sqrt(square(a) + square(b)); }
Field length(Field a, Field b, Field c) { return sqrt(square(a) + square(b) + square(c)); }
Field operator<(Field a, double b) { return less(a, a.builder->constant(b)); }
Field operator<=(Field a, double b) { return less_equal(a, a.builder->constant(b)); }
Field less(Field a, Field b) { return a.builder->apply(Op::less, a, b); }
Field less_equal(Field a, Field b) { return a.builder->apply(Op::less_equal, a, b); }
Field ceil(Field a) { return a.builder->apply(Op::ceil, a); }
Field sin(Field a) { return a.builder->apply(Op::sin, a); }
Field cos(Field a) { return a.builder->apply(Op::cos, a); }
Field truth(Field a) { return a.builder->apply(Op::truth, a); }
Field logical_not(Field a) { return a.builder->apply(Op::logical_not, a); }
Field logical_and(Field a, Field b) { return a.builder->apply(Op::logical_and, a, b); }
Field logical_or(Field a, Field b) { return a.builder->apply(Op::logical_or, a, b); }
Field share(Field part, Field total) { return part.builder->apply(Op::share, part, total); }
Field select(Field condition, Field a, Field b) { return a.builder->apply(Op::select, condition, a, b); }
Field is_finite(Field a) { return a.builder->apply(Op::is_finite, a); }

Field power(Field base, Field exponent) {
  constexpr int most = 64;
  const auto n = base.builder->constant_value(exponent);
  if (!n || std::trunc(*n) != *n || std::abs(*n) > most || *n == 0) return base.builder->apply(Op::pow, base, exponent);
  // Uses repeated squaring: x^6 = (x^2)^2 * x^2.
  Field result, factor = base;
  for (int left = std::abs(static_cast<int>(*n)); left > 0; left >>= 1) {
    if (left & 1) result = result ? result * factor : factor;
    if (left > 1) factor = square(factor);
  }
  return *n > 0 ? result : base.builder->constant(1) / result;
}

Field fold(std::vector<Field> fields, Field (*combine)(Field, Field)) {
  ASSERT(!fields.empty());
  while (fields.size() > 1) {
    size_t half = 0;
    for (size_t i = 0; i < fields.size(); i += 2)
      fields[half++] = i + 1 < fields.size() ? combine(fields[i], fields[i + 1]) : fields[i];
    fields.resize(half);
  }
  return fields[0];
}

Field sum(std::vector<Field> fields) { return fold(std::move(fields), operator+); }

Point Point::origin_frame(Builder& builder) { return {builder.input(0), builder.input(1), builder.input(2), Affine{}}; }

Point::Point(Field bx, Field by, Field bz, const Affine& map)
    : base_x_(bx), base_y_(by), base_z_(bz), here_from_base_(map) {
  const auto row = [&](int i) {
    return bx.builder->affine({map.rows[i].x, map.rows[i].y, map.rows[i].z, map.offset[i]}, bx, by, bz);
  };
  x = row(0);
  y = row(1);
  z = row(2);
}

std::optional<Affine> Point::from_inputs() const {
  if (base_x_.id != 0 || base_y_.id != 1 || base_z_.id != 2) return std::nullopt;  // 0, 1, 2 are the inputs
  return here_from_base_;
}

Point Point::mapped(const Affine& map) const {
  Point point(base_x_, base_y_, base_z_, map * here_from_base_);
  point.cell = cell;
  point.within_ = within_ == Box::everything() ? within_ : image(map, within_);
  return point;
}

Point Point::moved_to(Field to_x, Field to_y, Field to_z) const {
  Point point = of(to_x, to_y, to_z);
  point.cell = cell;
  return point;
}

}  // namespace ombre::program
