#pragma once
// Everything the simulation knows about other processes. One process is the default and says nothing.

#include <cstddef>
#include <memory>
#include <vector>

namespace brisance::simulator {

using Message = std::vector<std::byte>;

class Domain {
 public:
  virtual ~Domain() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Sends messages[r] to rank r and returns what each rank r sent here. Every rank calls it, with one message for each rank.
  virtual std::vector<Message> exchange(std::vector<Message> messages) = 0;
  /// The largest value of all ranks.
  virtual double maximum(double mine) = 0;
};

std::unique_ptr<Domain> single_process();

}  // namespace brisance::simulator
