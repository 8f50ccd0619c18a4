#include "cli/cluster/mpi_transport.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"

#ifdef CLACKERS_HAS_MPI

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
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

// The kind of a message is its tag.
class Mpi : public MpiTransport {
 public:
  Mpi() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
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
    MPI_Send(buffer_.data(), static_cast<int>(buffer_.size()), MPI_BYTE, to,
             static_cast<int>(message.kind), MPI_COMM_WORLD);
  }

  std::optional<Envelope> poll() override {
    int arrived = 0, length = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
    if (!arrived) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &length);
    buffer_.resize(static_cast<std::size_t>(length));
    MPI_Recv(buffer_.data(), length, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    Envelope envelope{status.MPI_SOURCE, {static_cast<Message::Kind>(status.MPI_TAG)}};
    auto& message = envelope.message;
    std::memcpy(message.numbers.data(), buffer_.data(), sizeof message.numbers);
    message.text = buffer_.substr(sizeof message.numbers);
    return envelope;
  }

  void finish() override { MPI_Finalize(); }

 private:
  int rank_ = 0, size_ = 1;
  bool serialized_ = false;
  std::string buffer_;
};

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
