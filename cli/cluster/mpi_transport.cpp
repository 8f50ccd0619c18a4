#include "cli/cluster/mpi_transport.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"

#ifdef CLACKERS_HAS_MPI

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <dlfcn.h>
#include <mpi.h>

#include <cstring>

#endif

namespace clackers::cli {
namespace {

void require_mpi(const campaign::Launch& launch) {
  if (launch.with_mpi) return;
  throw InputError(
      fmt::format("{} started {} processes without MPI, and each would compute the whole campaign. "
                  "Give it --mpi=pmix (srun --mpi=list names what it has), start one process, or "
                  "give each its own --shard i/n.",
                  launch.launcher, launch.ranks),
      "no-mpi");
}

#ifdef CLACKERS_HAS_MPI

using campaign::Message;

// MPI's library, loaded where it is asked for: a start with it takes a fifth longer.
class Library {
 public:
  Library() : handle_(dlopen(CLACKERS_HAS_MPI, RTLD_NOW | RTLD_GLOBAL)) {
    if (handle_ == nullptr)
      throw InputError(
          fmt::format("cannot load MPI: {}. Install it (Debian: libopenmpi3), start one "
                      "process, or give each its own --shard i/n.",
                      dlerror()),
          "no-mpi");
#ifdef OPEN_MPI
    world = static_cast<MPI_Comm>(dlsym(handle_, "ompi_mpi_comm_world"));
    bytes = static_cast<MPI_Datatype>(dlsym(handle_, "ompi_mpi_byte"));
#else
    world = MPI_COMM_WORLD;
    bytes = MPI_BYTE;
#endif
  }

  // The function of that name and type.
  template <class Function>
  Function* function(const char* name, Function*) const {
    return reinterpret_cast<Function*>(dlsym(handle_, name));
  }

  MPI_Comm world;
  MPI_Datatype bytes;

 private:
  void* handle_;  // stays open until the end of the program
};

#define CLACKERS_CALL(name, ...) \
  library_.function(#name, static_cast<decltype(&name)>(nullptr))(__VA_ARGS__)

// The kind of a message is its tag.
class Mpi : public MpiTransport {
 public:
  Mpi() {
    int provided = MPI_THREAD_SINGLE;
    CLACKERS_CALL(MPI_Init_thread, nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    CLACKERS_CALL(MPI_Comm_rank, library_.world, &rank_);
    CLACKERS_CALL(MPI_Comm_size, library_.world, &size_);
    serialized_ = provided >= MPI_THREAD_SERIALIZED;
  }

  bool serialized() const { return serialized_; }
  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, const Message& message) override {
    constexpr auto head = sizeof message.numbers;
    buffer_.resize(head + message.text.size());
    std::memcpy(buffer_.data(), message.numbers.data(), head);
    message.text.copy(buffer_.data() + head, message.text.size());
    CLACKERS_CALL(MPI_Send, buffer_.data(), static_cast<int>(buffer_.size()), library_.bytes, to,
                  static_cast<int>(message.kind), library_.world);
  }

  std::optional<Envelope> poll() override {
    int arrived = 0, length = 0;
    MPI_Status status;
    CLACKERS_CALL(MPI_Iprobe, MPI_ANY_SOURCE, MPI_ANY_TAG, library_.world, &arrived, &status);
    if (!arrived) return std::nullopt;
    CLACKERS_CALL(MPI_Get_count, &status, library_.bytes, &length);
    buffer_.resize(static_cast<std::size_t>(length));
    CLACKERS_CALL(MPI_Recv, buffer_.data(), length, library_.bytes, status.MPI_SOURCE,
                  status.MPI_TAG, library_.world, MPI_STATUS_IGNORE);
    Envelope envelope{status.MPI_SOURCE, {static_cast<Message::Kind>(status.MPI_TAG)}};
    auto& message = envelope.message;
    std::memcpy(message.numbers.data(), buffer_.data(), sizeof message.numbers);
    message.text = buffer_.substr(sizeof message.numbers);
    return envelope;
  }

  void finish() override { CLACKERS_CALL(MPI_Finalize); }

 private:
  Library library_;
  int rank_ = 0, size_ = 1;
  bool serialized_ = false;
  std::string buffer_;
};

#undef CLACKERS_CALL

#endif

}  // namespace

#ifdef CLACKERS_HAS_MPI

std::unique_ptr<MpiTransport> start_mpi(const campaign::Launch& launch) {
  require_mpi(launch);
  auto mpi = std::make_unique<Mpi>();
  if (mpi->size() == launch.ranks && mpi->serialized()) return mpi;
  const auto sentence = fmt::format(
      "{} started {} processes, but MPI sees {}{}: it is another MPI than the one this command was "
      "built with. Start it with that one's mpirun, or give each process its own --shard i/n.",
      launch.launcher, launch.ranks, mpi->size(),
      mpi->serialized() ? "" : " and allows no threads");
  mpi->finish();
  throw InputError(sentence, "no-mpi");
}

#else

std::unique_ptr<MpiTransport> start_mpi(const campaign::Launch& launch) {
  require_mpi(launch);
  throw InputError(
      fmt::format("{} started {} ranks, but this build has no MPI. Build with MPI installed "
                  "(Debian: libopenmpi-dev), start one process, or give each its own --shard i/n.",
                  launch.launcher, launch.ranks),
      "no-mpi");
}

#endif

}  // namespace clackers::cli
