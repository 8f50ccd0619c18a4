#include "paper/rendering/render.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/report/assets.hpp"
#include "paper/rendering/assets.hpp"
#include "paper/rendering/files.hpp"

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
    make_folder(folder_);
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
                                 const std::string& messages, const std::atomic<bool>* interrupt,
                                 std::chrono::seconds limit) {
  std::vector<char*> argv;
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  ::posix_spawn_file_actions_init(&streams);
  ::posix_spawn_file_actions_addopen(&streams, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&streams, 1, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&streams, 2, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, argv.front(), &streams, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&streams);
  if (error == ENOENT || error == EACCES) return std::nullopt;
  if (error != 0)
    throw FileError("paper: cannot start " + arguments.front() + ": " + std::strerror(error) + ".",
                    "render-failed");
  const auto end = std::chrono::steady_clock::now() + limit;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if ((interrupt != nullptr && *interrupt) || std::chrono::steady_clock::now() > end)
      ::kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return Ended{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
               read_file(messages)};
}

std::vector<Missing> render(const std::filesystem::path& folder,
                            const std::vector<std::string>& names,
                            const std::atomic<bool>* interrupt) {
  const RenderFolder work(folder);
  const auto messages = work.file("messages");
  std::vector<std::string> node{"node", work.file("render.js"), folder.string()};
  node.insert(node.end(), names.begin(), names.end());
  constexpr auto pictures = "pictures (svg, pdf)", prints = "prints (pdf)";
  const auto drawn = run_program(node, messages, interrupt);
  if (!drawn) return {no_program("node", pictures, "nodejs")};
  if (drawn->code != 0) return {failed("node", pictures, *drawn)};
  for (const auto& name : names) {
    const auto base = (folder / name).string();
    const auto printed = run_program(
        {"rsvg-convert", "-f", "pdf", "-o", base + ".pdf", base + ".svg"}, messages, interrupt);
    if (!printed) return {no_program("rsvg-convert", prints, "librsvg2-bin")};
    if (printed->code != 0) return {failed("rsvg-convert", prints, *printed)};
  }
  return {};
}

}  // namespace clackers::paper
