#include "cli/files/output_stream.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "cli/files/paths.hpp"
#include "cli/interrupt.hpp"

namespace clackers::cli {

DescriptorBuffer::DescriptorBuffer(int descriptor, std::string name, OnInterrupt on_interrupt)
    : descriptor_(descriptor), name_(std::move(name)), on_interrupt_(on_interrupt) {
  setp(bytes_.data(), bytes_.data() + bytes_.size());
}

void DescriptorBuffer::rethrow_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type byte) {
  write_out();
  if (!traits_type::eq_int_type(byte, traits_type::eof())) sputc(traits_type::to_char_type(byte));
  return traits_type::not_eof(byte);
}

int DescriptorBuffer::sync() {
  write_out();
  return 0;
}

void DescriptorBuffer::write_out() {
  const char* from = pbase();
  const char* const end = pptr();
  // What cannot be written now is dropped: a later try would put it after a hole.
  setp(bytes_.data(), bytes_.data() + bytes_.size());
  rethrow_failure();
  try {
    while (from != end) {
      if (on_interrupt_ == OnInterrupt::stop && interrupt_flag()) throw Interrupted();
      const auto written = ::write(descriptor_, from, static_cast<std::size_t>(end - from));
      if (written >= 0) {
        from += written;
      } else if (errno == EPIPE) {
        throw BrokenPipe();
      } else if (errno != EINTR) {
        fail_to_write(name_, errno);
      }
    }
  } catch (...) {
    failure_ = std::current_exception();
    throw;
  }
}

OutputStream::OutputStream(int descriptor, std::string name, OnInterrupt on_interrupt)
    : std::ostream(nullptr), buffer_(descriptor, std::move(name), on_interrupt) {
  rdbuf(&buffer_);
  exceptions(std::ios::badbit);  // or else the stream would swallow what the buffer throws
}

void OutputStream::finish() {
  buffer_.rethrow_failure();
  flush();
}

}  // namespace clackers::cli
