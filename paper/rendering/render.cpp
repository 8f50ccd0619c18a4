#include "paper/rendering/render.hpp"

#include <fmt/format.h>

#include <system_error>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/solvers/process.hpp"
#include "paper/rendering/assets.hpp"

namespace clackers::paper {
namespace {

constexpr auto kept = "The numbers (csv) and specifications (vl.json) were written all the same.";

Missing no_program(const std::string& program, const std::string& what,
                   const std::string& package) {
  return {
      fmt::format(
          "paper: {} are missing: there is no program {} on the PATH. Install it (Debian: apt-get install {}) and run the command again. {}",
          what, program, package, kept),
      "no-renderer"};
}

Missing failed(const std::string& program, const std::string& what, const Ended& how) {
  const auto line = how.messages.substr(0, how.messages.find('\n'));
  return {fmt::format("paper: {} are missing: {} failed with exit code {}{}{}. {}", what, program,
                      how.code, line.empty() ? "" : ": ", line, kept),
          "render-failed"};
}

// What node needs beside the specifications, removed at the end.
class RenderFolder {
 public:
  explicit RenderFolder(const std::filesystem::path& folder) : folder_(folder / ".render") {
    std::filesystem::create_directory(folder_);
    write_file(folder_ / "vega.min.js", report::assets::vega_min_js);
    write_file(folder_ / "vega-lite.min.js", report::assets::vega_lite_min_js);
    write_file(folder_ / "render.js", assets::render_js);
  }
  ~RenderFolder() {
    // A lack of memory or of descriptors may have passed at the second try.
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
    if (error) std::filesystem::remove_all(folder_, error);
  }
  RenderFolder(const RenderFolder&) = delete;
  RenderFolder& operator=(const RenderFolder&) = delete;
  std::string file(const char* name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace

std::optional<Ended> run_program(const std::vector<std::string>& arguments,
                                 const std::atomic<bool>* interrupt, std::chrono::seconds limit) {
  using End = solvers::ProcessResult::End;
  const auto result = solvers::run_process(
      {shell_line(arguments) + " >/dev/null", ".", double(limit.count()), {}}, interrupt);
  if (result.end == End::not_started)
    throw FileError(fmt::format("paper: cannot start {}: {}.", arguments.front(),
                                std::generic_category().message(result.status)),
                    "render-failed");
  constexpr int not_executable = 126, not_found = 127, killed = 137;  // codes of the shell
  if (result.end == End::signalled) return Ended{128 + result.status, result.printed};
  if (result.end != End::exited) return Ended{killed, result.printed};
  if (result.status == not_executable || result.status == not_found) return std::nullopt;
  return Ended{result.status, result.printed};
}

std::vector<Missing> render(const std::filesystem::path& folder,
                            const std::vector<std::string>& names,
                            const std::atomic<bool>* interrupt) {
  const RenderFolder work(folder);
  std::vector<std::string> node{"node", work.file("render.js"), folder.string()};
  node.insert(node.end(), names.begin(), names.end());
  constexpr auto pictures = "pictures (svg, pdf)", prints = "prints (pdf)";
  const auto drawn = run_program(node, interrupt);
  if (!drawn) return {no_program("node", pictures, "nodejs")};
  if (drawn->code != 0) return {failed("node", pictures, *drawn)};
  for (const auto& name : names) {
    const auto base = (folder / name).string();
    const auto printed =
        run_program({"rsvg-convert", "-f", "pdf", "-o", base + ".pdf", base + ".svg"}, interrupt);
    if (!printed) return {no_program("rsvg-convert", prints, "librsvg2-bin")};
    if (printed->code != 0) return {failed("rsvg-convert", prints, *printed)};
  }
  return {};
}

}  // namespace clackers::paper
