#include "simulator/domain/domain.hpp"

namespace brisance::simulator {
namespace {

class SingleProcess final : public Domain {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::vector<Message> exchange(std::vector<Message> messages) override { return messages; }
  double maximum(double mine) override { return mine; }
};

}  // namespace

std::unique_ptr<Domain> single_process() {
  return std::make_unique<SingleProcess>();
}

}  // namespace brisance::simulator
