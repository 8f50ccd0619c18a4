#include "cli/commands/generate.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "clackers/base/error.hpp"
#include "cli/files/output_file.hpp"
#include "cli/help/completion.hpp"
#include "cli/help/manual_page.hpp"

namespace clackers::cli {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::error_code problem;
  std::filesystem::create_directories(path.parent_path(), problem);
  // What is wrong with the folder, the file will say.
  OutputFile file(path.string(), OnInterrupt::stop);
  file.stream() << text;
  file.commit();
}

}  // namespace

void generate_shell_files(std::span<const Reference> references, const std::string& folder) {
  const std::filesystem::path share = folder;
  for (std::size_t i = 0; i < references.size(); ++i)
    write(share / "man/man1" / (manual_page_name(references[i]) + ".1"),
          manual_page(references, i));
  write(share / "bash-completion/completions/clackers", bash_completion(references));
  write(share / "zsh/site-functions/_clackers", zsh_completion(references));
}

}  // namespace clackers::cli
