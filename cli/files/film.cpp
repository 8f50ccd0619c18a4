#include "cli/files/film.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/jobs/removed_on_exit.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/report/html/film.hpp"
#include "clackers/solvers/process.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/progress_line.hpp"

namespace clackers::cli {
namespace {

constexpr int frames_per_second = 25;
// A motion is shown in its own time, but not for less or more [s].
constexpr double shortest = 4.0, longest = 12.0;
constexpr int webm_pixels = 1000, gif_pixels = 640;

// Shares of the work, measured.
constexpr double drawn = 0.02, rendered = 0.9;

// Removed with all that it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() : removed_(made()) {}
  ~TemporaryFolder() { remove_path(path().c_str()); }
  const std::string& path() const { return removed_.path(); }

 private:
  static std::string made() {
    auto name = (std::filesystem::temp_directory_path() / "clackers-film-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw FileError(fmt::format("--film: no folder can be made in {}. Set TMPDIR to one that can "
                                  "be written to.",
                                  std::filesystem::temp_directory_path().string()),
                      "cannot-write");
    return name;
  }
  RemovedOnExit removed_;
};

void run_in(const std::string& folder, const std::string& command, const std::string& package) {
  using End = solvers::ProcessResult::End;
  constexpr double limit = 600.0;
  const auto result = solvers::run_process({command, folder, limit, {}}, &interrupt_flag());
  if (result.end == End::interrupted) throw Interrupted();
  if (result.end == End::exited && result.status == 0) return;
  const auto program = command.substr(0, command.find(' '));
  constexpr int not_found = 127;  // of the shell
  if (result.end == End::exited && result.status == not_found)
    throw FileError(fmt::format("--film: there is no program {} on the PATH. Install it (Debian: "
                                "apt-get install {}) and run the command again.",
                                program, package),
                    "no-renderer");
  throw FileError(fmt::format("--film: {} failed. It printed: {}", program,
                              result.printed.substr(0, result.printed.find('\n'))),
                  "render-failed");
}

}  // namespace

Film::Film(const std::string& path, const CommonOptions& common, OnInterrupt on_interrupt)
    : quiet_(common.quiet) {
  if (path.empty()) return;
  const auto ending = std::filesystem::path(path).extension();
  if (ending != ".webm" && ending != ".gif")
    refuse("clackers", "--film", path, "a film: FILE.webm or FILE.gif", {}, "bad-syntax");
  file_ = std::make_unique<OutputFile>(path, on_interrupt);
}

bool Film::write(const record::CaseRecord& problem) {
  return try_to_write([&] {
    make(problem);
    file_->commit();
    if (!quiet_) note(fmt::format("Wrote {}", file_->path()));
  });
}

void Film::make(const record::CaseRecord& problem) {
  const auto files = report::film_files(problem);
  if (files.empty())
    throw FileError(fmt::format("--film: {} has no drawing that moves. All cases with one have an "
                                "animation in their page: --report.",
                                problem.problem.name),
                    "no-renderer");
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) write_file(folder.path() + '/' + name, text);
  const bool is_gif = std::filesystem::path(file_->path()).extension() == ".gif";
  const auto count = std::size_t(
      std::lround(frames_per_second * std::clamp(problem.problem.end, shortest, longest)));
  ProgressLine progress("film", quiet_);
  run_in(folder.path(),
         fmt::format("node film.js . {} {}", count, is_gif ? gif_pixels : webm_pixels), "nodejs");
  std::atomic<std::size_t> done = 0;
  run_all(count, thread_count(0), [&](std::size_t i) {
    run_in(folder.path(), fmt::format("rsvg-convert -b white -o {0:05}.png {0:05}.svg", i + 1),
           "librsvg2-bin");
    progress.report(drawn + (rendered - drawn) * double(++done) / double(count));
  });
  // A picture of the colours of all frames, then the frames in these.
  const std::string how =
      is_gif
          ? "-filter_complex 'split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none'"
          : "-c:v libvpx-vp9 -pix_fmt yuv420p -crf 32 -b:v 0 -deadline realtime -cpu-used 6";
  const std::string made = is_gif ? "film.gif" : "film.webm";
  run_in(folder.path(),
         fmt::format("ffmpeg -v error -y -framerate {} -i %05d.png {} {}", frames_per_second, how,
                     made),
         "ffmpeg");
  file_->stream() << read_file(folder.path() + '/' + made, {}, longest_file);
}

void add_film_option(Command& command, std::string& path) {
  command
      .add_option(
          "--film", path,
          "Also make a film of the motion, exact and of the methods that are run beside it; "
          "by node, rsvg-convert and ffmpeg.")
      ->writes_file("FILE.webm|gif");
}

}  // namespace clackers::cli
