#include "lang/openscad/value_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/text/text.h"
#include "lang/engine/scope.h"

namespace ombre::lang::openscad {
namespace {

// The parts of a number such as "1.23457e-05": digits without the decimal point, and the exponent of the first digit.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

// Rounds to six digits, ties away from zero: 123456.5 is 123457.
Decimal six_digits(double number) {
  std::array<char, 64> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.24e", number);
  const std::string text = buffer.data();
  const size_t e = text.find('e');
  constexpr size_t kept = 6;
  Decimal result{text.substr(0, 1) + text.substr(2, e - 2), std::atoi(text.c_str() + e + 1)};
  const bool is_rounded_up = result.digits[kept] >= '5';
  result.digits.resize(kept);
  if (is_rounded_up) {
    size_t at = kept;
    while (at > 0 && result.digits[at - 1] == '9') result.digits[--at] = '0';
    if (at > 0) {
      ++result.digits[at - 1];
    } else {
      result.digits = "1";
      ++result.exponent;
    }
  }
  while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back();
  return result;
}

std::string positive_text(double number) {
  constexpr int least = -5, most = 5;  // exponents for which numbers are written in decimal
  const auto [digits, exponent] = six_digits(number);
  if (exponent > most || exponent < least) {
    const std::string mantissa = digits.size() > 1 ? digits.substr(0, 1) + '.' + digits.substr(1) : digits;
    return mantissa + (exponent < 0 ? "e-" : "e+") + std::to_string(std::abs(exponent));
  }
  if (exponent < 0) return "0." + std::string(static_cast<size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<size_t>(exponent) + 1;
  if (digits.size() <= whole) return digits + std::string(whole - digits.size(), '0');
  return digits.substr(0, whole) + '.' + digits.substr(whole);
}

}  // namespace

std::string number_text(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  if (number == 0) return "0";
  return (number < 0 ? "-" : "") + positive_text(std::abs(number));
}

std::string stream_text(double number) {
  if (number == 0) return "0";
  if (std::isnan(number)) return "nan";
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%g", number);
  return buffer.data();
}

std::string literal_of(double number) {
  if (std::isnan(number)) return "(0/0)";
  if (std::isinf(number)) return number > 0 ? "(1/0)" : "(-1/0)";
  return format_number(number);
}

std::string literal_of(const std::string& text) {
  std::string literal = "\"";
  for (const char c : text) {
    if (c == '\n')
      literal += "\\n";
    else if (c == '\t')
      literal += "\\t";
    else if (c == '\r')
      literal += "\\r";
    else if (c == '"' || c == '\\')
      literal += std::string("\\") + c;
    else
      literal += c;
  }
  return literal + '"';
}

void append_value(std::string& text, const Value& value, bool quoted, Meter& meter) {
  const auto function = [](const Closure& closure) { return expression_text(*closure.function); };
  append_text(text, value, quoted, meter, {number_text, function});
}

std::string value_text(const Value& value, bool quoted, Meter& meter) {
  std::string text;
  append_value(text, value, quoted, meter);
  return text;
}

const char* type_name(const Value& value) {
  if (value.boolean()) return "bool";
  if (value.number()) return "number";
  if (value.text()) return "string";
  if (value.list()) return "vector";
  if (value.range()) return "range";
  if (value.closure()) return "function";
  if (value.record()) return "object";
  if (value.object()) return "value in space";
  return "undefined";
}

}  // namespace ombre::lang::openscad
