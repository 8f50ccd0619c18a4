#include "clackers/input/numbers/python_literal.hpp"

#include "clackers/base/testing/test_file.hpp"

namespace clackers::input {
namespace {

using List = PythonLiteral::List;

PythonLiteral literal_of(std::string_view text) { return read_python_literal("a.npy", text); }

TEST(PythonLiteral, ReadsWhatHeadersHold) {
  EXPECT_EQ(*literal_of(" True ").as<bool>(), true);
  EXPECT_EQ(*literal_of("False\n").as<bool>(), false);
  EXPECT_EQ(*literal_of("123456789012345678").as<long long>(), 123456789012345678);
  EXPECT_EQ(*literal_of("(7L,)").as<List>()->front().as<long long>(), 7);
  EXPECT_EQ(*literal_of("'<f8'").as<std::string>(), "<f8");
  EXPECT_EQ(*literal_of("\"it's\"").as<std::string>(), "it's");
  EXPECT_EQ(*literal_of("'a\\'b\\\\'").as<std::string>(), "a'b\\");
  EXPECT_EQ(literal_of("()").as<List>()->size(), 0u);
  EXPECT_EQ(literal_of("[('t', '<f8'), ('u', '<f8', (2,)),]").as<List>()->size(), 2u);
  const auto literal = literal_of("{'descr': '<f8', 'shape': (3, 4), }");
  const auto& members = *literal.as<PythonLiteral::Dictionary>();
  EXPECT_EQ(members.keys, (std::vector<std::string>{"descr", "shape"}));
  ASSERT_EQ(members.values.size(), 2u);
  EXPECT_EQ(*(*members.values[1].as<List>())[1].as<long long>(), 4);
  EXPECT_EQ(literal.as<bool>(), nullptr);
}

TEST(PythonLiteral, RefusesEverythingElseWithItsPlace) {
  for (const std::string text : {"", "None", "-1", "1.5", "1234567890123456789", "'a", "'a\\",
                                 "'\\x41'", "(1", "(1 2)", "[1,", "[,]", "{'a'}", "{'a': 1",
                                 "{1: 2}", "{'a': 1 'b': 2}", "True False", "__import__('os')"})
    EXPECT_REFUSED(literal_of(text), "not-an-array", "a.npy: byte");
  EXPECT_REFUSED(literal_of("(1, x)"), "not-an-array", "byte 4 of its header (\"x)\")");
  EXPECT_REFUSED(literal_of(std::string("1\0", 2)), "not-an-array", "byte 1");
  EXPECT_REFUSED(literal_of(std::string(100000, '(')), "not-an-array", "byte 17");
}

}  // namespace
}  // namespace clackers::input
