#include <memory>

#include "clackers/tables/citations.hpp"
#include "cli/command.hpp"
#include "cli/files/output_stream.hpp"
#include "cli/files/paths.hpp"

namespace clackers::cli {
namespace {

struct CiteOptions {
  std::vector<std::string> names;
  std::string record;
};

int run(const CiteOptions& options) {
  std::vector<std::string> names, records;
  for (const auto& name : options.names)
    (name.ends_with(".json") ? records : names).push_back(name);
  if (!options.record.empty()) records.push_back(options.record);
  auto used = tables::used_of(names);
  const auto join = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const auto& record : records) {
    const auto more = tables::used_in(read_record(record, "cite"));
    join(used.methods, more.methods);
    join(used.cases, more.cases);
    join(used.others, more.others);
  }
  OutputStream out(1, "standard output", OnInterrupt::stop);
  out << tables::bibtex(used);
  out.finish();
  return 0;
}

}  // namespace

void add_cite(Grammar& root) {
  const auto options = std::make_shared<CiteOptions>();
  auto* app = root.add_subcommand("cite", "[NAME ...]", "BibTeX of what was used");
  set_help(*app,
           {.examples = "  clackers cite\n"
                        "  clackers cite newmark+penalty three-parameter\n"
                        "  clackers cite record.json > clackers.bib\n",
            .about = "Prints BibTeX: the program, the paper whose systems it makes exact, and the "
                     "sources of methods, as their cards name them. Comments name what uses each "
                     "entry, and what has none.",
            .usage = "  clackers cite [METHOD|CASE|FILE.json ...]\n"});
  app->add_option(
         "NAME", options->names,
         "Methods and cases (clackers list), and records of verify or check, by their ending .json.")
      ->option_text("METHOD|CASE|FILE.json");
  app->add_option("--record", options->record,
                  "A record of verify or check (--format json): all methods and cases in it.")
      ->reads_file("FILE.json");
  app->run = [options](const std::string&) { return run(*options); };
}

}  // namespace clackers::cli
