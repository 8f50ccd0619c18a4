#include "clackers/input/table.hpp"

#include <algorithm>
#include <cctype>

#include "clackers/base/error.hpp"
#include "clackers/base/files/input_file.hpp"
#include "clackers/input/joined_table.hpp"
#include "clackers/input/numbers/number_table.hpp"
#include "clackers/input/results/result_table.hpp"
#include "clackers/input/text/text_table.hpp"

namespace clackers::input {

void Table::refuse_not_finite(std::size_t column, std::string_view shown) const {
  refuse(place(), names_[column], shown, "a finite number that a double can hold",
         "The run that wrote it may have left the range of finite numbers.", "not-finite");
}

std::unique_ptr<Table> open_table(const Source& source, const std::vector<std::string>& names,
                                  TableKind kind, const std::atomic<bool>* interrupt,
                                  const ResultChoice& choice) {
  if (const auto* columns = std::get_if<NumberColumns>(&source))
    return std::make_unique<NumberTable>(*columns, names, kind, interrupt);
  const auto& path = std::get<std::string>(source);
  if (const auto paths = joined_paths(path); paths.size() > 1) {
    std::vector<std::unique_ptr<Table>> tables;
    for (const auto& own : joined_names(path, names, paths.size()))
      tables.push_back(open_table(paths[tables.size()], own, kind, interrupt, choice));
    return std::make_unique<JoinedTable>(path, std::move(tables));
  }
  InputFile file(path, interrupt);
  if (kind == TableKind::history)
    if (const auto* reader = result_reader_of(file, choice))
      return std::make_unique<ResultTable>(std::move(file), *reader, choice, names);
  if (file.first_bytes(npy_magic.size()) == npy_magic)
    return std::make_unique<NumberTable>(NpyFile(std::move(file)), names, kind, interrupt);
  return std::make_unique<TextTable>(std::move(file), names, kind);
}

std::string plain_name(std::string_view text) {
  const auto bracket = text.find_first_of("[(");
  if (bracket != std::string_view::npos && bracket > 0) text = text.substr(0, bracket);
  std::string name(trimmed(text));
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace clackers::input
