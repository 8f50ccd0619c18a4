#include "clackers/paper/render.hpp"

#include <fmt/format.h>

#include "clackers/paper/assets.hpp"
#include "clackers/paper/files.hpp"
#include "clackers/paper/process.hpp"
#include "clackers/report/assets.hpp"

namespace clackers::paper {
namespace {

constexpr auto kept = "The numbers (csv) and specifications (vl.json) were written all the same.";

Missing no_program(const std::string& program, const std::string& what,
                   const std::string& package) {
  return {fmt::format("paper: {} are missing: there is no program {} on the PATH. Install it "
                      "(Debian: apt-get install {}) and run the command again. {}",
                      what, program, package, kept),
          "no-renderer"};
}

Missing failed(const std::string& program, const std::string& what, const Ended& how) {
  const auto line = how.messages.substr(0, how.messages.find('\n'));
  return {fmt::format("paper: {} are missing: {} failed with exit code {}{}{}. {}", what, program,
                      how.code, line.empty() ? "" : ": ", line, kept),
          "render-failed"};
}

// What node needs beside the specifications, gone when done.
class Workshop {
 public:
  explicit Workshop(const std::filesystem::path& folder) : folder_(folder / ".render") {
    make_folder(folder_);
    write_file(folder_ / "vega.min.js", report::assets::vega_min_js);
    write_file(folder_ / "vega-lite.min.js", report::assets::vega_lite_min_js);
    write_file(folder_ / "render.js", assets::render_js);
  }
  ~Workshop() {
    // A lack of memory or of descriptors may have passed at the second try.
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
    if (error) std::filesystem::remove_all(folder_, error);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  std::string file(const char* name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace

std::vector<Missing> render(const std::filesystem::path& folder,
                            const std::vector<std::string>& names) {
  const Workshop workshop(folder);
  std::vector<std::string> node{"node", workshop.file("render.js"), folder.string()};
  node.insert(node.end(), names.begin(), names.end());
  const auto drawn = run_program(node, workshop.file("messages"));
  constexpr auto pictures = "pictures (svg, pdf)", prints = "prints (pdf)";
  if (!drawn.found) return {no_program("node", pictures, "nodejs")};
  if (drawn.code != 0) return {failed("node", pictures, drawn)};
  for (const auto& name : names) {
    const auto base = (folder / name).string();
    const auto printed =
        run_program({"rsvg-convert", "-f", "pdf", "-o", base + ".pdf", base + ".svg"},
                    workshop.file("messages"));
    if (!printed.found) return {no_program("rsvg-convert", prints, "librsvg2-bin")};
    if (printed.code != 0) return {failed("rsvg-convert", prints, printed)};
  }
  return {};
}

}  // namespace clackers::paper
