// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/number_literal.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace shearfront::detail {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Digits with single underscores between them; their count without underscores is appended to `digits`.
bool take_digits(std::string_view& text, std::string& digits) {
  if (text.empty() || !is_digit(text[0])) return false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    if (is_digit(text[i])) {
      digits += text[i];
    } else if (text[i] != '_' || i + 1 == text.size() || !is_digit(text[i + 1])) {
      break;
    }
  }
  text.remove_prefix(i);
  return true;
}

long long exponent_value(std::string_view digits, bool negative) {
  constexpr long long kHuge = 1'000'000'000'000;  // far beyond any scalar, far from overflow
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  long long value = digits.empty() ? 0 : kHuge;
  if (!digits.empty() && digits.size() <= 12)
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return negative ? -value : value;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Follows just enough of TOML's syntax to know where a value starts.
class ValueScanner {
 public:
  explicit ValueScanner(std::string_view toml) : text_(toml), result_(toml) {}

  std::string run() {
    while (i_ < text_.size()) step(text_[i_]);
    return std::move(result_);
  }

 private:
  void step(char c) {
    const bool is_table_header = c == '[' && !expects_value_ && open_.empty();
    if (c == '#' || is_table_header) {
      i_ = std::min(text_.find('\n', i_), text_.size());
    } else if (c == '"' || c == '\'') {
      skip_string(c);
      expects_value_ = false;
    } else if (c == '[' || c == '{') {
      open_ += c;
      expects_value_ = c == '[';
      ++i_;
    } else if (c == ']' || c == '}') {
      if (!open_.empty()) open_.pop_back();
      expects_value_ = false;
      ++i_;
    } else if (c == ',' || c == '=') {
      expects_value_ = c == '=' || (!open_.empty() && open_.back() == '[');
      ++i_;
    } else if (c == '\n') {
      if (open_.empty()) expects_value_ = false;
      ++i_;
    } else if (is_blank(c)) {
      ++i_;
    } else {
      bare_word();
    }
  }

  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(i_, 3) == three;
    const std::string_view end = is_long ? std::string_view(three) : std::string_view(three).substr(0, 1);
    i_ += end.size();
    while (i_ < text_.size() && text_.substr(i_, end.size()) != end) {
      if (!is_long && text_[i_] == '\n') return;  // unterminated: the parser will say so
      i_ += quote == '"' && text_[i_] == '\\' ? 2 : 1;
    }
    i_ = std::min(i_ + end.size(), text_.size());
  }

  void bare_word() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n,]}[{=#\"'", i_), text_.size());
    const std::string_view word = text_.substr(i_, end - i_);
    if (const auto number = expects_value_ ? parse_decimal(word) : std::nullopt) {
      const bool is_integer = word.find_first_of(".eE") == std::string_view::npos;
      constexpr std::size_t kLongestWord = 100;  // toml++ keeps at most 126 characters of a number
      if (word.size() > kLongestWord || (is_integer && number->exponent > 18) || !fits_double(*number)) {
        result_[i_] = '1';
        std::fill(result_.begin() + static_cast<std::ptrdiff_t>(i_) + 1,
                  result_.begin() + static_cast<std::ptrdiff_t>(end), ' ');
      }
    }
    expects_value_ = false;
    i_ = end;
  }

  std::string_view text_;
  std::string result_;
  std::string open_;  ///< brackets and braces around the place
  std::size_t i_ = 0;
  bool expects_value_ = false;
};

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view literal) {
  Decimal number;
  if (!literal.empty() && (literal[0] == '+' || literal[0] == '-')) {
    number.negative = literal[0] == '-';
    literal.remove_prefix(1);
  }
  std::string digits, exponent;
  if (!take_digits(literal, digits) || (digits.size() > 1 && digits[0] == '0')) return std::nullopt;
  number.exponent = static_cast<long long>(digits.size());
  if (literal.starts_with('.')) {
    literal.remove_prefix(1);
    if (!take_digits(literal, digits)) return std::nullopt;
  }
  if (literal.starts_with('e') || literal.starts_with('E')) {
    literal.remove_prefix(1);
    const bool negative = literal.starts_with('-');
    if (negative || literal.starts_with('+')) literal.remove_prefix(1);
    if (!take_digits(literal, exponent)) return std::nullopt;
    number.exponent += exponent_value(exponent, negative);
  }
  if (!literal.empty()) return std::nullopt;
  const std::size_t zeros = std::min(digits.find_first_not_of('0'), digits.size());
  number.exponent -= static_cast<long long>(zeros);
  number.significand = digits.substr(zeros, kMostDigits);
  number.significand.erase(number.significand.find_last_not_of('0') + 1);
  return number;
}

bool fits_double(const Decimal& number) {
  if (number.significand.empty()) return true;
  if (number.exponent > 310 || number.exponent < -330) return false;
  const std::string text = "0." + number.significand + "e" + std::to_string(number.exponent);
  const auto x = parse_number(text);
  return x && *x != 0;
}

std::string with_tame_numbers(std::string_view toml) { return ValueScanner(toml).run(); }

}  // namespace shearfront::detail
