#pragma once
// Several ranks within one process: each a thread with a simulation of its own, messages through a shared mailbox. What holds
// here for the bits of a run holds for ranks that are processes.

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "simulator/domain/domain.hpp"

namespace brisance::simulator {

class VirtualRanks {
 public:
  explicit VirtualRanks(int ranks)
      : ranks_(ranks), barrier_(ranks), box_(static_cast<std::size_t>(ranks)), values_(static_cast<std::size_t>(ranks)) {}

  /// Runs work(domain) on every rank, one OpenMP thread each, and waits for all. Rethrows what the lowest rank threw.
  static void run(int ranks, const std::function<void(std::shared_ptr<Domain>)>& work) {
    VirtualRanks all(ranks);
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(ranks));
    std::vector<std::thread> threads;
    for (int r = 0; r < ranks; ++r)
      threads.emplace_back([&, r] {
        omp_set_num_threads(1);
        try {
          work(std::make_shared<Rank>(all, r));
        } catch (...) {
          thrown[static_cast<std::size_t>(r)] = std::current_exception();
          all.broken_ = true;
          all.barrier_.arrive_and_drop();
        }
      });
    for (std::thread& t : threads) t.join();
    for (const std::exception_ptr& e : thrown)
      if (e) std::rethrow_exception(e);
  }

 private:
  class Rank final : public Domain {
   public:
    Rank(VirtualRanks& all, int rank) : all_(all), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return all_.ranks_; }
    std::vector<Message> exchange(std::vector<Message> messages) override {
      all_.box_[static_cast<std::size_t>(rank_)] = std::move(messages);
      all_.meet();
      std::vector<Message> received;
      for (const std::vector<Message>& from : all_.box_) received.push_back(from[static_cast<std::size_t>(rank_)]);
      all_.meet();
      return received;
    }
    double maximum(double mine) override {
      all_.values_[static_cast<std::size_t>(rank_)] = mine;
      all_.meet();
      const double largest = *std::max_element(all_.values_.begin(), all_.values_.end());
      all_.meet();
      return largest;
    }

   private:
    VirtualRanks& all_;
    int rank_;
  };

  /// A rank that has thrown never comes; the others must not wait for it.
  void meet() {
    barrier_.arrive_and_wait();
    if (broken_) throw std::runtime_error("another rank has failed");
  }

  int ranks_;
  std::barrier<> barrier_;
  std::atomic<bool> broken_ = false;
  std::vector<std::vector<Message>> box_;
  std::vector<double> values_;
};

}  // namespace brisance::simulator
