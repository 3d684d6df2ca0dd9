#include "simulator/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "models/input/diagnostics.hpp"

namespace brisance::simulator {

struct Formula::Parser {
  mu::Parser parser;
  Vector position{1.0, 1.0, 1.0};
  double radius = 1.0, time = 1.0;
  std::size_t dimensions = 1;
  std::mutex in_use;
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

Formula::Formula(std::string text, int dimensions, bool with_time)
    : text_(std::move(text)), parser_(std::make_unique<Parser>()) {
  const std::vector<std::string_view> names = formula_names(dimensions, with_time);
  const auto fail = [&](const std::string& what, const std::string& hint = "") {
    throw std::invalid_argument(in_quotes(text_) + " is no formula: " + what + "; it may speak of " + listed(names) + hint);
  };
  mu::Parser& parser = parser_->parser;
  parser_->dimensions = static_cast<std::size_t>(dimensions);
  std::fill(parser_->position.begin() + dimensions, parser_->position.end(), 0.0);
  try {
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimensions); ++a)
      parser.DefineVar(std::string(1, "xyz"[a]), &parser_->position[a]);
    parser.DefineVar("r", &parser_->radius);
    if (with_time) parser.DefineVar("t", &parser_->time);
    parser.SetExpr(text_);
    parser.Eval();
    if (parser.GetNumResults() != 1) fail("it has more than one result");
  } catch (const mu::ParserError& error) {
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN) fail(reason(error));
    const std::string token = error.GetToken();
    const auto end = std::find_if(token.begin(), token.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
    const std::string unknown(token.begin(), end == token.begin() ? token.end() : end);
    std::vector<std::string> functions;
    for (const auto& [name, callback] : parser.GetFunDef()) functions.push_back(name);
    std::vector<std::string_view> known = names;
    known.insert(known.end(), functions.begin(), functions.end());
    fail(in_quotes(unknown) + " is unknown", did_you_mean(unknown, known));
  }
  if (assigns(text_)) fail("it would change a value; compare by ==");
}

Formula::~Formula() = default;

double Formula::operator()(const Vector& position, double time) const {
  const std::lock_guard lock(parser_->in_use);
  std::copy_n(position.begin(), parser_->dimensions, parser_->position.begin());
  parser_->radius = magnitude(parser_->position), parser_->time = time;
  try {
    return parser_->parser.Eval();
  } catch (const mu::ParserError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace brisance::simulator
