// Statements of `campaign query`, through to what is printed.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "clackers/base/files/files.hpp"
#include "clackers/campaign/run.hpp"
#include "clackers/report/write.hpp"
#include "target.hpp"

namespace clackers::fuzz {
namespace {

// A campaign of two tasks, in a folder that goes when the program ends.
class Database {
 public:
  Database() {
    auto name = (std::filesystem::temp_directory_path() / "clackers-fuzz-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    const auto specification = campaign::Specification::from_toml(
        "methods = [\"rk4\"]\n[ladder]\nlevels = 1\n[[cases]]\ncase = \"stop\"\n"
        "set = { eta = [0.5, 1], t_end = 2 }\n",
        "spec.toml");
    auto store = campaign::Store::create_or_open(path(), specification);
    campaign::LocalTasks tasks(specification.tasks(), {}, 1);
    campaign::run_campaign(specification, store, tasks, {.jobs = 1});
  }
  ~Database() { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ + "/runs.db"; }
  std::string bytes() const { return read_file(path()); }

 private:
  std::string folder_;
};

}  // namespace

void query_database(std::string_view bytes) {
  static const Database database;
  static const auto before = database.bytes();
  // Set: a statement ends at the first look at it, which is longer than any of the corpus takes.
  static std::atomic<bool> interrupt = false;
  static const auto store = campaign::Store::open(database.path(), &interrupt);
  interrupt = true;
  constexpr report::Format formats[] = {report::Format::table, report::Format::csv,
                                        report::Format::json};
  std::ostringstream out;
  const auto rows = store.query(std::string(bytes));
  require(!rows->columns().empty(), "a statement that is taken has columns");
  report::write(*rows, formats[bytes.size() % 3], out);
  require(database.bytes() == before, "a query changes nothing");
}

}  // namespace clackers::fuzz
