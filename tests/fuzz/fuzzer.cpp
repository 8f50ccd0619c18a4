// libFuzzer's entries: clackers_fuzz TARGET [options and folders of libFuzzer].
#include <cstdlib>
#include <cstring>
#include <exception>

#include "target.hpp"

namespace {

const clackers::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

int LLVMFuzzerInitialize(int* argc, char*** argv) {
  std::set_terminate(std::abort);  // the command's handler would keep the input from libFuzzer
  clackers::fuzz::every_output = false;
  chosen = &clackers::fuzz::target(*argc > 1 ? (*argv)[1] : "");
  // libFuzzer does not see the target's name.
  for (int i = 1; i < *argc; ++i) (*argv)[i] = (*argv)[i + 1];
  --*argc;
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clackers::fuzz::run_input(*chosen, {reinterpret_cast<const char*>(data), size});
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room,
                                    unsigned seed) {
  if (chosen->mutate != nullptr && seed % 2 == 0)
    return chosen->mutate(reinterpret_cast<char*>(data), size, room, seed / 2);
  return LLVMFuzzerMutate(data, size, room);
}
}
