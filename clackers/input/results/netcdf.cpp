#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "clackers/input/results/arrays.hpp"

namespace clackers::input {
namespace {

constexpr std::size_t longest_name = 256;  // NC_MAX_NAME
constexpr int deepest = 16, most_dimensions = 4;

// netCDF 4.7 to 4.9.2 (Debian 11 and 12, Ubuntu 22.04 and 24.04, Fedora), 4.9.3 (Debian 13), and what a
// development package or another system has.
const std::vector<const char*> libraries{"libnetcdf.so.19", "libnetcdf.so.22", "libnetcdf.so"};

// The functions of netCDF's C library, whose interface has not changed since version 4.0; it reads HDF5 as well.
struct NetCdf {
  int (*open_mem)(const char* path, int mode, std::size_t size, void* memory, int* id);
  const char* (*strerror)(int error);
  int (*inq_nvars)(int id, int* count);
  int (*inq_varname)(int id, int variable, char* name);
  int (*inq_varndims)(int id, int variable, int* count);
  int (*inq_vardimid)(int id, int variable, int* dimensions);
  int (*inq_dimlen)(int id, int dimension, std::size_t* length);
  int (*get_var_double)(int id, int variable, double* values);
  int (*inq_grps)(int id, int* count, int* groups);
  int (*inq_grpname)(int id, char* name);

  explicit NetCdf(const std::string& file) {
    const auto load = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(
          library_function(file, libraries, "libnetcdf19", name));
    };
    load(open_mem, "nc_open_mem");
    load(strerror, "nc_strerror");
    load(inq_nvars, "nc_inq_nvars");
    load(inq_varname, "nc_inq_varname");
    load(inq_varndims, "nc_inq_varndims");
    load(inq_vardimid, "nc_inq_vardimid");
    load(inq_dimlen, "nc_inq_dimlen");
    load(get_var_double, "nc_get_var_double");
    load(inq_grps, "nc_inq_grps");
    load(inq_grpname, "nc_inq_grpname");
  }
  void require(int error) const {
    if (error != 0) throw std::runtime_error(strerror(error));
  }
};

// What may be a history in a group and the groups in it.
void take(const NetCdf& library, int group, const std::string& path, int depth,
          std::vector<NamedArray>& arrays) {
  std::array<char, longest_name + 1> name{};
  int count = 0;
  library.require(library.inq_nvars(group, &count));
  for (int variable = 0; variable < count; ++variable) {
    library.require(library.inq_varname(group, variable, name.data()));
    NamedArray array{path + name.data(), {}, {}};
    int rank = 0;
    library.require(library.inq_varndims(group, variable, &rank));
    if (!is_history_array(array.name) || rank > most_dimensions) continue;
    std::array<int, most_dimensions> dimensions{};
    library.require(library.inq_vardimid(group, variable, dimensions.data()));
    std::size_t size = 1;
    for (int k = 0; k < rank; ++k) {
      auto& length = array.shape.emplace_back();
      library.require(library.inq_dimlen(group, dimensions[std::size_t(k)], &length));
      if (length > 0 && size > most_array_bytes / sizeof(double) / length)
        throw std::runtime_error(fmt::format("{} is larger than 2 GB", array.name));
      size *= length;
    }
    array.values.resize(size);
    if (size > 0 && library.get_var_double(group, variable, array.values.data()) == 0)
      arrays.push_back(std::move(array));  // no text
  }
  library.require(library.inq_grps(group, &count, nullptr));
  std::vector<int> groups(std::size_t(std::max(count, 0)) + 1);
  library.require(library.inq_grps(group, &count, groups.data()));
  for (int k = 0; k < count && depth < deepest; ++k) {
    library.require(library.inq_grpname(groups[std::size_t(k)], name.data()));
    take(library, groups[std::size_t(k)], path + name.data() + '/', depth + 1, arrays);
  }
}

}  // namespace

ResultRows read_netcdf(InputFile file, const ResultChoice& choice) {
  const auto name = file.name();
  const NetCdf library(name);
  auto bytes = file.rest(most_array_bytes);
  const auto arrays = in_own_process(name, [&] {
    int id = 0;
    library.require(library.open_mem("history", 0, bytes.size(), bytes.data(), &id));
    std::vector<NamedArray> found;
    take(library, id, "", 0, found);
    return found;
  });
  return rows_of(name, arrays, choice);
}

}  // namespace clackers::input
