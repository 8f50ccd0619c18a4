#include <bit>
#include <ostream>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/npy_writer.hpp"
#include "clackers/report/rows/rows.hpp"

namespace clackers::report {

void write_npy(record::RowSource& rows, std::ostream& out) {
  static_assert(std::endian::native == std::endian::little);
  auto* const numbers = rows.numbers();
  if (numbers == nullptr)
    throw InputError("format npy: these rows hold text; allowed: rows of numbers. Use csv or json.",
                     "bad-syntax");
  std::vector<std::string> names;
  for (const auto& column : rows.columns()) names.push_back(column.name);
  out << npy_header(names, numbers->count());
  std::vector<double> values;
  while (out && numbers->next_block(values))
    out.write(reinterpret_cast<const char*>(values.data()),
              std::streamsize(values.size() * sizeof(double)));
}

}  // namespace clackers::report
