#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "clackers/base/error.hpp"
#include "clackers/base/testing/test_file.hpp"
#include "clackers/input/history.hpp"
#include "clackers/input/results/arrays.hpp"
#include "clackers/input/results/result_table.hpp"
#include "clackers/input/testing/npy_bytes.hpp"

namespace clackers::input {
namespace {

using Numbers = std::vector<double>;

History result(const std::string& bytes, const ResultChoice& choice = {}, int dof = 2,
               double step = 0.0) {
  const TestFile file(bytes);
  HistoryOptions options{.dof = dof, .step = step};
  options.results = choice;
  return read_history(file.path(), options);
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  return text.replace(text.find(old), old.size(), by);
}

// As CalculiX 2.20 wrote it.
const std::string calculix_dat = R"(
 displacements (vx,vy,vz) for set MASSES and time  0.1000000E-01

         1  9.994502E-01  1.000000E+00  0.000000E+00
         2 -3.318238E-01  2.000000E+00  0.000000E+00

 forces (fx,fy,fz) for set GROUND and time  0.1000000E-01

         3  7.000000E+00  0.000000E+00  0.000000E+00

 velocities (vx,vy,vz) for set MASSES and time  0.1000000E-01

         1 -5.996727E-02  0.000000E+00  0.000000E+00
         2  2.852448E-01  0.000000E+00  0.000000E+00

 displacements (vx,vy,vz) for set MASSES and time  0.2000000E-01

         1  9.988009E-01  3.000000E+00  0.000000E+00
         2 -3.276413E-01  4.000000E+00  0.000000E+00

 velocities (vx,vy,vz) for set MASSES and time  0.2000000E-01

         1 -6.989359E-02  0.000000E+00  0.000000E+00
         2  5.512504E-01  0.000000E+00  0.000000E+00
)";

const std::string calculix_frd = R"(    1C
    1UUSER
  100CL  101 1.00000E-02           3                     1    1           1
 -4  DISP        4    1
 -5  D1          1    2    1    0
 -1         1 9.99450E-01 0.00000E+00 0.00000E+00
 -1         2-3.31824E-01 0.00000E+00 0.00000E+00
 -1         3 0.00000E+00 0.00000E+00 0.00000E+00
 -3
  100CL  101 1.00000E-02           3                     1    1           1
 -4  VELO        4    1
 -1         1-5.99673E-02 0.00000E+00 0.00000E+00
 -1         2 2.85245E-01 0.00000E+00 0.00000E+00
 -1         3 0.00000E+00 0.00000E+00 0.00000E+00
 -3
  100CL  102 2.00000E-02           3                     1    2           1
 -4  DISP        4    1
 -1         1 9.98801E-01 0.00000E+00 0.00000E+00
 -1         2-3.27641E-01 0.00000E+00 0.00000E+00
 -1         3 0.00000E+00 0.00000E+00 0.00000E+00
 -3
  100CL  102 2.00000E-02           3                     1    2           1
 -4  VELO        4    1
 -1         1-6.98936E-02 0.00000E+00 0.00000E+00
 -1         2 5.51250E-01 0.00000E+00 0.00000E+00
 -1         3 0.00000E+00 0.00000E+00 0.00000E+00
 -3
 9999
)";

const std::string abaqus_dat = R"(1

   Abaqus 2022                  Date 25-Nov-2026   Time 10:00:00

 STEP TIME COMPLETED       1.000E-02,  TOTAL TIME COMPLETED        1.000E-02

   THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET MASSES

       NODE FOOT-  U1          COOR1       V1
            NOTE

          1       -5.0000E-04  0.9995     -5.9967E-02
          2        1.5000E-03 -0.3318      0.2852

 MAXIMUM           1.5000E-03  0.9995      0.2852
 AT NODE                    2           1           2

 STEP TIME COMPLETED       2.000E-02,  TOTAL TIME COMPLETED        2.000E-02

       NODE FOOT-  U1          COOR1       V1
            NOTE

          1       -1.2000E-03  0.9988     -6.9894E-02
          2        5.7000E-03 -0.3276      0.5513
)";

const std::string nodout =
    " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1           ( at time 0.0000000E+00 )\n\n"
    " nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      y-accl      "
    "z-accl      x-coor      y-coor      z-coor\n"
    "         1  0.0000E+00  0.0000E+00  0.0000E+00 -5.0000E-02  0.0000E+00  0.0000E+00-1.0000E+00  0.0000E+00  "
    "0.0000E+00  1.0000E+00  0.0000E+00  0.0000E+00\n\n"
    " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1           ( at time 0.0000000E+00 )\n\n"
    " nodal point  x-rot      y-rot       z-rot\n         1  9.0000E+00  9.0000E+00  9.0000E+00\n\n"
    " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       2           ( at time 1.0000000E-03 )\n\n"
    " nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      y-accl      "
    "z-accl      x-coor      y-coor      z-coor\n"
    "         1 -1.0000E-04  0.0000E+00  0.0000E+00 -5.1000E-02  0.0000E+00  0.0000E+00-1.0000E+00  0.0000E+00  "
    "0.0000E+00  9.9990E-01  0.0000E+00  0.0000E+00\n";

// A matrix of a file of version 4: of doubles, or a text.
std::string matrix(const std::string& name, int rows, int columns, const Numbers& values,
                   bool is_text = false) {
  const std::int32_t head[5] = {is_text ? 51 : 0, rows, columns, 0, int(name.size()) + 1};
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  bytes += name + '\0';
  for (const double value : values)
    if (is_text)
      bytes += char(value);
    else
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

Numbers text(const std::string& words) { return {words.begin(), words.end()}; }

TEST(CalculixDat, HasARowATime) {
  const auto h = result(calculix_dat);
  EXPECT_EQ(h.motion.t, (Numbers{0.01, 0.02}));
  EXPECT_EQ(h.motion.u, (Numbers{0.9994502, -0.3318238, 0.9988009, -0.3276413}));
  EXPECT_EQ(h.motion.v, (Numbers{-0.05996727, 0.2852448, -0.06989359, 0.5512504}));
  for (const auto& column : h.columns) EXPECT_EQ(column.digits, 7) << column.name;
}

TEST(CalculixDat, NodesAndDirectionsAreChosen) {
  EXPECT_EQ(result(calculix_dat, {.nodes = {"2", "1"}}).motion.u,
            (Numbers{-0.3318238, 0.9994502, -0.3276413, 0.9988009}));
  EXPECT_EQ(result(calculix_dat, {.direction = 2}).motion.u, (Numbers{1.0, 2.0, 3.0, 4.0}));
}

TEST(CalculixDat, BentFilesAreRefused) {
  EXPECT_REFUSED(result(calculix_dat, {}, 1), "no-column", "--node");
  EXPECT_REFUSED(result(calculix_dat, {.nodes = {"1", "7"}}), "no-column", "7");
  EXPECT_REFUSED(result(replaced(calculix_dat, "9.988009E-01", "9.98x009E-01")), "not-a-number",
                 "line 18");
  EXPECT_REFUSED(result(replaced(calculix_dat, "9.988009E-01", "NaN")), "not-finite", "line 18");
  EXPECT_REFUSED(result(calculix_dat.substr(0, calculix_dat.size() - 60)), "ragged-row", "0.02");
  EXPECT_REFUSED(result(calculix_dat.substr(0, 70)), "too-short");
}

TEST(CalculixFrd, HasARowATime) {
  const auto h = result(calculix_frd, {.nodes = {"1", "2"}});
  EXPECT_EQ(h.motion.t, (Numbers{0.01, 0.02}));
  EXPECT_EQ(h.motion.u, (Numbers{0.99945, -0.331824, 0.998801, -0.327641}));
  EXPECT_EQ(h.motion.v, (Numbers{-0.0599673, 0.285245, -0.0698936, 0.55125}));
  EXPECT_REFUSED(result(calculix_frd), "no-column", "--node");
  EXPECT_REFUSED(result(replaced(calculix_frd, " -1         1 9.98801E-01 0.00000E+00 0.00000E+00",
                                 " -1         1")),
                 "ragged-row");
}

TEST(AbaqusDat, HasDisplacementsOrCoordinates) {
  const auto h = result(abaqus_dat);
  EXPECT_EQ(h.motion.t, (Numbers{0.01, 0.02}));
  EXPECT_EQ(h.motion.u, (Numbers{-0.0005, 0.0015, -0.0012, 0.0057}));
  EXPECT_EQ(h.motion.v, (Numbers{-0.059967, 0.2852, -0.069894, 0.5513}));
  EXPECT_EQ(result(abaqus_dat, {.coordinates = true}).motion.u,
            (Numbers{0.9995, -0.3318, 0.9988, -0.3276}));
  EXPECT_REFUSED(result(replaced(abaqus_dat, "  0.9988     -6.9894E-02", "")), "ragged-row");
}

TEST(Nodout, HasNumbersThatTouch) {
  const auto h = result(nodout, {}, 1);
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 0.001}));
  EXPECT_EQ(h.motion.u, (Numbers{0.0, -0.0001}));
  EXPECT_EQ(h.motion.v, (Numbers{-0.05, -0.051}));
  EXPECT_EQ(h.motion.a, (Numbers{-1.0, -1.0}));
  EXPECT_EQ(result(nodout, {.coordinates = true}, 1).motion.u, (Numbers{1.0, 0.9999}));
}

TEST(MbdynMov, RowsAreCounted) {
  const std::string mov =
      "1 1.5 0 0 0 0 0 -0.5 0 0 0 0 0\n2 2.5 0 0 0 0 0 0.5 0 0 0 0 0\n"
      "1 1.4 0 0 0 0 0 -0.6 0 0 0 0 0\n2 2.6 0 0 0 0 0 0.6 0 0 0 0 0\n";
  const auto h = result(mov, {}, 2, 0.1);
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 0.1}));
  EXPECT_EQ(h.motion.u, (Numbers{1.5, 2.5, 1.4, 2.6}));
  EXPECT_EQ(h.motion.v, (Numbers{-0.5, 0.5, -0.6, 0.6}));
  EXPECT_REFUSED(result(mov), "no-column", "--steps");
}

TEST(Mat4, TakesVariables) {
  const auto h = result(matrix("t", 3, 1, {0, 1, 2}) + matrix("u", 3, 2, {1, 2, 3, 4, 5, 6}) +
                        matrix("other", 1, 1, {9}));
  EXPECT_EQ(h.motion.t, (Numbers{0, 1, 2}));
  EXPECT_EQ(h.motion.u, (Numbers{1, 4, 2, 5, 3, 6}));
}

TEST(Mat4, TakesResultsOfModelica) {
  // A column a name of four letters; u2 is an alias of the negative u1, k is constant.
  auto whole = matrix("Aclass", 1, 4, text("Atra"), true) +
               matrix(
                   "name", 4, 4,
                   [] {
                     auto v = text("timeu[1]u[2]k");
                     v.resize(16);
                     return v;
                   }(),
                   true) +
               matrix("dataInfo", 4, 4, {0, 1, 0, -1, 2, 2, 0, -1, 2, -2, 0, -1, 1, 1, 0, 0}) +
               matrix("data_1", 1, 2, {7, 7}) + matrix("data_2", 2, 3, {0, 5, 1, 6, 2, 7});
  const auto h = result(whole);
  EXPECT_EQ(h.motion.t, (Numbers{0, 1, 2}));
  EXPECT_EQ(h.motion.u, (Numbers{5, -5, 6, -6, 7, -7}));
}

TEST(Mat4, BentFilesAreRefused) {
  const auto whole = matrix("t", 3, 1, {0, 1, 2}) + matrix("u", 3, 2, {1, 2, 3, 4, 5, 6});
  EXPECT_REFUSED(result(whole.substr(0, whole.size() - 1)), "not-an-array", "ends within a matrix");
  EXPECT_REFUSED(result(whole.substr(0, 60)), "not-an-array", "ends within a header");
  EXPECT_REFUSED(result(matrix("t", 3, 1, {0, 1, 2}) + matrix("u", 2, 2, {1, 2, 3, 4})),
                 "not-an-array", "lengths");
  EXPECT_REFUSED(result(matrix("x", 3, 1, {0, 1, 2})), "not-an-array", "t, u");
}

// An element of a file of version 5, filled to eight bytes.
std::string element(std::uint32_t type, std::string bytes) {
  const std::uint32_t tag[2] = {type, std::uint32_t(bytes.size())};
  bytes.resize((bytes.size() + 7) / 8 * 8);
  return std::string(reinterpret_cast<const char*>(tag), sizeof tag) + bytes;
}

std::string matrix_5(const std::string& name, int rows, int columns, const std::string& numbers,
                     std::uint32_t kind = 6) {
  return element(14, element(6, bytes_of<std::uint32_t>({kind, 0})) +
                         element(5, bytes_of<std::int32_t>({rows, columns})) + element(1, name) +
                         numbers);
}

std::string mat5(const std::string& elements) {
  std::string head = "MATLAB 5.0 MAT-file";
  head.resize(124, ' ');
  return head + std::string("\x00\x01IM", 4) + elements;
}

const auto t5 = matrix_5("t", 1, 3, element(9, bytes_of<double>({0, 1, 2})));

TEST(Mat5, TakesNumbersOfEveryType) {
  const auto u = matrix_5("u", 3, 2, element(1, bytes_of<std::int8_t>({1, 2, 3, -4, 5, 6})));
  const auto v = matrix_5("v", 3, 2, element(7, bytes_of<float>({1, 2, 3, 4, 5, 6.5})), 7);
  const auto h = result(mat5(matrix_5("s", 1, 1, "", 2) +
                             matrix_5("a", 1, 1, element(9, bytes_of<double>({9}))) + t5 + u + v));
  EXPECT_EQ(h.motion.t, (Numbers{0, 1, 2}));
  EXPECT_EQ(h.motion.u, (Numbers{1, -4, 2, 5, 3, 6}));
  EXPECT_EQ(h.motion.v, (Numbers{1, 4, 2, 5, 3, 6.5}));
}

TEST(Mat5, BentFilesAreRefused) {
  const auto u = matrix_5("u", 3, 1, element(9, bytes_of<double>({1, 2, 3})));
  const auto whole = mat5(t5 + u);
  EXPECT_EQ(result(whole, {}, 1).motion.u, (Numbers{1, 2, 3}));
  for (const std::size_t cut : {1u, 20u, 40u, 60u})
    EXPECT_REFUSED(result(whole.substr(0, whole.size() - cut)), "not-an-array", "ends within");
  EXPECT_REFUSED(result(mat5(t5 + matrix_5("u", 4, 1, element(9, bytes_of<double>({1, 2, 3}))))),
                 "not-an-array", "numbers of its shape");
  EXPECT_REFUSED(result(mat5(t5 + matrix_5("u", 2, 1, element(9, bytes_of<double>({1, 2}))))),
                 "not-an-array", "lengths");
  EXPECT_REFUSED(result(mat5(element(15, "no stream of zlib"))), "not-an-array", "compressed");
  EXPECT_REFUSED(
      result(replaced(whole, std::string_view("\x00\x01IM", 4), std::string_view("\x01\x00MI", 4))),
      "not-an-array", "big-endian");
  EXPECT_REFUSED(result(mat5(matrix_5("t", 1, 3, element(99, "12345678")))), "not-an-array",
                 "unknown type");
}

// A classic netCDF file with t and node.struct.7.X as MBDyn writes it, two rows.
std::string netcdf_file() {
  const auto whole = [](std::uint32_t value) { return bytes_of<std::uint32_t>({value}, true); };
  const auto text = [&](std::string name) {
    const auto size = whole(std::uint32_t(name.size()));
    name.resize((name.size() + 3) / 4 * 4);
    return size + name;
  };
  const auto none = whole(0) + whole(0);
  auto head = std::string("CDF\x01") + whole(0) + whole(10) + whole(2) + text("time") + whole(2) +
              text("Vec3") + whole(3) + none + whole(11) + whole(2);
  const auto t = text("time") + whole(1) + whole(0) + none + whole(6) + whole(16);
  const auto x =
      text("node.struct.7.X") + whole(2) + whole(0) + whole(1) + none + whole(6) + whole(48);
  const auto begin = std::uint32_t(head.size() + t.size() + x.size() + 8);
  head += t + whole(begin) + x + whole(begin + 16);
  return head + bytes_of<double>({0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, true);
}

// Where the library is not installed, the message names it.
bool has_netcdf() {
  try {
    result(netcdf_file(), {}, 1);
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("libnetcdf"), std::string::npos);
    return false;
  }
  return true;
}

TEST(NetCdf, TakesNodesOfMbdyn) {
  if (!has_netcdf()) GTEST_SKIP() << "needs libnetcdf19";
  const auto h = result(netcdf_file(), {.nodes = {"7"}, .direction = 2}, 1);
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 0.5}));
  EXPECT_EQ(h.motion.u, (Numbers{2.0, 5.0}));
  EXPECT_REFUSED(result(netcdf_file(), {.nodes = {"8"}}, 1), "no-column", "8");
}

TEST(NetCdf, BentFilesAreRefused) {
  if (!has_netcdf()) GTEST_SKIP() << "needs libnetcdf19";
  const auto whole = netcdf_file();
  EXPECT_REFUSED(result(whole.substr(0, 60)), "not-an-array", "no whole file");
  EXPECT_REFUSED(result(replaced(whole, "node", "nude")), "no-column");
  EXPECT_REFUSED(result("\x89HDF\r\n\x1a\n and no more"), "not-an-array", "HDF");
}

TEST(OwnProcess, EndsForItself) {
  const auto arrays = in_own_process("f", [] {
    return std::vector<NamedArray>{{"t", {1, 2}, {3.0, 4.0}}, {"u", {}, {5.0}}};
  });
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].shape, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(arrays[1].values, (Numbers{5.0}));
  EXPECT_REFUSED(in_own_process("f", []() -> std::vector<NamedArray> { std::abort(); }),
                 "not-an-array", "signal 6");
  EXPECT_REFUSED(in_own_process("f",
                                []() -> std::vector<NamedArray> {
                                  raise(SIGINT);
                                  return {};
                                }),
                 "interrupted");
  EXPECT_REFUSED(in_own_process("f", []() -> std::vector<NamedArray> { _exit(3); }), "not-an-array",
                 "ended early");
  EXPECT_REFUSED(
      in_own_process("f",
                     []() -> std::vector<NamedArray> { throw std::runtime_error("no group"); }),
      "not-an-array", "no group");
}

TEST(ResultReaders, AreForcedOrRefused) {
  EXPECT_REFUSED(result("PAR1 and more"), "not-text", "csv instead");
  EXPECT_REFUSED(result("t,u1\n0,1\n1,2\n", {.reader = "nodou"}), "unknown-name", "nodout");
  EXPECT_REFUSED(result("t,u1\n0,1\n1,2\n", {.reader = "nodout"}), "too-short");
  EXPECT_REFUSED(result(calculix_dat, {.reader = "table"}), "ragged-row");
}

TEST(ResultReaders, PlainTablesStayTables) {
  EXPECT_EQ(result("# exported from Abaqus 2022\nt,u1\n0,1\n1,2\n", {}, 1).motion.u,
            (Numbers{1, 2}));
}

}  // namespace
}  // namespace clackers::input
