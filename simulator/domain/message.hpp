#pragma once
// Plain values into messages and out again, in the order in which they were written.

#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "simulator/domain/domain.hpp"

namespace brisance::simulator {

template <class T>
void append(Message& to, const T* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = to.size();
  to.resize(at + count * sizeof(T));
  if (count) std::memcpy(to.data() + at, values, count * sizeof(T));
}
template <class T>
void append(Message& to, const T& value) {
  append(to, &value, 1);
}
template <class T>
void append(Message& to, const std::vector<T>& values) {
  append(to, values.size());
  append(to, values.data(), values.size());
}

class MessageReader {
 public:
  explicit MessageReader(const Message& message) : message_(message) {}
  bool at_end() const { return at_ == message_.size(); }
  template <class T>
  void read(T* values, std::size_t count) {
    if (at_ + count * sizeof(T) > message_.size()) throw std::logic_error("message: shorter than what is read from it");
    if (count) std::memcpy(values, message_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  template <class T>
  T read() {
    T value;
    read(&value, 1);
    return value;
  }
  template <class T>
  std::vector<T> read_list() {
    std::vector<T> values(read<std::size_t>());
    read(values.data(), values.size());
    return values;
  }

 private:
  const Message& message_;
  std::size_t at_ = 0;
};

/// What every rank has to say, by rank.
inline std::vector<Message> all_gather(Domain& domain, const Message& mine) {
  return domain.exchange(std::vector<Message>(static_cast<std::size_t>(domain.size()), mine));
}

}  // namespace brisance::simulator
