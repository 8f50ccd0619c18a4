#include "clackers/input/results/result_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::input {
namespace {

constexpr std::size_t most_first_bytes = 2048;

bool has(std::string_view bytes, std::string_view word) { return bytes.find(word) != bytes.npos; }

bool is_calculix_dat(std::string_view bytes) {
  return has(bytes, "(vx,vy,vz) for set ") && has(bytes, " and time ");
}
bool is_calculix_frd(std::string_view bytes) { return bytes.starts_with("    1C"); }
bool is_abaqus_dat(std::string_view bytes) {
  const bool banner = has(bytes, "Abaqus ") && has(bytes, " Date ") && has(bytes, " Time ");
  return banner || has(bytes, " TOTAL TIME COMPLETED ");
}
bool is_nodout(std::string_view bytes) { return has(bytes, "n o d a l   p r i n t   o u t"); }

// A whole label before twelve numbers, and no header.
bool is_mbdyn_mov(std::string_view bytes) {
  if (!has(bytes, "\n") || has(bytes.substr(0, bytes.find('\n')), ",")) return false;
  const auto fields = fields_of(bytes.substr(0, bytes.find('\n')));
  return fields.size() == 13 && whole_number(fields[0]) &&
         std::ranges::all_of(fields, looks_numeric);
}

// The first header of a little-endian file: kind, rows, columns, no imaginary part, a name that ends with 0.
bool is_mat4(std::string_view bytes) {
  std::int32_t head[5];
  if (bytes.size() < sizeof head + 2) return false;
  std::memcpy(head, bytes.data(), sizeof head);
  const auto [kind, rows, columns, imaginary, length] = head;
  return kind >= 0 && kind < 100 && kind % 10 < 2 && rows >= 0 && columns >= 0 && imaginary == 0 &&
         length > 1 && length < 256 && bytes.size() >= sizeof head + std::size_t(length) &&
         bytes[sizeof head + std::size_t(length) - 1] == '\0';
}

// Version 0x0100 and the order of bytes behind a text; version 7.3, 0x0200, is HDF5.
bool is_mat5(std::string_view bytes) {
  const auto version = bytes.size() < 128 ? bytes : bytes.substr(124, 4);
  return version == std::string_view("\x00\x01IM", 4) ||
         version == std::string_view("\x01\x00MI", 4);
}
// At the front, or behind a block of the user's.
bool is_hdf5(std::string_view bytes) {
  constexpr std::string_view mark = "\x89HDF\r\n\x1a\n";
  return bytes.starts_with(mark) || (bytes.size() > 512 && bytes.substr(512).starts_with(mark));
}
bool is_netcdf(std::string_view bytes) {
  return bytes.starts_with("CDF") && bytes.size() > 3 &&
         (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

/// All readers; a new one is a row here and its function.
const std::vector<ResultReader> table = {
    {"calculix-dat", "CalculiX, *NODE PRINT", is_calculix_dat, read_calculix_dat},
    {"calculix-frd", "CalculiX, *NODE FILE", is_calculix_frd, read_calculix_frd},
    {"abaqus-dat", "Abaqus, *NODE PRINT", is_abaqus_dat, read_abaqus_dat},
    {"nodout", "LS-DYNA, *DATABASE_NODOUT", is_nodout, read_nodout},
    {"mbdyn-mov", "MBDyn, structural nodes", is_mbdyn_mov, read_mbdyn_mov},
    {"mat4", "Modelica and MATLAB, version 4", is_mat4, read_mat4},
    {"mat5", "MATLAB and Octave, versions 5 to 7", is_mat5, read_mat5},
    {"hdf5", "HDF5, NetCDF 4 and MATLAB 7.3", is_hdf5, read_netcdf},
    {"netcdf", "NetCDF, MBDyn among others", is_netcdf, read_netcdf},
};

}  // namespace

std::span<const ResultReader> result_readers() { return table; }

const ResultReader* result_reader_of(InputFile& file, const ResultChoice& choice) {
  const auto bytes = file.first_bytes(most_first_bytes);
  if (bytes.starts_with("PAR1"))
    throw InputError(fmt::format("{}: Parquet is not read; write it as csv instead.", file.name()),
                     "not-text");
  if (choice.reader == "table") return nullptr;
  std::vector<std::string> names{"table"};
  for (const auto& reader : table) {
    if (choice.reader.empty() ? reader.recognises(bytes) : reader.name == choice.reader)
      return &reader;
    names.push_back(reader.name);
  }
  if (choice.reader.empty()) return nullptr;
  refuse_name("reader", choice.reader, names, fmt::format("{}", fmt::join(names, ", ")));
}

ResultTable::ResultTable(InputFile file, const ResultReader& reader, const ResultChoice& choice,
                         const std::vector<std::string>& names)
    : Table(file.name()), rows_(reader.read(std::move(file), choice)) {
  if (!names.empty() && names.size() != rows_.names.size())
    refuse(name(), "columns", fmt::format("{}", fmt::join(rows_.names, ", ")),
           "as many as --columns names", {}, "ragged-row");
  set_names(names.empty() ? rows_.names : names);
}

void ResultTable::read_number(std::size_t column, Number& number) {
  number = rows_.numbers[(row_ - 1) * names().size() + column];
  if (!std::isfinite(number.value)) refuse_not_finite(column, exact_number(number.value));
}

std::string ResultTable::place() const {
  return fmt::format("{} row {} (from 0)", name(), row_ - 1);
}

}  // namespace clackers::input
