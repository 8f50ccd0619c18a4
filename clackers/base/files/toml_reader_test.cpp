#include "clackers/base/files/toml_reader.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

TEST(Toml, TextsThatTheParserExcludesAreRefused) {
  for (const auto* text : {"a = [0, }0]", "a = [}", "a = [1979-05-27 0]", "a = [1979-05-27 0,",
                           "a = [0, \v0]", "a = [\xC2\x85]", "a = [\xE2\x80\xA8 0]"})
    EXPECT_REFUSED(toml_from(text, "x.toml"), "bad-syntax", "x.toml:1: ");
}

std::string utf8(unsigned point) {
  if (point < 0x800) return {char(0xC0 | point >> 6), char(0x80 | (point & 63))};
  return {char(0xE0 | point >> 12), char(0x80 | (point >> 6 & 63)), char(0x80 | (point & 63))};
}

TEST(Toml, LettersBeyondAsciiStandInQuotesAlone) {
  // Whole blocks, for which the parser's table of blanks had no answer.
  for (unsigned point = 0xA1; point < 0xFEFF; point += point < 0x4A0 ? 31 : 127) {
    const bool is_blank = point == 0x3000 || (point > 0x1600 && point < 0x2060);
    if (is_blank || (point >= 0xD800 && point <= 0xDFFF)) continue;
    const auto letter = utf8(point);
    for (const auto& text : {letter + " = 1", "a = " + letter, "a = [0, " + letter + "]"})
      EXPECT_REFUSED(toml_from(text, "x.toml"), "bad-syntax", "x.toml:1: ");
    EXPECT_EQ(toml_from("a = \"\"\"\\\n" + letter + "\"\"\" #" + letter, "x.toml")["a"], letter);
  }
}

TEST(Toml, LongKeysAreRefusedWhereverTheyStand) {
  std::string path = "'#'.\"\\\"\"";
  for (int i = 0; i < most_parts; ++i) path += " . a";
  for (const auto& text :
       {path + " = 1", "[" + path + "]", "[[" + path + "]]", "a = {" + path + " = 1}",
        "a = [\"\"\"b\"\"\"\"\", {" + path + " = 1}]", "a = ['''b'''', {" + path + " = 1}]",
        "a = ['\\', {" + path + "= 1}]", "a = [\"\", '', {" + path + "= 1}]"})
    EXPECT_REFUSED(toml_from("\n" + text, "x.toml"), "bad-syntax",
                   "x.toml:2: a key has more than 16 parts");
  const std::string many(100, '.');
  const auto table = toml_from("a.b.c = 1.5 # " + many + "\nd = [1.0, 2.0, '" + many + "', \"\\\"" +
                                   many + "\", \"\"\"\n" + many + "\"\"\", '''" + many + "''']",
                               "x.toml");
  EXPECT_EQ(table["d"].as_array()->size(), 6u);
}

TEST(Toml, TablesAreCounted) {
  const auto many = [](const std::string& line) {
    std::string text;
    while (text.size() < line.size() * (most_tables + 1)) text += line;
    return text;
  };
  for (const auto* line : {"[a]\n", " [[a]]\n", "a.b=1\n"})
    EXPECT_REFUSED(toml_from(many(line), "x.toml"), "bad-syntax",
                   "x.toml:200001: more than 200000 tables");
  for (const auto& text :
       {"a = [\n" + many("[],\n"), many("a = []\n")})  // the parser stops at once
    EXPECT_REFUSED(toml_from("!\n" + text, "x.toml"), "bad-syntax", "x.toml:1: Error");
}

}  // namespace
}  // namespace clackers
