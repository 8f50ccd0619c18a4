#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/files/input_file.hpp"
#include "clackers/base/number.hpp"
#include "clackers/input/history.hpp"

namespace clackers::input {

/// The rows of a result file, row by row.
struct ResultRows {
  std::vector<std::string> names;  ///< "t", "u1", "v1", ...; no "t" where the file has no times
  std::vector<Number> numbers;
};

/// One kind of result file.
struct ResultReader {
  std::string name;  ///< of --reader
  std::string program;
  bool (*recognises)(std::string_view first_bytes);
  ResultRows (*read)(InputFile file, const ResultChoice& choice);
};

ResultRows read_calculix_dat(InputFile file, const ResultChoice& choice);
ResultRows read_calculix_frd(InputFile file, const ResultChoice& choice);
ResultRows read_abaqus_dat(InputFile file, const ResultChoice& choice);
ResultRows read_nodout(InputFile file, const ResultChoice& choice);
ResultRows read_mbdyn_mov(InputFile file, const ResultChoice& choice);
ResultRows read_mat4(InputFile file, const ResultChoice& choice);
ResultRows read_mat5(InputFile file, const ResultChoice& choice);
ResultRows read_netcdf(InputFile file, const ResultChoice& choice);

/// Nodes are masses in the order of the choice, or of their first appearance.
class ChosenNodes {
 public:
  explicit ChosenNodes(const ResultChoice& choice) : choice_(choice) {}

  /// From 0; nothing for a node that was not chosen.
  std::optional<std::size_t> mass_of(std::string_view node);
  /// Throws InputError (no-column) where a chosen node has no values or there are more nodes than masses.
  void finish(const std::string& file, const std::function<bool(std::size_t mass)>& has_values);

 private:
  const ResultChoice& choice_;
  std::map<std::string, std::size_t, std::less<>> masses_;
};

/// Gathers what a file says node by node into rows.
class NodeRows {
 public:
  NodeRows(std::string file, const ResultChoice& choice) : file_(std::move(file)), nodes_(choice) {}

  /// What follows is of this time; the same time again goes on with its row. Throws InputError
  /// (ragged-row) where the row before lacks a value that the first has.
  void begin(const Number& time);
  /// A text that must be a number, of the quantity 'u', 'v' or 'a' of a node. Throws InputError with the place
  /// for another text (not-a-number, not-finite), and for a value before any time (too-short).
  void take(std::string_view node, char quantity, std::string_view text, const std::string& place);
  /// Throws InputError (too-short) without rows, and as ChosenNodes does.
  ResultRows finish();

 private:
  using Key = std::pair<std::size_t, char>;  // of a mass and quantity

  void end_row();

  std::string file_;
  ChosenNodes nodes_;
  std::vector<Key> columns_;  // of the first row
  std::map<Key, Number> row_;
  Number time_{};
  ResultRows rows_;
  bool has_time_ = false;
};

/// The fields of a line between blanks, and where a sign follows a digit, as Fortran prints them.
std::vector<std::string_view> fields_of(std::string_view line);
/// A number of a place, or InputError (not-a-number, not-finite).
Number number_of(std::string_view text, const std::string& place);

}  // namespace clackers::input
