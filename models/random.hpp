#pragma once
// Random numbers without a state: a pure function of the run's seed, the global id of a point and the property drawn for.
// Whoever creates the point, in whatever order, on however many processes, gets the same number.

#include <Random123/philox.h>

#include <cstdint>

namespace brisance {

/// What a number is drawn for: one independent number for each property of a point.
enum class RandomProperty : std::uint32_t { porosity, damage, strength };

/// Uniform in the open interval (0, 1): 52 random bits, centred in their cells so that neither end can come out.
inline double uniform(std::uint64_t seed, std::uint64_t id, RandomProperty property) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const r123::Philox4x32::ctr_type counter = {{low(id), high(id), static_cast<std::uint32_t>(property), 0}};
  const r123::Philox4x32::key_type key = {{low(seed), high(seed)}};
  const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(counter, key);
  const std::uint64_t bits = (static_cast<std::uint64_t>(words[0]) << 20) | (words[1] >> 12);
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace brisance
