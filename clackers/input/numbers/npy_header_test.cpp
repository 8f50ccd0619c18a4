#include "clackers/input/numbers/npy_header.hpp"

#include "clackers/base/testing/test_file.hpp"
#include "clackers/input/numbers/npy_file.hpp"
#include "clackers/input/testing/npy_bytes.hpp"

namespace clackers::input {
namespace {

using Numbers = std::vector<double>;

NpyFile read_header(const std::string& bytes) {
  const TestFile file(bytes);
  return NpyFile(InputFile(file.path(), nullptr));
}

TEST(NpyHeader, RefusesPythonObjectsUnread) {
  EXPECT_REFUSED(read_header(npy("'|O'", "(1,)", "cos\nsystem\n(S'true'\ntR.")), "not-an-array",
                 "never unpickled");
  EXPECT_REFUSED(read_header(npy("[('t', '<f8'), ('x', '|O')]", "(1,)", "cos\nsystem\n")),
                 "not-an-array", "never unpickled");
}

TEST(NpyHeader, RefusesOtherTypesAndShapes) {
  for (const std::string type : {"'<f2'", "'<f16'", "'<c16'", "'|b1'", "'|S8'", "'<U3'", "'<M8[s]'",
                                 "'<f3'", "'<i3'", "'|V8'"})
    EXPECT_REFUSED(read_header(npy(type, "(1,)", "")), "not-an-array",
                   "allowed: floating-point numbers");
  for (const std::string type : {"'f8'", "'=f8'", "'<f'", "''", "8", "'<f99999999999999999999'"})
    EXPECT_REFUSED(read_header(npy(type, "(1,)", "")), "not-an-array", "dtype");
  for (const std::string shape : {"()", "(2, 2, 2)"})
    EXPECT_REFUSED(read_header(npy("'<f8'", shape, "")), "not-an-array",
                   "allowed: (rows, columns)");
  EXPECT_REFUSED(read_header(npy("[('t', '<f8')]", "(1, 1)", "")), "not-an-array",
                 "allowed: (rows,) of a structured array");
  for (const std::string shape : {"3", "('3',)", "(3, True)"})
    EXPECT_REFUSED(read_header(npy("'<f8'", shape, "")), "not-an-array", "shape");
  EXPECT_REFUSED(read_header(npy("'<f8'", "(3, 0)", "")), "not-an-array", "no columns");
  EXPECT_REFUSED(read_header(npy("[]", "(3,)", "")), "not-an-array", "no columns");
  EXPECT_REFUSED(read_header(npy("[('', '|V8')]", "(3,)", "")), "not-an-array", "no columns");
  EXPECT_REFUSED(read_header(npy("[('t', [('a', '<f8')])]", "(3,)", "")), "not-an-array",
                 "field t has fields of its own");
  for (const std::string fields : {"['t']", "[('t',)]", "[(1, '<f8')]", "[('t', '<f8', 1, 2)]"})
    EXPECT_REFUSED(read_header(npy(fields, "(3,)", "")), "not-an-array", "a field in its header");
}

TEST(NpyHeader, RefusesSizesThatNoMemoryHolds) {
  EXPECT_REFUSED(read_header(npy("'<f8'", "(999999999999999999, 2)", "")), "not-an-array",
                 "999999999999999999 rows");
  EXPECT_REFUSED(read_header(npy("'<f8'", "(2, 999999999999999999)", "")), "not-an-array",
                 "rows are times");
  EXPECT_REFUSED(read_header(npy("'<f8'", "(500000000000, 100000)", "")), "not-an-array",
                 "ends before");
  EXPECT_REFUSED(read_header(npy("[('u', '<f8', (1000000, 1000000))]", "(2,)", "")), "not-an-array",
                 "numbers");
  EXPECT_REFUSED(read_header(npy("[('u', '<f8', (999999999999999999, 0))]", "(2,)", "")),
                 "not-an-array", "");
  EXPECT_REFUSED(read_header(npy("[('u', '<f8', (65536, 65536, 65536, 65536))]", "(2,)", "")),
                 "not-an-array", "131072 numbers");
  // Their bytes are 2^64.
  EXPECT_REFUSED(read_header(npy("'<f8'", "(576460752303423488, 4)", "")), "not-an-array",
                 "it has 576460752303423488 rows");
  EXPECT_REFUSED(read_header(npy("[('x', '|V16777216'), ('y', '|V16777216')]", "(2,)", "")),
                 "not-an-array", "bytes");
}

TEST(NpyHeader, RefusesAHeaderWithoutItsMembers) {
  const auto header = [](const std::string& text) { return npy_with_header(text, ""); };
  EXPECT_REFUSED(read_header(header("{'fortran_order': False, 'shape': (3,)}")), "not-an-array",
                 "its header has no descr");
  EXPECT_REFUSED(read_header(header("{'descr': '<f8', 'shape': (3,)}")), "not-an-array",
                 "its header has no fortran_order");
  EXPECT_REFUSED(read_header(header("{'descr': '<f8', 'fortran_order': False}")), "not-an-array",
                 "its header has no shape");
  EXPECT_REFUSED(read_header(header("{'descr': '<f8', 'fortran_order': 0, 'shape': (3,)}")),
                 "not-an-array", "neither True nor False");
  EXPECT_REFUSED(read_header(header("[1]")), "not-an-array", "its header has no");
  EXPECT_REFUSED(read_header(header("{'descr'")), "not-an-array", "is not as NumPy writes it");
}

}  // namespace
}  // namespace clackers::input
