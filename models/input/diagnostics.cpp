#include "models/input/diagnostics.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <utility>

namespace brisance {
namespace {

constexpr std::size_t most_problems_shown = 100;
constexpr std::size_t longest_quotation = 60;
constexpr std::size_t longest_word = 64;  // no key or name is longer; bounds the work of comparing words

std::string lines_of(const std::vector<Problem>& problems) {
  std::string lines;
  for (std::size_t i = 0; i < std::min(problems.size(), most_problems_shown); ++i) {
    if (i > 0) lines += '\n';
    lines += problems[i].text();
  }
  if (problems.size() > most_problems_shown)
    lines += "\n... and " + std::to_string(problems.size() - most_problems_shown) + " more problems";
  return lines;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Damerau-Levenshtein distance (optimal string alignment): F. J. Damerau, Commun. ACM 7 (1964) 171-176. A digit for
/// another character counts twice: numbers tell names apart.
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before_last(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : is_digit(a[i - 1]) || is_digit(b[j - 1]) ? 2 : 1;
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

/// The first letters of the words of a name: "jwl" of "jones_wilkins_lee".
std::string initials(std::string_view name) {
  std::string letters;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] != '_' && (i == 0 || name[i - 1] == '_')) letters += name[i];
  return lower_case(letters);
}

/// The names that a word is the beginning of, or the initials, if they are few: "nadal" of "nadal_lepoac".
std::vector<std::string_view> begun_by(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr std::size_t shortest = 3, most = 3;
  std::vector<std::string_view> found;
  if (word.size() < shortest || word.size() > longest_word) return found;
  for (const std::string_view candidate : candidates)
    if ((lower_case(candidate).starts_with(lower_case(word)) || initials(candidate) == lower_case(word)) &&
        std::find(found.begin(), found.end(), candidate) == found.end())
      found.push_back(candidate);
  if (found.size() > most) found.clear();
  return found;
}

std::string shortened(std::string_view text) {
  std::string_view shown = text.substr(0, longest_quotation);
  if (shown.size() < text.size()) {
    // Do not cut a UTF-8 character: drop its continuation bytes, then its head.
    while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xC0) == 0x80) shown.remove_suffix(1);
    if (!shown.empty() && static_cast<unsigned char>(shown.back()) >= 0xC0) shown.remove_suffix(1);
  }
  std::string result;
  for (const char c : shown) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return shown.size() < text.size() ? result + "..." : result;
}

}  // namespace

std::string Problem::text() const {
  std::string result = file;
  if (line > 0) result += ':' + std::to_string(line) + ':' + std::to_string(column);
  if (!result.empty()) result += ": ";
  if (!key.empty()) result += key + ": ";
  return result + what;
}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(lines_of(problems)), problems_(std::move(problems)) {}

std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > longest_word) return std::nullopt;
  std::optional<std::string_view> best;
  std::pair<int, bool> smallest;
  for (const std::string_view candidate : candidates) {
    // Twice the distance between lower-case forms, plus one if only the case differs somewhere.
    const int folded = edit_distance(lower_case(word), lower_case(candidate));
    const int distance = 2 * folded + (edit_distance(word, candidate) > folded ? 1 : 0);
    // A word may be wrong in a third of its letters and in one at least, but a name of one letter is no other one.
    const int longest = static_cast<int>(std::max(word.size(), candidate.size()));
    const int allowed = 2 * (longest > 1 ? std::max(longest / 3, 1) : 0) + 1;
    const std::pair rank(distance, word.size() != candidate.size());  // of two as near, the one that is as long
    if (distance <= allowed && (!best || rank < smallest)) best = candidate, smallest = rank;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  std::vector<std::string_view> guesses;
  if (const auto guess = nearest(word, candidates))
    guesses.push_back(*guess);
  else
    guesses = begun_by(word, candidates);
  if (guesses.empty()) return "";
  std::string text;
  for (const std::string_view guess : guesses) text += (text.empty() ? "\"" : " or \"") + std::string(guess) + '"';
  return "; did you mean " + text + '?';
}

std::string in_quotes(std::string_view text) {
  return '"' + shortened(text) + '"';
}

std::string printable(std::string_view text) {
  return text.empty() ? "\"\"" : shortened(text);
}

std::string listed(std::span<const std::string_view> words) {
  std::string result;
  for (const std::string_view word : words) {
    if (!result.empty()) result += ", ";
    result += word;
  }
  return result;
}

std::string shortest_text(double number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return std::string(buffer.data(), end);
}

}  // namespace brisance
