// Small helpers for names and numbers in text.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ombre {

// The shortest decimal that reads back to the same double; "inf", "-inf", "nan".
std::string format_number(double value);
// For people: at most `digits` significant digits, no trailing zeros.
std::string format_rounded(double value, int digits = 4);
// 1234567 -> "1,234,567"
std::string format_count(unsigned long long count);
// "1.5 GiB"
std::string format_bytes(double bytes);
// The whole text must be one finite decimal number.
std::optional<double> parse_number(std::string_view text);

// Lower case, without '-' and '_': F-grade, f_grade and fgrade are one name.
std::string fold_name(std::string_view name);
std::string to_lower(std::string_view text);

// The closest candidate that a typing slip could have turned into `name`.
std::optional<std::string> closest_name(std::string_view name, std::span<const std::string> candidates);
// `did you mean "ring"?`, or nothing when no candidate is close.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

std::string join(std::span<const std::string> parts, std::string_view separator);
// Returns "rgba, gray or mask" for a choice of words.
std::string words_text(std::span<const std::string> words);
std::vector<std::string> split(std::string_view text, char separator);
std::string_view trim(std::string_view text);

}  // namespace ombre
