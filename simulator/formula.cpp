#include "simulator/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "models/input/diagnostics.hpp"

namespace brisance::simulator {

namespace {

/// One of muparser's, with what it reads when it evaluates.
struct Parser {
  mu::Parser parser;
  Vector position{1.0, 1.0, 1.0};
  double radius = 1.0, time = 1.0;
  std::size_t dimensions = 1;

  /// Throws mu::ParserError, at the first evaluation at the latest.
  Parser(const std::string& text, int dimensions_, bool with_time) : dimensions(static_cast<std::size_t>(dimensions_)) {
    std::fill(position.begin() + dimensions_, position.end(), 0.0);
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t a = 0; a < dimensions; ++a) parser.DefineVar(std::string(1, "xyz"[a]), &position[a]);
    parser.DefineVar("r", &radius);
    if (with_time) parser.DefineVar("t", &time);
    parser.SetExpr(text);
  }
  Parser(const Parser&) = delete;  // muparser holds pointers to the members
};

}  // namespace

/// A parser for each thread that evaluates at the same time as others.
struct Formula::Parsers {
  struct alignas(64) Slot {  // a cache line: threads do not wait for each other's
    std::atomic_flag in_use;
    std::unique_ptr<Parser> parser;
  };
  std::array<Slot, 64> slots;

  /// f(slot) on a slot that is no other thread's meanwhile; a thread finds the same one again unless another has taken it.
  template <class F>
  double with_own(F&& f) {
    std::size_t n = std::hash<std::thread::id>{}(std::this_thread::get_id()) % slots.size();
    while (slots[n].in_use.test_and_set(std::memory_order_acquire)) n = (n + 1) % slots.size();
    struct Release {
      std::atomic_flag& flag;
      ~Release() { flag.clear(std::memory_order_release); }
    } const release{slots[n].in_use};
    return f(slots[n]);
  }
};

namespace {

/// What muparser says, as a part of a sentence.
std::string reason(const mu::ParserError& error) {
  std::string text = error.GetMsg();
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// An assignment would change what the formula is given.
bool assigns(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool second = i > 0 && (text[i - 1] == '=' || text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!');
    const bool first = i + 1 < text.size() && text[i + 1] == '=';
    if (!first && !second) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string_view> formula_names(int dimensions, bool with_time) {
  std::vector<std::string_view> names = {"x", "y", "z"};
  names.resize(static_cast<std::size_t>(dimensions));
  names.push_back("r");
  if (with_time) names.push_back("t");
  names.push_back("pi");
  return names;
}

std::vector<std::string> formula_functions() {
  std::vector<std::string> names;
  const mu::Parser parser;
  for (const auto& [name, callback] : parser.GetFunDef()) names.push_back(name);
  return names;
}

Formula::Formula(std::string text, int dimensions, bool with_time)
    : text_(std::move(text)), dimensions_(dimensions), with_time_(with_time), parsers_(std::make_unique<Parsers>()) {
  const std::vector<std::string_view> names = formula_names(dimensions, with_time);
  const auto fail = [&](const std::string& what, const std::string& hint = "") {
    throw std::invalid_argument(in_quotes(text_) + " is no formula: " + what + "; it may speak of " + listed(names) + hint);
  };
  try {
    Parser first(text_, dimensions_, with_time_);
    first.parser.Eval();
    if (first.parser.GetNumResults() != 1) fail("it has more than one result");
  } catch (const mu::ParserError& error) {
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN) fail(reason(error));
    const std::string token = error.GetToken();
    const auto end = std::find_if(token.begin(), token.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
    const std::string unknown(token.begin(), end == token.begin() ? token.end() : end);
    const std::vector<std::string> functions = formula_functions();
    std::vector<std::string_view> known = names;
    known.insert(known.end(), functions.begin(), functions.end());
    fail(in_quotes(unknown) + " is unknown", did_you_mean(unknown, known));
  }
  if (assigns(text_)) fail("it would change a value; compare by ==");
}

Formula::~Formula() = default;

double Formula::operator()(const Vector& position, double time) const {
  return parsers_->with_own([&](Parsers::Slot& slot) {
    try {
      if (!slot.parser) slot.parser = std::make_unique<Parser>(text_, dimensions_, with_time_);
      Parser& own = *slot.parser;
      std::copy_n(position.begin(), own.dimensions, own.position.begin());
      own.radius = magnitude(own.position), own.time = time;
      return own.parser.Eval();
    } catch (const mu::ParserError&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  });
}

}  // namespace brisance::simulator
