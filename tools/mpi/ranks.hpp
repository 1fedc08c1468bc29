// The processes that work together, as MPI knows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <mpi.h>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

/// Collective calls: all ranks make them in the same order.
class Ranks {
public:
  explicit Ranks(MPI_Comm communicator);

  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] bool is_first() const noexcept { return rank_ == 0; }
  /// How many bytes exchange() has sent to other ranks.
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }

  /// Runs work() on every rank. Where one of them throws, all throw the Failure of the lowest.
  void together(const std::function<void()>& work) const;

  [[nodiscard]] std::uint64_t sum(std::uint64_t value) const;
  [[nodiscard]] double most(double value) const;
  [[nodiscard]] double least(double value) const { return -most(-value); }
  /// Returns the sum over lower ranks.
  [[nodiscard]] std::uint64_t sum_before(std::uint64_t value) const;
  /// Returns the values of the first rank.
  [[nodiscard]] std::vector<std::uint64_t> of_first(std::vector<std::uint64_t> values) const;
  /// Returns what all ranks have, on the first rank; nothing elsewhere.
  [[nodiscard]] std::vector<double> gather(const std::vector<double>& values) const;
  /// Sends values to each rank, and returns what came from all of them.
  template <typename Value>
  [[nodiscard]] std::vector<Value> exchange(std::vector<std::vector<Value>> to);

private:
  MPI_Comm communicator_;
  int rank_ = 0;
  int count_ = 1;
  std::uint64_t sent_ = 0;
};

template <typename Value>
std::vector<Value> Ranks::exchange(std::vector<std::vector<Value>> to) {
  const auto ranks = static_cast<std::size_t>(count_);
  std::vector<int> sends(ranks);
  std::vector<int> receives(ranks);
  std::vector<int> send_at(ranks);
  std::vector<int> receive_at(ranks);
  std::vector<Value> out;
  together([&] {
    std::size_t all = 0;
    for (const auto& values : to) {
      all += values.size();
    }
    if (all > std::size_t{1} << 30) { // MPI counts in int
      bad_input("expected parts that share at most 2^30 patches, found more: sort the patches");
    }
  });
  for (std::size_t r = 0; r < ranks; ++r) {
    send_at[r] = static_cast<int>(out.size());
    sends[r] = static_cast<int>(to[r].size());
    out.insert(out.end(), to[r].begin(), to[r].end());
    sent_ += r == static_cast<std::size_t>(rank_) ? 0 : to[r].size() * sizeof(Value);
    to[r] = {};
  }
  MPI_Alltoall(sends.data(), 1, MPI_INT, receives.data(), 1, MPI_INT, communicator_);
  int received = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    receive_at[r] = received;
    received += receives[r];
  }
  std::vector<Value> in(static_cast<std::size_t>(received));
  MPI_Datatype type;
  MPI_Type_contiguous(sizeof(Value), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(out.data(), sends.data(), send_at.data(), type, in.data(), receives.data(),
                receive_at.data(), type, communicator_);
  MPI_Type_free(&type);
  return in;
}

} // namespace simdbezier::tools
