#include <memory>

#include "clackers/report/write.hpp"
#include "clackers/tables/listing.hpp"
#include "cli/command.hpp"
#include "cli/files/results.hpp"
#include "cli/options.hpp"

namespace clackers::cli {
namespace {

struct ExplainOptions {
  CommonOptions common;
  std::string code;
};

int run(const ExplainOptions& options) {
  Results results(options.common, OnInterrupt::stop);
  const auto sheet = tables::explain(options.code);
  record::SheetRows rows(sheet);
  report::write(rows, results.format(), results.stream(), results.style());
  results.finish();
  return 0;
}

}  // namespace

void add_explain(Grammar& root) {
  const auto options = std::make_shared<ExplainOptions>();
  auto* app = root.add_subcommand("explain", "[CODE]", "what a code in [brackets] means");
  set_help(*app,
           {.examples = "  clackers explain stagnating\n"
                        "  clackers explain\n",
            .about = "Explains a behaviour, a verdict or a code in [brackets], and what to do "
                     "about it. Without CODE it lists all.",
            .usage = "  clackers explain [CODE]\n"});
  app->add_option("CODE", options->code, "The word in brackets at the end of a message.");
  add_common_options(*app, options->common);
  app->run = [options](const std::string&) { return run(*options); };
}

}  // namespace clackers::cli
