#include "clackers/base/text.hpp"

#include <gtest/gtest.h>

namespace clackers {
namespace {

TEST(Printable, LettersOfAnyLanguageAreKept) {
  const std::string text = "h0.01 – Größe, 変位 \xF0\x9F\x98\x80";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscapedByteByByte) {
  EXPECT_EQ(printable("a\x1B[31mb\r\n\t\x7F"), "a\\x1b[31mb\\x0d\\x0a\\x09\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b");           // C1: CSI
  EXPECT_EQ(printable("\xE2\x80\xAE"), "\\xe2\\x80\\xae");  // right-to-left override
  EXPECT_EQ(printable("\xE2\x81\xA6"), "\\xe2\\x81\\xa6");  // isolate
  EXPECT_EQ(printable("\xE2\x80\xA8"), "\\xe2\\x80\\xa8");  // line separator
  EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");             // first character after C1
  EXPECT_EQ(printable("\xE2\x80\xA7"), "\xE2\x80\xA7");     // last one before the separators
}

TEST(Printable, BytesThatAreNoUtf8AreEscaped) {
  EXPECT_EQ(printable("a\xFFz"), "a\\xffz");
  EXPECT_EQ(printable("\xC3"), "\\xc3");           // cut short
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf");  // overlong
  EXPECT_EQ(printable("\xE0\x80\xAF"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");           // surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // above U+10FFFF
  EXPECT_EQ(printable("\xC3(x"), "\\xc3(x");
}

TEST(Wrap, WrapsAtSpacesThenAtMarksThenAnywhere) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrap("one two three", 7), (Lines{"one two", "three"}));
  EXPECT_EQ(wrap("generalized-alpha:rho=0.8", 13), (Lines{"generalized-", "alpha:rho=0.8"}));
  EXPECT_EQ(wrap("newmark+event-driven", 15), (Lines{"newmark+", "event-driven"}));
  EXPECT_EQ(wrap("abcdefgh", 3), (Lines{"abc", "def", "gh"}));
  EXPECT_EQ(wrap("±±±±", 3), (Lines{"±±±", "±"}));
  EXPECT_EQ(wrap("exact", 5), (Lines{"exact"}));
  EXPECT_EQ(wrap("", 5), (Lines{""}));
}

TEST(Wrap, KeepsLinesAndTheirIndentation) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrap("a\n\n  u1 = u0 + h v0", 80), (Lines{"a", "", "  u1 = u0 + h v0"}));
  EXPECT_EQ(wrap("  one two", 6), (Lines{"  one", "  two"}));
  EXPECT_EQ(wrap("Order  2 for all steps", 15),
            (Lines{"Order  2 for", "       all", "       steps"}));
  EXPECT_EQ(wrap("Order  2 for all steps", 14), (Lines{"Order  2 for", "all steps"}));
}

TEST(Wrap, RejoinsTheLinesOfAParagraphAndNoOthers) {
  EXPECT_EQ(rejoin("one\ntwo\nthree"), "one two three");
  EXPECT_EQ(rejoin("one\n\ntwo"), "one\n\ntwo");
  EXPECT_EQ(rejoin("one\n    u = v\n    v = a\ntwo"), "one\n    u = v\n    v = a\ntwo");
  EXPECT_EQ(rejoin("Order    2\nSource   a book\n(1991)."), "Order    2\nSource   a book (1991).");
  EXPECT_EQ(rejoin("Order       2\nDissipation none\nMemory      a0"),
            "Order       2\nDissipation none\nMemory      a0");
  EXPECT_EQ(rejoin("Order    2 where\n         it is so,\n         else 1\nCost     1"),
            "Order    2 where it is so, else 1\nCost     1");
  EXPECT_EQ(rejoin("Order    2\n    u = v"), "Order    2\n    u = v");
  EXPECT_EQ(rejoin(""), "");
}

TEST(Wrap, TakesTimeInProportionToItsLength) {
  const std::string text(std::size_t(1) << 22,
                         'x');  // minutes if each line looked at the whole rest
  EXPECT_EQ(wrap(text, 80).size(), (text.size() + 79) / 80);
}

TEST(Wrap, NoLineIsWiderThanAsked) {
  const std::string text =
      "A sentence, with words such as generalized-alpha:rho=0.8+event-driven and ±±±±±±±±±±±±±±.";
  for (std::size_t width = 1; width < 100; ++width)
    for (const auto& line : wrap(text, width)) EXPECT_LE(display_width(line), width);
}

TEST(Wrap, LongWordsAreKeptOnRequestAndLinesIndented) {
  EXPECT_EQ(wrapped("see /a/long/path and more", 12), "see\n/a/long/path\nand more");
  EXPECT_EQ(wrapped("one two three", 11, 4), "one two\n    three");
  EXPECT_EQ(wrapped("one\ntwo", 20, 2), "one\n  two");
  EXPECT_EQ(wrapped("unbreakable", 5), "unbreakable");
}

TEST(Shell, QuotesWhatAShellWouldReadOtherwise) {
  EXPECT_EQ(shell_quoted("./a-b_c+d:e=f@g%h,1.5"), "./a-b_c+d:e=f@g%h,1.5");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
  for (const auto* word : {"a b", "$x", "~", "*", "a;b", "{h}", "\n"})
    EXPECT_EQ(shell_quoted(word), "'" + std::string(word) + "'");
  EXPECT_EQ(shell_line(std::vector<std::string>{"cp", "a b", "c"}), "cp 'a b' c");
}

TEST(ShellWords, AreTheArgumentsOfALine) {
  const std::vector<std::string> arguments{"a", "", "it's", "two words", "--x=1", "\\ \"$y\""};
  EXPECT_EQ(shell_words(shell_line(arguments)), arguments);
  EXPECT_TRUE(shell_words("").empty());
}

}  // namespace
}  // namespace clackers
