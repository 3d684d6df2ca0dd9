#pragma once
// Everything the simulation knows about other processes. One process is the default and says nothing.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace brisance::simulator {

using Message = std::vector<std::byte>;

/// The rows of a symmetric positive definite matrix, and of the right side, that one rank has. Those of all ranks follow each
/// other in the order of the ranks, and are numbered from 0.
struct SystemRows {
  struct Entry {
    int row_number, column_number;
    double amount;
    int row() const { return row_number; }
    int col() const { return column_number; }
    double value() const { return amount; }
  };
  std::vector<Entry> entries;  // added up where there are several in one place
  std::vector<double> right_side;
};

class Domain {
 public:
  virtual ~Domain() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Sends messages[r] to rank r and returns what each rank r sent here. Every rank calls it, with one message for each rank.
  virtual std::vector<Message> exchange(std::vector<Message> messages) = 0;
  /// The largest value of all ranks.
  virtual double maximum(double mine) = 0;
  /// This rank's part of the solution, by conjugate gradients up to a residual of `tolerance` times the right side; none, on
  /// any rank, where they do not converge. As it is here rank 0 solves for all: the same bits for any number of ranks.
  virtual std::optional<std::vector<double>> solve_spd(const SystemRows& mine, double tolerance);
};

std::unique_ptr<Domain> single_process();

}  // namespace brisance::simulator
