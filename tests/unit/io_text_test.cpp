// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/text.hpp"

#include <gtest/gtest.h>

#include <clocale>

namespace shearfront {
namespace {

TEST(Text, NumbersFillTheWholeText) {
  EXPECT_EQ(parse_number("0.5"), 0.5);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number("-1e3"), -1000.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* bad :
       {"", " 1", "1 ", "1x", "0x10", "nan", "inf", "-inf", "1e400", "1,5", "+-1", "--1", "e5", "+"})
    EXPECT_FALSE(parse_number(bad)) << bad;
}

TEST(Text, NumbersDoNotDependOnTheLocale) {
  const char* old = std::setlocale(LC_ALL, nullptr);
  const std::string keep = old ? old : "C";
  if (std::setlocale(LC_ALL, "de_DE.UTF-8")) {
    EXPECT_EQ(parse_number("0.5"), 0.5);
  }
  std::setlocale(LC_ALL, keep.c_str());
  EXPECT_EQ(parse_number("0.5"), 0.5);
}

TEST(Text, CountsAreWholeAndNotNegative) {
  EXPECT_EQ(parse_count("0"), 0U);
  EXPECT_EQ(parse_count("1e6"), 1000000U);
  EXPECT_EQ(parse_count("9007199254740993"), 9007199254740993U);
  for (const char* bad : {"", "-1", "1.5", "1e30", "ten"}) EXPECT_FALSE(parse_count(bad)) << bad;
}

TEST(Text, NothingReachesTheTerminalUnescaped) {
  EXPECT_EQ(printable("a\nb\t\x1b[31m\x7f"), "a\\nb\\t\\x1b[31m\\x7f");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\u202egpj.exe\ufeff"), "\\u202egpj.exe\\ufeff");
  EXPECT_EQ(printable("Grüße, 粒"), "Grüße, 粒");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate is not UTF-8";
  EXPECT_EQ(quoted_text("say \"\\\""), "\"say \\\"\\\\\\\"\"");
}

TEST(Text, LongTextIsShortenedBetweenCharacters) {
  EXPECT_EQ(quoted_text("éééééé", 3), "\"ééé...\"");
  EXPECT_EQ(quoted_text("ééé", 3), "\"ééé\"");
}

TEST(Text, NearestNameIsWithinTwoChanges) {
  EXPECT_EQ(nearest_name("valeus", {"breaks", "values"}), "values");
  EXPECT_EQ(nearest_name("inital", {"initial", "domain"}), "initial");
  EXPECT_FALSE(nearest_name("gamma", {"breaks", "values"}));
  EXPECT_FALSE(nearest_name("xy", {"z"})) << "nothing of the name would be left";
}

TEST(Text, BadUtf8IsFound) {
  EXPECT_EQ(first_bad_utf8("abc"), 3U);
  EXPECT_EQ(first_bad_utf8("aé\xffz"), 3U);
  EXPECT_EQ(first_bad_utf8("\xf4\x90\x80\x80"), 0U) << "beyond U+10FFFF";
  EXPECT_EQ(first_bad_utf8("\xe0\x80\x80"), 0U) << "overlong";
}

}  // namespace
}  // namespace shearfront
