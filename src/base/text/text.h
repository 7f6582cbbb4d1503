// Helpers for names and numbers in text.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ombre {

// Returns the shortest decimal that reads back to the same double, or "inf", "-inf", "nan".
std::string format_number(double value);
// Rounds to at most `digits` significant digits, without trailing zeros, for people to read.
std::string format_rounded(double value, int digits = 4);
// Returns for example "1,234,567".
std::string format_count(unsigned long long count);
// Returns for example "1.5 GiB".
std::string format_bytes(double bytes);
// Returns nothing unless the whole text is one finite decimal number.
std::optional<double> parse_number(std::string_view text);

// Converts to lower case and removes '-' and '_', so that F-grade, f_grade and fgrade are the same name.
std::string fold_name(std::string_view name);
std::string to_lower(std::string_view text);

// Returns the candidate that is closest to `name` if a typing error could have caused the difference.
std::optional<std::string> closest_name(std::string_view name, std::span<const std::string> candidates);
// Returns `did you mean "ring"?`, or an empty text if no candidate is close.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

std::string join(std::span<const std::string> parts, std::string_view separator);
// Returns "rgba, gray or mask" for a choice of words.
std::string words_text(std::span<const std::string> words);
std::vector<std::string> split(std::string_view text, char separator);
std::string_view trim(std::string_view text);

}  // namespace ombre
