#pragma once
// Problems found in input files. They are collected, so that a user sees all of them at once, each as
//   file:line:column: key: what is wrong; what is allowed; did you mean

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

/// One thing that is wrong with the input. Empty or zero members are left out of the text.
struct Problem {
  std::string file;
  int line = 0;
  int column = 0;
  std::string key;
  std::string what;

  std::string text() const;
};

/// Thrown when input cannot be used. what() is one line per problem; programs print it and exit with code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// The words that come closest to `word` by insertions, deletions, replacements and swaps of neighbours, if one is near
/// enough to be what was meant. Letter case counts less than a letter.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates);

/// `; did you mean "..."?` with the nearest candidate, or with those that the word is the beginning or the initials of; or
/// nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// Text of the user in quotes, shortened and with unprintable bytes replaced, for messages.
std::string in_quotes(std::string_view text);

/// The same without quotes, for keys; "" stands for an empty one.
std::string printable(std::string_view text);

/// The words with commas between them.
std::string listed(std::span<const std::string_view> words);

/// The shortest decimal text that reads back to the same number.
std::string shortest_text(double number);

}  // namespace brisance
