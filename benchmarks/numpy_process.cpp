#include "benchmarks/numpy_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace clackers::benchmarks {

NumpyProcess::NumpyProcess(const std::string& script) {
  const char* chosen = std::getenv("CLACKERS_PYTHON");
  const char* python = chosen != nullptr ? chosen : "/usr/bin/python3";
  int in[2], out[2];
  if (pipe(in) != 0 || pipe(out) != 0) return;
  std::signal(SIGPIPE, SIG_IGN);
  process_ = fork();
  if (process_ == 0) {
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    for (const int end : {in[0], in[1], out[0], out[1]}) close(end);
    execlp(python, python, script.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(in[0]);
  close(out[1]);
  to_ = fdopen(in[1], "w");
  from_ = fdopen(out[0], "r");
  version_ = ask("version");
}

NumpyProcess::~NumpyProcess() {
  if (to_ != nullptr) std::fclose(to_);
  if (from_ != nullptr) std::fclose(from_);
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

std::string NumpyProcess::ask(const std::string& line) {
  if (to_ == nullptr || from_ == nullptr) return {};
  std::fputs((line + '\n').c_str(), to_);
  std::fflush(to_);
  char answer[256];
  if (std::fgets(answer, sizeof answer, from_) == nullptr) return {};
  std::string text = answer;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace clackers::benchmarks
