#include "base/math/pitch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text/text.h"

namespace ombre {
namespace {

constexpr int64_t largest = int64_t{1} << 52;  // terms up to here, and their sums, are exact as doubles
constexpr auto largest_term = static_cast<double>(largest);

struct Ratio {
  int64_t numerator, denominator;
};

// A decimal of at most this many digits is taken as typed by a person and exact. A longer one may be the rounded value
// of a ratio such as 25.4/300.
constexpr int most_digits_of_persons = 7;

// Computes the best rational approximations of a number, each closer than the one before, and returns the first that
// `will_do` accepts. Returns nothing if the terms become too large first.
template <class WillDo>
std::optional<Ratio> nearest_fraction(double value, const WillDo& will_do) {
  Ratio before{0, 1}, here{1, 0};
  double above = value, below = 1;
  while (below > 0) {
    const double rest = std::fmod(above, below), count = std::round((above - rest) / below);
    if (count * static_cast<double>(here.numerator) + static_cast<double>(before.numerator) > largest_term) break;
    if (count * static_cast<double>(here.denominator) + static_cast<double>(before.denominator) > largest_term) break;
    const auto whole = static_cast<int64_t>(count);
    const Ratio next{whole * here.numerator + before.numerator, whole * here.denominator + before.denominator};
    before = here;
    here = next;
    if (will_do(here)) return here;
    above = below;
    below = rest;
  }
  return std::nullopt;
}

double value_of(Ratio ratio) { return static_cast<double>(ratio.numerator) / static_cast<double>(ratio.denominator); }

// A decimal number as written: "0.027" is 27/1000.
struct Decimal {
  std::optional<Ratio> ratio;  // nothing if its terms are too large
  double value = 0;
  int digits = 0;       // digits from the first to the last that is not 0
  int last_places = 0;  // decimal exponent of the last digit that is not 0: -3 for 0.027
};

// Returns the simple ratio that differs from the number only by rounding, in a computation or in its last digit. Ratios
// with such small denominators are so sparse that only one number in a hundred is near one by chance.
std::optional<Ratio> simple_ratio(const Decimal& decimal) {
  constexpr double largest_denominator = 1e6, chance = 0.01;
  const double rounding = 4 * (std::nextafter(decimal.value, HUGE_VAL) - decimal.value);
  const double half_digit = parse_number("0.51e" + std::to_string(decimal.last_places)).value_or(0);
  const double room = std::max(rounding, half_digit);
  const auto ratio =
      nearest_fraction(decimal.value, [&](Ratio r) { return std::abs(value_of(r) - decimal.value) <= room; });
  if (!ratio) return std::nullopt;
  const auto denominator = static_cast<double>(ratio->denominator);
  const bool is_simple = denominator <= largest_denominator && denominator * denominator * room <= chance;
  return is_simple ? ratio : std::nullopt;
}

// Multiplies the ratio by 10^places. Returns false if its terms become too large.
bool shift(Ratio& ratio, int places) {
  for (; places != 0; places += places > 0 ? -1 : 1) {
    int64_t& term = places > 0 ? ratio.numerator : ratio.denominator;
    if (term > largest / 10) return false;
    term *= 10;
  }
  return true;
}

// Reads digits with an optional decimal point and an optional exponent.
std::optional<Decimal> read_decimal(std::string_view text) {
  const size_t e = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, e);
  if (mantissa.empty() || mantissa.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  const auto value = parse_number(text), power = parse_number(e == std::string_view::npos ? "0" : text.substr(e + 1));
  if (!value || !power || std::abs(*power) > 400) return std::nullopt;
  Decimal decimal{Ratio{0, 1}, *value};
  int places = static_cast<int>(*power), zeros = 0;
  bool behind_point = false;
  for (const char c : mantissa) {
    if (c == '.') {
      behind_point = true;
      continue;
    }
    places -= behind_point;
    zeros = c == '0' ? zeros + 1 : 0;
    if (decimal.digits > 0 || c != '0') ++decimal.digits;
    if (decimal.ratio && decimal.ratio->numerator > (largest - 9) / 10) decimal.ratio.reset();
    if (decimal.ratio) decimal.ratio->numerator = decimal.ratio->numerator * 10 + (c - '0');
  }
  decimal.digits -= std::min(zeros, decimal.digits);
  decimal.last_places = places + zeros;
  if (decimal.ratio && !shift(*decimal.ratio, places)) decimal.ratio.reset();
  return decimal;
}

std::optional<Ratio> decimal(std::string_view text) {
  const auto read = read_decimal(text);
  if (!read || !(read->value > 0)) return std::nullopt;
  if (read->digits > most_digits_of_persons || !read->ratio)
    if (const auto simple = simple_ratio(*read)) return simple;
  if (read->ratio) {
    const int64_t common = std::gcd(read->ratio->numerator, read->ratio->denominator);
    return Ratio{read->ratio->numerator / common, read->ratio->denominator / common};
  }
  return nearest_fraction(read->value, [&](Ratio r) { return value_of(r) == read->value; });
}

std::optional<Pitch> quotient(Ratio a, Ratio b) {
  // Computes (a.n/a.d) / (b.n/b.d). Common factors are divided out first so that the products stay small.
  const int64_t g = std::gcd(a.numerator, b.numerator), h = std::gcd(a.denominator, b.denominator);
  const int64_t n1 = a.numerator / g, n2 = b.denominator / h, d1 = a.denominator / h, d2 = b.numerator / g;
  if (n1 > largest / n2 || d1 > largest / d2) return std::nullopt;
  return Pitch::from_ratio(n1 * n2, d1 * d2);
}

}  // namespace

std::optional<Pitch> Pitch::from_ratio(int64_t numerator, int64_t denominator) {
  if (numerator <= 0 || denominator <= 0) return std::nullopt;
  const int64_t common = std::gcd(numerator, denominator);
  numerator /= common;
  denominator /= common;
  if (numerator > largest || denominator > largest) return std::nullopt;
  return Pitch{numerator, denominator};
}

std::optional<Pitch> Pitch::parse(std::string_view text) {
  text = trim(text);
  const size_t slash = text.find('/');
  const auto above = decimal(trim(text.substr(0, slash)));
  const auto below = slash == std::string_view::npos ? Ratio{1, 1} : decimal(trim(text.substr(slash + 1)));
  if (!above || !below) return std::nullopt;
  return quotient(*above, *below);
}

std::optional<Pitch> Pitch::from_dpi(std::string_view dots_per_inch) {
  const auto dpi = decimal(trim(dots_per_inch));
  if (!dpi) return std::nullopt;
  return quotient({127, 5}, *dpi);
}

std::optional<Pitch> Pitch::from_mm(double mm) {
  if (!std::isfinite(mm) || mm <= 0) return std::nullopt;
  return parse(format_number(mm));
}

std::string Pitch::text() const {
  std::string decimal_text = format_number(mm());
  if (decimal_text.size() <= 8 && parse(decimal_text) == *this) return decimal_text;
  return std::to_string(numerator) + '/' + std::to_string(denominator);
}

}  // namespace ombre
