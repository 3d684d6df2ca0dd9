#include "simulator/output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "models/programs/files.hpp"
#include "simulator/output/hdf5_file.hpp"
#include "simulator/solid/motion.hpp"

namespace brisance::simulator {
namespace {

using Path = std::filesystem::path;
constexpr std::string_view format = "brisance checkpoint 3";

std::vector<double> numbers_of(const Extremes& e) {
  return {e.wave_speed, e.wave_and_motion, e.speed, e.volume_rate, e.filling};
}
Extremes extremes_from(const std::vector<double>& v) {
  return {v.at(0), v.at(1), v.at(2), v.at(3), v.at(4)};
}

/// Calls f(part) for every part of the ledger that has a fixed size, and then for the accounts of the boundaries.
template <class AnyLedger, class F>
void for_each_part(AnyLedger& ledger, F&& f) {
  f(ledger.initial), f(ledger.initial_internal), f(ledger.state), f(ledger.peak_kinetic);
  f(ledger.internal_force), f(ledger.external), f(ledger.transfer), f(ledger.filter), f(ledger.filter_heat),
      f(ledger.advection);
  f(ledger.outflow), f(ledger.outflow_internal), f(ledger.outflow_work), f(ledger.outflow_mass);
  for (auto& account : ledger.boundary) f(account);
  for (auto& friction : ledger.friction) f(friction);
}

std::vector<double> numbers_of(const Ledger& ledger) {
  std::vector<double> numbers;
  for_each_part(ledger, [&]<class Part>(const Part& part) {
    static_assert(std::is_trivially_copyable_v<Part> && sizeof(Part) % sizeof(double) == 0);
    numbers.resize(numbers.size() + sizeof(Part) / sizeof(double));
    std::memcpy(numbers.data() + numbers.size() - sizeof(Part) / sizeof(double), &part, sizeof(Part));
  });
  return numbers;
}

Ledger ledger_from(const std::vector<double>& numbers, std::size_t boundaries) {
  Ledger ledger;
  ledger.boundary.resize(boundaries), ledger.friction.resize(boundaries);
  std::size_t at = 0;
  for_each_part(ledger, [&]<class Part>(Part& part) {
    constexpr std::size_t count = sizeof(Part) / sizeof(double);
    if (at + count > numbers.size()) throw std::runtime_error("its books are of another case");
    std::memcpy(static_cast<void*>(&part), numbers.data() + at, sizeof(Part));
    at += count;
  });
  if (at != numbers.size()) throw std::runtime_error("its books are of another case");
  return ledger;
}

/// The particles' numbers in the order of the bins.
template <class T, class F>
std::vector<T> in_order(const Body& body, F&& of_particle) {
  std::vector<T> values;
  values.reserve(body.bins.order.size());
  for (const std::uint32_t p : body.bins.order) values.push_back(of_particle(p));
  return values;
}

void write(const Path& path, const Simulation& s, const RunProgress& progress) {
  Hdf5Writer file(path);
  const auto keep = [&]<class T>(const std::string& name, const std::vector<T>& values) {
    file.array(name, std::span<const T>(values));
  };
  keep("step", std::vector<std::int64_t>{s.step});
  keep("time", std::vector<double>{s.time, s.last_time_step});
  keep("extremes", numbers_of(s.extremes));
  keep("ledger", numbers_of(s.ledger));
  keep("progress", std::vector<double>{progress.wall_time, progress.row_time});
  keep("history_rows", std::vector<std::int64_t>{progress.history_rows});
  keep("snapshot_times", progress.snapshot_times);
  keep("measures", progress.measures);
  if (!s.gas.empty()) keep("gas", gas::numbers_of(s.gas));
  file.group("bodies");
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Particles& ps = s.bodies[b].particles;
    const std::string group = fmt::format("bodies/{}", b);
    file.group(group);
    file.attribute(group, "name", s.bodies[b].name);
    const Body& body = s.bodies[b];
    keep(group + "/id", in_order<std::uint64_t>(body, [&](std::uint32_t p) { return ps.id[p]; }));
    if (!ps.second_field.empty())
      keep(group + "/second_field", in_order<std::uint32_t>(body, [&](std::uint32_t p) { return ps.second_field[p]; }));
    for (const Column& c : ps.columns())
      keep(group + "/" + c.name,
           in_order<double>(body, [&](std::uint32_t p) { return ps.set(c.set).at(c.index, static_cast<int>(p)); }));
  }
  file.attribute("/", "format", format);
  file.finish();
}

/// A checkpoint in memory, read and proved whole before any of it becomes the state.
struct Content {
  std::int64_t step = 0;
  std::vector<double> time, extremes, ledger, gas;
  RunProgress progress;
  struct OfBody {
    std::vector<std::uint64_t> id, second_field;
    std::vector<std::vector<double>> columns;
  };
  std::vector<OfBody> bodies;
};

Content read(const Path& path, const Simulation& s) {
  const Hdf5Reader file(path);
  if (file.text_attribute("/", "format") != format) throw std::runtime_error("it is of another version of this program");
  Content content;
  content.step = file.integers("step").at(0);
  content.time = file.doubles("time"), content.extremes = file.doubles("extremes"), content.ledger = file.doubles("ledger");
  const std::vector<double> progress = file.doubles("progress");
  content.progress.wall_time = progress.at(0), content.progress.row_time = progress.at(1);
  content.progress.history_rows = file.integers("history_rows").at(0);
  content.progress.snapshot_times = file.doubles("snapshot_times");
  if (file.has("measures")) content.progress.measures = file.doubles("measures");  // older ones measured nothing over time
  if (!s.gas.empty()) content.gas = file.doubles("gas");
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Particles& ps = s.bodies[b].particles;
    const std::string group = fmt::format("bodies/{}", b);
    if (!file.has(group) || file.text_attribute(group, "name") != s.bodies[b].name)
      throw std::runtime_error(fmt::format("it holds no body \"{}\"", s.bodies[b].name));
    Content::OfBody body;
    body.id = file.unsigned_integers(group + "/id");
    if (!ps.second_field.empty()) body.second_field = file.unsigned_integers(group + "/second_field");
    for (const Column& column : ps.columns()) {
      body.columns.push_back(file.doubles(group + "/" + column.name));
      if (body.columns.back().size() != body.id.size()) throw std::runtime_error("its columns differ in length");
    }
    content.bodies.push_back(std::move(body));
  }
  return content;
}

void become(Simulation& s, const Content& content) {
  s.ledger = ledger_from(content.ledger, s.boundaries.size());
  s.step = content.step, s.time = content.time.at(0), s.last_time_step = content.time.at(1);
  s.extremes = extremes_from(content.extremes);
  if (!s.gas.empty()) gas::restore(s.gas, content.gas, *s.domain);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    Particles& ps = s.bodies[b].particles;
    const Content::OfBody& body = content.bodies[b];
    ps.resize(static_cast<int>(body.id.size()));
    ps.id = body.id;
    if (!ps.second_field.empty()) std::copy(body.second_field.begin(), body.second_field.end(), ps.second_field.begin());
    const std::vector<Column> columns = ps.columns();
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (int p = 0; p < ps.size; ++p)
        ps.set(columns[c].set).at(columns[c].index, p) = body.columns[c][static_cast<std::size_t>(p)];
  }
  if (!s.bodies.empty()) place_particles(s);
}

/// The step of a checkpoint, or nothing if there is no readable one.
std::optional<std::int64_t> step_of(const Path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    return Hdf5Reader(path).integers("step").at(0);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<Path> checkpoint_paths(const Path& directory) {
  return {directory / "checkpoint_a.h5", directory / "checkpoint_b.h5"};
}

Path write_checkpoint(const Path& directory, const Simulation& s, const RunProgress& progress) {
  const std::vector<Path> paths = checkpoint_paths(directory);
  const Path& older = step_of(paths[0]).value_or(-1) <= step_of(paths[1]).value_or(-1) ? paths[0] : paths[1];
  replace_file_durably(older, [&](const Path& temporary) { write(temporary, s, progress); });
  return older;
}

Restored restore_newest(const Path& directory, Simulation& s, const std::function<void(const std::string&)>& report) {
  std::vector<Path> paths = checkpoint_paths(directory);
  // One that cannot be read may have been the newest: it is tried first, so that what is wrong with it is told.
  const auto rank = [](const Path& path) { return step_of(path).value_or(std::numeric_limits<std::int64_t>::max()); };
  std::stable_sort(paths.begin(), paths.end(), [&](const Path& a, const Path& b) { return rank(a) > rank(b); });
  std::string reasons;
  for (const Path& path : paths) {
    if (!std::filesystem::exists(path)) continue;
    try {
      const Content content = read(path, s);
      become(s, content);
      if (report && !reasons.empty()) report(reasons);
      return {path, content.progress};
    } catch (const std::exception& error) {
      reasons += fmt::format("{}{}: not usable: {}", reasons.empty() ? "" : "\n", path.string(), error.what());
    }
  }
  throw std::runtime_error(
      fmt::format("{}: no usable checkpoint{}{}", directory.string(), reasons.empty() ? "; there is none" : "\n", reasons));
}

bool has_checkpoint(const Path& directory) {
  const std::vector<Path> paths = checkpoint_paths(directory);
  return std::any_of(paths.begin(), paths.end(), [](const Path& path) { return std::filesystem::exists(path); });
}

}  // namespace brisance::simulator
