#include "base/pitch.h"

#include <cmath>
#include <numeric>

#include "base/text.h"

namespace ombre {
namespace {

constexpr int64_t largest = int64_t{1} << 52;  // both terms stay exact as doubles

struct Ratio {
  int64_t numerator, denominator;
};

// A decimal without exponent: "0.027" -> 27/1000.
std::optional<Ratio> decimal(std::string_view text) {
  Ratio ratio{0, 1};
  bool seen_point = false, seen_digit = false;
  for (const char c : text) {
    if (c == '.' && !seen_point) {
      seen_point = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    seen_digit = true;
    if (ratio.numerator > (largest - 9) / 10 || ratio.denominator > largest / 10) return std::nullopt;
    ratio.numerator = ratio.numerator * 10 + (c - '0');
    if (seen_point) ratio.denominator *= 10;
  }
  if (!seen_digit) return std::nullopt;
  const int64_t common = std::gcd(ratio.numerator, ratio.denominator);
  return Ratio{ratio.numerator / common, ratio.denominator / common};
}

std::optional<Pitch> quotient(Ratio a, Ratio b) {
  // a.n/a.d : b.n/b.d, with the common factors taken out first so that the products stay small.
  if (a.numerator == 0 || b.numerator == 0) return std::nullopt;
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
  std::string text = format_number(mm);
  const size_t exponent = text.find('e');
  if (exponent == std::string::npos) return parse(text);
  // 5e-05: shift the point by hand.
  const auto digits = decimal(std::string_view(text).substr(0, exponent));
  const auto power = parse_number(std::string_view(text).substr(exponent + 1));
  if (!digits || !power || std::abs(*power) > 15) return std::nullopt;
  int64_t shift = 1;
  for (int i = 0; i < std::abs(static_cast<int>(*power)); ++i) shift *= 10;
  return *power < 0 ? quotient(*digits, {shift, 1}) : quotient(*digits, {1, shift});
}

std::string Pitch::text() const {
  std::string decimal_text = format_number(mm());
  if (decimal_text.size() <= 8 && parse(decimal_text) == *this) return decimal_text;
  return std::to_string(numerator) + '/' + std::to_string(denominator);
}

}  // namespace ombre
