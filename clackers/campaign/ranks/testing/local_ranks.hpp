#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "clackers/campaign/ranks/transport.hpp"

namespace clackers::campaign::test {

/// Ranks in one process, a transport each: messages go through queues.
class LocalRanks {
 public:
  explicit LocalRanks(int size) {
    for (int rank = 0; rank < size; ++rank) ranks_.push_back(std::make_unique<Rank>(*this, rank));
  }

  Transport& operator[](int rank) { return *ranks_.at(static_cast<std::size_t>(rank)); }

 private:
  class Rank : public Transport {
   public:
    Rank(LocalRanks& all, int rank) : all_(all), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(all_.ranks_.size()); }

    void send(int to, const Message& message) override {
      auto& receiver = *all_.ranks_.at(static_cast<std::size_t>(to));
      const std::lock_guard lock(receiver.mutex_);
      receiver.arrived_.push_back({rank_, message});
    }

    std::optional<Envelope> poll() override {
      const std::lock_guard lock(mutex_);
      if (arrived_.empty()) return std::nullopt;
      auto envelope = std::move(arrived_.front());
      arrived_.pop_front();
      return envelope;
    }

   private:
    LocalRanks& all_;
    int rank_;
    std::mutex mutex_;
    std::deque<Envelope> arrived_;
  };

  std::vector<std::unique_ptr<Rank>> ranks_;
};

}  // namespace clackers::campaign::test
