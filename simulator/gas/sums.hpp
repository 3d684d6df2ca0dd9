#pragma once
// Sums over all ranks that do not depend on how many there are.

#include <vector>

#include "simulator/domain/message.hpp"
#include "simulator/ledger.hpp"

namespace brisance::simulator::gas {

/// Adds up the blocks' numbers, so many a block. Ranks own the blocks in Morton order, so the blocks of all ranks follow each
/// other as those of one rank would.
inline std::vector<double> sum_of_ranks(const std::vector<double>& mine, std::size_t numbers, Domain& domain) {
  std::vector<Message> all{Message{}};
  append(all[0], mine.data(), mine.size());
  if (domain.size() > 1) all = all_gather(domain, all[0]);
  std::vector<CompensatedSum> sums(numbers);
  for (const Message& message : all)
    for (MessageReader reader(message); !reader.at_end();)
      for (CompensatedSum& sum : sums) sum.add(reader.read<double>());
  std::vector<double> total;
  for (const CompensatedSum& sum : sums) total.push_back(sum.value());
  return total;
}

}  // namespace brisance::simulator::gas
