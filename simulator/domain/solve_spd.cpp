#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "simulator/domain/message.hpp"

namespace brisance::simulator {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

std::optional<std::vector<double>> solve_whole(const SystemRows& all, double tolerance) {
  const auto size = static_cast<Eigen::Index>(all.right_side.size());
  Matrix matrix(size, size);
  matrix.setFromTriplets(all.entries.begin(), all.entries.end());
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(tolerance);
  solver.compute(matrix);
  const Eigen::VectorXd solution = solver.solve(Eigen::Map<const Eigen::VectorXd>(all.right_side.data(), size));
  if (solver.info() != Eigen::Success) return std::nullopt;
  return std::vector<double>(solution.begin(), solution.end());
}

}  // namespace

std::optional<std::vector<double>> Domain::solve_spd(const SystemRows& mine, double tolerance) {
  if (size() == 1) return solve_whole(mine, tolerance);
  std::vector<Message> messages(static_cast<std::size_t>(size()));
  append(messages[0], mine.entries), append(messages[0], mine.right_side);
  const std::vector<Message> rows = exchange(std::move(messages));

  // From rank 0 to each: whether there is a solution, and its part of it.
  std::vector<Message> answers(static_cast<std::size_t>(size()));
  if (rank() == 0) {
    SystemRows all;
    std::vector<std::size_t> of_rank;
    for (const Message& message : rows) {
      MessageReader reader(message);
      const auto entries = reader.read_list<SystemRows::Entry>();
      const auto right_side = reader.read_list<double>();
      all.entries.insert(all.entries.end(), entries.begin(), entries.end());
      all.right_side.insert(all.right_side.end(), right_side.begin(), right_side.end());
      of_rank.push_back(right_side.size());
    }
    const std::optional<std::vector<double>> solution = solve_whole(all, tolerance);
    std::size_t first = 0;
    for (std::size_t r = 0; r < answers.size(); ++r) {
      append(answers[r], solution.has_value());
      if (solution) append(answers[r], solution->data() + first, of_rank[r]);
      first += of_rank[r];
    }
  }
  const Message answer = exchange(std::move(answers)).front();
  MessageReader reader(answer);
  if (!reader.read<bool>()) return std::nullopt;
  std::vector<double> part(mine.right_side.size());
  reader.read(part.data(), part.size());
  return part;
}

}  // namespace brisance::simulator
